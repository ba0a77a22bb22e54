//! Example scenes embedded in the program: the content of the folder `scenes/`. A path that contains [`ROOT`] refers to
//! one of these files, wherever a scene or its tables are read.

use super::Scene;
use include_dir::{Dir, include_dir};
use std::path::{Component, Path};
use std::sync::LazyLock;

/// Start of paths to examples: `examples:/training/slider_range_model.ron`.
pub const ROOT: &str = "examples:";

static FOLDER: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/scenes");

/// Example scene.
#[derive(Debug)]
pub struct Example {
    /// Folder and file name below [`ROOT`].
    pub path: &'static str,
    /// The scene. Its references to other files start at [`ROOT`], so that it can be saved in any folder.
    pub scene: Scene,
}

impl Example {
    /// Returns the folder of the example.
    pub fn folder(&self) -> &'static str {
        self.path.split('/').next().unwrap_or_default()
    }
}

/// Returns all examples, folder by folder, sorted by name.
pub fn all() -> &'static [Example] {
    static ALL: LazyLock<Vec<Example>> = LazyLock::new(|| {
        let files = FOLDER.dirs().flat_map(Dir::files).filter_map(|file| file.path().to_str());
        let scenes = files.filter(|path| path.ends_with(".ron"));
        // A test checks that all examples are accepted.
        scenes.filter_map(|path| Some(Example { path, scene: Scene::from_ron(&linked(path)?).ok()? })).collect()
    });
    &ALL
}

/// Returns the text of the embedded file that a path through [`ROOT`] refers to; `None` for other paths.
pub fn text_of(path: &Path) -> Option<&'static str> {
    let mut inside = Vec::new();
    for component in path.components().skip_while(|component| component.as_os_str() != ROOT).skip(1) {
        match component {
            Component::ParentDir => _ = inside.pop()?,
            Component::Normal(name) => inside.push(name.to_str()?),
            _ => {}
        }
    }
    FOLDER.get_file(inside.join("/"))?.contents_utf8()
}

/// Returns the text of an example with references to other embedded files rewritten to start at [`ROOT`].
fn linked(path: &str) -> Option<String> {
    let from_root = Path::new(ROOT).join(path);
    let folder = from_root.parent()?;
    let parts = text_of(&from_root)?.split('"').map(|part| {
        let target = folder.join(part);
        let is_name = part.ends_with(".ron") || part.ends_with(".csv");
        if is_name && text_of(&target).is_some() { plain(&target) } else { part.to_owned() }
    });
    Some(parts.collect::<Vec<_>>().join("\""))
}

/// Resolves `..` in a path.
fn plain(path: &Path) -> String {
    let mut names: Vec<String> = Vec::new();
    for component in path.components() {
        match component {
            Component::ParentDir => _ = names.pop(),
            other => names.push(other.as_os_str().to_string_lossy().into_owned()),
        }
    }
    names.join("/")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;
    use std::path::PathBuf;

    fn files_in(folder: &Path) -> Vec<PathBuf> {
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect()
    }

    #[test]
    fn every_scene_file_is_embedded() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
        let folders = files_in(&root).into_iter().filter(|path| path.is_dir());
        let scenes = folders.flat_map(|folder| files_in(&folder));
        let scenes: Vec<PathBuf> = scenes.filter(|path| path.extension().is_some_and(|end| end == "ron")).collect();
        let known: BTreeSet<&str> = all().iter().map(|example| example.path).collect();
        assert_eq!(known.len(), scenes.len(), "`cargo clean -p ehl-explorer` takes new files in");
        for path in scenes {
            let name = path.strip_prefix(&root).unwrap().to_str().unwrap().replace('\\', "/");
            let example = all().iter().find(|example| example.path == name).unwrap();
            let file = Scene::read(&path).unwrap();
            let (own, expected) = (&example.scene, file.expect.len());
            assert_eq!((&own.title, own.at, own.grid, own.expect.len()), (&file.title, file.at, file.grid, expected));
            assert_eq!(text_of(&Path::new(ROOT).join(&name)).unwrap(), std::fs::read_to_string(&path).unwrap());
        }
    }

    #[test]
    fn what_a_scene_refers_to_is_found_from_anywhere() {
        let example = all().iter().find(|example| example.path == "load_cases/rollers_and_balls.ron").unwrap();
        let text = example.scene.to_ron().unwrap();
        assert!(text.contains("examples:/load_cases/rollers_and_balls.csv"), "{text}");
        for path in [
            "examples:/load_cases/rollers_and_balls.csv",
            "/elsewhere/examples:/load_cases/rollers_and_balls.csv",
            "examples:/reduced/../load_cases/rollers_and_balls.csv",
        ] {
            assert!(text_of(Path::new(path)).is_some_and(|text| text.contains("name")), "{path}");
        }
        for path in ["load_cases/rollers_and_balls.csv", "examples:/none.csv", "examples:/../../Cargo.toml", ""] {
            assert!(text_of(Path::new(path)).is_none(), "{path}");
        }
        for Example { path, scene } in all() {
            let text = scene.to_ron().unwrap();
            let references = text.split('"').filter(|part| part.ends_with(".ron") && !part.contains(' '));
            for reference in references {
                assert!(reference.starts_with(ROOT), "{path}: {reference}");
            }
        }
    }
}
