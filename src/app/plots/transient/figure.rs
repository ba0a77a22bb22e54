//! The series and the profiles of the moment that is looked at as a figure for other programs (SVG), with axes, runs and parameters.

use crate::app::numbers;
use crate::app::plots::svg::{self, Chart, Curve, FILM, PRESSURE, Page};
use crate::app::transient::method::Method;
use crate::app::transient::{Run, TransientView, export};
use crate::solver::full::transient::{Frame, Interpolation, Quantity};
use crate::solver::reduced::tpwl::Weighting;

/// Page, left edge of the charts, their widths, top of the first, and the room between them.
const PAGE_WIDTH: f64 = 1000.0;
const LEFT: f64 = 70.0;
const SERIES_WIDTH: f64 = 520.0;
const PROFILE_LEFT: f64 = 670.0;
const PROFILE_WIDTH: f64 = 300.0;
const TOP: f64 = 78.0;
const HEIGHT: f64 = 210.0;
const BETWEEN: f64 = 46.0;

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
    let mut page = Page::new(PAGE_WIDTH, height);
    let title = format!("Contact in time, {}", numbers::moes(setup.point.moes()));
    page.text((LEFT, 24.0), "font-size=\"16\"", &title);
    for (k, line) in export::describe(setup).iter().enumerate() {
        page.text((LEFT, 40.0 + 11.0 * k as f64), "font-size=\"8.5\" fill=\"#666\"", line);
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
    let logarithmic = (false, false);
    let chart = Chart { id: 0, place: (LEFT, at(0.0)), size, x: duration, y: range(&pressures), titles, logarithmic };
    draw(&chart, &mut page, &runs, &pressures, PRESSURE);
    let chart = Chart { id: 1, place: (LEFT, at(1.0)), y: range(&films), titles: ("T", "H_c"), ..chart };
    draw(&chart, &mut page, &runs, &films, FILM);
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
        draw(&chart, &mut page, &runs, &deviations, FILM);
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
    let y = top(Quantity::MaximumPressure, 1.12);
    let chart = Chart { id: 3, place, size, x, y, titles: ("X", "P"), logarithmic };
    draw(&chart, &mut page, &runs, &pressures, PRESSURE);
    let place = (PROFILE_LEFT, at(1.0));
    let chart = Chart { id: 4, place, y: top(Quantity::CentralFilm, 3.4), titles: ("X", "H"), ..chart };
    draw(&chart, &mut page, &runs, &profiles, FILM);
    let moment = format!("Profiles at T = {}", numbers::significant(time));
    page.text((PROFILE_LEFT, TOP - 8.0), "font-size=\"12\"", &moment);
    for (k, run) in runs.iter().enumerate() {
        let y = at(rows) + 22.0 * k as f64;
        let (right, stroke) = (LEFT + 40.0, stroke(run, FILM));
        page.line(&format!("<line x1=\"{LEFT}\" y1=\"{y:.1}\" x2=\"{right:.1}\" y2=\"{y:.1}\" {stroke}/>"));
        page.text((LEFT + 50.0, y + 4.0), "font-size=\"12\"", &run.name());
    }
    Some(page.finish())
}

fn draw(chart: &Chart<'_>, page: &mut Page, runs: &[&Run], curves: &[Vec<[f64; 2]>], color: &str) {
    chart.draw(page, runs.iter().zip(curves).map(|(run, points)| Curve { stroke: stroke(run, color), points }));
}

/// The range of all values with some room; never empty.
fn range(curves: &[Vec<[f64; 2]>]) -> (f64, f64) {
    svg::range(curves.iter().flatten().map(|point| &point[1]))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_is_no_figure_of_nothing() {
        assert!(super::svg(&TransientView::default()).is_none());
    }
}
