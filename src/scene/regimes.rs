//! Lubrication regimes on the chart of M and L: which asymptote of Moes' film formula is dominant.

use super::chart::{Chart, ChartAxis, Marks, Note, Series};
use super::drawing::{Beside, Pen, Words};
use crate::solver::physics::contact::{FilmAsymptotes, FilmShape, Moes};

/// Ends of the chart along M.
pub const M_AXIS: (f64, f64) = (0.4, 1500.0);
/// Ends of the chart along L.
pub const L_AXIS: (f64, f64) = (0.2, 32.0);
/// Asymptotic lubrication regime.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Regime {
    /// Rigid bodies, constant viscosity.
    RigidIsoviscous,
    /// Elastic bodies, constant viscosity.
    ElasticIsoviscous,
    /// Rigid bodies, viscosity rising with pressure.
    RigidPiezoviscous,
    /// Elastic bodies, viscosity rising with pressure.
    ElasticPiezoviscous,
}

impl Regime {
    /// Returns the regime whose asymptote dominates Moes' formula at M and L. The isoviscous asymptotes add up, so the
    /// larger one counts. The piezoviscous ones add up inversely, so the smaller one counts. The larger of these two
    /// decides.
    pub fn of(shape: FilmShape, moes: Moes) -> Self {
        let a = FilmAsymptotes::of(shape, moes);
        let iso = a.rigid_isoviscous.max(a.elastic_isoviscous);
        if iso > a.rigid_piezoviscous.min(a.elastic_piezoviscous) {
            if a.rigid_isoviscous > a.elastic_isoviscous { Self::RigidIsoviscous } else { Self::ElasticIsoviscous }
        } else if a.rigid_piezoviscous < a.elastic_piezoviscous {
            Self::RigidPiezoviscous
        } else {
            Self::ElasticPiezoviscous
        }
    }

    /// Returns the name on two lines, for the chart.
    pub fn name(self) -> &'static str {
        match self {
            Self::RigidIsoviscous => "rigid,\nisoviscous",
            Self::ElasticIsoviscous => "elastic,\nisoviscous",
            Self::RigidPiezoviscous => "rigid,\npiezoviscous",
            Self::ElasticPiezoviscous => "elastic,\npiezoviscous",
        }
    }

    /// Returns the name on one line.
    pub fn title(self) -> &'static str {
        match self {
            Self::RigidIsoviscous => "Rigid, isoviscous",
            Self::ElasticIsoviscous => "Elastic, isoviscous",
            Self::RigidPiezoviscous => "Rigid, piezoviscous",
            Self::ElasticPiezoviscous => "Elastic, piezoviscous",
        }
    }

    /// Returns a one-line description.
    pub fn meaning(self) -> &'static str {
        match self {
            Self::RigidIsoviscous => "The bodies keep their shape, the oil its viscosity",
            Self::ElasticIsoviscous => "The bodies flatten, the oil keeps its viscosity",
            Self::RigidPiezoviscous => "The bodies keep their shape, pressure stiffens the oil",
            Self::ElasticPiezoviscous => "The bodies flatten, pressure stiffens the oil",
        }
    }
}

/// Number of samples along each line.
pub const SAMPLES: usize = 240;

/// Returns the k-th of `of` values with constant ratio.
pub fn spread((low, high): (f64, f64), k: usize, of: usize) -> f64 {
    (low.ln() + (high.ln() - low.ln()) * k as f64 / (of - 1) as f64).exp()
}

/// Returns the boundaries between regimes by their ends in (M, L). Each is a straight line on logarithmic axes. The
/// places where the regime changes are found along the rows and columns of a fine lattice and refined by bisection.
pub fn boundaries(shape: FilmShape) -> Vec<[[f64; 2]; 2]> {
    let mut found: Vec<([Regime; 2], Vec<Moes>)> = Vec::new();
    let mut add = |a: Regime, b: Regime, place: Moes| {
        let pair = if (a as usize) < b as usize { [a, b] } else { [b, a] };
        match found.iter_mut().find(|(known, _)| *known == pair) {
            Some((_, places)) => places.push(place),
            None => found.push((pair, vec![place])),
        }
    };
    for along_m in [false, true] {
        for k in 0..SAMPLES {
            let place = |t: f64| {
                let moving = |(low, high): (f64, f64)| (low.ln() + (high / low).ln() * t).exp();
                if along_m {
                    Moes { m: moving(M_AXIS), l: spread(L_AXIS, k, SAMPLES) }
                } else {
                    Moes { m: spread(M_AXIS, k, SAMPLES), l: moving(L_AXIS) }
                }
            };
            for step in 0..SAMPLES - 1 {
                let (mut low, mut high) =
                    (step as f64 / (SAMPLES - 1) as f64, (step + 1) as f64 / (SAMPLES - 1) as f64);
                let (a, b) = (Regime::of(shape, place(low)), Regime::of(shape, place(high)));
                if a == b {
                    continue;
                }
                for _ in 0..24 {
                    let middle = 0.5 * (low + high);
                    if Regime::of(shape, place(middle)) == a { low = middle } else { high = middle }
                }
                add(a, Regime::of(shape, place(high)), place(0.5 * (low + high)));
            }
        }
    }
    let ends = |(_, mut places): (_, Vec<Moes>)| {
        // Sorted along the axis on which the boundary is longer.
        let ratio = |of: fn(&Moes) -> f64| {
            places.iter().map(of).fold(0.0, f64::max) / places.iter().map(of).fold(f64::INFINITY, f64::min)
        };
        let along: fn(&Moes) -> f64 = if ratio(|p| p.m) > ratio(|p| p.l) { |p| p.m } else { |p| p.l };
        places.sort_by(|a, b| along(a).total_cmp(&along(b)));
        Some([places.first()?, places.last()?].map(|place| [place.m, place.l]))
    };
    found.into_iter().filter_map(ends).collect()
}

/// Returns places (M, L) for the names of the regimes, away from the most important contacts. Text at M < 1 begins
/// there; text at M > 1000 ends there. The regimes of elliptical contacts lie elsewhere: a regime that contains none of
/// these places has no name on the chart.
pub fn names(shape: FilmShape) -> Vec<(Regime, [f64; 2])> {
    let places: [&[[f64; 2]]; 4] = match shape {
        FilmShape::Line => [&[[0.43, 0.6]], &[[30.0, 0.5]], &[[0.5, 15.0]], &[[1100.0, 22.0]]],
        FilmShape::Ellipse(_) => [
            &[[0.6, 2.5]],
            &[[60.0, 0.45]],
            &[[5.5, 22.0], [30.0, 25.0], [120.0, 28.0]],
            &[[1100.0, 13.5], [1100.0, 5.0], [1100.0, 2.5]],
        ],
    };
    use Regime::{ElasticIsoviscous, ElasticPiezoviscous, RigidIsoviscous, RigidPiezoviscous};
    let regimes = [RigidIsoviscous, ElasticIsoviscous, RigidPiezoviscous, ElasticPiezoviscous];
    let first = |(regime, places): (Regime, &[[f64; 2]])| {
        let place = places.iter().find(|[m, l]| Regime::of(shape, Moes { m: *m, l: *l }) == regime)?;
        Some((regime, *place))
    };
    regimes.into_iter().zip(places).filter_map(first).collect()
}

/// Returns the regime chart for print, with one contact marked.
pub fn chart(shape: FilmShape, moes: Moes) -> Chart {
    let mut chart = Chart::new("Regime", ChartAxis::log("Load number M"), ChartAxis::log("Lubricant number L"));
    // The axes are extended if the contact lies outside.
    let around = |(from, to): (f64, f64), value: f64| Some((from.min(0.7 * value), to.max(1.4 * value)));
    (chart.x.ends, chart.y.ends) = (around(M_AXIS, moes.m), around(L_AXIS, moes.l));
    let pen = Pen { color: [0x88; 3], opacity: 1.0, width: 0.8, dashes: Vec::new() };
    for ends in boundaries(shape) {
        let (name, points) = (String::new(), ends.to_vec());
        chart.series.push(Series { name, marks: Marks::Line, points, pen: Some(pen.clone()) });
    }
    let (name, points) = ("this contact".to_owned(), vec![[moes.m, moes.l]]);
    let pen = Pen { color: [0xD5, 0x5E, 0x00], opacity: 1.0, width: 1.6, dashes: Vec::new() };
    chart.series.push(Series { name, marks: Marks::Dots, points, pen: Some(pen) });
    for (regime, at) in names(shape) {
        let [m, _] = at;
        let beside = match m {
            ..1.0 => Beside::Right,
            1000.0.. => Beside::Left,
            _ => Beside::Middle,
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
        let of = |shape, m, l| Regime::of(shape, Moes { m, l });
        let line = FilmShape::Line;
        assert_eq!(of(line, 0.6, 0.3), Regime::RigidIsoviscous);
        assert_eq!(of(line, 1000.0, 0.3), Regime::ElasticIsoviscous);
        assert_eq!(of(line, 1.0, 25.0), Regime::RigidPiezoviscous);
        assert_eq!(of(line, 200.0, 15.0), Regime::ElasticPiezoviscous);
        let ellipse = FilmShape::Ellipse;
        for (shape, count) in [(line, 4), (FilmShape::CIRCLE, 4), (ellipse(0.5), 4), (ellipse(20.0), 4)] {
            assert_eq!(names(shape).len(), count, "{shape:?}");
        }
        // Wide elliptical contacts stay rigid up to larger loads.
        assert_eq!(of(FilmShape::CIRCLE, 8.0, 0.3), Regime::ElasticIsoviscous);
        assert_eq!(of(FilmShape::Ellipse(20.0), 8.0, 0.3), Regime::RigidIsoviscous);
    }

    #[test]
    fn a_contact_stands_on_the_chart_wherever_it_is() {
        for (shape, m, l) in [(FilmShape::Line, 40.0, 10.0), (FilmShape::CIRCLE, 1e4, 0.01)] {
            let chart = chart(shape, Moes { m, l });
            let ([x, y], here) = ([chart.x.ends, chart.y.ends].map(Option::unwrap), chart.series.last().unwrap());
            assert_eq!(here.points, [[m, l]]);
            assert!(x.0 < m && m < x.1 && y.0 < l && l < y.1, "{x:?} {y:?}");
            assert!(chart.series.len() > 4 && chart.notes.len() == 4);
        }
    }
}
