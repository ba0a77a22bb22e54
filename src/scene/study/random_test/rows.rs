//! Rows of a random validation: tests, full solutions, and their comparison.

use crate::scene::{Method, Table, names};
use crate::solver::full::heat::Rises;
use crate::solver::full::{GridCost, Scalars, Solution};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::reduced::ErrorEstimate;
use crate::solver::warning::Warning;
use serde::{Deserialize, Serialize};

/// Row of a random validation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[expect(clippy::large_enum_variant, reason = "most rows are tests")]
pub enum Row {
    /// A test. Tests arrive in the order in which they are drawn.
    Test(Test),
    /// Full solution for the test with this index; `None` if the full solver failed. These rows arrive in any order,
    /// after all tests.
    Truth(usize, Option<Film>),
}

/// One test.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Test {
    /// The contact.
    pub point: OperatingPoint,
    /// Result of the method; `None` if it failed.
    pub film: Option<Film>,
    /// Number of Newton steps.
    pub newton_iterations: usize,
    /// Time of the solve alone \[s\].
    pub wall_s: f64,
    /// True if the point is inside the trained range; `None` for a full solution.
    pub trained: Option<bool>,
    /// Warnings.
    pub warnings: Vec<Warning>,
    /// Calibrated error bounds, if the model has them.
    pub estimate: Option<ErrorEstimate>,
}

/// Compared values of a solution.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Film {
    /// Central film thickness H_c.
    pub h_c: f64,
    /// Minimum film thickness H_min.
    pub h_min: f64,
    /// Traction coefficient; NaN if it is not meaningful.
    pub traction: f64,
    /// Temperature rises at X = 0; `None` without heat.
    pub rises: Option<Rises>,
    /// Discretisation error of H_c; `None` for a reduced solution.
    pub grid_cost: Option<GridCost>,
    /// Values of rough surfaces.
    #[serde(default)]
    pub rough: Option<Asperities>,
}

/// Compared values of rough surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Asperities {
    /// Share of the load that asperities carry.
    pub load_share: f64,
    /// Film thickness to which errors of thinner films are relative.
    pub least_film: f64,
}

impl Asperities {
    pub(super) fn of(solution: &Solution) -> Option<Self> {
        let load_share = solution.mixed()?.asperity_load_share;
        Some(Self { load_share, least_film: solution.problem.least_film() })
    }
}

/// Names of the compared values.
pub(super) const COMPARED: [&str; 5] =
    [names::H_C, names::H_MIN, names::TRACTION, "mid_film_rise", "asperity_load_share"];

/// Column of the contact and the method, and column of the full solution.
type Own = (&'static str, fn(&Test) -> f64);
type Full = (&'static str, fn(&Film) -> f64);

const OWN: [Own; 20] = [
    (names::M, |test| test.point.moes().m),
    (names::L, |test| test.point.moes().l),
    (names::ALPHA, |test| test.point.alpha_per_pa),
    (names::HERTZ_PRESSURE, |test| test.point.hertz().pressure_pa),
    (names::SRR, |test| test.point.sliding.slide_to_roll_ratio),
    (names::NPR, |test| test.point.sliding.newtonian_plateau_ratio.unwrap_or(1.0)),
    (names::CONVERGED, |test| f64::from(u8::from(test.film.is_some()))),
    (names::H_C, |test| test.film.unwrap_or(Film::NONE).h_c),
    (names::H_MIN, |test| test.film.unwrap_or(Film::NONE).h_min),
    (names::TRACTION, |test| test.film.unwrap_or(Film::NONE).traction),
    (names::MID_FILM_RISE, |test| test.film.unwrap_or(Film::NONE).mid_film_rise_k()),
    (names::MIXED_LOAD_SHARE, |test| test.film.unwrap_or(Film::NONE).load_share()),
    (names::NEWTON_ITERATIONS, |test| test.newton_iterations as f64),
    (names::TRAINED, |test| test.trained.map_or(f64::NAN, |trained| f64::from(u8::from(trained)))),
    (names::H_C_BOUND, |test| test.bounds()[0].unwrap_or(f64::NAN)),
    (names::H_MIN_BOUND, |test| test.bounds()[1].unwrap_or(f64::NAN)),
    (names::TRACTION_BOUND, |test| test.bounds()[2].unwrap_or(f64::NAN)),
    (names::RISE_BOUND, |test| test.bounds()[3].unwrap_or(f64::NAN)),
    (names::LOAD_SHARE_BOUND, |test| test.bounds()[4].unwrap_or(f64::NAN)),
    (names::WALL_S, |test| test.wall_s),
];

/// Columns of full solutions, prefixed by `full.`.
const FULL: [Full; 5] = [
    (names::H_C, |full| full.h_c),
    (names::H_MIN, |full| full.h_min),
    (names::TRACTION, |full| full.traction),
    (names::MID_FILM_RISE, Film::mid_film_rise_k),
    (names::MIXED_LOAD_SHARE, Film::load_share),
];

impl Film {
    const NONE: Self =
        Self { h_c: f64::NAN, h_min: f64::NAN, traction: f64::NAN, rises: None, grid_cost: None, rough: None };

    pub(super) fn of_full(full: &Solution) -> Self {
        // Excluded from comparison: at these temperatures the laws of the lubricant are not valid.
        if full.heat.as_ref().is_some_and(|heat| heat.too_hot().is_some()) {
            return Self::NONE;
        }
        let traction = if full.traction_warning().is_none() { full.traction_coefficient() } else { f64::NAN };
        let Solution { scalars: Scalars { h_c, h_min, .. }, grid_cost, .. } = *full;
        let rises = full.heat.as_ref().map(|heat| heat.central);
        let rough = Asperities::of(full);
        Self { h_c, h_min, traction, rises, grid_cost, rough }
    }

    fn mid_film_rise_k(&self) -> f64 {
        self.rises.map_or(f64::NAN, |rises| rises.mid_film_k)
    }

    fn load_share(&self) -> f64 {
        self.rough.map_or(f64::NAN, |rough| rough.load_share)
    }

    /// Returns the relative errors of H_c, H_min, traction and (thermal contacts) temperature rise at mid-film against
    /// a full solution, and the absolute error of the asperity load share; `None` for missing values. For a rise below
    /// 1 K, the error is in kelvin. Errors of films thinner than σ/2 are relative to σ/2.
    pub fn errors(&self, full: &Self) -> [Option<f64>; 5] {
        let least = full.rough.map_or(0.0, |rough| rough.least_film);
        let relative = |own: f64, full: f64, least: f64| {
            let error = if full.abs() < least { (own - full).abs() / least } else { (own / full - 1.0).abs() };
            Some(error).filter(|error| error.is_finite())
        };
        let films = [(self.h_c, full.h_c), (self.h_min, full.h_min)];
        let [h_c, h_min] = films.map(|(own, full)| relative(own, full, least));
        let traction = relative(self.traction, full.traction, 0.0);
        let rise = self.rises.zip(full.rises).map(|(own, full)| own.difference(&full));
        let load_share = self.rough.zip(full.rough).map(|(own, full)| (own.load_share - full.load_share).abs());
        [h_c, h_min, traction, rise, load_share]
    }
}

impl Test {
    /// Returns the calibrated error bounds of H_c, H_min, traction, temperature rise at mid-film and asperity load
    /// share.
    pub fn bounds(&self) -> [Option<f64>; 5] {
        let all = |e: ErrorEstimate| [Some(e.h_c), Some(e.h_min), e.traction, e.rise, e.load_share];
        let bounds = |e: ErrorEstimate| all(e).map(|e| e.map(|e| e.bound));
        self.estimate.map_or([None; 5], bounds)
    }
}

/// Test with its comparison: `None` if not compared yet, `Some(None)` if the full solution failed.
pub type Tested = (Test, Option<Option<Film>>);

/// Returns the errors as [`Film::errors`], if there is a full solution.
pub fn errors((test, truth): &Tested) -> [Option<f64>; 5] {
    test.film.zip(truth.flatten()).map_or([None; 5], |(film, full)| film.errors(&full))
}

/// Adds a row to the tests received before.
pub fn add(tests: &mut Vec<Tested>, row: &Row) {
    match row {
        Row::Test(test) => tests.push((test.clone(), None)),
        Row::Truth(index, film) => {
            if let Some((_, truth)) = tests.get_mut(*index) {
                *truth = Some(*film);
            }
        }
    }
}

/// Collects the tests from the rows so far.
pub fn tests<'a>(rows: impl IntoIterator<Item = &'a Row>) -> Vec<Tested> {
    let mut tests = Vec::new();
    rows.into_iter().for_each(|row| add(&mut tests, row));
    tests
}

/// Returns the tests as a table.
pub(super) fn table(tests: &[Tested]) -> Table {
    let own = OWN.iter().map(|(name, _)| (*name).to_owned());
    let columns = own.chain(FULL.iter().map(|(name, _)| names::by(Method::Full.name(), name))).collect();
    let row = |(test, truth): &Tested| {
        let full = truth.flatten().unwrap_or(Film::NONE);
        OWN.iter().map(|(_, get)| get(test)).chain(FULL.iter().map(|(_, get)| get(&full))).collect()
    };
    let rows = tests.iter().map(row).collect();
    let table = Table { name: "random".to_owned(), columns, rows, ..Table::default() };
    table.with_warnings(tests.iter().map(|(test, _)| &test.warnings[..]))
}

#[cfg(test)]
mod tests_of_rows {
    use super::*;
    use crate::solver::discrete::grid::GridSpec;
    use crate::solver::full::{FullSolver, Start};
    use crate::solver::physics::contact::Sliding;
    use crate::solver::physics::lubricant::{Heat, Lubricant};

    #[test]
    fn a_truth_finds_its_test_whenever_it_comes() {
        let test = Test {
            point: OperatingPoint::TABLE_2_1,
            film: Some(Film { h_c: 1.1, h_min: 0.9, traction: f64::NAN, rises: None, grid_cost: None, rough: None }),
            newton_iterations: 3,
            wall_s: 0.0,
            trained: Some(true),
            warnings: Vec::new(),
            estimate: None,
        };
        let full = Film { h_c: 1.0, h_min: 1.0, traction: 0.05, rises: None, grid_cost: None, rough: None };
        let rows = [
            Row::Test(test.clone()),
            Row::Test(test.clone()),
            Row::Truth(1, Some(full)),
            Row::Truth(0, None),
            Row::Truth(7, None),
        ];
        let seen = tests(&rows);
        assert_eq!((seen.len(), seen[0].1, seen[1].1), (2, Some(None), Some(Some(full))));
        let [h_c, h_min, traction, rise, load_share] = test.film.unwrap().errors(&full);
        assert!((h_c.unwrap() - 0.1).abs() < 1e-12 && (h_min.unwrap() - 0.1).abs() < 1e-12);
        assert!(traction.is_none() && rise.is_none() && load_share.is_none());
    }

    #[test]
    fn overheated_films_are_not_compared() {
        let sliding = Sliding { slide_to_roll_ratio: 0.2, newtonian_plateau_ratio: None };
        let point = OperatingPoint { sliding, ..OperatingPoint::TABLE_2_1 };
        let grid = GridSpec::Graded { nodes: 200, domain: (-6.0, 2.5), registered: false };
        let solved = |inlet_temperature: f64| {
            let lubricant =
                Lubricant { heat: Some(Heat { inlet_temperature, ..Heat::default() }), ..Lubricant::default() };
            let solution = FullSolver::new(grid).unwrap().solve(&point, lubricant, Start::Cold, &()).unwrap();
            let rise = solution.heat.as_ref().unwrap().largest.mid_film_k;
            (Film::of_full(&solution), inlet_temperature + rise)
        };
        let ((warm, below), (hot, above)) = (solved(313.0), solved(500.0));
        assert!(below < 573.0 && warm.errors(&warm).iter().take(4).all(Option::is_some), "{below}");
        assert!(above > 573.0 && warm.errors(&hot).iter().all(Option::is_none), "{above}");
    }
}
