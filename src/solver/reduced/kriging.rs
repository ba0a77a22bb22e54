//! A start of the online iteration by kriging: what the training solutions of a window say of a contact between them.
//!
//! Universal kriging with the covariance −r³ and a quadratic trend is interpolation by radial functions: no length has to
//! be chosen. Coefficients of the pressure, the logarithm of the film over the formula's, and the rupture boundary are
//! interpolated at once.

use super::dense;
use super::model::Window;
use super::oils::{apart, oil_place};
use super::start::{Guess, film_number};
use crate::solver::physics::contact::OperatingPoint;
use faer::Mat;

/// Terms of the trend: of a quadratic in four numbers.
const TERMS: usize = 15;
/// Solutions without which there is no trend.
const FEWEST: usize = 2 * TERMS;
/// What trends that the solutions cannot tell apart are held by.
const RIDGE: f64 = 1e-9;

/// Interpolates between the training solutions of a window.
pub(super) struct Kriging {
    centre: [f64; 4],
    /// Length in which places are counted.
    length: f64,
    places: Vec<[f64; 4]>,
    /// Of each solution, then of each term, what it contributes: coefficients, ln of the film, fronts.
    weights: Vec<f64>,
    modes: usize,
    /// Numbers that are interpolated.
    numbers: usize,
}

impl Kriging {
    /// Of the snapshots of a window; `None` where they are too few or do not differ enough.
    pub fn of(window: &Window) -> Option<Self> {
        let snapshots = &window.snapshots;
        let (count, modes) = (snapshots.len(), window.pressure.count());
        let lines = snapshots.first()?.fronts.len();
        if count < FEWEST {
            return None;
        }
        let own: Vec<[f64; 4]> = snapshots.iter().map(|snapshot| oil_place(&snapshot.point)).collect();
        let centre: [f64; 4] = std::array::from_fn(|k| own.iter().map(|place| place[k]).sum::<f64>() / count as f64);
        let length = (own.iter().map(|place| apart(*place, centre)).sum::<f64>() / count as f64).sqrt();
        let places: Vec<[f64; 4]> = own.iter().map(|place| scaled(*place, centre, length)).collect();
        let terms: Vec<[f64; TERMS]> = places.iter().map(|place| trend(*place)).collect();
        let system = Mat::from_fn(count + TERMS, count + TERMS, |i, j| match (i < count, j < count) {
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
        let known = Mat::from_fn(count + TERMS, numbers, |i, k| match (snapshots.get(i), k.checked_sub(modes)) {
            (None, _) => 0.0,
            (Some(snapshot), None) => snapshot.coefficients[k],
            (Some(snapshot), Some(0)) => (snapshot.h_c / film_number(&snapshot.point)).ln(),
            (Some(snapshot), Some(line)) => snapshot.fronts[line - 1] as f64,
        });
        let solved = dense::solved(system.as_ref(), known);
        let weights: Vec<f64> =
            (0..count + TERMS).flat_map(|i| (0..numbers).map(move |k| (i, k))).map(|at| solved[at]).collect();
        let sound = weights.iter().all(|weight| weight.is_finite());
        sound.then_some(Self { centre, length, places, weights, modes, numbers })
    }

    /// The start for a contact; `None` where it is none.
    pub fn start(&self, point: &OperatingPoint) -> Option<Guess> {
        let place = scaled(oil_place(point), self.centre, self.length);
        let mut coefficients = vec![0.0; self.numbers];
        let near = self.places.iter().map(|other| cubed(apart(place, *other)));
        for (factor, weights) in near.chain(trend(place)).zip(self.weights.chunks_exact(self.numbers)) {
            coefficients.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += factor * weight);
        }
        let fronts = coefficients[self.modes + 1..].iter().map(|front| (front + 0.5).max(0.0) as usize).collect();
        let h_c = coefficients[self.modes].exp() * film_number(point);
        coefficients.truncate(self.modes);
        let sound = h_c.is_finite() && h_c > 0.0 && coefficients.iter().all(|c| c.is_finite());
        sound.then_some(Guess { coefficients, h_c, fronts, theta: Vec::new() })
    }
}

fn scaled(place: [f64; 4], centre: [f64; 4], length: f64) -> [f64; 4] {
    std::array::from_fn(|k| (place[k] - centre[k]) / length)
}

/// 1, the numbers, and their products.
fn trend(place: [f64; 4]) -> [f64; TERMS] {
    let mut terms = [1.0; TERMS];
    terms[1..5].copy_from_slice(&place);
    let mut at = 5;
    for i in 0..4 {
        for j in i..4 {
            terms[at] = place[i] * place[j];
            at += 1;
        }
    }
    terms
}

/// r³ of r².
fn cubed(square: f64) -> f64 {
    square * square.sqrt()
}
