//! Where the explorer's reduced models come from: one for each kind of contact and each fluid, or none.

use crate::engine::{Embedded, Store};
use crate::host::pool::on_all_cores;
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::{Lubricant, ShearLaw};
use crate::solver::reduced::ReducedModel;
use rayon::prelude::*;
use std::mem::{Discriminant, discriminant};
use std::sync::Arc;

/// The models that are read when they are first asked for: not everybody has ellipses, light balls, heat or oils that thin.
const LATE: [Embedded; 7] = [
    Embedded::LightCircle,
    Embedded::Ellipse,
    Embedded::HeatedLine,
    Embedded::HeatedCircle,
    Embedded::EyringLine,
    Embedded::EyringCircle,
    Embedded::LightEyringCircle,
];

/// The reduced models in use. Where there is none for a contact and its fluid, the full solver draws the pictures.
#[derive(Clone, Default)]
pub struct Models {
    models: Vec<Arc<ReducedModel>>,
    /// Those of the program that are read only when they are first asked for.
    late: Vec<Embedded>,
}

impl Models {
    /// The models embedded in the program, some of them later. Without them (a damaged build) the full solver draws
    /// the pictures.
    pub fn embedded(store: &Store) -> Self {
        let (late, first): (Vec<_>, Vec<_>) = Embedded::ALL.into_iter().partition(|which| LATE.contains(which));
        // Operators are computed as a model is read: all of them at once, for the window waits.
        let read = |which: &Embedded| store.embedded(*which).ok();
        Self { models: on_all_cores(|| first.par_iter().filter_map(read).collect()), late }
    }

    /// The model that has to be read before a contact can be served; only once.
    pub fn late_for(&mut self, point: &OperatingPoint, lubricant: &Lubricant) -> Option<Embedded> {
        let wanted = Embedded::of(point, lubricant);
        let place = self.late.iter().position(|late| *late == wanted)?;
        Some(self.late.swap_remove(place))
    }

    /// Only this model, or none.
    pub fn only(model: Option<Arc<ReducedModel>>) -> Self {
        Self { models: model.into_iter().collect(), late: Vec::new() }
    }

    /// The model that serves a contact with a fluid: one of its shape and of this very fluid, else one of another fluid
    /// that thins under shear as little or as much, else one of circles; what it was trained for it says itself.
    pub fn of(&self, point: &OperatingPoint, lubricant: &Lubricant) -> Option<&Arc<ReducedModel>> {
        let (ellipse, m) = (point.radius_ratio() != 1.0, point.moes().m);
        let round = || self.shaped(point.kind, false, lubricant, m);
        self.shaped(point.kind, ellipse, lubricant, m).or_else(|| ellipse.then(round).flatten())
    }

    /// The model of a kind of contact, elliptical or not, with a fluid; with heat one that knows heat, where there is one.
    /// Of several that differ in M alone it is the one that knows this load number, or comes nearest to it.
    pub fn shaped(
        &self,
        kind: ContactKind,
        ellipse: bool,
        lubricant: &Lubricant,
        m: f64,
    ) -> Option<&Arc<ReducedModel>> {
        let thins = |laws: &Lubricant| laws.shear != ShearLaw::Newtonian;
        let akin = |model: &&Arc<ReducedModel>| thins(&model.domain.lubricant) == thins(lubricant);
        let of_law = |model: &&Arc<ReducedModel>| law(&model.domain.lubricant) == law(lubricant);
        let own = |model: &&Arc<ReducedModel>| model.domain.is_of(lubricant);
        let shaped = |model: &&Arc<ReducedModel>| model.contact() == kind && model.of_ellipses() == ellipse;
        let warm = |model: &&Arc<ReducedModel>| model.domain.heats();
        let alike = || self.models.iter().filter(shaped).filter(akin);
        let cold = || alike().filter(|model| !warm(model));
        let wanted = lubricant.heat.is_some();
        nearest(m, self.models.iter().filter(shaped).filter(own))
            .or_else(|| nearest(m, alike().filter(|model| warm(model) && wanted)))
            .or_else(|| nearest(m, cold().filter(of_law)))
            .or_else(|| nearest(m, cold()))
    }

    /// Puts a model in place of the one of its kind of contact, fluid and loads, which is returned.
    pub fn put(&mut self, model: Arc<ReducedModel>) -> Option<Arc<ReducedModel>> {
        match self.place(&model) {
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

    /// Whether contacts of a model's kind and loads, with a fluid like its own, have one.
    pub fn serves(&self, model: &ReducedModel) -> bool {
        let kind = |model: &ReducedModel| {
            let laws = &model.domain.lubricant;
            (model.contact(), model.of_ellipses(), law(laws), laws.heat.is_some())
        };
        self.models.iter().any(|known| kind(known) == kind(model) && in_common(known, model) > 0.0)
    }

    /// Whether a model is among them.
    pub fn contains(&self, model: &Arc<ReducedModel>) -> bool {
        self.models.iter().any(|other| Arc::ptr_eq(other, model))
    }

    /// The place of the model that another one is to replace: of its kind of contact and fluid the one with which it has
    /// most loads in common.
    fn place(&self, wanted: &ReducedModel) -> Option<usize> {
        let shape = |model: &ReducedModel| (model.contact(), model.of_ellipses());
        let alike =
            |model: &ReducedModel| shape(model) == shape(wanted) && model.domain.is_of(&wanted.domain.lubricant);
        let shared = |place: &usize| in_common(&self.models[*place], wanted);
        let places = (0..self.models.len()).filter(|place| alike(&self.models[*place]) && shared(place) > 0.0);
        places.max_by(|a, b| shared(a).total_cmp(&shared(b)))
    }
}

/// Of several models the first that knows a load number, or else comes nearest to it.
fn nearest<'a>(m: f64, models: impl Iterator<Item = &'a Arc<ReducedModel>>) -> Option<&'a Arc<ReducedModel>> {
    let beyond = |model: &ReducedModel| (model.domain.m().0 / m).max(m / model.domain.m().1).max(1.0);
    models.min_by(|a, b| beyond(a).total_cmp(&beyond(b)))
}

/// The loads that two models have in common, in ln M.
fn in_common(a: &ReducedModel, b: &ReducedModel) -> f64 {
    let (a, b) = (a.domain.m(), b.domain.m());
    (a.1.min(b.1) / a.0.max(b.0)).ln()
}

/// Which law of shear a lubricant has, whatever its constants.
fn law(lubricant: &Lubricant) -> Discriminant<ShearLaw> {
    discriminant(&lubricant.shear)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::document::{Document, Shape};
    use crate::scene::named_lubricant::{SQUALANE_PIP, by_name};
    use crate::solver::full::Problem;
    use crate::solver::parameters::Quantity;
    use crate::solver::physics::contact::{MoesRequest, Sliding, si_from_moes};
    use crate::solver::physics::lubricant::{Heat, LimitingStress, ViscosityLaw};
    use crate::solver::reduced::Trust;

    fn line() -> OperatingPoint {
        si_from_moes(&MoesRequest::new(ContactKind::Line, 40.0, 10.0)).unwrap()
    }

    #[test]
    fn the_fluid_picks_the_model_and_another_fluid_gets_the_one_akin() {
        let models = Models::embedded(&Store::default());
        let of = |lubricant: &Lubricant| models.of(&line(), lubricant).unwrap();
        let (newtonian, thinning) = (of(&Lubricant::default()), of(&SQUALANE_PIP));
        let plateau = |model: &ReducedModel| model.domain.space.varies(Quantity::NewtonianPlateauRatio);
        assert!(!plateau(newtonian) && plateau(thinning));
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
        let own = Arc::clone(models.of(&line(), &SQUALANE_PIP).unwrap());
        let mut other = ReducedModel::clone(&own);
        other.title = "another".to_owned();
        let other = Arc::new(other);
        let former = models.put(Arc::clone(&other)).unwrap();
        assert!(Arc::ptr_eq(&former, &own) && models.contains(&other) && !models.contains(&own));
        assert!(models.of(&line(), &Lubricant::default()).is_some());
        models.remove(&other);
        assert!(models.of(&line(), &SQUALANE_PIP).is_none());
    }
    #[test]
    fn the_model_of_ellipses_is_read_once_and_only_when_there_is_one() {
        let store = Store::default();
        let mut models = Models::embedded(&store);
        let circle = si_from_moes(&MoesRequest::new(ContactKind::Point, 50.0, 5.0)).unwrap();
        let ellipse = Quantity::RadiusRatio.at(&circle, 2.0);
        let oil = Lubricant::default();
        assert_eq!(models.late_for(&circle, &oil), None);
        let round = Arc::clone(models.of(&circle, &oil).unwrap());
        assert!(Arc::ptr_eq(models.of(&ellipse, &oil).unwrap(), &round), "until it is there");
        let which = models.late_for(&ellipse, &oil).unwrap();
        assert_eq!(models.late_for(&ellipse, &oil), None, "once");
        assert!(models.put(store.embedded(which).unwrap()).is_none());
        assert!(
            models.of(&ellipse, &oil).unwrap().of_ellipses() && Arc::ptr_eq(models.of(&circle, &oil).unwrap(), &round)
        );
        assert_eq!(Models::only(None).late_for(&ellipse, &oil), None);
    }

    #[test]
    fn light_balls_have_a_model_beside_that_of_the_others_and_one_of_the_users_takes_the_place_of_the_nearer() {
        let store = Store::default();
        let mut models = Models::embedded(&store);
        let ball = |m: f64| si_from_moes(&MoesRequest::new(ContactKind::Point, m, 5.0)).unwrap();
        let oil = Lubricant::default();
        let heavy = Arc::clone(models.of(&ball(50.0), &oil).unwrap());
        assert_eq!(models.late_for(&ball(50.0), &oil), None);
        assert_eq!(models.late_for(&ball(6.0), &oil), Some(Embedded::LightCircle));
        assert!(Arc::ptr_eq(models.of(&ball(6.0), &oil).unwrap(), &heavy), "until it is there");
        let light = store.embedded(Embedded::LightCircle).unwrap();
        assert!(!models.serves(&light) && models.put(Arc::clone(&light)).is_none() && models.serves(&light));
        for (m, wanted) in [(2.0, &light), (6.0, &light), (12.5, &heavy), (900.0, &heavy)] {
            assert!(Arc::ptr_eq(models.of(&ball(m), &oil).unwrap(), wanted), "M = {m}");
        }
        let mut own = ReducedModel::clone(&heavy);
        own.domain.space.axis_mut(Quantity::M).unwrap().ends = (4.0, 20.0);
        own.domain.lubricant = light.domain.lubricant;
        let own = Arc::new(own);
        let former = models.put(Arc::clone(&own)).unwrap();
        assert!(Arc::ptr_eq(&former, &light) && Arc::ptr_eq(models.of(&ball(6.0), &oil).unwrap(), &own));
        assert!(models.contains(&heavy) && Arc::ptr_eq(models.of(&ball(50.0), &oil).unwrap(), &heavy));
    }

    #[test]
    fn models_of_oils_that_thin_by_eyrings_law_are_read_late_and_know_the_first_contacts() {
        let store = Store::default();
        let mut models = Models::embedded(&store);
        let shear = ShearLaw::Eyring { critical_stress: 5e6, npr: 0.0 };
        let oil = Lubricant { shear, limiting_stress: None, ..Document::default().lubricant };
        let mut ball = Document::default();
        ball.set_shape(Shape::Ball).unwrap();
        let light = si_from_moes(&MoesRequest::new(ContactKind::Point, 6.0, 5.0)).unwrap();
        let homes = [
            (Document::default().point, Embedded::EyringLine),
            (ball.point, Embedded::EyringCircle),
            (light, Embedded::LightEyringCircle),
        ];
        for (home, wanted) in homes {
            assert_eq!(models.late_for(&home, &oil), Some(wanted));
            let model = store.embedded(wanted).unwrap();
            assert!(models.put(Arc::clone(&model)).is_none() && Arc::ptr_eq(models.of(&home, &oil).unwrap(), &model));
            for srr in [0.0, 0.1, 1.0] {
                let sliding = Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio: None };
                let point = OperatingPoint { sliding, ..home };
                let trust = model.trust(&Problem::new(&point, oil).unwrap());
                assert_eq!(trust, Trust::Trained, "{wanted:?} at SRR {srr}");
            }
        }
    }

    #[test]
    fn the_model_with_heat_is_read_late_and_draws_what_has_heat_only() {
        let store = Store::default();
        let mut models = Models::embedded(&store);
        let cold = Document::default().lubricant;
        let warm = Lubricant { heat: Some(Heat::default()), ..cold };
        assert_eq!(models.late_for(&line(), &cold), None);
        assert_eq!(models.late_for(&line(), &warm), Some(Embedded::HeatedLine));
        let heated = store.embedded(Embedded::HeatedLine).unwrap();
        let isothermal = Arc::clone(models.of(&line(), &warm).unwrap());
        assert!(!models.serves(&heated) && models.serves(&isothermal));
        assert!(models.put(Arc::clone(&heated)).is_none() && models.serves(&heated));
        assert!(Arc::ptr_eq(models.of(&line(), &warm).unwrap(), &heated));
        assert!(Arc::ptr_eq(models.of(&line(), &cold).unwrap(), &isothermal));
        // The contacts that the explorer opens with are among those they were trained for.
        let mut ball = Document::default();
        ball.set_shape(Shape::Ball).unwrap();
        assert_eq!(models.late_for(&ball.point, &warm), Some(Embedded::HeatedCircle));
        let of_balls = store.embedded(Embedded::HeatedCircle).unwrap();
        for (model, home) in [(&heated, Document::default().point), (&of_balls, ball.point)] {
            for srr in [0.0, 0.1, 1.0] {
                let sliding = Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio: None };
                let point = OperatingPoint { sliding, ..home };
                assert_eq!(model.trust(&Problem::new(&point, warm).unwrap()), Trust::Trained, "SRR {srr}");
            }
        }
    }
}
