//! Stiffness and damping of a contact, for users and other programs.

use crate::solver::full::Solution;
use crate::solver::full::response::{ContactResponse, Dynamics, Maxwell, ResponseError};
use crate::solver::observer::Observer;
use crate::solver::physics::contact::ContactKind;
use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};

/// Stiffness and damping of a steady contact at some frequencies, and the element fitted to them.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactDynamics {
    /// Kind of contact. Values of a line contact are per metre of its length.
    pub kind: ContactKind,
    /// Values at each frequency, in the given order.
    pub values: Vec<Dynamics>,
    /// Fitted element; `None` for fewer than three different frequencies above zero.
    pub maxwell: Option<Maxwell>,
}

impl ContactDynamics {
    /// Computes stiffness and damping of a steady solution at frequencies in Hz. Ends early if the observer cancels.
    ///
    /// # Errors
    /// If the contact is not supported, or if a linear solve stalls.
    pub fn of(solution: &Solution, frequencies_hz: &[f64], observer: &dyn Observer) -> Result<Self, ResponseError> {
        let mut response = ContactResponse::of(solution)?;
        let going_on = frequencies_hz.iter().take_while(|_| !observer.cancelled());
        let values = going_on.map(|&frequency| response.dynamics(frequency)).collect::<Result<Vec<_>, _>>()?;
        Ok(Self { kind: solution.problem.point.kind, maxwell: Maxwell::fit(&values), values })
    }

    /// Returns the units of stiffness and damping.
    pub fn units(&self) -> [&'static str; 2] {
        if self.kind.is_line() { ["N/m²", "N s/m²"] } else { ["N/m", "N s/m"] }
    }

    /// Returns the names of stiffness and damping in JSON.
    fn names(&self) -> [&'static str; 2] {
        if self.kind.is_line() {
            ["stiffness_n_per_m2", "damping_ns_per_m2"]
        } else {
            ["stiffness_n_per_m", "damping_ns_per_m"]
        }
    }
}

/// Object with the given names and numbers.
struct Named<'a>(&'a [(String, f64)]);

impl Serialize for Named<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

/// Serialises the entries `dynamics` and `maxwell`.
impl Serialize for ContactDynamics {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let [stiffness, damping] = self.names();
        let mut map = serializer.serialize_map(None)?;
        let values: Vec<_> = self
            .values
            .iter()
            .map(|value| {
                [
                    ("frequency_hz".to_owned(), value.frequency_hz),
                    (stiffness.to_owned(), value.stiffness),
                    (damping.to_owned(), value.damping),
                ]
            })
            .collect();
        map.serialize_entry("dynamics", &values.iter().map(|value| Named(value)).collect::<Vec<_>>())?;
        if let Some(maxwell) = &self.maxwell {
            let entries = [
                (format!("static_{stiffness}"), maxwell.static_stiffness),
                (format!("series_{stiffness}"), maxwell.series_stiffness),
                ("relaxation_s".to_owned(), maxwell.relaxation_s),
                (format!("parallel_{damping}"), maxwell.parallel_damping),
                ("deviation".to_owned(), maxwell.deviation),
            ];
            map.serialize_entry("maxwell", &Named(&entries))?;
        }
        map.end()
    }
}
