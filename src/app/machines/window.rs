//! Window with the form of a machine: its values, what follows from them, and a slider along the path of contact.

use super::along;
use super::derived::{self, Row};
use super::kind::MachineKind;
use super::{bearing, cam, gear, sketch};
use crate::app::command::Command;
use crate::app::context::Commands;
use crate::app::controls::{Entries, RangeSlider, message_ui};
use crate::app::document::{Document, Edit};
use crate::app::numbers;
use crate::app::refusal::Refusal;
use crate::app::tab::Tab;
use crate::app::theme::rich;
use crate::app::units;
use crate::solver::physics::engineering::UnitSystem;
use crate::solver::physics::machines::Machine;
use egui::{Button, Context, Grid, ScrollArea, TextStyle, Ui, Window};

/// Field under which the document refuses a machine.
const FIELD: &str = "bodies";
/// Width of the derived values.
const DERIVED: f32 = 250.0;
/// Height of the title and of the buttons.
const ACTIONS: f32 = 96.0;

/// Window with the form of a machine. Machines that were entered are kept while the program runs; the document
/// remembers the one in use.
pub struct MachineWindow {
    open: Option<MachineKind>,
    drafts: [Machine; 3],
    /// Text of the lift table.
    table: String,
    entries: Entries,
    /// Reason why the last button did nothing.
    message: Option<Refusal>,
}

impl Default for MachineWindow {
    fn default() -> Self {
        Self {
            open: None,
            drafts: MachineKind::ALL.map(MachineKind::example),
            table: String::new(),
            entries: Entries::default(),
            message: None,
        }
    }
}

impl MachineWindow {
    /// Returns true if the window is open. Escape then closes it.
    pub fn is_open(&self) -> bool {
        self.open.is_some()
    }

    /// Opens the form of a kind, with the machine of the document if it has one.
    pub fn open(&mut self, kind: MachineKind, document: &Document) {
        self.open = Some(kind);
        self.message = None;
        self.entries.clear();
        if let Some(machine) = document.view.machine.as_ref().filter(|machine| MachineKind::of(machine) == kind) {
            self.drafts[kind as usize] = machine.clone();
        }
        if let Machine::Cam(cam) = &self.drafts[MachineKind::Cam as usize] {
            self.table = cam::text_of(&cam.lift);
        }
    }

    /// Closes the window and keeps the values.
    pub fn close(&mut self) {
        self.open = None;
    }

    /// Draws the window if it is open.
    pub fn ui(&mut self, ctx: &Context, document: &Document, commands: &mut Commands) {
        let Some(kind) = self.open else { return };
        let mut open = true;
        let room = ctx.content_rect().size();
        let title = kind.title().trim_end_matches('…');
        let window = Window::new(title).id(egui::Id::unique("machine")).open(&mut open).collapsible(false);
        let height = 0.86 * room.y;
        window.resizable(false).max_height(height).default_pos((0.28 * room.x, 0.06 * room.y)).show(ctx, |ui| {
            let room = height - ACTIONS;
            let area = ScrollArea::vertical().max_height(room).min_scrolled_height(room);
            let ready = area.show(ui, |ui| {
                let columns = ui.horizontal_top(|ui| {
                    ui.vertical(|ui| self.form_ui(ui, kind));
                    ui.add_space(12.0);
                    let derived = ui.vertical(|ui| {
                        ui.set_width(DERIVED);
                        self.derived_ui(ui, kind, document)
                    });
                    derived.inner
                });
                columns.inner
            });
            // The buttons stay in view below the form.
            self.actions_ui(ui, kind, ready.inner, document, commands);
        });
        if !open {
            self.open = None;
        }
    }

    fn form_ui(&mut self, ui: &mut Ui, kind: MachineKind) {
        let entries = &mut self.entries;
        let changed = match &mut self.drafts[kind as usize] {
            Machine::Bearing(draft) => bearing::ui(ui, draft, entries),
            Machine::Gear(draft) => gear::ui(ui, draft, entries),
            Machine::Cam(draft) => cam::ui(ui, draft, &mut self.table, entries),
        };
        if changed {
            self.message = None;
        }
        let names: Vec<&str> = match kind {
            MachineKind::Bearing => bearing::names().collect(),
            MachineKind::Gear => gear::names().collect(),
            MachineKind::Cam => cam::names().collect(),
        };
        ui.scope(|ui| {
            ui.set_max_width(250.0);
            self.entries.reserved_ui(ui, names);
        });
    }

    /// Draws the slider, the sketch and the values of the contact. Returns true if there is a contact.
    fn derived_ui(&mut self, ui: &mut Ui, kind: MachineKind, document: &Document) -> bool {
        // The sketch stays where it is if the machine is refused and has no path.
        ui.scope(|ui| {
            let spacing = ui.spacing();
            let slider = spacing.item_spacing.y + spacing.interact_size.y;
            ui.set_min_height(ui.text_style_height(&TextStyle::Body) + slider);
            self.slider_ui(ui, kind, document);
        });
        let machine = self.drafts[kind as usize].clone();
        let shown = trial(&machine, document, units::system(ui.ctx()));
        let modulus = document.bodies().reduced_modulus_pa().unwrap_or(document.point.modulus_pa);
        sketch::ui(ui, &machine, modulus, DERIVED - 10.0);
        ui.scope(|ui| {
            // The values keep their space while a message is shown.
            ui.set_min_height(250.0);
            match &shown {
                Ok(rows) => rows_ui(ui, rows),
                Err(why) => message_ui(ui, why),
            }
        });
        shown.is_ok()
    }

    /// Draws the buttons that use the contact or its path.
    fn actions_ui(
        &mut self,
        ui: &mut Ui,
        kind: MachineKind,
        ready: bool,
        document: &Document,
        commands: &mut Commands,
    ) {
        let machine = self.drafts[kind as usize].clone();
        let line = machine.kind().is_line();
        ui.horizontal(|ui| {
            let tip = "Sets bodies, speeds and load. Materials, roughness and lubricant stay";
            if ui.add_enabled(ready, Button::new("Use")).on_hover_text(tip).clicked() {
                commands.edit(Edit::Machine(Box::new(machine.clone())), FIELD);
            }
            let tip = "Opens a table with the contacts along the path";
            if ui.add_enabled(ready, Button::new("Load cases along the path")).on_hover_text(tip).clicked() {
                match along::load_cases(&machine, document) {
                    Ok(text) => commands.push(Command::OpenLoadCases(text)),
                    Err(why) => self.message = Some(why),
                }
            }
            let tip =
                "Uses this contact, and lets R, u_m and w follow the path in the Transient tab. By the full solver";
            let transient = ui.add_enabled(ready && line, Button::new("Transient run along the path"));
            let transient = transient
                .on_hover_text(tip)
                .on_disabled_hover_text("Transient runs along a path cover line contacts only");
            if transient.clicked() {
                // The form would hide the run.
                match start_transient(&machine, document, commands) {
                    Ok(()) => self.open = None,
                    Err(why) => self.message = Some(why),
                }
            }
        });
        if let Some(why) = &self.message {
            message_ui(ui, why);
        }
    }

    /// Draws the slider along the path, and keeps the position on the path.
    fn slider_ui(&mut self, ui: &mut Ui, kind: MachineKind, document: &Document) {
        let draft = &mut self.drafts[kind as usize];
        let (name, position) = kind.position();
        let unit = position.unit(units::system(ui.ctx()));
        let modulus = document.bodies().reduced_modulus_pa().unwrap_or(document.point.modulus_pa);
        let Ok((from, to)) = draft.extent(modulus) else { return };
        let here = match draft {
            Machine::Bearing(bearing) => bearing.orbit_deg.to_radians(),
            Machine::Gear(pair) => pair.position_m,
            Machine::Cam(cam) => cam.angle_deg.to_radians(),
        };
        let ends = [from, to].map(|end| numbers::digits(unit.number(end), 3));
        ui.label(format!("{name}, {} to {} {}", ends[0], ends[1], unit.name));
        let slider = RangeSlider {
            name: "Position along the path",
            range: unit.number(from)..=unit.number(to),
            marked: None,
            home: 0.0,
            tooltip: "Position of the contact along its path; a double click sets 0",
            logarithmic: false,
        };
        if let Some(moved) = slider.show(ui, unit.number(here), DERIVED - 20.0) {
            *draft = draft.at(unit.si(moved).clamp(from, to));
            self.entries.clear();
        }
    }
}

/// Returns the values of a machine as it would be used now, or why the document cannot take it.
fn trial(machine: &Machine, document: &Document, system: UnitSystem) -> Result<Vec<Row>, Refusal> {
    let mut with = document.clone();
    with.set_machine(machine.clone())?;
    let modulus_pa = document.bodies().reduced_modulus_pa()?;
    let mut rows = derived::of_contact(&with.point, &machine.contact(modulus_pa)?, system);
    rows.extend(derived::of_machine(machine, modulus_pa, system)?);
    Ok(rows)
}

fn rows_ui(ui: &mut Ui, rows: &[Row]) {
    Grid::new("derived").num_columns(2).spacing([12.0, 3.0]).show(ui, |ui| {
        for (name, value, tip) in rows {
            let size = TextStyle::Body.resolve(ui.style()).size;
            let name = if name.contains('_') { format!("{{{name}}}") } else { (*name).to_owned() };
            let color = ui.visuals().text_color();
            ui.label(rich(&name, size, color)).on_hover_text(*tip);
            ui.label(value).on_hover_text(*tip);
            ui.end_row();
        }
    });
}

/// Sets the contact of the machine and the transient study along its path.
fn start_transient(machine: &Machine, document: &Document, commands: &mut Commands) -> Result<(), Refusal> {
    let study = along::transient(machine, document)?;
    let mut with = document.clone();
    with.set_machine(machine.clone())?;
    with.set_transient(study.clone())?;
    commands.edit(Edit::Machine(Box::new(machine.clone())), FIELD);
    commands.edit(Edit::Transient(Box::new(study)), FIELD);
    commands.push(Command::Go(Tab::Transient));
    Ok(())
}
