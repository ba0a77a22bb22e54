//! Key of a plot: a sample of each curve and mark above the plot, or a name next to the curve.

use crate::app::figure::Canvas;
use crate::app::plot::axes::TITLE_SIZE;
use crate::app::theme::{Palette, rich};
use egui::{Align2, Color32, Pos2, Sense, Shape, Stroke, Ui, vec2};
use egui_plot::{LineStyle, PlotPoint, Text};
use std::hash::Hash;

/// Length of a sample of a line.
const PIECE: f32 = 26.0;
/// Space between entries.
const APART: f32 = 16.0;
/// Space between a sample and its name.
const BESIDE: f32 = 5.0;
/// Width of a mark.
const MARK: f32 = 12.0;

/// Style of a curve or mark, with its width or radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sample {
    Line(f32),
    /// A dashed line.
    Dashed(f32),
    /// A dotted line.
    Dotted(f32),
    /// A filled circle.
    Dot(f32),
    /// A triangle that points upwards.
    Up(f32),
    /// A triangle that points downwards.
    Down(f32),
    Cross(f32),
    /// A square on its corner.
    Diamond(f32),
    /// A filled area.
    Area,
}

impl Sample {
    /// Returns the sample of a line of a plot.
    pub fn of_line(style: LineStyle, width: f32) -> Self {
        match style {
            LineStyle::Solid => Self::Line(width),
            LineStyle::Dashed { .. } => Self::Dashed(width),
            LineStyle::Dotted { .. } => Self::Dotted(width),
        }
    }

    fn is_line(self) -> bool {
        matches!(self, Self::Line(_) | Self::Dashed(_) | Self::Dotted(_))
    }

    /// Returns the width of the sample.
    fn width(self) -> f32 {
        if self.is_line() { PIECE } else { MARK }
    }

    /// Draws the sample.
    pub fn ui(self, ui: &mut Ui, color: Color32) {
        let width = self.width();
        let (rect, _) = ui.allocate_exact_size(vec2(width, 12.0), Sense::hover());
        let (ends, at) = ([rect.left_center(), rect.right_center()], rect.center());
        let polygon = |corners: Vec<Pos2>| Shape::convex_polygon(corners, color, Stroke::NONE);
        let painter = ui.painter();
        match self {
            Self::Line(width) => _ = painter.line_segment(ends, Stroke::new(width, color)),
            Self::Dashed(width) => painter.extend(Shape::dashed_line(&ends, Stroke::new(width, color), 5.0, 3.0)),
            Self::Dotted(width) => painter.extend(Shape::dotted_line(&ends, color, 4.0, 0.5 * width)),
            Self::Dot(radius) => _ = painter.circle_filled(at, radius, color),
            Self::Up(r) => _ = painter.add(polygon(vec![at - vec2(r, -r), at - vec2(0.0, r), at + vec2(r, r)])),
            Self::Down(r) => _ = painter.add(polygon(vec![at - vec2(r, r), at + vec2(r, -r), at + vec2(0.0, r)])),
            Self::Diamond(r) => {
                let corners = [vec2(0.0, -r), vec2(r, 0.0), vec2(0.0, r), vec2(-r, 0.0)];
                painter.add(polygon(corners.map(|corner| at + corner).to_vec()));
            }
            Self::Area => _ = painter.rect_filled(rect.shrink2(vec2(0.0, 1.5)), 1.0, color),
            Self::Cross(r) => {
                for corner in [vec2(r, r), vec2(r, -r)] {
                    painter.line_segment([at - corner, at + corner], Stroke::new(1.2, color));
                }
            }
        }
    }
}

/// Curve or kind of mark with its name, in which symbols are in braces.
pub struct Entry {
    name: String,
    color: Color32,
    sample: Sample,
}

impl Entry {
    /// Creates an entry from its name and style.
    pub fn new(name: impl Into<String>, color: Color32, sample: Sample) -> Self {
        Self { name: name.into(), color, sample }
    }
}

/// Draws the key.
pub fn ui(ui: &mut Ui, entries: impl IntoIterator<Item = Entry>) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = APART;
        entries_ui(ui, entries, TITLE_SIZE);
    });
}

/// Draws the entries in an existing row, with names of this size.
pub fn entries_ui(ui: &mut Ui, entries: impl IntoIterator<Item = Entry>, size: f32) {
    for Entry { name, color, sample } in entries {
        // A name stays next to its sample when entries wrap.
        let words = rich(&name, size, ui.visuals().text_color());
        let wide = sample.width() + BESIDE + ui.painter().layout_job(words.clone()).size().x;
        let begun = ui.cursor().left() > ui.max_rect().left() + 1.0;
        if begun && ui.layout().main_wrap() && ui.available_size_before_wrap().x < wide {
            ui.end_row();
        }
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = BESIDE;
            sample.ui(ui, color);
            ui.label(words);
        });
    }
}

/// Draws a plot below its key, together as high as `height`.
pub fn over<R>(
    ui: &mut Ui,
    height: f32,
    entries: impl IntoIterator<Item = Entry>,
    plot: impl FnOnce(&mut Ui, f32) -> R,
) -> R {
    ui.vertical(|ui| {
        let top = ui.cursor().top();
        self::ui(ui, entries);
        let rest = height - (ui.cursor().top() - top);
        plot(ui, rest)
    })
    .inner
}

/// Draws a name at a position of a plot, in a readable shade of its curve.
pub fn name(plot: &mut Canvas<'_, '_>, id: impl Hash, at: PlotPoint, name: &str, color: Color32, anchor: Align2) {
    let ink = Palette::of_screen(plot.ctx()).ink(color);
    let text = Text::new("", at, rich(&format!("  {name}  "), TITLE_SIZE, ink)).anchor(anchor);
    plot.text(text.id(("name of a curve", id)).allow_hover(false));
}
