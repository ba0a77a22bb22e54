//! Initial guess of the online iteration by kriging between the training solutions of a local model.
//!
//! Universal kriging with the covariance −r³ (distance r) and a quadratic trend is interpolation by radial functions
//! without a length parameter. It interpolates the pressure coefficients, the logarithm of the film thickness
//! relative to a formula, and the cavitation boundary at once.

use super::dense;
use super::model::Window;
use super::start::{FilmUnit, Guess};
use crate::solver::parameters::{MOST_NUMBERS, Metric, Place, apart};
use crate::solver::physics::contact::OperatingPoint;
use faer::Mat;

/// Number of terms of a quadratic trend in the given number of coordinates; and the maximum.
const fn terms(numbers: usize) -> usize {
    (numbers + 1) * (numbers + 2) / 2
}
const MOST_TERMS: usize = terms(MOST_NUMBERS);
/// Minimum number of solutions per term.
const FEWEST: usize = 2;
/// Ridge for trends that the solutions do not determine.
const RIDGE: f64 = 1e-9;

/// Interpolation between the training solutions of a local model.
pub(super) struct Kriging {
    metric: Metric,
    centre: Place,
    /// Unit of distances.
    length: f64,
    places: Vec<Place>,
    /// Contributions of each solution, then of each term: coefficients, ln of the film thickness, cavitation
    /// boundaries.
    weights: Vec<f64>,
    modes: usize,
    /// Number of interpolated values.
    numbers: usize,
}

impl Kriging {
    /// Fits the interpolation to the snapshots of a local model. `None` if there are too few, or if they do not
    /// differ enough.
    pub fn of(window: &Window, metric: Metric) -> Option<Self> {
        let snapshots = &window.snapshots;
        let (count, modes) = (snapshots.len(), window.pressure.count());
        let lines = snapshots.first()?.fronts.len();
        let apart_by = metric.len();
        let trends = terms(apart_by);
        if count < FEWEST * trends {
            return None;
        }
        let own: Vec<Place> = snapshots.iter().map(|snapshot| metric.place(&snapshot.point)).collect();
        let centre: Place = std::array::from_fn(|k| own.iter().map(|place| place[k]).sum::<f64>() / count as f64);
        let length = (own.iter().map(|place| apart(*place, centre)).sum::<f64>() / count as f64).sqrt();
        let places: Vec<Place> = own.iter().map(|place| scaled(*place, centre, length)).collect();
        let terms: Vec<[f64; MOST_TERMS]> = places.iter().map(|place| trend(*place, apart_by)).collect();
        let system = Mat::from_fn(count + trends, count + trends, |i, j| match (i < count, j < count) {
            (true, true) => cubed(apart(places[i], places[j])),
            (true, false) => terms[i][j - count],
            (false, true) => terms[j][i - count],
            (false, false) => {
                if i == j {
                    -RIDGE
                } else {
                    0.0
                }
            }
        });
        let numbers = modes + 1 + lines;
        let known = Mat::from_fn(count + trends, numbers, |i, k| match (snapshots.get(i), k.checked_sub(modes)) {
            (None, _) => 0.0,
            (Some(snapshot), None) => snapshot.coefficients[k],
            (Some(snapshot), Some(0)) => FilmUnit::of(window, &snapshot.point).number(snapshot.h_c).ln(),
            (Some(snapshot), Some(line)) => snapshot.fronts[line - 1] as f64,
        });
        let solved = dense::solved(system.as_ref(), known);
        let weights: Vec<f64> =
            (0..count + trends).flat_map(|i| (0..numbers).map(move |k| (i, k))).map(|at| solved[at]).collect();
        let sound = weights.iter().all(|weight| weight.is_finite());
        sound.then_some(Self { metric, centre, length, places, weights, modes, numbers })
    }

    /// Returns the initial guess for a contact of the same local model; `None` if it is not finite.
    pub fn start(&self, window: &Window, point: &OperatingPoint) -> Option<Guess> {
        let place = scaled(self.metric.place(point), self.centre, self.length);
        let mut coefficients = vec![0.0; self.numbers];
        let near = self.places.iter().map(|other| cubed(apart(place, *other)));
        let trends = trend(place, self.metric.len());
        for (factor, weights) in near.chain(trends).zip(self.weights.chunks_exact(self.numbers)) {
            coefficients.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += factor * weight);
        }
        let fronts = coefficients[self.modes + 1..].iter().map(|front| (front + 0.5).max(0.0) as usize).collect();
        let h_c = FilmUnit::of(window, point).film(coefficients[self.modes].exp());
        coefficients.truncate(self.modes);
        let sound = h_c.is_finite() && (h_c > 0.0 || window.is_rough()) && coefficients.iter().all(|c| c.is_finite());
        sound.then_some(Guess { coefficients, h_c, fronts, theta: Vec::new() })
    }
}

fn scaled(place: Place, centre: Place, length: f64) -> Place {
    std::array::from_fn(|k| (place[k] - centre[k]) / length)
}

/// Returns the terms of the trend: 1, the coordinates, and their products.
fn trend(place: Place, numbers: usize) -> [f64; MOST_TERMS] {
    let mut terms = [1.0; MOST_TERMS];
    terms[1..=numbers].copy_from_slice(&place[..numbers]);
    let mut at = numbers + 1;
    for i in 0..numbers {
        for j in i..numbers {
            terms[at] = place[i] * place[j];
            at += 1;
        }
    }
    terms
}

/// Returns r³ for a given r².
fn cubed(square: f64) -> f64 {
    square * square.sqrt()
}
