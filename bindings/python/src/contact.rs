//! Contact defined by keywords.

use crate::STORE;
use crate::model::Model;
use crate::work::{refused, stated};
use ehl_explorer::engine::Workbench;
use ehl_explorer::scene::{ContactSpec, Field, MethodName, Request, Words};
use ehl_explorer::solver::full::Problem;
use ehl_explorer::solver::reduced::ReducedModel;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyString, PyTuple};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::PathBuf;
use std::sync::Arc;

/// A contact, given by the options of ``ehl-explorer solve`` with ``_`` in place of ``-``, or by an ``oil`` grade and
/// its ``temperature`` in place of viscosity and alpha.
///
/// ``Contact(moes_m=40, moes_l=10)``, ``Contact(radius=0.0225, speed=5.04, load=646e3, modulus=287.8e9, viscosity=4e-3,
/// alpha=22e-9)``. Numbers are in SI units, but the temperature of an oil is in °C; texts may have a unit, as in
/// ``radius="12 mm"``. Use ``contact="point"`` for circular and elliptical contacts. The contact is checked when it is
/// created, and is immutable. Contacts are equal if their requests are. They can be pickled and used as dictionary keys.
#[pyclass(frozen, module = "ehl_explorer")]
pub struct Contact {
    /// Stated fields.
    pub spec: ContactSpec,
    /// Request that they define.
    pub request: Request,
    /// Keywords with their values, in the order of the fields.
    given: Vec<(Field, Py<PyAny>)>,
}

/// Field with its stated value.
type Given<'py> = (Field, Bound<'py, PyAny>);

/// Sets a field to a Python value.
fn state(spec: &mut ContactSpec, field: Field, value: &Bound<'_, PyAny>) -> PyResult<()> {
    let text = if let Ok(truth) = value.cast::<PyBool>() {
        truth.is_true().to_string()
    } else if value.is_instance_of::<PyString>() {
        value.extract::<String>()?
    } else if let Ok(number) = value.extract::<f64>() {
        if field.is_number() {
            spec.set_as_typed(field, number);
            return Ok(());
        }
        number.to_string()
    } else if let Ok(numbers) = value.extract::<Vec<f64>>() {
        numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(",")
    } else if let Ok(path) = value.extract::<PathBuf>() {
        path.to_string_lossy().into_owned()
    } else {
        let sentence =
            format!("{} must be a number, a text, a Boolean or a sequence of numbers", Words::Keywords.of(field));
        return Err(PyTypeError::new_err(sentence));
    };
    spec.read(field, &text, "").map_err(|refusal| refused(stated(refusal)))
}

/// Converts keywords to fields by `field_of`. `None` leaves a field unset.
fn stated_fields<'py>(
    keywords: Option<&Bound<'py, PyDict>>,
    field_of: fn(&str) -> Option<Field>,
) -> PyResult<Vec<Given<'py>>> {
    let field = |(name, value): (Bound<'py, PyAny>, Bound<'py, PyAny>)| {
        let name: String = name.extract()?;
        let field = field_of(&name).ok_or_else(|| {
            let accepted = Field::of(Words::Keywords).map(Field::keyword).collect::<Vec<_>>().join(", ");
            refused(format!("{name}= is no keyword of a contact; accepted are {accepted}"))
        })?;
        Ok((field, value))
    };
    keywords.into_iter().flatten().map(field).collect()
}

/// Returns an immutable copy of a value: lists and arrays become tuples of Python numbers.
fn unchangeable<'py>(field: Field, value: Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    if value.is_instance_of::<PyString>() || value.is_instance_of::<PyBool>() || value.is_instance_of::<PyTuple>() {
        return Ok(value);
    }
    if let Some(number) = value.extract::<f64>().ok().filter(|_| field.is_number()) {
        return Ok(PyFloat::new(value.py(), number).into_any());
    }
    match value.extract::<Vec<f64>>() {
        Ok(numbers) => Ok(PyTuple::new(value.py(), numbers)?.into_any()),
        Err(_) => Ok(value),
    }
}

impl Contact {
    /// Returns the contact of some fields. A later value of the same field replaces an earlier one.
    fn of(fields: Vec<Given<'_>>) -> PyResult<Self> {
        let mut given: Vec<Given<'_>> = Vec::with_capacity(fields.len());
        for (field, value) in fields {
            given.retain(|(other, _)| *other != field);
            if !value.is_none() {
                given.push((field, unchangeable(field, value)?));
            }
        }
        given.sort_by_key(|(field, _)| field.reading_order());
        let mut spec = ContactSpec::default();
        given.iter().try_for_each(|(field, value)| state(&mut spec, *field, value))?;
        for (field, _) in &given {
            // Removes the sign of zero, so that equal contacts have equal hashes.
            if spec.number(*field) == Some(0.0) {
                spec.set(*field, 0.0);
            }
        }
        let request = spec.request().map_err(|refusal| refused(stated(refusal)))?;
        Problem::new(&request.point, request.lubricant).map_err(refused)?;
        let given = given.into_iter().map(|(field, value)| (field, value.unbind())).collect();
        Ok(Self { spec, request, given })
    }

    /// Returns the contact of some numbers and of keywords, which replace the numbers.
    fn of_numbers(
        py: Python<'_>,
        numbers: impl IntoIterator<Item = (Field, Option<f64>)>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let number = |(field, number): (Field, Option<f64>)| Some((field, PyFloat::new(py, number?).into_any()));
        let mut fields: Vec<Given<'_>> = numbers.into_iter().filter_map(number).collect();
        fields.extend(stated_fields(options, Field::named)?);
        Self::of(fields)
    }

    fn fields<'py>(&self, py: Python<'py>) -> Vec<Given<'py>> {
        self.given.iter().map(|(field, value)| (*field, value.bind(py).clone())).collect()
    }

    /// Returns the request of a call with its method and model: a model in memory, or a file name.
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
            Some(Ok(model)) => Some(Arc::clone(&model.get().model)),
            Some(Err(path)) => {
                spec.rom = Some(path.extract()?);
                None
            }
        };
        Ok(Asked { spec, model })
    }
}

/// Request of a call.
pub struct Asked {
    /// Contact and method.
    pub spec: ContactSpec,
    /// Model in memory, if given.
    pub model: Option<Arc<ReducedModel>>,
}

impl Asked {
    /// Returns the workbench for the request.
    pub fn bench(&self) -> Workbench {
        bench_with(self.model.as_ref())
    }
}

/// Returns a workbench, with a model in memory in place of the embedded models if given.
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
        Self::of(stated_fields(options, Field::named)?)
    }

    /// Creates a contact in SI units: R [m], u_m [m/s], load [N/m line, N point], E' [Pa], viscosity [Pa s], alpha
    /// [1/Pa].
    #[staticmethod]
    #[pyo3(signature = (radius, speed, load, modulus=None, viscosity=None, alpha=None, **options))]
    #[expect(clippy::too_many_arguments, reason = "they have names in Python")]
    fn si(
        py: Python<'_>,
        radius: f64,
        speed: f64,
        load: f64,
        modulus: Option<f64>,
        viscosity: Option<f64>,
        alpha: Option<f64>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let numbers = [
            (Field::Radius, Some(radius)),
            (Field::Speed, Some(speed)),
            (Field::Load, Some(load)),
            (Field::Modulus, modulus),
            (Field::Viscosity, viscosity),
            (Field::Alpha, alpha),
        ];
        Self::of_numbers(py, numbers, options)
    }

    /// Creates a contact by Moes numbers M and L. Other quantities that are given keep their values; the rest follows
    /// or takes default values.
    #[staticmethod]
    #[pyo3(signature = (m, l, **options))]
    fn moes(py: Python<'_>, m: f64, l: f64, options: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        Self::of_numbers(py, [(Field::MoesM, Some(m)), (Field::MoesL, Some(l))], options)
    }

    /// Creates a contact by the columns of a table of load cases, as in ``Contact.engineering(radius="12 mm", speed="3
    /// m/s", load="300 N/mm", modulus="231 GPa", oil="ISO VG 68", temperature="60 °C", srr="5 %")``.
    #[staticmethod]
    #[pyo3(signature = (contact="line", **quantities))]
    fn engineering(py: Python<'_>, contact: &str, quantities: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let mut fields = vec![(Field::Contact, PyString::new(py, contact).into_any())];
        fields.extend(stated_fields(quantities, Field::titled)?);
        Self::of(fields)
    }

    /// Returns the contact with some keywords changed. ``None`` removes a keyword.
    ///
    /// ``contact.replace(load=3e5)``. A contact given by Moes numbers keeps these; its other quantities follow.
    #[pyo3(signature = (**changes))]
    fn replace(&self, py: Python<'_>, changes: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let mut fields = self.fields(py);
        fields.extend(stated_fields(changes, Field::named)?);
        Self::of(fields)
    }

    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyTuple>, Bound<'py, PyDict>)> {
        let keywords = PyDict::new(py);
        for (field, value) in &self.given {
            keywords.set_item(field.keyword(), value)?;
        }
        Ok((PyTuple::empty(py), keywords))
    }

    fn __copy__(own: Py<Self>) -> Py<Self> {
        own
    }

    fn __deepcopy__(own: Py<Self>, _memo: &Bound<'_, PyAny>) -> Py<Self> {
        own
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.request == other.request
    }

    fn __hash__(&self) -> PyResult<u64> {
        let mut hasher = DefaultHasher::new();
        serde_json::to_string(&self.request).map_err(refused)?.hash(&mut hasher);
        Ok(hasher.finish())
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

    /// Maximum Hertzian pressure p_H [Pa].
    #[getter]
    fn hertz_pressure(&self) -> f64 {
        self.request.point.hertz().pressure_pa
    }

    /// ``"line"`` or ``"point"``.
    #[getter]
    fn contact(&self) -> &'static str {
        self.request.point.kind.name()
    }

    /// Radius R [m], speed u_m [m/s], load [N/m or N], modulus E' [Pa], viscosity [Pa s], alpha [1/Pa] and
    /// slide-to-roll ratio, by name; for a point contact also ``radius_y``.
    fn quantities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (point, dict) = (&self.request.point, PyDict::new(py));
        let names = ["radius", "speed", "load", "modulus", "viscosity", "alpha"];
        for (name, value) in names.into_iter().zip(point.quantities()) {
            dict.set_item(name, value)?;
        }
        if point.kind.is_point() {
            dict.set_item("radius_y", point.radius_y_m.unwrap_or(point.radius_m))?;
        }
        dict.set_item("srr", point.sliding.slide_to_roll_ratio)?;
        Ok(dict)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let word = |(field, value): &(Field, Py<PyAny>)| match self.spec.number(*field) {
            Some(number) => Ok(format!("{}{number:?}", Words::Keywords.of(*field))),
            None => Ok(format!("{}={}", field.keyword(), value.bind(py).repr()?)),
        };
        let words = self.given.iter().map(word).collect::<PyResult<Vec<_>>>()?;
        Ok(format!("Contact({})", words.join(", ")))
    }
}
