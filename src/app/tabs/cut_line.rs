//! A vertical line in a profile of a point contact: there the other profile cuts it, and the hand can take it along.

use egui::{Color32, CursorIcon, Id, Response, Ui};
use egui_plot::{LineStyle, PlotPoint, PlotTransform, PlotUi, VLine};

/// How near (in screen points) the pointer must be to take the line along.
const GRAB: f32 = 6.0;

/// The line of one plot.
pub struct CutLine {
    id: Id,
    at: f64,
}

impl CutLine {
    /// The line at a place of the plot of a name.
    pub fn new(plot: &str, at: f64) -> Self {
        Self { id: Id::unique(("cut line", plot.to_owned())), at }
    }

    /// Whether the hand holds it: then the plot itself stays where it is.
    pub fn is_held(&self, ui: &Ui) -> bool {
        ui.data(|data| data.get_temp(self.id).unwrap_or(false))
    }

    /// Draws it.
    pub fn draw(&self, plot: &mut PlotUi<'_>, color: Color32) {
        let line = VLine::new("", self.at).id(self.id).color(color).width(1.2);
        plot.vline(line.style(LineStyle::dashed_dense()).allow_hover(false));
    }

    /// Where the hand takes it in this frame.
    pub fn moved(&self, ui: &Ui, response: &Response, transform: &PlotTransform) -> Option<f64> {
        let spot = transform.position_from_point(&PlotPoint::new(self.at, 0.0)).x;
        let near = response.hover_pos().is_some_and(|p| (p.x - spot).abs() < GRAB);
        let mut held = self.is_held(ui);
        // Taking hold before the drag begins keeps the plot itself still.
        if ui.input(|i| i.pointer.primary_pressed()) {
            held = near;
        }
        held &= ui.input(|i| i.pointer.primary_down());
        ui.data_mut(|data| data.insert_temp(self.id, held));
        if near || held {
            ui.ctx().set_cursor_icon(CursorIcon::ResizeHorizontal);
        }
        let pointer = ui.input(|i| i.pointer.latest_pos()).filter(|_| held)?;
        let begun = ui.input(|i| i.pointer.press_origin()).is_some_and(|origin| origin.distance(pointer) > 1.0);
        begun.then(|| snapped(transform.value_from_position(pointer).x))
    }
}

/// Hundredths, and the middle where it is near: a hand does not hit it.
pub fn snapped(value: f64) -> f64 {
    let rounded = (100.0 * value).round() / 100.0;
    if rounded.abs() < 0.03 { 0.0 } else { rounded }
}
