//! Availability of commands, and the reasons why a command is not available.

use super::workspace::Desk;
use crate::app::animations::loads;
use crate::app::answers::MOST_PINS;
use crate::app::answers::jobs::JobKind;
use crate::app::answers::picture::Origin;
use crate::app::command::Command;
use crate::app::tabs::traction::sweep;
use crate::app::units::Units;

const NO_PICTURE: &str = "There is no picture yet";
const RUNS_ALREADY: &str = "It is already running";

impl Desk {
    /// Returns whether the option that a command switches is on. `None` for commands that switch nothing.
    pub fn state(&self, command: &Command) -> Option<bool> {
        let (profiles, theme) = (&self.tabs.profiles.choices, self.display.theme);
        match command {
            Command::Overlay => Some(profiles.overlay),
            Command::Difference => Some(profiles.difference),
            Command::ShowWhy => Some(self.display.why),
            Command::SwitchUnits => Some(self.display.units == Units::Dimensional),
            Command::System(wanted) => Some(self.display.system == *wanted),
            Command::LockAxes => Some(!self.locked.is_empty()),
            Command::Presentation => Some(self.presentation.is_some()),
            Command::Theme(wanted) => Some(theme == *wanted),
            _ => None,
        }
    }

    /// Returns a short reason why a command is not available. `None` if it is available.
    pub fn refusal(&self, command: &Command) -> Option<&'static str> {
        let (refused, why) = match command {
            Command::Undo => (!self.history.can_undo(&self.document), "Nothing has been changed"),
            Command::Redo => (!self.history.can_redo(), "Nothing has been undone"),
            Command::CopyReadouts | Command::ExportProfiles => (self.answers.picture().is_none(), NO_PICTURE),
            Command::Pin if self.answers.picture().is_some() => {
                (self.answers.pins().len() >= MOST_PINS, "The maximum number of curves is pinned")
            }
            Command::Pin => (true, NO_PICTURE),
            Command::SwapPin if self.answers.picture().is_none() => (true, NO_PICTURE),
            Command::SwapPin | Command::Unpin => (self.answers.pins().is_empty(), "Nothing is pinned"),
            Command::AnimateRun => (self.transient.animated().is_none(), "There is no full transient run yet"),
            Command::AnimateLoad => {
                (loads(&self.document, &self.answers).is_none(), "The reduced model does not cover this contact")
            }
            Command::Overlay | Command::Difference => {
                let full = self.answers.picture().is_none_or(|picture| picture.origin == Origin::Full);
                (full, "The picture is the full solution itself")
            }
            Command::EstimateGridError => return grid_error(self),
            Command::SolveAlong => match self.tabs.traction.sweeps.full.standing() {
                Some(_) => (true, RUNS_ALREADY),
                None => (
                    sweep(&self.document, &self.answers, &self.tabs.traction.choices).is_none(),
                    "A Newtonian lubricant has no plateau ratio to vary",
                ),
            },
            Command::RunInTime => match self.transient.standing() {
                Some(_) => (true, RUNS_ALREADY),
                None => return self.document.no_transient(),
            },
            Command::Train => match self.tabs.training.work.standing() {
                Some(_) => (true, "A training or comparison is already running"),
                None => (self.tabs.training.work.left_behind, "First resume or discard the unfinished training"),
            },
            Command::Cancel => (self.works().is_empty() && self.answers.running().is_empty(), "Nothing runs"),
            _ => return None,
        };
        refused.then_some(why)
    }
}

fn grid_error(desk: &Desk) -> Option<&'static str> {
    if desk.document.point.kind.is_line() {
        Some("The grid error is estimated for point contacts only")
    } else if desk.answers.runs(JobKind::Estimate) {
        Some(RUNS_ALREADY)
    } else {
        let there = desk.answers.can_estimate();
        (!there).then_some("A full solution on the chosen grid comes first")
    }
}
