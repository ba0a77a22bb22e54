//! Traction and film along one quantity: a curve by the reduced model that follows the other sliders, and full solutions on request.

mod curve;
pub mod export;
mod served;
mod sweep;

pub use curve::Curve;
pub use served::{Served, sweep};
pub use sweep::{Against, Sample, Sweep, Varied};

use super::answers::Answers;
use super::answers::jobs::wake;
use super::document::{Document, Edit};
use super::numbers;
use crate::engine::job::Background;
use crate::engine::{Store, Workbench};
use crate::scene::{Grid, Method, StudyRow};
use crate::solver::physics::contact::Quantity;
use curve::LiveCurve;
use egui::Context;
use serde::{Deserialize, Serialize};

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
    /// Contacts that are left out: the solver did not converge.
    failed: usize,
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
    pub full: Background<StudyRow>,
    live: LiveCurve,
    wanted: Option<(Sweep, Served)>,
}

impl TractionView {
    /// Takes in what came since the last frame.
    pub fn receive(&mut self) {
        if let Some(curve) = self.live.finished() {
            self.curve = Some(curve);
        }
        let Some(markers) = &mut self.markers else { return };
        let works = self.full.job().is_some();
        self.full.receive(|row| {
            if let StudyRow::Sweep(row) = row {
                match Sample::of(&row) {
                    Some(sample) => markers.samples.push(sample),
                    None => markers.failed += 1,
                }
            }
        });
        let failed = markers.failed;
        if works && self.full.job().is_none() && failed > 0 {
            let why = || format!("{failed} of {MARKERS} full solutions did not converge and are left out");
            self.full.message.get_or_insert_with(why);
        }
    }

    /// Whether the curve that is drawn is the one that was asked for last.
    pub fn curve_is_current(&self) -> bool {
        matches!((&self.curve, &self.wanted), (Some(curve), Some((sweep, served)))
            if curve.sweep == *sweep && curve.served == *served)
    }
}

impl TractionView {
    /// Whether the curve of a sweep has been asked for.
    pub fn is_asked(&self, sweep: &Sweep, served: &Served) -> bool {
        self.wanted.as_ref().is_some_and(|(wanted, by)| wanted == sweep && by == served)
    }

    /// Asks for the curve of a sweep, unless it has been asked for.
    pub fn follow(&mut self, ctx: &Context, store: &Store, sweep: Sweep, served: Served) {
        if !self.is_asked(&sweep, &served) {
            self.wanted = Some((sweep.clone(), served.clone()));
            self.live.ask(ctx, store, sweep, served);
        }
    }

    /// Solves contacts of the sweep through a document's contact in full, one from the other: on the grid of the model where one draws the
    /// curve, so that both can be compared.
    pub fn start_markers(&mut self, ctx: &Context, document: &Document, answers: &Answers, choices: &Choices) {
        let Some((sweep, served)) = served::sweep(document, answers, choices) else { return };
        let plane = document.chosen_plane();
        let model = match &served {
            Ok(served) => Some(&served.by.model),
            Err(_) => answers.model(document).filter(|_| plane.is_none()),
        };
        let grid = match (model, plane) {
            (Some(_), _) => Grid::Model,
            (None, Some(plane)) => Grid::Plane(plane),
            (None, None) => Grid::Graded,
        };
        let bench = Workbench::on(&answers.store, "");
        let bench = if let Some(model) = model { bench.using(model) } else { bench };
        let question = sweep.question("Full solutions along the curve", grid, MARKERS, Method::Full);
        self.full.run(question.ask(bench, wake(ctx)));
        self.markers = Some(Markers { sweep, samples: Vec::new(), failed: 0 });
    }
}

/// What goes to a place on the axis of the curve.
pub fn edit_along(document: &Document, choices: &Choices, place: f64) -> Edit {
    let value = numbers::rounded(choices.against.value(&document.point, place), 3);
    match choices.against.varied() {
        Varied::SlideToRoll => {
            let srr = value.max(0.0).copysign(document.point.sliding.slide_to_roll_ratio);
            Edit::Quantity(Quantity::SlideToRollRatio, srr)
        }
        Varied::Plateau => Edit::Quantity(Quantity::NewtonianPlateauRatio, value.clamp(0.0, 1.0)),
        Varied::Speed => Edit::Quantity(Quantity::Speed, value),
    }
}
