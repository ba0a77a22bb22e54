//! Estimated errors of a reduced solution, and what their bounds allow for where a film cavitates by another law than the
//! full solutions by which errors were measured.

use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::Cavitation;
use serde::{Deserialize, Serialize};

/// An error that was not measured.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Estimated {
    /// Its likely size (median of similar cases).
    pub likely: f64,
    /// What 99 of 100 errors stay below.
    pub bound: f64,
}

/// Relative errors of a reduced solution against the full one on the same grid.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorEstimate {
    /// Of the central film, |H̃_c/H_c − 1|.
    pub h_c: Estimated,
    /// Of the smallest film.
    pub h_min: Estimated,
    /// Of the state, e_z of (3.10).
    pub state: Estimated,
    /// Of the traction coefficient (3.41), of a model that knows sliding and where an isothermal traction has a
    /// meaning.
    pub traction: Option<Estimated>,
    /// Of the rise of temperature at mid-film, X = 0, of a model that knows heat; where it rises by less than a kelvin,
    /// in kelvin.
    pub rise: Option<Estimated>,
}

/// By how much the default penalty of full solutions moves H_c of lines against complementarity at most, relative to it.
const MOVES_H_C: f64 = 3.5e-7;
/// And H_min, whose place is where the film ruptures: so much, and so much for each unit of M. Of 2,000 contacts with M 2…1000
/// it is moved by 8e-7 in the median and by up to 3.8e-5, more than the bounds of most that do not allow for it.
const MOVES_H_MIN: (f64, f64) = (2e-6, 4e-8);

impl ErrorEstimate {
    /// The same against a full solution that ruptures by the law that is asked for. Only lines are so exact that it counts:
    /// films of circles are moved by up to 1.8e-4, four tenths of their bounds at most, which hold as before.
    pub fn against(mut self, point: &OperatingPoint, asked: Cavitation, measured_by: Cavitation) -> Self {
        if (point.kind, asked, measured_by) == (ContactKind::Line, Cavitation::Penalty, Cavitation::Complementarity) {
            self.h_c.bound += MOVES_H_C;
            self.h_min.bound += MOVES_H_MIN.0 + MOVES_H_MIN.1 * point.moes().m;
        }
        self
    }
}
