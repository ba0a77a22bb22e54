//! Vertical line in a profile of a point contact. It marks the position of the other profile and can be dragged.

use crate::app::command::Command;
use crate::app::context::{Commands, Context};
use crate::app::controls::named;
use crate::app::figure::Canvas;
use crate::app::plot::grip::Grip;
use crate::app::theme::rich;
use egui::{Color32, CursorIcon, DragValue, Response, Ui};
use egui_plot::{LineStyle, PlotPoint, PlotTransform, VLine};

/// Distance in screen points within which the pointer can grab the line.
const GRAB: f32 = 6.0;

/// Line of one plot.
pub struct CutLine {
    grip: Grip,
    at: f64,
}

impl CutLine {
    /// Creates the line at a position in the plot of this name.
    pub fn new(plot: &str, at: f64) -> Self {
        Self { grip: Grip::new(plot, "cut"), at }
    }

    /// Returns true while the user drags the line. The plot itself must then not move.
    pub fn is_held(&self, ui: &Ui) -> bool {
        self.grip.is_held(ui)
    }

    pub fn draw(&self, plot: &mut Canvas<'_, '_>, color: Color32) {
        let line = VLine::new("", self.at).id("cut line").color(color).width(1.2);
        plot.vline(line.style(LineStyle::dashed_dense()).allow_hover(false));
    }

    /// Returns the position to which the user drags the line in this frame.
    pub fn moved(&self, ui: &Ui, response: &Response, transform: &PlotTransform) -> Option<f64> {
        let spot = transform.position_from_point(&PlotPoint::new(self.at, 0.0)).x;
        let near = response.hover_pos().is_some_and(|p| (p.x - spot).abs() < GRAB);
        let to = self.grip.follow(ui, near);
        if near || self.is_held(ui) {
            ui.ctx().set_cursor_icon(CursorIcon::ResizeHorizontal);
        }
        Some(snapped(transform.value_from_position(to?).x))
    }
}

/// Rounds to hundredths, and to zero near the centre, which is hard to hit with the pointer.
pub fn snapped(value: f64) -> f64 {
    let rounded = (100.0 * value).round() / 100.0;
    if rounded.abs() < 0.03 { 0.0 } else { rounded }
}

/// Space for name and value of one cut.
const CUT_WIDTH: f32 = 116.0;

/// Draws the positions of the cuts as number fields.
pub fn cuts_ui(ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
    let domain = context.document.plane().domain;
    let mut cuts = context.cuts;
    for (name, symbol, value, range, tip) in [
        (
            "Cut across at X",
            "at {X}",
            &mut cuts.x,
            domain.0..=domain.1,
            "Position X of the profile across the contact; drag the line in the map",
        ),
        (
            "Cut along at Y",
            "at {Y}",
            &mut cuts.y,
            domain.2..=-domain.2,
            "Position Y of the profile along X; drag the line in the map",
        ),
    ] {
        // In a toolbar that wraps, name and value stay in one row.
        if ui.available_size_before_wrap().x < CUT_WIDTH {
            ui.end_row();
        }
        let color = ui.visuals().text_color();
        ui.add(egui::Label::new(rich(&format!("Cut {symbol}"), 13.5, color)).extend()).on_hover_text(tip);
        let field = DragValue::new(value).range(range).speed(0.01).fixed_decimals(2);
        let response = ui.add(field).on_hover_text(tip);
        named(ui, response, name);
    }
    if cuts != context.cuts {
        commands.push(Command::Cut(cuts));
    }
}
