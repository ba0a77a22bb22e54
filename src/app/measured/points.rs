//! Points of the measured tables of the document, read once per change.

use crate::scene::{MeasuredPoint, MeasuredTable, measured_points};

/// Points of the measured tables of a document.
#[derive(Default)]
pub struct MeasuredPoints {
    of: Vec<MeasuredTable>,
    points: Vec<MeasuredPoint>,
}

impl MeasuredPoints {
    /// Reads the tables if they have changed. Tables of a document are valid.
    pub fn follow(&mut self, tables: &[MeasuredTable]) {
        if self.of != tables {
            self.of = tables.to_vec();
            self.points = tables.iter().filter_map(|table| measured_points(&table.text).ok()).flatten().collect();
        }
    }

    /// Returns the points of all tables.
    pub fn all(&self) -> &[MeasuredPoint] {
        &self.points
    }
}
