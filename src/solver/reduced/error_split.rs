//! Where the error of a reduced solution comes from.
//!
//! Four solutions of one contact lie between a reduced one and the truth, and each step between them has one cause:
//!
//! | from | to | error |
//! |---|---|---|
//! | full, extrapolated to vanishing spacing | full on the model's grid | discretisation |
//! | full on the model's grid | its best approximation in the basis | basis |
//! | best approximation | Galerkin solution: all rows, same basis | projection |
//! | Galerkin solution | the reduced solution: sampled rows | sampling |
//!
//! The steps are signed, in units of the full film on the model's grid, and add up to the whole by construction. They
//! may cancel: a film of the Galerkin solution is often nearer to the truth than that of the best approximation,
//! because its H₀ is free to follow.
//!
//! **Best approximation**: the state (P, H₀) projected onto the trial space, in the weighted product under which the
//! basis is orthonormal, among pressures that carry the load, as every reduced solution does. No reduced solution is
//! nearer to P in that norm.
//!
//! **Discretisation**: full solutions on the model's grid and on the next finer one (`ReferenceGrid::refined`), and
//! Richardson's extrapolation with order two, which the scheme has (H_c on uniform grids: 1.98–1.99). The ends of the
//! domain are the model's own; what a longer inlet would change is not part of it. The smallest *nodal* film has an
//! error that jumps with the node it falls on, so the parabola through it and its neighbours is extrapolated and the
//! nodal value held against that. Against three grids finer than a coarse one of 300 nodes (M 25, 40, 70) this was
//! right to 0.05 % for H_c and to 4, 9 and 13 % for H_min. Heights of spikes do not converge on these grids; pressures
//! therefore have no discretisation part. Point contacts are extrapolated in both directions at once, with a second
//! grid of half the spacings ([`second_grid`]), or of twice the spacings where the finer one would take too long.
//!
//! A reduced model of point contacts may have a softer penalty than the full system. What that costs is part of the
//! projection.

use super::model::{ReducedModel, Window};
use super::online::{Online, ReducedError, ReducedOptions};
use super::operators::fronts;
use super::reduced_solution::ReducedSolution;
use super::sampling::{Sampling, TestSpace, all_rows};
use crate::solver::discrete::grid::{ContactGrid, FIRST_UNKNOWN, GridError, dot};
use crate::solver::full::point::{Accuracy, second_grid};
use crate::solver::full::{ContactSolver, FullSolver, PointSolver, Scalars, Solution, SolveError, Start, Termination};
use crate::solver::observer::Observer;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::Lubricant;
use faer::Mat;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// 2² − 1: an error of second order on a grid and on the one with half its spacing.
const RICHARDSON: f64 = 3.0;

/// Why an error cannot be split.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SplitError {
    /// The problem itself is refused.
    #[error(transparent)]
    Problem(#[from] SolveError),
    /// The model has no finer grid.
    #[error("the model's grid cannot be refined: {0}")]
    Grid(#[from] GridError),
    /// The reduced model has no solution here.
    #[error(transparent)]
    Reduced(#[from] ReducedError),
    /// The model with all rows has none.
    #[error("with all rows {0}")]
    Galerkin(#[source] ReducedError),
    /// A full solve did not converge, or the second grid does not belong to the first: a sentence.
    #[error("{0}")]
    Full(String),
    /// The observer asked to stop.
    #[error("cancelled")]
    Cancelled,
}

/// Signed parts of one scalar's error, each relative to the full solution on the model's grid.
#[derive(Clone, Copy, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct Parts {
    /// Best approximation minus full.
    pub basis: f64,
    /// All rows minus best approximation.
    pub projection: f64,
    /// Sampled rows minus all rows.
    pub sampling: f64,
    /// Full minus its extrapolated limit.
    pub discretisation: f64,
}

impl Parts {
    /// The reduced solution against the full one on the same grid: what verification shows.
    pub fn reduction(&self) -> f64 {
        self.basis + self.projection + self.sampling
    }

    /// The reduced solution against the extrapolated limit.
    pub fn whole(&self) -> f64 {
        self.reduction() + self.discretisation
    }

    /// The parts by name, in the order in which a model gains them.
    pub fn named(&self) -> [(&'static str, f64); 4] {
        [
            ("basis", self.basis),
            ("projection", self.projection),
            ("sampling", self.sampling),
            ("discretisation", self.discretisation),
        ]
    }
}

/// Distances of pressures e_P = ‖ΔP‖/‖P‖ in the weighted norm. They are lengths: they do not add up.
#[derive(Clone, Copy, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct PressureParts {
    /// Best approximation from full: the least any solution in this basis can have.
    pub basis: f64,
    /// All rows from best approximation.
    pub projection: f64,
    /// Sampled rows from all rows.
    pub sampling: f64,
    /// Sampled rows from full.
    pub reduction: f64,
}

/// The error of one reduced solution, by cause.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorSplit {
    /// The reduced solution whose error it is.
    pub reduced: ReducedSolution,
    /// Scalars of the reduced solution.
    pub scalars: Scalars,
    /// Scalars of the full solution on the model's grid.
    pub full: Scalars,
    /// Parts of the error of H_c.
    pub h_c: Parts,
    /// Parts of the error of H_min.
    pub h_min: Parts,
    /// Parts of the error of the pressure.
    pub pressure: PressureParts,
}

/// Splits errors of one model under one truncation; keeps grids, operators and work space between contacts.
pub struct ErrorSplitter {
    sampled: Online,
    windows: Vec<Option<References>>,
}

/// What a window's reduced solutions are compared with.
struct References {
    all_rows: Online,
    full: ContactSolver,
    /// Finer than the model's grid, or coarser where a finer one would take too long.
    second: ContactSolver,
}

impl ErrorSplitter {
    /// A splitter; grids and operators are made per window when first needed.
    pub fn new(model: Arc<ReducedModel>, options: ReducedOptions) -> Self {
        let windows = model.windows.iter().map(|_| None).collect();
        Self { sampled: Online::new(model, options), windows }
    }

    /// Splits the error at one contact.
    ///
    /// # Errors
    /// When the contact is refused, one of the solutions cannot be had, or the observer cancels.
    pub fn split(
        &mut self,
        point: &OperatingPoint,
        lubricant: Lubricant,
        observer: &dyn Observer,
    ) -> Result<ErrorSplit, SplitError> {
        let Self { sampled, windows } = self;
        sampled.forget();
        let reduced = sampled.solve(point, lubricant)?;
        let model = Arc::clone(&sampled.model);
        let (Some(window), Some(references)) = (model.windows.get(reduced.window), windows.get_mut(reduced.window))
        else {
            return Err(ReducedError::Empty.into());
        };
        let references = match references {
            Some(references) => references,
            None => references.insert(References::new(&model, window, sampled.options())?),
        };
        references.all_rows.forget();
        let galerkin = references.all_rows.solve(point, lubricant).map_err(SplitError::Galerkin)?;
        let galerkin = references.all_rows.reconstruct(&galerkin).map_err(SplitError::Galerkin)?;
        // The truth must not depend on what it judges: the full solve starts cold.
        let solved = references.full.solve(point, lubricant, Start::Cold, observer)?;
        let full = converged(solved, "the model’s grid")?;
        let solved = references.second.solve(point, lubricant, Start::From(&full), observer)?;
        let second = converged(solved, "the second grid")?;
        let best = best_approximation(window, &full, &reduced);
        let best = sampled.reconstruct(&best)?;
        let fields = sampled.reconstruct(&reduced)?;
        let steps = [&full, &best, &galerkin, &fields];

        let (h_c_limit, h_min_limit) = limits(window, &full, &second)?;
        let distance = |a: &Solution, b: &Solution| distance(window.grid.weights(), a, b, &full);
        Ok(ErrorSplit {
            h_c: parts(steps.map(|s| s.scalars.h_c), h_c_limit),
            h_min: parts(steps.map(|s| s.scalars.h_min), h_min_limit),
            pressure: PressureParts {
                basis: distance(&best, &full),
                projection: distance(&galerkin, &best),
                sampling: distance(&fields, &galerkin),
                reduction: distance(&fields, &full),
            },
            scalars: fields.scalars,
            full: full.scalars,
            reduced,
        })
    }
}

impl References {
    fn new(model: &ReducedModel, window: &Window, options: &ReducedOptions) -> Result<Self, SplitError> {
        let second = match &window.grid {
            ContactGrid::Line(grid) => ContactSolver::Line(FullSolver::on(grid.refined()?)),
            ContactGrid::Point(grid) => ContactSolver::Point(PointSolver::on(second_grid(grid.spec).build()?)),
        };
        let mut exact = window.clone();
        exact.set_rows(Sampling::All, all_rows(&TestSpace::new(window.pressure.basis(), &window.grid)));
        let exact = ReducedModel { windows: vec![exact], ..model.clone() };
        Ok(Self { all_rows: Online::new(Arc::new(exact), *options), full: ContactSolver::on(&window.grid), second })
    }
}

fn converged(solution: Solution, grid: &str) -> Result<Solution, SplitError> {
    match solution.report.termination {
        Termination::Converged => Ok(solution),
        Termination::Cancelled => Err(SplitError::Cancelled),
        termination => Err(SplitError::Full(format!("the full solve on {grid} {}", termination.describe()))),
    }
}

/// The projection of a full state onto the trial space of a reduced solution, among pressures that carry the load.
fn best_approximation(window: &Window, full: &Solution, reduced: &ReducedSolution) -> ReducedSolution {
    let weights = window.grid.weights();
    let basis = window.pressure.basis().clone().cut(reduced.coefficients.len());
    let load = window.pressure.carried(weights, basis.modes.ncols());
    // The shortest way to the right load runs along the best approximation of what carries it.
    let fields = Mat::from_fn(weights.len(), 2, |i, k| if k == 0 { full.pressure[i] } else { 1.0 });
    let best = basis.best_coefficients(weights, fields.as_ref());
    let [mut coefficients, way] = [0, 1].map(|k| best.col(k).iter().copied().collect::<Vec<f64>>());
    let missing = full.problem.load / full.mesh.scale - dot(&load, &coefficients);
    let step = missing / dot(&load, &way);
    for (c, way) in coefficients.iter_mut().zip(&way) {
        *c += step * way;
    }
    let ruptured = !reduced.fronts.is_empty();
    let fronts = if ruptured { fronts(&window.grid, |node| full.pressure[node]) } else { Vec::new() };
    ReducedSolution { coefficients, fronts, beside: Vec::new(), h_0: full.scalars.h_0, ..reduced.clone() }
}

/// Parts of one scalar, given for full, best approximation, all rows, sampled rows.
fn parts([full, best, galerkin, reduced]: [f64; 4], limit: f64) -> Parts {
    Parts {
        basis: (best - full) / full,
        projection: (galerkin - best) / full,
        sampling: (reduced - galerkin) / full,
        discretisation: (full - limit) / full,
    }
}

/// H_c and H_min on vanishing spacings.
fn limits(window: &Window, full: &Solution, second: &Solution) -> Result<(f64, f64), SplitError> {
    match &window.grid {
        ContactGrid::Line(_) => {
            let h_c = extrapolate(full.scalars.h_c, second.scalars.h_c);
            Ok((h_c, extrapolate(lowest_film(full), lowest_film(second))))
        }
        ContactGrid::Point(_) => {
            let incomparable = || {
                let (first, second) = (full.y.len(), second.y.len());
                SplitError::Full(format!(
                    "the grid's part cannot be extrapolated: {first} and {second} nodes across the contact do not belong \
                     together"
                ))
            };
            let accuracy = Accuracy::of_either(full, second).ok_or_else(incomparable)?;
            Ok((accuracy.h_c.limit, accuracy.h_min.limit))
        }
    }
}

fn extrapolate(coarse: f64, fine: f64) -> f64 {
    fine + (fine - coarse) / RICHARDSON
}

/// ‖P_a − P_b‖/‖P‖ in the weighted norm.
fn distance(weights: &[f64], a: &Solution, b: &Solution, full: &Solution) -> f64 {
    let norm = |value: &dyn Fn(usize) -> f64| -> f64 {
        weights.iter().enumerate().map(|(i, w)| w * value(i).powi(2)).sum::<f64>().sqrt()
    };
    norm(&|i| a.pressure[i] - b.pressure[i]) / norm(&|i| full.pressure[i])
}

/// The smallest film between nodes: the vertex of the parabola through the smallest nodal film and its neighbours.
fn lowest_film(solution: &Solution) -> f64 {
    let at = solution.x.partition_point(|&x| x < solution.scalars.x_h_min - 1e-12);
    let at = at.clamp(FIRST_UNKNOWN, solution.x.len() - 2);
    let (x, h) = (&solution.x[at - 1..=at + 1], &solution.film[at - 1..=at + 1]);
    let (left, right) = ((h[1] - h[0]) / (x[1] - x[0]), (h[2] - h[1]) / (x[2] - x[1]));
    let curvature = (right - left) / (x[2] - x[0]);
    // H(x) = h₁ + slope (x − x₁) + curvature (x − x₁)².
    let slope = left + curvature * (x[1] - x[0]);
    if curvature > 0.0 { h[1] - slope * slope / (4.0 * curvature) } else { h[1] }
}
