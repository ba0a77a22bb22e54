//! Dragging of an object in a plot, such as a line or the point of the contact. The state is stored in the memory of
//! egui.

use egui::{Id, Pos2, Ui};

/// Object that can be dragged.
#[derive(Clone, Copy)]
pub struct Grip(Id);

impl Grip {
    /// Returns the object with this name in the plot with the name `plot`.
    pub fn new(plot: &str, name: &str) -> Self {
        Self(Id::unique(("grip", plot.to_owned(), name.to_owned())))
    }

    /// Returns true while the user drags the object. The plot itself must then not move.
    pub fn is_held(self, ui: &Ui) -> bool {
        ui.data(|data| data.get_temp(self.0).unwrap_or(false))
    }

    /// Returns the screen position of the pointer while the user drags the object, after a move of more than one point.
    /// Call in every frame. `near` is true if the pointer is close enough to grab the object.
    pub fn follow(self, ui: &Ui, near: bool) -> Option<Pos2> {
        let mut held = self.is_held(ui);
        // The object is held from the press on, before the drag starts, so that the plot itself does not move.
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
