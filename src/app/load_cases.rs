//! Window in which the user pastes or opens a table of load cases, one contact per line. It checks the lines and starts
//! a study that solves all of them and shows the results in the Results tab.

use super::command::Command;
use super::context::Commands;
use super::controls::{message_ui, warning_ui};
use super::document::Document;
use super::purpose::Purpose;
use super::theme::Palette;
use crate::app::refusal::Refusal;
use crate::scene::study::load_cases::LoadCases;
use crate::scene::{At, CaseTable, CasesError, LoadCase, Method, Scene, Study};
use egui::{Align, Button, Checkbox, Context, FontId, Layout, ScrollArea, TextEdit, Ui, Window, vec2};
use std::path::Path;
use std::sync::Arc;

/// Example table.
const EXAMPLE: &str = include_str!("../../scenes/load_cases/rollers_and_balls.csv");
/// Maximum number of refused lines listed in the window. The results list all of them.
const MOST_LISTED: usize = 50;
/// Height of the area below the table: the number of valid contacts and the list of refused lines.
const CHECK_HEIGHT: f32 = 100.0;
/// Maximum height of the list of refused lines.
const REFUSED_HEIGHT: f32 = 72.0;

/// Window of load cases with its table.
pub struct LoadCasesWindow {
    open: bool,
    /// Table as text.
    text: String,
    /// True to solve the contacts in full.
    full: bool,
    /// True to solve the contacts by the built-in reduced model.
    reduced: bool,
    /// Parsed table. `None` if the text is empty.
    parsed: Option<ParsedTable>,
}

/// Result of parsing a table. It is valid for one text and one document.
struct ParsedTable {
    text: String,
    /// Document whose contact provides missing quantities.
    document: Document,
    /// Load cases, each with its request or the reason why its line is refused.
    cases: Result<Vec<LoadCase>, CasesError>,
}

impl Default for LoadCasesWindow {
    fn default() -> Self {
        Self { open: false, text: String::new(), full: true, reduced: false, parsed: None }
    }
}

impl LoadCasesWindow {
    /// Returns true if the window is open.
    pub fn is_open(&self) -> bool {
        self.open
    }

    /// Opens the window with its last table.
    pub fn open(&mut self) {
        self.open = true;
    }

    /// Opens the window with a table.
    pub fn paste(&mut self, text: String) {
        self.text = text;
        self.open = true;
    }

    /// Closes the window and keeps the table.
    pub fn close(&mut self) {
        self.open = false;
    }

    /// Reads the table from a file. Does not open the window.
    ///
    /// # Errors
    /// If the file cannot be read.
    pub fn read(&mut self, path: &Path) -> Result<(), Refusal> {
        if let CaseTable::Text(text) = CaseTable::pasted(path)? {
            self.text = text;
        }
        Ok(())
    }

    /// Draws the window if it is open.
    pub fn ui(&mut self, ctx: &Context, document: &Document, commands: &mut Commands) {
        let mut open = self.open;
        let room = ctx.content_rect().size();
        let window = Window::new("Load cases").open(&mut open).collapsible(false);
        let size = vec2(0.6 * room.x, 0.65 * room.y);
        window.default_size(size).max_size(0.9 * room).default_pos(room.to_pos2() * 0.15).show(ctx, |ui| {
            self.table_ui(ui, commands);
            // The area has a fixed height, so that the buttons below do not move while the user types.
            let size = vec2(ui.available_width(), CHECK_HEIGHT);
            ui.allocate_ui_with_layout(size, Layout::top_down(Align::LEFT), |ui| {
                ui.set_min_height(CHECK_HEIGHT);
                self.check_ui(ui, document);
            });
            self.solve_ui(ui, document, commands);
        });
        self.open &= open;
    }

    /// Draws the instructions, the buttons that fill or clear the table, and the editable table.
    fn table_ui(&mut self, ui: &mut Ui, commands: &mut Commands) {
        ui.label(
            "One line of titles, then one contact per line. Open a CSV file, or paste cells from a spreadsheet. Units \
             are in titles or cells. Missing quantities are taken from the contact on the left.",
        );
        ui.horizontal(|ui| {
            if ui.button("Open CSV…").clicked() {
                commands.push(Command::Ask(Purpose::Cases));
            }
            if ui.button("Ten bearings, gears and rigs").on_hover_text("An example table").clicked() {
                EXAMPLE.clone_into(&mut self.text);
            }
            if ui.add_enabled(!self.text.is_empty(), Button::new("Clear")).clicked() {
                self.text.clear();
            }
        });
        let height = (ui.available_height() - 150.0).max(90.0);
        ScrollArea::both().id_salt("table of load cases").max_height(height).auto_shrink(false).show(ui, |ui| {
            let hint = "name;  radius [mm]; speed; load [N/mm]; oil;        temperature; srr\nshaft; 12;          3 m/s; \
                        300;         ISO VG 68; 60 °C;       5 %";
            let field = TextEdit::multiline(&mut self.text).code_editor().hint_text(hint).desired_rows(8);
            let field = ui.add(field.desired_width(f32::INFINITY).font(FontId::monospace(12.0)));
            super::controls::named(ui, field, "Table of load cases");
        });
    }

    /// Parses the table if it has changed. Draws the number of valid contacts and the refused lines with reasons.
    fn check_ui(&mut self, ui: &mut Ui, document: &Document) {
        if self.text.trim().is_empty() {
            self.parsed = None;
            return;
        }
        let kept = self.parsed.take().filter(|kept| kept.text == self.text && kept.document == *document);
        let parsed = self.parsed.insert(kept.unwrap_or_else(|| {
            let experiment = scene(document, String::new(), Vec::new()).experiment();
            let cases = CaseTable::Text(self.text.clone()).cases(&experiment, &|path| path.to_owned());
            ParsedTable { text: self.text.clone(), document: document.clone(), cases }
        }));
        match &parsed.cases {
            Err(refused) => message_ui(ui, &refused.to_string()),
            Ok(cases) => {
                let bad: Vec<_> = cases.iter().filter_map(|case| Some((case, case.request.as_ref().err()?))).collect();
                let color = if bad.is_empty() { Palette::of(ui).verified } else { Palette::of(ui).warning };
                let good = cases.len() - bad.len();
                ui.colored_label(color, format!("{good} contacts can be solved, {} lines are refused", bad.len()));
                ScrollArea::vertical()
                    .id_salt("refused lines")
                    .max_height(REFUSED_HEIGHT)
                    .auto_shrink([false, true])
                    .show(ui, |ui| {
                        for (LoadCase { line, name, .. }, why) in bad.into_iter().take(MOST_LISTED) {
                            let name = if name.is_empty() { String::new() } else { format!(" ({name})") };
                            warning_ui(ui, &format!("Line {line}{name}: {why}"));
                        }
                    });
            }
        }
    }

    /// Returns the methods that the user selected.
    fn methods(&self) -> Vec<Method> {
        let methods = [(self.full, Method::Full), (self.reduced, Method::EMBEDDED)];
        methods.into_iter().filter_map(|(wanted, method)| wanted.then_some(method)).collect()
    }

    /// Draws the choice of methods, and the buttons that solve the table or open it as a scene.
    fn solve_ui(&mut self, ui: &mut Ui, document: &Document, commands: &mut Commands) {
        let cases = self.parsed.as_ref().and_then(|parsed| parsed.cases.as_ref().ok());
        let good = cases.map_or(0, |cases| cases.iter().filter(|case| case.request.is_ok()).count());
        ui.horizontal(|ui| {
            ui.add(Checkbox::new(&mut self.full, "Full")).on_hover_text("Full solutions, as `solve` returns them");
            let tip = "By the built-in reduced model. Results outside its trained range carry a warning";
            ui.add(Checkbox::new(&mut self.reduced, "Reduced")).on_hover_text(tip);
            let ready = good > 0 && (self.full || self.reduced);
            if ui.add_enabled(ready, Button::new("Solve all")).clicked() {
                let methods = self.methods();
                commands.push(Command::SolveCases(Arc::new(scene(document, self.text.clone(), methods))));
                self.open = false;
            }
            let tip = "Opens the table as a scene that can be saved, in place of the present one";
            if ui.add_enabled(ready, Button::new("Open as a scene")).on_hover_text(tip).clicked() {
                commands.push(Command::OpenScene(Arc::new(scene(document, self.text.clone(), self.methods()))));
                self.open = false;
            }
            ui.weak("The Results tab shows the table and exports it as CSV");
        });
    }
}

/// Returns a scene with the title and the study of `of`. Quantities that its load cases do not state are those of the
/// document's contact.
pub fn scene_like(document: &Document, of: &Scene) -> Scene {
    Scene { title: of.title.clone(), study: of.study.clone(), ..scene(document, String::new(), Vec::new()) }
}

/// Returns the scene that solves a table. Quantities missing in a line are taken from the document's contact.
fn scene(document: &Document, text: String, methods: Vec<Method>) -> Scene {
    Scene {
        title: "Load cases".to_owned(),
        source: String::new(),
        at: At::from(document.point),
        study: Study::LoadCases(LoadCases { cases: CaseTable::Text(text), methods }),
        expect: Vec::new(),
        ..document.to_scene()
    }
}
