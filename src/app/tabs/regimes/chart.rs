//! Fixed content of the M–L chart: boundaries of regimes, contours, limits. It is computed once per shape and
//! model.

use crate::app::export;
use crate::app::theme::Palette;
use crate::scene::names;
use crate::scene::regime::{Regime, RegimeMap};
use crate::scene::regimes::{L_AXIS, M_AXIS, SAMPLES, boundaries, names, spread};
use crate::solver::parameters::ParameterSpace;
use crate::solver::physics::contact::{
    ContactKind, FilmShape, Moes, MoesRequest, OperatingPoint, PLAUSIBLE_HERTZ_PRESSURE_PA, si_from_moes,
};
use crate::solver::reduced::{Domain, ReducedModel};
use egui::ColorImage;
use egui_plot::PlotPoint;

/// Film numbers of the contours.
const CONTOURS: [f64; 11] = [0.35, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0];

/// Kind of a line of the chart. The exported table contains its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A contour of the film number.
    Contour,
    /// A boundary between two regimes.
    Boundary,
    /// p_H = 3.2 GPa in the default realisation.
    PressureLimit,
    /// Outline of the trained range, cut by its pressure limit.
    Trained,
    /// Training contacts of the model, drawn as points.
    Snapshots,
    /// Outline of the point contacts of Table 3.4.
    Table,
    /// The trajectory (3.21) through them, Fig. 3.8.
    Trajectory,
}

/// Line of the chart in (log10 M, log10 L).
pub struct ChartLine {
    pub kind: Kind,
    /// Film number of a contour, or number of a boundary.
    pub value: Option<f64>,
    pub points: Vec<PlotPoint>,
}

/// All lines of the chart.
pub struct ChartLines {
    /// Lines in the order of their kinds.
    pub lines: Vec<ChartLine>,
    /// Positions of the names of the regimes.
    pub names: Vec<(Regime, PlotPoint)>,
}

/// Returns a place of the chart.
pub fn point(m: f64, l: f64) -> PlotPoint {
    PlotPoint::new(m.log10(), l.log10())
}

impl ChartLines {
    /// Returns all lines for a shape and, if there is one, its model.
    pub fn new(shape: FilmShape, model: Option<&ReducedModel>) -> Self {
        let mut lines = Vec::new();
        let mut add = |kind, value, points| lines.push(ChartLine { kind, value, points });
        for film in CONTOURS {
            let points = contour(shape, film);
            if points.len() > 1 {
                add(Kind::Contour, Some(film), points);
            }
        }
        for (k, line) in boundaries(shape).into_iter().enumerate() {
            add(Kind::Boundary, Some(k as f64), line.into_iter().map(|[m, l]| point(m, l)).collect());
        }
        // For wide elliptical contacts the limit is outside the chart.
        let limit = pressure_limit(shape);
        if limit.len() > 1 {
            add(Kind::PressureLimit, None, limit);
        }
        if let Some(model) = model {
            let snapshots =
                model.windows.iter().flat_map(|window| &window.snapshots).map(|snapshot| snapshot.point.moes());
            add(Kind::Trained, None, trained(shape, &model.domain));
            add(Kind::Snapshots, None, snapshots.map(|moes| point(moes.m, moes.l)).collect());
        }
        // Point contacts of the dissertation.
        if shape == FilmShape::CIRCLE {
            add(Kind::Table, None, outline(&ParameterSpace::table_3_4(), shape.kind()));
            add(Kind::Trajectory, None, trajectory(&ParameterSpace::table_3_4(), shape.kind()));
        }
        Self { lines, names: names(shape).into_iter().map(|(regime, [m, l])| (regime, point(m, l))).collect() }
    }

    /// Returns the lines as CSV.
    pub fn csv(&self) -> String {
        let row = |line: &ChartLine, p: &PlotPoint| {
            vec![Some(10f64.powf(p.x)), Some(10f64.powf(p.y)), Some(f64::from(line.kind as u8)), line.value]
        };
        let rows = self.lines.iter().flat_map(|line| line.points.iter().map(move |p| row(line, p)));
        let comment = "kind 0: contour of Moes' film number (value); 1: regime boundary; 2: p_H 3.2 GPa; \
                       3: trained range; 4: snapshot; 5: Table 3.4; 6: trajectory (3.21)";
        export::csv(&[comment.to_owned()], &[names::M, names::L, "kind", "value"], rows)
    }
}

/// Returns the largest number in a range up to which a condition holds. It must hold at the lower end.
fn up_to((mut low, mut high): (f64, f64), holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..40 {
        let middle = (low * high).sqrt();
        if holds(middle) { low = middle } else { high = middle }
    }
    low
}

/// Returns a contour. The film number is monotonic in L, so bisection in ln L finds it for every M.
fn contour(shape: FilmShape, film: f64) -> Vec<PlotPoint> {
    (0..SAMPLES)
        .filter_map(|k| {
            let m = spread(M_AXIS, k, SAMPLES);
            let value = |l: f64| shape.film(Moes { m, l });
            let within = value(L_AXIS.0) <= film && film <= value(L_AXIS.1);
            within.then(|| point(m, up_to(L_AXIS, |l| value(l) < film)))
        })
        .collect()
}

/// Returns a function for p_H \[Pa\] of the default realisation at M and L. For an elliptical contact it is a fixed
/// share of that of a circular contact.
fn hertz_pressure(shape: FilmShape) -> impl Fn(f64, f64) -> f64 {
    let pressure = |point: OperatingPoint| point.hertz().pressure_pa;
    let [own, circle] = shape.hertz_and_circle();
    let share = own.pressure_pa / circle.pressure_pa;
    move |m, l| share * si_from_moes(&MoesRequest::new(shape.kind(), m, l)).map_or(f64::INFINITY, pressure)
}

/// Returns L at which the default realisation reaches p_H = 3.2 GPa, for every M where it is in the chart. p_H
/// rises with L.
fn pressure_limit(shape: FilmShape) -> Vec<PlotPoint> {
    const LIMIT: f64 = PLAUSIBLE_HERTZ_PRESSURE_PA;
    let hertz = hertz_pressure(shape);
    (0..SAMPLES)
        .filter_map(|k| {
            let m = spread(M_AXIS, k, SAMPLES);
            let pressure = |l: f64| hertz(m, l);
            let within = pressure(L_AXIS.0) <= LIMIT && LIMIT <= pressure(L_AXIS.1);
            within.then(|| point(m, up_to(L_AXIS, |l| pressure(l) < LIMIT)))
        })
        .collect()
}

/// Returns the rectangle of M and L, with its upper right corner cut by the pressure limit.
fn trained(shape: FilmShape, domain: &Domain) -> Vec<PlotPoint> {
    let (m, l, highest) = (domain.m(), domain.l(), domain.highest_pressure_pa());
    let hertz = hertz_pressure(shape);
    let below = |m: f64, l: f64| hertz(m, l) <= highest;
    let top = |m: f64| if below(m, l.1) { l.1 } else { up_to(l, |l| below(m, l)) };
    let mut outline = vec![point(m.0, l.0)];
    outline.extend((0..SAMPLES).map(|k| spread(m, k, SAMPLES)).map(|m| point(m, top(m))));
    outline.extend([point(m.1, l.0), point(m.0, l.0)]);
    outline
}

/// Returns the closed convex hull of a box's contacts. M and L are products of powers of the quantities. In
/// logarithmic axes the box therefore becomes a polygon with corners of the box; on linear axes its sides are
/// curved.
fn outline(range: &ParameterSpace, kind: ContactKind) -> Vec<PlotPoint> {
    let moes = range.corners().filter_map(|unit| Some(range.at(kind, &unit)?.moes()));
    let mut corners: Vec<PlotPoint> = moes.map(|moes| point(moes.m, moes.l)).collect();
    corners.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let turn = |a: &PlotPoint, b: &PlotPoint, c: &PlotPoint| (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    let half = |points: &mut dyn Iterator<Item = &PlotPoint>| {
        let mut hull: Vec<PlotPoint> = Vec::new();
        for p in points {
            while matches!(hull.as_slice(), [.., a, b] if turn(a, b, p) <= 0.0) {
                hull.pop();
            }
            hull.push(*p);
        }
        hull
    };
    let mut hull = half(&mut corners.iter());
    hull.extend(half(&mut corners.iter().rev()).into_iter().skip(1));
    hull
}

/// Returns the test trajectory through a box, 0 ≤ c ≤ 2.
fn trajectory(range: &ParameterSpace, kind: ContactKind) -> Vec<PlotPoint> {
    let at = |k: usize| Some(range.trajectory(kind, 2.0 * k as f64 / SAMPLES as f64)?.moes());
    (0..=SAMPLES).filter_map(at).map(|moes| point(moes.m, moes.l)).collect()
}

/// Returns the regimes as an image with smooth transitions.
pub fn shading(shape: FilmShape, palette: &Palette) -> ColorImage {
    let (width, height) = (280, 180);
    let map = RegimeMap::new(shape);
    let mut pixels = Vec::with_capacity(width * height);
    for j in 0..height {
        for i in 0..width {
            let moes = Moes { m: spread(M_AXIS, i, width), l: spread(L_AXIS, height - 1 - j, height) };
            pixels.push(palette.regimes[map.regime(moes) as usize]);
        }
    }
    ColorImage::new([width, height], pixels)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chart_lines_are_finite_and_present() {
        for shape in [FilmShape::Line, FilmShape::CIRCLE, FilmShape::Ellipse(0.1), FilmShape::Ellipse(40.0)] {
            let lines = ChartLines::new(shape, None);
            let of = |kind: Kind| lines.lines.iter().filter(move |line| line.kind == kind);
            // Extreme ellipses have fewer regimes within the chart.
            let regimes = if matches!(shape, FilmShape::Ellipse(ratio) if ratio != 1.0) { 2 } else { 4 };
            assert!(of(Kind::Boundary).count() == 2 && of(Kind::Contour).count() >= 6, "{shape:?}");
            assert!(of(Kind::PressureLimit).all(|line| line.points.len() > 10), "{shape:?}");
            assert!(lines.names.len() >= regimes, "{shape:?}");
            let all = lines.lines.iter().flat_map(|line| &line.points);
            assert!(all.clone().count() > 500 && all.into_iter().all(|p| p.x.is_finite() && p.y.is_finite()));
            assert_eq!(of(Kind::Table).count() == 0, shape != FilmShape::CIRCLE);
        }
    }

    #[test]
    fn table_3_4_contains_its_trajectory() {
        let lines = ChartLines::new(FilmShape::CIRCLE, None).lines;
        let of = |kind: Kind| &lines.iter().find(|line| line.kind == kind).unwrap().points;
        let table = of(Kind::Table);
        let ends = |of: fn(&PlotPoint) -> f64| {
            let values = || table.iter().map(of);
            (10f64.powf(values().fold(f64::MAX, f64::min)), 10f64.powf(values().fold(f64::MIN, f64::max)))
        };
        let ((m_low, m_high), (l_low, l_high)) = (ends(|p| p.x), ends(|p| p.y));
        assert!((m_low - 12.8).abs() < 0.05 && (m_high - 857.9).abs() < 0.5, "{m_low} {m_high}");
        assert!((l_low - 1.7).abs() < 0.05 && (l_high - 14.1).abs() < 0.05, "{l_low} {l_high}");
        for p in of(Kind::Trajectory) {
            let inside = table
                .windows(2)
                .all(|w| (w[1].x - w[0].x) * (p.y - w[0].y) - (w[1].y - w[0].y) * (p.x - w[0].x) > -1e-9);
            assert!(inside, "{p:?}");
        }
    }
}
