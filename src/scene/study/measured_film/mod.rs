//! Measured-film study: film thickness along the entrainment axis compared with published measurements or computations.

mod passing;

pub use passing::Passing;

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
    /// Features that pass the contact. If absent, the contact is steady.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub passing: Option<Passing>,
}

/// Published film-thickness profile.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GivenFilm {
    /// Name, also used in names of values.
    pub name: String,
    /// Source.
    pub from: String,
    /// Position of the first feature that passes \[µm\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<f64>,
    /// Position and film thickness \[µm, nm\], in ascending order of position.
    pub points: Vec<(f64, f64)>,
}

/// Computed film thickness.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Index of the given film that it belongs to. `None` if it is that of the steady contact.
    pub of: Option<usize>,
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
    /// The given film is moved by `displacement` \[m\].
    fn pairs(&self, film: &GivenFilm, computed: &[[f64; 2]], displacement: f64) -> Vec<[f64; 3]> {
        let metres = film.points.iter().map(|&(x, h)| (PLACE_M * x + displacement, THICKNESS_M * h));
        let compared = metres.filter(|(x, _)| (self.between.0..=self.between.1).contains(x));
        compared.filter_map(|(x, given)| Some([x, given, at(computed, x)?])).collect()
    }

    /// Returns the largest and mean relative deviation of the computed film thickness from a given one, and the
    /// deviation of its minimum.
    fn deviations(&self, film: &GivenFilm, computed: &[[f64; 2]], displacement: f64) -> [f64; 3] {
        let pairs = self.pairs(film, computed, displacement);
        let off: Vec<f64> = pairs.iter().map(|[_, given, own]| (own / given - 1.0).abs()).collect();
        let largest = off.iter().copied().fold(f64::NAN, f64::max);
        let between = |place: f64| (self.between.0..=self.between.1).contains(&place);
        let least = |values: &mut dyn Iterator<Item = f64>| values.fold(f64::INFINITY, f64::min);
        let own = least(&mut computed.iter().filter(|[x, _]| between(*x)).map(|[_, h]| *h));
        let given = least(&mut pairs.iter().map(|[_, given, _]| *given));
        [largest, off.iter().sum::<f64>() / off.len() as f64, own / given - 1.0]
    }
}

impl MeasuredFilm {
    /// Returns the displacement of a given film \[m\] that its reading uncertainty permits.
    fn displacement(&self, film: &GivenFilm, computed: &[[f64; 2]]) -> f64 {
        let mean = |displacement: f64| {
            let [_, mean, _] = self.deviations(film, computed, displacement);
            mean
        };
        self.passing.as_ref().map_or(0.0, |passing| passing.displacement(mean))
    }

    /// Returns every given film with the computed one that it is compared with.
    fn compared<'a>(&'a self, rows: &'a [&Row]) -> impl Iterator<Item = (usize, &'a GivenFilm, &'a [[f64; 2]])> {
        self.films.iter().enumerate().flat_map(move |(k, film)| {
            let own = rows.iter().filter(move |row| row.of.is_none_or(|of| of == k) && !row.film.is_empty());
            own.map(move |row| (k, film, row.film.as_slice()))
        })
    }
}

impl Question for MeasuredFilm {
    type Row = Row;

    fn check(&self, experiment: &Experiment) -> Checked {
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
        match &self.passing {
            Some(passing) => passing.check(self, experiment),
            None if self.films.iter().any(|film| film.at.is_some()) => {
                Err(refuse("study.films.at", "must be left out without `passing`"))
            }
            None => Ok(()),
        }
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Row>) -> Result<(), RunError> {
        setting.step("solving", 0, 1)?;
        if let Some(passing) = &self.passing {
            let (films, trajectory) = passing.films(self, setting)?;
            let rows = films.into_iter().enumerate();
            let warnings = |k: usize| if k == 0 { trajectory.warnings().collect() } else { Vec::new() };
            rows.for_each(|(k, film)| tell(Row { of: Some(k), film, warnings: warnings(k) }));
            return Ok(());
        }
        let request = setting.experiment.request()?;
        let answer = setting.bench.answer(&request, None, setting.observer)?;
        let along = |solution: &Solution| {
            let point = &solution.problem.point;
            let (length, height) = (point.hertz().half_width_m, point.film_scale_m());
            solution.profile().map(|(x, _, h)| [length * x, height * h]).collect()
        };
        let film = answer.fields().map(along).unwrap_or_default();
        tell(Row { of: None, film, warnings: answer.result.warnings.clone() });
        Ok(())
    }

    /// Values of each given profile, by its name, all relative to it: `.deviation_max`, `.deviation_mean`, and
    /// `.minimum`, the deviation of the minimum film thickness. With features also `.moved_um`, by which the given film
    /// was moved.
    fn findings(&self, _experiment: &Experiment, rows: &[&Row], found: &mut Findings) {
        found.converged &= !rows.is_empty() && rows.iter().all(|row| !row.film.is_empty());
        found.warn("", rows.iter().flat_map(|row| row.warnings.iter().cloned()));
        for (_, film, computed) in self.compared(rows) {
            let moved = self.displacement(film, computed);
            let values = self.deviations(film, computed, moved);
            for (name, value) in ["deviation_max", "deviation_mean", "minimum"].into_iter().zip(values) {
                found.push(format!("{}.{name}", film.name), Some(&Method::Full), value);
            }
            if self.passing.is_some() {
                found.push(format!("{}.moved_um", film.name), None, moved / PLACE_M);
            }
        }
    }

    fn tables(&self, rows: &[&Row]) -> Vec<Table> {
        let mut table = Table::new("films", &["film", "x_m", "h_given_m", "h_computed_m"]);
        for (k, film, computed) in self.compared(rows) {
            let pairs = self.pairs(film, computed, self.displacement(film, computed)).into_iter();
            table.rows.extend(pairs.map(|[x, given, computed]| vec![k as f64 + 1.0, x, given, computed]));
        }
        vec![table]
    }

    fn charts(&self, rows: &[&Row]) -> Vec<Chart> {
        let (from, to) = (1.3 * self.between.0 / PLACE_M, 1.3 * self.between.1 / PLACE_M);
        let shown = |[x, _]: &[f64; 2]| (from..=to).contains(x);
        let chart = |title: String, films: &[&GivenFilm], computed: &[&Row]| {
            let mut chart = Chart::new(title, ChartAxis::linear("x [µm]"), ChartAxis::linear("h [nm]"));
            for row in computed {
                let computed = row.film.iter().map(|[x, h]| [x / PLACE_M, h / THICKNESS_M]);
                chart.add("here", Marks::Line, computed.filter(shown));
            }
            for film in films {
                let moved = computed.first().map_or(0.0, |row| self.displacement(film, &row.film)) / PLACE_M;
                let points = film.points.iter().map(|&(x, h)| [x + moved, h]);
                chart.add(film.name.clone(), Marks::Dots, points.filter(shown));
            }
            chart
        };
        let along = "Film thickness along the entrainment axis";
        if self.passing.is_none() {
            return vec![chart(along.to_owned(), &self.films.iter().collect::<Vec<_>>(), rows)];
        }
        // Films that were taken at the same time share a chart.
        let mut places: Vec<f64> = self.films.iter().filter_map(|film| film.at).collect();
        places.sort_by(f64::total_cmp);
        places.dedup();
        let at = |place: f64| {
            let films: Vec<(usize, &GivenFilm)> =
                self.films.iter().enumerate().filter(|(_, film)| film.at == Some(place)).collect();
            let first = films.first().map(|(k, _)| *k);
            let own: Vec<&Row> = rows.iter().copied().filter(|row| row.of.is_some() && row.of == first).collect();
            let films: Vec<&GivenFilm> = films.into_iter().map(|(_, film)| film).collect();
            chart(format!("{along}, feature at {place} µm"), &films, &own)
        };
        places.into_iter().map(at).collect()
    }
}
