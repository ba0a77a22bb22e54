//! Reading and writing scenes as RON.

use super::error::{SceneError, SceneFileError, VERSION};
use super::{Scene, atomic_file, examples};
use ron::Options;
use ron::extensions::Extensions;
use ron::ser::PrettyConfig;
use serde::Deserialize;
use std::fs::File;
use std::io::Read as _;
use std::path::Path;

/// Largest scene file that is read \[bytes\].
pub const MAX_BYTES: u64 = 4 << 20;

fn options() -> Options {
    Options::default().with_default_extension(Extensions::IMPLICIT_SOME | Extensions::UNWRAP_VARIANT_NEWTYPES)
}

/// Only the version, whatever else is there.
#[derive(Deserialize)]
#[serde(rename = "Scene")]
struct Probe {
    version: u32,
}

impl Scene {
    /// Reads and checks a scene.
    ///
    /// # Errors
    /// With line and column where the text is wrong, or the field whose value makes no sense.
    pub fn from_ron(text: &str) -> Result<Self, SceneError> {
        let parsed = options().from_str::<Self>(text);
        let version = match &parsed {
            Ok(scene) => Some(scene.version),
            Err(_) => options().from_str::<Probe>(text).ok().map(|probe| probe.version),
        };
        match version {
            Some(version) if version > VERSION => return Err(SceneError::Newer { version }),
            Some(0) => return Err(SceneError::NoVersion),
            _ => {}
        }
        let scene = parsed.map_err(|error| SceneError::Syntax {
            line: error.span.start.line,
            column: error.span.start.col,
            message: error.code.to_string().replace('\n', " "),
        })?;
        scene.check()?;
        Ok(scene)
    }

    /// Writes the scene as text that [`Scene::from_ron`] reads back unchanged.
    ///
    /// # Errors
    /// Never for a scene that passes [`Scene::check`].
    pub fn to_ron(&self) -> Result<String, SceneError> {
        let config = PrettyConfig::new().struct_names(true).compact_arrays(true).depth_limit(3);
        let mut text =
            options().to_string_pretty(self, config).map_err(|error| SceneError::Unwritable(error.to_string()))?;
        text.push('\n');
        Ok(text)
    }

    /// Reads a scene file, or one of the program's [`examples`].
    ///
    /// # Errors
    /// When the file cannot be read or is no valid scene; the message names the file.
    pub fn read(path: &Path) -> Result<Self, SceneFileError> {
        let refused = |reason| SceneFileError::Scene { path: path.to_owned(), reason };
        if let Some(text) = examples::text_of(path) {
            return Self::from_ron(text).map_err(refused);
        }
        let unreadable = |reason: String| SceneFileError::Read { path: path.to_owned(), reason };
        if path.is_dir() {
            return Err(unreadable("it is a folder".to_owned()));
        }
        let mut bytes = Vec::new();
        // Devices and pipes announce no length: what is read is limited instead.
        let read = File::open(path).and_then(|file| file.take(MAX_BYTES + 1).read_to_end(&mut bytes));
        read.map_err(|error| unreadable(atomic_file::said(&error)))?;
        if bytes.len() as u64 > MAX_BYTES {
            return Err(unreadable(format!("it is larger than {MAX_BYTES} bytes, which no scene is")));
        }
        let text = String::from_utf8(bytes).map_err(|_| unreadable("it is not UTF-8 text".to_owned()))?;
        Self::from_ron(&text).map_err(refused)
    }

    /// Writes a scene file, as a whole or not at all.
    ///
    /// # Errors
    /// When the file cannot be written; the message names it.
    pub fn write(&self, path: &Path) -> Result<(), SceneFileError> {
        let text = self.to_ron().map_err(|reason| SceneFileError::Scene { path: path.to_owned(), reason })?;
        Ok(atomic_file::replace(path, text.as_bytes())?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FIRST: &str = "Scene(\n    version: 1,\n    title: \"t\",\n    study: Point(methods: [Full]),\n)";

    #[test]
    fn a_short_scene_takes_the_defaults_and_survives_writing() {
        let scene = Scene::from_ron(FIRST).unwrap();
        assert_eq!(scene.at, super::super::At::moes(40.0, 10.0));
        assert_eq!(Scene::from_ron(&scene.to_ron().unwrap()).unwrap(), scene);
    }

    #[test]
    fn unknown_fields_are_errors_with_line_and_column() {
        let text = FIRST.replace("title", "titel");
        let SceneError::Syntax { line, column, message } = Scene::from_ron(&text).unwrap_err() else { panic!() };
        assert_eq!(line, 3);
        assert!(column > 1 && message.contains("titel"), "{column} {message}");
    }

    #[test]
    fn a_newer_scene_is_refused_with_its_version_whatever_it_holds() {
        let text = "Scene(version: 7, title: \"t\", hologram: Wide(depth: 3, of: [1, 2]), study: Dream(\"x\"))";
        assert_eq!(Scene::from_ron(text).unwrap_err(), SceneError::Newer { version: 7 });
        let same = FIRST.replace("version: 1", "version: 2");
        assert_eq!(Scene::from_ron(&same).unwrap_err(), SceneError::Newer { version: 2 });
        assert_eq!(Scene::from_ron(&FIRST.replace("version: 1", "version: 0")).unwrap_err(), SceneError::NoVersion);
    }

    #[test]
    fn text_that_is_no_scene_is_refused() {
        for text in ["", "Scene(", "{}", "Scene()", "\u{0}\u{1}", "Scene(version: 1, title: \"t\", study: Point())"] {
            assert!(Scene::from_ron(text).is_err(), "{text}");
        }
        let deep = format!("Scene(version: 1, title: {}", "(".repeat(100_000));
        assert!(Scene::from_ron(&deep).is_err());
    }
}
