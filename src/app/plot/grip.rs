//! Dragging of an object in a plot: a line, or the contact itself.

use egui::{Id, Pos2, Ui};

/// Object that can be dragged.
#[derive(Clone, Copy)]
pub struct Grip(Id);

impl Grip {
    /// Creates the object with this name in one plot.
    pub fn new(plot: &str, name: &str) -> Self {
        Self(Id::unique(("grip", plot.to_owned(), name.to_owned())))
    }

    /// Returns true while the user drags the object. The plot itself must then not move.
    pub fn is_held(self, ui: &Ui) -> bool {
        ui.data(|data| data.get_temp(self.0).unwrap_or(false))
    }

    /// Returns the position of the pointer while the user drags the object. `near` states whether the pointer can
    /// grab it.
    pub fn follow(self, ui: &Ui, near: bool) -> Option<Pos2> {
        let mut held = self.is_held(ui);
        // Grabbing starts before the drag, so that the plot itself does not move.
        if ui.input(|i| i.pointer.primary_pressed()) {
            held = near;
        }
        held &= ui.input(|i| i.pointer.primary_down());
        ui.data_mut(|data| data.insert_temp(self.0, held));
        let pointer = ui.input(|i| i.pointer.latest_pos()).filter(|_| held)?;
        let origin = ui.input(|i| i.pointer.press_origin())?;
        (origin.distance(pointer) > 1.0).then_some(pointer)
    }
}
