//! A contact: what is to be solved, in the words of the command line.

use crate::STORE;
use crate::model::Model;
use crate::work::refused;
use ehl_explorer::cli::{MethodName, PointOptions};
use ehl_explorer::engine::Workbench;
use ehl_explorer::scene::{CaseTable, Grid, Request, Scene};
use ehl_explorer::solver::physics::contact::ContactKind;
use ehl_explorer::solver::reduced::ReducedModel;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyString};
use std::path::PathBuf;
use std::sync::Arc;

/// A contact, given by the options of ``ehl-explorer solve`` with ``_`` in place of ``-``.
///
/// ``Contact(moes_m=40, moes_l=10)``, ``Contact(radius=0.0225, speed=5.04, load=646e3, modulus=287.8e9,
/// viscosity=4e-3, alpha=22e-9)``; numbers in SI units, ``contact="point"`` for balls and ellipses. It is checked as it is
/// made and never changes.
#[pyclass(frozen, module = "ehl_explorer")]
pub struct Contact {
    /// The options.
    pub options: PointOptions,
    /// What they ask for.
    pub request: Request,
    words: String,
}

/// `--name=value` of a Python value; none where it says nothing.
fn word(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Option<String>> {
    let name = name.replace('_', "-");
    if value.is_none() {
        return Ok(None);
    }
    if let Ok(flag) = value.cast::<PyBool>() {
        return Ok(flag.is_true().then(|| format!("--{name}")));
    }
    if value.is_instance_of::<PyString>() {
        return Ok(Some(format!("--{name}={}", value.extract::<String>()?)));
    }
    if let Ok(number) = value.extract::<f64>() {
        return Ok(Some(format!("--{name}={number:?}")));
    }
    if let Ok(numbers) = value.extract::<Vec<f64>>() {
        let numbers: Vec<String> = numbers.iter().map(|number| format!("{number:?}")).collect();
        return Ok(Some(format!("--{name}={}", numbers.join(","))));
    }
    if let Ok(path) = value.extract::<PathBuf>() {
        return Ok(Some(format!("--{name}={}", path.display())));
    }
    Err(PyTypeError::new_err(format!("{name} must be a number, a text, a truth or some numbers")))
}

impl Contact {
    fn of_words(words: Vec<String>) -> PyResult<Self> {
        let shown = words.iter().map(|word| word.trim_start_matches('-')).collect::<Vec<_>>().join(", ");
        let options = PointOptions::from_words(words).map_err(refused)?;
        let request = options.request().map_err(refused)?;
        Ok(Self { options, request, words: shown })
    }

    fn from_dict(given: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let mut words = Vec::new();
        for (name, value) in given.into_iter().flatten() {
            words.extend(word(&name.extract::<String>()?, &value)?);
        }
        Self::of_words(words)
    }

    /// The options with the method and the model that a call asks for: one in memory, or a file's name.
    pub fn asked(&self, method: Option<&str>, model: Option<&Bound<'_, PyAny>>) -> PyResult<Asked> {
        let mut options = self.options.clone();
        let method = method.or(model.map(|_| "reduced"));
        options.method = match method {
            None => options.method,
            Some("full") => MethodName::Full,
            Some("reduced") => MethodName::Reduced,
            Some(word) => return Err(refused(format!("`{word}` is no method; accepted are full, reduced"))),
        };
        let model = match model.map(|model| model.cast::<Model>().map_err(|_| model)) {
            None => None,
            Some(Ok(model)) => Some(Arc::clone(&model.get().0)),
            Some(Err(path)) => {
                options.rom = Some(path.extract()?);
                None
            }
        };
        Ok(Asked { options, model })
    }
}

/// What a call asks for.
pub struct Asked {
    /// The contact and its method.
    pub options: PointOptions,
    /// A model in memory.
    pub model: Option<Arc<ReducedModel>>,
}

impl Asked {
    /// What is solved on.
    pub fn bench(&self) -> Workbench {
        bench_with(self.model.as_ref())
    }
}

/// What is solved on, with a model in memory in place of those of the program.
pub fn bench_with(model: Option<&Arc<ReducedModel>>) -> Workbench {
    let bench = Workbench::on(&STORE, "");
    match model {
        Some(model) => bench.with_model(model),
        None => bench,
    }
}

#[pymethods]
impl Contact {
    #[new]
    #[pyo3(signature = (**options))]
    fn new(options: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        Self::from_dict(options)
    }

    /// A contact in SI units: R [m], u_m [m/s], load [N/m line, N point], E' [Pa], viscosity [Pa s], alpha [1/Pa].
    #[staticmethod]
    #[pyo3(signature = (radius, speed, load, modulus=None, viscosity=None, alpha=None, **options))]
    fn si(
        radius: f64,
        speed: f64,
        load: f64,
        modulus: Option<f64>,
        viscosity: Option<f64>,
        alpha: Option<f64>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let given = [
            ("radius", Some(radius)),
            ("speed", Some(speed)),
            ("load", Some(load)),
            ("modulus", modulus),
            ("viscosity", viscosity),
            ("alpha", alpha),
        ];
        Self::with_numbers(&given, options)
    }

    /// A contact by Moes' numbers M and L; what is given besides is kept, the rest takes its default.
    #[staticmethod]
    #[pyo3(signature = (m, l, **options))]
    fn moes(m: f64, l: f64, options: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        Self::with_numbers(&[("moes-m", Some(m)), ("moes-l", Some(l))], options)
    }

    /// A contact as engineers write it, each quantity a number in SI units or a text with its unit: the columns of a
    /// table of load cases, as ``Contact.engineering(radius="12 mm", speed="3 m/s", load="300 N/mm", modulus="231 GPa",
    /// oil="ISO VG 68", temperature="60 °C", srr="5 %")``.
    #[staticmethod]
    #[pyo3(signature = (contact="line", **quantities))]
    fn engineering(contact: &str, quantities: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let (mut titles, mut cells) = (vec!["contact".to_owned()], vec![contact.to_owned()]);
        for (name, value) in quantities.into_iter().flatten() {
            titles.push(name.extract::<String>()?.replace('_', "-"));
            let cell = value.extract::<f64>().map(|number| format!("{number:?}"));
            cells.push(cell.or_else(|_| value.extract::<String>())?);
        }
        let quoted = |cells: &[String]| {
            cells.iter().map(|cell| format!("\"{}\"", cell.replace('"', "\"\""))).collect::<Vec<_>>().join("\t")
        };
        let table = CaseTable::Text(format!("{}\n{}\n", quoted(&titles), quoted(&cells)));
        let experiment = Scene { grid: Grid::Usual, ..Scene::at_moes(40.0, 10.0) }.experiment();
        let cases = table.cases(&experiment, &|path| path.to_owned()).map_err(refused)?;
        let case = cases.into_iter().next().ok_or_else(|| refused("no contact is given"))?;
        let request = case.request.map_err(refused)?;
        let named = titles.iter().zip(&cells).find(|(title, _)| title.as_str() == "lubricant");
        Self::of_words(words_of(&request, named.map(|(_, name)| name.as_str())))
    }

    /// Load number M.
    #[getter]
    fn m(&self) -> f64 {
        self.request.point.moes().m
    }

    /// Lubricant number L.
    #[getter]
    fn l(&self) -> f64 {
        self.request.point.moes().l
    }

    /// Half width a of the dry contact [m].
    #[getter]
    fn hertz_half_width(&self) -> f64 {
        self.request.point.hertz().half_width_m
    }

    /// Largest pressure p_H of the dry contact [Pa].
    #[getter]
    fn hertz_pressure(&self) -> f64 {
        self.request.point.hertz().pressure_pa
    }

    /// ``"line"`` or ``"point"``.
    #[getter]
    fn contact(&self) -> &'static str {
        self.request.point.kind.name()
    }

    /// Radius R [m], speed u_m [m/s], load [N/m or N], modulus E' [Pa], viscosity [Pa s], alpha [1/Pa] and the
    /// slide-to-roll ratio, by name; of a point contact ``radius_y`` too.
    fn quantities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (point, dict) = (&self.request.point, PyDict::new(py));
        let names = ["radius", "speed", "load", "modulus", "viscosity", "alpha"];
        for (name, value) in names.into_iter().zip(point.quantities()) {
            dict.set_item(name, value)?;
        }
        if point.kind == ContactKind::Point {
            dict.set_item("radius_y", point.radius_y_m.unwrap_or(point.radius_m))?;
        }
        dict.set_item("srr", point.sliding.slide_to_roll_ratio)?;
        Ok(dict)
    }

    fn __repr__(&self) -> String {
        format!("Contact({})", self.words)
    }
}

impl Contact {
    fn with_numbers(given: &[(&str, Option<f64>)], options: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let mut words: Vec<String> =
            given.iter().filter_map(|(name, value)| value.map(|value| format!("--{name}={value:?}"))).collect();
        for (name, value) in options.into_iter().flatten() {
            words.extend(word(&name.extract::<String>()?, &value)?);
        }
        Self::of_words(words)
    }
}

/// The words of a contact that is known by its quantities, and by the name of its lubricant where it has one.
fn words_of(request: &Request, lubricant: Option<&str>) -> Vec<String> {
    let Request { point, lubricant: laws, .. } = request;
    let mut words = vec![format!("--contact={}", point.kind.name())];
    let names = ["radius", "speed", "load", "modulus", "viscosity", "alpha"];
    let own_alpha = laws.own_coefficient().is_some();
    let given = names.into_iter().zip(point.quantities()).filter(|(name, _)| *name != "alpha" || !own_alpha);
    words.extend(given.map(|(name, value)| format!("--{name}={value:?}")));
    words.extend(point.radius_y_m.map(|radius| format!("--radius-y={radius:?}")));
    words.push(format!("--srr={:?}", point.sliding.slide_to_roll_ratio));
    words.extend(point.sliding.newtonian_plateau_ratio.map(|npr| format!("--npr={npr:?}")));
    words.extend(lubricant.filter(|name| !name.is_empty()).map(|name| format!("--lubricant={name}")));
    words
}
