//! The scenes that come with the program, as they lie in `scenes/`: a program that was copied elsewhere has them too.
//! A path that leads through [`ROOT`] names one of their files, wherever a scene or its tables are read.

use super::Scene;
use include_dir::{Dir, include_dir};
use std::path::{Component, Path};
use std::sync::LazyLock;

/// Where paths to them begin: `examples:/training/slider_range_model.ron`.
pub const ROOT: &str = "examples:";

static FOLDER: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/scenes");

/// A scene of the program.
#[derive(Debug)]
pub struct Example {
    /// Folder and file below [`ROOT`].
    pub path: &'static str,
    /// The scene; what it refers to is named from [`ROOT`] on, so that it can be saved anywhere.
    pub scene: Scene,
}

impl Example {
    /// The folder that it lies in.
    pub fn folder(&self) -> &'static str {
        self.path.split('/').next().unwrap_or_default()
    }
}

/// All of them, folder by folder, in the order of their names.
pub fn all() -> &'static [Example] {
    static ALL: LazyLock<Vec<Example>> = LazyLock::new(|| {
        let files = FOLDER.dirs().flat_map(Dir::files).filter_map(|file| file.path().to_str());
        let scenes = files.filter(|path| path.ends_with(".ron"));
        // They are tested: none is refused.
        scenes.filter_map(|path| Some(Example { path, scene: Scene::from_ron(&linked(path)?).ok()? })).collect()
    });
    &ALL
}

/// The text of the file that a path leads to through [`ROOT`]; none where it leads elsewhere.
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

/// The text of a scene in which files of these folders are named from [`ROOT`] on.
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

/// A path without steps back.
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
    fn every_scene_of_the_folders_is_there_and_reads_as_its_file_does() {
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
