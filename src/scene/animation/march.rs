//! Animation of a transient contact: profiles or the map of the film, with film thickness and pressure over time.

use super::frame::{ALONG, FILM, PRESSURE, REFERENCE, add, composed, dot, encoded};
use crate::scene::chart::{Chart, ChartAxis};
use crate::scene::drawing::{AnimationError, Drawing, Rgb};
use crate::scene::report::film_over_plane;
use crate::scene::study::StudyRow;
use crate::scene::study::transient::{MarchedBy, Row};
use crate::solver::full::transient::{Moment, State, Trajectory};
use crate::solver::observer::Observer;
use crate::solver::physics::engineering::UnitSystem;

/// Largest number of frames.
const FRAMES: usize = 120;
/// Distance of the undeformed features below h = 0, in units of their largest height.
const BELOW: f64 = 1.3;

/// Returns the first full march of a transient study with its moments and fields. `None` if it has none.
pub fn full_march(rows: &[StudyRow]) -> Option<Trajectory> {
    let mut march: Option<Trajectory> = None;
    for row in rows {
        let StudyRow::Transient(row) = row else { continue };
        match (row, &mut march) {
            (Row::Begun { by: MarchedBy::Full, trajectory, .. }, None) => march = Some((**trajectory).clone()),
            (Row::Moment { moment, .. }, Some(march)) => march.moments.push(*moment),
            (Row::State { state, .. }, Some(march)) => march.states.push((**state).clone()),
            (Row::Marched(_), Some(_)) => break,
            _ => {}
        }
    }
    march.filter(|march| march.states.len() > 1)
}

/// Draws the frames of a march with its fields and encodes them as an animated PNG of 960×540 pixels.
///
/// # Errors
/// [`AnimationError`] if the march has no fields, or if the observer stops.
pub fn of_march(march: &Trajectory, dark: bool, observer: &dyn Observer) -> Result<Vec<u8>, AnimationError> {
    let count = march.states.len().min(FRAMES);
    let (scenery, last) = (Scenery::new(march, dark), march.states.len().saturating_sub(1));
    encoded(count, observer, |k| {
        let state = march.states.get(k * last / count.saturating_sub(1).max(1));
        state.map(|state| scenery.frame(state)).ok_or(AnimationError::Frames(0))
    })
}

/// Scales and ranges that all frames share.
struct Scenery<'a> {
    march: &'a Trajectory,
    dark: bool,
    /// Units of lengths \[mm\], film thicknesses \[µm\], pressures \[GPa\] and times \[ms\].
    units: [f64; 4],
    /// Largest central film thickness and pressure, smallest film thickness, and largest height of features.
    most: [f64; 4],
}

impl<'a> Scenery<'a> {
    fn new(march: &'a Trajectory, dark: bool) -> Self {
        let point = &march.transient.point;
        let hertz = point.hertz();
        let most = |of: fn(&Moment) -> f64| march.moments.iter().map(of).fold(0.0, f64::max);
        let least = march.moments.iter().map(|moment| moment.h_min).fold(f64::INFINITY, f64::min);
        let depth = march.transient.surfaces.iter().map(|surface| surface.shape.greatest()).fold(0.0, f64::max);
        Self {
            march,
            dark,
            units: [
                1e3 * hertz.half_width_m,
                1e6 * point.film_scale_m(),
                1e-9 * hertz.pressure_pa,
                1e3 * hertz.half_width_m / point.speed_m_per_s,
            ],
            most: [most(|m| m.h_c), most(|m| m.p_max), least, depth],
        }
    }

    fn frame(&self, state: &State) -> Drawing {
        let (left, right): (Vec<Chart>, Vec<Chart>) = match self.map(state) {
            Some(map) => (vec![map], self.profiles(state).into()),
            None => (self.profiles(state).into(), self.series(state).into()),
        };
        let (moes, ms) = (self.march.problem.moes, state.time * self.units[3]);
        let time = if ms < 1.0 { format!("{:.1} µs", 1e3 * ms) } else { format!("{ms:.3} ms") };
        let caption =
            format!("{{t}} = {time}   {{T}} = {:.2}   {{M}} = {:.1}   {{L}} = {:.1}", state.time, moes.m, moes.l);
        composed((&left, &right), &caption, self.dark)
    }

    /// Returns X, P and H along the axis in the scales of the reference contact.
    fn profile<'s>(&'s self, state: &'s State) -> impl Iterator<Item = [f64; 3]> + 's {
        let scales = state.scales;
        // Nodes of a point contact run from the outer edge to the axis first.
        let column = (state.pressure.len() / self.march.x.len().max(1)).max(1);
        let on_axis = move |field: &'s [f64]| field.iter().skip(column - 1).step_by(column);
        let nodes = self.march.x.iter().zip(on_axis(&state.pressure)).zip(on_axis(&state.film)).skip(1);
        let nodes = nodes.map(move |((x, p), h)| [x * scales.half_width, p * scales.pressure, h * scales.film]);
        nodes.filter(|[x, ..]| (ALONG.0..=ALONG.1).contains(x))
    }

    fn profiles(&self, state: &State) -> [Chart; 2] {
        let ([mm, um, gpa, _], [h_c, p_max, _, depth]) = (self.units, self.most);
        let axis = || ChartAxis { ends: Some((mm * ALONG.0, mm * ALONG.1)), ..ChartAxis::linear("{x} in mm") };
        let mut pressure = Chart::new("Pressure", axis(), ChartAxis::linear("{p} in GPa"));
        let mut film = Chart::new("Film thickness", axis(), ChartAxis::linear("{h} in µm"));
        (pressure.marked, film.marked) = (true, true);
        pressure.y.ends = Some((0.0, 1.1 * gpa * p_max));
        film.y.ends = Some((-2.0 * BELOW * depth * um, 3.0 * um * h_c));
        add(&mut pressure, "", (PRESSURE, 1.6), self.profile(state).map(|[x, p, _]| [mm * x, gpa * p]));
        let thin = self.profile(state).filter(|[.., h]| *h <= 3.0 * h_c);
        add(&mut film, "", (FILM, 1.6), thin.map(|[x, _, h]| [mm * x, um * h]));
        let surfaces = &self.march.transient.surfaces;
        let height = |x: f64| surfaces.iter().map(|surface| surface.height(x, 0.0, state.time)).sum::<f64>();
        if depth > 0.0 {
            let curve = (0..=400).map(|k| ALONG.0 + (ALONG.1 - ALONG.0) * f64::from(k) / 400.0);
            let curve = curve.map(|x| [mm * x, um * (height(x) - BELOW * depth)]);
            add(&mut film, "undeformed feature", (REFERENCE, 0.9), curve);
        }
        [pressure, film]
    }

    /// Returns central film thickness and pressure over time, with the moment of a state.
    fn series(&self, state: &State) -> [Chart; 2] {
        let [_, um, gpa, ms] = self.units;
        let one = |title: &str, label: &str, color: Rgb, of: &dyn Fn(&Moment) -> f64| {
            let mut chart = Chart::new(title, ChartAxis::linear("{t} in ms"), ChartAxis::linear(label));
            chart.marked = true;
            let points = self.march.moments.iter().map(|moment| [ms * moment.time, of(moment)]);
            add(&mut chart, "", (color, 1.4), points);
            let now = self.march.moments.iter().find(|moment| moment.time >= state.time);
            if let Some(now) = now {
                dot(&mut chart, color, [ms * now.time, of(now)]);
            }
            chart
        };
        [
            one("Central pressure", "{p_c} in GPa", PRESSURE, &|moment| gpa * moment.p_c),
            one("Central film thickness", "{h_c} in µm", FILM, &|moment| um * moment.h_c),
        ]
    }

    /// Returns the film of a point contact over its plane. `None` for a line contact.
    fn map(&self, state: &State) -> Option<Chart> {
        let x = &self.march.x;
        let y = self.march.mesh.plane()?.ordinates(state.film.len() / x.len().max(1));
        let [h_c, _, h_min, _] = self.most;
        let range = (h_min.max(0.0), 1.5 * h_c);
        Some(film_over_plane(&self.march.transient.point, (x, &y), &state.film, range, UnitSystem::default()))
    }
}
