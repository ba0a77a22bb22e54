//! What is known of a field of a contact besides its type.

use super::words::Words;
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::engineering::Dimension;

/// What the number of a field measures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Measure {
    /// A quantity of the contact, with its range.
    Of(Quantity),
    /// A dimension.
    In(Dimension),
}

/// What is known of a field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facts {
    /// Its word: hyphens in flags and columns, underscores in keywords.
    pub name: &'static str,
    /// What it is.
    pub about: &'static str,
    /// What is added to that in a list of options; fields stand in it as `<radius>`.
    pub note: &'static str,
    /// Its title in a table where that is not its word.
    pub column: &'static str,
    /// What people write instead, in lower case and without spaces.
    pub titles: &'static [&'static str],
    /// Its name in a Functional Mock-up Unit where that is not its word.
    pub variable: &'static str,
    /// What its number measures.
    pub measure: Measure,
    /// The unit of a number without one, where that is not the SI unit.
    pub bare: Option<&'static str>,
    /// What stands for its value in a list of options.
    pub placeholder: Option<&'static str>,
    /// Its value where it is left out, for people.
    pub default: Option<&'static str>,
    /// The interfaces that do not have it.
    pub absent: &'static [Words],
}

impl Facts {
    /// A plain number, or what is no number.
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

    /// What its number measures in contacts of a kind.
    pub fn dimension_in(&self, kind: ContactKind) -> Dimension {
        match self.measure {
            Measure::Of(quantity) => quantity.dimension(kind),
            Measure::In(dimension) => dimension,
        }
    }

    /// The unit of a bare number in line contacts and in point contacts; empty where it has none.
    pub fn units(&self) -> [&'static str; 2] {
        let unit = |kind| self.bare.unwrap_or_else(|| self.dimension_in(kind).si_unit());
        [ContactKind::Line, ContactKind::Point].map(unit)
    }
}
