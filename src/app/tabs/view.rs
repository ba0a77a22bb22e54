//! Interface of a tab to the window.

use super::offer::Offer;
use crate::app::context::{Commands, Context};
use crate::engine::job::Standing;
use egui::Ui;
use serde::Serialize;
use serde::de::DeserializeOwned;

/// Constant properties of a tab.
pub struct About {
    /// Keywords for the search.
    pub keywords: &'static str,
    /// Page of the manual.
    pub page: &'static str,
    /// True if its axes can be shown in dimensionless and SI units. The axes of other tabs show numbers of the
    /// contact or relative errors, or they are always in SI units.
    pub has_units: bool,
    /// Explanation of its content in three sentences, for any contact.
    pub why: &'static str,
}

/// Tab: its drawing, its jobs, its exports, and its settings for the session.
pub trait View {
    /// Returns its constant properties.
    fn about(&self) -> &'static About;

    /// Returns the explanation of its content in three sentences, for the present contact.
    fn why(&self, _: &Context<'_>) -> String {
        self.about().why.to_owned()
    }

    /// Draws the tab and adds commands.
    fn ui(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands);

    /// Returns its exports.
    fn offers<'a>(&'a self, _: &Context<'a>) -> Vec<Offer<'a>> {
        Vec::new()
    }

    /// Returns the parameters of its plots for the caption of a figure, if they are not those of the contact.
    fn caption(&self, _: &Context<'_>) -> Option<String> {
        None
    }

    /// Receives results of its jobs since the last frame.
    fn receive(&mut self) {}

    /// Returns the progress of its jobs.
    fn jobs(&self, _: &Context<'_>) -> Vec<Standing> {
        Vec::new()
    }

    /// Stops its jobs and keeps their results so far.
    fn stop(&mut self) {}

    /// Returns its settings as text, for the session.
    fn kept(&self) -> Option<String> {
        None
    }

    /// Restores its settings. Returns false and changes nothing if the text is invalid.
    fn restore(&mut self, _: &str) -> bool {
        true
    }
}

/// Age from which a job that follows a dragged slider is shown \[s\]. Shorter jobs would only flicker.
const FOLLOWS_S: f64 = 0.5;

/// Returns the progress of a job that follows a slider if it runs longer.
pub fn lasting(standing: Option<Standing>) -> Option<Standing> {
    standing.filter(|standing| standing.since_s > FOLLOWS_S)
}

/// Returns settings as text for the session.
pub fn kept(settings: &impl Serialize) -> Option<String> {
    ron::to_string(settings).ok()
}

/// Restores settings of a session if they are valid.
pub fn restore<T: DeserializeOwned>(settings: &mut T, text: &str, sound: impl Fn(&T) -> bool) -> bool {
    match ron::from_str::<T>(text) {
        Ok(kept) if sound(&kept) => *settings = kept,
        _ => return false,
    }
    true
}
