//! One varied quantity of a space with its interval.

use super::quantity::Quantity;
use super::scale::Scale;
use serde::de::{Error, SeqAccess, Visitor};
use serde::ser::SerializeTuple;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;

/// A quantity that varies within an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// The quantity.
    pub quantity: Quantity,
    /// Smallest and largest value, in SI units.
    pub ends: (f64, f64),
    /// How values are spread.
    pub scale: Scale,
}

impl Axis {
    /// Creates an axis with the usual scale of its quantity.
    pub fn new(quantity: Quantity, ends: (f64, f64)) -> Self {
        Self { quantity, ends, scale: quantity.scale() }
    }

    /// Creates an axis with equal differences.
    pub fn linear(quantity: Quantity, ends: (f64, f64)) -> Self {
        Self { quantity, ends, scale: Scale::Linear }
    }

    /// Creates an axis with equal ratios.
    pub fn logarithmic(quantity: Quantity, ends: (f64, f64)) -> Self {
        Self { quantity, ends, scale: Scale::Log }
    }

    /// Returns the value at a fraction 0…1 of the interval.
    pub fn value(&self, t: f64) -> f64 {
        let (low, high) = self.ends;
        match self.scale {
            Scale::Linear => low + (high - low) * t,
            Scale::Log => low * (high / low).powf(t),
        }
    }
}

/// Interval and scale of an axis in files: `(low, high)`, or `(low, high, Linear)` if the scale is not the usual one
/// of the quantity.
#[derive(Clone, Copy)]
pub(super) struct Spread {
    pub ends: (f64, f64),
    pub scale: Option<Scale>,
}

impl Serialize for Spread {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        // Formats that are not self-describing need a fixed number of elements.
        let always = !serializer.is_human_readable();
        let mut tuple = serializer.serialize_tuple(if always || self.scale.is_some() { 3 } else { 2 })?;
        tuple.serialize_element(&self.ends.0)?;
        tuple.serialize_element(&self.ends.1)?;
        match self.scale {
            _ if always => tuple.serialize_element(&self.scale)?,
            Some(scale) => tuple.serialize_element(&scale)?,
            None => {}
        }
        tuple.end()
    }
}

impl<'de> Deserialize<'de> for Spread {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let always = !deserializer.is_human_readable();
        deserializer.deserialize_tuple(3, SpreadVisitor { always })
    }
}

struct SpreadVisitor {
    always: bool,
}

impl<'de> Visitor<'de> for SpreadVisitor {
    type Value = Spread;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an interval (smallest, largest), or (smallest, largest, Linear) or (smallest, largest, Log)")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut values: A) -> Result<Spread, A::Error> {
        let short = |count| A::Error::invalid_length(count, &"an interval (smallest, largest)");
        let low = values.next_element()?.ok_or_else(|| short(0))?;
        let high = values.next_element()?.ok_or_else(|| short(1))?;
        let scale =
            if self.always { values.next_element::<Option<Scale>>()?.flatten() } else { values.next_element()? };
        Ok(Spread { ends: (low, high), scale })
    }
}
