//! Groups of columns in tables of results.

use super::contact_result::ContactResult;
use crate::solver::physics::lubricant::Lubricant;

/// Groups of result columns that only some contacts have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Extras {
    /// Temperatures of thermal contacts.
    pub heat: bool,
    /// Forces and power loss of line contacts with a length.
    pub total: bool,
    /// Values of contacts with rough surfaces.
    pub mixed: bool,
}

impl Extras {
    /// Returns the groups that at least one contact with these lubricants has.
    pub fn of<'a>(lubricants: impl IntoIterator<Item = &'a Lubricant>) -> Self {
        lubricants.into_iter().fold(Self::default(), |all, lubricant| Self {
            heat: all.heat || lubricant.heat.is_some(),
            mixed: all.mixed || lubricant.is_rough(),
            ..all
        })
    }

    /// Returns the groups that at least one of these results has.
    pub fn of_results<'a>(results: impl IntoIterator<Item = &'a ContactResult>) -> Self {
        results.into_iter().fold(Self::default(), |all, result| Self {
            heat: all.heat || result.heat.is_some(),
            mixed: all.mixed || result.mixed.is_some(),
            total: all.total || result.extent.length_m.is_some(),
        })
    }
}
