//! Amplitude study: what remains in the film of a wavy surface that moves through the contact, over the wavelength.

use super::question::{
    Chart, ChartAxis, Checked, Experiment, Findings, Marks, Question, RunError, Setting, Table, Tell,
};
use crate::scene::check::{count, number, refuse};
use crate::scene::grid::Grid;
use crate::scene::method::Method;
use crate::scene::written::is_default;
use crate::solver::full::Solution;
use crate::solver::full::response::{
    ContactResponse, TimeDerivative, WaveResponse, check_lubricant, check_wavelength, published_reduction,
    reduction_parameter, widest_spacing,
};
use crate::solver::full::transient::MovingSurface;
use crate::solver::warning::Warning;
use serde::{Deserialize, Serialize};

/// Amplitude A_d of the central film thickness under a wavy surface with the amplitude A_i, for several wavelengths.
/// Each is one complex linear solve at the steady contact. The crests lie across the direction of rolling.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Amplitude {
    /// Wavelengths λ/a.
    pub wavelengths: Vec<f64>,
    /// Body with the wavy surface, 1 or 2. The scene's SRR sets its speed.
    #[serde(default = "first", skip_serializing_if = "is_first")]
    pub body: u8,
    /// Time derivatives, each with its own curve.
    #[serde(default = "exact", skip_serializing_if = "is_exact")]
    pub derivatives: Vec<Derivative>,
    /// Step ΔT of derivatives by differences; the grid's spacing in the contact if absent.
    #[serde(default, skip_serializing_if = "is_default")]
    pub time_step: Option<f64>,
}

/// Time derivative of a periodic change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Derivative {
    /// Exact derivative.
    Exact,
    /// Error of the scheme `Bdf2` included.
    Bdf2,
    /// Error of the scheme `Characteristic` included.
    Characteristic,
}

/// Columns: λ/a, ∇, published |A_d/A_i|. Those of each derivative follow.
const COLUMNS: [&str; 3] = ["wavelength", "nabla", "published"];
/// Largest number of wavelengths.
const MOST_WAVELENGTHS: usize = 1000;

/// Result for one wavelength.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Wavelength λ/a.
    pub wavelength: f64,
    /// Parameter ∇ of the published curve.
    pub nabla: f64,
    /// |A_d/A_i| of the published curve for pure rolling.
    pub published: f64,
    /// Response for each derivative, in the order of the study.
    pub responses: Vec<WaveResponse>,
    /// Warnings about the steady contact.
    pub warnings: Vec<Warning>,
}

fn first() -> u8 {
    1
}

fn is_first(body: &u8) -> bool {
    *body == first()
}

fn exact() -> Vec<Derivative> {
    vec![Derivative::Exact]
}

fn is_exact(derivatives: &Vec<Derivative>) -> bool {
    *derivatives == exact()
}

impl Derivative {
    /// Returns its name in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Bdf2 => "bdf2",
            Self::Characteristic => "characteristic",
        }
    }

    fn with_step(self, step: f64) -> TimeDerivative {
        match self {
            Self::Exact => TimeDerivative::Exact,
            Self::Bdf2 => TimeDerivative::Bdf2 { step },
            Self::Characteristic => TimeDerivative::Characteristic { step },
        }
    }
}

impl Amplitude {
    /// Returns the speed of the wavy surface over u_m.
    fn speed(&self, slide_to_roll_ratio: f64) -> f64 {
        MovingSurface::speed_of(self.body, slide_to_roll_ratio)
    }

    /// Returns the rows of a solved contact.
    fn rows(&self, solution: &Solution, warnings: &[Warning], setting: &Setting<'_>) -> Result<Vec<Row>, RunError> {
        let refused = |problem: &dyn std::fmt::Display| RunError::Study(problem.to_string());
        let mut response = ContactResponse::of(solution).map_err(|problem| refused(&problem))?;
        let (point, moes) = (&solution.problem.point, solution.problem.moes);
        let speed = self.speed(point.sliding.slide_to_roll_ratio);
        let step = self.time_step.unwrap_or_else(|| widest_spacing(&solution.x));
        let mut rows = Vec::new();
        for (k, &wavelength) in self.wavelengths.iter().enumerate() {
            setting.step("wavelengths", k, self.wavelengths.len())?;
            let nabla = reduction_parameter(point.kind, moes, wavelength);
            let responses = self.derivatives.iter().map(|derivative| {
                response.wave(wavelength, speed, derivative.with_step(step)).map_err(|problem| refused(&problem))
            });
            rows.push(Row {
                wavelength,
                nabla,
                published: published_reduction(point.kind).at(nabla),
                responses: responses.collect::<Result<_, _>>()?,
                warnings: if k == 0 { warnings.to_vec() } else { Vec::new() },
            });
        }
        Ok(rows)
    }
}

impl Question for Amplitude {
    type Row = Row;

    fn check(&self, experiment: &Experiment) -> Checked {
        check_lubricant(&experiment.lubricant).map_err(|problem| refuse("study", format!("is refused: {problem}")))?;
        count("study.wavelengths (how many)", self.wavelengths.len(), 1, MOST_WAVELENGTHS)?;
        count("study.body", usize::from(self.body), 1, 2)?;
        count("study.derivatives (how many)", self.derivatives.len(), 1, 3)?;
        if (1..self.derivatives.len()).any(|i| self.derivatives[..i].contains(&self.derivatives[i])) {
            return Err(refuse("study.derivatives", "must not name a derivative twice: results are named by it"));
        }
        self.time_step.iter().try_for_each(|&step| number("study.time_step", step, 1e-6, 10.0))?;
        let spacing = match experiment.grid {
            Grid::Uniform { dx, .. } => Some(dx),
            Grid::Plane(spec) => Some(spec.dx),
            _ => None,
        };
        for &wavelength in &self.wavelengths {
            number("study.wavelengths", wavelength, 1e-4, 1e4)?;
            if let Some(Err(problem)) = spacing.map(|spacing| check_wavelength(wavelength, spacing)) {
                return Err(refuse("study.wavelengths", format!("are refused: {problem}")));
            }
        }
        let uniform = experiment.contact.is_line() && matches!(experiment.grid, Grid::Uniform { .. });
        if self.derivatives.contains(&Derivative::Characteristic) && !uniform {
            return Err(refuse(
                "study.derivatives",
                "hold Characteristic, which needs a line contact on a grid of the kind Uniform",
            ));
        }
        Ok(())
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Row>) -> Result<(), RunError> {
        setting.step("solving", 0, 1)?;
        let request = setting.experiment.request()?;
        let answer = setting.bench.answer(&request, None, setting.observer)?;
        let Some(solution) = answer.fields() else { return Ok(()) };
        self.rows(solution, &answer.result.warnings, setting)?.into_iter().for_each(tell);
        Ok(())
    }

    /// Values, numbered by wavelength from 0:
    ///
    /// - `nabla_0`, the parameter ∇ of the published curve, and `published_0`, its |A_d/A_i| for pure rolling;
    /// - `exact.amplitude_0`, |A_d/A_i|, `exact.real_0` and `exact.imaginary_0`, and the same for `bdf2` and
    ///   `characteristic`.
    fn findings(&self, _experiment: &Experiment, rows: &[&Row], found: &mut Findings) {
        let of = Some(&Method::Full);
        found.converged &= rows.len() == self.wavelengths.len();
        found.warn("", rows.iter().flat_map(|row| row.warnings.iter().cloned()));
        for (k, row) in rows.iter().enumerate() {
            found.push(format!("nabla_{k}"), of, row.nabla);
            found.push(format!("published_{k}"), of, row.published);
            for (derivative, response) in self.derivatives.iter().zip(&row.responses) {
                let (name, (real, imaginary)) = (derivative.name(), response.amplitude);
                found.push(format!("{name}.amplitude_{k}"), of, response.ratio());
                found.push(format!("{name}.real_{k}"), of, real);
                found.push(format!("{name}.imaginary_{k}"), of, imaginary);
            }
        }
    }

    fn tables(&self, rows: &[&Row]) -> Vec<Table> {
        let mut table = Table::new("amplitude", &COLUMNS);
        for derivative in &self.derivatives {
            let column = |what: &str| format!("{}.{what}", derivative.name());
            table.columns.extend(["amplitude", "real", "imaginary"].map(column));
        }
        table.rows.extend(rows.iter().map(|row| {
            let of = |response: &WaveResponse| [response.ratio(), response.amplitude.0, response.amplitude.1];
            [row.wavelength, row.nabla, row.published].into_iter().chain(row.responses.iter().flat_map(of)).collect()
        }));
        vec![table]
    }

    fn charts(&self, rows: &[&Row]) -> Vec<Chart> {
        let mut chart = Chart::new(
            "Amplitude of a wavy surface",
            ChartAxis::log("Reduction parameter Ψ"),
            ChartAxis::linear("|A_d/A_i|"),
        );
        let mut published: Vec<[f64; 2]> = rows.iter().map(|row| [row.nabla, row.published]).collect();
        published.sort_by(|a, b| a[0].total_cmp(&b[0]));
        chart.add("published, pure rolling", Marks::Line, published);
        for (k, derivative) in self.derivatives.iter().enumerate() {
            let points = rows.iter().filter_map(|row| Some([row.nabla, row.responses.get(k)?.ratio()]));
            chart.add(derivative.name(), Marks::Dots, points);
        }
        vec![chart]
    }
}
