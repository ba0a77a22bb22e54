//! Display settings in the session file.

use super::place::within;
use crate::app::desk::Desk;
use crate::app::display::Display;
use crate::app::figure::FigureSettings;
use crate::app::presentation::Presentation;
use crate::app::reports::ReportSettings;
use crate::app::tab::Tab;
use crate::app::tabs::all::Tabs;
use serde::{Deserialize, Serialize};

/// Maximum number of finished lessons in a session.
const MOST_FINISHED: usize = 1000;

/// Display settings in the session file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Shown {
    #[serde(flatten)]
    display: Display,
    figures: FigureSettings,
    reports: ReportSettings,
    /// Settings of the tabs as text.
    tabs: Vec<(Tab, String)>,
    /// Titles of the lessons that were finished.
    finished: Vec<String>,
    /// Tabs whose axes are locked.
    locked: Vec<Tab>,
}

impl Shown {
    /// Returns the present display settings.
    pub fn of(desk: &Desk) -> Self {
        Self {
            display: desk.display,
            figures: desk.figures.settings,
            reports: desk.reports.settings.clone(),
            tabs: desk.tabs.kept(),
            finished: desk.finished.clone(),
            locked: desk.presentation.as_ref().map_or(&desk.locked, Presentation::locked_before).clone(),
        }
    }

    pub fn restore(self, desk: &mut Desk) {
        desk.tabs.restore(&self.tabs);
        desk.display = self.display;
        desk.finished = self.finished;
        desk.reports.settings = self.reports;
        (desk.figures.settings, desk.locked) = (self.figures, self.locked);
    }

    /// Returns true if all settings are valid.
    pub fn is_sound(&self) -> bool {
        let Display { cuts, zoom, thresholds, .. } = self.display;
        thresholds.check().is_ok()
            && within(zoom, Display::ZOOMS)
            && cuts.x.is_finite()
            && cuts.y.is_finite()
            && Tabs::default().restore(&self.tabs)
            && self.figures.is_sound()
            && self.reports.is_sound()
            && self.finished.len() <= MOST_FINISHED
            && Tab::ALL.iter().all(|tab| self.locked.iter().filter(|locked| *locked == tab).count() <= 1)
    }
}
