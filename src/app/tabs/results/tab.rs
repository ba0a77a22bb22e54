//! Results tab: results of any scene. Its study runs in the engine as from the command line, and charts, tables and
//! verdicts are updated while it runs.

use super::columns::ShownColumn;
use super::run::{Campaign, Look, Run};
use super::{chart, contact, table};
use crate::app::command::Command;
use crate::app::context::{Commands, Context};
use crate::app::controls::{either_button, message_ui, named, standing_ui, warning_ui};
use crate::app::document::Document;
use crate::app::drawn::{self, Owner};
use crate::app::numbers;
use crate::app::tabs::{About, Offer, View};
use crate::app::theme::{Palette, rich};
use crate::engine::Workbench;
use crate::engine::job::{Standing, Wake};
use crate::scene::{Chart, ChartAxis, Marks, Method, Scene, Study, Table, Verdict};
use crate::solver::physics::engineering::UnitSystem;
use egui::{ComboBox, Grid, Label, RichText, ScrollArea, Ui};
use std::path::PathBuf;

/// Width of the verdicts next to the charts.
const VERDICTS: f32 = 330.0;

/// Tooltip of the button that runs the study.
const RUN_TIP: &str = "Runs the study of the open scene, as “ehl-explorer run” does without a window";

/// Displayed part of the results.
#[derive(Clone, Debug, PartialEq, Eq)]
enum ResultsChoice {
    Charts,
    /// A table, by its name.
    Table(String),
    /// A column of a table along its lines, by the name of the table and the number of the column.
    Column(String, usize),
}

/// Results tab: its run and the displayed part.
pub struct Results {
    run: Option<Run>,
    /// Document of the last frame with its scene.
    seen: Option<(Document, Scene)>,
    /// True if the study is not that of the document, but a table of load cases.
    of_cases: bool,
    shown: ResultsChoice,
    fresh: bool,
}

impl Default for Results {
    fn default() -> Self {
        Self { run: None, seen: None, of_cases: false, shown: ResultsChoice::Charts, fresh: true }
    }
}

impl Results {
    /// Runs the study of a scene on a bench.
    pub fn start(&mut self, scene: Scene, bench: Workbench, wake: Wake) {
        let shown = match scene.study {
            // The table of the load cases is the main result.
            Study::LoadCases(_) => ResultsChoice::Table("load_cases".to_owned()),
            _ => ResultsChoice::Charts,
        };
        *self = Self { run: Some(Run::start(scene, bench, wake)), shown, ..Self::default() };
    }

    /// Solves a table of load cases. The document keeps its study.
    pub fn solve_cases(&mut self, scene: Scene, bench: Workbench, wake: Wake) {
        self.start(scene, bench, wake);
        self.of_cases = true;
    }

    /// Watches a campaign of a scene. Charts and tables are updated as its shards arrive.
    pub fn watch(&mut self, scene: Scene, folder: PathBuf, wake: Wake) {
        *self = Self { run: Some(Run::watch(scene, folder, wake)), ..Self::default() };
    }

    /// Discards the run, because another scene is on the screen.
    pub fn forget(&mut self) {
        *self = Self::default();
    }

    /// Returns the progress of the running study.
    pub fn standing(&self) -> Option<Standing> {
        self.run.as_ref()?.standing()
    }

    /// Returns true if a study runs whose rows are stored nowhere else.
    pub fn would_lose(&self) -> bool {
        self.run.as_ref().is_some_and(|run| run.campaign.is_none() && run.standing().is_some())
    }

    /// Returns whether all expectations are met. `None` before the study is complete.
    pub fn verdict(&self) -> Option<bool> {
        let look = self.run.as_ref()?.look.as_ref().filter(|look| look.complete)?;
        Some(look.outcome.passed())
    }

    /// Returns a table of the last evaluation by its name.
    pub fn table(&self, name: &str) -> Option<&Table> {
        self.run.as_ref()?.look.as_ref()?.table(name)
    }

    fn scene_ui(&mut self, ui: &mut Ui, scene: &Scene, context: &Context<'_>, commands: &mut Commands) {
        // A table of load cases is solved without becoming the scene of the document.
        let of = self.run.as_ref().filter(|_| self.of_cases).map_or(scene, |run| &run.scene);
        let title = if of.title.is_empty() { "Results" } else { &of.title };
        ui.horizontal_wrapped(|ui| {
            ui.heading(title);
            if !of.source.is_empty() {
                ui.weak(&of.source);
            }
        });
        self.toolbar(ui, context.system, commands);
        if let Some(why) = context.document.lost_question() {
            let title = &context.document.title;
            warning_ui(ui, &format!("The study of “{title}” is replaced by the contact itself: {why}"));
        }
        let Some(run) = &self.run else {
            ui.separator();
            contact::ui(ui, context);
            return;
        };
        if let Some(campaign) = &run.campaign {
            campaign_ui(ui, campaign);
        }
        if let Some(message) = run.message() {
            message_ui(ui, message);
        }
        let owner = Box::new(run.scene.clone());
        let owner = if self.of_cases { Owner::Cases(owner) } else { Owner::Question(owner) };
        let changed = drawn::is_grey(ui.ctx(), "results of a study", owner, context);
        if changed {
            warning_ui(ui, "These results belong to a previous state of the scene, which has changed since");
        }
        ui.separator();
        let Some(look) = &run.look else {
            ui.weak("There are no results yet");
            return;
        };
        if changed {
            drawn::fade(ui, false);
        }
        let fresh = std::mem::take(&mut self.fresh);
        let whole = ui.available_size();
        let beside = whole.x > 2.0 * VERDICTS;
        if beside {
            ui.horizontal_top(|ui| {
                let width = ui.available_width() - VERDICTS - 12.0;
                ui.vertical(|ui| {
                    ui.set_min_height(whole.y);
                    ui.set_max_width(width);
                    shown_ui(ui, look, (&self.shown, context.system), fresh);
                });
                ui.separator();
                ui.vertical(|ui| verdicts_ui(ui, look));
            });
        } else {
            ui.allocate_ui(egui::vec2(whole.x, 0.6 * whole.y), |ui| {
                shown_ui(ui, look, (&self.shown, context.system), fresh);
            });
            ui.separator();
            verdicts_ui(ui, look);
        }
    }

    fn toolbar(&mut self, ui: &mut Ui, system: UnitSystem, commands: &mut Commands) {
        ui.horizontal_wrapped(|ui| {
            let standing = self.standing();
            let runs = standing.is_some();
            let tip = if runs { "Keeps the results so far (Esc)" } else { RUN_TIP };
            let watches = self.run.as_ref().is_some_and(|run| run.campaign.is_some());
            let stop = if watches { "Stop watching" } else { "Stop" };
            if either_button(ui, ["Run the study", stop], runs).on_hover_text(tip).clicked() {
                if runs {
                    self.stop();
                } else {
                    commands.push(Command::RunStudy);
                }
            }
            if self.run.is_none() {
                ui.weak("This contact");
                return;
            }
            let look = self.run.as_ref().and_then(|run| run.look.as_ref());
            let tables: &[Table] = look.map_or(&[], |look| &look.outcome.tables);
            let text = match &self.shown {
                ResultsChoice::Charts => "Charts".to_owned(),
                ResultsChoice::Table(name) => format!("Table {name}"),
                ResultsChoice::Column(..) => "Column along the lines".to_owned(),
            };
            let mut chosen = self.shown.clone();
            let combo = ComboBox::from_id_salt("shown of results").selected_text(text).width(180.0).show_ui(ui, |ui| {
                ui.selectable_value(&mut chosen, ResultsChoice::Charts, "Charts");
                for table in tables {
                    let name = table.name.clone();
                    ui.selectable_value(&mut chosen, ResultsChoice::Table(name.clone()), format!("Table {name}"));
                }
            });
            named(ui, combo.response, "Shown of the results");
            if let ResultsChoice::Table(name) | ResultsChoice::Column(name, _) = &chosen
                && let Some(of) = tables.iter().find(|table| table.name == *name)
                && let Some(column) = column_ui(ui, of, &chosen, system)
            {
                (chosen, self.fresh) = (ResultsChoice::Column(name.clone(), column), true);
            }
            self.shown = chosen;
            standing_ui(ui, standing, "Progress of the study");
        });
    }
}

const ABOUT: About = About {
    keywords: "study scene run expectations verdicts table report",
    page: "scenes.md",
    has_units: false,
    why: "A scene is an experiment with a question, and this tab shows its results while they are computed. The values \
          that the scene expects, with their sources, are listed next to the results. The same scene gives the same \
          numbers from the command line.",
};

impl View for Results {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn ui(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        let document = context.document;
        let seen = self.seen.take().filter(|seen| seen.0 == *document);
        let seen = seen.unwrap_or_else(|| (document.clone(), document.to_scene()));
        self.scene_ui(ui, &seen.1, context, commands);
        self.seen = Some(seen);
    }

    fn offers<'a>(&'a self, context: &Context<'a>) -> Vec<Offer<'a>> {
        if self.run.is_none() {
            let text = contact::csv(context);
            return vec![Offer::table(
                "Table as CSV…",
                "The table of this contact, with all digits",
                text,
                String::clone,
            )];
        }
        let look = self.run.as_ref().and_then(|run| run.look.as_ref());
        let table = match &self.shown {
            ResultsChoice::Table(name) | ResultsChoice::Column(name, _) => look.and_then(|look| look.table(name)),
            ResultsChoice::Charts => look.and_then(|look| look.outcome.tables.first()),
        };
        vec![Offer::table("Table as CSV…", "The table that is chosen, or the first one", table, |table| {
            table.to_csv()
        })]
    }

    fn receive(&mut self) {
        if let Some(run) = &mut self.run {
            run.receive();
        }
    }

    fn jobs(&self, _: &Context<'_>) -> Vec<Standing> {
        self.standing().into_iter().collect()
    }

    fn stop(&mut self) {
        if let Some(run) = &self.run {
            run.stop();
        }
    }
}

/// Draws the progress of a campaign and the failures of shards. The two lines are always present, so that nothing
/// moves after a failure.
fn campaign_ui(ui: &mut Ui, campaign: &Campaign) {
    let palette = Palette::of(ui);
    let folder = campaign.folder.display();
    let (text, failed) = match &campaign.status {
        None => (format!("Campaign: reading {folder}"), [].as_slice()),
        Some(status) => {
            let left = match status.left_s.filter(|_| !status.open.is_empty()) {
                Some(left) => format!(", {} of processor time left in it", numbers::duration(left)),
                None => String::new(),
            };
            let merged = if status.merged { "; merged" } else { "" };
            let (done, shards, round) = (status.done, status.shards, status.rounds);
            let text = format!("Campaign: {done} of {shards} shards complete, round {round}{left}{merged}");
            (text, status.failed.as_slice())
        }
    };
    ui.add(Label::new(text).truncate()).on_hover_text(folder.to_string());
    let named = |(shard, reason): &(usize, String)| format!("Shard {shard} failed: {reason}");
    // A space keeps the line.
    let first = failed.first().map_or(" ".to_owned(), named);
    let more = if failed.len() > 1 { format!(" (and {} more)", failed.len() - 1) } else { String::new() };
    let line = ui.add(Label::new(rich(&format!("{first}{more}"), 11.0, palette.warning)).truncate());
    if !failed.is_empty() {
        let all: Vec<String> = failed.iter().take(NAMED_FAILURES).map(named).collect();
        line.on_hover_text(all.join("\n"));
    }
}

/// Maximum number of failed shards listed on hover.
const NAMED_FAILURES: usize = 12;

fn shown_ui(ui: &mut Ui, look: &Look, (shown, system): (&ResultsChoice, UnitSystem), fresh: bool) {
    match shown {
        ResultsChoice::Table(name) => match look.table(name) {
            Some(of) => table::ui(ui, of, system),
            None => _ = ui.weak("There is no such table yet"),
        },
        ResultsChoice::Column(name, column) => {
            match look.table(name).and_then(|of| column_chart(of, *column, system)) {
                Some(of) => {
                    let height = ui.available_height() - 4.0;
                    chart::ui(ui, &format!("column {column} of {name} {system:?}"), &of, height, fresh);
                }
                None => _ = ui.weak("There is no such column yet"),
            }
        }
        ResultsChoice::Charts => {
            let charts: Vec<_> = look.charts.iter().filter(|chart| !chart.series.is_empty()).collect();
            if charts.is_empty() {
                match look.outcome.tables.first() {
                    Some(first) => table::ui(ui, first, system),
                    None => _ = ui.weak("There is no chart yet"),
                }
                return;
            }
            let room = ui.available_height();
            let height = (room / charts.len().min(2) as f32 - 26.0).max(150.0);
            ScrollArea::vertical().id_salt("charts of results").auto_shrink(false).show(ui, |ui| {
                for (k, of) in charts.into_iter().enumerate() {
                    ui.label(RichText::new(&of.title).strong());
                    chart::ui(ui, &format!("chart {k} of results"), of, height, fresh);
                }
            });
        }
    }
}

/// Draws the choice of a column to plot. Returns the column that was chosen.
fn column_ui(ui: &mut Ui, table: &Table, shown: &ResultsChoice, system: UnitSystem) -> Option<usize> {
    let title = |column: usize| {
        let name = table.columns.get(column).map_or("", String::as_str);
        ShownColumn::of(name, system).title.replace(['{', '}'], "")
    };
    let present = if let ResultsChoice::Column(_, column) = shown { Some(*column) } else { None };
    let text = present.map_or_else(|| "Plot a column".to_owned(), title);
    let mut chosen = None;
    let combo = ComboBox::from_id_salt("plotted column").selected_text(text).width(170.0).show_ui(ui, |ui| {
        for column in 0..table.columns.len() {
            if ui.selectable_label(present == Some(column), title(column)).clicked() {
                chosen = Some(column);
            }
        }
    });
    named(ui, combo.response, "Plotted column").on_hover_text("Plots a column along the lines of the table");
    chosen
}

/// Returns a chart of a column along the lines of a table. `None` if there is no such column.
fn column_chart(table: &Table, column: usize, system: UnitSystem) -> Option<Chart> {
    let shown = ShownColumn::of(table.columns.get(column)?, system);
    let title = shown.title.replace(['{', '}'], "");
    let mut chart = Chart::new(&title, ChartAxis::linear("Line"), ChartAxis::linear(&title));
    let value = |row: &Vec<f64>| row.get(column).map(|value| shown.number(*value)).filter(|value| value.is_finite());
    let points = |k: usize, row: &Vec<f64>| Some([(k + 1) as f64, value(row)?]);
    let points: Vec<[f64; 2]> = table.rows.iter().enumerate().filter_map(|(k, row)| points(k, row)).collect();
    chart.add("", Marks::Line, points.iter().copied());
    chart.add(title, Marks::Dots, points);
    Some(chart)
}

fn verdicts_ui(ui: &mut Ui, look: &Look) {
    let palette = Palette::of(ui);
    let outcome = &look.outcome;
    let held = outcome.verdicts.iter().filter(|verdict| verdict.holds).count();
    ScrollArea::vertical().id_salt("verdicts").auto_shrink(false).show(ui, |ui| {
        ui.strong("Expectations");
        let (text, color) = match (look.complete, outcome.verdicts.len()) {
            (false, _) => (format!("Not complete yet: {} rows", look.rows), palette.quiet),
            (true, 0) if outcome.passed() => ("The scene expects nothing; all converged".to_owned(), palette.verified),
            (true, 0) => ("Some solves did not converge".to_owned(), palette.warning),
            (true, all) if outcome.passed() => (format!("All {all} hold"), palette.verified),
            (true, all) if held == all => ("All hold, but some solves did not converge".to_owned(), palette.warning),
            (true, all) => (format!("{held} of {all} hold"), palette.warning),
        };
        ui.colored_label(color, text);
        Grid::new("expectations").num_columns(3).striped(true).spacing([8.0, 3.0]).show(ui, |ui| {
            for verdict in &outcome.verdicts {
                verdict_ui(ui, verdict, look.complete, &palette);
            }
        });
        for warning in &outcome.found.warnings {
            warning_ui(ui, &warning.to_string());
        }
        if outcome.verdicts.is_empty() {
            ui.add_space(4.0);
            Grid::new("values").num_columns(2).striped(true).spacing([8.0, 3.0]).show(ui, |ui| {
                for value in &outcome.found.values {
                    ui.label(of_method(&value.name, value.method.as_ref()));
                    ui.label(numbers::counted(value.value));
                    ui.end_row();
                }
            });
        }
    });
}

fn verdict_ui(ui: &mut Ui, verdict: &Verdict, complete: bool, palette: &Palette) {
    let (mark, color) = match (verdict.holds, complete) {
        (true, _) => ("holds", palette.verified),
        (false, true) => ("short", palette.warning),
        (false, false) => ("open", palette.quiet),
    };
    ui.label(rich(mark, 11.0, color));
    let expected = &verdict.expected;
    let tip = format!("Expected {}; {}", expected.wanted(), expected.from);
    ui.label(of_method(&expected.name, expected.method.as_ref())).on_hover_text(&tip);
    let value = verdict.value.map_or_else(|| "–".to_owned(), numbers::counted);
    ui.label(value).on_hover_text(tip);
    ui.end_row();
}

fn of_method(name: &str, method: Option<&Method>) -> String {
    method.map_or_else(|| name.to_owned(), |method| format!("{name}, {}", method.name()))
}
