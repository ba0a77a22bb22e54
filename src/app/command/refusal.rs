//! What can be done now, and why the rest cannot.

use super::Command;
use crate::app::jobs::JobKind;
use crate::app::picture::Origin;
use crate::app::state::{MOST_PINS, State};
use crate::solver::physics::contact::ContactKind;

const NO_PICTURE: &str = "There is no picture yet";
const RUNS_ALREADY: &str = "It runs already";

impl Command {
    /// Why it cannot be done now, in a few words; `None` where it can.
    pub fn refusal(self, state: &State) -> Option<&'static str> {
        let (refused, why) = match self {
            Self::Undo => (!state.history.can_undo(&state.document), "Nothing has been changed"),
            Self::Redo => (!state.history.can_redo(), "Nothing has been undone"),
            Self::CopyReadouts | Self::ExportProfiles => (state.picture.is_none(), NO_PICTURE),
            Self::Pin if state.picture.is_some() => {
                (state.pins.len() >= MOST_PINS, "As many curves are pinned as can be told apart")
            }
            Self::Pin => (true, NO_PICTURE),
            Self::Unpin => (state.pins.is_empty(), "Nothing is pinned"),
            Self::Overlay | Self::Difference => {
                let full = state.picture.as_ref().is_none_or(|picture| picture.origin == Origin::Full);
                (full, "The picture is the full solution itself")
            }
            Self::EstimateGridError => return grid_error(state),
            Self::SolveAlong => match state.traction.full.standing() {
                Some(_) => (true, RUNS_ALREADY),
                None => (state.sweep().is_none(), "A Newtonian lubricant has no plateau ratio to vary"),
            },
            Self::RunInTime => match state.transient.work.standing() {
                Some(_) => (true, RUNS_ALREADY),
                None => return state.no_transient(),
            },
            Self::Train => match state.training.job() {
                Some(_) => (true, "A training or comparison runs already"),
                None => (state.training.left_behind, "First resume or discard the training that was left unfinished"),
            },
            Self::Cancel => {
                let background = state.training.job().is_some() || state.study().is_some();
                (!background && state.jobs.running().is_empty(), "Nothing runs")
            }
            _ => return None,
        };
        refused.then_some(why)
    }
}

fn grid_error(state: &State) -> Option<&'static str> {
    if state.document.point.kind == ContactKind::Line {
        Some("Only the grid of a point contact is estimated")
    } else if state.jobs.busy(JobKind::Estimate) {
        Some(RUNS_ALREADY)
    } else {
        let there = state.full_is_current() && !state.is_quick();
        (!there).then_some("A full solution on the chosen grid comes first")
    }
}
