//! Random validation in the M–L plane: failures of the reduced model, and its error elsewhere. A click moves the
//! contact there.

use super::parts::{CONTACT_COLUMNS, contact_cells, tests_toolbar};
use super::random_tests::{RandomTests, Results, bound_of, error_of};
use super::worst::{self, Worst};
use crate::app::context::{Commands, Context};
use crate::app::document::Edit;
use crate::app::drawn::{self, Owner};
use crate::app::in_use::InUse;
use crate::app::plot::axes;
use crate::app::plot::key::{self, Entry, Sample};
use crate::app::theme::{Palette, rich, sequential};
use crate::app::{export, numbers};
use crate::scene::names;
use crate::scene::study::random_test::{Tested, errors};
use crate::solver::physics::contact::{Moes, OperatingPoint};
use egui::{Color32, Ui};
use egui_plot::{HoverPosition, MarkerShape, PlotPoint, PlotPoints, Points};

/// Maximum distance of a click from a test, in screen points.
const NEAR: f32 = 12.0;
/// Decades with separate colours, from 10^FIRST. Smaller and larger errors share the colours at the ends.
const FIRST: i32 = -7;
const CLASSES: usize = 7;

/// Error that colours a test.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum By {
    /// The calibrated bound on the error of H_c.
    #[default]
    Bound,
    /// The true error, if a full solution was computed.
    Truth,
}

impl By {
    /// Returns the error of a test.
    pub fn of(self, tested: &Tested) -> Option<f64> {
        match self {
            Self::Bound => bound_of(tested),
            Self::Truth => error_of(tested),
        }
    }
}

/// State of the view.
#[derive(Default)]
pub struct Map {
    /// Error that the user chose; `None` for the bound, or the true error if there are no bounds.
    by: Option<By>,
    drawn: Option<DrawnTests>,
    worst: Worst,
}

impl Map {
    fn by(&self, results: &Results) -> By {
        let bounds = || results.tests.is_empty() || results.tests.iter().any(|tested| bound_of(tested).is_some());
        self.by.unwrap_or_else(|| if bounds() { By::Bound } else { By::Truth })
    }
}

/// Tests as series of points, updated after a change.
struct DrawnTests {
    of: (usize, usize, By),
    classes: [Vec<PlotPoint>; CLASSES],
    unknown: Vec<PlotPoint>,
    failures: Vec<PlotPoint>,
}

impl DrawnTests {
    fn new(results: &Results, by: By) -> Self {
        let mut drawn =
            Self { of: stamp(results, by), classes: Default::default(), unknown: Vec::new(), failures: Vec::new() };
        for tested in &results.tests {
            let place = match (tested.0.film, by.of(tested)) {
                (None, _) => &mut drawn.failures,
                (_, Some(error)) => &mut drawn.classes[class(error)],
                (_, None) => &mut drawn.unknown,
            };
            place.push(at(tested.0.point.moes()));
        }
        drawn
    }
}

/// Returns a stamp by which drawings and lists detect that they are out of date.
pub fn stamp(results: &Results, by: By) -> (usize, usize, By) {
    (results.revision, results.tests.len(), by)
}

fn class(error: f64) -> usize {
    let decade = error.max(f64::MIN_POSITIVE).log10().floor() as i32 - FIRST + 1;
    decade.clamp(0, CLASSES as i32 - 1) as usize
}

fn class_name(class: usize) -> String {
    let power = |k: i32| format!("1e−{}", -k);
    let from = FIRST - 1 + class as i32;
    match class {
        0 => format!("below {}", power(FIRST)),
        c if c + 1 == CLASSES => format!("{} and more", power(from)),
        _ => format!("{}…{}", power(from), power(from + 1)),
    }
}

fn at(moes: Moes) -> PlotPoint {
    PlotPoint::new(moes.m.log10(), moes.l)
}

/// Accessible name of the plot.
const MAP: &str = "Map of the random validation";
/// Name under which the refusal of a chosen contact is stored.
const FIELD: &str = "failure map";

/// Draws the view.
pub fn ui(
    ui: &mut Ui,
    (map, tests): (&mut Map, &mut RandomTests),
    context: &Context<'_>,
    commands: &mut Commands,
    in_use: &InUse,
) {
    tests_toolbar(ui, context.answers.store(), tests, in_use);
    context.entries.message_ui(ui, FIELD);
    let Some(results) = &tests.results else {
        super::parts::nothing_yet(
            ui,
            "Run the validation to see where the model fails and how large its error is over its whole range",
        );
        return;
    };
    ui.horizontal_wrapped(|ui| {
        let mut by = map.by(results);
        ui.label("Judged by").on_hover_text("Colours the map and sorts the list");
        let bound = rich("bound on the error of {H_c}", 13.5, ui.visuals().text_color());
        ui.selectable_value(&mut by, By::Bound, bound);
        let truth = rich("true error of {H_c}", 13.5, ui.visuals().text_color());
        ui.selectable_value(&mut by, By::Truth, truth)
            .on_hover_text("Only contacts that were compared with full solutions have a colour");
        ui.weak(summary(results));
        if by != map.by(results) {
            map.by = Some(by);
        }
    });
    let by = map.by(results);
    if by == By::Bound {
        super::parts::bound_note(ui, results.tests.iter().map(bound_of));
    }
    if map.drawn.as_ref().is_none_or(|d| d.of != stamp(results, by)) {
        map.drawn = Some(DrawnTests::new(results, by));
    }
    map.worst.sort(results, by);
    let stale = is_former(ui, results, context);
    let here = context.document.point.moes();
    let mut wanted = None;
    if ui.available_width() > 700.0 {
        let list = 300.0;
        ui.horizontal_top(|ui| {
            ui.vertical(|ui| {
                ui.set_width(ui.available_width() - list - 14.0);
                let height = ui.available_height();
                wanted = chart(ui, map, results, here, height, stale);
            });
            ui.vertical(|ui| wanted = wanted.or(worst::ui(ui, &map.worst, results)));
        });
    } else {
        let height = (ui.available_height() - 150.0).max(180.0);
        wanted = chart(ui, map, results, here, height, stale);
        wanted = wanted.or(worst::ui(ui, &map.worst, results));
    }
    let lubricant = results.in_use.model.domain.lubricant;
    if let Some(point) = wanted {
        commands.edit(Edit::Contact(point, Box::new(lubricant)), FIELD);
    }
}

/// Returns true if the tests belong to another model than the one in use. Fades the remaining widgets in this case.
pub fn is_former(ui: &mut Ui, results: &Results, context: &Context<'_>) -> bool {
    let former = drawn::is_grey(ui.ctx(), "random tests", Owner::Model(results.in_use.clone()), context);
    if former {
        drawn::fade(ui, false);
    }
    former
}

/// Returns the numbers of tests, failures and comparisons as text.
pub fn summary(results: &Results) -> String {
    let (made, wanted) = (results.tests.len(), results.wanted.tests);
    let failures = match results.failures() {
        0 => "no failures".to_owned(),
        1 => "1 failure".to_owned(),
        n => format!("{n} failures"),
    };
    let of_truth = |tests: &[Tested]| tests.iter().filter(|(_, truth)| truth.is_some()).count();
    let (as_they_came, beyond) = results.tests.split_at(results.wanted.compared.min(made));
    let worst = match of_truth(beyond) {
        0 => String::new(),
        count => format!(", {count} more with the largest expected errors"),
    };
    format!("{made} of {wanted} tests, {failures}, {} compared{worst}", of_truth(as_they_came))
}

fn chart(ui: &mut Ui, map: &Map, results: &Results, here: Moes, height: f32, stale: bool) -> Option<OperatingPoint> {
    let drawn = map.drawn.as_ref()?;
    let palette = Palette::of(ui);
    let dark = ui.visuals().dark_mode;
    let grey = |color: Color32| if stale { palette.reference } else { color };
    let class_color = |k: usize| grey(sequential(k as f32 / (CLASSES - 1) as f32, dark));
    let classes = drawn.classes.iter().enumerate().filter(|(_, points)| !points.is_empty());
    let mut entries: Vec<Entry> =
        classes.map(|(k, _)| Entry::new(class_name(k), class_color(k), Sample::Dot(3.0))).collect();
    if !drawn.unknown.is_empty() {
        entries.push(Entry::new("not compared", palette.grid, Sample::Dot(3.0)));
    }
    if !drawn.failures.is_empty() {
        entries.push(Entry::new("failed", grey(palette.wrong), Sample::Cross(4.0)));
    }
    let response = key::over(ui, height, entries, |ui, height| {
        let plot = axes::plot(ui, "failure map", height, "Load number {M}", "Lubricant number {L}")
            .log_x()
            .y_axis_min_width(34.0)
            .set_margin_fraction(egui::vec2(0.03, 0.05))
            .label_formatter(|hover| match hover {
                HoverPosition::NearDataPoint { position, .. } => label(results, *position),
                HoverPosition::Elsewhere { .. } => None,
            });
        axes::show(plot, ui, MAP, |plot| {
            let unknown = Points::new("not compared", PlotPoints::Borrowed(&drawn.unknown));
            if !drawn.unknown.is_empty() {
                plot.points(unknown.color(palette.grid).radius(2.0));
            }
            for (k, points) in drawn.classes.iter().enumerate().filter(|(_, points)| !points.is_empty()) {
                let points = Points::new(class_name(k), PlotPoints::Borrowed(points));
                plot.points(points.color(class_color(k)).radius(2.4));
            }
            if !drawn.failures.is_empty() {
                let failures = Points::new("failed", PlotPoints::Borrowed(&drawn.failures));
                plot.points(failures.color(grey(palette.wrong)).radius(5.0).shape(MarkerShape::Cross));
            }
            let ring = Points::new("", vec![[at(here).x, at(here).y]]).id("here").color(palette.accent).radius(8.0);
            plot.points(ring.filled(false).shape(MarkerShape::Circle).allow_hover(false));
        })
    });
    let transform = response.transform;
    let response = response.response;
    let response = response.on_hover_cursor(egui::CursorIcon::Crosshair);
    let pointer = response.interact_pointer_pos().filter(|_| response.clicked())?;
    nearest(results, |moes| transform.position_from_point(&at(moes)).distance(pointer)).map(|(test, _)| test.point)
}

/// Returns the test with the smallest distance on the screen, if it is near enough.
fn nearest(results: &Results, distance: impl Fn(Moes) -> f32) -> Option<&Tested> {
    let distances = results.tests.iter().map(|tested| (tested, distance(tested.0.point.moes())));
    distances.filter(|(_, d)| *d < NEAR).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(tested, _)| tested)
}

/// Returns the text about the test at a place of the map.
fn label(results: &Results, place: PlotPoint) -> Option<String> {
    let tested = results.tests.iter().find(|(test, _)| at(test.point.moes()) == place)?;
    let point = &tested.0.point;
    let error = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), numbers::error_percent);
    Some(format!(
        "{}, α {}/GPa\nerror bound of H_c {}, true error {}\nclick to go to this contact",
        numbers::moes(point.moes()),
        numbers::digits(point.alpha_per_pa * 1e9, 3),
        error(bound_of(tested)),
        error(error_of(tested))
    ))
}

/// Returns every test as a row of CSV.
pub fn csv(results: &Results) -> String {
    let comments = [
        results.in_use.describe(),
        format!("random tests (3.17) of the trained range, seed {}", results.wanted.seed),
        "converged 0: the reduced model failed; empty errors: not compared, or no full solution".to_owned(),
    ];
    let own = [
        names::CONVERGED,
        names::NEWTON_ITERATIONS,
        names::H_C,
        names::H_MIN,
        names::H_C_BOUND,
        "H_c_error",
        "H_min_error",
    ];
    let header: Vec<&str> = CONTACT_COLUMNS.into_iter().chain(own).collect();
    let rows = results.tests.iter().map(|tested| {
        let (test, [h_c, h_min, ..]) = (&tested.0, errors(tested));
        let mut row = contact_cells(&test.point).map(Some).to_vec();
        row.extend([
            Some(f64::from(u8::from(test.film.is_some()))),
            test.film.map(|_| test.newton_iterations as f64),
            test.film.map(|film| film.h_c),
            test.film.map(|film| film.h_min),
            bound_of(tested),
            h_c,
            h_min,
        ]);
        row
    });
    export::csv(&comments, &header, rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_error_has_a_class_with_a_name() {
        assert_eq!((class(0.0), class(3e-8), class(3e-7), class(9e-3), class(0.5)), (0, 0, 1, 5, 6));
        assert_eq!(class_name(0), "below 1e−7");
        assert_eq!(class_name(class(3e-7)), "1e−7…1e−6");
        assert_eq!(class_name(6), "1e−2 and more");
    }
}
