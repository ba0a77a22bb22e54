//! View of the reduced model along the test trajectory (3.21), and of its error against full solutions.

use super::parts::{CONTACT_COLUMNS, contact_cells, count, run_or_stop, stale_note};
use crate::app::context::Context;
use crate::app::controls::{message_ui, standing_ui};
use crate::app::drawn::{self, Owner};
use crate::app::export;
use crate::app::figure::Canvas;
use crate::app::in_use::InUse;
use crate::app::plot::axes;
use crate::app::plot::frame::PlotFrame;
use crate::app::plot::key::{self, Entry, Sample};
use crate::app::theme::{FULL_WIDTH, LIVE_WIDTH, Palette, rich};
use crate::engine::Store;
use crate::engine::job::Background;
use crate::scene::names;
use crate::scene::study::PathRow;
use crate::scene::study::trajectory::Trajectory;
use crate::scene::{ContactResult, Method, Study, StudyRow};
use crate::solver::parameters::ParameterSpace;
use crate::solver::physics::contact::ContactKind;
use egui::{Color32, ComboBox, Id, Ui, Vec2b};
use egui_plot::{Line, LineStyle, VLine};

/// Range of the trajectory.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
enum Through {
    /// The range of Table 3.1 or 3.4, as in the dissertation.
    #[default]
    Dissertation,
    /// The trained range of the model.
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

/// Requested trajectory.
#[derive(Clone, Copy, PartialEq)]
struct Wanted {
    through: Through,
    points: usize,
}

/// Contact of the trajectory, solved by the reduced model and by the full solver.
pub struct Step(PathRow);

impl Step {
    /// Returns the path parameter c, 0 ≤ c ≤ 2.
    fn c(&self) -> f64 {
        self.0.values.first().copied().unwrap_or(f64::NAN)
    }

    /// Returns the result of the reduced model.
    fn by_model(&self) -> Option<&ContactResult> {
        self.0.results().first()
    }

    /// Returns H_c, the central film thickness, of the reduced model.
    fn reduced(&self) -> Option<f64> {
        Some(self.by_model()?.scalars?.h_c)
    }

    /// Returns H_c of the full solution.
    fn full(&self) -> Option<f64> {
        Some(self.0.results().get(1)?.scalars?.h_c)
    }

    /// Returns the error bound of H_c, relative.
    fn bound(&self) -> Option<f64> {
        Some(self.by_model()?.reduced.as_ref()?.error?.h_c.bound)
    }

    /// Returns true inside the trained range.
    fn trained(&self) -> bool {
        self.by_model().is_some_and(|result| !result.untrained())
    }

    /// Returns the relative error of H_c of the reduced model.
    fn error(&self) -> Option<f64> {
        Some((self.reduced()? / self.full()? - 1.0).abs())
    }
}

/// Results along a trajectory.
pub struct Followed {
    in_use: InUse,
    wanted: Wanted,
    /// True if it was started automatically.
    automatic: bool,
    /// Contacts so far.
    pub steps: Vec<Step>,
    /// True if further contacts may follow.
    running: bool,
}

/// State of the view.
pub struct Along {
    wanted: Wanted,
    /// Running study, and the reason why the last one ended early.
    pub work: Background<StudyRow>,
    /// Results so far.
    pub results: Option<Followed>,
}

impl Default for Along {
    fn default() -> Self {
        let wanted = Wanted { through: Through::default(), points: 201 };
        Self { wanted, work: Background::default(), results: None }
    }
}

impl Along {
    /// Receives results.
    pub fn receive(&mut self) {
        let Some(results) = &mut self.results else { return };
        self.work.receive(|row| {
            if let StudyRow::Trajectory(row) = row {
                results.steps.push(Step(row));
            }
        });
        results.running = self.work.job().is_some();
    }

    /// Starts a short trajectory automatically, unless the user has started one or the results are up to date.
    fn start_automatically(&mut self, ctx: &egui::Context, store: &Store, in_use: &InUse) {
        let through = self.wanted.through;
        let other = |results: &Followed| results.in_use != *in_use || results.wanted.through != through;
        if self.results.as_ref().is_none_or(|results| results.automatic && other(results)) {
            let points = if in_use.model.contact().is_line() { 41 } else { 11 };
            self.begin(ctx, store, in_use, (Wanted { through, points }, true));
        }
    }

    /// Stops and discards a trajectory that was started automatically. It starts again when the view is shown
    /// again.
    pub fn hide(&mut self) {
        if self.work.job().is_some() && self.results.as_ref().is_some_and(|results| results.automatic) {
            (self.results, self.work) = (None, Background::default());
        }
    }

    /// Starts the trajectory. The initial guess of each full solution is its neighbour on the path, never a reduced
    /// solution.
    fn begin(&mut self, ctx: &egui::Context, store: &Store, in_use: &InUse, (wanted, automatic): (Wanted, bool)) {
        self.results = Some(Followed { in_use: in_use.clone(), wanted, automatic, steps: Vec::new(), running: true });
        let range = match wanted.through {
            Through::Dissertation => ParameterSpace::of_tables(in_use.model.contact()),
            Through::Trained => in_use.trained_range(),
        };
        let methods = vec![in_use.method(), Method::Full];
        let study = Study::Trajectory(Trajectory { range, points: wanted.points, methods });
        let question = in_use.question("Trajectory", study).map_err(|why| why.to_string());
        self.work.start(question.map(|question| in_use.ask(ctx, store, question)));
    }
}

/// Draws the view.
pub fn ui(ui: &mut Ui, along: &mut Along, context: &Context<'_>, in_use: &InUse) {
    let ctx = ui.ctx().clone();
    along.start_automatically(&ctx, context.answers.store(), in_use);
    let kind = in_use.model.contact();
    ui.horizontal_wrapped(|ui| {
        let through = ui.label("Through").on_hover_text("The range in which the parameters vary by (3.21)");
        let choice =
            ComboBox::from_id_salt("through").selected_text(along.wanted.through.name(kind)).show_ui(ui, |ui| {
                for option in [Through::Dissertation, Through::Trained] {
                    ui.selectable_value(&mut along.wanted.through, option, option.name(kind));
                }
            });
        choice.response.labelled_by(through.id);
        count(ui, "Contacts", "Equidistant values of c from 0 to 2", &mut along.wanted.points, 11..=1001);
        if run_or_stop(ui, "Follow the trajectory", "Reduced and full solutions along it", &along.work) {
            along.begin(&ctx, context.answers.store(), in_use, (along.wanted, false));
        }
        standing_ui(ui, along.work.standing(), "Progress of the trajectory");
    });
    if let Some(message) = &along.work.message {
        message_ui(ui, message);
    }
    let Some(results) = &along.results else {
        super::parts::nothing_yet(ui, "Follow the trajectory to see film thickness and error along it");
        return;
    };
    let stale = drawn::is_grey(ui.ctx(), "trajectory", Owner::Model(results.in_use.clone()), context);
    if stale {
        stale_note(ui, &results.in_use);
        drawn::fade(ui, false);
    }
    ui.label(rich(&summary(results), 13.5, Palette::of(ui).quiet));
    super::parts::bound_note(ui, results.steps.iter().map(Step::bound));
    film_plot(ui, results, stale, 0.4 * ui.available_height());
    error_plot(ui, results, stale, (ui.available_height() - 4.0).max(110.0));
}

fn summary(results: &Followed) -> String {
    let Followed { wanted, steps, .. } = results;
    let failures = steps.iter().filter(|step| step.reduced().is_none()).count();
    let outside = steps.iter().filter(|step| !step.trained()).count();
    // Contacts that the range excludes have no row.
    let excluded = if results.running { 0 } else { wanted.points.saturating_sub(steps.len()) };
    let worst = steps.iter().filter_map(Step::error).fold(0.0, f64::max);
    let mut text = format!(
        "{} of {} contacts through {}, {failures} failures, maximum error of {{H_c}} {}",
        steps.len() + excluded,
        wanted.points,
        wanted.through.name(results.in_use.model.contact()),
        crate::app::numbers::error_percent(worst)
    );
    if outside > 0 {
        text.push_str(&format!(", {outside} outside the trained range"));
    }
    if excluded > 0 {
        text.push_str(&format!(", {excluded} omitted above its pressure limit"));
    }
    text
}

impl Followed {
    /// Returns the connected pieces of a quantity along the path. A piece also ends where the range excludes a
    /// contact, because the gap in c then exceeds 1.5 steps.
    fn pieces(&self, value: impl Fn(&Step) -> Option<f64>) -> Vec<Vec<[f64; 2]>> {
        pieces(self.steps.iter().map(|step| (step.c(), value(step))), 3.0 / (self.wanted.points - 1) as f64)
    }
}

/// Returns the pieces of a line. All points of a piece have values, and neighbours are closer than `apart`.
fn pieces(points: impl Iterator<Item = (f64, Option<f64>)>, apart: f64) -> Vec<Vec<[f64; 2]>> {
    let mut pieces: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut previous = None;
    for (c, value) in points {
        let continues = previous.is_some_and(|previous| c - previous < apart);
        previous = value.map(|_| c);
        match (value, pieces.last_mut().filter(|_| continues)) {
            (Some(value), Some(piece)) => piece.push([c, value]),
            (Some(value), None) => pieces.push(vec![[c, value]]),
            (None, _) => {}
        }
    }
    pieces
}

fn draw(plot: &mut Canvas<'_, '_>, name: &str, pieces: Vec<Vec<[f64; 2]>>, look: (Color32, f32, LineStyle)) {
    for (k, piece) in pieces.into_iter().enumerate() {
        let line = Line::new(name, piece).color(look.0).width(look.1).style(look.2);
        plot.line(line.id((name, k)));
    }
}

/// Creates a plot whose X axis and cursor are linked to the other plot of the view.
fn linked<'a>(ui: &Ui, id: &str, height: f32, x_title: &str, y_title: &str) -> PlotFrame<'a> {
    axes::plot(ui, id, height, x_title, y_title)
        .link_axis(Id::unique("trajectory"), Vec2b::new(true, false))
        .link_cursor(Id::unique("trajectory"), Vec2b::new(true, false))
        .auto_bounds(Vec2b::TRUE)
}

/// Accessible names of the plots.
const FILM: &str = "Film along the trajectory";
const ERROR: &str = "Error along the trajectory";

fn film_plot(ui: &mut Ui, results: &Followed, stale: bool, height: f32) {
    let palette = Palette::of(ui);
    let color = if stale { palette.reference } else { palette.film };
    let full = if stale { palette.reference } else { palette.over(palette.film) };
    let entries = [
        Entry::new("reduced model", color, Sample::Line(LIVE_WIDTH)),
        Entry::new("full solution", full, Sample::Line(FULL_WIDTH)),
    ];
    key::over(ui, height.max(110.0), entries, |ui, height| {
        let plot = linked(ui, "trajectory film", height, "", "Film {H_c}").paper_x("{c}").include_y(0.0);
        axes::show(plot, ui, FILM, |plot| {
            draw(plot, "Reduced model", results.pieces(Step::reduced), (color, LIVE_WIDTH, LineStyle::Solid));
            draw(plot, "Full solution", results.pieces(Step::full), (full, FULL_WIDTH, LineStyle::Solid));
        });
    });
}

fn error_plot(ui: &mut Ui, results: &Followed, stale: bool, height: f32) {
    let palette = Palette::of(ui);
    let grey = |color| if stale { palette.reference } else { color };
    // Smaller errors are below the tolerance of the full solver, and zero has no logarithm.
    let log = |value: Option<f64>| value.map(|v| v.max(1e-12).log10());
    let (film, accent, wrong) = (grey(palette.film), grey(palette.accent), grey(palette.wrong));
    let failed = || results.steps.iter().filter(|step| step.reduced().is_none());
    let mut entries = vec![Entry::new("true error", film, Sample::Line(1.8))];
    if results.steps.iter().any(|step| step.bound().is_some()) {
        entries.push(Entry::new("bound", accent, Sample::Dashed(1.2)));
    }
    if failed().next().is_some() {
        entries.push(Entry::new("failed", wrong, Sample::Line(1.0)));
    }
    key::over(ui, height, entries, |ui, height| {
        let plot = linked(ui, "trajectory error", height, "{c}", "Relative error of {H_c}").decades_y(8.0);
        axes::show(plot, ui, ERROR, |plot| {
            let error = results.pieces(|s| log(s.error()));
            draw(plot, "True error", error, (film, 1.8, LineStyle::Solid));
            let bound = results.pieces(|s| log(s.bound()));
            draw(plot, "Bound", bound, (accent, 1.2, LineStyle::dashed_dense()));
            for (k, step) in failed().enumerate() {
                plot.vline(VLine::new("failed", step.c()).color(wrong).width(1.0).id(("failed", k)));
            }
        });
    });
}

/// Returns every contact as a row of CSV.
pub fn csv(results: &Followed) -> String {
    let comments = [
        results.in_use.describe(),
        format!(
            "trajectory (3.21) through {}",
            results.wanted.through.name(results.in_use.model.contact()).replace('’', "'")
        ),
    ];
    let full = names::by(Method::Full.name(), names::H_C);
    let own = [names::TRAINED, names::H_C, &full, names::H_C_BOUND, "H_c_error"];
    let header: Vec<&str> = ["c"].into_iter().chain(CONTACT_COLUMNS).chain(own).collect();
    // A refused contact has no numbers.
    let rows = results.steps.iter().filter_map(|step| {
        let mut row = vec![Some(step.c())];
        row.extend(contact_cells(&step.0.results().first()?.point).map(Some));
        let trained = Some(f64::from(u8::from(step.trained())));
        row.extend([trained, step.reduced(), step.full(), step.bound(), step.error()]);
        Some(row)
    });
    export::csv(&comments, &header, rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_break_lines() {
        let points = [(0.0, Some(1.0)), (0.1, None), (0.2, None), (0.3, Some(2.0)), (0.4, Some(3.0)), (0.6, Some(4.0))];
        let lines = pieces(points.into_iter(), 0.15);
        assert_eq!(lines, [vec![[0.0, 1.0]], vec![[0.3, 2.0], [0.4, 3.0]], vec![[0.6, 4.0]]]);
    }
}
