//! The reduced model as it is used: with the truncation that the document asks for.

use crate::engine::Store;
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

/// Solves by a model as it is used, with what is in a store; operators are made when first needed.
pub struct Solvers {
    in_use: InUse,
    store: Store,
    windows: Vec<Option<Online>>,
}

impl Solvers {
    /// Solvers that nothing has been solved with.
    pub fn new(store: &Store, in_use: &InUse) -> Self {
        let windows = in_use.model.windows.iter().map(|_| None).collect();
        Self { in_use: in_use.clone(), store: store.clone(), windows }
    }

    fn online(&mut self, moes: Moes) -> Result<&mut Online, ReducedError> {
        let Self { in_use, store, windows } = self;
        let place = windows.get_mut(in_use.model.window_for(moes)).ok_or(ReducedError::Empty)?;
        Ok(place.get_or_insert_with(|| store.online(&in_use.model, in_use.options_at(moes))))
    }

    /// The reduced solution and its fields, from its neighbours along a path.
    ///
    /// # Errors
    /// When the point is refused or Newton does not converge.
    pub fn along(
        &mut self,
        point: &OperatingPoint,
        lubricant: Lubricant,
    ) -> Result<(ReducedSolution, Solution), ReducedError> {
        let online = self.online(point.moes())?;
        let solved = online.solve(point, lubricant)?;
        let fields = online.reconstruct(&solved)?;
        Ok((solved, fields))
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
        let online = self.online(point.moes())?;
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
        &self,
        point: &OperatingPoint,
        lubricant: Lubricant,
        start: Start<'_>,
        observer: &dyn Observer,
    ) -> Result<Option<Solution>, SolveError> {
        let model = &self.in_use.model;
        let Some(window) = model.windows.get(model.window_for(point.moes())) else { return Ok(None) };
        let solve = |solver: &mut ContactSolver| solver.solve(point, lubricant, start, observer);
        Ok(Some(self.store.with_full_solver(&window.grid, solve)?).filter(Solution::converged))
    }
}

impl Drop for Solvers {
    fn drop(&mut self) {
        for online in self.windows.drain(..).flatten() {
            self.store.give_back(online);
        }
    }
}
