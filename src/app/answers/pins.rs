//! Pinned curves, which stay on the screen for comparison.

use super::picture::{Cuts, Picture};
use crate::app::document::Key;

/// Maximum number of pinned curves.
pub const MOST_PINS: usize = 8;

/// Pinned curve.
pub struct Pin {
    /// Number that the screen shows.
    pub number: usize,
    /// Curve and its parameters.
    pub picture: Picture,
}

/// All pinned curves, numbered in the order of pinning.
#[derive(Default)]
pub struct Pins {
    all: Vec<Pin>,
    pinned: usize,
}

impl Pins {
    /// Returns the curves, the oldest first.
    pub fn all(&self) -> &[Pin] {
        &self.all
    }

    /// Pins a curve. Does nothing if there are [`MOST_PINS`] already.
    pub fn add(&mut self, picture: &Picture) {
        if self.all.len() < MOST_PINS {
            self.pinned += 1;
            self.all.push(Pin { number: self.pinned, picture: picture.clone() });
        }
    }

    /// Replaces the last pinned curve. Returns the contact of the former one.
    pub fn swap(&mut self, picture: &Picture) -> Option<Key> {
        let last = self.all.last_mut()?;
        Some(std::mem::replace(&mut last.picture, picture.clone()).key)
    }

    /// Removes the curve at an index, if there is one.
    pub fn remove(&mut self, place: usize) {
        if place < self.all.len() {
            self.all.remove(place);
        }
    }

    /// Removes all curves.
    pub fn clear(&mut self) {
        self.all.clear();
    }

    /// Moves the cuts of all curves of point contacts.
    pub fn cut(&mut self, cuts: Cuts) {
        self.all.iter_mut().for_each(|pin| pin.picture.cut(cuts));
    }
}
