//! What can be done now, and why the rest cannot.

use super::Command;
use crate::app::answers::MOST_PINS;
use crate::app::answers::jobs::JobKind;
use crate::app::answers::picture::Origin;
use crate::app::desk::Desk;
use crate::app::traction::sweep;
use crate::solver::physics::contact::ContactKind;

const NO_PICTURE: &str = "There is no picture yet";
const RUNS_ALREADY: &str = "It runs already";

impl Command {
    /// Why it cannot be done now, in a few words; `None` where it can.
    pub fn refusal(&self, desk: &Desk) -> Option<&'static str> {
        let (refused, why) = match self {
            Self::Undo => (!desk.history.can_undo(&desk.document), "Nothing has been changed"),
            Self::Redo => (!desk.history.can_redo(), "Nothing has been undone"),
            Self::CopyReadouts | Self::ExportProfiles => (desk.answers.picture.is_none(), NO_PICTURE),
            Self::Pin if desk.answers.picture.is_some() => {
                (desk.answers.pins.len() >= MOST_PINS, "As many curves are pinned as can be told apart")
            }
            Self::Pin => (true, NO_PICTURE),
            Self::Unpin => (desk.answers.pins.is_empty(), "Nothing is pinned"),
            Self::Overlay | Self::Difference => {
                let full = desk.answers.picture.as_ref().is_none_or(|picture| picture.origin == Origin::Full);
                (full, "The picture is the full solution itself")
            }
            Self::EstimateGridError => return grid_error(desk),
            Self::SolveAlong => match desk.traction.full.standing() {
                Some(_) => (true, RUNS_ALREADY),
                None => (
                    sweep(&desk.document, &desk.answers, &desk.views.traction.choices).is_none(),
                    "A Newtonian lubricant has no plateau ratio to vary",
                ),
            },
            Self::RunInTime => match desk.transient.work.standing() {
                Some(_) => (true, RUNS_ALREADY),
                None => return desk.no_transient(),
            },
            Self::Train => match desk.training.job() {
                Some(_) => (true, "A training or comparison runs already"),
                None => (desk.training.left_behind, "First resume or discard the training that was left unfinished"),
            },
            Self::Cancel => {
                let background = desk.training.job().is_some() || desk.study().is_some();
                (!background && desk.answers.jobs.running().is_empty(), "Nothing runs")
            }
            _ => return None,
        };
        refused.then_some(why)
    }
}

fn grid_error(desk: &Desk) -> Option<&'static str> {
    if desk.document.point.kind == ContactKind::Line {
        Some("Only the grid of a point contact is estimated")
    } else if desk.answers.jobs.busy(JobKind::Estimate) {
        Some(RUNS_ALREADY)
    } else {
        let there = desk.answers.can_estimate();
        (!there).then_some("A full solution on the chosen grid comes first")
    }
}
