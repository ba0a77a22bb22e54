//! What a reduced model is made of.

use crate::solver::contact::{Moes, OperatingPoint};
use crate::solver::full::Problem;
use crate::solver::grid::ReferenceGrid;
use crate::solver::lubricant::Lubricant;
use faer::Mat;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The range a model declares to be trained for: an interval each of M, L, α and p_H at its η₀, for its lubricant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Domain {
    /// Load number.
    pub m: (f64, f64),
    /// Lubricant number.
    pub l: (f64, f64),
    /// Pressure–viscosity coefficient \[1/Pa\].
    pub alpha_per_pa: (f64, f64),
    /// Largest Hertzian pressure \[Pa\].
    pub max_hertz_pressure_pa: f64,
    /// Ambient viscosity \[Pa·s\].
    pub viscosity_pa_s: f64,
    /// Laws of the lubricant.
    pub lubricant: Lubricant,
}

/// Whether a model was trained for a problem.
#[derive(Clone, Debug, PartialEq)]
pub enum Trust {
    /// Inside the declared domain.
    Trained,
    /// Outside, with a sentence that says in which quantity and by how much.
    Outside(String),
}

/// How the rows of the reduced system are sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Default)]
pub enum Sampling {
    /// Every row: no sampling error, large-scale cost.
    All,
    /// The dissertation's greedy of Fig. 2.9 with the rows of V_p themselves.
    Greedy,
    /// Q-DEIM with its fixed reconstruction.
    #[default]
    QDeim,
}

/// A POD basis with all its singular values.
#[derive(Clone, Debug)]
pub struct PodBasis {
    /// One mode per column over the node array, orthonormal under the grid's weights.
    pub modes: Mat<f64>,
    /// All singular values of the snapshots, also of modes that were not kept.
    pub singular_values: Vec<f64>,
}

/// A training solution as the model keeps it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Snapshot {
    /// The operating point.
    pub point: OperatingPoint,
    /// Its coefficients in the pressure basis.
    pub coefficients: Vec<f64>,
    /// Its H₀.
    pub h_0: f64,
    /// Its central film H_c, from the full solution.
    pub h_c: f64,
}

/// One local model: a window of M with its own grid, bases and sampled rows.
#[derive(Clone, Debug)]
pub struct Window {
    /// Range of M for which this window is used.
    pub m: (f64, f64),
    /// The reference grid of its solutions.
    pub grid: Arc<ReferenceGrid>,
    /// Pressure basis.
    pub pressure: PodBasis,
    /// Deformation basis.
    pub deformation: PodBasis,
    /// How rows were sampled.
    pub sampling: Sampling,
    /// Sampled rows as indices of unknowns (node index minus 2), ascending.
    pub sampled_rows: Vec<usize>,
    /// Training solutions.
    pub snapshots: Vec<Snapshot>,
}

/// A reduced model of the stationary line contact.
#[derive(Clone, Debug)]
pub struct ReducedModel {
    /// Title for people.
    pub title: String,
    /// What it was trained for.
    pub domain: Domain,
    /// Local models by ascending M.
    pub windows: Vec<Window>,
    /// What the training did, one sentence per line.
    pub log: Vec<String>,
}

impl PodBasis {
    /// Loss of information when only the first `k` modes are kept, (2.90).
    pub fn loss(&self, k: usize) -> f64 {
        let total: f64 = self.singular_values.iter().sum();
        self.singular_values.iter().skip(k).sum::<f64>() / total
    }

    /// Fewest modes whose loss does not exceed `loss`, (2.92), at least one and at most all that are kept.
    pub fn modes_for(&self, loss: f64) -> usize {
        (1..=self.modes.ncols()).find(|&k| self.loss(k) <= loss).unwrap_or(self.modes.ncols())
    }
}

impl ReducedModel {
    /// Index of the window that serves a contact.
    pub fn window_for(&self, moes: Moes) -> usize {
        self.windows.iter().position(|w| moes.m <= w.m.1).unwrap_or(self.windows.len().saturating_sub(1))
    }

    /// Whether the model was trained for a problem.
    pub fn trust(&self, problem: &Problem) -> Trust {
        self.domain.trust(problem)
    }
}

impl Domain {
    /// Whether a problem lies inside; boundaries count as inside to rounding.
    pub fn trust(&self, problem: &Problem) -> Trust {
        if problem.lubricant != self.lubricant {
            return Trust::Outside("the model was trained with other lubricant laws".to_owned());
        }
        let point = &problem.point;
        if (point.viscosity_pa_s / self.viscosity_pa_s - 1.0).abs() > 1e-6 {
            return Trust::Outside(format!(
                "the model was trained at an ambient viscosity of {} Pa·s, not {} Pa·s",
                self.viscosity_pa_s, point.viscosity_pa_s
            ));
        }
        let p_h = point.hertz().pressure_pa;
        let checks = [
            ("M", problem.moes.m, self.m, 1.0, ""),
            ("L", problem.moes.l, self.l, 1.0, ""),
            ("α", point.alpha_per_pa, self.alpha_per_pa, 1e9, "/GPa"),
            ("p_H", p_h, (0.0, self.max_hertz_pressure_pa), 1e-9, " GPa"),
        ];
        for (name, value, (low, high), scale, unit) in checks {
            if value < low * (1.0 - 1e-6) || value > high * (1.0 + 1e-6) {
                return Trust::Outside(format!(
                    "{name} = {:.4}{unit} lies outside the trained range {:.4}…{:.4}{unit}",
                    value * scale,
                    low * scale,
                    high * scale
                ));
            }
        }
        Trust::Trained
    }
}
