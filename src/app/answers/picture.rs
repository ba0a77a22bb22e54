//! Picture that the plots draw: a solution with curves ready for the screen, and the comparison of two of them.

use crate::app::controls::sentence;
use crate::app::document::Key;
use crate::app::numbers;
use crate::engine::{Answer, ContactResult, Warning};
use crate::solver::full::point::side_lobe_error;
use crate::solver::full::{Mixed, Problem, Solution, TractionDoubt};
use crate::solver::reduced::ErrorEstimate;
use egui_plot::PlotPoint;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Position of the cuts through a point contact. The profile along X lies at Y = `y`, the profile across at X =
/// `x`.
#[derive(Clone, Copy, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct Cuts {
    /// X of the profile across.
    pub x: f64,
    /// Y of the profile along.
    pub y: f64,
}

/// Pressure and film thickness across, over both halves of a point contact. Empty for a line contact.
#[derive(Clone, Default)]
pub struct Across {
    /// P against Y.
    pub pressure: Vec<PlotPoint>,
    /// H against Y.
    pub film: Vec<PlotPoint>,
    /// P_a against Y; empty for smooth surfaces.
    pub asperities: Vec<PlotPoint>,
}

/// Method that computed a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Origin {
    /// By the reduced model.
    Reduced {
        /// e_f^I, relative residual, (3.15).
        residual_estimate: f64,
        /// Calibrated errors. `None` if the model was not calibrated for the present options.
        error: Option<ErrorEstimate>,
        /// Newton steps.
        iterations: usize,
        /// Index of the local model that computed it.
        window: usize,
        /// True if the contact's own local model found no solution and a neighbouring one computed it.
        by_neighbour: bool,
    },
    /// By the full solver.
    Full,
}

impl From<&ContactResult> for Origin {
    fn from(result: &ContactResult) -> Self {
        let Some(facts) = &result.reduced else { return Self::Full };
        Self::Reduced {
            residual_estimate: facts.residual_estimate.unwrap_or(f64::NAN),
            error: facts.error,
            iterations: result.newton_iterations,
            window: facts.window,
            by_neighbour: result.warnings.contains(&Warning::NeighbouringModel),
        }
    }
}

impl Origin {
    /// Returns a description for the heads of tables.
    pub fn describe(&self) -> String {
        match self {
            Self::Full => "full solution".to_owned(),
            Self::Reduced { residual_estimate, error, iterations, window, by_neighbour } => {
                let bound = match error {
                    Some(e) => format!("error bounds H_c {:e}, H_min {:e}", e.h_c.bound, e.h_min.bound),
                    None if *by_neighbour => "no error bound: computed by a neighbouring local model".to_owned(),
                    None => "no calibrated error bound".to_owned(),
                };
                let window = window + 1;
                format!(
                    "reduced model, local model {window}, {iterations} Newton steps, residual estimate \
                     {residual_estimate:e}, {bound}"
                )
            }
        }
    }
}

/// Solution, its contact, and its curves.
#[derive(Clone)]
pub struct Picture {
    /// Contact.
    pub key: Key,
    /// Method.
    pub origin: Origin,
    pub solution: Arc<Solution>,
    /// Position of the cuts through a point contact.
    cuts: Cuts,
    /// P against X.
    pub pressure: Vec<PlotPoint>,
    /// H against X.
    pub film: Vec<PlotPoint>,
    /// P and H against Y.
    pub across: Across,
    /// Traction coefficient over the whole domain, (3.41).
    pub traction: f64,
    /// Reason why the traction coefficient is not physical, if it is not.
    pub unphysical: Option<TractionDoubt>,
    /// Results of rough surfaces; `None` for smooth ones.
    pub mixed: Option<Mixed>,
    /// Asperity pressure P_a against X; empty for smooth surfaces.
    pub asperities: Vec<PlotPoint>,
    /// X at which cavitation begins. `None` without cavitation.
    pub rupture: Option<f64>,
    /// X of the inlet meniscus of a starved contact.
    pub meniscus: Option<f64>,
    /// Position and height of the pressure spike.
    pub spike: Option<(f64, f64)>,
    /// Warnings that belong to the solution.
    pub warnings: Vec<Warning>,
    /// Warnings about the grid as sentences: domain too short, spacing too wide, side lobes not resolved.
    pub unresolved: Option<String>,
    /// True if the domain or the spacing causes too large an error of the film thickness.
    pub costly_grid: bool,
}

impl Picture {
    /// Prepares an answer for drawing as that of a contact with the same film thickness. `None` without
    /// convergence.
    pub fn of(key: Key, answer: Answer, cuts: Cuts) -> Option<Self> {
        let asked = Key { point: answer.request.point, lubricant: answer.request.lubricant };
        let (origin, traction) = (Origin::from(&answer.result), answer.result.traction?);
        let (warnings, mixed) = (answer.result.warnings.clone(), answer.result.mixed);
        let solution = Arc::new(answer.into_fields()?);
        let of_nodes = |warning: &&Warning| {
            matches!(warning, Warning::DiscretisationError { .. } | Warning::DiscretisationErrorUnknown)
        };
        let of_grid = |warning: &&Warning| of_nodes(warning) || matches!(warning, Warning::SideLobesUnresolved { .. });
        let unresolved: Vec<String> = warnings.iter().filter(of_grid).map(Warning::to_string).collect();
        let mut picture = Self {
            key: asked,
            origin,
            cuts,
            pressure: Vec::new(),
            film: Vec::new(),
            across: Across::default(),
            traction,
            unphysical: solution.problem.doubts_traction(traction, &solution.scalars),
            mixed,
            asperities: Vec::new(),
            rupture: solution.rupture(),
            meniscus: solution.meniscus(),
            spike: solution.spike(),
            costly_grid: warnings.iter().any(|warning| of_nodes(&warning)),
            unresolved: (!unresolved.is_empty()).then(|| unresolved.join(". ")),
            warnings,
            solution,
        };
        if key != asked {
            picture.slide(key);
        }
        picture.draw_curves();
        Some(picture)
    }

    /// Assigns the picture to a contact with the same film thickness ([`Key::has_film_of`]). Only the traction is
    /// recomputed.
    pub fn slide(&mut self, key: Key) {
        self.solution = of_contact(Arc::clone(&self.solution), &key);
        self.key = key;
        self.traction = self.solution.traction_coefficient();
        self.mixed = self.mixed.map(|mixed| self.solution.mixed_at_sliding(mixed));
        let former = self.unphysical.map(Warning::from);
        self.unphysical = self.solution.problem.doubts_traction(self.traction, &self.solution.scalars);
        self.warnings.retain(|warning| Some(warning) != former.as_ref());
        self.warnings.extend(self.unphysical.map(Warning::from));
    }

    /// Returns the relative errors of H_c and H_min due to the grid of a full solution, estimated from this
    /// solution alone. `None` for a reduced solution.
    pub fn grid_errors(&self) -> Option<(f64, f64)> {
        let cost = self.solution.grid_cost.filter(|_| self.origin == Origin::Full)?.total();
        Some((cost, cost + side_lobe_error(&self.solution)))
    }

    /// Returns a description of the method for the heads of tables. For a full solution it includes the grid and
    /// its error.
    pub fn means(&self) -> String {
        let (nx, ny) = (self.solution.x.len(), self.solution.y.len());
        let nodes = if self.has_plane() { format!(" on {nx}×{ny} nodes") } else { String::new() };
        let grid = match self.grid_errors() {
            Some((h_c, h_min)) if h_c.is_finite() => format!("{nodes}; grid error H_c {h_c:.1e}, H_min {h_min:.1e}"),
            Some(_) => format!("{nodes}; the grid error cannot be estimated"),
            None => String::new(),
        };
        self.origin.describe() + &grid
    }

    /// Returns the warnings as sentences that end with a space. Empty without warnings.
    pub fn warned(&self) -> String {
        let by_neighbour = |warning: &&Warning| **warning != Warning::NeighbouringModel;
        let sentences = self.warnings.iter().filter(by_neighbour).map(|warning| sentence(&warning.to_string()) + " ");
        sentences.collect()
    }

    /// Moves the cuts of a point contact.
    pub fn cut(&mut self, cuts: Cuts) {
        if self.cuts != cuts {
            self.cuts = cuts;
            self.draw_curves();
        }
    }

    fn draw_curves(&mut self) {
        let curve = |nodes: &[(f64, f64, f64)], of: fn(&(f64, f64, f64)) -> f64| {
            nodes.iter().map(|node| PlotPoint::new(node.0, of(node))).collect()
        };
        let (along, across) = (self.solution.along(self.cuts.y), self.solution.across(self.cuts.x));
        (self.pressure, self.film) = (curve(&along, |node| node.1), curve(&along, |node| node.2));
        let problem = self.solution.problem;
        let asperities = |nodes: &[(f64, f64, f64)]| match self.mixed {
            Some(_) => nodes.iter().map(|node| PlotPoint::new(node.0, problem.asperity_pressure(node.2))).collect(),
            None => Vec::new(),
        };
        self.asperities = asperities(&along);
        self.across = Across {
            pressure: curve(&across, |node| node.1),
            film: curve(&across, |node| node.2),
            asperities: asperities(&across),
        };
    }

    /// Returns true if a solution of the same contact uses the same grid.
    pub fn shares_grid(&self, other: &Solution) -> bool {
        self.solution.mesh.spec == other.mesh.spec
    }

    /// Returns true for a point contact.
    pub fn has_plane(&self) -> bool {
        self.solution.mesh.plane().is_some()
    }

    /// Returns κ = b/a, the ellipticity. X is scaled with a, Y with b.
    pub fn kappa(&self) -> f64 {
        self.key.point.ellipse().kappa
    }

    /// Returns the central film thickness in m.
    pub fn central_film_m(&self) -> f64 {
        self.solution.scalars.h_c * self.key.point.film_scale_m()
    }

    /// Returns the minimum film thickness in m.
    pub fn minimum_film_m(&self) -> f64 {
        self.solution.scalars.h_min * self.key.point.film_scale_m()
    }

    /// Returns the maximum pressure in Pa.
    pub fn largest_pressure_pa(&self) -> f64 {
        self.solution.scalars.p_max * self.key.point.hertz().pressure_pa
    }
}

/// Returns a solution as one of the contact that it is shown for. The film thickness may have been solved at
/// another sliding.
fn of_contact(solution: Arc<Solution>, key: &Key) -> Arc<Solution> {
    match Problem::new(&key.point, key.lubricant) {
        Ok(problem) if problem != solution.problem => Arc::new(Arc::unwrap_or_clone(solution).of_problem(problem)),
        _ => solution,
    }
}

/// Returns the value of a curve at x, linearly interpolated between its points. `None` outside the curve.
pub fn value_at(curve: &[PlotPoint], x: f64) -> Option<f64> {
    let at = curve.partition_point(|p| p.x < x);
    let (left, right) = (curve.get(at.checked_sub(1)?)?, curve.get(at)?);
    let t = if right.x > left.x { (x - left.x) / (right.x - left.x) } else { 0.0 };
    Some((1.0 - t) * left.y + t * right.y)
}

/// Difference between a picture and the full solution of the same contact.
#[derive(Clone)]
pub struct Comparison {
    /// Relative error of H_c, [`Problem::film_difference`].
    pub h_c: f64,
    /// Relative error of H_min.
    pub h_min: f64,
    /// Difference of the traction coefficients. `None` in pure rolling.
    pub traction: Option<f64>,
    /// Maximum of |ΔP|, for a point contact over the whole plane.
    pub max_dp: f64,
    /// Position of the cuts through a point contact.
    pub cuts: Cuts,
    /// ΔP against X.
    pub pressure: Vec<PlotPoint>,
    /// ΔH/H_c against X; for rough surfaces ΔH/(σ/2) if H_c is smaller.
    pub film: Vec<PlotPoint>,
}

impl Comparison {
    /// Returns the errors as one line, with symbols in braces.
    pub fn describe(&self) -> String {
        let traction =
            self.traction.map_or_else(String::new, |traction| format!(", Δ{{µ}} {}", numbers::small(traction)));
        format!(
            "Δ{{H_c}} {}, Δ{{H_min}} {}, max |Δ{{P}}| {}{traction}",
            numbers::error_percent(self.h_c),
            numbers::error_percent(self.h_min),
            numbers::small(self.max_dp)
        )
    }

    /// Compares a picture with the full solution of its contact.
    pub fn new(picture: &Picture, full: &Picture) -> Self {
        let (a, b) = (&picture.solution.scalars, &full.solution.scalars);
        let slides =
            picture.key.point.sliding.slide_to_roll_ratio != 0.0 && picture.solution.traction_warning().is_none();
        let difference = |mine: &[PlotPoint], theirs: &[PlotPoint], scale: f64| -> Vec<PlotPoint> {
            mine.iter().filter_map(|p| value_at(theirs, p.x).map(|v| PlotPoint::new(p.x, (p.y - v) / scale))).collect()
        };
        let pressure = difference(&picture.pressure, &full.pressure, 1.0);
        let largest = |differences: &mut dyn Iterator<Item = f64>| differences.map(f64::abs).fold(0.0, f64::max);
        let (mine, theirs) = (&picture.solution, &full.solution);
        let max_dp = if picture.has_plane() && mine.mesh == theirs.mesh {
            largest(&mut mine.pressure.iter().zip(&theirs.pressure).map(|(p, q)| p - q))
        } else {
            largest(&mut pressure.iter().map(|p| p.y))
        };
        Self {
            h_c: full.solution.problem.film_difference(a.h_c, b.h_c),
            h_min: full.solution.problem.film_difference(a.h_min, b.h_min),
            traction: slides.then_some(picture.traction - full.traction),
            max_dp,
            cuts: picture.cuts,
            film: difference(&picture.film, &full.film, b.h_c.abs().max(full.solution.problem.least_film())),
            pressure,
        }
    }
}
