//! The series and the profiles of the moment that is looked at as a figure for other programs (SVG), with axes, runs and parameters.

use crate::app::numbers;
use crate::app::plots::axes;
use crate::app::transient::method::Method;
use crate::app::transient::{Run, TransientView, export};
use crate::solver::full::transient::{Frame, Interpolation, Quantity};
use crate::solver::reduced::tpwl::Weighting;
use egui_plot::GridInput;
use std::fmt::Write as _;

/// Hues of pressure and film on paper.
const PRESSURE: &str = "#D55E00";
const FILM: &str = "#0072B2";
/// Page, left edge of the charts, their widths, top of the first, and the room between them.
const PAGE_WIDTH: f64 = 1000.0;
const LEFT: f64 = 70.0;
const SERIES_WIDTH: f64 = 520.0;
const PROFILE_LEFT: f64 = 670.0;
const PROFILE_WIDTH: f64 = 300.0;
const TOP: f64 = 78.0;
const HEIGHT: f64 = 210.0;
const BETWEEN: f64 = 46.0;

/// A rectangle on the page with what its edges stand for.
struct Chart<'a> {
    id: usize,
    place: (f64, f64),
    size: (f64, f64),
    x: (f64, f64),
    y: (f64, f64),
    titles: (&'a str, &'a str),
}

/// The figure; `None` where nothing has been computed.
pub fn svg(view: &TransientView) -> Option<String> {
    let setup = view.setup.as_ref()?;
    let runs: Vec<&Run> = view.runs.iter().filter(|run| !run.trajectory.moments.is_empty()).collect();
    if runs.is_empty() {
        return None;
    }
    let time = view.player.time();
    let compared = view.runs.len() > 1;
    let rows = if compared { 3.0 } else { 2.0 };
    let height = TOP + rows * (HEIGHT + BETWEEN) + 22.0 * runs.len() as f64 + 20.0;
    let mut out = String::new();
    // Writing to a string cannot fail, here and below.
    let _ok = writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{PAGE_WIDTH:.0}\" height=\"{height:.0}\" viewBox=\"0 0 {PAGE_WIDTH:.0} {height:.0}\" \
         font-family=\"sans-serif\" font-size=\"13\" fill=\"#222\">\n<rect width=\"{PAGE_WIDTH:.0}\" height=\"{height:.0}\" fill=\"#fff\"/>"
    );
    text(
        &mut out,
        (LEFT, 24.0),
        "font-size=\"16\"",
        &format!("Contact in time, {}", numbers::moes(setup.point.moes())),
    );
    for (k, line) in export::describe(setup).iter().enumerate() {
        text(&mut out, (LEFT, 40.0 + 11.0 * k as f64), "font-size=\"8.5\" fill=\"#666\"", line);
    }
    let duration = (0.0, setup.study.duration);
    let at = |row: f64| TOP + row * (HEIGHT + BETWEEN);
    let series = |quantity: Quantity| -> Vec<Vec<[f64; 2]>> {
        let points = |run: &&Run| run.trajectory.moments.iter().map(|m| [m.time, m.value(quantity)]).collect();
        runs.iter().map(points).collect()
    };
    let size = (SERIES_WIDTH, HEIGHT);
    let (pressures, films) = (series(Quantity::CentralPressure), series(Quantity::CentralFilm));
    let titles = ("T", "P_c");
    let chart = Chart { id: 0, place: (LEFT, at(0.0)), size, x: duration, y: range(&pressures), titles };
    chart.draw(&mut out, &runs, &pressures, PRESSURE);
    let chart = Chart { id: 1, place: (LEFT, at(1.0)), y: range(&films), titles: ("T", "H_c"), ..chart };
    chart.draw(&mut out, &runs, &films, FILM);
    if compared {
        let deviation = |(k, run): (usize, &Run)| -> Vec<[f64; 2]> {
            let Some(reference) = view.reference_of(k) else { return Vec::new() };
            let of = |m: &crate::solver::full::transient::Moment| {
                let other = reference.trajectory.at(Quantity::CentralFilm, m.time)?;
                Some([m.time, 100.0 * (m.h_c / other - 1.0)])
            };
            run.trajectory.moments.iter().filter_map(of).collect()
        };
        let present = view.runs.iter().enumerate().filter(|(_, run)| !run.trajectory.moments.is_empty());
        let deviations: Vec<Vec<[f64; 2]>> = present.map(deviation).collect();
        let titles = ("T", "Difference of H_c in %");
        let chart = Chart { id: 2, place: (LEFT, at(2.0)), y: range(&deviations), titles, ..chart };
        chart.draw(&mut out, &runs, &deviations, FILM);
    }
    let profiles = |of: fn((f64, f64, f64)) -> [f64; 2]| -> Vec<Vec<[f64; 2]>> {
        let points = |run: &&Run| run.state_at(time).map(|state| run.profile(state).map(of).collect());
        runs.iter().map(|run| points(run).unwrap_or_default()).collect()
    };
    let (pressures, profiles) = (profiles(|(x, p, _)| [x, p]), profiles(|(x, _, h)| [x, h]));
    let top = |quantity: Quantity, factor: f64| {
        let values = runs.iter().flat_map(|run| &run.trajectory.moments).map(|m| m.value(quantity));
        (0.0, numbers::round_up(factor * values.fold(0.0, f64::max)))
    };
    let size = (PROFILE_WIDTH, HEIGHT);
    let (x, place) = ((-2.2, 1.6), (PROFILE_LEFT, at(0.0)));
    let chart = Chart { id: 3, place, size, x, y: top(Quantity::MaximumPressure, 1.12), titles: ("X", "P") };
    chart.draw(&mut out, &runs, &pressures, PRESSURE);
    let place = (PROFILE_LEFT, at(1.0));
    let chart = Chart { id: 4, place, y: top(Quantity::CentralFilm, 3.4), titles: ("X", "H"), ..chart };
    chart.draw(&mut out, &runs, &profiles, FILM);
    let moment = format!("Profiles at T = {}", numbers::significant(time));
    text(&mut out, (PROFILE_LEFT, TOP - 8.0), "font-size=\"12\"", &moment);
    for (k, run) in runs.iter().enumerate() {
        let y = at(rows) + 22.0 * k as f64;
        let _ok = writeln!(
            out,
            "<line x1=\"{LEFT}\" y1=\"{y:.1}\" x2=\"{:.1}\" y2=\"{y:.1}\" {}/>",
            LEFT + 40.0,
            stroke(run, FILM)
        );
        text(&mut out, (LEFT + 50.0, y + 4.0), "font-size=\"12\"", &run.name());
    }
    out.push_str("</svg>\n");
    Some(out)
}

fn text(out: &mut String, (x, y): (f64, f64), style: &str, content: &str) {
    let content = content.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    let _ok = writeln!(out, "<text x=\"{x:.1}\" y=\"{y:.1}\" {style}>{content}</text>");
}

/// The line of a run: dashes by frame, the reduced model thick, a linearised one thicker and paler.
fn stroke(run: &Run, color: &str) -> String {
    let dashes = match run.frame() {
        _ if run.method == Method::Linearised(Weighting::Dissertation) => "5 3",
        Frame::Fixed => "none",
        Frame::ArbitraryLagrangianEulerian => "10 6",
        Frame::Remeshed(Interpolation::CubicSpline) => "5 3",
        Frame::Remeshed(Interpolation::Linear) => "1.5 4",
    };
    let (width, opacity) = match run.method {
        Method::Full => (1.4, 1.0),
        Method::Reduced => (3.6, 0.45),
        Method::Linearised(_) => (6.0, 0.3),
    };
    format!(
        "fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\" stroke-opacity=\"{opacity}\" stroke-dasharray=\"{dashes}\""
    )
}

/// The range of all values with some room; never empty.
fn range(curves: &[Vec<[f64; 2]>]) -> (f64, f64) {
    let values = curves.iter().flatten().map(|point| point[1]);
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    let room = (0.06 * (high - low)).max(1e-9 * high.abs()).max(f64::MIN_POSITIVE);
    if low <= high { (low - room, high + room) } else { (-1.0, 1.0) }
}

impl Chart<'_> {
    fn draw(&self, out: &mut String, runs: &[&Run], curves: &[Vec<[f64; 2]>], color: &str) {
        let ((left, top), (width, height), id) = (self.place, self.size, self.id);
        let across = |x: f64| left + width * (x - self.x.0) / (self.x.1 - self.x.0);
        let up = |y: f64| top + height * (self.y.1 - y) / (self.y.1 - self.y.0);
        let _ok = writeln!(
            out,
            "<clipPath id=\"chart{id}\"><rect x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\"/></clipPath>\n\
             <rect x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" fill=\"none\" stroke=\"#999\"/>"
        );
        let marks =
            |bounds: (f64, f64), wanted: f64| axes::round_marks(GridInput { bounds, base_step_size: 1.0 }, wanted);
        for mark in marks(self.x, width / 60.0) {
            let (x, below) = (across(mark.value), top + height);
            let _ok = writeln!(out, "<path d=\"M{x:.1} {top}V{below}\" stroke=\"#ddd\"/>");
            text(out, (x, below + 15.0), "font-size=\"11\" text-anchor=\"middle\"", &label(mark.value));
        }
        for mark in marks(self.y, height / 36.0) {
            let (y, right) = (up(mark.value), left + width);
            let _ok = writeln!(out, "<path d=\"M{left} {y:.1}H{right}\" stroke=\"#ddd\"/>");
            text(out, (left - 6.0, y + 4.0), "font-size=\"11\" text-anchor=\"end\"", &label(mark.value));
        }
        for (run, curve) in runs.iter().zip(curves).filter(|(_, curve)| !curve.is_empty()) {
            let points: Vec<String> = curve.iter().map(|[x, y]| format!("{:.2},{:.2}", across(*x), up(*y))).collect();
            let (points, line) = (points.join(" "), stroke(run, color));
            let _ok = writeln!(out, "<polyline clip-path=\"url(#chart{id})\" {line} points=\"{points}\"/>");
        }
        let middle = (left + 0.5 * width, top + height + 30.0);
        text(out, middle, "font-size=\"12\" font-style=\"italic\" text-anchor=\"middle\"", self.titles.0);
        text(out, (left + 6.0, top + 15.0), "font-size=\"12\" font-style=\"italic\"", self.titles.1);
    }
}

fn label(value: f64) -> String {
    format!("{}", (value * 1e9).round() / 1e9).replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_hold_all_values_and_are_never_empty() {
        let (low, high) = range(&[vec![[0.0, 1.0]], vec![[0.0, 3.0], [1.0, 2.0]]]);
        assert!(low < 1.0 && high > 3.0);
        for flat in [vec![vec![[0.0, 2.0]]], vec![vec![[0.0, 0.0]]], Vec::new()] {
            let (low, high) = range(&flat);
            assert!(low < high, "{flat:?}");
        }
        assert!(svg(&TransientView::default()).is_none());
    }
}
