//! Marches that a transient study computes.

use super::data::{Drive, TransientStudy};
use crate::solver::full::transient::{Frame, Keep, Transient};
use crate::solver::physics::contact::{ContactError, ContactKind, MoesRequest, OperatingPoint, si_from_moes};
use crate::solver::physics::lubricant::Lubricant;

/// Approximate number of states kept of a training trajectory.
const TRAINING_STATES: f64 = 700.0;
/// The same for linearised models, which select among the states, and for local bases, which divide them.
const MANY_TRAINING_STATES: f64 = 3000.0;

/// Returns the contact with Moes numbers (M, L), with radius, materials and lubricant of another contact.
///
/// # Errors
/// If there is no such contact.
pub(super) fn training_contact(own: &OperatingPoint, (m, l): (f64, f64)) -> Result<OperatingPoint, ContactError> {
    si_from_moes(&MoesRequest {
        radius_m: Some(own.radius_m),
        modulus_pa: Some(own.modulus_pa),
        viscosity_pa_s: Some(own.viscosity_pa_s),
        alpha_per_pa: Some(own.alpha_per_pa),
        ..MoesRequest::new(ContactKind::Line, m, l)
    })
}

impl TransientStudy {
    /// Returns all inputs: the study's own, which have no name, and the further ones.
    pub fn drives(&self) -> Vec<Drive> {
        let own = Drive { name: String::new(), inputs: self.inputs.clone(), duration: self.duration };
        std::iter::once(own).chain(self.further.iter().cloned()).collect()
    }

    /// Returns the interval for statistics of a march with this duration.
    pub fn window(&self, duration: f64) -> (f64, f64) {
        self.window.unwrap_or((0.0, duration))
    }

    /// Returns the march along some inputs, without stored fields.
    pub fn march(&self, drive: &Drive, point: OperatingPoint, lubricant: Lubricant, frame: Frame) -> Transient {
        let Drive { inputs, duration, .. } = drive.clone();
        let (separation, surfaces, scheme) = (self.separation.clone(), Vec::new(), self.scheme);
        let (time_step, keep) = (self.time_step, Keep::Scalars);
        Transient { point, lubricant, inputs, separation, surfaces, scheme, frame, duration, time_step, keep }
    }

    /// Returns the march along the study's own inputs. It stores fields if models are trained from it.
    pub fn own_march(&self, point: OperatingPoint, lubricant: Lubricant, frame: Frame) -> Transient {
        let trains = self.trains_on_itself(point.kind);
        Transient {
            point,
            lubricant,
            inputs: self.inputs.clone(),
            separation: self.separation.clone(),
            surfaces: Vec::new(),
            scheme: self.scheme,
            frame,
            duration: self.duration,
            time_step: self.time_step,
            keep: if trains { self.training_states(self.duration) } else { Keep::Scalars },
        }
    }

    /// Returns true if the study trains models from full marches. Models of circular contacts are trained around the
    /// reference contact instead.
    pub fn trains(&self, kind: ContactKind) -> bool {
        let models =
            self.linearised.is_some() || self.reduced.as_ref().is_some_and(|reduced| reduced.training().is_some());
        models && kind.is_line()
    }

    /// Returns true if models are trained from the march along the study's own inputs.
    pub fn trains_on_itself(&self, kind: ContactKind) -> bool {
        self.trains(kind) && !self.has_trainings()
    }

    /// Returns true if the study has other inputs or contacts for training.
    fn has_trainings(&self) -> bool {
        !(self.trainings.is_empty() && self.training_loads.is_empty() && self.training_contacts.is_empty())
    }

    /// Returns the marches for training the models of a frame, contact by contact. Empty without other inputs or
    /// contacts than those of the study's own march, `own`.
    pub fn training_marches(&self, own: &Transient) -> Vec<Transient> {
        if !self.has_trainings() {
            return Vec::new();
        }
        let loaded = self.training_loads.iter().map(|&load| OperatingPoint { load, ..own.point });
        // Invalid contacts are refused by the check before.
        let chosen = self.training_contacts.iter().filter_map(|contact| training_contact(&own.point, *contact).ok());
        let mut contacts: Vec<OperatingPoint> = loaded.chain(chosen).collect();
        if contacts.is_empty() {
            contacts.push(own.point);
        }
        let own_drive = [Drive { name: String::new(), inputs: own.inputs.clone(), duration: own.duration }];
        let drives = if self.trainings.is_empty() { &own_drive[..] } else { &self.trainings };
        let march = |point: OperatingPoint, drive: &Drive| Transient {
            point,
            inputs: drive.inputs.clone(),
            duration: drive.duration,
            keep: self.training_states(drive.duration),
            ..own.clone()
        };
        contacts.iter().flat_map(|&point| drives.iter().map(move |drive| march(point, drive))).collect()
    }

    /// Returns which states a training stores. Linearised models and local bases need more states than a single basis.
    fn training_states(&self, duration: f64) -> Keep {
        let longest = self.time_step.longest(duration);
        let local = self.reduced.as_ref().is_some_and(|reduced| reduced.local.is_some());
        let most = if self.linearised.is_some() || local { MANY_TRAINING_STATES } else { TRAINING_STATES };
        Keep::Every(((duration / longest / most) as usize).max(1))
    }
}

#[cfg(test)]
mod tests {
    use super::super::data::ReducedTransient;
    use super::*;
    use crate::scene::{Scene, Study};
    use crate::solver::training::LocalBases;

    fn study(text: &str) -> (OperatingPoint, TransientStudy) {
        let scene = Scene::from_ron(&format!("Scene(version: 1, title: \"t\", study: Transient({text}))")).unwrap();
        let Study::Transient(study) = scene.study.clone() else { panic!() };
        (scene.point().unwrap(), study)
    }

    #[test]
    fn trainings_march_each_load_or_their_inputs() {
        let load = "inputs: (load: Harmonic(amplitude: 0.1, period: 2.0)), duration: 6.5, time_step: Fixed(0.001)";
        let linearised = "linearised: (modes: 10, selection: Step(tolerance: 0.001))";
        let (point, own) = study(&format!("{load}, {linearised}"));
        let march = |study: &TransientStudy| study.own_march(point, Lubricant::default(), Frame::Fixed);
        assert!(own.trains_on_itself(point.kind) && own.training_marches(&march(&own)).is_empty());
        assert_eq!(march(&own).keep, Keep::Every(2), "6500 steps, of which about 3000 states are kept");

        let (_, plain) = study(load);
        let keep = |local: Option<LocalBases>| {
            let reduced = Some(ReducedTransient { local, ..ReducedTransient::default() });
            march(&TransientStudy { reduced, ..plain.clone() }).keep
        };
        assert_eq!(keep(Some(LocalBases { clusters: 12, modes: 70 })), Keep::Every(2), "each learns from its share");
        assert_eq!(keep(None), Keep::Every(9));

        let (_, loads) = study(&format!("{load}, {linearised}, training_loads: [2e5, 3e5]"));
        let trained = loads.training_marches(&march(&loads));
        assert_eq!(march(&loads).keep, Keep::Scalars);
        assert_eq!(trained.iter().map(|t| t.point.load).collect::<Vec<_>>(), [2e5, 3e5]);
        assert!(trained.iter().all(|t| t.inputs == own.inputs && t.keep == Keep::Every(2)));

        let trainings = "trainings: [(inputs: (), duration: 1.0), (name: \"long\", inputs: (), duration: 9.5)]";
        let (_, both) = study(&format!("{load}, {linearised}, training_loads: [2e5, 3e5], {trainings}"));
        let trained = both.training_marches(&march(&both));
        let seen: Vec<_> = trained.iter().map(|t| (t.point.load, t.duration)).collect();
        assert_eq!(seen, [(2e5, 1.0), (2e5, 9.5), (3e5, 1.0), (3e5, 9.5)]);
        assert_eq!((trained[1].keep, trained[1].point.radius_m), (Keep::Every(3), point.radius_m));

        let (_, contacts) = study(&format!("{load}, training_contacts: [(30.0, 9.0), (50.0, 11.0)]"));
        let trained = contacts.training_marches(&march(&contacts));
        for (trained, (m, l)) in trained.iter().zip([(30.0, 9.0), (50.0, 11.0)]) {
            let moes = trained.point.moes();
            assert!((moes.m / m - 1.0).abs() < 1e-12 && (moes.l / l - 1.0).abs() < 1e-12, "{moes:?}");
            assert_eq!((trained.point.radius_m, trained.point.alpha_per_pa), (point.radius_m, point.alpha_per_pa));
        }
    }
}
