//! Scenes of the repository: in folders by subject, each with a unique name.

use ehl_explorer::engine::results::{SceneFile, scenes_below};
use ehl_explorer::engine::{SceneOutcome, Store, Workbench, run_scene};
use ehl_explorer::scene::Scene;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, LazyLock, Mutex, OnceLock};

/// Returns all scenes, by folder and name.
pub fn all() -> Vec<SceneFile> {
    scenes_below(&Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes")).unwrap_or_else(|error| panic!("{error}"))
}

/// Returns the name of a scene: that of its file, without folder and extension.
pub fn name(path: &Path) -> String {
    path.file_stem().unwrap().to_string_lossy().into_owned()
}

/// Returns the path of the scene with this name.
pub fn path(wanted: &str) -> PathBuf {
    let found = all().into_iter().find(|file| name(&file.path) == wanted);
    found.unwrap_or_else(|| panic!("no scene {wanted}")).path
}

/// Returns the scene with this name.
pub fn read(name: &str) -> Scene {
    Scene::read(&path(name)).unwrap_or_else(|error| panic!("{error}"))
}

/// Runs a scene of the repository, possibly changed. All tests of a program share grids, solvers and models, as
/// `run --all` does.
pub fn run(name: &str, scene: &Scene) -> SceneOutcome {
    static STORE: LazyLock<Store> = LazyLock::new(Store::default);
    run_scene(scene, &mut Workbench::on(&STORE, path(name).parent().unwrap()), &())
        .unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// Returns the outcome of an unchanged scene of the repository, which runs once for all tests of a program.
pub fn outcome(name: &str) -> Arc<SceneOutcome> {
    static OUTCOMES: Mutex<BTreeMap<String, Arc<OnceLock<Arc<SceneOutcome>>>>> = Mutex::new(BTreeMap::new());
    let once = Arc::clone(OUTCOMES.lock().unwrap().entry(name.to_owned()).or_default());
    Arc::clone(once.get_or_init(|| Arc::new(run(name, &read(name)))))
}
