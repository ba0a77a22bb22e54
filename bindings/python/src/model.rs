//! Reduced models.

use crate::tables::shaped;
use crate::work::{long, refused};
use ehl_explorer::engine::arrays::Array;
use ehl_explorer::engine::{self, EngineError, SavedModel, model_arrays, model_file, model_snapshots, model_text};
use ehl_explorer::scene::Scene;
use ehl_explorer::solver::parameters::Quantity;
use ehl_explorer::solver::physics::contact::ContactKind;
use ehl_explorer::solver::reduced::ReducedModel;
use ehl_explorer::solver::training::train;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyString};
use std::borrow::Cow;
use std::collections::VecDeque;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// A reduced model: bases, sampled rows, and the range for which it was trained. It never changes. Models are equal if
/// their files are; they can be pickled, as what :meth:`save` writes.
#[pyclass(frozen, skip_from_py_object, module = "ehl_explorer")]
#[derive(Clone)]
pub struct Model {
    /// The model.
    pub model: Arc<ReducedModel>,
    /// Its name, if it is part of the program.
    name: Option<&'static str>,
    /// The content of its file, made when first needed.
    content: OnceLock<Arc<Vec<u8>>>,
}

/// Models that were unpickled last: every task of a pool brings its model along.
static UNPICKLED: Mutex<VecDeque<Model>> = Mutex::new(VecDeque::new());
/// How many of them are kept.
const KEPT: usize = 4;

impl Model {
    fn own(model: Arc<ReducedModel>, content: Option<Vec<u8>>) -> Self {
        Self { model, name: None, content: content.map(Arc::new).map(OnceLock::from).unwrap_or_default() }
    }

    fn of_program(py: Python<'_>, name: &'static str) -> PyResult<Self> {
        let model = py.detach(|| engine::embedded(name)).map_err(refused)?;
        Ok(Self { model, name: Some(name), content: OnceLock::new() })
    }

    /// The content of its file.
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

/// The model of the content of a file, or of a name: what a pickled one is made of.
#[pyfunction]
pub fn _model(py: Python<'_>, kept: &Bound<'_, PyAny>) -> PyResult<Model> {
    if let Ok(content) = kept.cast::<PyBytes>() {
        let content = content.as_bytes();
        // Held under Python's lock only, as a fork finds it open.
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
    let name: String = kept.extract()?;
    let known = engine::catalogue().iter().find(|entry| entry.name == name);
    Model::of_program(py, known.ok_or_else(|| refused(format!("the program has no model `{name}`")))?.name)
}

fn by_name(py: Python<'_>, arrays: Vec<Array>) -> PyResult<Bound<'_, PyDict>> {
    let dict = PyDict::new(py);
    for array in arrays {
        dict.set_item(&array.name, shaped(py, array.values, &array.shape)?)?;
    }
    Ok(dict)
}

/// A scene from its text, or from the file of a name.
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
    /// Reads a ``.rom`` file; a damaged, foreign or newer one is refused.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let read =
            || SavedModel::read_with_content(&path).and_then(|(read, content)| Ok((read.stationary()?, content)));
        let unusable = |reason| refused(EngineError::Model { path: path.clone(), reason });
        let (model, content) = py.detach(read).map_err(|reason| unusable(reason.into()))?;
        Ok(Self::own(model, Some(content)))
    }

    /// A model of the program: for ``"line"`` or ``"point"`` contacts (circles), of lubricants that thin under shear or
    /// not; of those that do not also with heat.
    #[staticmethod]
    #[pyo3(signature = (contact="line", thinning=false, heat=false))]
    fn embedded(py: Python<'_>, contact: &str, thinning: bool, heat: bool) -> PyResult<Self> {
        let kind = match contact {
            "line" => ContactKind::Line,
            "point" => ContactKind::Point,
            _ => return Err(refused(format!("`{contact}` is no contact; accepted are line, point"))),
        };
        let name = match (kind, thinning, heat) {
            (ContactKind::Line, false, false) => "line",
            (ContactKind::Line, true, false) => "line_shear",
            (ContactKind::Point, false, false) => "point",
            (ContactKind::Point, true, false) => "point_shear",
            (ContactKind::Line, false, true) => "line_heat",
            (ContactKind::Point, false, true) => "point_heat",
            (_, true, true) => return Err(refused("heat is known to the models without thinning only".to_owned())),
        };
        Self::of_program(py, name)
    }

    /// Trains a model as a scene describes, given by its text or its file; ``progress(stage, done, total)`` is called
    /// meanwhile, Ctrl-C stops it. The same scene gives the same model as ``ehl-explorer train``.
    #[staticmethod]
    #[pyo3(signature = (scene, progress=None))]
    fn train(py: Python<'_>, scene: &Bound<'_, PyAny>, progress: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let (read, _) = scene_of(scene)?;
        let none = || EngineError::NoTraining { path: scene.extract().unwrap_or_default() };
        let spec = read.training().ok_or_else(|| refused(none()))?;
        let model = long(py, progress, |watch| train(&spec, watch).map_err(EngineError::from))?;
        Ok(Self::own(Arc::new(model), None))
    }

    /// Writes it as a ``.rom`` file, whole or not at all.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        py.detach(|| model_file::write(&self.model, &path)).map_err(refused)
    }

    /// Its title.
    #[getter]
    fn title(&self) -> &str {
        &self.model.title
    }

    /// ``"line"`` or ``"point"``.
    #[getter]
    fn contact(&self) -> &'static str {
        self.model.contact().name()
    }

    /// The range for which it was trained: (from, to) of ``m``, ``l`` and ``alpha`` [1/Pa], the largest
    /// ``hertz_pressure`` [Pa], the ``viscosity`` [Pa s], and (from, to) of ``radius_ratio`` R_y/R.
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

    /// What it is made of, as arrays by name: those of ``ehl-explorer info --arrays``.
    fn arrays<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        by_name(py, py.detach(|| model_arrays::of_model(&self.model)))
    }

    /// The training contacts of a local model (from 1), solved again in full: their fields as arrays by name, those that
    /// ``ehl-explorer info --arrays FILE --snapshots`` writes. With ``iterates`` also the pressures of all Newton steps.
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

    /// The same as text, as ``ehl-explorer info`` prints it.
    fn __str__(&self) -> String {
        model_text::describe(&self.model)
    }

    fn __repr__(&self) -> String {
        format!("Model({:?}, {})", self.model.title, self.model.contact().name())
    }
}
