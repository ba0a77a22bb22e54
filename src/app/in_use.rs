//! The reduced model as it is used: with the truncation that the document asks for.

use crate::scene::View;
use crate::solver::full::{ContactSolver, Scalars, Solution, SolveError, Start};
use crate::solver::observer::Observer;
use crate::solver::physics::contact::{Moes, OperatingPoint};
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::reduced::{Online, ReducedError, ReducedModel, ReducedOptions, ReducedSolution, Window};
use std::sync::Arc;

/// A model and its truncation: what a study judges, and by which it knows later whether it is out of date.
#[derive(Clone, Debug)]
pub struct InUse {
    /// The model.
    pub model: Arc<ReducedModel>,
    pressure_loss: Option<f64>,
    /// Set where the deformation goes through its basis.
    deformation_loss: Option<f64>,
}

impl PartialEq for InUse {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.model, &other.model)
            && self.pressure_loss == other.pressure_loss
            && self.deformation_loss == other.deformation_loss
    }
}

impl InUse {
    /// The model under a document's view.
    pub fn new(model: &Arc<ReducedModel>, view: &View) -> Self {
        let deformation_loss = view.projected_deformation.then(|| view.deformation_loss.unwrap_or(0.0));
        Self { model: Arc::clone(model), pressure_loss: view.pressure_loss, deformation_loss }
    }

    /// The online settings in one of its windows.
    pub fn options(&self, window: &Window) -> ReducedOptions {
        ReducedOptions {
            pressure_modes: self.pressure_loss.map(|loss| window.pressure.modes_for(loss)),
            deformation_modes: self.deformation_loss.map(|loss| window.deformation.modes_for(loss)),
            ..ReducedOptions::default()
        }
    }

    /// The online settings where a contact is solved.
    pub fn options_at(&self, moes: Moes) -> ReducedOptions {
        let window = self.model.windows.get(self.model.window_for(moes));
        window.map_or_else(ReducedOptions::default, |window| self.options(window))
    }

    /// For people and the heads of tables.
    pub fn describe(&self) -> String {
        let pressure =
            self.pressure_loss.map_or_else(|| "all modes".to_owned(), |loss| format!("pressure loss {loss:.1e}"));
        let deformation = match self.deformation_loss {
            None => String::new(),
            Some(0.0) => ", deformation through its basis".to_owned(),
            Some(loss) => format!(", deformation loss {loss:.1e}"),
        };
        format!("{}, {pressure}{deformation}", self.model.title)
    }
}

/// Reduced solves along a path, each from its neighbour; operators are made when first needed.
pub struct Chain {
    /// The model and its truncation.
    pub in_use: InUse,
    windows: Vec<Option<Online>>,
}

impl Chain {
    /// A chain that nothing has been solved with.
    pub fn new(in_use: &InUse) -> Self {
        Self { in_use: in_use.clone(), windows: in_use.model.windows.iter().map(|_| None).collect() }
    }

    /// The reduced solution, and its fields.
    ///
    /// # Errors
    /// When the point is refused or Newton does not converge.
    pub fn solve(
        &mut self,
        point: &OperatingPoint,
        lubricant: Lubricant,
    ) -> Result<(ReducedSolution, Solution), ReducedError> {
        let (model, moes) = (&self.in_use.model, point.moes());
        let place = self.windows.get_mut(model.window_for(moes)).ok_or(ReducedError::Empty)?;
        let online = place.get_or_insert_with(|| Online::new(Arc::clone(model), self.in_use.options_at(moes)));
        let solved = online.solve(point, lubricant)?;
        let fields = online.reconstruct(&solved)?;
        Ok((solved, fields))
    }
}

/// Reduced and full solvers of a model as it is used, for a study's own thread.
pub struct Solvers {
    in_use: InUse,
    reduced: Vec<Online>,
    full: Vec<ContactSolver>,
}

impl Solvers {
    /// Solvers of every window; operators are made when first needed.
    pub fn new(in_use: &InUse) -> Self {
        let windows = &in_use.model.windows;
        Self {
            reduced: windows.iter().map(|w| Online::new(Arc::clone(&in_use.model), in_use.options(w))).collect(),
            full: windows.iter().map(|w| ContactSolver::on(&w.grid)).collect(),
            in_use: in_use.clone(),
        }
    }

    /// The reduced solution, independent of what was solved before.
    ///
    /// # Errors
    /// When the point is refused or Newton does not converge.
    pub fn reduced(
        &mut self,
        point: &OperatingPoint,
        lubricant: Lubricant,
    ) -> Result<(ReducedSolution, Scalars), ReducedError> {
        let window = self.in_use.model.window_for(point.moes());
        let online = self.reduced.get_mut(window).ok_or(ReducedError::Empty)?;
        online.forget();
        let solved = online.solve(point, lubricant)?;
        let scalars = online.scalars(&solved)?;
        Ok((solved, scalars))
    }

    /// The full solution on the model's own grid; `None` when it does not converge.
    ///
    /// # Errors
    /// When the point is refused.
    pub fn full(
        &mut self,
        point: &OperatingPoint,
        lubricant: Lubricant,
        start: Start<'_>,
        observer: &dyn Observer,
    ) -> Result<Option<Solution>, SolveError> {
        let window = self.in_use.model.window_for(point.moes());
        let Some(solver) = self.full.get_mut(window) else { return Ok(None) };
        let solution = solver.solve(point, lubricant, start, observer)?;
        Ok(solution.converged().then_some(solution))
    }
}
