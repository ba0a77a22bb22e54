//! Reasons why a contact lies outside a space.

use super::quantity::Quantity;
use crate::solver::limits::digits;
use crate::solver::physics::contact::ContactKind;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Reason why a model does not cover a contact, as data. Displayed as one sentence.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
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
    /// The laws, the inlet or the shape are of another kind. Contains the message.
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
                let shown = quantity.unit_in_sentences(*kind);
                let unit = match shown.name.strip_prefix('1') {
                    _ if shown.name.is_empty() => String::new(),
                    Some(per) => per.to_owned(),
                    None => format!(" {}", shown.name),
                };
                let [found, least, most] = [*value, *low, *high].map(|value| digits(shown.number(value)));
                let (name, range) = (quantity.short(), quantity.range());
                match (*low > range.0.max(0.0), *high < range.1) {
                    _ if low == high => {
                        write!(f, "{name} = {found}{unit}, but the model was trained at {least}{unit} only")
                    }
                    (false, true) if value > high => {
                        write!(f, "{name} = {found}{unit} lies above the trained {most}{unit}")
                    }
                    (true, false) if value < low => {
                        write!(f, "{name} = {found}{unit} lies below the trained {least}{unit}")
                    }
                    _ => write!(f, "{name} = {found}{unit} lies outside the trained range {least}…{most}{unit}"),
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sentence_names_the_end_that_is_passed() {
        let sentence = |quantity, value, ends| {
            let outside = Outside::of(quantity, ContactKind::Line, value, ends, 0.0);
            outside.map(|outside| outside.to_string()).unwrap_or_default()
        };
        assert_eq!(sentence(Quantity::M, 30.0, (2.0, 500.0)), "");
        assert_eq!(sentence(Quantity::M, 1.0, (2.0, 500.0)), "M = 1 lies outside the trained range 2…500");
        assert_eq!(sentence(Quantity::SlideToRollRatio, 0.7, (0.0, 0.6)), "SRR = 70 % lies above the trained 60 %");
        let reversed = sentence(Quantity::SlideToRollRatio, -0.3, (0.0, 0.6));
        assert_eq!(reversed, "SRR = -30 % lies outside the trained range 0…60 %");
        let thin = sentence(Quantity::FilmThickness, 0.1, (0.16, 1e6));
        assert_eq!(thin, "H_c by Moes’ formula = 0.1 lies below the trained 0.16");
        let radius = sentence(Quantity::Radius, 0.02, (0.01, 0.01));
        assert_eq!(radius, "R = 20 mm, but the model was trained at 10 mm only");
        let unknown = sentence(Quantity::HertzPressure, f64::NAN, (0.0, 3.2e9));
        assert!(unknown.starts_with("p_H = NaN"), "{unknown}");
    }
}
