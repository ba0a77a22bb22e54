//! Reduced models embedded in the program, with a catalogue of their ranges.

use super::rom::{self, Catalogue, ModelFileError};
use crate::host::models;
use crate::solver::observer::Observer;
use crate::solver::physics::contact::ContactKind;
use crate::solver::reduced::transient::TrajectoryModel;
use crate::solver::reduced::{Domain, ReducedModel};
use std::borrow::Cow;
use std::path::Path;
use std::sync::{Arc, LazyLock, Mutex, MutexGuard, OnceLock, PoisonError};

/// Embeds a model file: complete, or without the feature `models` only header and directory.
#[cfg(feature = "models")]
macro_rules! held {
    ($path:literal) => {
        include_bytes!($path)
    };
}
#[cfg(not(feature = "models"))]
macro_rules! held {
    ($path:literal) => {{
        // The file itself is needed only at compile time.
        const FILE: &[u8] = include_bytes!($path);
        static HEAD: [u8; rom::head_length(FILE)] = rom::head(FILE);
        &HEAD
    }};
}

/// Names of the steady models with the embedded part of their files. Scenes in `scenes/training` train them.
const MODELS: [(&str, &[u8]); 13] = [
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
    ("line_rough", held!("../../assets/line_rough.rom")),
    ("point_rough", held!("../../assets/point_rough.rom")),
];

/// Catalogue entry of an embedded model.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Name of the model and of its file.
    pub name: &'static str,
    /// Range of contacts that it covers.
    pub domain: Domain,
}

/// Returns the catalogue of the steady models, read from the directories of their files. Damaged files are left out.
pub fn catalogue() -> &'static [Entry] {
    static CATALOGUE: LazyLock<Vec<Entry>> = LazyLock::new(|| {
        let entry = |(name, bytes)| Some(Entry { name, domain: Catalogue::of_head(bytes).ok()?.domain });
        MODELS.into_iter().filter_map(entry).collect()
    });
    &CATALOGUE
}

/// Returns the content of a model's file; `None` for an unknown name, or if the file has not been loaded yet.
pub fn bytes_of(name: &str) -> Option<Cow<'static, [u8]>> {
    let (_, held) = MODELS.iter().chain(&IN_TIME).find(|(known, _)| *known == name)?;
    if cfg!(feature = "models") { Some(Cow::Borrowed(held)) } else { models::now(name).map(Cow::Owned) }
}

/// Returns the name of an embedded model that stands in place of a path, if there is no such file.
pub fn named_by(path: &Path) -> Option<&str> {
    path.to_str().filter(|name| !path.exists() && bytes_of(name).is_some())
}

/// Loaded models and outlines.
pub(super) type Read = Vec<Loaded>;

/// Loaded model, or the outline of one.
pub(super) struct Loaded {
    name: String,
    outline: bool,
    model: Arc<ReducedModel>,
}

static READ: Mutex<Read> = Mutex::new(Vec::new());

fn read() -> MutexGuard<'static, Read> {
    // A panic does not leave the list in an invalid state.
    READ.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Locks the list of loaded models, after making sure that the catalogue exists.
pub(super) fn hold() -> MutexGuard<'static, Read> {
    catalogue();
    read()
}

/// Returns the name of a loaded embedded model or outline; `None` for other models.
pub fn name_of(model: &Arc<ReducedModel>) -> Option<String> {
    read().iter().find(|own| Arc::ptr_eq(&own.model, model)).map(|own| own.name.clone())
}

/// Frees the models that are not in use.
pub(super) fn forget_unused() {
    read().retain(|own| Arc::strong_count(&own.model) > 1);
}

/// Loads an embedded model. Its consistency is checked by tests, not here.
///
/// # Errors
/// For an unknown name, or if the program was built with a damaged file.
pub fn embedded(name: &str) -> Result<Arc<ReducedModel>, ModelFileError> {
    embedded_watched(name, &())
}

/// Loads an embedded model with an observer, as [`embedded`]. Each model is read once.
///
/// # Errors
/// As [`embedded`], and if the observer cancels.
pub(super) fn embedded_watched(name: &str, observer: &dyn Observer) -> Result<Arc<ReducedModel>, ModelFileError> {
    loaded(name, false, |bytes| rom::from_own_bytes(bytes, observer)?.stationary())
}

/// Loads the outline of an embedded model: everything that the screen shows except the modes. It cannot solve.
///
/// # Errors
/// As [`embedded`].
pub(super) fn outline(name: &str) -> Result<Arc<ReducedModel>, ModelFileError> {
    loaded(name, true, |bytes| rom::outline_from_own_bytes(bytes).map(Arc::new))
}

/// Returns true if an embedded model is loaded.
pub(super) fn is_loaded(name: &str) -> bool {
    read().iter().any(|own| own.name == name && !own.outline)
}

fn loaded(
    name: &str,
    outline: bool,
    load: impl FnOnce(&[u8]) -> Result<Arc<ReducedModel>, ModelFileError>,
) -> Result<Arc<ReducedModel>, ModelFileError> {
    let known = |read: &Read| {
        let own = read.iter().find(|own| own.name == name && own.outline == outline);
        own.map(|own| Arc::clone(&own.model))
    };
    if let Some(model) = known(&read()) {
        return Ok(model);
    }
    let model = load(&bytes_of(name).ok_or(ModelFileError::Missing)?)?;
    let mut read = read();
    // If another thread has loaded it in the meantime, that copy is used.
    Ok(known(&read).unwrap_or_else(|| {
        read.push(Loaded { name: name.to_owned(), outline, model: Arc::clone(&model) });
        model
    }))
}

/// Names of the transient models with the embedded part of their files: of line and of circular contacts.
const IN_TIME: [(&str, &[u8]); 2] = [
    ("line_in_time", held!("../../assets/line_in_time.rom")),
    ("point_in_time", held!("../../assets/point_in_time.rom")),
];

/// Loads the transient model of a kind of contact: `scenes/training/line_in_time.ron` for line contacts with varying
/// load, `scenes/training/point_in_time.ron` for circular contacts with varying load and speed. It is read only once,
/// because its trained range is needed for every frame.
///
/// # Errors
/// If the program was built with a damaged file.
pub fn in_time(kind: ContactKind) -> Result<Arc<TrajectoryModel>, ModelFileError> {
    static LINE: OnceLock<Arc<TrajectoryModel>> = OnceLock::new();
    static POINT: OnceLock<Arc<TrajectoryModel>> = OnceLock::new();
    let [(line, _), (point, _)] = IN_TIME;
    let (name, model) = if kind.is_line() { (line, &LINE) } else { (point, &POINT) };
    if let Some(model) = model.get() {
        return Ok(Arc::clone(model));
    }
    let bytes = bytes_of(name).ok_or(ModelFileError::Foreign)?;
    let read = rom::from_own_bytes(&bytes, &())?.in_time()?;
    Ok(Arc::clone(model.get_or_init(|| read)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::reduced::Window;

    #[test]
    fn the_catalogue_has_every_model() {
        assert_eq!(catalogue().len(), MODELS.len());
    }

    #[test]
    fn outlines_have_everything_but_the_modes() {
        for (name, _) in MODELS {
            let (whole, outline) = (embedded(name).unwrap(), outline(name).unwrap());
            assert!(outline.is_outline() && !whole.is_outline(), "{name}");
            assert_eq!((&outline.domain, &outline.title, &outline.log), (&whole.domain, &whole.title, &whole.log));
            assert_eq!([&outline, &whole].map(name_of), [Some(name.to_owned()), Some(name.to_owned())]);
            for (own, window) in outline.windows.iter().zip(&whole.windows) {
                assert_eq!((own.size(), own.grid.spec()), (window.size(), window.grid.spec()));
                assert_eq!((&own.sampled_rows, own.anchor), (&window.sampled_rows, window.anchor));
                assert_eq!(own.pressure.singular_values(), window.pressure.singular_values());
                assert_eq!(own.deformation.singular_values, window.deformation.singular_values);
                let points = |window: &Window| window.snapshots.iter().map(|s| (s.point, s.h_c)).collect::<Vec<_>>();
                assert_eq!(points(own), points(window));
            }
            assert_eq!(outline.windows.len(), whole.windows.len());
        }
    }

    #[test]
    fn all_files_together_are_small() {
        let all = MODELS.iter().chain(&IN_TIME).map(|(_, bytes)| bytes.len()).sum::<usize>();
        assert!(all < 32_000_000 && bytes_of("line").unwrap().len() < 3_100_000, "{all} bytes");
    }
}
