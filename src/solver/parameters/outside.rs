//! Why a contact lies outside a space.

use super::quantity::Quantity;
use crate::solver::limits::digits;
use crate::solver::physics::contact::ContactKind;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Why a model does not cover a contact, as data; displayed as one sentence.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Outside {
    /// A quantity lies outside its interval.
    Quantity {
        /// The quantity.
        quantity: Quantity,
        /// Kind of contact, for the unit of a load.
        kind: ContactKind,
        /// Its value, in SI units.
        value: f64,
        /// The interval, in SI units.
        ends: (f64, f64),
    },
    /// No contact of a box of SI quantities has the same M, L, α and η₀.
    Box {
        /// M of the contact.
        m: f64,
        /// L of the contact.
        l: f64,
    },
    /// The laws, the inlet or the shape are of another kind.
    Other(String),
}

impl Outside {
    /// `Some` if a value lies outside an interval, with a tolerance relative to the ends.
    pub fn of(quantity: Quantity, kind: ContactKind, value: f64, ends: (f64, f64), tolerance: f64) -> Option<Self> {
        let (low, high) = ends;
        let inside = value >= low - tolerance * low.abs() && value <= high + tolerance * high.abs();
        (!inside).then_some(Self::Quantity { quantity, kind, value, ends })
    }
}

impl fmt::Display for Outside {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Quantity { quantity, kind, value, ends: (low, high) } => {
                let (unit, scale) = quantity.reading_unit(*kind);
                let unit = match unit.strip_prefix('1') {
                    _ if unit.is_empty() => String::new(),
                    Some(per) => per.to_owned(),
                    None => format!(" {unit}"),
                };
                let [value, least, most] = [*value, *low, *high].map(|number| digits(number / scale));
                let (name, range) = (quantity.short(), quantity.range());
                match (*low > range.0.max(0.0), *high < range.1) {
                    _ if low == high => {
                        write!(f, "{name} = {value}{unit}, but the model was trained at {least}{unit} only")
                    }
                    (false, true) => write!(f, "{name} = {value}{unit} lies above the trained {most}{unit}"),
                    (true, false) => write!(f, "{name} = {value}{unit} lies below the trained {least}{unit}"),
                    _ => write!(f, "{name} = {value}{unit} lies outside the trained range {least}…{most}{unit}"),
                }
            }
            Self::Box { m, l } => write!(
                f,
                "no contact of the trained box of R, u_m, w and α has M = {} and L = {} at this α and η₀",
                digits(*m),
                digits(*l)
            ),
            Self::Other(sentence) => f.write_str(sentence),
        }
    }
}
