//! The reduced models that are part of the program, with a catalogue of what they cover.

use super::model_file::{self, ModelFileError};
use super::trajectory_file;
use crate::solver::observer::Observer;
use crate::solver::reduced::transient::TrajectoryModel;
use crate::solver::reduced::{Domain, ReducedModel};
use serde::{Deserialize, Serialize};
use std::sync::{Arc, LazyLock, OnceLock};

/// The steady models by name, each with the content of its file. Scenes in `scenes/training` train them.
const MODELS: [(&str, &[u8]); 11] = [
    ("line", include_bytes!("../../assets/line.rom")),
    ("line_shear", include_bytes!("../../assets/line_shear.rom")),
    ("point", include_bytes!("../../assets/point.rom")),
    ("point_light", include_bytes!("../../assets/point_light.rom")),
    ("point_shear", include_bytes!("../../assets/point_shear.rom")),
    ("ellipse", include_bytes!("../../assets/ellipse.rom")),
    ("line_heat", include_bytes!("../../assets/line_heat.rom")),
    ("point_heat", include_bytes!("../../assets/point_heat.rom")),
    ("line_sliding", include_bytes!("../../assets/line_sliding.rom")),
    ("point_sliding", include_bytes!("../../assets/point_sliding.rom")),
    ("point_light_sliding", include_bytes!("../../assets/point_light_sliding.rom")),
];

/// What a model of the program covers, apart from its bytes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Entry {
    /// Name of the model and of its file.
    pub name: String,
    /// Title for people.
    pub title: String,
    /// Contacts it covers.
    pub domain: Domain,
    /// Size of its file in bytes.
    pub bytes: usize,
    /// XXH3 hash of its file.
    pub hash: u64,
}

/// Returns the catalogue of the steady models; empty if the program was built with a damaged one.
pub fn catalogue() -> &'static [Entry] {
    static CATALOGUE: LazyLock<Vec<Entry>> =
        LazyLock::new(|| ron::from_str(include_str!("../../assets/models.ron")).unwrap_or_default());
    &CATALOGUE
}

/// Returns the content of the file of a model; `None` for an unknown name.
pub fn bytes_of(name: &str) -> Option<&'static [u8]> {
    MODELS.iter().find(|(known, _)| *known == name).map(|(_, bytes)| *bytes)
}

/// Reads a model of the program. That its parts belong together was checked when it was tested, and is not checked again.
///
/// # Errors
/// For an unknown name, and when the program was built with a damaged asset.
pub fn embedded(name: &str) -> Result<Arc<ReducedModel>, ModelFileError> {
    embedded_watched(name, &())
}

/// The same while an observer watches.
///
/// # Errors
/// As [`embedded`], and when the observer cancels.
pub(super) fn embedded_watched(name: &str, observer: &dyn Observer) -> Result<Arc<ReducedModel>, ModelFileError> {
    let bytes = bytes_of(name).ok_or(ModelFileError::Foreign)?;
    model_file::from_own_bytes(bytes, observer).map(Arc::new)
}

/// Whether a model's file would be, byte for byte, one of these.
pub(super) fn is_embedded(model: &ReducedModel) -> bool {
    model_file::to_bytes(model).is_ok_and(|bytes| MODELS.iter().any(|(_, own)| *own == bytes))
}

/// The content of the file of the model in time.
const LINE_IN_TIME: &[u8] = include_bytes!("../../assets/line_in_time.rom");

/// The model in time of line contacts whose load breathes: `scenes/training/line_in_time.ron`. It is read once, and what
/// it was trained for is asked with every picture.
///
/// # Errors
/// When the program was built with a damaged asset.
pub fn line_in_time() -> Result<Arc<TrajectoryModel>, ModelFileError> {
    static MODEL: OnceLock<Arc<TrajectoryModel>> = OnceLock::new();
    if let Some(model) = MODEL.get() {
        return Ok(Arc::clone(model));
    }
    let read = trajectory_file::from_own_bytes(LINE_IN_TIME)?;
    Ok(Arc::clone(MODEL.get_or_init(|| read)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use xxhash_rust::xxh3::xxh3_64;

    #[test]
    fn the_parts_of_every_model_belong_together() {
        for (name, bytes) in MODELS {
            let read = model_file::from_bytes(bytes).unwrap_or_else(|why| panic!("{name}: {why}"));
            assert!(!read.windows.is_empty() && read.domain == embedded(name).unwrap().domain);
        }
    }

    #[test]
    fn the_catalogue_says_what_the_files_hold() {
        let entries = MODELS.map(|(name, bytes)| {
            let ReducedModel { title, domain, .. } = ReducedModel::clone(&embedded(name).unwrap());
            Entry { name: name.to_owned(), title, domain, bytes: bytes.len(), hash: xxh3_64(bytes) }
        });
        let text = ron::ser::to_string_pretty(&entries, ron::ser::PrettyConfig::default()).unwrap();
        assert!(catalogue() == entries, "assets/models.ron should be\n{text}");
    }

    #[test]
    fn the_parts_of_the_transient_model_belong_together_and_it_survives_a_round_trip() {
        let read = trajectory_file::from_bytes(LINE_IN_TIME).unwrap();
        assert_eq!(read.domain, line_in_time().unwrap().domain);
    }

    #[test]
    fn all_files_together_are_small() {
        let all = MODELS.iter().map(|(_, bytes)| bytes.len()).sum::<usize>() + LINE_IN_TIME.len();
        assert!(all < 28_800_000 && bytes_of("line").unwrap().len() < 3_100_000, "{all} bytes");
    }
}
