//! Traction and film thickness along one quantity: a curve by the reduced model and full solutions.

use super::curve::Curve;
use super::served::{self, Served};
use super::sweep::{Against, Sample, Sweep, Varied};

use super::curve::LiveCurve;
use crate::app::answers::Answers;
use crate::app::document::{Document, Edit};
use crate::app::numbers;
use crate::app::wake::wake;
use crate::engine::job::{Background, Standing};
use crate::engine::{Store, Workbench};
use crate::scene::{Grid, Method, StudyRow};
use egui::Context;
use serde::{Deserialize, Serialize};

/// Number of contacts of a curve by the reduced model.
pub const CURVE: usize = 41;
/// Number of contacts of a Stribeck curve: eight per decade of speed, and more for a reduced model.
pub const STRIBECK: usize = 57;
pub const REDUCED_STRIBECK: usize = 101;
/// Number of full solutions on the curve: every fourth of its contacts, every tenth of a Stribeck curve's.
const MARKERS: usize = 11;
/// Number of full solutions that form the curve of a line contact without a reduced model.
const FULL_CURVE: usize = 21;

/// Full solutions along a sweep.
pub struct Markers {
    pub sweep: Sweep,
    /// Contacts solved so far.
    pub samples: Vec<Sample>,
    /// Contacts of the companion.
    companions: Vec<Sample>,
    /// Number of requested contacts.
    wanted: usize,
    /// Number of contacts without convergence. They are omitted.
    failed: usize,
    /// True if they started automatically. They stop when another sweep is shown.
    by_themselves: bool,
}

/// Displayed part of an axis of SRR.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum SlideView {
    /// 0 to 10 %, where traction rises.
    #[default]
    Near,
    Whole,
    /// The whole range on a logarithmic axis.
    Logarithmic,
}

impl SlideView {
    /// All views with their names and tooltips.
    pub const ALL: [(Self, &'static str, &'static str); 3] = [
        (Self::Near, "0–10 %", "Where traction rises"),
        (Self::Whole, "0–100 %", "The whole range of the curve"),
        (Self::Logarithmic, "Log", "The whole range on a logarithmic axis"),
    ];
}

/// Settings of the tab. They are not part of the document.
#[derive(Clone, Copy, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Choices {
    /// Quantity on the horizontal axis.
    pub against: Against,
    /// Logarithmic axes: horizontal if it is not SRR, and vertical.
    pub logarithmic: (bool, bool),
    /// Displayed part of an axis of SRR.
    pub slide: SlideView,
    /// True if the laws of the fluid are shown instead of the traction.
    pub shows_fluid: bool,
}

impl Choices {
    /// Returns true if the horizontal axis is logarithmic.
    pub fn logarithmic_along(&self) -> bool {
        match self.against {
            Against::SlideToRoll => self.slide == SlideView::Logarithmic,
            _ => self.logarithmic.0,
        }
    }
}

/// Curve and full solutions of the tab.
#[derive(Default)]
pub struct Sweeps {
    /// Last curve by the reduced model.
    pub curve: Option<Curve>,
    /// Full solutions.
    pub markers: Option<Markers>,
    /// Job of the full solutions.
    pub full: Background<StudyRow>,
    beside: Background<StudyRow>,
    live: LiveCurve,
    wanted: Option<(Sweep, Served)>,
}

impl Sweeps {
    /// Receives the results since the last frame.
    pub fn receive(&mut self) {
        if let Some(curve) = self.live.finished() {
            self.curve = Some(curve);
        }
        let Some(markers) = &mut self.markers else { return };
        let works = self.full.job().is_some();
        self.full.receive(|row| match Sample::of_row(&row, &markers.sweep) {
            Some(sample) => markers.samples.push(sample),
            None => markers.failed += 1,
        });
        self.beside.receive(|row| markers.companions.extend(Sample::of_row(&row, &markers.sweep)));
        // A companion that fails is omitted.
        self.beside.message = None;
        markers.sweep.note_companions(&mut markers.samples, &markers.companions);
        let (failed, wanted) = (markers.failed, markers.wanted);
        if works && self.full.job().is_none() && failed > 0 {
            let why = || format!("{failed} of {wanted} full solutions did not converge and are left out");
            self.full.message.get_or_insert_with(why);
        }
    }

    /// Returns true if the curve is the one requested last.
    pub fn curve_is_current(&self) -> bool {
        matches!((&self.curve, &self.wanted), (Some(curve), Some((sweep, served)))
            if curve.sweep == *sweep && curve.served == *served)
    }
}

impl Sweeps {
    /// Returns true if the curve of a sweep has been requested.
    pub fn is_asked(&self, sweep: &Sweep, served: &Served) -> bool {
        self.wanted.as_ref().is_some_and(|(wanted, by)| wanted == sweep && by == served)
    }

    /// Requests the curve of a sweep, unless it has been requested already.
    pub fn follow(&mut self, ctx: &Context, store: &Store, sweep: Sweep, served: Served) {
        if !self.is_asked(&sweep, &served) {
            self.wanted = Some((sweep.clone(), served.clone()));
            self.live.ask(ctx, store, sweep, served);
        }
    }

    /// Returns true if full solutions of a sweep were started.
    pub fn has_markers_of(&self, sweep: &Sweep) -> bool {
        self.markers.as_ref().is_some_and(|markers| markers.sweep == *sweep)
    }

    /// Returns true if automatically started full solutions of another sweep are running.
    pub fn fills_another(&self, sweep: &Sweep) -> bool {
        let another = |markers: &Markers| markers.by_themselves && markers.sweep != *sweep;
        self.full.job().is_some_and(|job| !job.stopping()) && self.markers.as_ref().is_some_and(another)
    }

    /// Returns the progress of the curve.
    pub fn following(&self) -> Option<Standing> {
        self.live.standing()
    }

    /// Stops the full solutions and keeps those computed so far.
    pub fn stop_markers(&self) {
        self.full.stop();
        self.beside.stop();
    }

    /// Starts full solutions of the sweep through the document's contact, each from its neighbour. If a model
    /// computes the curve, they use its grid, so that both are comparable.
    pub fn start_markers(
        &mut self,
        ctx: &Context,
        document: &Document,
        answers: &Answers,
        choices: &Choices,
        by_themselves: bool,
    ) {
        let Some((sweep, served)) = served::sweep(document, answers, choices) else { return };
        let plane = document.chosen_plane();
        let model = match &served {
            Ok(served) => served.by.as_ref().map(|by| &by.model),
            Err(_) => answers.model(document).filter(|_| plane.is_none()),
        };
        let grid = match (model, plane) {
            (Some(_), _) => Grid::Model,
            (None, Some(plane)) => Grid::Plane(plane),
            (None, None) => Grid::Graded,
        };
        let ask = |title: &str, sweep: &Sweep, count: usize| {
            let bench = Workbench::on(answers.store(), "");
            let bench = if let Some(model) = model { bench.using(model) } else { bench };
            sweep.question(title, grid, count, Method::Full).ask(bench, wake(ctx))
        };
        let wanted = if served.is_err() && plane.is_none() { FULL_CURVE } else { MARKERS };
        let part = served.as_ref().map_or_else(|_| sweep.clone(), |served| served.part_of(&sweep));
        self.full.run(ask("Full solutions along the curve", &part, wanted));
        self.beside = Background::default();
        if let Some((companion, by)) = sweep.accompanied().filter(|_| served.is_err()) {
            self.beside.run(ask(companion.title(), &by, sweep.companions(wanted)));
        }
        let (samples, companions) = (Vec::new(), Vec::new());
        self.markers = Some(Markers { sweep, samples, companions, wanted, failed: 0, by_themselves });
    }
}

/// Returns the edit that moves the contact to a position on the axis of the curve.
pub fn edit_along(document: &Document, choices: &Choices, place: f64) -> Edit {
    let value = numbers::rounded(choices.against.value(&document.point, place), 3);
    let varied = choices.against.varied();
    let value = match varied {
        Varied::SlideToRoll => value.max(0.0).copysign(document.point.sliding.slide_to_roll_ratio),
        Varied::Plateau => value.clamp(0.0, 1.0),
        _ => value,
    };
    Edit::Quantity(varied.quantity(), value)
}
