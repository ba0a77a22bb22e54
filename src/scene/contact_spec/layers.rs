//! Combines two contact specifications: fields that a table line leaves out are those of the scene.

use super::fields::{ContactSpec, Field};
use super::machines::DETERMINED;
use crate::scene::at::At;
use crate::scene::experiment::Experiment;
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::lubricant::Cavitation;
use crate::solver::physics::machines::Machine;

/// Fields of [`At`].
const NUMBERS: [Field; 9] = [
    Field::Radius,
    Field::RadiusY,
    Field::Speed,
    Field::Load,
    Field::Modulus,
    Field::Viscosity,
    Field::Alpha,
    Field::MoesM,
    Field::MoesL,
];

impl ContactSpec {
    /// Returns the contact kind: line or point. A machine determines it.
    pub fn kind(&self) -> ContactKind {
        self.machine.as_ref().map_or(self.contact.unwrap_or_default(), Machine::kind)
    }

    /// Fills the fields that this contact leaves out from `base`. Fields of `base` are dropped if this contact states
    /// the same quantity by other fields.
    pub(super) fn over(self, mut base: Self) -> Self {
        let states = |fields: &[Field]| fields.iter().any(|field| self.states(*field));
        if states(&[Field::MoesM, Field::MoesL]) || base.moes_m.is_some() {
            NUMBERS.into_iter().for_each(|field| base.forget(field));
        }
        if self.machine.is_some() {
            DETERMINED.into_iter().for_each(|field| base.forget(field));
        } else if states(&DETERMINED) {
            base.forget(Field::Machine);
        }
        let oil = states(&[Field::Oil, Field::Temperature]);
        let named = self.lubricant.is_some_and(|named| named.viscosity_pa_s.is_some());
        let named_alpha = self.lubricant.is_some_and(|named| named.alpha_per_pa.is_some());
        for (replaced, field) in [
            (self.kind() != base.kind(), Field::Load),
            (self.kind() != base.kind(), Field::Length),
            (self.kind() != base.kind(), Field::TotalLoad),
            (states(&[Field::Load, Field::MoesM]), Field::TotalLoad),
            (states(&[Field::TotalLoad]), Field::Load),
            (states(&[Field::Radius]), Field::Radius1),
            (states(&[Field::Radius]), Field::Radius2),
            (states(&[Field::Radius1, Field::Radius2]), Field::Radius),
            (self.kind().is_line(), Field::RadiusY),
            (states(&[Field::E1, Field::Nu1, Field::E2, Field::Nu2]), Field::Modulus),
            (oil || named, Field::Viscosity),
            (oil || named_alpha, Field::Alpha),
            (states(&[Field::U1, Field::U2]), Field::Speed),
            (states(&[Field::U1, Field::U2]), Field::Srr),
            (states(&[Field::Speed, Field::Srr]), Field::U1),
            (states(&[Field::Speed, Field::Srr]), Field::U2),
            (states(&[Field::Grid, Field::Dx, Field::Dy, Field::Domain]), Field::Grid),
        ] {
            if replaced {
                base.forget(field);
            }
        }
        let own_alpha = self.alpha.is_some();
        let mut all = self.filled_from(base);
        if !own_alpha && all.named_laws().own_coefficient().is_some() {
            all.alpha = None;
        }
        all
    }
}

impl From<At> for ContactSpec {
    fn from(at: At) -> Self {
        match at {
            At::Si { radius, radius_y, speed, load, modulus, viscosity, alpha } => Self {
                radius: Some(radius),
                radius_y,
                speed: Some(speed),
                load: Some(load),
                modulus: Some(modulus),
                viscosity: Some(viscosity),
                alpha: Some(alpha),
                ..Self::default()
            },
            At::Moes { m, l, radius, radius_y, speed, load, modulus, viscosity, alpha } => Self {
                moes_m: Some(m),
                moes_l: Some(l),
                radius,
                radius_y,
                speed,
                load,
                modulus,
                viscosity,
                alpha,
                ..Self::default()
            },
        }
    }
}

impl From<&Experiment> for ContactSpec {
    fn from(experiment: &Experiment) -> Self {
        let Experiment { contact, lubricant, at, sliding, grid, length_m, .. } = *experiment;
        let rough = lubricant.roughness;
        Self {
            contact: Some(contact),
            length: length_m,
            laws: Some(lubricant),
            // Stated only if it is not the default, which a roughness changes.
            cavitation: Some(lubricant.cavitation).filter(|cavitation| *cavitation != Cavitation::default()),
            heat: Some(lubricant.heat.is_some()),
            thermal: lubricant.heat,
            roughness: rough.map(|rough| rough.sigma),
            asperities: rough.map(|rough| rough.asperities),
            peklenik: rough.map(|rough| rough.peklenik),
            shear_flow: rough.map(|rough| rough.shear_flow),
            boundary_friction: rough.map(|rough| rough.boundary_friction),
            wear_rate: rough.map(|rough| rough.wear_rate).filter(|rate| *rate > 0.0),
            srr: Some(sliding.slide_to_roll_ratio),
            npr: sliding.newtonian_plateau_ratio,
            grid: Some(grid),
            ..Self::from(at)
        }
    }
}
