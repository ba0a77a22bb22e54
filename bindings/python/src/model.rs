//! Reduced models.

use crate::tables::shaped;
use crate::work::{long, refused};
use ehl_explorer::engine::arrays::Array;
use ehl_explorer::engine::{self, EngineError, SavedModel, model_arrays, model_file, model_snapshots, model_text};
use ehl_explorer::scene::Scene;
use ehl_explorer::solver::parameters::Quantity;
use ehl_explorer::solver::reduced::ReducedModel;
use ehl_explorer::solver::training::train;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyString};
use std::borrow::Cow;
use std::collections::VecDeque;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// A reduced model: bases, sampled equations, and trained range. It is immutable. Models are equal if their files are
/// equal. They can be pickled; the pickled form is that of :meth:`save`.
#[pyclass(frozen, skip_from_py_object, module = "ehl_explorer")]
#[derive(Clone)]
pub struct Model {
    /// The model.
    pub model: Arc<ReducedModel>,
    /// Name, if it is an embedded model.
    name: Option<&'static str>,
    /// Content of its file, computed when first needed.
    content: OnceLock<Arc<Vec<u8>>>,
}

/// Recently unpickled models. Every task of a pool contains its model, which should be read only once.
static UNPICKLED: Mutex<VecDeque<Model>> = Mutex::new(VecDeque::new());
/// Number of these models that are stored.
const KEPT: usize = 4;

impl Model {
    fn own(model: Arc<ReducedModel>, content: Option<Vec<u8>>) -> Self {
        Self { model, name: None, content: content.map(Arc::new).map(OnceLock::from).unwrap_or_default() }
    }

    fn of_program(py: Python<'_>, name: &str) -> PyResult<Self> {
        let names = || engine::catalogue().iter().map(|entry| entry.name);
        let Some(name) = names().find(|known| *known == name) else {
            let accepted = names().collect::<Vec<_>>().join(", ");
            return Err(refused(format!("the program has no model `{name}`; accepted are {accepted}")));
        };
        let model = py.detach(|| engine::embedded(name)).map_err(refused)?;
        Ok(Self { model, name: Some(name), content: OnceLock::new() })
    }

    /// Returns the content of its file.
    fn content(&self, py: Python<'_>) -> PyResult<&[u8]> {
        let own = || self.content.get().map(|own| &own[..]);
        let of_program = |name| match engine::bytes_of(name) {
            Some(Cow::Borrowed(content)) => Some(content),
            _ => None,
        };
        if let Some(content) = self.name.and_then(of_program).or_else(own) {
            return Ok(content);
        }
        let content = py.detach(|| model_file::to_bytes(&self.model)).map_err(refused)?;
        Ok(self.content.get_or_init(|| Arc::new(content)))
    }
}

/// Returns the model of a file's content or of a name. Used for unpickling.
#[pyfunction]
pub fn _model(py: Python<'_>, kept: &Bound<'_, PyAny>) -> PyResult<Model> {
    if let Ok(content) = kept.cast::<PyBytes>() {
        let content = content.as_bytes();
        // Locked only while Python's global lock is held, so that it is not locked during a fork.
        let kept = || UNPICKLED.lock().unwrap_or_else(PoisonError::into_inner);
        let known = |model: &&Model| model.content.get().is_some_and(|own| own[..] == *content);
        if let Some(model) = kept().iter().find(known) {
            return Ok(model.clone());
        }
        let read = py.detach(|| model_file::from_bytes(content)).map_err(refused)?;
        let model = Model::own(Arc::new(read), Some(content.to_vec()));
        let mut kept = kept();
        kept.truncate(KEPT - 1);
        kept.push_front(model.clone());
        return Ok(model);
    }
    Model::of_program(py, &kept.extract::<String>()?)
}

fn by_name(py: Python<'_>, arrays: Vec<Array>) -> PyResult<Bound<'_, PyDict>> {
    let dict = PyDict::new(py);
    for array in arrays {
        dict.set_item(&array.name, shaped(py, array.values, &array.shape)?)?;
    }
    Ok(dict)
}

/// Returns a scene from its text or from a file.
pub fn scene_of(given: &Bound<'_, PyAny>) -> PyResult<(Scene, PathBuf)> {
    if let Ok(text) = given.extract::<String>()
        && text.contains('(')
    {
        return Ok((Scene::from_ron(&text).map_err(refused)?, PathBuf::new()));
    }
    let path: PathBuf = given.extract()?;
    let scene = Scene::read(&path).map_err(refused)?;
    Ok((scene, path.parent().map(PathBuf::from).unwrap_or_default()))
}

#[pymethods]
impl Model {
    /// Reads a ``.rom`` file. Refuses damaged files and other formats or versions.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let read =
            || SavedModel::read_with_content(&path).and_then(|(read, content)| Ok((read.stationary()?, content)));
        let unusable = |reason| refused(EngineError::Model { path: path.clone(), reason });
        let (model, content) = py.detach(read).map_err(|reason| unusable(reason.into()))?;
        Ok(Self::own(model, Some(content)))
    }

    /// Returns a model of the program by its name, such as ``"line"``, ``"point"`` or ``"line_heat"``. The manual lists
    /// them; another name is refused with all that are accepted.
    #[staticmethod]
    #[pyo3(signature = (name="line"))]
    fn embedded(py: Python<'_>, name: &str) -> PyResult<Self> {
        Self::of_program(py, name)
    }

    /// Trains the model of a scene, given by its text or its file. ``progress(stage, done, total)`` is called
    /// meanwhile; Ctrl-C stops the training. The same scene gives the same model as ``ehl-explorer train``.
    #[staticmethod]
    #[pyo3(signature = (scene, progress=None))]
    fn train(py: Python<'_>, scene: &Bound<'_, PyAny>, progress: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let (read, _) = scene_of(scene)?;
        let none = || EngineError::NoTraining { path: scene.extract().unwrap_or_default() };
        let spec = read.training().ok_or_else(|| refused(none()))?;
        let model = long(py, progress, |watch| train(&spec, watch).map_err(EngineError::from))?;
        Ok(Self::own(Arc::new(model), None))
    }

    /// Writes a ``.rom`` file as a whole or not at all.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        py.detach(|| model_file::write(&self.model, &path)).map_err(refused)
    }

    /// Title.
    #[getter]
    fn title(&self) -> &str {
        &self.model.title
    }

    /// ``"line"`` or ``"point"``.
    #[getter]
    fn contact(&self) -> &'static str {
        self.model.contact().name()
    }

    /// Trained range: (from, to) of ``m``, ``l`` and ``alpha`` [1/Pa], largest ``hertz_pressure`` [Pa], ``viscosity``
    /// [Pa s], and (from, to) of ``radius_ratio`` R_y/R.
    #[getter]
    fn domain<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (domain, dict) = (&self.model.domain, PyDict::new(py));
        for (name, quantity) in [("m", Quantity::M), ("l", Quantity::L), ("alpha", Quantity::Alpha)] {
            dict.set_item(name, domain.interval(quantity))?;
        }
        dict.set_item("radius_ratio", domain.space.radius_ratio())?;
        dict.set_item("hertz_pressure", domain.highest_pressure_pa())?;
        dict.set_item("viscosity", domain.middle_viscosity_pa_s())?;
        Ok(dict)
    }

    /// Returns the contents as arrays by name, as written by ``ehl-explorer info --arrays``.
    fn arrays<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        by_name(py, py.detach(|| model_arrays::of_model(&self.model)))
    }

    /// Solves the training contacts of a local model (numbered from 1) in full again, and returns their fields as
    /// arrays by name, as written by ``ehl-explorer info --arrays FILE --snapshots``. With ``iterates`` also the
    /// pressures of all Newton steps.
    #[pyo3(signature = (window=1, iterates=false, progress=None))]
    fn snapshots<'py>(
        &self,
        py: Python<'py>,
        window: usize,
        iterates: bool,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let arrays = long(py, progress, |watch| model_snapshots::solve(&self.model, window, iterates, watch))?;
        by_name(py, arrays)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyAny>,))> {
        let kept = match self.name {
            Some(name) => PyString::new(py, name).into_any(),
            None => PyBytes::new(py, self.content(py)?).into_any(),
        };
        Ok((py.import("ehl_explorer._native")?.getattr("_model")?, (kept,)))
    }

    fn __copy__(own: Py<Self>) -> Py<Self> {
        own
    }

    fn __deepcopy__(own: Py<Self>, _memo: &Bound<'_, PyAny>) -> Py<Self> {
        own
    }

    fn __eq__(&self, py: Python<'_>, other: &Self) -> PyResult<bool> {
        if Arc::ptr_eq(&self.model, &other.model) {
            return Ok(true);
        }
        let (own, others) = (&self.model, &other.model);
        let alike = own.title == others.title && own.domain == others.domain && own.scene == others.scene;
        Ok(alike && self.content(py)? == other.content(py)?)
    }

    fn __hash__(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        (&self.model.title, &self.model.scene).hash(&mut hasher);
        hasher.finish()
    }

    /// Returns the description printed by ``ehl-explorer info``.
    fn __str__(&self) -> String {
        model_text::describe(&self.model)
    }

    fn __repr__(&self) -> String {
        format!("Model({:?}, {})", self.model.title, self.model.contact().name())
    }
}
