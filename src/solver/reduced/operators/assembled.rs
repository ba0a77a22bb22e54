//! The reduced operators of one window for a chosen truncation. Nothing in them is of large scale.

use super::front::{Front, support as front_support};
use super::heat::{Heated, further_nodes};
use super::least_squares::LeastSquares;
use super::newton::Case;
use super::shaped::Shaped;
use super::support::{StateRows, Support, deformed_at};
use super::traction::{Rule, RuleTraction};
use crate::solver::discrete::grid::dot;
use crate::solver::discrete::nodes::Nodes;
use crate::solver::discrete::reynolds::film_integrals::LAST_STEP;
use crate::solver::discrete::reynolds::{CENTER, RowGeometry, STENCIL};
use crate::solver::full::Problem;
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::lubricant::Cavitation;
use crate::solver::reduced::dense::{self, SmallSystem};
use crate::solver::reduced::minimisation::Scheme;
use crate::solver::reduced::model::{Window, deformation_weights};
use faer::{Mat, MatRef};

/// What Newton's iteration needs of a window, and its work space.
pub(crate) struct Operators {
    pub modes: usize,
    /// How many of them Newton's steps change; Galerkin's equations of the others are left out.
    pub(super) active: usize,
    /// The nodes that the rows depend on.
    pub(super) support: Support,
    /// Six of them per sampled row; those that a row lacks have weight zero.
    pub(super) stencil: Vec<[usize; STENCIL]>,
    pub(super) geometry: Vec<RowGeometry>,
    pub(super) row_weights: Vec<f64>,
    /// The modes on the support.
    pub(super) state: StateRows,
    /// Axes along which the rows need gradients: none of a Newtonian model.
    pub(super) axes: usize,
    /// What is made of the rows' values, see the window's.
    pub(super) reconstruction: Mat<f64>,
    pub(super) residual_reconstruction: Option<Mat<f64>>,
    /// wᵀ V_p.
    pub(super) load_row: Vec<f64>,
    /// The rule for the traction; none of a model that knows no sliding.
    pub(super) rule: Option<Rule>,
    /// V_δ V_δᵀ W K V_p over the whole node array, for reconstruction; none where the exact K V_p is used, which the
    /// window has.
    pub(super) projected: Option<Mat<f64>>,
    /// E_δ of (3.13) with δ̃ condensed: what V_δ cannot represent of K V_p, as a quadratic form; empty for the exact
    /// operator.
    pub(super) deformation_error: Option<Mat<f64>>,
    /// The film at X = 0 (and Y = 0) per unit of each coefficient without a boundary, and the scale it was found for; not
    /// of ellipses.
    pub(super) at_zero: Option<(f64, Vec<f64>)>,
    /// Where the film ruptures; none where a penalty holds the pressures.
    pub(super) front: Option<Front>,
    /// What follows the shape of an ellipse; none of a window that knows circles or lines.
    pub(super) shaped: Option<Shaped>,
    /// Temperatures; none of a model that knows no heat.
    pub(super) heated: Option<Box<Heated>>,
    pub(super) scratch: Scratch,
}

pub(super) struct Scratch {
    /// P and K P on the support, and the gradients where there are any. They follow the steps, so that each iteration
    /// multiplies once by the large `state`.
    pub(super) fields: Vec<f64>,
    pub(super) step_fields: Vec<f64>,
    pub(super) films: Vec<f64>,
    pub(super) nodes: Nodes,
    /// The step that ends the iteration of a film of a node that thins.
    pub(super) film_step: f64,
    pub(super) values: Vec<f64>,
    pub(super) jacobian_rows: Vec<f64>,
    /// By the films of each row's nodes, and by all of them at once.
    pub(super) film_slopes: Vec<[f64; STENCIL]>,
    pub(super) film_column: Vec<f64>,
    /// The reduced Jacobian, load row included, and the step.
    pub(super) system: SmallSystem,
    /// By how much modes are held at zero behind the rupture boundary in it.
    pub(super) restraint: f64,
    /// The equations whose squares are least, of a scheme of residual minimisation.
    pub(super) minimised: Option<LeastSquares>,
    /// What observers see of the former before it is factorised.
    pub(super) jacobian: Mat<f64>,
    pub(super) product: Vec<f64>,
}

impl Operators {
    /// Operators with the first `modes` pressure modes and, if given, the first `deformation_modes` deformation modes;
    /// `thinning` for lubricants that thin under shear.
    pub fn new(window: &Window, modes: usize, deformation_modes: Option<usize>, thinning: bool) -> Self {
        let mut out = Self::with_support(window, modes, deformation_modes, thinning, &[]);
        out.rule = Rule::of(window, (out.modes, out.axes), out.projected.as_ref());
        out
    }

    /// Operators of contacts with heat.
    pub fn with_heat(window: &Window, modes: usize, deformation_modes: Option<usize>) -> Self {
        let further = further_nodes(&window.grid);
        let mut out = Self::with_support(window, modes, deformation_modes, true, &further);
        let mut films: Vec<usize> = out.stencil.iter().flatten().copied().collect();
        films.sort_unstable();
        films.dedup();
        out.heated = Some(Box::new(Heated::new(&window.grid, &out.support.places, films)));
        out.rule = Rule::of(window, (out.modes, out.axes), out.projected.as_ref());
        out
    }

    /// The same with further nodes that its rows may come to depend on.
    pub fn with_support(
        window: &Window,
        modes: usize,
        deformation_modes: Option<usize>,
        thinning: bool,
        further: &[usize],
    ) -> Self {
        let modes = modes.clamp(1, window.pressure.count());
        let reference = &window.grid;
        let (projected, deformation_error) = match deformation_modes {
            None => (None, None),
            Some(k) => {
                let exact = window.pressure.flexed().get(.., ..modes);
                let k = k.clamp(1, window.deformation.modes.ncols());
                let weights = deformation_weights(reference);
                let v = window.deformation.modes.get(.., ..k);
                let weighted = Mat::from_fn(v.nrows(), k, |i, j| weights[i] * v[(i, j)]);
                let projected = dense::product(v, dense::product(weighted.transpose(), exact).as_ref());
                let missing =
                    Mat::from_fn(v.nrows(), modes, |i, j| weights[i].sqrt() * (exact[(i, j)] - projected[(i, j)]));
                let error = dense::product(missing.transpose(), missing.as_ref());
                (Some(projected), Some(error))
            }
        };
        let rows = &window.sampled_rows;
        let (stencils, geometry): (Vec<_>, Vec<_>) = rows.iter().map(|&row| reference.row(row)).unzip();
        let ruptures = window.cavitation == Cavitation::Complementarity;
        let passed = if ruptures { front_support(window) } else { Vec::new() };
        let own: Vec<usize> = stencils.iter().flatten().chain(further).copied().collect();
        let support = Support::new(reference, own, passed);
        let nodes = support.nodes();
        let stencil = stencils.iter().map(|stencil| stencil.map(|node| support.place(node))).collect();
        let deformation = deformed_at(window, projected.as_ref(), &nodes, modes);
        let axes = match reference.kind() {
            _ if !thinning => 0,
            ContactKind::Line => 1,
            ContactKind::Point => 2,
        };
        let mut state = StateRows::of(window, &nodes, (modes, axes), &deformation);
        let weights = reference.weights();
        let load_row = window.pressure.carried(weights, modes);
        let front = ruptures.then(|| {
            let whole = std::mem::take(&mut state.deformations);
            Front::new(window, &support, (&state, whole), &load_row)
        });
        let shaped = Shaped::of(window, (&nodes, modes), (&geometry, &support.places, &state));
        let (n, s) = (rows.len(), support.len());
        let size = modes + 1;
        Self {
            modes,
            active: modes,
            stencil,
            geometry,
            row_weights: rows.iter().map(|&row| weights[reference.node(row)]).collect(),
            state,
            axes,
            reconstruction: match window.scheme {
                Scheme::Galerkin => window.reconstruction.get(..modes, ..).to_owned(),
                Scheme::LeastSquares { .. } | Scheme::Gnat { .. } => window.reconstruction.clone(),
            },
            residual_reconstruction: window.residual_reconstruction.clone(),
            load_row,
            rule: None,
            projected,
            deformation_error,
            at_zero: None,
            front,
            shaped,
            heated: None,
            scratch: Scratch {
                fields: vec![0.0; (2 + axes) * s],
                step_fields: vec![0.0; (2 + axes) * s],
                films: vec![0.0; s],
                nodes: Nodes::new(s, axes > 0),
                film_step: LAST_STEP,
                values: vec![0.0; n],
                jacobian_rows: vec![0.0; n * modes],
                film_slopes: vec![[0.0; STENCIL]; n],
                film_column: vec![0.0; n],
                system: SmallSystem::new(size),
                restraint: 0.0,
                minimised: match window.scheme {
                    Scheme::Galerkin => None,
                    Scheme::LeastSquares { .. } => Some(LeastSquares::new(n + 1, size)),
                    Scheme::Gnat { .. } => Some(LeastSquares::new(window.reconstruction.nrows() + 1, size)),
                },
                jacobian: Mat::zeros(size, size),
                product: vec![0.0; n],
            },
            support,
        }
    }

    /// Lets the rupture boundary pass several nodes at once: in time it travels far in one step.
    pub fn stride(&mut self) {
        self.front.iter_mut().for_each(|front| front.strides = true);
    }

    /// The place of a node in the support.
    pub fn place(&self, node: usize) -> usize {
        self.support.place(node)
    }

    /// Gives row `r` of the sampled ones, and behind them of those that the rupture boundary may pass, other
    /// coefficients and other nodes: places in the support.
    pub fn set_row(&mut self, r: usize, stencil: [usize; STENCIL], geometry: RowGeometry) {
        match (r.checked_sub(self.stencil.len()), &mut self.front) {
            (Some(passed), Some(front)) => front.set_row(passed, stencil, geometry),
            _ => (self.stencil[r], self.geometry[r]) = (stencil, geometry),
        }
    }

    /// ρ̄H at the own nodes of the rows of [`Self::set_row`], of the state evaluated last.
    pub fn flow(&self) -> impl Iterator<Item = f64> + '_ {
        let sampled = self.stencil.iter().map(|stencil| stencil[CENTER]);
        let passed = self.front.iter().flat_map(Front::places);
        sampled.chain(passed).map(|place| self.scratch.nodes[place].flow)
    }

    /// Traction (3.41) of a state by the window's rule, with heat by the temperatures of the last turns; `None` where it has
    /// none.
    pub fn traction(&mut self, case: &Case<'_>, coefficients: &[f64], h_0: f64) -> Option<RuleTraction> {
        let Case { problem, scale, curvature, .. } = *case;
        let rule = self.rule.as_mut()?;
        Some(rule.traction(problem, (scale, curvature), (coefficients, h_0), self.heated.as_deref()))
    }

    /// K V_p or V_δ V_δᵀ W K V_p over the whole node array of the window these operators are of.
    pub fn deformation<'a>(&'a self, window: &'a Window) -> MatRef<'a, f64> {
        match &self.projected {
            Some(projected) => projected.as_ref(),
            None => window.pressure.flexed().get(.., ..self.modes),
        }
    }

    /// Turns to the shape of a contact; nothing where the window knows one only.
    pub fn take_shape(&mut self, window: &Window, problem: &Problem) {
        let Self { shaped, state, geometry, support, heated, rule, .. } = self;
        let (Some(shaped), Some(shapes)) = (shaped, &window.shapes) else { return };
        let ellipse = problem.point.ellipse();
        shaped.turn_to(shapes, &ellipse, state, geometry, &mut support.places);
        heated.iter_mut().for_each(|heated| heated.across_by(ellipse.kappa));
        rule.iter_mut().for_each(|rule| rule.take_shape(shapes, &ellipse));
    }

    /// Lets Newton's steps change the coefficients of so many modes only; those of the others must be zero.
    pub fn use_modes(&mut self, active: usize) {
        self.active = active.clamp(1, self.modes);
    }

    /// Puts the rupture boundary at these columns, one per line along X, before an iteration begins, or out of force, so
    /// that the penalty holds all pressures; nothing where there is no boundary.
    pub fn rupture_at(&mut self, fronts: Option<&[usize]>) {
        let Self { front, load_row, .. } = self;
        if let Some(front) = front {
            front.begin(fronts, load_row);
        }
    }

    /// The first ruptured column of each line along X; none where a penalty holds the pressures.
    pub fn fronts(&self) -> impl Iterator<Item = usize> + '_ {
        self.front.iter().flat_map(|front| front.fronts(&self.scratch.fields))
    }

    /// Nodes behind the rupture boundary, and the pressures of the modes there that it takes away.
    pub fn cut<'a>(&'a self, coefficients: &'a [f64]) -> impl Iterator<Item = (usize, f64)> + 'a {
        self.front.iter().flat_map(|front| front.cut(coefficients))
    }

    /// The film at X = 0 (and Y = 0) over what H₀ gives it, by these nodes and weights of an interpolation there:
    /// per unit of each coefficient, with the rupture boundary where it is.
    pub fn lift(&mut self, window: &Window, zero: &[(usize, f64)], scale: f64) -> Vec<f64> {
        let whole: Vec<f64> = match (&self.shaped, &window.shapes) {
            (Some(shaped), Some(shapes)) => (0..self.modes).map(|k| shaped.at(shapes, zero, k)).collect(),
            _ => {
                if self.at_zero.as_ref().is_none_or(|(of, _)| *of != scale) {
                    let nodes: Vec<usize> = zero.iter().map(|(node, _)| *node).collect();
                    let deformation = deformed_at(window, self.projected.as_ref(), &nodes, self.modes);
                    let sum =
                        |k: usize| zero.iter().enumerate().map(|(i, (_, w))| w * deformation[(i, k)]).sum::<f64>();
                    self.at_zero = Some((scale, (0..self.modes).map(|k| scale * sum(k)).collect()));
                }
                self.at_zero.as_ref().map(|(_, whole)| whole.clone()).unwrap_or_default()
            }
        };
        match &mut self.front {
            Some(front) => {
                front.aim(&window.grid, zero, scale, &whole);
                front.lift.clone()
            }
            None => whole,
        }
    }

    /// What the last iteration made of it: the boundary may have moved.
    pub fn lifted(&self, whole: &[f64], coefficients: &[f64]) -> f64 {
        dot(self.front.as_ref().map_or(whole, |front| &front.lift), coefficients)
    }

    /// Scales coefficients so that they carry the load on a grid of scale s.
    pub fn carry_load(&self, problem: &Problem, scale: f64, coefficients: &mut [f64]) {
        let carried: f64 = self.load_row.iter().zip(coefficients.iter()).map(|(l, c)| l * c).sum();
        let factor = problem.load / (scale * carried);
        if factor.is_finite() && factor > 0.0 {
            coefficients.iter_mut().for_each(|c| *c *= factor);
        }
    }
}
