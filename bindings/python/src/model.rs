//! Reduced models.

use crate::tables::shaped;
use crate::work::{long, refused};
use ehl_explorer::engine::{self, EngineError, model_arrays, model_file, model_text};
use ehl_explorer::scene::Scene;
use ehl_explorer::solver::parameters::Quantity;
use ehl_explorer::solver::physics::contact::ContactKind;
use ehl_explorer::solver::reduced::ReducedModel;
use ehl_explorer::solver::training::train;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::Arc;

/// A reduced model: bases, sampled rows, and the range for which it was trained. It never changes.
#[pyclass(frozen, module = "ehl_explorer")]
pub struct Model(pub Arc<ReducedModel>);

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
        let read = py.detach(|| model_file::read(&path));
        let unusable = |reason| refused(EngineError::Model { path: path.clone(), reason });
        Ok(Self(Arc::new(read.map_err(|reason| unusable(reason.into()))?)))
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
        Ok(Self(py.detach(|| engine::embedded(name)).map_err(refused)?))
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
        Ok(Self(Arc::new(model)))
    }

    /// Writes it as a ``.rom`` file, whole or not at all.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        py.detach(|| model_file::write(&self.0, &path)).map_err(refused)
    }

    /// Its title.
    #[getter]
    fn title(&self) -> &str {
        &self.0.title
    }

    /// ``"line"`` or ``"point"``.
    #[getter]
    fn contact(&self) -> &'static str {
        self.0.contact().name()
    }

    /// The range for which it was trained: (from, to) of ``m``, ``l`` and ``alpha`` [1/Pa], the largest
    /// ``hertz_pressure`` [Pa], the ``viscosity`` [Pa s], and (from, to) of ``radius_ratio`` R_y/R.
    #[getter]
    fn domain<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (domain, dict) = (&self.0.domain, PyDict::new(py));
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
        let dict = PyDict::new(py);
        for array in py.detach(|| model_arrays::of_model(&self.0)) {
            dict.set_item(&array.name, shaped(py, array.values, &array.shape)?)?;
        }
        Ok(dict)
    }

    /// The same as text, as ``ehl-explorer info`` prints it.
    fn __str__(&self) -> String {
        model_text::describe(&self.0)
    }

    fn __repr__(&self) -> String {
        format!("Model({:?}, {})", self.0.title, self.0.contact().name())
    }
}
