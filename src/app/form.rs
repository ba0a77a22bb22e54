//! Form for a part of the document: numbers, intervals, counts and choices, each with the refusal of its last
//! entry.

use super::command::Command;
use super::context::{Commands, Context};
use super::controls::{Entries, choice, explained, named};
use super::document::Edit;
use super::numbers;
use super::theme::rich;
use super::units;
use crate::solver::physics::engineering::{QuantityKind, Unit};
use egui::{DragValue, Ui};

/// Width of the column of names.
const NAMES: f32 = 112.0;
/// Width of a number field.
const NUMBER: f32 = 66.0;

/// Field of a form that was changed last. A refusal is shown next to it.
pub type LastField = Option<&'static str>;

/// State that the fields of a form share in one frame.
pub struct Form<'a> {
    /// Name under which the window stores refusals of this form.
    name: &'static str,
    last: LastField,
    entries: &'a Entries,
    /// Field changed in this frame.
    pub changed: Option<&'static str>,
    /// Field whose entry is invalid for any values of the other fields, and the reason.
    pub refused: Option<(&'static str, &'static str)>,
}

impl<'a> Form<'a> {
    /// Creates a form. Refusals are stored under `name`.
    pub fn new(name: &'static str, last: LastField, context: &Context<'a>) -> Self {
        Self { name, last, entries: context.entries, changed: None, refused: None }
    }

    /// Submits the change made in this frame, if there is one. Returns the field that was changed last, or
    /// `otherwise` if no field has reported a change.
    pub fn ask(self, edit: Option<Edit>, otherwise: &'static str, commands: &mut Commands) -> LastField {
        match (edit, self.refused) {
            (Some(edit), _) => {
                commands.edit(edit, self.name);
                self.changed.or(Some(otherwise))
            }
            (None, Some((field, why))) => {
                commands.push(Command::Refuse(self.name, why));
                Some(field)
            }
            (None, None) => self.last,
        }
    }

    /// Shows why the last entry in a field was refused.
    pub fn message(&self, ui: &mut Ui, field: &str) {
        if self.last == Some(field) {
            self.entries.message_ui(ui, self.name);
        }
    }

    /// Draws a number that can be dragged or typed in a unit.
    pub fn number(&mut self, ui: &mut Ui, field: &'static str, name: &str, value: &mut f64, unit: Unit, tip: &str) {
        let mut shown = unit.number(*value);
        let before = shown;
        let drag = DragValue::new(&mut shown)
            .speed((0.01 * before.abs()).max(1e-12))
            .update_while_editing(false)
            .custom_formatter(|value, _| short(value))
            .custom_parser(|text| numbers::parse(text).ok());
        let height = ui.spacing().interact_size.y;
        let response = ui.add_sized([NUMBER, height], drag);
        let response = named(ui, response, name).on_hover_text(tip);
        // Leaving a field without a change must not round its value to the displayed digits.
        if response.changed() && short(shown) != short(before) {
            *value = unit.si(shown);
            self.changed = Some(field);
        }
    }

    /// Draws a row with a count.
    pub fn count(&mut self, ui: &mut Ui, field: &'static str, value: &mut usize, tip: &str) {
        row(ui, field, tip, |ui| {
            let response = ui.add_sized([NUMBER, ui.spacing().interact_size.y], DragValue::new(value).speed(0.4));
            if named(ui, response, &plain(field)).on_hover_text(tip).changed() {
                self.changed = Some(field);
            }
        });
        self.message(ui, field);
    }

    /// Draws a row with a number and its unit.
    pub fn row(&mut self, ui: &mut Ui, field: &'static str, kind: QuantityKind, value: &mut f64, tip: &str) {
        let unit = kind.unit(units::system(ui.ctx()));
        row(ui, field, tip, |ui| {
            self.number(ui, field, &plain(field), value, unit, tip);
            ui.label(unit.name);
        });
        self.message(ui, field);
    }

    /// Draws a row with both ends of an interval and their unit.
    pub fn interval(&mut self, ui: &mut Ui, field: &'static str, kind: QuantityKind, ends: &mut (f64, f64), tip: &str) {
        let unit = kind.unit(units::system(ui.ctx()));
        row(ui, field, tip, |ui| {
            self.number(ui, field, &format!("{} from", plain(field)), &mut ends.0, unit, tip);
            ui.label("…");
            self.number(ui, field, &format!("{} to", plain(field)), &mut ends.1, unit, tip);
            ui.label(unit.name);
        });
        self.message(ui, field);
    }
}

/// Draws a row: its name with a tooltip, and its content.
pub fn row(ui: &mut Ui, name: &str, tip: &str, content: impl FnOnce(&mut Ui)) {
    ui.horizontal(|ui| {
        ui.horizontal(|ui| {
            ui.set_min_width(NAMES);
            let job = rich(name, 13.5, ui.visuals().text_color());
            explained(ui, job, tip);
        });
        ui.spacing_mut().item_spacing.x = 5.0;
        content(ui);
    });
}

/// Returns a name for screen readers, without the markup of symbols.
fn plain(name: &str) -> String {
    name.replace(['{', '}'], "")
}

/// Returns a number without trailing zeros, with a power of ten if that is shorter.
pub fn short(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-3..1e6).contains(&size) {
        let text = format!("{value:.3e}");
        let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        let mantissa =
            if mantissa.contains('.') { mantissa.trim_end_matches('0').trim_end_matches('.') } else { mantissa };
        return format!("{mantissa}e{exponent}").replace('-', "−");
    }
    let text = numbers::digits(value, 5);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// Draws a row with a choice box.
pub fn choose<T: Copy + PartialEq>(
    ui: &mut Ui,
    name: &str,
    tip: &str,
    value: &mut T,
    options: &[T],
    describe: impl Fn(T) -> (&'static str, &'static str),
) {
    egui::Grid::new(name).num_columns(2).min_col_width(NAMES).spacing([8.0, 4.0]).show(ui, |ui| {
        choice(ui, name, tip, value, options, describe);
    });
}
