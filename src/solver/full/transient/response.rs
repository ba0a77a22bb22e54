//! Linear response of a march at a steady contact, in the scales of its reference contact.

use super::frame::Conditions;
use super::space::MarchSpace;
use super::system::FullMarch;
use crate::solver::discrete::space::PlaneSpace;
use crate::solver::full::System;
use crate::solver::full::response::{Adjoint, LinearResponse, ResponseSpace};

impl<S: MarchSpace + Clone> FullMarch<S> {
    /// Returns a system with the current state and the steady rows of the given conditions.
    fn steady_system(&self, at: &Conditions) -> System<S> {
        let mut space = self.system.space.clone();
        space.set_steady_rows(at);
        let mut system = System::new(space);
        system.set_pressure(&at.problem, &self.system.pressure);
        system.set_h_0(self.system.h_0);
        system
    }

    /// Returns the linear response at the steady contact under the given conditions, to which the march was set by
    /// [`super::Marching::rest`].
    pub fn response(&self, at: &Conditions) -> LinearResponse<S>
    where
        S: ResponseSpace,
    {
        LinearResponse::around(self.steady_system(at), at.problem)
    }
}

impl FullMarch<PlaneSpace> {
    /// Returns the adjoint at the same contact, see [`Adjoint`]. `None` if its matrix cannot be factorised.
    pub fn adjoint(&self, at: &Conditions, penalty: f64) -> Option<Adjoint> {
        Adjoint::around(self.steady_system(at), &at.problem, penalty)
    }

    /// Returns the pressure P and the rigid-body separation H₀ of the current state.
    pub fn pressure(&self) -> (&[f64], f64) {
        (&self.system.pressure, self.system.h_0)
    }
}
