//! Widgets shared by the panels: number fields with error messages, sliders with a marked range, choice boxes. Further
//! functions set the texts for screen readers and draw a ring around a control.

use super::numbers;
use super::theme::Palette;
use crate::app::refusal::Refusal;
use crate::engine::job::Standing;
use egui::accesskit::Role;
use egui::text::{LayoutJob, TextFormat};
use egui::{
    Button, Color32, ComboBox, Context, Id, Key, ProgressBar, Rect, Response, RichText, Sense, Slider, SliderClamping,
    Stroke, TextEdit, TextStyle, Ui, WidgetInfo, WidgetText, pos2, vec2,
};
use std::collections::HashMap;
use std::ops::RangeInclusive;

/// Text being edited and messages about refused entries, by the name of the field.
#[derive(Default)]
pub struct Entries {
    buffers: HashMap<&'static str, String>,
    messages: HashMap<&'static str, String>,
    /// Field of the last refusal.
    last: Option<&'static str>,
}

impl Entries {
    /// Removes all texts and messages, because the values have changed.
    pub fn clear(&mut self) {
        self.buffers.clear();
        self.messages.clear();
    }

    /// Stores why an entry was refused. Removes text and message if it was accepted.
    pub fn answer(&mut self, name: &'static str, result: Result<(), Refusal>) {
        match result {
            Ok(()) => {
                self.messages.remove(name);
                self.buffers.remove(name);
            }
            Err(message) => {
                self.last = Some(name);
                self.messages.insert(name, message.to_string());
            }
        }
    }

    /// Returns the message about a field, if there is one.
    pub fn message(&self, name: &str) -> Option<&str> {
        self.messages.get(name).map(String::as_str)
    }

    /// Shows the message about a field, if there is one.
    pub fn message_ui(&self, ui: &mut Ui, name: &str) {
        if let Some(message) = self.message(name) {
            message_ui(ui, message);
        }
    }

    /// Shows one message about a group of fields: the last refusal if it belongs to the group, else the first message.
    /// Reserves two lines, so that nothing below moves.
    pub fn reserved_ui<'a>(&self, ui: &mut Ui, names: impl IntoIterator<Item = &'a str>) {
        let names: Vec<&str> = names.into_iter().collect();
        let last = self.last.filter(|last| names.contains(last)).and_then(|last| self.message(last));
        reserved_message(ui, last.or_else(|| names.iter().find_map(|name| self.message(name))));
    }
}

/// Draws an error message, if there is one, in two reserved lines, so that nothing below moves. If the message does not
/// fit, it is shown in full on hover.
pub fn reserved_message(ui: &mut Ui, message: Option<&str>) {
    reserved(ui, 2, |ui| {
        let Some(message) = message else { return };
        let font_id = TextStyle::Small.resolve(ui.style());
        let format = TextFormat { font_id, color: Palette::of(ui).wrong, ..TextFormat::default() };
        let mut job = LayoutJob::single_section(sentence(message), format);
        job.wrap.max_rows = 2;
        ui.label(job);
    });
}

/// Reserves space for `lines` lines of small text, so that nothing below moves.
pub fn reserved(ui: &mut Ui, lines: u8, content: impl FnOnce(&mut Ui)) {
    let height = f32::from(lines) * ui.text_style_height(&egui::TextStyle::Small) + ui.spacing().item_spacing.y;
    let layout = egui::Layout::top_down(egui::Align::LEFT);
    ui.allocate_ui_with_layout([ui.available_width(), height].into(), layout, |ui| {
        ui.set_min_height(height);
        content(ui);
    });
}

/// Draws one of two alternative buttons: the second one if `second`. Both have the width of the wider one, so that
/// neighbouring widgets do not move.
pub fn either_button(ui: &mut Ui, names: [&str; 2], second: bool) -> Response {
    let font = TextStyle::Button.resolve(ui.style());
    let text = |name: &str| ui.painter().layout_no_wrap(name.to_owned(), font.clone(), Color32::PLACEHOLDER).size().x;
    let width = names.map(text).into_iter().fold(0.0, f32::max) + 2.0 * ui.spacing().button_padding.x;
    let [first, other] = names;
    ui.add(Button::new(if second { other } else { first }).min_size(vec2(width, 0.0)))
}

/// Draws an error message as a sentence.
pub fn message_ui(ui: &mut Ui, message: &str) {
    let color = Palette::of(ui).wrong;
    ui.label(RichText::new(sentence(message)).small().color(color));
}

/// Draws a warning as a sentence.
pub fn warning_ui(ui: &mut Ui, message: &str) {
    let color = Palette::of(ui).warning;
    ui.label(RichText::new(sentence(message)).small().color(color));
}

/// Draws stage, progress and remaining time of a job. In a horizontal layout the bar is shorter and the stage is a
/// tooltip. `name` is the accessible name of the bar.
pub fn standing_ui(ui: &mut Ui, standing: Option<Standing>, name: &str) {
    let Some(standing) = standing else { return };
    let (stage, short) = (sentence(&standing.stage), ui.layout().is_horizontal());
    let content = |ui: &mut Ui| {
        if !short {
            ui.label(&stage);
        }
        let fraction = if standing.total > 0 { standing.done as f32 / standing.total as f32 } else { 0.0 };
        let bar = ProgressBar::new(fraction).desired_width(if short { 90.0 } else { 120.0 }).desired_height(8.0);
        let bar = ui.add(bar);
        named(ui, bar, name);
        ui.weak(numbers::standing(&standing)).on_hover_text(&stage);
    };
    if short { content(ui) } else { ui.horizontal(content).inner }
}

/// Draws a small lock, closed or open, at the left of an area of the size `room`. The whole area can be clicked.
pub fn lock_ui(ui: &mut Ui, room: [f32; 2], closed: bool) -> Response {
    let (slot, response) = ui.allocate_exact_size(room.into(), Sense::click());
    let rect = Rect::from_center_size(slot.left_center() + vec2(9.0, 0.0), vec2(14.0, 14.0));
    let visuals = ui.style().interact(&response);
    let color = if closed { visuals.text_color() } else { ui.visuals().weak_text_color() };
    let body = Rect::from_min_max(rect.min + vec2(2.5, 6.5), rect.max - vec2(2.5, 1.5));
    let shackle = body.center_top() + vec2(if closed { 0.0 } else { 4.0 }, 0.0);
    ui.painter().circle_stroke(shackle, 3.0, Stroke::new(1.3, color));
    ui.painter().rect_filled(body, 1.0, color);
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, closed, "lock"));
    response
}

/// Draws the explanation of a tab.
pub fn why(ui: &mut Ui, text: &str) {
    let frame = egui::Frame::new().inner_margin(6.0).corner_radius(4.0).fill(ui.visuals().faint_bg_color);
    frame.show(ui, |ui| ui.label(text));
}

/// Returns the text with a capital first letter and a full stop at the end. The first letter stays small if no letter
/// follows it, as in a symbol.
pub fn sentence(text: &str) -> String {
    let text = text.trim();
    let mut chars = text.chars();
    let first = chars.next();
    let is_word = chars.clone().next().is_some_and(char::is_alphabetic);
    let mut out = match first {
        Some(letter) if is_word => letter.to_uppercase().chain(chars).collect(),
        _ => text.to_owned(),
    };
    if !out.ends_with(['.', '!', '?']) {
        out.push('.');
    }
    out
}

/// Sets the accessible name of a widget, which screen readers and tests use. Draws its ring, see [`ringed`].
pub fn named(ui: &Ui, response: Response, name: &str) -> Response {
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_label(name));
    ringed(ui, response, name)
}

/// Draws a ring around a widget if [`point_at`] or [`show`] has chosen its name. Scrolls to it once after [`show`].
pub fn ringed(ui: &Ui, response: Response, name: &str) -> Response {
    let pointed = ui.ctx().data(|data| data.get_temp::<String>(pointed_at()));
    if pointed.is_some_and(|pointed| pointed == name) {
        let stroke = egui::Stroke::new(2.0, Palette::of(ui).accent);
        ui.painter().rect_stroke(response.rect.expand(3.0), 4.0, stroke, egui::StrokeKind::Outside);
        if ui.ctx().data_mut(|data| data.remove_temp::<bool>(pointed_at())).is_some() {
            response.scroll_to_me(Some(egui::Align::Center));
        }
    }
    response
}

/// Returns the key of two stored values: the name of the ringed control (`String`) and the request to scroll to it
/// (`bool`).
fn pointed_at() -> Id {
    Id::unique("pointed at")
}

/// Draws a ring around the control of this name, for demonstrations. No ring with `None`.
pub fn point_at(ctx: &Context, name: Option<&str>) {
    ctx.data_mut(|data| data.insert_temp(pointed_at(), name.unwrap_or_default().to_owned()));
}

/// Draws a ring around the control of this name and scrolls to it.
pub fn show(ctx: &Context, name: &str) {
    point_at(ctx, Some(name));
    ctx.data_mut(|data| data.insert_temp(pointed_at(), true));
}

/// Sets the text that a screen reader reads for a label whose own text is not sufficient.
pub fn spoken(ui: &Ui, response: Response, text: &str) -> Response {
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_value(text));
    response
}

/// Sets the text that a screen reader reads after the name, because it cannot read tooltips.
pub fn described(ui: &Ui, response: Response, description: &str) -> Response {
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_description(description));
    response
}

/// Common width of choice boxes \[points\].
const CHOICE_WIDTH: f32 = 164.0;

/// Draws a row with a name and a choice box. `describe` returns the name and the tooltip of an option; the tooltip may
/// be empty.
pub fn choice<'a, T: Copy + PartialEq>(
    ui: &mut Ui,
    name: impl Into<WidgetText>,
    tooltip: &str,
    value: &mut T,
    options: &[T],
    describe: impl Fn(T) -> (&'a str, &'a str),
) {
    let name = name.into();
    let text = name.text().to_owned();
    let label = ui.label(name);
    let label = ringed(ui, label, &text).on_hover_text(tooltip);
    let (chosen, meaning) = describe(*value);
    let response = ComboBox::from_id_salt(label.id)
        .selected_text(chosen)
        .width(CHOICE_WIDTH)
        // Long lists show all options on usual screens.
        .height(0.6 * ui.ctx().content_rect().height())
        .show_ui(ui, |ui| {
            for &option in options {
                let (name, meaning) = describe(option);
                let response = ui.selectable_value(value, option, name);
                if !meaning.is_empty() {
                    response.on_hover_text(meaning);
                }
            }
        })
        .response
        .labelled_by(label.id);
    if !meaning.is_empty() {
        response.on_hover_text(meaning);
    }
    ui.end_row();
}

/// Draws a number field that parses its text with `read`. Returns the number when the user has changed it, and stores
/// the message if `read` refuses the text. NaN is shown as “none”. Arrow keys change the number by 1 %, with Shift by
/// 10 %.
pub fn typed_field(
    ui: &mut Ui,
    entries: &mut Entries,
    name: &'static str,
    value: f64,
    width: f32,
    tooltip: &str,
    read: impl Fn(&str) -> Result<f64, Refusal>,
) -> Option<f64> {
    let shown = match value {
        value if value.is_infinite() => "∞".to_owned(),
        value if value.is_nan() => "none".to_owned(),
        value => numbers::significant(value),
    };
    let mut text = entries.buffers.get(name).cloned().unwrap_or_else(|| shown.clone());
    let wrong = entries.messages.contains_key(name);
    let mut edit = TextEdit::singleline(&mut text).align(egui::Align2::RIGHT_CENTER);
    if wrong {
        edit = edit.text_color(Palette::of(ui).wrong);
    }
    let height = ui.spacing().interact_size.y;
    let response = ui.add_sized([width, height], edit);
    let response = named(ui, response, name).on_hover_text(tooltip);
    if response.gained_focus() {
        entries.buffers.entry(name).or_insert_with(|| shown.clone());
    }
    if response.changed() {
        entries.buffers.insert(name, text.clone());
    }
    if response.has_focus() {
        let (up, down, large) = ui.input_mut(|i| {
            let large = i.modifiers.shift;
            (
                i.count_and_consume_key(i.modifiers, Key::ArrowUp),
                i.count_and_consume_key(i.modifiers, Key::ArrowDown),
                large,
            )
        });
        let steps = up as f64 - down as f64;
        if steps != 0.0 {
            entries.buffers.remove(name);
            entries.messages.remove(name);
            let share: f64 = if large { 0.1 } else { 0.01 };
            // Zero has no percentage, so step from zero in absolute values.
            return Some(if value == 0.0 { share * steps } else { value * (1.0 + share).powf(steps) });
        }
    }
    if response.lost_focus() {
        let typed = entries.buffers.get(name).cloned().unwrap_or(text);
        if ui.input(|i| i.key_pressed(Key::Escape)) || typed == shown {
            entries.buffers.remove(name);
            entries.messages.remove(name);
            return None;
        }
        match read(&typed) {
            Ok(number) => return Some(number),
            Err(message) => entries.answer(name, Err(message)),
        }
    }
    None
}

/// Parameters of a labelled slider.
pub struct RangeSlider<'a> {
    /// Accessible name. The name of the number field is this name with " value" appended.
    pub name: &'a str,
    /// Range of the slider.
    pub range: RangeInclusive<f64>,
    /// Trained range, marked under the rail.
    pub marked: Option<(f64, f64)>,
    /// Value set by a double click.
    pub home: f64,
    /// Description of the quantity for screen readers.
    pub tooltip: &'a str,
    /// True for a logarithmic scale.
    pub logarithmic: bool,
}

impl RangeSlider<'_> {
    /// Draws the slider. Returns the new value after a move or a double click.
    pub fn show(&self, ui: &mut Ui, value: f64, width: f32) -> Option<f64> {
        let mut moved = value;
        ui.spacing_mut().slider_width = width;
        let response = ui.add(
            Slider::new(&mut moved, self.range.clone())
                .logarithmic(self.logarithmic)
                .clamping(SliderClamping::Never)
                .smart_aim(false)
                .show_value(false),
        );
        let rect = response.rect;
        // No tooltip here, because it would cover what the slider moves. The symbol to its left has the tooltip.
        let response = described(ui, named(ui, response, self.name), self.tooltip);
        if let Some((low, high)) = self.marked {
            let radius = rect.height() / 2.5;
            let at = |v: f64| {
                let place = |v: f64| if self.logarithmic { v.max(1e-12).ln() } else { v };
                let (a, b) = (place(*self.range.start()), place(*self.range.end()));
                let t = ((place(v) - a) / (b - a)).clamp(0.0, 1.0) as f32;
                rect.left() + radius + t * (rect.width() - 2.0 * radius)
            };
            let y = rect.bottom() - 1.0;
            let color = Palette::of(ui).accent.gamma_multiply(0.8);
            ui.painter().line_segment([pos2(at(low), y), pos2(at(high), y)], egui::Stroke::new(2.0, color));
        }
        let double = ui.input(|i| i.pointer.button_double_clicked(egui::PointerButton::Primary));
        if double && response.hovered() {
            return Some(self.home);
        }
        (response.changed() && moved != value).then_some(moved)
    }
}

/// Draws the heading of a group in a panel.
pub fn heading(ui: &mut Ui, text: &str) {
    ui.add_space(4.0);
    let label = ui.label(RichText::new(text).strong().size(14.5));
    ringed(ui, label, text);
}

/// Width of the column of names \[points\], so that values line up across groups.
pub const NAME_WIDTH: f32 = 110.0;

/// Draws a formatted label with a tooltip.
pub fn explained(ui: &mut Ui, job: LayoutJob, tooltip: &str) -> Response {
    ui.label(job).on_hover_text(tooltip)
}

/// Draws the name of a row with the common width.
pub fn row_name(ui: &mut Ui, job: LayoutJob, tooltip: &str) {
    ui.horizontal(|ui| {
        ui.set_min_width(NAME_WIDTH);
        explained(ui, job, tooltip);
    });
}
