//! Results tab: charts, tables and verdicts of the study of a scene, updated while the study runs. The study runs in
//! the engine, as from the command line. The tab can also show a campaign in a folder or the runs of the Transient tab.

use super::column::PlottedColumn;
use super::run::{Campaign, Look, Run};
use super::{chart, contact, measured, table, verdicts};
use crate::app::command::Command;
use crate::app::context::{Commands, Context};
use crate::app::controls::{either_button, message_ui, named, standing_ui, warning_ui};
use crate::app::document::Document;
use crate::app::drawn::{self, Owner};
use crate::app::numbers;
use crate::app::tabs::{About, Offer, View};
use crate::app::theme::{Palette, rich};
use crate::app::wake::wake;
use crate::engine::Workbench;
use crate::engine::job::{Standing, Wake};
use crate::scene::{Chart, Scene, Study, Table};
use egui::{ComboBox, Label, RichText, ScrollArea, Ui};
use std::path::PathBuf;
use std::sync::Arc;

/// Width of the verdicts next to the charts, in screen points.
const VERDICTS_WIDTH: f32 = 330.0;

/// Tooltip of the button that runs the study.
const RUN_TIP: &str = "Runs the study of the open scene, as “ehl-explorer run” does without a window";

/// Displayed part of the results.
#[derive(Clone, Debug, PartialEq, Eq)]
enum ResultsChoice {
    /// All charts of the study.
    Charts,
    /// A table, by its name.
    Table(String),
    /// Plot of a column of a table.
    Column(PlottedColumn),
}

impl ResultsChoice {
    /// Returns the name of the table that is shown or plotted. `None` for the charts.
    fn table(&self) -> Option<&str> {
        match self {
            Self::Charts => None,
            Self::Table(name) => Some(name),
            Self::Column(plotted) => Some(&plotted.table),
        }
    }
}

/// Results tab.
pub struct Results {
    /// Study whose results are shown. `None` to show the results of the contact only.
    run: Option<Run>,
    /// Document of the last frame and its scene, which is made again only if the document changes.
    seen: Option<(Document, Scene)>,
    /// True if the study is a table of load cases that is not part of the document.
    of_cases: bool,
    /// Number of the last study of the Transient tab when `run` was started. Only newer ones can replace `run`. `None`
    /// until the tab is drawn.
    older: Option<u64>,
    /// Displayed part of the results.
    shown: ResultsChoice,
    /// True if the charts must be fitted to their data in the next frame.
    fresh: bool,
}

impl Default for Results {
    fn default() -> Self {
        Self { run: None, seen: None, of_cases: false, older: None, shown: ResultsChoice::Charts, fresh: true }
    }
}

impl Results {
    /// Runs the study of a scene. `bench` computes its contacts, and `wake` is called after each new result.
    pub fn start(&mut self, scene: Scene, bench: Workbench, wake: Wake) {
        let shown = match scene.study {
            // The table of the load cases is the main result.
            Study::LoadCases(_) => ResultsChoice::Table("load_cases".to_owned()),
            _ => ResultsChoice::Charts,
        };
        *self = Self { run: Some(Run::start(scene, bench, wake)), shown, ..Self::default() };
    }

    /// Solves the table of load cases in a scene. The document and its own study do not change.
    pub fn solve_cases(&mut self, scene: Scene, bench: Workbench, wake: Wake) {
        self.start(scene, bench, wake);
        self.of_cases = true;
    }

    /// Shows a campaign: a study whose parts (shards) other processes compute and write to a folder. Charts and tables
    /// are updated when shards arrive.
    pub fn watch(&mut self, scene: Scene, folder: PathBuf, wake: Wake) {
        *self = Self { run: Some(Run::watch(scene, folder, wake)), ..Self::default() };
    }

    /// Discards the run and its results. Called when another scene is opened.
    pub fn forget(&mut self) {
        *self = Self::default();
    }

    /// Returns the progress of the running study. `None` if no study runs here.
    pub fn standing(&self) -> Option<Standing> {
        self.run.as_ref()?.standing()
    }

    /// Returns true if a study runs whose results are stored nowhere else.
    pub fn would_lose(&self) -> bool {
        self.run.as_ref().is_some_and(Run::would_lose)
    }

    /// Returns true if all expectations are met, and false if one is not. `None` if this is not known: before the study
    /// is complete, or after runs of the Transient tab that leave out an expected value.
    pub fn verdict(&self) -> Option<bool> {
        let run = self.run.as_ref()?;
        verdicts::passed(run.look.as_ref()?, run.follows().is_some())
    }

    /// Returns a table of the results by its name.
    pub fn table(&self, name: &str) -> Option<&Table> {
        self.run.as_ref()?.look.as_ref()?.table(name)
    }

    /// Shows the runs of the Transient tab if they are the study of `scene`. Runs that the user starts replace the
    /// present results. Automatic runs are shown only if no study has been run in this tab.
    fn follow(&mut self, ctx: &egui::Context, scene: &Scene, context: &Context<'_>) {
        let Some(recorded) = &context.transient.recorded else { return };
        let older = *self.older.get_or_insert(if self.run.is_some() { recorded.number } else { 0 });
        let follows = self.run.as_ref().and_then(Run::follows);
        if let Some(run) = self.run.as_mut().filter(|_| follows == Some(recorded.number)) {
            if run.take_over(recorded) {
                ctx.request_repaint();
            }
            return;
        }
        let newer = recorded.number > older && (recorded.by_hand || self.run.is_none() || follows.is_some());
        let present = || Owner::Transient(Arc::clone(&recorded.setup)).is_present(context);
        if newer && matches!(scene.study, Study::Transient(_)) && present() {
            let run = Run::follow(scene.clone(), recorded, wake(ctx));
            let shown = if follows.is_some() { self.shown.clone() } else { ResultsChoice::Charts };
            *self = Self { run: Some(run), older: Some(older), shown, ..Self::default() };
            ctx.request_repaint();
        }
    }

    /// Draws the title, the toolbar, warnings, and the results of the scene.
    fn scene_ui(&mut self, ui: &mut Ui, scene: &Scene, context: &Context<'_>, commands: &mut Commands) {
        // Load cases have their own title, because they are not part of the document.
        let of = self.run.as_ref().filter(|_| self.of_cases).map_or(scene, |run| &run.scene);
        let title = if of.title.is_empty() { "Results" } else { &of.title };
        ui.horizontal_wrapped(|ui| {
            ui.heading(title);
            if !of.source.is_empty() {
                ui.weak(&of.source);
            }
        });
        self.toolbar(ui, context, commands);
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
        let followed = context.transient.recorded.as_ref().filter(|recorded| run.follows() == Some(recorded.number));
        let owner = match followed {
            Some(recorded) => Owner::Transient(Arc::clone(&recorded.setup)),
            None if self.of_cases => Owner::Cases(Box::new(run.scene.clone())),
            None => Owner::Question(Box::new(run.scene.clone())),
        };
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
        let (fresh, partial) = (std::mem::take(&mut self.fresh), run.follows().is_some());
        let whole = ui.available_size();
        let beside = whole.x > 2.0 * VERDICTS_WIDTH;
        if beside {
            ui.horizontal_top(|ui| {
                let width = ui.available_width() - VERDICTS_WIDTH - 12.0;
                ui.vertical(|ui| {
                    ui.set_min_height(whole.y);
                    ui.set_max_width(width);
                    shown_ui(ui, look, &self.shown, (context, fresh));
                });
                ui.separator();
                ui.vertical(|ui| verdicts::ui(ui, look, partial));
            });
        } else {
            ui.allocate_ui(egui::vec2(whole.x, 0.6 * whole.y), |ui| {
                shown_ui(ui, look, &self.shown, (context, fresh));
            });
            ui.separator();
            verdicts::ui(ui, look, partial);
        }
    }

    /// Draws the button that runs or stops the study, the choice of the displayed part, and the progress.
    fn toolbar(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
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
            let Some(run) = &self.run else {
                ui.weak("This contact");
                return;
            };
            if run.follows().is_some() {
                let tip = "The runs of the Transient tab. Run the study also computes comparisons that they leave out";
                ui.weak("Transient runs").on_hover_text(tip);
            }
            let look = run.look.as_ref();
            let tables: &[Table] = look.map_or(&[], |look| &look.outcome.tables);
            let text = match &self.shown {
                ResultsChoice::Charts => "Charts".to_owned(),
                ResultsChoice::Table(name) => format!("Table {name}"),
                ResultsChoice::Column(_) => "Plot of a column".to_owned(),
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
            let plotted = if let ResultsChoice::Column(plotted) = &chosen { Some(plotted) } else { None };
            if let Some(of) = chosen.table().and_then(|name| tables.iter().find(|table| table.name == name))
                && let Some(plotted) = PlottedColumn::ui(ui, (of, &run.scene.study), plotted, context.system)
            {
                (chosen, self.fresh) = (ResultsChoice::Column(plotted), true);
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
        self.follow(ui.ctx(), &seen.1, context);
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
        let table = match self.shown.table() {
            Some(name) => look.and_then(|look| look.table(name)),
            None => look.and_then(|look| look.outcome.tables.first()),
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

/// Draws the progress of a campaign in one line and the failures of its shards in a second one. The second line is
/// present even without failures, so that nothing moves when a shard fails.
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
    // A text of one space keeps the height of the line.
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

/// Draws the chosen part of the results. `fresh` fits the charts to their data.
fn shown_ui(ui: &mut Ui, look: &Look, shown: &ResultsChoice, (context, fresh): (&Context<'_>, bool)) {
    let system = context.system;
    match shown {
        ResultsChoice::Table(name) => match look.table(name) {
            Some(of) => table::ui(ui, of, system),
            None => _ = ui.weak("There is no such table yet"),
        },
        ResultsChoice::Column(plotted) => {
            match look.table(&plotted.table).and_then(|of| plotted.chart(of, system, context.measured)) {
                Some((of, measured)) => {
                    let height = ui.available_height() - 4.0;
                    chart::ui(ui, &format!("{plotted:?} {system:?}"), (&of, &measured), height, fresh);
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
                    let measured = measured_of(of, look, context);
                    chart::ui(ui, &format!("chart {k} of results"), (of, &measured), height, fresh);
                }
            });
        }
    }
}

/// Returns the measured points of the document for the two quantities on the axes of a chart. Empty if the chart has no
/// such quantities.
fn measured_of(chart: &Chart, look: &Look, context: &Context<'_>) -> Vec<[f64; 2]> {
    match (&chart.quantities, look.outcome.tables.first()) {
        (Some([x, y]), Some(table)) if !context.measured.is_empty() => {
            measured::points([x, y], table, context.measured)
        }
        _ => Vec::new(),
    }
}
