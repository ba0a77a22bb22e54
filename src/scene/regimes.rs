//! Chart of M and L with the lubrication regimes.

use super::chart::{Chart, ChartAxis, Marks, Note, Series};
use super::drawing::{Pen, TextAnchor, Words};
use super::regime::{Regime, RegimeMap};
use crate::solver::physics::contact::{FilmShape, Moes};

/// Ends of the chart along M.
pub const M_AXIS: (f64, f64) = (0.4, 1500.0);
/// Ends of the chart along L.
pub const L_AXIS: (f64, f64) = (0.05, 32.0);

/// Number of samples along each line.
pub const SAMPLES: usize = 240;

/// Returns the k-th of `of` values with constant ratio.
pub fn spread((low, high): (f64, f64), k: usize, of: usize) -> f64 {
    (low.ln() + (high.ln() - low.ln()) * k as f64 / (of - 1) as f64).exp()
}

/// Returns the boundaries between regimes as lines of (M, L): where the deformation equals the film thickness, and
/// where the viscosity doubles.
pub fn boundaries(shape: FilmShape) -> [Vec<[f64; 2]>; 2] {
    let map = RegimeMap::new(shape);
    let crossing = |(low, high): (f64, f64), holds: &dyn Fn(f64) -> bool| {
        let (mut from, mut to) = (low.ln(), high.ln());
        if holds(low) || !holds(high) {
            return None;
        }
        for _ in 0..30 {
            let middle = 0.5 * (from + to);
            if holds(middle.exp()) { to = middle } else { from = middle }
        }
        Some((0.5 * (from + to)).exp())
    };
    // The deformation grows with M, the viscosity with L.
    let elastic = |l: f64| Some([crossing(M_AXIS, &|m| map.regime(Moes { m, l }).is_elastic())?, l]);
    let piezoviscous = |m: f64| Some([m, crossing(L_AXIS, &|l| map.regime(Moes { m, l }).is_piezoviscous())?]);
    [
        (0..SAMPLES).filter_map(|k| elastic(spread(L_AXIS, k, SAMPLES))).collect(),
        (0..SAMPLES).filter_map(|k| piezoviscous(spread(M_AXIS, k, SAMPLES))).collect(),
    ]
}

/// Returns places (M, L) for the names of the regimes, away from the most important contacts. Text at M < 1 begins
/// there; text at M > 1000 ends there. A regime that contains none of these places has no name on the chart.
pub fn names(shape: FilmShape) -> Vec<(Regime, [f64; 2])> {
    let map = RegimeMap::new(shape);
    let inside = |regime: Regime, [m, l]: [f64; 2]| {
        // The name needs some room.
        [0.8, 1.25].iter().all(|by| map.regime(Moes { m, l: by * l }) == regime)
    };
    use Regime::{ElasticIsoviscous, ElasticPiezoviscous, RigidIsoviscous, RigidPiezoviscous};
    let places: [(Regime, &[[f64; 2]]); 4] = [
        (RigidIsoviscous, &[[0.43, 0.3], [0.43, 0.1]]),
        (ElasticIsoviscous, &[[25.0, 0.08], [60.0, 0.08], [120.0, 0.07], [300.0, 0.07]]),
        (RigidPiezoviscous, &[[0.43, 15.0], [0.43, 25.0], [5.0, 20.0], [40.0, 25.0]]),
        (ElasticPiezoviscous, &[[1100.0, 22.0], [1100.0, 13.5], [1100.0, 5.0], [1100.0, 2.5]]),
    ];
    let first =
        |(regime, places): (Regime, &[[f64; 2]])| Some((regime, *places.iter().find(|place| inside(regime, **place))?));
    places.into_iter().filter_map(first).collect()
}

/// Returns the regime chart for print, with one contact marked.
pub fn chart(shape: FilmShape, moes: Moes) -> Chart {
    let mut chart = Chart::new("Regime", ChartAxis::log("Load number M"), ChartAxis::log("Lubricant number L"));
    // The axes are extended if the contact lies outside.
    let around = |(from, to): (f64, f64), value: f64| Some((from.min(0.7 * value), to.max(1.4 * value)));
    (chart.x.ends, chart.y.ends) = (around(M_AXIS, moes.m), around(L_AXIS, moes.l));
    let pen = Pen { color: [0x88; 3], opacity: 1.0, width: 0.8, dashes: Vec::new() };
    for points in boundaries(shape) {
        let name = String::new();
        chart.series.push(Series { name, marks: Marks::Line, points, pen: Some(pen.clone()) });
    }
    let (name, points) = ("this contact".to_owned(), vec![[moes.m, moes.l]]);
    let pen = Pen { color: [0xD5, 0x5E, 0x00], opacity: 1.0, width: 1.6, dashes: Vec::new() };
    chart.series.push(Series { name, marks: Marks::Dots, points, pen: Some(pen) });
    for (regime, at) in names(shape) {
        let [m, _] = at;
        let beside = match m {
            ..1.0 => TextAnchor::Right,
            1000.0.. => TextAnchor::Left,
            _ => TextAnchor::Middle,
        };
        let words = Words::plain(regime.name().replace('\n', " "));
        chart.notes.push(Note { at, words, beside, above: 0, color: None });
    }
    chart
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_corners_belong_to_the_regimes_of_the_literature() {
        let of = |shape, m, l| RegimeMap::new(shape).regime(Moes { m, l });
        let line = FilmShape::Line;
        assert_eq!(of(line, 0.6, 0.3), Regime::RigidIsoviscous);
        assert_eq!(of(line, 30.0, 0.1), Regime::ElasticIsoviscous);
        assert_eq!(of(line, 1.0, 25.0), Regime::RigidPiezoviscous);
        assert_eq!(of(line, 200.0, 15.0), Regime::ElasticPiezoviscous);
        let ellipse = FilmShape::Ellipse;
        for (shape, count) in [(line, 4), (FilmShape::CIRCLE, 4), (ellipse(0.5), 3), (ellipse(20.0), 3)] {
            assert!(names(shape).len() >= count, "{shape:?}");
        }
        // Wide elliptical contacts stay rigid up to larger loads.
        assert_eq!(of(FilmShape::CIRCLE, 20.0, 0.1), Regime::ElasticIsoviscous);
        assert_eq!(of(FilmShape::Ellipse(20.0), 20.0, 0.1), Regime::RigidIsoviscous);
    }

    #[test]
    fn a_contact_stands_on_the_chart_wherever_it_is() {
        for (shape, m, l) in [(FilmShape::Line, 40.0, 10.0), (FilmShape::CIRCLE, 1e4, 0.01)] {
            let chart = chart(shape, Moes { m, l });
            let ([x, y], here) = ([chart.x.ends, chart.y.ends].map(Option::unwrap), chart.series.last().unwrap());
            assert_eq!(here.points, [[m, l]]);
            assert!(x.0 < m && m < x.1 && y.0 < l && l < y.1, "{x:?} {y:?}");
            assert!(chart.series.len() == 3 && chart.notes.len() == 4, "{:?}", chart.notes);
        }
    }
}
