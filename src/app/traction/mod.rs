//! Traction and film along one quantity: a curve by the reduced model that follows the other sliders, and full solutions on request.

mod curve;
pub mod export;
mod full;
mod served;
mod sweep;

pub use curve::{Curve, LeftOut};
pub use served::Served;
pub use sweep::{Against, Sample, Sweep, Varied};

use super::desk::Desk;
use super::numbers;
use crate::engine::job::Background;
use crate::solver::full::Solution;
use curve::Worker;
use egui::Context;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Contacts of a curve by the reduced model.
pub const CURVE: usize = 41;
/// Full solutions that are set on it: every fourth of its contacts.
const MARKERS: usize = 11;

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
    wanted: Option<(Sweep, Served)>,
}

impl TractionView {
    /// Takes in what came since the last frame.
    pub fn receive(&mut self) {
        if let Some(curve) = self.worker.as_mut().and_then(Worker::latest) {
            self.curve = Some(curve);
        }
        if let Some(markers) = &mut self.markers {
            self.full.receive(|sample| markers.samples.push(sample));
        }
    }

    /// Whether the curve that is drawn is the one that was asked for last.
    pub fn curve_is_current(&self) -> bool {
        matches!((&self.curve, &self.wanted), (Some(curve), Some((sweep, served)))
            if curve.sweep == *sweep && curve.served == *served)
    }
}

impl Desk {
    /// Asks for the curve of a sweep, unless it has been asked for.
    pub fn follow_sweep(&mut self, ctx: &Context, sweep: &Sweep, served: &Served) {
        let view = &mut self.traction;
        let asked = view.wanted.as_ref().is_some_and(|(wanted, by)| wanted == sweep && by == served);
        if !asked {
            view.wanted = Some((sweep.clone(), served.clone()));
            view.worker.get_or_insert_with(|| Worker::new(&self.answers.store)).ask(ctx, sweep.clone(), served.clone());
        }
    }

    /// Solves contacts of a sweep in full, one from the other: on the grid of the model where one draws the curve, so that both can be compared.
    pub fn start_markers(&mut self, ctx: &Context, sweep: &Sweep, served: &Result<Served, String>) {
        let model = match served {
            Ok(served) => Some(&served.by.model),
            Err(_) => self.model().filter(|_| self.document.chosen_plane().is_none()),
        };
        let model = model.cloned();
        self.traction.markers = Some(Markers { sweep: sweep.clone(), samples: Vec::new() });
        self.traction.full.run(full::start(
            ctx,
            &self.answers.store,
            sweep.clone(),
            model,
            self.document.chosen_plane(),
        ));
    }

    /// Goes to a place on the axis.
    ///
    /// # Errors
    /// A sentence when the contact would be refused; the document is unchanged then.
    pub fn go_along(&mut self, place: f64) -> Result<(), String> {
        let value = numbers::rounded(self.views.traction.against.value(&self.document.point, place), 3);
        match self.views.traction.against.varied() {
            Varied::SlideToRoll => {
                let srr = self.document.point.sliding.slide_to_roll_ratio;
                self.document.set_slide_to_roll_ratio(value.max(0.0).copysign(srr))
            }
            Varied::Plateau => self.document.set_plateau_ratio(Some(value.clamp(0.0, 1.0))),
            Varied::Speed => self.document.set_quantity(super::document::Quantity::Speed, value),
        }
    }
}
