//! Fit study: constants of the lubricant from measured film thicknesses and friction coefficients.

use super::question::{
    Chart, ChartAxis, Checked, Experiment, Findings, Marks, Question, RunError, Setting, Table, Tell,
};
use crate::scene::answer::Request;
use crate::scene::bench::answer_or_full;
use crate::scene::check::{count, refuse};
use crate::scene::load_cases::CaseTable;
use crate::scene::measured_data::{MeasuredPoint, measured_points};
use crate::scene::method::Method;
use crate::scene::names;
use crate::solver::parameters::{Estimate, Estimated, EstimationError, estimate};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::{Lubricant, ShearLaw, WholeLubricant};
use crate::solver::warning::Warning;
use serde::{Deserialize, Serialize};

/// Estimates constants of the lubricant by nonlinear least squares. Each measured value has the same relative error;
/// values below 2 % of the largest one have the error of those 2 %.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fit {
    /// Tables with speed or slide-to-roll ratio, and film thickness or friction coefficient. What a table does not
    /// give is that of the scene.
    pub measured: Vec<CaseTable>,
    /// Constants to estimate.
    pub parameters: Vec<FitParameter>,
    /// Method that computes the contacts.
    #[serde(default = "embedded")]
    pub method: Method,
}

fn embedded() -> Method {
    Method::EMBEDDED
}

/// Share of the largest value of a kind below which the absolute error of a measured value is constant.
const FLOOR: f64 = 0.02;
/// Correlation from which two constants can hardly be told apart.
const CORRELATED: f64 = 0.98;
/// Largest number of tables.
const MOST_TABLES: usize = 20;

/// Constant of a lubricant that can be estimated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum FitParameter {
    /// Pressure–viscosity coefficient α.
    Alpha,
    /// Viscosity η₀.
    Viscosity,
    /// Eyring stress τ_E, of the shear law or of the traction.
    EyringStress,
    /// Slope Λ of the limiting shear stress.
    LimitingSlope,
}

impl FitParameter {
    /// All parameters.
    pub const ALL: [Self; 4] = [Self::Alpha, Self::Viscosity, Self::EyringStress, Self::LimitingSlope];

    /// Returns the name in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Alpha => "alpha",
            Self::Viscosity => "viscosity",
            Self::EyringStress => "eyring_stress",
            Self::LimitingSlope => "limiting_slope",
        }
    }

    /// Returns the symbol.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Alpha => "α",
            Self::Viscosity => "η₀",
            Self::EyringStress => "τ_E",
            Self::LimitingSlope => "Λ",
        }
    }

    /// Returns the smallest and largest value of a fit, in SI units.
    fn ends(self) -> (f64, f64) {
        match self {
            Self::Alpha => (1e-10, 1e-7),
            Self::Viscosity => (1e-5, 100.0),
            Self::EyringStress => (1e4, 1e9),
            Self::LimitingSlope => (1e-4, 1.0),
        }
    }

    /// Returns the value of a contact. `None` if its lubricant has no such constant.
    pub fn of(self, point: &OperatingPoint, lubricant: &Lubricant) -> Option<f64> {
        let mut copy = (*point, *lubricant);
        self.place(&mut copy.0, &mut copy.1).copied()
    }

    fn place<'a>(self, point: &'a mut OperatingPoint, lubricant: &'a mut Lubricant) -> Option<&'a mut f64> {
        match self {
            Self::Alpha => lubricant.own_coefficient().is_none().then_some(&mut point.alpha_per_pa),
            Self::Viscosity => Some(&mut point.viscosity_pa_s),
            Self::EyringStress => match &mut lubricant.shear {
                ShearLaw::Eyring { critical_stress, .. } => Some(critical_stress),
                _ => lubricant.limiting_stress.as_mut()?.eyring.as_mut(),
            },
            Self::LimitingSlope => Some(&mut lubricant.limiting_stress.as_mut()?.slope),
        }
    }

    /// Returns what a lubricant needs to have this constant.
    pub fn needs(self) -> &'static str {
        match self {
            Self::Alpha => "α follows from the lubricant's own viscosity law",
            Self::Viscosity => "the lubricant has no viscosity",
            Self::EyringStress => "the lubricant has no Eyring stress; choose Eyring's law, or Eyring traction",
            Self::LimitingSlope => "the lubricant has no limiting shear stress; switch it on",
        }
    }
}

/// Measured value and the fitted one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FittedPoint {
    /// Table, from 1, and line in it, from 1.
    pub table: usize,
    /// Line.
    pub line: usize,
    /// Speed \[m/s\].
    pub speed_m_per_s: f64,
    /// Slide-to-roll ratio.
    pub srr: f64,
    /// Measured and fitted central film thickness \[m\].
    pub film_m: Option<[f64; 2]>,
    /// Measured and fitted friction coefficient.
    pub friction: Option<[f64; 2]>,
}

/// Result of a fit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Constants with their uncertainty, in the order of the study.
    pub parameters: Vec<(FitParameter, Estimated)>,
    /// Standard deviation of the relative differences.
    pub deviation: f64,
    /// Largest magnitude of the correlation of two constants.
    pub correlation: f64,
    /// Contact with the fitted constants.
    pub point: OperatingPoint,
    /// Lubricant with the fitted constants.
    #[serde(with = "WholeLubricant")]
    pub lubricant: Lubricant,
    /// Measured and fitted values.
    pub points: Vec<FittedPoint>,
    /// Warnings of the fitted contacts.
    pub warnings: Vec<Vec<Warning>>,
}

impl Row {
    /// Returns true if two constants can hardly be told apart.
    pub fn is_correlated(&self) -> bool {
        self.correlation > CORRELATED
    }
}

/// Measured point of one of the tables.
struct Given {
    table: usize,
    point: MeasuredPoint,
}

impl Fit {
    fn read(&self, resolve: &dyn Fn(&std::path::Path) -> std::path::PathBuf) -> Result<Vec<Given>, RunError> {
        let mut given = Vec::new();
        for (table, measured) in (1..).zip(&self.measured) {
            let points = measured_points(&measured.text(resolve)?);
            let points = points.map_err(|error| RunError::Study(format!("the measured table {table}: {error}")))?;
            given.extend(points.into_iter().map(|point| Given { table, point }));
        }
        Ok(given)
    }

    /// Returns contact and lubricant with these values of the parameters.
    fn with(&self, values: &[f64], mut point: OperatingPoint, mut lubricant: Lubricant) -> (OperatingPoint, Lubricant) {
        for (parameter, value) in self.parameters.iter().zip(values) {
            if let Some(place) = parameter.place(&mut point, &mut lubricant) {
                *place = *value;
            }
        }
        (point, lubricant)
    }

    /// Solves the contact of a measured point. Returns film thickness, friction coefficient and warnings.
    fn solve(
        &self,
        setting: &mut Setting<'_>,
        base: &Request,
        given: &Given,
        values: &[f64],
    ) -> Result<(OperatingPoint, [f64; 2], Vec<Warning>), RunError> {
        let (mut point, lubricant) = self.with(values, base.point, base.lubricant);
        point.speed_m_per_s = given.point.speed_m_per_s.unwrap_or(point.speed_m_per_s);
        point.sliding.slide_to_roll_ratio = given.point.srr.unwrap_or(point.sliding.slide_to_roll_ratio);
        let request = Request { point, lubricant, method: self.method.clone(), ..base.clone() };
        let result = answer_or_full(setting.bench, &request, setting.observer)?.result;
        let none = || {
            let Given { table, point: MeasuredPoint { line, .. } } = given;
            RunError::Study(format!("the contact of line {line} of the measured table {table} did not converge"))
        };
        let film = result.value(names::H_C_M).filter(|_| result.converged).ok_or_else(none)?;
        Ok((point, [film, result.traction.unwrap_or(0.0).abs()], result.warnings))
    }
}

impl Question for Fit {
    type Row = Row;

    fn check(&self, experiment: &Experiment) -> Checked {
        count("study.measured (how many)", self.measured.len(), 1, MOST_TABLES)?;
        count("study.parameters (how many)", self.parameters.len(), 1, FitParameter::ALL.len())?;
        // An invalid contact is refused by its own field.
        let Ok(point) = experiment.point() else { return Ok(()) };
        for (k, parameter) in self.parameters.iter().enumerate() {
            if self.parameters[..k].contains(parameter) {
                return Err(refuse("study.parameters", format!("names {parameter:?} twice")));
            }
            if parameter.of(&point, &experiment.lubricant).is_none() {
                return Err(refuse("study.parameters", format!("names {parameter:?}, but {}", parameter.needs())));
            }
        }
        // A file is read only when the study runs, so that a scene can be written before its table.
        for table in &self.measured {
            if let CaseTable::Text(text) = table {
                measured_points(text).map_err(|error| refuse("study.measured", format!("is refused: {error}")))?;
            }
        }
        Ok(())
    }

    fn methods(&self) -> &[Method] {
        std::slice::from_ref(&self.method)
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Row>) -> Result<(), RunError> {
        let given = {
            let bench = &*setting.bench;
            self.read(&|path| bench.resolve(path))?
        };
        let base = setting.experiment.request()?;
        let largest = |of: fn(&MeasuredPoint) -> Option<f64>| {
            given.iter().filter_map(|given| of(&given.point)).fold(0.0, f64::max)
        };
        let floors = [FLOOR * largest(|point| point.film_m), FLOOR * largest(|point| point.friction)];
        let mut stopped = false;
        let mut rounds = 0;
        let mut residuals = |values: &[f64]| -> Result<Vec<f64>, RunError> {
            rounds += 1;
            let mut residuals = Vec::with_capacity(given.len());
            for given in &given {
                if let Err(stop) = setting.step("fitting", rounds, 0) {
                    stopped = true;
                    return Err(stop);
                }
                let (_, own, _) = self.solve(setting, &base, given, values)?;
                let pairs = [given.point.film_m, given.point.friction].into_iter().zip(own).zip(floors);
                residuals.extend(pairs.filter_map(|((measured, own), floor)| {
                    measured.map(|measured| (own - measured) / measured.max(floor).max(f64::MIN_POSITIVE))
                }));
            }
            Ok(residuals)
        };
        let start: Vec<f64> =
            self.parameters.iter().filter_map(|parameter| parameter.of(&base.point, &base.lubricant)).collect();
        let ends: Vec<(f64, f64)> = self.parameters.iter().map(|parameter| parameter.ends()).collect();
        let found = estimate(&start, &ends, &mut residuals);
        if stopped {
            return Err(RunError::Cancelled);
        }
        let found = found.map_err(|error| self.refusal(error))?;
        tell(self.row(setting, &base, &given, found)?);
        Ok(())
    }

    /// Values: for each constant its name in SI units, and with `_error` (standard error), `_low`, `_high` (ends of the
    /// 95 % interval); `values` (number of measured values), `deviation` (standard deviation of the relative
    /// differences), `correlation`.
    fn findings(&self, _experiment: &Experiment, rows: &[&Row], found: &mut Findings) {
        for row in rows {
            let of = Some(&self.method);
            for (parameter, Estimated { value, relative_error, interval: (low, high) }) in &row.parameters {
                let name = parameter.name();
                let values = [("", *value), ("_error", value * relative_error), ("_low", *low), ("_high", *high)];
                values.into_iter().for_each(|(end, value)| found.push(format!("{name}{end}"), of, value));
            }
            let values = row.points.iter().map(|p| usize::from(p.film_m.is_some()) + usize::from(p.friction.is_some()));
            found.push("values", None, values.sum::<usize>() as f64);
            found.push("deviation", of, row.deviation);
            found.push("correlation", of, row.correlation);
            if row.is_correlated() {
                let sentence = format!(
                    "two constants have a correlation of {:.3}: the values hardly tell them apart",
                    row.correlation
                );
                found.warnings.push(sentence.into());
            }
            found.warn_repeated("", Warning::summary(row.warnings.iter().map(Vec::as_slice)));
        }
    }

    fn tables(&self, rows: &[&Row]) -> Vec<Table> {
        let mut constants = Table::new("fit", &["value", "standard_error", "low", "high"]);
        let columns =
            ["table", "line", names::SPEED, names::SRR, "film_m", "fitted_film_m", "friction", "fitted_friction"];
        let mut points = Table::new("points", &columns);
        for row in rows {
            for (parameter, Estimated { value, relative_error, interval: (low, high) }) in &row.parameters {
                constants.labels.push(parameter.name().to_owned());
                constants.rows.push(vec![*value, value * relative_error, *low, *high]);
            }
            points.rows.extend(row.points.iter().map(|point| {
                let [film, friction] = [point.film_m, point.friction].map(|pair| pair.unwrap_or([f64::NAN; 2]));
                let place = [point.table as f64, point.line as f64, point.speed_m_per_s, point.srr];
                place.into_iter().chain(film).chain(friction).collect()
            }));
        }
        vec![constants, points]
    }

    fn charts(&self, rows: &[&Row]) -> Vec<Chart> {
        let Some(row) = rows.first() else { return Vec::new() };
        let slides = row.points.windows(2).any(|pair| pair[0].srr != pair[1].srr);
        let over_srr = ("Slide-to-roll ratio SRR [%]", (|point| 100.0 * point.srr) as fn(&FittedPoint) -> f64);
        let over_speed = ("Speed u_m [m/s]", (|point| point.speed_m_per_s) as fn(&FittedPoint) -> f64);
        type Values = fn(&FittedPoint) -> Option<[f64; 2]>;
        let film: Values = |point| point.film_m.map(|pair| pair.map(|film| 1e9 * film));
        let friction: Values = |point| point.friction;
        let chart = |title: &str, y: &str, of: Values, (x, place): (&str, fn(&FittedPoint) -> f64)| {
            let mut pairs: Vec<(f64, [f64; 2])> =
                row.points.iter().filter_map(|point| Some((place(point), of(point)?))).collect();
            pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
            let mut chart = Chart::new(title, ChartAxis::linear(x), ChartAxis::linear(y));
            chart.add("measured", Marks::Rings, pairs.iter().map(|(x, [measured, _])| [*x, *measured]));
            chart.add("fitted", Marks::Line, pairs.iter().map(|(x, [_, own])| [*x, *own]));
            (!pairs.is_empty()).then_some(chart)
        };
        let over = if slides { over_srr } else { over_speed };
        let film = chart("Film thickness against speed", "Central film thickness [nm]", film, over_speed);
        let friction = chart("Friction", "Friction coefficient", friction, over);
        [film, friction].into_iter().flatten().collect()
    }
}

impl Fit {
    /// Returns the row with the fitted values.
    fn row(
        &self,
        setting: &mut Setting<'_>,
        base: &Request,
        given: &[Given],
        found: Estimate,
    ) -> Result<Row, RunError> {
        let values: Vec<f64> = found.parameters.iter().map(|parameter| parameter.value).collect();
        let (point, lubricant) = self.with(&values, base.point, base.lubricant);
        let (mut points, mut warnings) = (Vec::with_capacity(given.len()), Vec::with_capacity(given.len()));
        for given in given {
            let (at, [film, friction], warned) = self.solve(setting, base, given, &values)?;
            points.push(FittedPoint {
                table: given.table,
                line: given.point.line,
                speed_m_per_s: at.speed_m_per_s,
                srr: at.sliding.slide_to_roll_ratio,
                film_m: given.point.film_m.map(|measured| [measured, film]),
                friction: given.point.friction.map(|measured| [measured, friction]),
            });
            warnings.push(warned);
        }
        Ok(Row {
            parameters: self.parameters.iter().copied().zip(found.parameters).collect(),
            deviation: found.deviation,
            correlation: found.correlation,
            point,
            lubricant,
            points,
            warnings,
        })
    }

    fn refusal(&self, error: EstimationError<RunError>) -> RunError {
        let symbol = |k: usize| self.parameters.get(k).map_or("", |parameter| parameter.symbol());
        RunError::Study(match error {
            EstimationError::Model(error) => return error,
            EstimationError::TooFew { values, least } => {
                format!("there are {values} measured values; the fit needs at least {least}")
            }
            EstimationError::Undetermined(k) => format!(
                "the measured values do not determine {}: leave it out, or add values that depend on it",
                symbol(k)
            ),
            EstimationError::AtItsEnd(k) => {
                let (low, high) = self.parameters.get(k).map_or((0.0, 0.0), |parameter| parameter.ends());
                format!("the best {} lies beyond {low:e}…{high:e} in SI units; check units and contact", symbol(k))
            }
            EstimationError::NotConverged => "the fit did not converge; start closer to the measured values".to_owned(),
        })
    }
}
