//! Result of one contact.

use crate::contact::Contact;
use crate::tables::{from_row, shaped};
use crate::work::{long, refused, stated};
use ehl_explorer::engine::{Answer, ContactResult};
use ehl_explorer::scene::{ContactSpec, Paper, Report, ReportFormat, Stated, Subsurface, answer_or_full, atomic_file};
use ehl_explorer::solver::discrete::half_space::Stress;
use ehl_explorer::solver::full::Solution;
use ehl_explorer::solver::physics::engineering::UnitSystem;
use pyo3::exceptions::{PyAttributeError, PyKeyError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyDict;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::PathBuf;

/// Result of one contact: scalars by the names of ``solve --json`` (``H_c``, ``h_c_m``, ``traction``, ``converged``,
/// and those of groups such as ``p_h_pa`` or ``trained``), and fields as arrays. Values that do not apply are absent.
/// Results are equal if everything except the time ``wall_s`` is equal. They can be pickled.
#[pyclass(frozen, module = "ehl_explorer")]
pub struct Result {
    result: ContactResult,
    values: PyOnceLock<Py<PyDict>>,
    fields: Option<Fields>,
    /// Answer and contact, for reports and stresses; `None` for a pickled result.
    solved: Option<Box<(Answer, ContactSpec)>>,
}

/// Arrays of a solution.
struct Fields {
    x: Py<PyAny>,
    y: Py<PyAny>,
    pressure: Py<PyAny>,
    film: Py<PyAny>,
    further: Vec<(String, Py<PyAny>)>,
}

impl Fields {
    fn arrays(&self) -> impl Iterator<Item = &Py<PyAny>> {
        [&self.x, &self.y, &self.pressure, &self.film].into_iter().chain(self.further.iter().map(|(_, array)| array))
    }

    /// Moves the fields of a solution into arrays.
    fn of(py: Python<'_>, solution: Solution) -> PyResult<Self> {
        let line = solution.problem.point.kind.is_line();
        let skipped = solution.mesh.spec.first_column();
        let (nx, ny) = (solution.x.len(), solution.y.len());
        let shape = if line { vec![nx] } else { vec![nx, ny] };
        let field = |values: Vec<f64>| Ok::<_, PyErr>(from_row(shaped(py, values, &shape)?, skipped)?.unbind());
        let rises = solution.heat.as_deref().map(|heat| heat.rises().collect::<Vec<_>>());
        let mut further = Vec::new();
        for (name, values) in [("multiplier", solution.multiplier), ("filled", solution.fraction)] {
            if !values.is_empty() {
                further.push((name.to_owned(), field(values)?));
            }
        }
        if let Some(rises) = rises {
            let columns = [
                ("mid_film_rise_k", rises.iter().map(|at| at.mid_film_k).collect::<Vec<_>>()),
                ("surface_1_rise_k", rises.iter().map(|at| at.surfaces_k[0]).collect()),
                ("surface_2_rise_k", rises.iter().map(|at| at.surfaces_k[1]).collect()),
            ];
            for (name, values) in columns {
                let length = values.len();
                further.push((name.to_owned(), shaped(py, values, &[length])?.unbind()));
            }
        }
        Ok(Self {
            x: from_row(shaped(py, solution.x, &[nx])?, skipped)?.unbind(),
            y: shaped(py, solution.y, &[ny])?.unbind(),
            pressure: field(solution.pressure)?,
            film: field(solution.film)?,
            further,
        })
    }
}

/// Arrays of a result in Python: X, Y, P, H, and the further ones by name.
type Kept<'py> = (Bound<'py, PyAny>, Bound<'py, PyAny>, Bound<'py, PyAny>, Bound<'py, PyAny>, Bound<'py, PyDict>);

/// Pickled form of a result: function and arguments that recreate it.
type Reduced<'py> = (Bound<'py, PyAny>, (String, Option<Kept<'py>>));

/// Recreates a pickled result.
#[pyfunction]
#[pyo3(signature = (result, fields=None))]
pub fn _result(result: &str, fields: Option<Kept<'_>>) -> PyResult<Result> {
    let result = ron::from_str(result).map_err(refused)?;
    let fields = fields.map(|(x, y, pressure, film, further)| {
        let further = further.iter().map(|(name, array)| Ok((name.extract()?, array.unbind())));
        let further = further.collect::<PyResult<_>>()?;
        let (x, y, pressure, film) = (x.unbind(), y.unbind(), pressure.unbind(), film.unbind());
        Ok::<_, PyErr>(Fields { x, y, pressure, film, further })
    });
    Ok(Result { result, values: PyOnceLock::new(), fields: fields.transpose()?, solved: None })
}

impl Result {
    /// Returns the pickled form of the values.
    fn text(&self) -> PyResult<String> {
        ron::to_string(&self.result).map_err(refused)
    }

    /// Returns the values without measured times, for comparisons.
    fn text_without_clock(&self) -> PyResult<String> {
        ron::to_string(&ContactResult { wall_s: 0.0, ..self.result.clone() }).map_err(refused)
    }

    fn kept<'py>(&self, py: Python<'py>) -> PyResult<Option<Kept<'py>>> {
        let Some(Fields { x, y, pressure, film, .. }) = &self.fields else { return Ok(None) };
        let [x, y, pressure, film] = [x, y, pressure, film].map(|array| array.bind(py).clone());
        Ok(Some((x, y, pressure, film, self.fields(py)?)))
    }

    fn of(py: Python<'_>, answer: Answer, spec: &ContactSpec) -> PyResult<Self> {
        let result = answer.result.clone();
        let solved = Some(Box::new((answer.clone(), spec.clone())));
        let fields = answer.into_fields().map(|solution| Fields::of(py, solution)).transpose()?;
        Ok(Self { result, values: PyOnceLock::new(), fields, solved })
    }

    /// Returns answer and contact.
    fn solved(&self) -> PyResult<&(Answer, ContactSpec)> {
        let none = || refused("a pickled result has no solution for this; solve the contact again");
        self.solved.as_deref().ok_or_else(none)
    }

    fn values<'py>(&self, py: Python<'py>) -> PyResult<&Bound<'py, PyDict>> {
        let values = self.values.get_or_try_init(py, || {
            let text = serde_json::to_string(&self.result.json()).map_err(refused)?;
            let values = py.import("json")?.call_method1("loads", (text,))?;
            Ok::<_, PyErr>(values.cast_into::<PyDict>()?.unbind())
        })?;
        Ok(values.bind(py))
    }

    fn field<'py>(&self, py: Python<'py>, get: fn(&Fields) -> &Py<PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let none = || refused("the solve did not converge: there are no fields");
        Ok(get(self.fields.as_ref().ok_or_else(none)?).bind(py).clone())
    }

    /// Finds a value by its name, in any group.
    fn find<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Option<Bound<'py, PyAny>>> {
        let values = self.values(py)?;
        if let Some(value) = values.get_item(name)? {
            return Ok(Some(value));
        }
        if let Some((group, name)) = name.split_once('.') {
            let group = values.get_item(group)?.and_then(|group| group.cast_into::<PyDict>().ok());
            return group.map_or(Ok(None), |group| group.get_item(name));
        }
        for (_, group) in values {
            if let Ok(group) = group.cast::<PyDict>()
                && let Some(value) = group.get_item(name)?
            {
                return Ok(Some(value));
            }
        }
        Ok(None)
    }
}

#[pymethods]
impl Result {
    /// X = x/a of the nodes, shape (n_x,).
    #[getter]
    fn x<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.field(py, |fields| &fields.x)
    }

    /// Y = y/b <= 0 of the nodes, shape (n_y,). The last one lies on the axis; a line contact has only this one.
    #[getter]
    fn y<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.field(py, |fields| &fields.y)
    }

    /// Pressure P = p/p_H at the nodes, shape (n_x,) for a line contact, (n_x, n_y) for a point contact.
    #[getter]
    fn pressure<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.field(py, |fields| &fields.pressure)
    }

    /// Film thickness H = h R/a^2 at the nodes, with the shape of the pressure.
    #[getter]
    fn film<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.field(py, |fields| &fields.film)
    }

    /// Further fields by name: ``multiplier`` or ``filled`` for cavitation by complementarity or mass-conserving
    /// cavitation, and temperature rises for thermal contacts.
    #[getter]
    fn fields<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        for (name, array) in self.fields.iter().flat_map(|fields| &fields.further) {
            dict.set_item(name, array)?;
        }
        Ok(dict)
    }

    /// True if the solve converged. Otherwise there are no scalars and no fields.
    #[getter]
    fn converged(&self) -> bool {
        self.result.converged
    }

    /// Warnings, one sentence each.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.result.warnings.iter().map(ToString::to_string).collect()
    }

    /// Central film thickness H_c.
    #[getter(H_c)]
    fn h_c(&self) -> Option<f64> {
        self.result.scalars.map(|scalars| scalars.h_c)
    }

    /// Minimum film thickness H_min.
    #[getter(H_min)]
    fn h_min(&self) -> Option<f64> {
        self.result.scalars.map(|scalars| scalars.h_min)
    }

    /// Traction coefficient.
    #[getter]
    fn traction(&self) -> Option<f64> {
        self.result.traction
    }

    /// Returns everything except the fields, as the object of ``solve --json``.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        Ok(py.import("copy")?.call_method1("deepcopy", (self.values(py)?,))?.cast_into::<PyDict>()?)
    }

    /// Writes a report of one page. The extension of ``path`` selects HTML or PDF; ``units`` is si, engineering or imperial.
    #[pyo3(signature = (path, title=None, author="", company="", paper="a4", units="engineering"))]
    fn report(
        &self,
        path: PathBuf,
        title: Option<&str>,
        author: &str,
        company: &str,
        paper: &str,
        units: &str,
    ) -> PyResult<()> {
        let (answer, spec) = self.solved()?;
        let accepted =
            || refused(format!("{} has an unsupported file extension; accepted are html, pdf", path.display()));
        let format = ReportFormat::of(&path).ok_or_else(accepted)?;
        let paper = match paper {
            "a4" => Paper::A4,
            "letter" => Paper::Letter,
            word => return Err(refused(format!("paper=\"{word}\" is not valid; accepted are a4, letter"))),
        };
        let title = title.map_or_else(|| format!("{} contact", answer.result.point.kind.name()), str::to_owned);
        let system = UnitSystem::of_word(units).ok_or_else(|| {
            refused(format!("units=\"{units}\" is not valid; accepted are si, engineering, imperial"))
        })?;
        let stated = Stated::of_spec(title, spec, system);
        let stated = Stated { author: author.to_owned(), company: company.to_owned(), ..stated };
        let file = Report::new(&stated, std::slice::from_ref(answer), paper).file(format);
        atomic_file::replace(&path, &file).map_err(refused)
    }

    /// Returns the stress below the surface of body 1 in the plane Y = 0 as arrays by name: ``x_m``, ``z_m`` (depth), and
    /// with the shape (depths, abscissae) in Pa ``sigma_x_pa``, ``sigma_y_pa``, ``sigma_z_pa``, ``tau_xz_pa``,
    /// ``von_mises_pa``, ``maximum_shear_pa``; and the maxima of ``solve --stress --json``. ``poisson`` is Poisson's ratio
    /// of body 1.
    #[pyo3(signature = (poisson=0.3))]
    fn subsurface<'py>(&self, py: Python<'py>, poisson: f64) -> PyResult<Bound<'py, PyDict>> {
        let (answer, _) = self.solved()?;
        let solution = answer.fields().ok_or_else(|| refused("the solve did not converge: there are no fields"))?;
        if !(0.0..=0.5).contains(&poisson) {
            return Err(refused(format!("poisson={poisson} is not valid; accepted are numbers from 0 to 0.5")));
        }
        let point = &answer.result.point;
        let field = py.detach(|| solution.subsurface_stress(poisson)).map_err(refused)?;
        let maxima = serde_json::to_string(&Subsurface::of(&field, point)).map_err(refused)?;
        let dict = py.import("json")?.call_method1("loads", (maxima,))?.cast_into::<PyDict>()?;
        let a = point.hertz().half_width_m;
        let lengths = |nodes: &[f64]| nodes.iter().map(|at| a * at).collect::<Vec<_>>();
        let shape = [field.z.len(), field.x.len()];
        dict.set_item("x_m", shaped(py, lengths(&field.x), &[shape[1]])?)?;
        dict.set_item("z_m", shaped(py, lengths(&field.z), &[shape[0]])?)?;
        type Part = fn(&Stress) -> f64;
        let parts: [(&str, Part); 6] = [
            ("sigma_x_pa", |stress| stress.x),
            ("sigma_y_pa", |stress| stress.y),
            ("sigma_z_pa", |stress| stress.z),
            ("tau_xz_pa", |stress| stress.xz),
            ("von_mises_pa", |stress| stress.von_mises()),
            ("maximum_shear_pa", |stress| stress.maximum_shear()),
        ];
        for (name, part) in parts {
            dict.set_item(name, shaped(py, field.stress.iter().map(part).collect(), &shape)?)?;
        }
        Ok(dict)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let made_by = py.import("ehl_explorer._native")?.getattr("_result")?;
        Ok((made_by, (self.text()?, self.kept(py)?)))
    }

    fn __copy__(own: Py<Self>) -> Py<Self> {
        own
    }

    fn __eq__(&self, py: Python<'_>, other: &Self) -> PyResult<bool> {
        if self.text_without_clock()? != other.text_without_clock()? {
            return Ok(false);
        }
        let (Some(own), Some(others)) = (&self.fields, &other.fields) else {
            return Ok(self.fields.is_none() && other.fields.is_none());
        };
        let named = |(name, _): &(String, Py<PyAny>)| name.clone();
        if !own.further.iter().map(named).eq(others.further.iter().map(named)) {
            return Ok(false);
        }
        let equal = py.import("numpy")?.getattr("array_equal")?;
        for (own, others) in own.arrays().zip(others.arrays()) {
            if !equal.call1((own, others))?.is_truthy()? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    fn __hash__(&self) -> PyResult<u64> {
        let mut hasher = DefaultHasher::new();
        self.text_without_clock()?.hash(&mut hasher);
        Ok(hasher.finish())
    }

    fn __getattr__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let none = || PyAttributeError::new_err(format!("the result has no `{name}`"));
        if name.starts_with('_') { Err(none()) } else { self.find(py, name)?.ok_or_else(none) }
    }

    fn __getitem__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        self.find(py, name)?.ok_or_else(|| PyKeyError::new_err(name.to_owned()))
    }

    fn __repr__(&self) -> String {
        let moes = self.result.point.moes();
        let film = self.result.scalars.map_or("not converged".to_owned(), |scalars| format!("H_c={:.6}", scalars.h_c));
        format!(
            "Result({}, {}, M={:.6}, L={:.6}, {film})",
            self.result.point.kind.name(),
            self.result.method,
            moes.m,
            moes.l
        )
    }
}

/// Solves a contact, as ``ehl-explorer solve`` does.
///
/// ``method`` is ``"full"`` or ``"reduced"``. ``model`` is a :class:`Model` or the name of a ``.rom`` file, if not an
/// embedded model. ``progress(stage, done, total)`` is called occasionally. If the reduced model has no solution, the
/// contact is solved in full and a warning is added.
#[pyfunction]
#[pyo3(signature = (contact, method=None, model=None, progress=None))]
pub fn solve(
    py: Python<'_>,
    contact: &Contact,
    method: Option<&str>,
    model: Option<&Bound<'_, PyAny>>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Result> {
    let asked = contact.asked(method, model)?;
    let request = asked.spec.request().map_err(|refusal| refused(stated(refusal)))?;
    // A reduced solve takes less time than starting a thread. A thread is used only for the full solver.
    if request.method.model().is_some() {
        use ehl_explorer::scene::Bench;
        let answer = py.detach(|| asked.bench().answer(&request, None, &())).map_err(refused)?;
        if answer.result.converged {
            return Result::of(py, answer, &asked.spec);
        }
    }
    let answer = long(py, progress, |watch| answer_or_full(&mut asked.bench(), &request, watch))?;
    Result::of(py, answer, &asked.spec)
}
