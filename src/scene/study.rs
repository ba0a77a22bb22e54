//! The questions a scene can ask.

use super::{Method, ModelSource, TpwlStudy, TransientStudy};
use crate::solver::contact::{ContactKind, FilmFormula, OperatingPoint, Sliding};
use crate::solver::reduced::{Norm, ReducedOptions, Sampling};
use crate::solver::training::{SlidingRange, TrainingSpec};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;
use std::path::PathBuf;

/// What is asked of a scene's contact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Study {
    /// The contact itself.
    Point {
        /// How it is solved.
        methods: Vec<Method>,
    },
    /// The contact along one to three varied quantities, the last one fastest; each solve starts from its neighbour.
    Sweep {
        /// What is varied.
        over: Vec<Axis>,
        /// How each point is solved.
        methods: Vec<Method>,
        /// Whether full solves start cold instead.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        cold: bool,
    },
    /// The test trajectory (3.21) through a box, 0 ≤ c ≤ 2.
    Trajectory {
        /// The box.
        range: QuantityBox,
        /// Equidistant values of c, both ends counted.
        points: usize,
        /// How each point is solved.
        methods: Vec<Method>,
    },
    /// Random points (3.17): how often a method fails, how fast it is, and how far a reduced model lies from full solutions.
    RandomTest {
        /// Where the points are drawn.
        range: TestRange,
        /// How many.
        tests: usize,
        /// Seed of the random numbers: the same seed gives the same points.
        seed: u64,
        /// What is tested; a full method starts cold.
        method: Method,
        /// Full solutions on the model's own grid are compared at this many of the points.
        #[serde(default)]
        compare: usize,
    },
    /// Where a reduced model's error comes from: its basis, Galerkin's projection, the sampling of rows, or the grid.
    ErrorSplit {
        /// Where it is split.
        contacts: Contacts,
        /// The reduced model.
        method: Method,
    },
    /// The contact on ever finer uniform grids over the scene's domain: observed order and extrapolated value. A point contact keeps ΔY.
    GridStudy {
        /// Spacings ΔX, falling by one constant factor; at least three.
        dx: Vec<f64>,
    },
    /// How many modes the full solutions at all combinations of one to three varied quantities need at losses of information: Table 3.7.
    Dimensions {
        /// What is varied.
        over: Vec<Axis>,
        /// Losses of information, (2.92) and (2.93).
        losses: Vec<f64>,
    },
    /// Training of a reduced model.
    Training(TrainingSpec),
    /// Error measures (3.10), (3.14), (3.15) of a reduced model at random points (3.17), ordered by the true error: Fig. 3.1.
    ErrorMeasures {
        /// Where the points are drawn.
        range: TestRange,
        /// How many.
        points: usize,
        /// Seed of the random numbers.
        seed: u64,
        /// The measured model.
        model: ModelSource,
        /// Its online scheme.
        #[serde(default)]
        online: OnlineScheme,
        /// The norm of states and residuals.
        #[serde(default)]
        norm: Norm,
    },
    /// Weights of the distance measure by (3.9) from full solutions at random points (3.17): (3.20).
    DistanceMeasure {
        /// Where the points are drawn.
        range: TestRange,
        /// How many.
        points: usize,
        /// Seed of the random numbers.
        seed: u64,
    },
    /// Plans of snapshot selection side by side: Tables 3.2 and 3.3, Figs. 3.3 to 3.5 and 3.7.
    PlanComparison {
        /// The plans.
        plans: Vec<ComparedPlan>,
        /// The box of random tests (3.17) and of the trajectory (3.21).
        range: QuantityBox,
        /// Random tests of each.
        tests: usize,
        /// Seed of the random tests.
        seed: u64,
        /// Full solutions are compared at this many of them.
        compare: usize,
        /// Points along the trajectory.
        trajectory: usize,
        /// Online scheme of all of them.
        #[serde(default)]
        online: OnlineScheme,
    },
    /// An adaptive training cut at each tolerance of its ladder: Fig. 3.6.
    ToleranceStudy {
        /// The scene of the training; relative paths refer to this scene's folder.
        training: PathBuf,
        /// The box of random tests (3.17) and of the trajectory (3.21).
        range: QuantityBox,
        /// Points along the trajectory, each with a full solution.
        points: usize,
        /// Random tests of each cut.
        tests: usize,
        /// Seed of the random tests.
        seed: u64,
        /// Online scheme.
        #[serde(default)]
        online: OnlineScheme,
    },
    /// Ways of sampling rows, on the same full solutions and basis.
    SamplingComparison {
        /// The scene of the training; relative paths refer to this scene's folder.
        training: PathBuf,
        /// The ways.
        samplings: Vec<ComparedSampling>,
        /// The box of random tests (3.17).
        range: QuantityBox,
        /// Random tests of each.
        tests: usize,
        /// Seed of the random tests.
        seed: u64,
        /// Full solutions are compared at this many of them.
        compare: usize,
    },
    /// The contact in time, under inputs that vary: Figs. 2.6 (right), 4.4, 4.14, 4.15.
    Transient(TransientStudy),
    /// Trajectory-piecewise-linear models of the contact in time: Figs. 4.10 to 4.12, 4.15 to 4.18.
    Tpwl(TpwlStudy),
    /// Full solutions against a published film formula at all pairs of M and L in the default realisation.
    FormulaComparison {
        /// The formula.
        formula: Formula,
        /// Load numbers.
        m: Vec<f64>,
        /// Lubricant numbers.
        l: Vec<f64>,
    },
}

/// Which contacts a study looks at.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Contacts {
    /// The scene's own operating point.
    Here,
    /// The test trajectory (3.21) through a box, 0 ≤ c ≤ 2.
    Trajectory {
        /// The box.
        range: QuantityBox,
        /// Equidistant values of c, both ends counted.
        points: usize,
    },
}

/// One of the compared plans.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ComparedPlan {
    /// Its name in results.
    pub name: String,
    /// The scene of its training; relative paths refer to this scene's folder.
    pub training: PathBuf,
    /// Failure rate as published \[%\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub published_failure_percent: Option<f64>,
}

/// One of the compared ways of sampling rows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ComparedSampling {
    /// Its name in results.
    pub name: String,
    /// How rows are sampled.
    pub sampling: Sampling,
    /// Sampled rows per pressure mode.
    pub rows_per_mode: f64,
    /// Penalty factor γ̄ of the reduced equations.
    pub penalty: f64,
}

/// How a reduced model is solved online.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Default)]
pub enum OnlineScheme {
    /// The explorer's: exact deformation operator, several starts, continuation.
    #[default]
    Explorer,
    /// The dissertation's: δ̃ in the state, the nearest snapshot by (3.20) as the only start.
    Dissertation,
}

/// One varied quantity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Axis {
    /// What is varied.
    pub vary: Variable,
    /// Its values.
    pub values: Steps,
}

/// A quantity that a sweep can vary.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Variable {
    /// Load number M; needs an operating point given by Moes numbers.
    M,
    /// Lubricant number L; needs an operating point given by Moes numbers.
    L,
    /// Reduced radius \[m\].
    Radius,
    /// Entrainment speed \[m/s\].
    Speed,
    /// Load \[N/m\].
    Load,
    /// Reduced modulus \[Pa\].
    Modulus,
    /// Viscosity \[Pa·s\].
    Viscosity,
    /// Pressure–viscosity coefficient \[1/Pa\].
    Alpha,
    /// Slide-to-roll ratio SRR.
    SlideToRollRatio,
    /// Newtonian plateau ratio NPR.
    NewtonianPlateauRatio,
}

/// Values of a varied quantity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Steps {
    /// Equidistant, both ends counted.
    Linear {
        /// First value.
        from: f64,
        /// Last value.
        to: f64,
        /// How many.
        n: usize,
    },
    /// With a constant ratio, both ends counted.
    Log {
        /// First value.
        from: f64,
        /// Last value.
        to: f64,
        /// How many.
        n: usize,
    },
    /// As listed.
    List(Vec<f64>),
}

/// Intervals of R, u_m, w and α at fixed E′ and η₀, as Table 3.1 gives them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct QuantityBox {
    /// Radius \[m\].
    pub radius: (f64, f64),
    /// Speed \[m/s\].
    pub speed: (f64, f64),
    /// Load \[N/m\] (line) or \[N\] (point).
    pub load: (f64, f64),
    /// Pressure–viscosity coefficient \[1/Pa\].
    pub alpha: (f64, f64),
    /// Reduced modulus \[Pa\].
    pub modulus: f64,
    /// Viscosity at ambient pressure \[Pa·s\].
    pub viscosity: f64,
}

/// Where random points are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum TestRange {
    /// A box of SI quantities, (3.17) in each.
    Box(QuantityBox),
    /// M and L in the default realisation, (3.17) in ln M and L; points beyond the pressure are drawn again.
    Realisation {
        /// Load number.
        m: (f64, f64),
        /// Lubricant number.
        l: (f64, f64),
        /// Largest Hertzian pressure \[Pa\].
        max_hertz_pressure: f64,
    },
    /// M, L and α at the default R (3 mm line, 10 mm point) and E′ = 231 GPa, (3.17) in ln M, L and α; points beyond the pressure are drawn again.
    Moes {
        /// Load number.
        m: (f64, f64),
        /// Lubricant number.
        l: (f64, f64),
        /// Pressure–viscosity coefficient \[1/Pa\].
        alpha: (f64, f64),
        /// Largest Hertzian pressure \[Pa\].
        max_hertz_pressure: f64,
        /// Viscosity at ambient pressure \[Pa·s\].
        viscosity: f64,
    },
    /// M, L, SRR and NPR of a shear-thinning lubricant, (3.17) in ln M, L, SRR and NPR; points beyond the pressure are drawn again.
    Sliding(SlidingRange),
}

/// A published film formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Formula {
    /// Moes, central film.
    Moes,
    /// Dowson & Higginson, minimum film.
    DowsonHigginson,
    /// Dowson & Toyoda, central film.
    DowsonToyoda,
    /// Hamrock & Dowson, point contact, central film.
    HamrockDowsonCentral,
    /// Hamrock & Dowson, point contact, minimum film.
    HamrockDowsonMinimum,
    /// Nijenbanning, Venner & Moes, point contact, central film.
    NijenbanningVennerMoes,
}

impl Study {
    /// The methods it uses, in order.
    pub fn methods(&self) -> &[Method] {
        match self {
            Self::Point { methods } | Self::Sweep { methods, .. } | Self::Trajectory { methods, .. } => methods,
            Self::RandomTest { method, .. } | Self::ErrorSplit { method, .. } => std::slice::from_ref(method),
            Self::GridStudy { .. }
            | Self::Dimensions { .. }
            | Self::Training(_)
            | Self::FormulaComparison { .. }
            | Self::ErrorMeasures { .. }
            | Self::DistanceMeasure { .. }
            | Self::PlanComparison { .. }
            | Self::ToleranceStudy { .. }
            | Self::SamplingComparison { .. }
            | Self::Transient(_)
            | Self::Tpwl(_) => &[],
        }
    }

    /// The reduced model whose grid [`Grid::Model`](super::Grid::Model) means: the first one used, else the embedded one.
    pub fn grid_model(&self) -> ModelSource {
        self.methods().iter().find_map(Method::model).cloned().unwrap_or_default()
    }
}

impl OnlineScheme {
    /// The solver's options for it.
    pub fn options(self) -> ReducedOptions {
        match self {
            Self::Explorer => ReducedOptions::default(),
            Self::Dissertation => ReducedOptions::dissertation(),
        }
    }
}

impl Variable {
    /// The word that stands for it in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::M => "M",
            Self::L => "L",
            Self::Radius => "radius",
            Self::Speed => "speed",
            Self::Load => "load",
            Self::Modulus => "modulus",
            Self::Viscosity => "viscosity",
            Self::Alpha => "alpha",
            Self::SlideToRollRatio => "srr",
            Self::NewtonianPlateauRatio => "npr",
        }
    }

    /// Smallest and largest accepted value.
    pub fn range(self) -> (f64, f64) {
        match self {
            Self::SlideToRollRatio => (-10.0, 10.0),
            Self::NewtonianPlateauRatio => (0.0, 1.0),
            _ => (f64::MIN_POSITIVE, 1e15),
        }
    }
}

impl Steps {
    /// How many values there are.
    pub fn len(&self) -> usize {
        match self {
            Self::Linear { n, .. } | Self::Log { n, .. } => *n,
            Self::List(values) => values.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The values; both ends are hit exactly.
    pub fn values(&self) -> Vec<f64> {
        let spaced = |from: f64, to: f64, n: usize, at: &dyn Fn(f64) -> f64| {
            (0..n)
                .map(|i| match i {
                    0 => from,
                    i if i + 1 == n => to,
                    i => at(i as f64 / (n - 1) as f64),
                })
                .collect()
        };
        match *self {
            Self::Linear { from, to, n } => spaced(from, to, n, &|t| from + (to - from) * t),
            Self::Log { from, to, n } => spaced(from, to, n, &|t| from * (to / from).powf(t)),
            Self::List(ref values) => values.clone(),
        }
    }
}

impl QuantityBox {
    /// Table 3.1 of the dissertation.
    pub const TABLE_3_1: Self = Self {
        radius: (2e-3, 4e-3),
        speed: (1.0, 10.0),
        load: (1e5, 5e5),
        alpha: (5e-9, 20e-9),
        modulus: 231e9,
        viscosity: 0.01,
    };

    /// The dissertation's box for a kind of contact.
    pub fn of_tables(kind: ContactKind) -> Self {
        match kind {
            ContactKind::Line => Self::TABLE_3_1,
            ContactKind::Point => Self::TABLE_3_4,
        }
    }

    /// The dissertation's Table 3.4, whose printed radii and loads contradict its M and L: with these they hold.
    pub const TABLE_3_4: Self = Self {
        radius: (10e-3, 20e-3),
        speed: (1.0, 10.0),
        load: (20.0, 100.0),
        alpha: (5e-9, 20e-9),
        modulus: 231e9,
        viscosity: 0.01,
    };

    /// The point of a kind at fractions (0…1) of radius, speed, load and alpha.
    pub fn at(&self, kind: ContactKind, [radius, speed, load, alpha]: [f64; 4]) -> OperatingPoint {
        let between = |(low, high): (f64, f64), t: f64| low + (high - low) * t;
        OperatingPoint {
            kind,
            radius_m: between(self.radius, radius),
            speed_m_per_s: between(self.speed, speed),
            load: between(self.load, load),
            modulus_pa: self.modulus,
            viscosity_pa_s: self.viscosity,
            alpha_per_pa: between(self.alpha, alpha),
            sliding: Sliding::NONE,
        }
    }

    /// The point of the test trajectory (3.21) at the running parameter c.
    pub fn trajectory(&self, kind: ContactKind, c: f64) -> OperatingPoint {
        let wave = |halves: f64| 0.5 + 0.5 * (halves * PI * c).sin();
        self.at(kind, [wave(3.0), wave(4.0), wave(5.0), wave(2.0)])
    }
}

impl Formula {
    /// The solver's name for it.
    pub fn film_formula(self) -> FilmFormula {
        match self {
            Self::Moes => FilmFormula::MoesLine,
            Self::DowsonHigginson => FilmFormula::DowsonHigginson,
            Self::DowsonToyoda => FilmFormula::DowsonToyoda,
            Self::HamrockDowsonCentral => FilmFormula::HamrockDowsonCentral,
            Self::HamrockDowsonMinimum => FilmFormula::HamrockDowsonMinimum,
            Self::NijenbanningVennerMoes => FilmFormula::NijenbanningVennerMoes,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_trajectory_starts_in_the_middle_and_stays_in_the_box() {
        let range = QuantityBox::TABLE_3_1;
        let middle = [3e-3, 5.5, 3e5, 231e9, 0.01, 12.5e-9];
        assert!(
            range
                .trajectory(ContactKind::Line, 0.0)
                .quantities()
                .iter()
                .zip(middle)
                .all(|(q, m)| (q / m - 1.0).abs() < 1e-14)
        );
        for i in 0..=1000 {
            let point = range.trajectory(ContactKind::Line, i as f64 / 500.0);
            assert!((2e-3..=4e-3).contains(&point.radius_m) && (1e5..=5e5).contains(&point.load));
        }
    }

    #[test]
    fn steps_hit_both_ends() {
        assert_eq!(Steps::Linear { from: 1.0, to: 2.0, n: 3 }.values(), [1.0, 1.5, 2.0]);
        let log = Steps::Log { from: 1.0, to: 100.0, n: 3 }.values();
        assert!(log[0] == 1.0 && (log[1] - 10.0).abs() < 1e-12 && log[2] == 100.0);
        assert_eq!(Steps::Linear { from: 7.0, to: 9.0, n: 1 }.values(), [7.0]);
    }
}
