//! A lubricant with all its laws as one value, where scenes state cavitation and heat in fields of their own: for
//! `#[serde(with = "whole")]`.

use super::{Cavitation, Heat, Lubricant};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

#[derive(Serialize, Deserialize)]
struct Whole {
    laws: Lubricant,
    cavitation: Cavitation,
    heat: Option<Heat>,
}

/// Writes all laws.
///
/// # Errors
/// As the format.
pub fn serialize<S: Serializer>(laws: &Lubricant, serializer: S) -> Result<S::Ok, S::Error> {
    let Lubricant { cavitation, heat, .. } = *laws;
    Whole { laws: *laws, cavitation, heat }.serialize(serializer)
}

/// Reads all laws.
///
/// # Errors
/// As the format.
pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Lubricant, D::Error> {
    let Whole { laws, cavitation, heat } = Whole::deserialize(deserializer)?;
    Ok(Lubricant { cavitation, heat, ..laws })
}
