//! What the hand takes along in a plot: a line, or the contact itself.

use egui::{Id, Pos2, Ui};

/// Something that can be taken along.
#[derive(Clone, Copy)]
pub struct Grip(Id);

impl Grip {
    /// What goes by a name in one plot.
    pub fn new(plot: &str, name: &str) -> Self {
        Self(Id::unique(("grip", plot.to_owned(), name.to_owned())))
    }

    /// Whether the hand holds it: then the plot itself stays where it is.
    pub fn is_held(self, ui: &Ui) -> bool {
        ui.data(|data| data.get_temp(self.0).unwrap_or(false))
    }

    /// Where the hand takes it in this frame; `near` says whether the pointer is where it can be taken hold of.
    pub fn follow(self, ui: &Ui, near: bool) -> Option<Pos2> {
        let mut held = self.is_held(ui);
        // Taking hold before the drag begins keeps the plot itself still.
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
