//! Contact stated by a machine: a bearing, a gear pair or a cam.

use super::fields::{ContactSpec, Field};
use super::given::{Given, ValueError};
use super::refusal::{Refusal, refuse};
use crate::scene::document::options;
use crate::solver::physics::bodies::Bodies;
use crate::solver::physics::machines::Machine;

/// Fields that a machine determines.
pub(super) const DETERMINED: [Field; 9] = [
    Field::Radius,
    Field::RadiusY,
    Field::Speed,
    Field::U1,
    Field::U2,
    Field::Load,
    Field::Srr,
    Field::MoesM,
    Field::MoesL,
];

impl Given for Machine {
    fn read(text: &str) -> Result<Self, ValueError> {
        options().from_str(text).map_err(|error| ValueError::Machine(error.to_string()))
    }
}

impl ContactSpec {
    /// Returns the contact with radii, speeds and load of its machine instead of the machine. `None` without a machine.
    ///
    /// # Errors
    /// If a field is stated that the machine determines, if E′ is missing, or if the machine does not exist.
    pub(super) fn of_machine(&self) -> Result<Option<Self>, Refusal> {
        let Some(machine) = &self.machine else { return Ok(None) };
        if let Some(field) = DETERMINED.into_iter().find(|field| self.states(*field)) {
            let name = field.facts().name;
            return refuse(field, format!("<machine> determines <{name}>; leave one of them out"));
        }
        let Some(modulus_pa) = self.reduced_modulus()? else {
            return refuse(Field::Modulus, "<machine> needs <modulus>, or <e1> <nu1> <e2> <nu2>; give them too");
        };
        let of = |error: &dyn std::error::Error| Refusal::new(Field::Machine, format!("<machine>: {error}"));
        let contact = machine.contact(modulus_pa).map_err(|error| of(&error))?;
        let bodies = contact.bodies(Bodies::on_plane(1.0, 1.0, 0.0));
        let (speed, srr) = bodies.entrainment().map_err(|error| of(&error))?;
        let radius = bodies.reduced_radius_m().map_err(|error| of(&error))?;
        let radius_y = if contact.kind.is_line() {
            None
        } else {
            Some(bodies.reduced_transverse_radius_m().map_err(|error| of(&error))?)
        };
        Ok(Some(Self {
            contact: Some(contact.kind),
            machine: None,
            radius: Some(radius),
            radius_y: radius_y.filter(|radius_y| *radius_y != radius),
            speed: Some(speed),
            srr: Some(srr),
            load: Some(contact.load),
            ..self.clone()
        }))
    }
}
