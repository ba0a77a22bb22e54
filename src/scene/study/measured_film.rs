//! Measured-film study: film thickness along the entrainment axis compared with published measurements or computations.

use super::question::{
    Chart, ChartAxis, Checked, Experiment, Findings, Marks, Question, RunError, Setting, Table, Tell,
};
use crate::scene::check::{count, number, refuse};
use crate::scene::method::Method;
use crate::solver::full::Solution;
use crate::solver::warning::Warning;
use serde::{Deserialize, Serialize};

/// Film thickness of the contact along Y = 0, compared with given profiles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeasuredFilm {
    /// Given profiles.
    pub films: Vec<GivenFilm>,
    /// Interval in which they are compared \[m\].
    pub between: (f64, f64),
}

/// Published film-thickness profile.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GivenFilm {
    /// Name, also used in names of values.
    pub name: String,
    /// Source.
    pub from: String,
    /// Position and film thickness \[µm, nm\], in ascending order of position.
    pub points: Vec<(f64, f64)>,
}

/// Computed film thickness.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Position and film thickness \[m\]; empty if the solve failed.
    pub film: Vec<[f64; 2]>,
    /// Warnings.
    pub warnings: Vec<Warning>,
}

/// Units of the given positions and film thicknesses in metres.
const PLACE_M: f64 = 1e-6;
const THICKNESS_M: f64 = 1e-9;

/// Interpolates linearly between points.
fn at(line: &[[f64; 2]], x: f64) -> Option<f64> {
    let k = line.partition_point(|[own, _]| *own < x);
    let [x_0, h_0] = *line.get(k.checked_sub(1)?)?;
    let [x_1, h_1] = *line.get(k)?;
    Some(h_0 + (h_1 - h_0) * (x - x_0) / (x_1 - x_0))
}

impl MeasuredFilm {
    /// Returns position, given and computed film thickness \[m\] where both exist in the compared interval.
    fn pairs(&self, film: &GivenFilm, computed: &[[f64; 2]]) -> Vec<[f64; 3]> {
        let metres = film.points.iter().map(|&(x, h)| (PLACE_M * x, THICKNESS_M * h));
        let compared = metres.filter(|(x, _)| (self.between.0..=self.between.1).contains(x));
        compared.filter_map(|(x, given)| Some([x, given, at(computed, x)?])).collect()
    }

    /// Returns the largest and mean relative deviation of the computed film thickness from a given one, and the
    /// deviation of its minimum.
    fn deviations(&self, film: &GivenFilm, computed: &[[f64; 2]]) -> [f64; 3] {
        let pairs = self.pairs(film, computed);
        let off: Vec<f64> = pairs.iter().map(|[_, given, own]| (own / given - 1.0).abs()).collect();
        let largest = off.iter().copied().fold(f64::NAN, f64::max);
        let between = |place: f64| (self.between.0..=self.between.1).contains(&place);
        let least = |values: &mut dyn Iterator<Item = f64>| values.fold(f64::INFINITY, f64::min);
        let own = least(&mut computed.iter().filter(|[x, _]| between(*x)).map(|[_, h]| *h));
        let given = least(&mut pairs.iter().map(|[_, given, _]| *given));
        [largest, off.iter().sum::<f64>() / off.len() as f64, own / given - 1.0]
    }
}

impl Question for MeasuredFilm {
    type Row = Row;

    fn check(&self, _experiment: &Experiment) -> Checked {
        count("study.films (how many)", self.films.len(), 1, 20)?;
        let (from, to) = self.between;
        number("study.between.0", from, -1.0, 1.0)?;
        number("study.between.1", to, from, 1.0)?;
        for film in &self.films {
            count("study.films.points (how many)", film.points.len(), 2, 100_000)?;
            for &(x, h) in &film.points {
                number("study.films.points.0", x, -1e6, 1e6)?;
                number("study.films.points.1", h, 1e-3, 1e9)?;
            }
            if film.points.windows(2).any(|pair| pair[0].0 >= pair[1].0) {
                return Err(refuse("study.films.points", "must be in ascending order of their places"));
            }
        }
        Ok(())
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Row>) -> Result<(), RunError> {
        setting.step("solving", 0, 1)?;
        let request = setting.experiment.request()?;
        let answer = setting.bench.answer(&request, None, setting.observer)?;
        let along = |solution: &Solution| {
            let point = &solution.problem.point;
            let (length, height) = (point.hertz().half_width_m, point.film_scale_m());
            solution.profile().map(|(x, _, h)| [length * x, height * h]).collect()
        };
        let film = answer.fields().map(along).unwrap_or_default();
        tell(Row { film, warnings: answer.result.warnings.clone() });
        Ok(())
    }

    /// Values of each given profile, by its name, all relative to it: `.deviation_max`, `.deviation_mean`, and
    /// `.minimum`, the deviation of the minimum film thickness.
    fn findings(&self, _experiment: &Experiment, rows: &[&Row], found: &mut Findings) {
        found.converged &= !rows.is_empty() && rows.iter().all(|row| !row.film.is_empty());
        found.warn("", rows.iter().flat_map(|row| row.warnings.iter().cloned()));
        let computed = || rows.iter().map(|row| &row.film).filter(|film| !film.is_empty());
        for (film, computed) in self.films.iter().flat_map(|film| computed().map(move |row| (film, row))) {
            let values = self.deviations(film, computed);
            for (name, value) in ["deviation_max", "deviation_mean", "minimum"].into_iter().zip(values) {
                found.push(format!("{}.{name}", film.name), Some(&Method::Full), value);
            }
        }
    }

    fn tables(&self, rows: &[&Row]) -> Vec<Table> {
        let mut table = Table::new("films", &["film", "x_m", "h_given_m", "h_computed_m"]);
        for (k, film) in self.films.iter().enumerate() {
            let pairs = rows.iter().flat_map(|row| self.pairs(film, &row.film));
            table.rows.extend(pairs.map(|[x, given, computed]| vec![k as f64 + 1.0, x, given, computed]));
        }
        vec![table]
    }

    fn charts(&self, rows: &[&Row]) -> Vec<Chart> {
        let mut chart = Chart::new(
            "Film thickness along the entrainment axis",
            ChartAxis::linear("x [µm]"),
            ChartAxis::linear("h [nm]"),
        );
        let (from, to) = (1.3 * self.between.0 / PLACE_M, 1.3 * self.between.1 / PLACE_M);
        let shown = |[x, _]: &[f64; 2]| (from..=to).contains(x);
        for row in rows {
            let computed = row.film.iter().map(|[x, h]| [x / PLACE_M, h / THICKNESS_M]);
            chart.add("here", Marks::Line, computed.filter(shown));
        }
        for film in &self.films {
            chart.add(film.name.clone(), Marks::Dots, film.points.iter().map(|&(x, h)| [x, h]).filter(shown));
        }
        vec![chart]
    }
}
