//! Lists of quantities as maps in files: `{M: (2.0, 1000.0), L: (0.5, 25.0)}`. The order of the entries is kept.

use super::axis::{Axis, Spread};
use super::quantity::Quantity;
use serde::de::{Deserialize, Deserializer, Error, MapAccess, Visitor};
use serde::ser::{Serialize, Serializer};
use std::fmt;
use std::marker::PhantomData;

/// Entry of a list: a quantity and its value.
pub(super) trait Entry: Sized {
    /// Value of the quantity in a file.
    type Value: Serialize + for<'de> Deserialize<'de>;
    fn split(&self) -> (Quantity, Self::Value);
    fn join(quantity: Quantity, value: Self::Value) -> Self;
}

impl Entry for Axis {
    type Value = Spread;

    fn split(&self) -> (Quantity, Spread) {
        let scale = Some(self.scale).filter(|scale| *scale != self.quantity.scale());
        (self.quantity, Spread { ends: self.ends, scale })
    }

    fn join(quantity: Quantity, Spread { ends, scale }: Spread) -> Self {
        Self { quantity, ends, scale: scale.unwrap_or_else(|| quantity.scale()) }
    }
}

impl Entry for (Quantity, (f64, f64)) {
    type Value = (f64, f64);

    fn split(&self) -> (Quantity, (f64, f64)) {
        *self
    }

    fn join(quantity: Quantity, ends: (f64, f64)) -> Self {
        (quantity, ends)
    }
}

impl Entry for (Quantity, f64) {
    type Value = f64;

    fn split(&self) -> (Quantity, f64) {
        *self
    }

    fn join(quantity: Quantity, value: f64) -> Self {
        (quantity, value)
    }
}

/// List that is written as a map.
pub(super) struct Named<'a, E>(pub &'a [E]);

impl<E: Entry> Serialize for Named<'_, E> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(Entry::split))
    }
}

/// Reads a list from a map. Each quantity may occur once.
pub(super) fn deserialize<'de, E: Entry, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<E>, D::Error> {
    deserializer.deserialize_map(Entries(PhantomData))
}

struct Entries<E>(PhantomData<E>);

impl<'de, E: Entry> Visitor<'de> for Entries<E> {
    type Value = Vec<E>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a map of quantities, such as {M: (2.0, 1000.0)}")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Vec<E>, A::Error> {
        let mut entries: Vec<E> = Vec::new();
        while let Some((quantity, value)) = map.next_entry::<Quantity, E::Value>()? {
            if entries.iter().any(|entry| entry.split().0 == quantity) {
                return Err(A::Error::custom(format!("{quantity:?} is given twice")));
            }
            entries.push(E::join(quantity, value));
        }
        Ok(entries)
    }
}
