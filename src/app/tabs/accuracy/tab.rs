//! Accuracy tab: parts of this contact's error, validation of the model over its whole range, quality of its
//! calibrated bound, and convergence of the last full solve.

use super::random_tests::RandomTests;
use super::{along, failure_map, residuals, split, truth};
use crate::app::context::{Commands, Context};
use crate::app::tabs::{About, Offer, View};

use crate::engine::job::{Background, Standing};
use crate::scene::StudyRow;

use egui::Ui;

/// View of the tab.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
enum Part {
    /// Parts of this contact's error.
    #[default]
    Split,
    /// Random validation in the M–L plane.
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
            Self::Split => "Error contributions",
            Self::FailureMap => "Failure map",
            Self::Truth => "Bound vs. true error",
            Self::Along => "Along the trajectory",
            Self::Residuals => "Newton residuals",
        }
    }
}

/// Accuracy tab: its studies and their results.
#[derive(Default)]
pub struct Accuracy {
    part: Part,
    split: split::Split,
    tests: RandomTests,
    map: failure_map::Map,
    truth: Option<truth::Scatter>,
    along: along::Along,
    /// True if the tab was drawn since the last frame.
    shown: bool,
}

impl Accuracy {
    /// Returns true while a study runs.
    pub fn works(&self) -> bool {
        self.studies().into_iter().any(|work| work.standing().is_some())
    }

    fn studies(&self) -> [&Background<StudyRow>; 3] {
        [&self.tests.work, &self.along.work, &self.split.work]
    }
}

const ABOUT: About = About {
    keywords: "error failure map residuals bound validation trust check",
    page: "trust.md",
    has_units: false,
    why: "A reduced model has errors from its limited number of modes, from its sampled equations and from its grid, \
          and each part can be measured. A full solution on the same grid gives the true error, and a calibrated bound \
          predicts it without a full solution. Random validation over the whole range shows where the model fails, and \
          how often.",
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
                ui.weak(
                    "No reduced model is loaded: every picture is a full solution, and there is no model to validate",
                )
            });
            return;
        };
        match self.part {
            Part::Split => split::ui(ui, &mut self.split, context, &in_use),
            Part::FailureMap => failure_map::ui(ui, (&mut self.map, &mut self.tests), context, commands, &in_use),
            Part::Truth => truth::ui(ui, (&mut self.truth, &mut self.tests), context, &in_use),
            Part::Along => along::ui(ui, &mut self.along, context, &in_use),
            Part::Residuals => {}
        }
    }

    fn offers<'a>(&'a self, context: &Context<'a>) -> Vec<Offer<'a>> {
        let split = self.split.found.as_ref();
        let tests = self.tests.results.as_ref().filter(|results| !results.tests.is_empty());
        let along = self.along.results.as_ref().filter(|results| !results.steps.is_empty());
        let report = context.answers.last_report();
        let tested = "Every contact with its film thicknesses, bound and true errors";
        let followed = "Every contact with both film thicknesses, bound and true error";
        let steps = "Residual and step of every Newton step";
        let parts = "All parts for H_c, H_min and the pressure";
        vec![
            Offer::table("Parts of the error as CSV…", parts, split, |(asked, split)| split::csv(asked, split)),
            Offer::table("Random validation as CSV…", tested, tests, |results| failure_map::csv(results)),
            Offer::table("Trajectory as CSV…", followed, along, |results| along::csv(results)),
            Offer::table("Newton residuals as CSV…", steps, report, |(key, report)| residuals::csv(key, report)),
        ]
    }

    /// Receives results. Stops automatically started studies if the tab is hidden.
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
