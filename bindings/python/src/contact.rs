//! A contact: what is to be solved, by keywords.

use crate::STORE;
use crate::model::Model;
use crate::work::{refused, stated};
use ehl_explorer::engine::Workbench;
use ehl_explorer::scene::{ContactSpec, Field, MethodName, Request, Words};
use ehl_explorer::solver::physics::contact::ContactKind;
use ehl_explorer::solver::reduced::ReducedModel;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyString};
use std::path::PathBuf;
use std::sync::Arc;

/// A contact, given by the options of ``ehl-explorer solve`` with ``_`` in place of ``-``, an ``oil`` of a grade at a
/// ``temperature`` besides.
///
/// ``Contact(moes_m=40, moes_l=10)``, ``Contact(radius=0.0225, speed=5.04, load=646e3, modulus=287.8e9,
/// viscosity=4e-3, alpha=22e-9)``; numbers in SI units, or texts with a unit as ``radius="12 mm"``; ``contact="point"`` for
/// balls and ellipses. It is checked as it is made and never changes.
#[pyclass(frozen, module = "ehl_explorer")]
pub struct Contact {
    /// What was stated.
    pub spec: ContactSpec,
    /// What that asks for.
    pub request: Request,
    words: Vec<String>,
}

/// States a field by a Python value.
fn state(spec: &mut ContactSpec, field: Field, value: &Bound<'_, PyAny>) -> PyResult<()> {
    let text = if let Ok(truth) = value.cast::<PyBool>() {
        truth.is_true().to_string()
    } else if value.is_instance_of::<PyString>() {
        value.extract::<String>()?
    } else if let Ok(number) = value.extract::<f64>() {
        if field.is_number() {
            spec.set(field, number);
            return Ok(());
        }
        number.to_string()
    } else if let Ok(numbers) = value.extract::<Vec<f64>>() {
        numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(",")
    } else if let Ok(path) = value.extract::<PathBuf>() {
        path.to_string_lossy().into_owned()
    } else {
        let sentence = format!("{} must be a number, a text, a truth or some numbers", Words::Keywords.of(field));
        return Err(PyTypeError::new_err(sentence));
    };
    spec.read(field, &text, "").map_err(|refusal| refused(stated(refusal)))
}

impl Contact {
    /// The contact of some fields and of keywords, whose fields `field_of` finds.
    fn of(
        mut spec: ContactSpec,
        keywords: Option<&Bound<'_, PyDict>>,
        field_of: fn(&str) -> Option<Field>,
    ) -> PyResult<Self> {
        let mut given = Vec::new();
        for (name, value) in keywords.into_iter().flatten().filter(|(_, value)| !value.is_none()) {
            let name: String = name.extract()?;
            let field = field_of(&name).ok_or_else(|| {
                let accepted: Vec<_> = Field::of(Words::Keywords).map(|field| field.facts().name).collect();
                refused(format!(
                    "{name}= is no keyword of a contact; accepted are {}",
                    accepted.join(", ").replace('-', "_")
                ))
            })?;
            given.push((field, value));
        }
        // The unit of a load depends on the kind of contact, which is the first field.
        given.sort_by_key(|(field, _)| *field);
        given.iter().try_for_each(|(field, value)| state(&mut spec, *field, value))?;
        let request = spec.request().map_err(|refusal| refused(stated(refusal)))?;
        let mut words = Vec::new();
        for &field in Field::ALL {
            let word = Words::Keywords.of(field);
            match (spec.number(field), given.iter().find(|(other, _)| *other == field)) {
                (Some(number), _) => words.push(format!("{word}{number:?}")),
                (None, Some((_, value))) => words.push(format!("{}={}", field.facts().name, value.repr()?)),
                (None, None) => {}
            }
        }
        Ok(Self { spec, request, words })
    }

    /// What a call asks for by its method and its model: one in memory, or a file's name.
    pub fn asked(&self, method: Option<&str>, model: Option<&Bound<'_, PyAny>>) -> PyResult<Asked> {
        let mut spec = self.spec.clone();
        let method = method.or(model.map(|_| "reduced"));
        spec.method = match method {
            None => spec.method,
            Some("full") => Some(MethodName::Full),
            Some("reduced") => Some(MethodName::Reduced),
            Some(word) => return Err(refused(format!("`{word}` is no method; accepted are full, reduced"))),
        };
        let model = match model.map(|model| model.cast::<Model>().map_err(|_| model)) {
            None => None,
            Some(Ok(model)) => Some(Arc::clone(&model.get().0)),
            Some(Err(path)) => {
                spec.rom = Some(path.extract()?);
                None
            }
        };
        Ok(Asked { spec, model })
    }
}

/// What a call asks for.
pub struct Asked {
    /// The contact and its method.
    pub spec: ContactSpec,
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
        Self::of(ContactSpec::default(), options, Field::named)
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
        let (radius, speed, load) = (Some(radius), Some(speed), Some(load));
        let spec = ContactSpec { radius, speed, load, modulus, viscosity, alpha, ..ContactSpec::default() };
        Self::of(spec, options, Field::named)
    }

    /// A contact by Moes' numbers M and L; what is given besides is kept, the rest takes its default.
    #[staticmethod]
    #[pyo3(signature = (m, l, **options))]
    fn moes(m: f64, l: f64, options: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let spec = ContactSpec { moes_m: Some(m), moes_l: Some(l), ..ContactSpec::default() };
        Self::of(spec, options, Field::named)
    }

    /// A contact by the columns of a table of load cases, as
    /// ``Contact.engineering(radius="12 mm", speed="3 m/s", load="300 N/mm", modulus="231 GPa", oil="ISO VG 68",
    /// temperature="60 °C", srr="5 %")``.
    #[staticmethod]
    #[pyo3(signature = (contact="line", **quantities))]
    fn engineering(contact: &str, quantities: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let mut spec = ContactSpec::default();
        spec.read(Field::Contact, contact, "").map_err(|refusal| refused(stated(refusal)))?;
        Self::of(spec, quantities, Field::titled)
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
        format!("Contact({})", self.words.join(", "))
    }
}
