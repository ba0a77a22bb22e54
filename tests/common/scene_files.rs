//! The scenes of the repository, which lie in folders by subject, each under a name of its own.

use ehl_explorer::engine::results::{SceneFile, scenes_below};
use ehl_explorer::engine::{SceneOutcome, Workbench, run_scene};
use ehl_explorer::scene::Scene;
use std::path::{Path, PathBuf};

/// All scenes, by folder and name.
pub fn all() -> Vec<SceneFile> {
    scenes_below(&Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes")).unwrap_or_else(|error| panic!("{error}"))
}

/// The name of a scene: its file's, without folder and extension.
pub fn name(path: &Path) -> String {
    path.file_stem().unwrap().to_string_lossy().into_owned()
}

/// The path of the scene of a name.
pub fn path(wanted: &str) -> PathBuf {
    let found = all().into_iter().find(|file| name(&file.path) == wanted);
    found.unwrap_or_else(|| panic!("no scene {wanted}")).path
}

/// The scene of a name.
pub fn read(name: &str) -> Scene {
    Scene::read(&path(name)).unwrap_or_else(|error| panic!("{error}"))
}

/// Runs a scene of the repository, or what has been made of it.
pub fn run(name: &str, scene: &Scene) -> SceneOutcome {
    run_scene(scene, &mut Workbench::new(path(name).parent().unwrap()), &())
        .unwrap_or_else(|error| panic!("{name}: {error}"))
}
