//! Curves that stay for comparison.

use super::picture::{Cuts, Picture};

/// Curves that can be pinned at once.
pub const MOST_PINS: usize = 8;

/// A curve that stays for comparison.
pub struct Pin {
    /// Number shown to people.
    pub number: usize,
    /// The curve and its parameters.
    pub picture: Picture,
}

/// All pinned curves, numbered in the order in which they were pinned.
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

    /// Pins a curve, unless there are [`MOST_PINS`].
    pub fn add(&mut self, picture: &Picture) {
        if self.all.len() < MOST_PINS {
            self.pinned += 1;
            self.all.push(Pin { number: self.pinned, picture: picture.clone() });
        }
    }

    /// Removes the curve at a place, if there is one.
    pub fn remove(&mut self, place: usize) {
        if place < self.all.len() {
            self.all.remove(place);
        }
    }

    /// Removes all curves.
    pub fn clear(&mut self) {
        self.all.clear();
    }

    /// Cuts all curves of point contacts elsewhere.
    pub fn cut(&mut self, cuts: Cuts) {
        self.all.iter_mut().for_each(|pin| pin.picture.cut(cuts));
    }
}
