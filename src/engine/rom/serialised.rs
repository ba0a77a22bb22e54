//! Serialisation of models as the content of their files.

use super::saved::SavedModel;
use crate::solver::reduced::ReducedModel;
use crate::solver::reduced::transient::TrajectoryModel;
use serde::de::Error as _;
use serde::ser::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::sync::Arc;

impl Serialize for ReducedModel {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        super::saved::to_bytes(self).map_err(S::Error::custom)?.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for ReducedModel {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let model = read(deserializer)?.stationary().map_err(D::Error::custom)?;
        Ok(Arc::unwrap_or_clone(model))
    }
}

impl Serialize for TrajectoryModel {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        super::saved::in_time_to_bytes(self).map_err(S::Error::custom)?.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for TrajectoryModel {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let model = read(deserializer)?.in_time().map_err(D::Error::custom)?;
        Ok(Arc::unwrap_or_clone(model))
    }
}

/// Reads a model that this program has serialised.
fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<SavedModel, D::Error> {
    super::saved::from_own_bytes(&Vec::<u8>::deserialize(deserializer)?, &()).map_err(D::Error::custom)
}
