//! What a tab is to the window.

use super::offer::Offer;
use crate::app::context::{Commands, Context};
use crate::engine::job::Standing;
use egui::Ui;
use serde::Serialize;
use serde::de::DeserializeOwned;

/// What never changes about a tab.
pub struct About {
    /// Words that people search for.
    pub keywords: &'static str,
    /// Page of the manual.
    pub page: &'static str,
    /// Its axes can be shown in ratios and in SI units. Those of the other tabs show numbers of the contact, relative
    /// errors, or are in SI units always.
    pub has_units: bool,
    /// What is seen in it and why, in three sentences.
    pub why: &'static str,
}

/// A tab: how it looks, which jobs it runs, what can be exported from it and what the session keeps of it.
pub trait View {
    /// Returns what never changes about it.
    fn about(&self) -> &'static About;

    /// Draws it and asks for changes by commands.
    fn ui(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands);

    /// Returns what can be exported from it.
    fn offers<'a>(&'a self, _: &Context<'a>) -> Vec<Offer<'a>> {
        Vec::new()
    }

    /// Returns the parameters of its plots for the caption of a figure, where they are not those of the contact.
    fn caption(&self, _: &Context<'_>) -> Option<String> {
        None
    }

    /// Receives what its jobs have found since the last frame.
    fn receive(&mut self) {}

    /// Returns the progress of its jobs.
    fn jobs(&self, _: &Context<'_>) -> Vec<Standing> {
        Vec::new()
    }

    /// Stops its jobs; what they have found stays.
    fn stop(&mut self) {}

    /// Returns what the session keeps of it, as text.
    fn kept(&self) -> Option<String> {
        None
    }

    /// Takes over what a session kept; returns false and changes nothing if that makes no sense.
    fn restore(&mut self, _: &str) -> bool {
        true
    }
}

/// Seconds after which a job that follows a dragged slider is shown: before, it comes and goes.
const FOLLOWS_S: f64 = 0.5;

/// Returns the progress of a job that follows a slider, if it lasts.
pub fn lasting(standing: Option<Standing>) -> Option<Standing> {
    standing.filter(|standing| standing.since_s > FOLLOWS_S)
}

/// Returns settings as the session keeps them.
pub fn kept(settings: &impl Serialize) -> Option<String> {
    ron::to_string(settings).ok()
}

/// Takes over settings that a session kept, if they are sound.
pub fn restore<T: DeserializeOwned>(settings: &mut T, text: &str, sound: impl Fn(&T) -> bool) -> bool {
    match ron::from_str::<T>(text) {
        Ok(kept) if sound(&kept) => *settings = kept,
        _ => return false,
    }
    true
}
