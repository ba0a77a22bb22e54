//! Figures of a report: pressure and film thickness along X, the map of a point contact, the stress below the surface.

use crate::scene::answer::Answer;
use crate::scene::chart::{Chart, ChartAxis, ColorScale, Map, Marks};
use crate::scene::drawing::{Pen, Pixels, viridis};
use crate::solver::discrete::half_space::{Stress, StressMeasure};
use crate::solver::full::{Solution, SubsurfaceStress};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::engineering::{QuantityKind, Unit, UnitSystem};

/// Abscissae X of the profiles.
const ALONG: (f64, f64) = (-2.0, 1.5);
/// Largest drawn film thickness over H_c. Film thicknesses far upstream would dominate the scale.
const HIGHEST: f64 = 4.0;
/// Largest film thickness over H_c with a separate colour in the map.
const BRIGHTEST: f64 = 2.0;
/// Columns and rows of the map.
const PIXELS: [usize; 2] = [280, 240];

/// Returns the figures of a report. The first answer is the reference, to which the stress field belongs.
pub fn of(solved: &[Answer], stress: Option<&SubsurfaceStress>, system: UnitSystem) -> Vec<Chart> {
    let Some(solution) = solved.first().and_then(Answer::fields) else { return Vec::new() };
    let map = solution.problem.point.kind.is_point().then(|| film_map(solution, system));
    profiles(solved, system)
        .into_iter()
        .chain(map)
        .chain(stress.map(|field| stress_map(solution, field, system)))
        .collect()
}

/// Returns an axis with a unit.
fn axis(symbol: &str, unit: Unit) -> ChartAxis {
    ChartAxis::linear(format!("{{{symbol}}} in {}", unit.name))
}

/// Returns pressure and film thickness in the plane Y = 0.
pub fn profiles(solved: &[Answer], system: UnitSystem) -> [Chart; 2] {
    let [length, pressures, films] =
        [QuantityKind::Length, QuantityKind::Pressure, QuantityKind::FilmThickness].map(|kind| kind.unit(system));
    let mut pressure = Chart::new("Pressure", axis("x", length), axis("p", pressures));
    let mut film = Chart::new("Film thickness", axis("x", length), axis("h", films));
    (pressure.marked, film.marked) = (true, true);
    for (answer, solution) in solved.iter().filter_map(|answer| Some((answer, answer.fields()?))) {
        let result = &answer.result;
        let (hertz, scale) = (result.point.hertz(), result.point.film_scale_m());
        let near = || solution.profile().filter(|(x, ..)| (ALONG.0..=ALONG.1).contains(x));
        let a = length.number(hertz.half_width_m);
        let name = if solved.len() > 1 { result.method } else { "" };
        pressure.add(name, Marks::Line, near().map(|(x, p, _)| [x * a, pressures.number(p * hertz.pressure_pa)]));
        let most = HIGHEST * solution.scalars.h_c;
        film.add(
            name,
            Marks::Line,
            near().filter(|(.., h)| *h <= most).map(|(x, _, h)| [x * a, films.number(h * scale)]),
        );
    }
    film.y.ends = Some((
        0.0,
        HIGHEST * films.number(solved.first().and_then(|answer| answer.result.value("h_c_m")).unwrap_or(0.0)),
    ));
    [pressure, film]
}

/// Returns the colours of a scale.
fn colors() -> Vec<[u8; 3]> {
    (0..64).map(|k| viridis(f64::from(k) / 63.0)).collect()
}

/// Returns the film thickness of a point contact as a map over both halves.
fn film_map(solution: &Solution, system: UnitSystem) -> Chart {
    let range = (solution.scalars.h_min.max(0.0), BRIGHTEST * solution.scalars.h_c);
    film_over_plane(&solution.problem.point, (&solution.x, &solution.y), &solution.film, range, system)
}

/// Returns a film thickness at nodes X and Y ≤ 0 of a point contact as a map over both halves. The colours extend over
/// `range`.
pub fn film_over_plane(
    point: &OperatingPoint,
    (nodes_x, nodes_y): (&[f64], &[f64]),
    film: &[f64],
    (lowest, highest): (f64, f64),
    system: UnitSystem,
) -> Chart {
    let [length, films] = [QuantityKind::Length, QuantityKind::FilmThickness].map(|kind| kind.unit(system));
    let hertz = point.hertz();
    let [a, b] = [hertz.half_width_m, hertz.half_length_m].map(|axis| length.number(axis));
    let (x, y) = ((-1.8, 1.4), (-1.4, 1.4));
    let [columns, rows] = PIXELS;
    let place = |(from, to): (f64, f64), k: usize, count: usize| from + (to - from) * (k as f64 + 0.5) / count as f64;
    let mut rgb = Vec::with_capacity(3 * columns * rows);
    for row in 0..rows {
        let line = Line::of(nodes_y, -place(y, row, rows).abs());
        for column in 0..columns {
            let along = Line::of(nodes_x, place(x, column, columns));
            let here = along.between(|i| line.between(|j| film.get(i * nodes_y.len() + j).copied()));
            let share = (here.unwrap_or(highest) - lowest) / (highest - lowest);
            rgb.extend(viridis(share));
        }
    }
    let scale = films.number(point.film_scale_m());
    let mut chart = Chart::new("Film thickness of the contact", axis("x", length), axis("y", length));
    (chart.equal, chart.marked) = (true, true);
    chart.map = Some(Map {
        x: (a * x.0, a * x.1),
        y: (b * y.0, b * y.1),
        pixels: Pixels { width: columns, rgb },
        scale: Some(ColorScale {
            label: format!("{{h}} in {}", films.name),
            ends: (scale * lowest, scale * highest),
            colors: colors(),
        }),
    });
    (chart.x.ends, chart.y.ends) = (Some((a * x.0, a * x.1)), Some((b * y.0, b * y.1)));
    chart
}

/// Returns the von Mises stress below the surface, with the position of its maximum.
fn stress_map(solution: &Solution, field: &SubsurfaceStress, system: UnitSystem) -> Chart {
    let [length, stresses] = [QuantityKind::Length, QuantityKind::Stress].map(|kind| kind.unit(system));
    let a = length.number(solution.problem.point.hertz().half_width_m);
    let ends = |nodes: &[f64]| (nodes.first().map_or(0.0, |x| a * x), nodes.last().map_or(1.0, |x| a * x));
    let ((left, right), (_, deepest)) = (ends(&field.x), ends(&field.z));
    let largest = field.maximum(StressMeasure::VonMises);
    let pixel = |stress: &Stress| viridis(stress.von_mises() / largest.stress_pa);
    let mut chart = Chart::new("Von Mises stress below body 1", axis("x", length), axis("z", length));
    chart.marked = true;
    chart.map = Some(Map {
        x: (left, right),
        y: (-deepest, 0.0),
        pixels: Pixels { width: field.x.len(), rgb: field.stress.iter().flat_map(pixel).collect() },
        scale: Some(ColorScale {
            label: format!("stress in {}", stresses.name),
            ends: (0.0, stresses.number(largest.stress_pa)),
            colors: colors(),
        }),
    });
    (chart.x.ends, chart.y.ends) = (Some((left, right)), Some((-deepest, 0.0)));
    chart.add("maximum", Marks::Crosses, [[a * largest.x, -a * largest.z]]);
    if let Some(series) = chart.series.last_mut() {
        series.name.clear();
        series.pen = Some(Pen { color: [0x22; 3], opacity: 1.0, width: 1.0, dashes: Vec::new() });
    }
    chart
}

/// Position between two nodes.
struct Line {
    left: usize,
    share: f64,
    inside: bool,
}

impl Line {
    fn of(nodes: &[f64], at: f64) -> Self {
        let right = nodes.partition_point(|node| *node < at).clamp(1, nodes.len().max(2) - 1);
        let [before, after] = [right - 1, right].map(|k| nodes.get(k).copied().unwrap_or(at));
        let inside = nodes.first().is_some_and(|first| at >= *first) && nodes.last().is_some_and(|last| at <= *last);
        Self { left: right - 1, share: ((at - before) / (after - before)).clamp(0.0, 1.0), inside }
    }

    /// Interpolates a value; `None` outside the nodes.
    fn between(&self, value: impl Fn(usize) -> Option<f64>) -> Option<f64> {
        let [left, right] = [value(self.left)?, value(self.left + 1)?];
        self.inside.then_some((1.0 - self.share) * left + self.share * right)
    }
}
