//! The reduced models that are part of the program, with a catalogue of what they cover.

use super::rom::{self, Catalogue, ModelFileError};
use crate::host::models;
use crate::solver::observer::Observer;
use crate::solver::reduced::transient::TrajectoryModel;
use crate::solver::reduced::{Domain, ReducedModel};
use std::borrow::Cow;
use std::sync::{Arc, LazyLock, Mutex, MutexGuard, OnceLock, PoisonError};

/// What the program holds of the file of a model: all of it, or without the feature `models` its header and directory.
#[cfg(feature = "models")]
macro_rules! held {
    ($path:literal) => {
        include_bytes!($path)
    };
}
#[cfg(not(feature = "models"))]
macro_rules! held {
    ($path:literal) => {{
        // The file itself is needed at compile time only.
        const FILE: &[u8] = include_bytes!($path);
        static HEAD: [u8; rom::head_length(FILE)] = rom::head(FILE);
        &HEAD
    }};
}

/// The steady models by name, each with what the program holds of its file. Scenes in `scenes/training` train them.
const MODELS: [(&str, &[u8]); 11] = [
    ("line", held!("../../assets/line.rom")),
    ("line_shear", held!("../../assets/line_shear.rom")),
    ("point", held!("../../assets/point.rom")),
    ("point_light", held!("../../assets/point_light.rom")),
    ("point_shear", held!("../../assets/point_shear.rom")),
    ("ellipse", held!("../../assets/ellipse.rom")),
    ("line_heat", held!("../../assets/line_heat.rom")),
    ("point_heat", held!("../../assets/point_heat.rom")),
    ("line_sliding", held!("../../assets/line_sliding.rom")),
    ("point_sliding", held!("../../assets/point_sliding.rom")),
    ("point_light_sliding", held!("../../assets/point_light_sliding.rom")),
];

/// A model of the program in the catalogue.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Name of the model and of its file.
    pub name: &'static str,
    /// Contacts it covers.
    pub domain: Domain,
}

/// Returns the catalogue of the steady models, from the directories of their files; a damaged one is left out.
pub fn catalogue() -> &'static [Entry] {
    static CATALOGUE: LazyLock<Vec<Entry>> = LazyLock::new(|| {
        let entry = |(name, bytes)| Some(Entry { name, domain: Catalogue::of_head(bytes).ok()?.domain });
        MODELS.into_iter().filter_map(entry).collect()
    });
    &CATALOGUE
}

/// Returns the content of the file of a model; `None` for an unknown name, and where the file is not there (yet).
pub fn bytes_of(name: &str) -> Option<Cow<'static, [u8]>> {
    let (_, held) = MODELS.iter().chain(&[IN_TIME]).find(|(known, _)| *known == name)?;
    if cfg!(feature = "models") { Some(Cow::Borrowed(held)) } else { models::now(name).map(Cow::Owned) }
}

/// Models that have been read, by name.
pub(super) type Read = Vec<(String, Arc<ReducedModel>)>;

static READ: Mutex<Read> = Mutex::new(Vec::new());

fn read() -> MutexGuard<'static, Read> {
    // A thread that panicked leaves a whole list.
    READ.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Locks the models that have been read, with the catalogue made.
pub(super) fn hold() -> MutexGuard<'static, Read> {
    catalogue();
    read()
}

/// Name of a model of the program that has been read; `None` for other models.
pub fn name_of(model: &Arc<ReducedModel>) -> Option<String> {
    read().iter().find(|(_, read)| Arc::ptr_eq(read, model)).map(|(name, _)| name.clone())
}

/// Reads a model of the program. That its parts belong together was checked when it was tested, and is not checked again.
///
/// # Errors
/// For an unknown name, and when the program was built with a damaged asset.
pub fn embedded(name: &str) -> Result<Arc<ReducedModel>, ModelFileError> {
    embedded_watched(name, &())
}

/// [`embedded`] while an observer watches. Each model is read once.
///
/// # Errors
/// As [`embedded`], and when the observer cancels.
pub(super) fn embedded_watched(name: &str, observer: &dyn Observer) -> Result<Arc<ReducedModel>, ModelFileError> {
    let known = |read: &Read| read.iter().find(|(known, _)| known == name).map(|(_, model)| Arc::clone(model));
    if let Some(model) = known(&read()) {
        return Ok(model);
    }
    let bytes = bytes_of(name).ok_or(ModelFileError::Foreign)?;
    let model = rom::from_own_bytes(&bytes, observer)?.stationary()?;
    let mut read = read();
    // If another thread has read it in the meantime, everybody gets that one.
    Ok(known(&read).unwrap_or_else(|| {
        read.push((name.to_owned(), Arc::clone(&model)));
        model
    }))
}

/// The transient model with the content of its file.
const IN_TIME: (&str, &[u8]) = ("line_in_time", held!("../../assets/line_in_time.rom"));

/// The model in time of line contacts whose load varies: `scenes/training/line_in_time.ron`. It is read once: every picture
/// needs what it was trained for.
///
/// # Errors
/// When the program was built with a damaged asset.
pub fn line_in_time() -> Result<Arc<TrajectoryModel>, ModelFileError> {
    static MODEL: OnceLock<Arc<TrajectoryModel>> = OnceLock::new();
    if let Some(model) = MODEL.get() {
        return Ok(Arc::clone(model));
    }
    let bytes = bytes_of(IN_TIME.0).ok_or(ModelFileError::Foreign)?;
    let read = rom::from_own_bytes(&bytes, &())?.in_time()?;
    Ok(Arc::clone(MODEL.get_or_init(|| read)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_catalogue_has_every_model() {
        assert_eq!(catalogue().len(), MODELS.len());
    }

    #[test]
    fn all_files_together_are_small() {
        let all = MODELS.iter().map(|(_, bytes)| bytes.len()).sum::<usize>() + IN_TIME.1.len();
        assert!(all < 28_800_000 && bytes_of("line").unwrap().len() < 3_100_000, "{all} bytes");
    }
}
