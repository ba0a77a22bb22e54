//! Where the explorer's reduced models come from: one for each kind of contact and each fluid, or none.

use crate::engine::Store;
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::lubricant::{Lubricant, ShearLaw};
use crate::solver::reduced::ReducedModel;
use rayon::prelude::*;
use std::sync::Arc;

/// The reduced models in use. Where there is none for a contact and its fluid, the full solver draws the pictures.
#[derive(Clone, Default)]
pub struct Models {
    models: Vec<Arc<ReducedModel>>,
}

impl Models {
    /// The models embedded in the program. Without them (a damaged build) the full solver draws the pictures.
    pub fn embedded(store: &Store) -> Self {
        let all = [false, true].map(|thins| [ContactKind::Line, ContactKind::Point].map(|kind| (thins, kind)));
        // Operators are computed as a model is read: all of them at once, for the window waits.
        Self {
            models: all
                .as_flattened()
                .par_iter()
                .filter_map(|&(thins, kind)| store.embedded(kind, thins).ok())
                .collect(),
        }
    }

    /// Only this model, or none.
    pub fn only(model: Option<Arc<ReducedModel>>) -> Self {
        Self { models: model.into_iter().collect() }
    }

    /// The model that serves a kind of contact with a fluid: one of this very fluid, else one of another fluid that
    /// thins under shear as little or as much; what it was trained for it says itself.
    pub fn of(&self, kind: ContactKind, lubricant: &Lubricant) -> Option<&Arc<ReducedModel>> {
        let thins = |laws: &Lubricant| laws.shear != ShearLaw::Newtonian;
        let akin = |model: &&Arc<ReducedModel>| thins(&model.domain.lubricant) == thins(lubricant);
        let own = self.place(kind, lubricant).and_then(|place| self.models.get(place));
        own.or_else(|| self.models.iter().filter(|model| model.contact() == kind).find(akin))
    }

    /// Puts a model in place of the one of its kind of contact and fluid, which is returned.
    pub fn put(&mut self, model: Arc<ReducedModel>) -> Option<Arc<ReducedModel>> {
        match self.place(model.contact(), &model.domain.lubricant) {
            Some(place) => Some(std::mem::replace(&mut self.models[place], model)),
            None => {
                self.models.push(model);
                None
            }
        }
    }

    /// Takes a model away.
    pub fn remove(&mut self, model: &Arc<ReducedModel>) {
        self.models.retain(|other| !Arc::ptr_eq(other, model));
    }

    /// Whether a model is among them.
    pub fn contains(&self, model: &Arc<ReducedModel>) -> bool {
        self.models.iter().any(|other| Arc::ptr_eq(other, model))
    }

    fn place(&self, kind: ContactKind, lubricant: &Lubricant) -> Option<usize> {
        let wanted = lubricant.of_the_liquid();
        let same = |model: &Arc<ReducedModel>| model.domain.lubricant.of_the_liquid() == wanted;
        self.models.iter().position(|model| model.contact() == kind && same(model))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::named_lubricant::{SQUALANE_PIP, by_name};
    use crate::solver::physics::lubricant::{LimitingStress, ViscosityLaw};

    #[test]
    fn the_fluid_picks_the_model_and_another_fluid_gets_the_one_akin() {
        let models = Models::embedded(&Store::default());
        let of = |lubricant: &Lubricant| models.of(ContactKind::Line, lubricant).unwrap();
        let (newtonian, thinning) = (of(&Lubricant::default()), of(&SQUALANE_PIP));
        assert!(newtonian.domain.sliding.is_none() && thinning.domain.sliding.is_some());
        let barus = Lubricant { viscosity: ViscosityLaw::Barus, ..Lubricant::default() };
        assert!(Arc::ptr_eq(of(&barus), newtonian));
        assert!(Arc::ptr_eq(of(&by_name("pao-650").unwrap().laws), thinning));
        // A limiting stress changes neither pressure nor film.
        let limited = Lubricant {
            limiting_stress: Some(LimitingStress { ambient: 5e6, slope: 0.05, eyring: None }),
            ..SQUALANE_PIP
        };
        assert!(Arc::ptr_eq(of(&limited), thinning));
    }

    #[test]
    fn a_model_takes_the_place_of_the_one_of_its_fluid_only() {
        let mut models = Models::embedded(&Store::default());
        let own = Arc::clone(models.of(ContactKind::Line, &SQUALANE_PIP).unwrap());
        let mut other = ReducedModel::clone(&own);
        other.title = "another".to_owned();
        let other = Arc::new(other);
        let former = models.put(Arc::clone(&other)).unwrap();
        assert!(Arc::ptr_eq(&former, &own) && models.contains(&other) && !models.contains(&own));
        assert!(models.of(ContactKind::Line, &Lubricant::default()).is_some());
        models.remove(&other);
        assert!(models.of(ContactKind::Line, &SQUALANE_PIP).is_none());
    }
}
