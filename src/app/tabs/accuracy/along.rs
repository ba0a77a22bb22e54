//! The reduced model along the test trajectory (3.21), and its error against full solutions.

use super::random_tests::trained_range;
use super::{AccuracyView, CONTACT_COLUMNS, Running, contact_cells, count, progress, run_or_stop, stale_note};
use crate::app::answers::jobs::wake;
use crate::app::command::Command;
use crate::app::context::{Commands, Context};
use crate::app::controls::message_ui;
use crate::app::export;
use crate::app::in_use::{InUse, Solvers};
use crate::app::tabs::axes;
use crate::app::theme::{FULL_WIDTH, LIVE_WIDTH, Palette, rich};
use crate::engine::Store;
use crate::engine::job::{Background, Ending, Job, Reporter};
use crate::scene::QuantityBox;
use crate::solver::full::{Problem, Solution, Start};
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::reduced::Trust;
use crate::solver::training::Range;
use egui::{Color32, ComboBox, Id, Ui, Vec2b};
use egui_plot::{Corner, Legend, Line, LineStyle, PlotUi, VLine};
use std::f64::consts::PI;

/// Where the trajectory runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
enum Through {
    /// Table 3.1's or 3.4's box, as in the dissertation.
    #[default]
    Dissertation,
    /// What the model was trained for.
    Trained,
}

impl Through {
    fn name(self, kind: ContactKind) -> &'static str {
        match (self, kind) {
            (Self::Dissertation, ContactKind::Line) => "Table 3.1’s box",
            (Self::Dissertation, ContactKind::Point) => "Table 3.4’s box",
            (Self::Trained, _) => "the trained range",
        }
    }
}

#[derive(Clone, Copy, PartialEq)]
struct Plan {
    through: Through,
    points: usize,
}

/// One contact of the trajectory.
#[derive(Clone, Copy)]
struct Step {
    c: f64,
    /// `None` where the range excludes the place.
    point: Option<OperatingPoint>,
    trained: bool,
    reduced: Option<f64>,
    bound: Option<f64>,
    full: Option<f64>,
}

impl Step {
    fn error(&self) -> Option<f64> {
        Some((self.reduced? / self.full? - 1.0).abs())
    }
}

struct Results {
    in_use: InUse,
    plan: Plan,
    steps: Vec<Step>,
}

/// State of the view.
pub struct Along {
    plan: Plan,
    work: Background<Step>,
    results: Option<Results>,
}

impl Default for Along {
    fn default() -> Self {
        Self { plan: Plan { through: Through::default(), points: 201 }, work: Background::default(), results: None }
    }
}

impl Along {
    /// Takes in what came.
    pub fn receive(&mut self) {
        if let Some(results) = &mut self.results {
            self.work.receive(|step| results.steps.push(step));
        }
    }

    /// The run under way.
    pub fn task(&self) -> Option<&dyn Running> {
        self.work.job().map(|job| job as &dyn Running)
    }

    fn start(&mut self, ctx: &egui::Context, store: &Store, in_use: &InUse) {
        let plan = self.plan;
        self.results = Some(Results { in_use: in_use.clone(), plan, steps: Vec::new() });
        let (store, in_use) = (store.clone(), in_use.clone());
        self.work.run(Job::start("Trajectory", wake(ctx), move |reporter| work(&store, &in_use, plan, reporter)));
    }
}

/// The contact of (3.21) at c in a range: in a box of SI quantities the dissertation's, in others the same waves of its
/// coordinates.
fn contact(range: &Range, kind: ContactKind, c: f64) -> Option<OperatingPoint> {
    let wave = |halves: f64| 0.5 + 0.5 * (halves * PI * c).sin();
    range.at(kind, [3.0, 4.0, 5.0, 2.0].map(wave))
}

fn range_of(in_use: &InUse, through: Through) -> Range {
    match through {
        Through::Trained => trained_range(&in_use.model),
        Through::Dissertation => Range::Box(QuantityBox::of_tables(in_use.model.contact())),
    }
}

/// Each full solution starts from its neighbour on the path, never from a reduced one.
fn work(store: &Store, in_use: &InUse, plan: Plan, reporter: &Reporter<Step>) -> Ending {
    let lubricant = in_use.model.domain.lubricant;
    let range = range_of(in_use, plan.through);
    let mut solvers = Solvers::new(store, in_use);
    let mut former: Option<Solution> = None;
    for i in 0..plan.points {
        let c = 2.0 * i as f64 / (plan.points - 1) as f64;
        let mut step = Step {
            c,
            point: contact(&range, in_use.model.contact(), c),
            trained: false,
            reduced: None,
            bound: None,
            full: None,
        };
        if let Some(point) = &step.point {
            let problem = Problem::new(point, lubricant).map_err(|error| error.to_string())?;
            step.trained = in_use.model.trust(&problem) == Trust::Trained;
            if let Ok((solution, scalars)) = solvers.reduced(point, lubricant) {
                step.reduced = Some(scalars.h_c);
                step.bound = solution.error.map(|e| e.h_c.bound);
            }
            let start = former.as_ref().map_or(Start::Cold, Start::From);
            let full = solvers.full(point, lubricant, start, reporter);
            let full = full.map_err(|error| error.to_string())?;
            step.full = full.as_ref().map(|solution| solution.scalars.h_c);
            former = full.or(former);
        }
        if reporter.cancelled() {
            break;
        }
        reporter.send(step);
        reporter.stage("Trajectory", i + 1, plan.points);
    }
    Ok(())
}

/// The view.
pub fn ui(ui: &mut Ui, own: &mut AccuracyView, context: &Context<'_>, commands: &mut Commands, in_use: &InUse) {
    let ctx = ui.ctx().clone();
    let along = &mut own.along;
    let kind = in_use.model.contact();
    let mut export_now = false;
    ui.horizontal_wrapped(|ui| {
        let through = ui.label("Through").on_hover_text("The range in which the parameters swing by (3.21)");
        let choice = ComboBox::from_id_salt("through").selected_text(along.plan.through.name(kind)).show_ui(ui, |ui| {
            for option in [Through::Dissertation, Through::Trained] {
                ui.selectable_value(&mut along.plan.through, option, option.name(kind));
            }
        });
        choice.response.labelled_by(through.id);
        count(ui, "Contacts", "Equidistant values of c from 0 to 2", &mut along.plan.points, 11..=1001);
        if run_or_stop(ui, "Follow the trajectory", "Reduced and full solutions along it", along.task()) {
            along.start(&ctx, &context.answers.store, in_use);
        }
        let there = along.results.as_ref().is_some_and(|r| !r.steps.is_empty());
        let button = ui.add_enabled(there, egui::Button::new("Export CSV…"));
        export_now = button.on_hover_text("Every contact with both films, bound and true error").clicked();
        progress(ui, along.task());
    });
    if let Some(message) = &along.work.message {
        message_ui(ui, message);
    }
    let Some(results) = &along.results else {
        super::nothing_yet(ui, "Follow the trajectory to see film and error along it");
        return;
    };
    let stale = results.in_use != *in_use;
    if stale {
        stale_note(ui, &results.in_use);
    }
    ui.label(rich(&summary(results), 13.5, Palette::of(ui).quiet));
    super::bound_note(ui, results.steps.iter().map(|s| s.bound));
    film_plot(ui, results, stale, 0.4 * ui.available_height());
    error_plot(ui, results, stale, (ui.available_height() - 4.0).max(110.0));
    if export_now {
        let text = csv(results);
        commands.push(Command::csv(text));
    }
}

fn summary(results: &Results) -> String {
    let Results { plan, steps, .. } = results;
    let solved = steps.iter().filter(|s| s.point.is_some());
    let failures = solved.clone().filter(|s| s.reduced.is_none()).count();
    let outside = solved.filter(|s| !s.trained).count();
    let excluded = steps.iter().filter(|s| s.point.is_none()).count();
    let worst = steps.iter().filter_map(Step::error).fold(0.0, f64::max);
    let mut text = format!(
        "{} of {} contacts through {}, {failures} failures, largest error of {{H_c}} {}",
        steps.len(),
        plan.points,
        plan.through.name(results.in_use.model.contact()),
        crate::app::numbers::error_percent(worst)
    );
    if outside > 0 {
        text.push_str(&format!(", {outside} outside the trained range"));
    }
    if excluded > 0 {
        text.push_str(&format!(", {excluded} left out beyond its largest pressure"));
    }
    text
}

/// Unbroken pieces of a quantity along the path.
fn pieces(steps: &[Step], value: impl Fn(&Step) -> Option<f64>) -> Vec<Vec<[f64; 2]>> {
    let mut pieces = vec![Vec::new()];
    for step in steps {
        match (value(step), pieces.last_mut()) {
            (Some(v), Some(piece)) => piece.push([step.c, v]),
            _ => pieces.push(Vec::new()),
        }
    }
    pieces.retain(|piece| !piece.is_empty());
    pieces
}

fn draw(plot: &mut PlotUi<'_>, name: &str, pieces: Vec<Vec<[f64; 2]>>, look: (Color32, f32, LineStyle)) {
    for (k, piece) in pieces.into_iter().enumerate() {
        let line = Line::new(name, piece).color(look.0).width(look.1).style(look.2);
        plot.line(line.id((name, k)));
    }
}

fn linked<'a>(ui: &Ui, id: &str, height: f32, x_title: &str, y_title: &str) -> egui_plot::Plot<'a> {
    axes::plot(ui, id, height, x_title, y_title)
        .link_axis(Id::unique("trajectory"), Vec2b::new(true, false))
        .link_cursor(Id::unique("trajectory"), Vec2b::new(true, false))
        .auto_bounds(Vec2b::TRUE)
        .legend(Legend::default().position(Corner::RightTop).follow_insertion_order(true).background_alpha(0.6))
}

fn film_plot(ui: &mut Ui, results: &Results, stale: bool, height: f32) {
    let palette = Palette::of(ui);
    let color = if stale { palette.reference } else { palette.film };
    let full = if stale { palette.reference } else { palette.over(palette.film) };
    axes::show(
        linked(ui, "trajectory film", height.max(90.0), "", "Film {H_c}").include_y(0.0),
        ui,
        "Film along the trajectory",
        |plot| {
            draw(plot, "Reduced model", pieces(&results.steps, |s| s.reduced), (color, LIVE_WIDTH, LineStyle::Solid));
            draw(plot, "Full solution", pieces(&results.steps, |s| s.full), (full, FULL_WIDTH, LineStyle::Solid));
        },
    );
}

fn error_plot(ui: &mut Ui, results: &Results, stale: bool, height: f32) {
    let palette = Palette::of(ui);
    let grey = |color| if stale { palette.reference } else { color };
    // Smaller errors are the full solver's own tolerance, and zero has no logarithm.
    let log = |value: Option<f64>| value.map(|v| v.max(1e-12).log10());
    axes::show(
        linked(ui, "trajectory error", height, "{c}", "Relative error of {H_c}")
            .y_grid_spacer(axes::decade_marks)
            .y_axis_formatter(|mark, _| axes::decade_label(mark)),
        ui,
        "Error along the trajectory",
        |plot| {
            let truth = pieces(&results.steps, |s| log(s.error()));
            draw(plot, "True error", truth, (grey(palette.film), 1.8, LineStyle::Solid));
            let bound = pieces(&results.steps, |s| log(s.bound));
            draw(plot, "Bound", bound, (grey(palette.accent), 1.2, LineStyle::dashed_dense()));
            let failed = results.steps.iter().filter(|s| s.point.is_some() && s.reduced.is_none());
            for (k, step) in failed.enumerate() {
                plot.vline(VLine::new("failed", step.c).color(grey(palette.wrong)).width(1.0).id(("failed", k)));
            }
        },
    );
}

fn csv(results: &Results) -> String {
    let comments = [
        results.in_use.describe(),
        format!(
            "trajectory (3.21) through {}",
            results.plan.through.name(results.in_use.model.contact()).replace('’', "'")
        ),
    ];
    let own = ["trained", "H_c", "H_c_full", "H_c_error_bound", "H_c_error"];
    let header: Vec<&str> = ["c"].into_iter().chain(CONTACT_COLUMNS).chain(own).collect();
    let rows = results.steps.iter().map(|step| {
        let mut row = vec![Some(step.c)];
        row.extend(step.point.as_ref().map_or([None; 8], |point| contact_cells(point).map(Some)));
        row.extend([Some(f64::from(u8::from(step.trained))), step.reduced, step.full, step.bound, step.error()]);
        row
    });
    export::csv(&comments, &header, rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_path_is_the_dissertations_and_gaps_break_lines() {
        let range = Range::Box(QuantityBox::TABLE_3_1);
        for c in [0.0, 0.37, 1.9] {
            assert_eq!(
                contact(&range, ContactKind::Line, c),
                Some(QuantityBox::TABLE_3_1.trajectory(ContactKind::Line, c))
            );
        }
        let step = |c, reduced| Step { c, point: None, trained: true, reduced, bound: None, full: None };
        let steps =
            [step(0.0, Some(1.0)), step(0.1, None), step(0.2, None), step(0.3, Some(2.0)), step(0.4, Some(3.0))];
        assert_eq!(pieces(&steps, |s| s.reduced), [vec![[0.0, 1.0]], vec![[0.3, 2.0], [0.4, 3.0]]]);
    }
}
