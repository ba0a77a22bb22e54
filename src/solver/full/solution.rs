//! What is solved and what comes out: a problem and a solution are values that know what they belong to.

use crate::solver::contact::{ContactError, ContactKind, Moes, OperatingPoint};
use crate::solver::grid::{FIRST_UNKNOWN, GridError, GridSpec, LineGrid, dot};
use crate::solver::lubricant::{Lubricant, LubricantError, ScaledFluid, ScaledShear, Sliding};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Why a solve cannot be started.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SolveError {
    /// The operating point is refused.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// The lubricant is refused.
    #[error(transparent)]
    Lubricant(#[from] LubricantError),
    /// The grid is refused.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// The kind of contact is not available.
    #[error("the point contact is not part of this version; use a line contact")]
    PointContact,
}

/// One dimensionless problem: what the solver needs of an operating point and a lubricant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Problem {
    /// The operating point it was made from.
    pub point: OperatingPoint,
    /// The laws it was made with.
    pub lubricant: Lubricant,
    /// The sliding and the plateau it was made with.
    pub sliding: Sliding,
    /// The laws with their constants.
    pub fluid: ScaledFluid,
    /// The shear-thinning law with its constants; `None` where the fluid is Newtonian.
    pub shear: Option<ScaledShear>,
    /// Moes numbers.
    pub moes: Moes,
    /// 1/λ̄ of (2.23).
    pub inverse_lambda: f64,
    /// ∫P dX: π/2, (2.28).
    pub load: f64,
}

impl Problem {
    /// Checks the point and the lubricant and makes them dimensionless: pure rolling, with the lubricant's own plateau ratio.
    ///
    /// # Errors
    /// When either is outside its valid range.
    pub fn new(point: &OperatingPoint, lubricant: Lubricant) -> Result<Self, SolveError> {
        Self::under_sliding(point, lubricant, Sliding::default())
    }

    /// The same under sliding. Where α follows from the viscosity law, the problem's point has that α, whatever the given one has.
    ///
    /// # Errors
    /// When the point, the lubricant or the sliding is outside its valid range.
    pub fn under_sliding(point: &OperatingPoint, lubricant: Lubricant, sliding: Sliding) -> Result<Self, SolveError> {
        lubricant.check()?;
        let alpha_per_pa = lubricant.own_coefficient().unwrap_or(point.alpha_per_pa);
        let point = &OperatingPoint { alpha_per_pa, ..*point };
        point.check()?;
        if point.kind == ContactKind::Point {
            return Err(SolveError::PointContact);
        }
        let fluid = lubricant.scaled(point)?;
        Ok(Self {
            point: *point,
            lubricant,
            sliding,
            fluid,
            shear: ScaledShear::new(lubricant.shear, sliding, point)?,
            moes: point.moes(),
            inverse_lambda: 1.0 / point.lambda_bar(),
            load: 0.5 * PI,
        })
    }
}

/// Why a solve stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Termination {
    /// ‖Δz‖/‖z‖ fell below the tolerance.
    Converged,
    /// The iteration limit was reached.
    IterationLimit,
    /// The iterates left every sensible range.
    Diverged,
    /// The pressures left the range of the viscosity law.
    OccupiedVolume,
    /// The observer asked to stop.
    Cancelled,
}

impl Termination {
    /// One sentence for people.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Converged => "converged",
            Self::IterationLimit => {
                "stopped at the iteration limit; try a start from a converged neighbour, a finer grid or a longer inlet"
            }
            Self::Diverged => "diverged; try a start from a converged neighbour, a smaller load or a finer grid",
            Self::OccupiedVolume => {
                "met pressures at which the lubricant's relative volume falls under its occupied volume, where Doolittle's law ends; use a smaller load or another lubricant"
            }
            Self::Cancelled => "was cancelled",
        }
    }
}

/// How a solution was obtained.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Why it stopped.
    pub termination: Termination,
    /// Newton steps, all attempts together.
    pub newton_iterations: usize,
    /// Krylov iterations, all attempts together.
    pub linear_iterations: usize,
    /// Starts that were tried (1 when the first one converged).
    pub attempts: usize,
    /// Residual 2-norm before each Newton step: rows weighted by √w so that it approximates the L2 norm over X.
    pub residuals: Vec<f64>,
    /// ‖Δz‖/‖z‖ of each Newton step.
    pub steps: Vec<f64>,
    /// Residual 2-norm of the solution.
    pub residual_norm: f64,
}

/// Scalars of a solution. Positions and values are dimensionless, (2.22).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, Default)]
pub struct Scalars {
    /// Film at X = 0 (interpolated where no node lies there).
    pub h_c: f64,
    /// Smallest nodal film in −1.2 < X < 1.5.
    pub h_min: f64,
    /// Its position.
    pub x_h_min: f64,
    /// Pressure at X = 0.
    pub p_c: f64,
    /// Largest nodal pressure.
    pub p_max: f64,
    /// Its position.
    pub x_p_max: f64,
    /// Rigid-body displacement H₀ with the kernel of (2.27).
    pub h_0: f64,
    /// |∫P/(π/2) − 1|.
    pub load_residual: f64,
}

/// Traction of a Newtonian fluid per unit slide-to-roll ratio, (3.41): coefficient = `per_srr` · SRR.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Traction {
    /// Coefficient at SRR = 1.
    pub per_srr: f64,
}

/// Fields and scalars of one contact, with what they were computed for and how.
#[derive(Clone, Debug)]
pub struct Solution {
    /// What was solved.
    pub problem: Problem,
    /// Reference grid it was solved on.
    pub grid: GridSpec,
    /// Scale of the registration map.
    pub grid_scale: f64,
    /// Node abscissae X (node array: leading outside node).
    pub x: Vec<f64>,
    /// P at the nodes.
    pub pressure: Vec<f64>,
    /// H at the nodes.
    pub film: Vec<f64>,
    /// Scalars.
    pub scalars: Scalars,
    /// How it was obtained.
    pub report: Report,
}

impl Solution {
    /// Whether it may be shown as a result.
    pub fn converged(&self) -> bool {
        self.report.termination == Termination::Converged
    }

    /// Deformation Δ = H − H₀ − X²/2 at the nodes (the logarithmic kernel's own constant included).
    pub fn deformation(&self) -> Vec<f64> {
        self.x.iter().zip(&self.film).map(|(x, h)| h - self.scalars.h_0 - 0.5 * x * x).collect()
    }

    /// The profile without the outside node: X, P, H.
    pub fn profile(&self) -> impl Iterator<Item = (f64, f64, f64)> + '_ {
        self.x.iter().zip(&self.pressure).zip(&self.film).skip(1).map(|((&x, &p), &h)| (x, p, h))
    }

    /// Position and height of the pressure spike: the last local maximum in 0.2 < X < 1.2 that stands out, if there is one.
    pub fn spike(&self) -> Option<(f64, f64)> {
        let p = &self.pressure;
        (1..p.len() - 1)
            .rev()
            .filter(|&i| self.x[i] > 0.2 && self.x[i] < 1.2)
            .find(|&i| p[i] > 0.05 && p[i] > p[i - 1] && p[i] >= p[i + 1])
            .map(|i| (self.x[i], p[i]))
    }

    /// Where the film ruptures: first node behind the contact with P ≤ 0.
    pub fn rupture(&self) -> Option<f64> {
        let last = self.pressure.iter().rposition(|&p| p > 0.0)?;
        self.x.get(last + 1).copied()
    }

    /// Newtonian traction over the whole domain, (3.41), positive for SRR > 0, as the mean shear stress on the surfaces over the load.
    pub fn traction(&self) -> Traction {
        // τ = η u_s / h with u_s = SRR u_m; friction = ∫τ dx / w, the Poiseuille part cancels in the mean of both surfaces.
        let point = &self.problem.point;
        let hertz = point.hertz();
        let stress_scale = point.viscosity_pa_s * point.speed_m_per_s / point.film_scale_m();
        let mut integral = 0.0;
        for i in 1..self.x.len() - 1 {
            let value = |k: usize| {
                if self.pressure[k] > 0.0 {
                    self.problem.fluid.at(self.pressure[k]).viscosity / self.film[k]
                } else {
                    1.0 / self.film[k]
                }
            };
            integral += 0.5 * (value(i) + value(i + 1)) * (self.x[i + 1] - self.x[i]);
        }
        Traction { per_srr: stress_scale * hertz.half_width_m * integral / point.load }
    }
}

/// Scalars of fields on a grid.
pub fn scalars_of(grid: &LineGrid, problem: &Problem, pressure: &[f64], film: &[f64], h_0: f64) -> Scalars {
    let mut out = Scalars {
        h_c: grid.at(film, 0.0),
        p_c: grid.at(pressure, 0.0),
        h_min: f64::INFINITY,
        p_max: f64::NEG_INFINITY,
        h_0,
        load_residual: (dot(&grid.weights, pressure) / problem.load - 1.0).abs(),
        ..Scalars::default()
    };
    for i in FIRST_UNKNOWN..grid.len() - 1 {
        let x = grid.x[i];
        if film[i] < out.h_min && x > -1.2 && x < 1.5 {
            (out.h_min, out.x_h_min) = (film[i], x);
        }
        if pressure[i] > out.p_max {
            (out.p_max, out.x_p_max) = (pressure[i], x);
        }
    }
    out
}
