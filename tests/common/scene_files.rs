//! The scenes of the repository, which lie in folders by subject, each under a name of its own.

use ehl_explorer::engine::results::{SceneFile, scenes_below};
use ehl_explorer::engine::{SceneOutcome, Store, Workbench, run_scene};
use ehl_explorer::scene::Scene;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, LazyLock, Mutex, OnceLock};

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

/// Runs a scene of the repository, or what has been made of it. Grids, solvers and models are shared by all tests of a
/// program, as `run --all` shares them.
pub fn run(name: &str, scene: &Scene) -> SceneOutcome {
    static STORE: LazyLock<Store> = LazyLock::new(Store::default);
    run_scene(scene, &mut Workbench::on(&STORE, path(name).parent().unwrap()), &())
        .unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The outcome of a scene of the repository as it is, run once for all tests of a program.
pub fn outcome(name: &str) -> Arc<SceneOutcome> {
    static OUTCOMES: Mutex<BTreeMap<String, Arc<OnceLock<Arc<SceneOutcome>>>>> = Mutex::new(BTreeMap::new());
    let once = Arc::clone(OUTCOMES.lock().unwrap().entry(name.to_owned()).or_default());
    Arc::clone(once.get_or_init(|| Arc::new(run(name, &read(name)))))
}
