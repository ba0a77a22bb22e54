//! Reduced models of the explorer: the built-in models, some of which are read when first needed, and the models
//! that the user has put in their place.

use crate::engine::registry::{alike, best, loads_in_common};
use crate::engine::{Store, catalogue};
use crate::host::pool::on_all_cores;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::reduced::{Domain, ReducedModel};
use rayon::prelude::*;
use std::sync::Arc;

/// Models that are read at start. Few users need the others.
const FIRST: [&str; 4] = ["line", "line_shear", "point", "point_shear"];

/// Model in use, or built-in model that is read when first needed.
#[derive(Clone)]
enum Known {
    Read(Arc<ReducedModel>),
    /// Name and domain of a model that has not been read yet.
    Later(&'static str, &'static Domain),
    /// Model that is being read, or that could not be read. It keeps its place in the list, so that the choice
    /// between two equally near models does not depend on the order of reading.
    Asked(&'static Domain),
}

impl Known {
    fn domain(&self) -> &Domain {
        match self {
            Self::Read(model) => &model.domain,
            Self::Later(_, domain) | Self::Asked(domain) => domain,
        }
    }

    fn model(&self) -> Option<&Arc<ReducedModel>> {
        match self {
            Self::Read(model) => Some(model),
            Self::Later(..) | Self::Asked(_) => None,
        }
    }
}

/// Reduced models in use. If none covers a contact, the full solver computes the pictures.
#[derive(Clone, Default)]
pub struct Models {
    known: Vec<Known>,
}

impl Models {
    /// Returns the built-in models. Some of them are read later, as are models whose file is not yet available.
    /// Until then the full solver computes the pictures.
    pub fn embedded(store: &Store) -> Self {
        // Reading a model computes its operators. Read all of them in parallel, because the window waits.
        let read = |name: &'static str| (name, store.shown(name).ok());
        let first: Vec<_> = on_all_cores(|| FIRST.into_par_iter().map(read).collect());
        let mut known: Vec<Known> = first.iter().filter_map(|(_, model)| model.clone()).map(Known::Read).collect();
        let there = |name| first.iter().any(|(first, model)| *first == name && model.is_some());
        let later = catalogue().iter().filter(|entry| !there(entry.name));
        known.extend(later.map(|entry| Known::Later(entry.name, &entry.domain)));
        Self { known }
    }

    /// Returns a list with only this model, or an empty list.
    pub fn only(model: Option<Arc<ReducedModel>>) -> Self {
        Self { known: model.into_iter().map(Known::Read).collect() }
    }

    /// Returns the name of the model that must be read for a contact. Returns each name only once.
    pub fn late_for(&mut self, point: &OperatingPoint, lubricant: &Lubricant) -> Option<&'static str> {
        let all = self.known.iter().enumerate().map(|(place, known)| (place, known.domain()));
        let place = best(all, point, lubricant)?;
        let known = self.known.get_mut(place)?;
        let Known::Later(name, domain) = *known else { return None };
        *known = Known::Asked(domain);
        Some(name)
    }

    /// Returns the model for a contact with a lubricant, among the models that have been read.
    pub fn of(&self, point: &OperatingPoint, lubricant: &Lubricant) -> Option<&Arc<ReducedModel>> {
        best(self.read().map(|model| (model, &model.domain)), point, lubricant)
    }

    /// Returns the model in use that another model would replace.
    pub fn counterpart(&self, domain: &Domain) -> Option<&Arc<ReducedModel>> {
        self.place(domain).and_then(|place| self.known[place].model())
    }

    /// Puts a model in place of the one for the same kind of contact, lubricant and loads, and returns the replaced
    /// model.
    pub fn put(&mut self, model: Arc<ReducedModel>) -> Option<Arc<ReducedModel>> {
        match self.place(&model.domain) {
            Some(place) => std::mem::replace(&mut self.known[place], Known::Read(model)).model().cloned(),
            None => {
                self.known.push(Known::Read(model));
                None
            }
        }
    }

    /// Removes a model.
    pub fn remove(&mut self, model: &Arc<ReducedModel>) {
        self.known.retain(|known| known.model().is_none_or(|other| !Arc::ptr_eq(other, model)));
    }

    /// Returns true if a model is in use for the same kind of contact, loads and lubricant.
    pub fn serves(&self, model: &ReducedModel) -> bool {
        self.read().any(|known| alike(&known.domain, &model.domain))
    }

    /// Returns true if a model is in use.
    pub fn contains(&self, model: &Arc<ReducedModel>) -> bool {
        self.read().any(|other| Arc::ptr_eq(other, model))
    }

    fn read(&self) -> impl Iterator<Item = &Arc<ReducedModel>> {
        self.known.iter().filter_map(Known::model)
    }

    /// Returns the index of the model to be replaced by one of this domain. Among the models of the same contact
    /// and lubricant, it is the one whose load range overlaps most.
    fn place(&self, wanted: &Domain) -> Option<usize> {
        let same = |domain: &Domain| {
            domain.contact == wanted.contact
                && domain.space.of_ellipses() == wanted.space.of_ellipses()
                && domain.is_of(&wanted.lubricant)
        };
        let shared = |place: &usize| loads_in_common(self.known[*place].domain(), wanted);
        let places = (0..self.known.len()).filter(|place| same(self.known[*place].domain()) && shared(place) > 0.0);
        places.max_by(|a, b| shared(a).total_cmp(&shared(b)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::document::{Document, Shape};
    use crate::scene::named_lubricant::{SQUALANE_PIP, by_name};
    use crate::solver::full::Problem;
    use crate::solver::parameters::Quantity;
    use crate::solver::physics::contact::{ContactKind, MoesRequest, Sliding, si_from_moes};
    use crate::solver::physics::lubricant::{Heat, LimitingStress, ShearLaw, ViscosityLaw};
    use crate::solver::reduced::Trust;

    fn line() -> OperatingPoint {
        si_from_moes(&MoesRequest::new(ContactKind::Line, 40.0, 10.0)).unwrap()
    }

    #[test]
    fn fluid_selects_the_model_or_the_nearest() {
        let models = Models::embedded(&Store::default());
        let of = |lubricant: &Lubricant| models.of(&line(), lubricant).unwrap();
        let (newtonian, thinning) = (of(&Lubricant::default()), of(&SQUALANE_PIP));
        let plateau = |model: &ReducedModel| model.domain.space.varies(Quantity::NewtonianPlateauRatio);
        assert!(!plateau(newtonian) && plateau(thinning));
        let barus = Lubricant { viscosity: ViscosityLaw::Barus, ..Lubricant::default() };
        assert!(Arc::ptr_eq(of(&barus), newtonian));
        assert!(Arc::ptr_eq(of(&by_name("pao-650").unwrap().laws), thinning));
        // A limiting shear stress changes neither pressure nor film thickness.
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
    fn ellipse_model_is_read_once_and_on_demand() {
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
    fn user_model_replaces_the_nearer_embedded_one() {
        let store = Store::default();
        let mut models = Models::embedded(&store);
        let ball = |m: f64| si_from_moes(&MoesRequest::new(ContactKind::Point, m, 5.0)).unwrap();
        let oil = Lubricant::default();
        let heavy = Arc::clone(models.of(&ball(50.0), &oil).unwrap());
        assert_eq!(models.late_for(&ball(50.0), &oil), None);
        assert_eq!(models.late_for(&ball(6.0), &oil), Some("point_light"));
        assert!(Arc::ptr_eq(models.of(&ball(6.0), &oil).unwrap(), &heavy), "until it is there");
        let light = store.embedded("point_light").unwrap();
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
    fn eyring_models_are_read_on_demand() {
        let store = Store::default();
        let mut models = Models::embedded(&store);
        let shear = ShearLaw::Eyring { critical_stress: 5e6, npr: 0.0 };
        let oil = Lubricant { shear, limiting_stress: None, ..Document::default().lubricant };
        let mut ball = Document::default();
        ball.set_shape(Shape::Ball).unwrap();
        let light = si_from_moes(&MoesRequest::new(ContactKind::Point, 6.0, 5.0)).unwrap();
        let homes = [
            (Document::default().point, "line_sliding"),
            (ball.point, "point_sliding"),
            (light, "point_light_sliding"),
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
    fn thermal_model_is_read_on_demand() {
        let store = Store::default();
        let mut models = Models::embedded(&store);
        let cold = Document::default().lubricant;
        let warm = Lubricant { heat: Some(Heat::default()), ..cold };
        assert_eq!(models.late_for(&line(), &cold), None);
        assert_eq!(models.late_for(&line(), &warm), Some("line_heat"));
        let heated = store.embedded("line_heat").unwrap();
        let isothermal = Arc::clone(models.of(&line(), &warm).unwrap());
        assert!(!models.serves(&heated) && models.serves(&isothermal));
        assert!(models.put(Arc::clone(&heated)).is_none() && models.serves(&heated));
        assert!(Arc::ptr_eq(models.of(&line(), &warm).unwrap(), &heated));
        assert!(Arc::ptr_eq(models.of(&line(), &cold).unwrap(), &isothermal));
        // The contacts that the explorer starts with are inside the trained range.
        let mut ball = Document::default();
        ball.set_shape(Shape::Ball).unwrap();
        assert_eq!(models.late_for(&ball.point, &warm), Some("point_heat"));
        let of_balls = store.embedded("point_heat").unwrap();
        for (model, home) in [(&heated, Document::default().point), (&of_balls, ball.point)] {
            for srr in [0.0, 0.1, 1.0] {
                let sliding = Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio: None };
                let point = OperatingPoint { sliding, ..home };
                assert_eq!(model.trust(&Problem::new(&point, warm).unwrap()), Trust::Trained, "SRR {srr}");
            }
        }
    }
}
