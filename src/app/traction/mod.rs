//! Traction and film along one quantity: a curve by the reduced model that follows the other sliders, and full solutions on request.

mod curve;
pub mod export;
mod full;
mod sweep;

pub use curve::Curve;
pub use sweep::{Against, Sample, Sweep, Varied};

use super::in_use::InUse;
use super::jobs::Key;
use super::numbers;
use super::state::State;
use super::task::Background;
use crate::solver::full::{Problem, Solution};
use crate::solver::lubricant::ShearLaw;
use crate::solver::reduced::Trust;
use curve::Worker;
use egui::Context;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Contacts of a curve by the reduced model.
pub const CURVE: usize = 41;
/// Full solutions that are set on it: every fourth of its contacts.
const MARKERS: usize = 11;
/// What a logarithmic axis of SRR begins with, as a share of its end.
const LOG_SRR: f64 = 5e-3;
/// What a logarithmic axis of NPR begins with at least.
const LOG_NPR: f64 = 1e-2;

/// Full solutions along a sweep.
pub struct Markers {
    /// The sweep.
    pub sweep: Sweep,
    /// What has been solved so far.
    pub samples: Vec<Sample>,
}

/// How the tab shows it; not part of the document.
#[derive(Clone, Copy, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Choices {
    /// What the curves are drawn against.
    pub against: Against,
    /// Logarithmic axes: along, and of traction and film.
    pub logarithmic: (bool, bool),
    /// Whether the laws of the fluid are shown in place of the traction.
    pub shows_fluid: bool,
    /// Whether the note for teaching is shown.
    pub why: bool,
}

/// What the tab knows.
#[derive(Default)]
pub struct TractionView {
    /// The last curve by the reduced model.
    pub curve: Option<Curve>,
    /// Full solutions.
    pub markers: Option<Markers>,
    /// Their work.
    pub full: Background<Sample>,
    /// The largest shear stress of a solution.
    pub stress_met: Option<(Arc<Solution>, f64)>,
    worker: Option<Worker>,
    wanted: Option<(Sweep, InUse)>,
}

impl TractionView {
    /// Takes in what came since the last frame.
    pub fn receive(&mut self) {
        if let Some(curve) = self.worker.as_ref().and_then(Worker::latest) {
            self.curve = Some(curve);
        }
        if let Some(markers) = &mut self.markers {
            self.full.receive(|sample| markers.samples.push(sample));
        }
    }

    /// Whether the curve that is drawn is the one that was asked for last.
    pub fn curve_is_current(&self) -> bool {
        matches!((&self.curve, &self.wanted), (Some(curve), Some((sweep, in_use)))
            if curve.sweep == *sweep && curve.in_use == *in_use)
    }
}

impl State {
    /// The sweep through the contact of the sliders, and the reduced model that serves all of it or why none does. `None` where the fluid does
    /// not answer to the quantity.
    pub fn sweep(&self) -> Option<(Sweep, Result<InUse, String>)> {
        let varied = self.display.traction.against.varied();
        let key = self.key();
        let mut point = key.point;
        point.sliding.slide_to_roll_ratio = point.sliding.slide_to_roll_ratio.abs();
        if varied == Varied::Plateau && key.lubricant.shear == ShearLaw::Newtonian {
            return None;
        }
        let (ends, served) = match self.in_use() {
            None => (varied.everywhere(&point), Err("there is no reduced model of this contact".to_owned())),
            Some(in_use) => match varied.trained(&in_use.model.domain, &point) {
                Some(ends) => match outside(&in_use, &key, varied, ends) {
                    None => (ends, Ok(in_use)),
                    Some(why) => (ends, Err(why)),
                },
                None => (varied.everywhere(&point), Err("the reduced model was trained for no such speed".to_owned())),
            },
        };
        let logarithmic = self.display.traction.logarithmic.0;
        let ends = match varied {
            Varied::SlideToRoll if logarithmic => (ends.0.max(LOG_SRR * ends.1), ends.1),
            Varied::Plateau if logarithmic => (ends.0.max(LOG_NPR), ends.1),
            _ => ends,
        };
        let base = Key { point: varied.at(&point, ends.0), lubricant: key.lubricant };
        Some((Sweep { varied, base, ends, logarithmic }, served))
    }

    /// Asks for the curve of a sweep, unless it has been asked for.
    pub fn follow_sweep(&mut self, ctx: &Context, sweep: &Sweep, in_use: &InUse) {
        let view = &mut self.traction;
        let asked = view.wanted.as_ref().is_some_and(|(wanted, by)| wanted == sweep && by == in_use);
        if !asked {
            view.wanted = Some((sweep.clone(), in_use.clone()));
            view.worker.get_or_insert_with(Worker::default).ask(ctx, sweep.clone(), in_use.clone());
        }
    }

    /// Solves contacts of a sweep in full, one from the other.
    pub fn start_markers(&mut self, ctx: &Context, sweep: &Sweep) {
        let serves = self.passed_over.is_none() || self.plane().is_none();
        let model = self.model().filter(|_| serves).cloned();
        self.traction.markers = Some(Markers { sweep: sweep.clone(), samples: Vec::new() });
        self.traction.full.run(full::start(ctx, sweep.clone(), model, self.plane()));
    }

    /// Goes to a place on the axis.
    ///
    /// # Errors
    /// A sentence when the contact would be refused; the document is unchanged then.
    pub fn go_along(&mut self, place: f64) -> Result<(), String> {
        let value = numbers::rounded(self.display.traction.against.value(&self.document.point, place), 3);
        match self.display.traction.against.varied() {
            Varied::SlideToRoll => {
                let srr = self.document.point.sliding.slide_to_roll_ratio;
                self.document.set_slide_to_roll_ratio(value.max(0.0).copysign(srr))
            }
            Varied::Plateau => self.document.set_plateau_ratio(Some(value.clamp(0.0, 1.0))),
            Varied::Speed => self.document.set_quantity(super::document::Quantity::Speed, value),
        }
    }
}

/// Why a model does not serve a sweep, where it does not.
fn outside(in_use: &InUse, key: &Key, varied: Varied, ends: (f64, f64)) -> Option<String> {
    [ends.0, ends.1].into_iter().find_map(|value| {
        let problem = Problem::new(&varied.at(&key.point, value), key.lubricant);
        match problem.map(|problem| in_use.model.trust(&problem)) {
            Ok(Trust::Trained) => None,
            Ok(Trust::Outside(why)) => Some(why),
            Err(refused) => Some(refused.to_string()),
        }
    })
}
