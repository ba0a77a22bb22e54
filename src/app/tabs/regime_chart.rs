//! Everything in the M–L chart that does not move: regimes, boundaries, contours, limits. Made once.

use crate::app::export;
use crate::app::theme::Palette;
use crate::scene::QuantityBox;
use crate::solver::physics::contact::{
    ContactKind, FilmAsymptotes, Moes, MoesRequest, PLAUSIBLE_HERTZ_PRESSURE_PA, moes_film, si_from_moes,
};
use crate::solver::reduced::{Domain, ReducedModel};
use egui::ColorImage;
use egui_plot::PlotPoint;

/// M at the ends of the chart.
pub const M_AXIS: (f64, f64) = (0.4, 1500.0);
/// L at the ends of the chart.
pub const L_AXIS: (f64, f64) = (0.2, 32.0);
/// Film numbers of the contours.
const CONTOURS: [f64; 9] = [0.7, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0];

/// An asymptotic regime.
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
    /// The regime whose asymptote Moes' formula follows at M and L: iso parts add up (the larger rules), piezo parts
    /// add up inversely (the smaller rules), and the larger of both sides wins.
    pub fn of(kind: ContactKind, moes: Moes) -> Self {
        let a = FilmAsymptotes::of(kind, moes);
        let iso = a.rigid_isoviscous.max(a.elastic_isoviscous);
        if iso > a.rigid_piezoviscous.min(a.elastic_piezoviscous) {
            if a.rigid_isoviscous > a.elastic_isoviscous { Self::RigidIsoviscous } else { Self::ElasticIsoviscous }
        } else if a.rigid_piezoviscous < a.elastic_piezoviscous {
            Self::RigidPiezoviscous
        } else {
            Self::ElasticPiezoviscous
        }
    }

    /// For people.
    pub fn name(self) -> &'static str {
        match self {
            Self::RigidIsoviscous => "rigid,\nisoviscous",
            Self::ElasticIsoviscous => "elastic,\nisoviscous",
            Self::RigidPiezoviscous => "rigid,\npiezoviscous",
            Self::ElasticPiezoviscous => "elastic,\npiezoviscous",
        }
    }

    /// Its name in a line.
    pub fn title(self) -> &'static str {
        match self {
            Self::RigidIsoviscous => "Rigid, isoviscous",
            Self::ElasticIsoviscous => "Elastic, isoviscous",
            Self::RigidPiezoviscous => "Rigid, piezoviscous",
            Self::ElasticPiezoviscous => "Elastic, piezoviscous",
        }
    }

    /// What happens in it.
    pub fn meaning(self) -> &'static str {
        match self {
            Self::RigidIsoviscous => "The bodies keep their shape, the oil its viscosity",
            Self::ElasticIsoviscous => "The bodies flatten, the oil keeps its viscosity",
            Self::RigidPiezoviscous => "The bodies keep their shape, pressure stiffens the oil",
            Self::ElasticPiezoviscous => "The bodies flatten, pressure stiffens the oil",
        }
    }

    const ALL: [Self; 4] =
        [Self::RigidIsoviscous, Self::ElasticIsoviscous, Self::RigidPiezoviscous, Self::ElasticPiezoviscous];
}

/// What a line of the chart is. The table of the chart knows them by their places here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A contour of the film number.
    Contour,
    /// A boundary between two regimes.
    Boundary,
    /// p_H = 3.2 GPa in the default realisation.
    PressureLimit,
    /// Outline of what the model is trained for, cut by its pressure limit.
    Trained,
    /// Contacts that the model was trained by; no line.
    Snapshots,
    /// Outline of the point contacts of Table 3.4.
    Table,
    /// The trajectory (3.21) through them, Fig. 3.8.
    Trajectory,
}

/// A line of the chart in (log10 M, log10 L).
pub struct ChartLine {
    /// What it is.
    pub kind: Kind,
    /// The film number of a contour; which boundary it is.
    pub value: Option<f64>,
    /// Its points.
    pub points: Vec<PlotPoint>,
}

/// All lines of the chart.
pub struct ChartLines {
    /// In the order of their kinds.
    pub lines: Vec<ChartLine>,
    /// Where the regimes' names stand.
    pub names: Vec<(Regime, PlotPoint)>,
}

/// Points along each line.
const SAMPLES: usize = 240;

fn spread((low, high): (f64, f64), k: usize, of: usize) -> f64 {
    (low.ln() + (high.ln() - low.ln()) * k as f64 / (of - 1) as f64).exp()
}

/// A place of the chart.
pub fn point(m: f64, l: f64) -> PlotPoint {
    PlotPoint::new(m.log10(), l.log10())
}

impl ChartLines {
    /// All lines for a kind of contact, and of its model where there is one.
    pub fn new(kind: ContactKind, model: Option<&ReducedModel>) -> Self {
        let mut lines = Vec::new();
        let mut add = |kind, value, points| lines.push(ChartLine { kind, value, points });
        for film in CONTOURS {
            let points = contour(kind, film);
            if points.len() > 1 {
                add(Kind::Contour, Some(film), points);
            }
        }
        for (k, points) in boundaries(kind).into_iter().enumerate() {
            add(Kind::Boundary, Some(k as f64), points);
        }
        add(Kind::PressureLimit, None, pressure_limit(kind));
        if let Some(model) = model {
            let snapshots =
                model.windows.iter().flat_map(|window| &window.snapshots).map(|snapshot| snapshot.point.moes());
            add(Kind::Trained, None, trained(kind, &model.domain));
            add(Kind::Snapshots, None, snapshots.map(|moes| point(moes.m, moes.l)).collect());
        }
        if kind == ContactKind::Point {
            add(Kind::Table, None, outline(&QuantityBox::TABLE_3_4, kind));
            add(Kind::Trajectory, None, trajectory(&QuantityBox::TABLE_3_4, kind));
        }
        Self { lines, names: names(kind) }
    }

    /// The lines as a table.
    pub fn csv(&self) -> String {
        let row = |line: &ChartLine, p: &PlotPoint| {
            vec![Some(10f64.powf(p.x)), Some(10f64.powf(p.y)), Some(f64::from(line.kind as u8)), line.value]
        };
        let rows = self.lines.iter().flat_map(|line| line.points.iter().map(move |p| row(line, p)));
        let comment = "kind 0: contour of Moes' film number (value); 1: regime boundary; 2: p_H 3.2 GPa; \
                       3: trained range; 4: snapshot; 5: Table 3.4; 6: trajectory (3.21)";
        export::csv(&[comment.to_owned()], &["M", "L", "kind", "value"], rows)
    }
}

/// The greatest place in a range of positive numbers up to which a condition holds that holds at its lower end.
fn up_to((mut low, mut high): (f64, f64), holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..40 {
        let middle = (low * high).sqrt();
        if holds(middle) { low = middle } else { high = middle }
    }
    low
}

/// Regime boundaries: along each row and column of a fine lattice, the places where the regime changes, sharpened by
/// bisection.
fn boundaries(kind: ContactKind) -> Vec<Vec<PlotPoint>> {
    let mut found: Vec<((Regime, Regime), Vec<PlotPoint>)> = Vec::new();
    let mut add = |a: Regime, b: Regime, p: PlotPoint| {
        let pair = if Regime::ALL.iter().position(|r| *r == a) < Regime::ALL.iter().position(|r| *r == b) {
            (a, b)
        } else {
            (b, a)
        };
        match found.iter_mut().find(|f| f.0 == pair) {
            Some((_, points)) => points.push(p),
            None => found.push((pair, vec![p])),
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
                let (a, b) = (Regime::of(kind, place(low)), Regime::of(kind, place(high)));
                if a == b {
                    continue;
                }
                for _ in 0..24 {
                    let middle = 0.5 * (low + high);
                    if Regime::of(kind, place(middle)) == a { low = middle } else { high = middle }
                }
                let at = place(0.5 * (low + high));
                add(a, Regime::of(kind, place(high)), point(at.m, at.l));
            }
        }
    }
    found
        .into_iter()
        .map(|(_, mut points)| {
            // Every boundary is a straight line in these axes: order along its longer extent.
            let span = |f: &dyn Fn(&PlotPoint) -> f64| {
                points.iter().map(f).fold(f64::MIN, f64::max) - points.iter().map(f).fold(f64::MAX, f64::min)
            };
            if span(&|p| p.x) > span(&|p| p.y) {
                points.sort_by(|a, b| a.x.total_cmp(&b.x));
            } else {
                points.sort_by(|a, b| a.y.total_cmp(&b.y));
            }
            match (points.first(), points.last()) {
                (Some(first), Some(last)) => vec![*first, *last],
                _ => Vec::new(),
            }
        })
        .collect()
}

/// The film number is monotonic in L: bisection in ln L for every M.
fn contour(kind: ContactKind, film: f64) -> Vec<PlotPoint> {
    (0..SAMPLES)
        .filter_map(|k| {
            let m = spread(M_AXIS, k, SAMPLES);
            let value = |l: f64| moes_film(kind, Moes { m, l });
            let within = value(L_AXIS.0) <= film && film <= value(L_AXIS.1);
            within.then(|| point(m, up_to(L_AXIS, |l| value(l) < film)))
        })
        .collect()
}

/// Places for the regimes' names, of those left of M = 1 their beginning, clear of the contacts that matter most.
fn names(kind: ContactKind) -> Vec<(Regime, PlotPoint)> {
    let places = match kind {
        ContactKind::Line => [(0.43, 0.6), (30.0, 0.5), (0.5, 15.0), (480.0, 22.0)],
        ContactKind::Point => [(0.6, 2.5), (60.0, 0.45), (5.5, 22.0), (800.0, 13.5)],
    };
    Regime::ALL.into_iter().zip(places).map(|(regime, (m, l))| (regime, point(m, l))).collect()
}

fn hertz_pressure(kind: ContactKind, m: f64, l: f64) -> f64 {
    si_from_moes(&MoesRequest::new(kind, m, l)).map_or(f64::INFINITY, |p| p.hertz().pressure_pa)
}

/// L at which the default realisation reaches p_H = 3.2 GPa, for every M that does within the chart. p_H rises with L.
fn pressure_limit(kind: ContactKind) -> Vec<PlotPoint> {
    const LIMIT: f64 = PLAUSIBLE_HERTZ_PRESSURE_PA;
    (0..SAMPLES)
        .filter_map(|k| {
            let m = spread(M_AXIS, k, SAMPLES);
            let pressure = |l: f64| hertz_pressure(kind, m, l);
            let within = pressure(L_AXIS.0) <= LIMIT && LIMIT <= pressure(L_AXIS.1);
            within.then(|| point(m, up_to(L_AXIS, |l| pressure(l) < LIMIT)))
        })
        .collect()
}

/// The box of M and L, its upper right corner cut by the pressure limit.
fn trained(kind: ContactKind, domain: &Domain) -> Vec<PlotPoint> {
    let (m, l) = (domain.m, domain.l);
    let below = |m: f64, l: f64| hertz_pressure(kind, m, l) <= domain.max_hertz_pressure_pa;
    let top = |m: f64| if below(m, l.1) { l.1 } else { up_to(l, |l| below(m, l)) };
    let mut outline = vec![point(m.0, l.0)];
    outline.extend((0..SAMPLES).map(|k| spread(m, k, SAMPLES)).map(|m| point(m, top(m))));
    outline.extend([point(m.1, l.0), point(m.0, l.0)]);
    outline
}

/// The convex hull of a box's contacts, closed. M and L are products of powers of the quantities: in logarithmic axes
/// the box becomes a polygon, with its corners among those of the box; on linear axes its sides are curved.
fn outline(range: &QuantityBox, kind: ContactKind) -> Vec<PlotPoint> {
    let end = |corner: u32, bit: u32| f64::from(corner >> bit & 1);
    let mut corners: Vec<PlotPoint> = (0..16)
        .map(|k| range.at(kind, [end(k, 0), end(k, 1), end(k, 2), end(k, 3)]).moes())
        .map(|moes| point(moes.m, moes.l))
        .collect();
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

/// The test trajectory through a box, 0 ≤ c ≤ 2.
fn trajectory(range: &QuantityBox, kind: ContactKind) -> Vec<PlotPoint> {
    let at = |k: usize| range.trajectory(kind, 2.0 * k as f64 / SAMPLES as f64).moes();
    (0..=SAMPLES).map(at).map(|moes| point(moes.m, moes.l)).collect()
}

/// The regimes as a picture, blended softly where they meet.
pub fn shading(kind: ContactKind, palette: &Palette) -> ColorImage {
    let (width, height) = (280, 180);
    let mut pixels = Vec::with_capacity(width * height);
    for j in 0..height {
        for i in 0..width {
            let moes = Moes { m: spread(M_AXIS, i, width), l: spread(L_AXIS, height - 1 - j, height) };
            pixels.push(palette.regimes[Regime::of(kind, moes) as usize]);
        }
    }
    ColorImage::new([width, height], pixels)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_corners_belong_to_the_regimes_of_the_literature() {
        let of = |kind, m, l| Regime::of(kind, Moes { m, l });
        let line = ContactKind::Line;
        assert_eq!(of(line, 0.6, 0.3), Regime::RigidIsoviscous);
        assert_eq!(of(line, 1000.0, 0.3), Regime::ElasticIsoviscous);
        assert_eq!(of(line, 1.0, 25.0), Regime::RigidPiezoviscous);
        assert_eq!(of(line, 200.0, 15.0), Regime::ElasticPiezoviscous);
        for kind in [ContactKind::Line, ContactKind::Point] {
            for (regime, place) in names(kind) {
                assert_eq!(of(kind, 10f64.powf(place.x), 10f64.powf(place.y)), regime, "{kind:?}");
            }
        }
    }

    #[test]
    fn chart_lines_are_finite_and_present() {
        for kind in [ContactKind::Line, ContactKind::Point] {
            let lines = ChartLines::new(kind, None);
            let of = |kind: Kind| lines.lines.iter().filter(move |line| line.kind == kind);
            assert!(of(Kind::Boundary).count() >= 4 && of(Kind::Contour).count() >= 6, "{kind:?}");
            assert!(of(Kind::PressureLimit).all(|line| line.points.len() > 10), "{kind:?}");
            assert_eq!(lines.names.len(), 4);
            let all = lines.lines.iter().flat_map(|line| &line.points);
            assert!(all.clone().count() > 500 && all.into_iter().all(|p| p.x.is_finite() && p.y.is_finite()));
            assert_eq!(of(Kind::Table).count() == 0, kind == ContactKind::Line);
        }
    }

    #[test]
    fn the_box_of_table_3_4_has_the_numbers_the_dissertation_states_and_holds_its_trajectory() {
        let lines = ChartLines::new(ContactKind::Point, None).lines;
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
