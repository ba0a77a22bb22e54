//! Initial guesses of the online Newton iteration: an interpolation between the training solutions around the point,
//! and the nearest of them. The interpolation also transfers the film thickness and the pressure spike. The nearest
//! snapshot alone is the dissertation's choice.

use super::dense;
use super::model::{Snapshot, Window};
use crate::solver::discrete::heat::Profile;
use crate::solver::parameters::{REFERENCE_ROUGHNESS_M, SHAPE_WEIGHT, separation};
use crate::solver::physics::contact::{FilmFormula, FilmShape, OperatingPoint};
use crate::solver::physics::surfaces::{mean_gap, separation_of_gap};
use faer::Mat;

/// Number of snapshots for the interpolation of Newtonian contacts; of shear-thinning ones, with two more parameters;
/// and of elliptical ones, with one more.
const NEIGHBOURS: [usize; 3] = [6, 10, 8];
/// Weight of (ln α ratio)² in addition to (3.20).
const ALPHA_WEIGHT: f64 = 0.02;
/// Number of functions that the interpolation reproduces, for the same three kinds.
const FEATURES: [usize; 3] = [4, 6, 5];

/// Initial guess: coefficients of the pressure, and film thickness at X = 0 (and Y = 0). Modes without a coefficient
/// are omitted in the iteration that starts here.
#[derive(Clone)]
pub(super) struct Guess {
    pub coefficients: Vec<f64>,
    pub h_c: f64,
    /// First cavitated column of each line along X; empty with a penalty.
    pub fronts: Vec<usize>,
    /// θ at the stations of a thermal contact; empty to start without temperatures.
    pub theta: Vec<Profile>,
}

impl Guess {
    /// Returns the guess with this share of the modes.
    pub fn with_modes(&self, share: f64) -> Self {
        let mut fewer = self.clone();
        fewer.coefficients.truncate(((share * self.coefficients.len() as f64) as usize).max(1));
        fewer
    }
}

/// Distance by (3.20) below which the previous solution is preferred to an interpolation.
const DRAG_DISTANCE: f64 = 1e-3;
/// Largest squared step of a curve: the distance of (3.20) between neighbours.
const LONGEST_STEP: f64 = 0.03;
/// Largest distance of a contact from the line through the last two, relative to its distance from the last one; and
/// largest extrapolation, relative to the distance of the last two.
const BESIDE: f64 = 0.25;
const AHEAD: f64 = 1.5;

/// Converged solution.
pub(super) struct Known {
    pub window: usize,
    pub point: OperatingPoint,
    pub coefficients: Vec<f64>,
    pub h_c: f64,
    pub fronts: Vec<usize>,
    pub theta: Vec<Profile>,
}

/// Last two converged solutions, the latest first.
#[derive(Default)]
pub(super) struct Former {
    known: [Option<Known>; 2],
}

impl Former {
    pub fn remember(&mut self, latest: Known) {
        let [known, _] = std::mem::take(&mut self.known);
        self.known = [Some(latest), known];
    }

    /// Returns the latest solution, if it is near.
    pub fn beside(&self, window: usize, point: &OperatingPoint) -> Option<Guess> {
        let near = |known: &&Known| known.window == window && separation(point, &known.point) < DRAG_DISTANCE;
        self.known[0].as_ref().filter(near).map(|known| Guess {
            coefficients: known.coefficients.clone(),
            h_c: known.h_c * film_number(point) / film_number(&known.point),
            fronts: known.fronts.clone(),
            theta: known.theta.clone(),
        })
    }

    /// Extrapolates the last two solutions, if the contact is near and continues their line. Along a curve this
    /// halves the number of iterations.
    pub fn continued(&self, window: usize, point: &OperatingPoint) -> Option<Guess> {
        let [Some(latest), Some(before)] = &self.known else { return None };
        if latest.window != window || before.window != window {
            return None;
        }
        let [there, here, was] = [point, &latest.point, &before.point].map(coordinates);
        let (way, step) = (difference(there, here), difference(here, was));
        let (length, stride) = (square(way), square(step));
        if !(stride > 0.0 && stride < LONGEST_STEP && length < LONGEST_STEP) {
            return None;
        }
        let t = way.iter().zip(step).map(|(a, b)| a * b).sum::<f64>() / stride;
        let aside = square(difference(way, step.map(|s| t * s)));
        if !(t > 0.0 && t < AHEAD && aside <= BESIDE * BESIDE * length) {
            return None;
        }
        let ahead = |new: f64, old: f64| new + t * (new - old);
        let film = |known: &Known| (known.h_c / film_number(&known.point)).ln();
        let both = latest.coefficients.iter().zip(&before.coefficients);
        let profiles = latest.theta.iter().zip(&before.theta);
        Some(Guess {
            coefficients: both.map(|(new, old)| ahead(*new, *old)).collect(),
            h_c: ahead(film(latest), film(before)).exp() * film_number(point),
            fronts: latest.fronts.clone(),
            theta: profiles.map(|(new, old)| std::array::from_fn(|j| ahead(new[j], old[j]))).collect(),
        })
    }
}

/// Returns the coordinates of a contact, ln α included. Their squared distance is [`separation`] plus the weighted ln
/// α term, for contacts close together.
fn coordinates(point: &OperatingPoint) -> [f64; 6] {
    let (moes, sliding) = (point.moes(), point.sliding);
    let plateau = sliding.newtonian_plateau_ratio.unwrap_or(1.0);
    let squares = [0.5, 0.001, ALPHA_WEIGHT, 0.03, 0.3, SHAPE_WEIGHT];
    let (log_alpha, log_ratio) = (point.alpha_per_pa.ln(), point.log_ratio());
    let values = [moes.m.ln(), moes.l, log_alpha, sliding.slide_to_roll_ratio.abs(), plateau, log_ratio];
    std::array::from_fn(|k| f64::sqrt(squares[k]) * values[k])
}

fn difference(a: [f64; 6], b: [f64; 6]) -> [f64; 6] {
    std::array::from_fn(|k| a[k] - b[k])
}

fn square(v: [f64; 6]) -> f64 {
    v.iter().map(|v| v * v).sum()
}

/// Positive number that stands for the central film thickness H_c in interpolations, relative to a formula. For rough
/// surfaces it is the mean gap, because H_c is the distance of the mean planes, which may pass each other.
#[derive(Clone, Copy)]
pub(super) struct FilmUnit {
    formula: f64,
    /// σ in units of the film thickness; `None` for smooth surfaces.
    sigma: Option<f64>,
}

impl FilmUnit {
    /// Returns the unit of a contact of a local model, as it was trained.
    pub fn of(window: &Window, point: &OperatingPoint) -> Self {
        let sigma = window.is_rough().then(|| REFERENCE_ROUGHNESS_M / point.film_scale_m());
        Self { formula: film_number(point), sigma }
    }

    /// Returns the number of a film thickness H_c.
    pub fn number(&self, h_c: f64) -> f64 {
        self.sigma.map_or(h_c, |sigma| sigma * mean_gap(h_c / sigma).0) / self.formula
    }

    /// Returns the film thickness of a contact from that of another one, as the formula scales it.
    pub fn carried(window: &Window, h_c: f64, (from, to): (&OperatingPoint, &OperatingPoint)) -> f64 {
        if window.is_rough() {
            return Self::of(window, to).film(Self::of(window, from).number(h_c));
        }
        h_c * film_number(to) / film_number(from)
    }

    /// Returns the film thickness H_c of a number.
    pub fn film(&self, number: f64) -> f64 {
        let gap = number * self.formula;
        self.sigma.map_or(gap, |sigma| sigma * separation_of_gap(gap / sigma))
    }
}

/// Returns a film thickness formula in the solver's scaling up to a constant, to compare film thicknesses: Moes for
/// line contacts, Hamrock and Dowson for circular, Chittenden for elliptical contacts.
fn film_number(point: &OperatingPoint) -> f64 {
    let formula = match FilmShape::of(point) {
        FilmShape::Line => {
            let moes = point.moes();
            return FilmShape::Line.film(moes) / moes.m;
        }
        FilmShape::CIRCLE => FilmFormula::HamrockDowsonCentral,
        FilmShape::Ellipse(_) => FilmFormula::ChittendenCentral,
    };
    formula.predict(point).film_m / point.film_scale_m()
}

/// Returns the nearest training solution by (3.20), with its film thickness scaled by the formula.
pub(super) fn nearest(window: &Window, point: &OperatingPoint) -> Option<Guess> {
    window.nearest(point).map(|(snapshot, _)| carried(window, snapshot, point))
}

/// Returns a training solution with its film thickness scaled to a point by the formula.
pub(super) fn carried(window: &Window, snapshot: &Snapshot, point: &OperatingPoint) -> Guess {
    let h_c = FilmUnit::carried(window, snapshot.h_c, (&snapshot.point, point));
    Guess { coefficients: snapshot.coefficients.clone(), h_c, fronts: snapshot.fronts.clone(), theta: Vec::new() }
}

/// Returns the nearest training solution by (3.20) with its own film thickness.
pub(super) fn unchanged(window: &Window, point: &OperatingPoint) -> Option<Guess> {
    window.nearest(point).map(|(snapshot, _)| Guess { h_c: snapshot.h_c, ..carried(window, snapshot, point) })
}

/// Interpolates between the nearest training solutions. The weights reproduce functions linear in (ln M, L, ln α), with
/// the Moes parameters M and L; for shear-thinning contacts also in the slide-to-roll ratio |SRR| and the Newtonian
/// plateau ratio NPR, for elliptical ones in ln(R_y/R), and strongly prefer near solutions.
pub(super) fn interpolated(window: &Window, point: &OperatingPoint, thinning: bool) -> Option<Guess> {
    let kind = match window.shapes {
        Some(_) => 2,
        None => usize::from(thinning),
    };
    let (neighbours, count) = (NEIGHBOURS[kind], FEATURES[kind]);
    let moes = point.moes();
    let log_alpha = point.alpha_per_pa.ln();
    let mut around: Vec<(usize, f64)> = window
        .snapshots
        .iter()
        .enumerate()
        .map(|(i, s)| {
            let d = separation(point, &s.point) + ALPHA_WEIGHT * (s.point.alpha_per_pa.ln() - log_alpha).powi(2);
            (i, d)
        })
        .collect();
    if around.len() < neighbours {
        return None;
    }
    around.select_nth_unstable_by(neighbours - 1, |a, b| a.1.total_cmp(&b.1));
    around.truncate(neighbours);
    let plateau = |point: &OperatingPoint| point.sliding.newtonian_plateau_ratio.unwrap_or(1.0);
    let srr = |point: &OperatingPoint| point.sliding.slide_to_roll_ratio.abs();
    let features: Vec<[f64; 6]> = around
        .iter()
        .map(|&(i, _)| {
            let s = &window.snapshots[i].point;
            let m = s.moes();
            let (dl, d_alpha) = (0.2 * (m.l - moes.l), s.alpha_per_pa.ln() - log_alpha);
            let [first, second] = match window.shapes {
                Some(_) => [s.log_ratio_over(point), 0.0],
                None => [srr(s) - srr(point), plateau(s) - plateau(point)],
            };
            [1.0, (m.m / moes.m).ln(), dl, d_alpha, first, second]
        })
        .collect();
    // min Σ w² d²  subject to  Σ w φ = (1, 0, 0, 0); a small ridge covers ranges in which a feature does not vary.
    let inverse: Vec<f64> = around.iter().map(|(_, d)| 1.0 / (d * d + 1e-9)).collect();
    let scale: f64 = inverse.iter().sum();
    let normal = Mat::from_fn(count, count, |r, c| {
        let sum: f64 = features.iter().zip(&inverse).map(|(f, v)| v * f[r] * f[c]).sum();
        sum / scale + if r == c && r > 0 { 1e-7 } else { 0.0 }
    });
    let rhs = Mat::from_fn(count, 1, |r, _| if r == 0 { 1.0 } else { 0.0 });
    let multipliers = dense::solved(normal.as_ref(), rhs);
    let weights: Vec<f64> = features
        .iter()
        .zip(&inverse)
        .map(|(f, v)| v / scale * (0..count).map(|k| f[k] * multipliers[(k, 0)]).sum::<f64>())
        .collect();
    if weights.iter().any(|w| !w.is_finite() || w.abs() > 3.0) {
        return None;
    }
    let modes = window.pressure.count();
    let mut coefficients = vec![0.0; modes];
    let mut log_film = 0.0;
    let mut fronts = vec![0.5; window.snapshots.first().map_or(0, |snapshot| snapshot.fronts.len())];
    for (&(i, _), w) in around.iter().zip(&weights) {
        let snapshot = &window.snapshots[i];
        for (front, own) in fronts.iter_mut().zip(&snapshot.fronts) {
            *front += w * *own as f64;
        }
        for (c, s) in coefficients.iter_mut().zip(&snapshot.coefficients) {
            *c += w * s;
        }
        log_film += w * FilmUnit::of(window, &snapshot.point).number(snapshot.h_c).ln();
    }
    let fronts = fronts.into_iter().map(|front| front as usize).collect();
    Some(Guess { coefficients, h_c: FilmUnit::of(window, point).film(log_film.exp()), fronts, theta: Vec::new() })
}
