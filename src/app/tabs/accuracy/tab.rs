//! How far results can be believed: where the error of this contact comes from, how the model does over its whole
//! range, what its calibrated bound is worth, and how the last full solve converged.

use super::random_tests::{MOST_COMPARED, RandomTests, TESTS};
use super::{along, failure_map, residuals, split, truth};
use crate::app::context::{Commands, Context};
use crate::app::controls::{either_button, message_ui, named, standing_ui, warning_ui};
use crate::app::in_use::InUse;
use crate::app::tabs::{About, Offer, View};
use crate::app::theme::{Palette, rich};
use crate::engine::Store;
use crate::engine::job::{Background, Standing};
use crate::scene::StudyRow;
use crate::solver::physics::contact::OperatingPoint;
use egui::{DragValue, Ui};

/// A view of the tab.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
enum Part {
    /// The parts of this contact's error.
    #[default]
    Split,
    /// Random tests in the M–L plane.
    FailureMap,
    /// Calibrated bound against true error.
    Truth,
    /// Errors along (3.21).
    Along,
    /// Newton residuals of the last full solve.
    Residuals,
}

impl Part {
    const ALL: [Self; 5] = [Self::Split, Self::FailureMap, Self::Truth, Self::Along, Self::Residuals];

    fn name(self) -> &'static str {
        match self {
            Self::Split => "Where the error comes from",
            Self::FailureMap => "Failure map",
            Self::Truth => "Bound against truth",
            Self::Along => "Along the trajectory",
            Self::Residuals => "Newton residuals",
        }
    }
}

/// The tab's studies and what they found.
#[derive(Default)]
pub struct Accuracy {
    part: Part,
    pub(super) split: split::Split,
    pub(super) tests: RandomTests,
    pub(super) map: failure_map::Map,
    pub(super) truth: Option<truth::Scatter>,
    pub(super) along: along::Along,
    /// Whether the tab was drawn since the last frame.
    shown: bool,
}

impl Accuracy {
    /// Whether a study runs.
    pub fn works(&self) -> bool {
        self.studies().into_iter().any(|work| work.standing().is_some())
    }

    fn studies(&self) -> [&Background<StudyRow>; 3] {
        [&self.tests.work, &self.along.work, &self.split.work]
    }
}

const ABOUT: About = About {
    keywords: "error failure map residuals bound",
    page: "trust.md",
    has_units: false,
    why: "A reduced model errs because its modes are too few, because its equations are met at some places only, \
          and because its grid is coarse: each share can be measured. A full solution on the same grid gives the \
          true error, and a calibrated bound predicts it without one. Random tests over the whole range show where \
          it fails, and how often.",
};

impl View for Accuracy {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn ui(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        self.shown = true;
        ui.horizontal_wrapped(|ui| {
            for part in Part::ALL {
                ui.selectable_value(&mut self.part, part, part.name());
            }
        });
        ui.separator();
        if self.part == Part::Residuals {
            residuals::ui(ui, context);
            return;
        }
        let Some(in_use) = context.answers.in_use(context.document) else {
            ui.centered_and_justified(|ui| {
                ui.weak("No reduced model is loaded: every picture is a full solution, and there is nothing to judge")
            });
            return;
        };
        match self.part {
            Part::Split => split::ui(ui, self, context, &in_use),
            Part::FailureMap => failure_map::ui(ui, self, context, commands, &in_use),
            Part::Truth => truth::ui(ui, self, context, &in_use),
            Part::Along => along::ui(ui, self, context, &in_use),
            Part::Residuals => {}
        }
    }

    fn offers<'a>(&'a self, context: &Context<'a>) -> Vec<Offer<'a>> {
        let split = self.split.found.as_ref();
        let tests = self.tests.results.as_ref().filter(|results| !results.tests.is_empty());
        let along = self.along.results.as_ref().filter(|results| !results.steps.is_empty());
        let report = context.answers.last_report.as_ref();
        let tested = "Every test with its contact, films, bound and true errors";
        let followed = "Every contact with both films, bound and true error";
        let steps = "Residual and step of every Newton step";
        let parts = "All parts for H_c, H_min and the pressure";
        vec![
            Offer::table("Parts of the error as CSV…", parts, split, |(asked, split)| split::csv(asked, split)),
            Offer::table("Random tests as CSV…", tested, tests, |results| failure_map::csv(results)),
            Offer::table("Trajectory as CSV…", followed, along, |results| along::csv(results)),
            Offer::table("Newton residuals as CSV…", steps, report, |(key, report)| residuals::csv(key, report)),
        ]
    }

    /// Studies that nobody asked for stop where nobody looks.
    fn receive(&mut self) {
        if !std::mem::take(&mut self.shown) {
            self.split.hide();
            self.tests.hide();
            self.along.hide();
        }
        self.split.receive();
        self.tests.receive();
        self.along.receive();
    }

    fn jobs(&self, _: &Context<'_>) -> Vec<Standing> {
        self.studies().into_iter().filter_map(Background::standing).collect()
    }

    fn stop(&mut self) {
        self.studies().into_iter().for_each(Background::stop);
    }
}

/// A number to choose with its name before it.
pub fn count(ui: &mut Ui, name: &str, tip: &str, value: &mut usize, range: std::ops::RangeInclusive<usize>) {
    ui.label(name).on_hover_text(tip);
    let response = ui.add(DragValue::new(value).range(range).speed(10.0));
    named(ui, response, name).on_hover_text(tip);
}

/// Run, or Stop while it runs. Returns whether a run is wanted.
pub fn run_or_stop(ui: &mut Ui, run: &str, tip: &str, work: &Background<StudyRow>) -> bool {
    let runs = work.job().is_some();
    let tip = if runs { "What has been found so far stays (Esc)" } else { tip };
    let clicked = either_button(ui, [run, "Stop"], runs).on_hover_text(tip).clicked();
    if clicked && runs {
        work.stop();
    }
    clicked && !runs
}

/// The row over both views of the random tests.
pub fn tests_toolbar(ui: &mut Ui, store: &Store, tests: &mut RandomTests, in_use: &InUse) {
    tests.show(&ui.ctx().clone(), store, in_use);
    ui.horizontal_wrapped(|ui| {
        let wanted = &mut tests.wanted;
        let tip = "Reduced solves at random contacts (3.17) of the range the model was trained for";
        count(ui, "Random tests", tip, &mut wanted.tests, TESTS);
        let tip = "How many of them are compared with full solutions on the model’s own grid; up to 20 that look worst come \
                   first, beside them";
        count(ui, "Compared in full", tip, &mut wanted.compared, 0..=MOST_COMPARED);
        let tip = "The same seed gives the same contacts";
        ui.label("Seed").on_hover_text(tip);
        let seed = ui.add(DragValue::new(&mut wanted.seed));
        named(ui, seed, "Seed").on_hover_text(tip);
        if run_or_stop(ui, "Run tests", "Tests the model as it is truncated now", &tests.work) {
            tests.start(&ui.ctx().clone(), store, in_use);
        }
        standing_ui(ui, tests.work.standing(), "Progress of the random tests");
    });
    if let Some(message) = &tests.work.message {
        message_ui(ui, message);
    }
    if let Some(results) = tests.results.as_ref().filter(|r| r.in_use != *in_use) {
        stale_note(ui, &results.in_use);
    }
}

/// Says that what is shown was made with another model or truncation.
pub fn stale_note(ui: &mut Ui, of: &InUse) {
    warning_ui(ui, &format!("Found with {}; the model or its truncation has changed since", of.describe()));
}

/// Says why there are no bounds, where there are none.
pub fn bound_note(ui: &mut Ui, mut bounds: impl Iterator<Item = Option<f64>>) {
    if !bounds.any(|bound| bound.is_some()) {
        let note = "No calibrated bounds: the model is truncated, or its training measured no errors";
        ui.label(rich(note, 11.0, Palette::of(ui).quiet));
    }
}

/// Columns that say which contact a row of an exported table is.
pub const CONTACT_COLUMNS: [&str; 8] =
    ["M", "L", "R_m", "u_m_m_per_s", "w_n_per_m", "E_pa", "eta_0_pa_s", "alpha_per_pa"];

/// The values of [`CONTACT_COLUMNS`].
pub fn contact_cells(point: &OperatingPoint) -> [f64; 8] {
    let (moes, [r, u, w, e, eta, alpha]) = (point.moes(), point.quantities());
    [moes.m, moes.l, r, u, w, e, eta, alpha]
}

/// Says why there is nothing yet.
pub fn nothing_yet(ui: &mut Ui, text: &str) {
    ui.centered_and_justified(|ui| ui.weak(text));
}
