//! Static description of the fields of a contact.

use super::words::Words;
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::engineering::Dimension;

/// Quantity or dimension that a numeric field has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Measure {
    /// Quantity of the contact, with its range.
    Of(Quantity),
    /// Dimension.
    In(Dimension),
}

/// Static description of a field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facts {
    /// Name, with hyphens in flags and columns, underscores in keywords.
    pub name: &'static str,
    /// Description.
    pub about: &'static str,
    /// Addition to the description in a list of options. Fields are written as `<radius>`.
    pub note: &'static str,
    /// Title in tables; usually the name.
    pub column: &'static str,
    /// Other accepted titles, in lower case and without spaces.
    pub titles: &'static [&'static str],
    /// Variable name in a Functional Mock-up Unit; usually the name.
    pub variable: &'static str,
    /// Quantity or dimension of a number.
    pub measure: Measure,
    /// Unit of a number written without one, if it is not the SI unit.
    pub bare: Option<&'static str>,
    /// Placeholder for the value in a list of options.
    pub placeholder: Option<&'static str>,
    /// Default value, for users.
    pub default: Option<&'static str>,
    /// Interfaces that do not have the field.
    pub absent: &'static [Words],
}

impl Facts {
    /// Returns the description of a dimensionless number or of a field that is not a number.
    pub(super) const fn new(name: &'static str, about: &'static str) -> Self {
        Self {
            name,
            about,
            note: "",
            column: name,
            titles: &[],
            variable: name,
            measure: Measure::In(Dimension::Ratio),
            bare: None,
            placeholder: None,
            default: None,
            absent: &[],
        }
    }

    /// Returns the dimension of the number for a contact kind.
    pub fn dimension_in(&self, kind: ContactKind) -> Dimension {
        match self.measure {
            Measure::Of(quantity) => quantity.dimension(kind),
            Measure::In(dimension) => dimension,
        }
    }

    /// Returns the units of a number written without one, for line and point contacts; empty for dimensionless numbers.
    pub fn units(&self) -> [&'static str; 2] {
        let unit = |kind| self.bare.unwrap_or_else(|| self.dimension_in(kind).si_unit());
        ContactKind::BOTH.map(unit)
    }
}
