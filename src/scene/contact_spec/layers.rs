//! A contact over another one: what a line of a table leaves out is its scene's.

use super::fields::{ContactSpec, Field};
use super::refusal::Refusal;
use crate::scene::at::At;
use crate::scene::experiment::Experiment;
use crate::solver::physics::contact::ContactKind;

/// The fields that [`At`] has.
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
    /// Line or point contact.
    pub fn kind(&self) -> ContactKind {
        self.contact.unwrap_or_default()
    }

    /// Reads fields over another contact: texts with or without a unit, each with the unit of numbers that have none.
    ///
    /// # Errors
    /// With the first field whose text is no value of it.
    pub fn read_over<'a>(
        base: &Self,
        texts: impl IntoIterator<Item = (Field, &'a str, &'a str)>,
    ) -> Result<Self, Refusal> {
        let mut texts: Vec<_> = texts.into_iter().collect();
        // The unit of a load depends on the kind of contact, which is the first field.
        texts.sort_by_key(|(field, ..)| *field);
        let mut own = Self { contact: base.contact, ..Self::default() };
        texts.into_iter().try_for_each(|(field, text, unit)| own.read(field, text, unit))?;
        Ok(own.over(base.clone()))
    }

    /// This contact, with what it leaves out from another one. What says the same thing in other fields takes the place
    /// of the other one's.
    fn over(self, mut base: Self) -> Self {
        let states = |fields: &[Field]| fields.iter().any(|field| self.states(*field));
        if states(&[Field::MoesM, Field::MoesL]) || base.moes_m.is_some() {
            NUMBERS.into_iter().for_each(|field| base.forget(field));
        }
        if self.kind() != base.kind() {
            base.load = None;
        }
        if self.kind() == ContactKind::Line {
            base.radius_y = None;
        }
        if states(&[Field::E1, Field::Nu1, Field::E2, Field::Nu2]) {
            base.modulus = None;
        }
        if states(&[Field::Oil, Field::Temperature]) {
            (base.viscosity, base.alpha) = (None, None);
        }
        if self.lubricant.is_some_and(|named| named.viscosity_pa_s.is_some()) {
            base.viscosity = None;
        }
        if states(&[Field::Grid, Field::Dx, Field::Dy, Field::Domain]) {
            base.grid = None;
        }
        let own_alpha = self.alpha.is_some();
        let mut all = self.filled_from(base);
        if !own_alpha && all.named_laws().own_coefficient().is_some() {
            all.alpha = None;
        }
        all
    }

    fn forget(&mut self, field: Field) {
        let place = match field {
            Field::Radius => &mut self.radius,
            Field::RadiusY => &mut self.radius_y,
            Field::Speed => &mut self.speed,
            Field::Load => &mut self.load,
            Field::Modulus => &mut self.modulus,
            Field::Viscosity => &mut self.viscosity,
            Field::Alpha => &mut self.alpha,
            Field::MoesM => &mut self.moes_m,
            Field::MoesL => &mut self.moes_l,
            _ => return,
        };
        *place = None;
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
        let Experiment { contact, lubricant, at, sliding, grid, .. } = *experiment;
        Self {
            contact: Some(contact),
            laws: Some(lubricant),
            cavitation: Some(lubricant.cavitation),
            heat: Some(lubricant.heat.is_some()),
            thermal: lubricant.heat,
            srr: Some(sliding.slide_to_roll_ratio),
            npr: sliding.newtonian_plateau_ratio,
            grid: Some(grid),
            ..Self::from(at)
        }
    }
}
