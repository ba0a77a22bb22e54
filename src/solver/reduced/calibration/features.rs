//! What is known of a reduced solution, and what was measured of it.

use crate::solver::parameters::{Quantity, Scale};
use crate::solver::physics::contact::{Moes, OperatingPoint};
use crate::solver::reduced::{Domain, ReducedSolution};

/// Features of every reduced solution: ln M, L, ln α, ln e_f^I, and the logarithm of the last modes' share.
pub(super) const FEATURES: usize = 5;
/// Most features.
pub(super) const MOST_FEATURES: usize = FEATURES + MOST_FURTHER;
/// Most features beside these.
const MOST_FURTHER: usize = 6;
/// Errors of every reduced solution: of H_c, H_min and the state.
pub(super) const ERRORS: usize = 3;
/// The two features among them that are no place but a sign of the error.
pub(super) const SIGNS: std::ops::Range<usize> = 3..5;
/// Modes at the end of the basis whose share is a sign of what it lacks.
const LAST_MODES: usize = 3;
/// Sliding below this is told apart no further: relative errors of a traction that is next to nothing are larger than
/// those of others.
const SLOW: f64 = 0.01;
/// A share of the traction that is cut is told apart no further than this: what is cut everywhere goes with the load, which
/// is met exactly, and what is cut nowhere with the film.
const LITTLE: f64 = 1e-3;
/// Nor is a rise of temperature \[K\].
const COOL_K: f64 = 1.0;

/// One measured case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evidence {
    /// What was known of the reduced solution.
    pub features: Features,
    /// Measured relative errors.
    pub errors: Measured,
}

/// Measured relative errors of a reduced solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// Of H_c.
    pub h_c: f64,
    /// Of H_min.
    pub h_min: f64,
    /// Of the state, e_z.
    pub state: f64,
    /// Of the traction coefficient; not where nothing slides, the traction has no meaning, or the model has no rule for
    /// it.
    pub traction: Option<f64>,
    /// Of the rise of temperature at mid-film, X = 0, of contacts with heat.
    pub rise: Option<f64>,
}

impl Measured {
    /// The first errors: of H_c, H_min, state, traction, and the temperature rise.
    pub(super) fn values(&self, count: usize) -> impl Iterator<Item = f64> {
        let known = |value: Option<f64>| value.unwrap_or(f64::NAN);
        [self.h_c, self.h_min, self.state, known(self.traction), known(self.rise)].into_iter().take(count)
    }
}

/// A feature that some models have beside those of every one.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Feature {
    /// ln(|SRR| + 0.01).
    Sliding,
    /// NPR, or another quantity as it is.
    Linear(Quantity),
    /// The logarithm of a quantity.
    Log(Quantity),
    /// The logarithm of the temperature rise at mid-film.
    Rise,
    /// The logarithm of the share of traction that a limiting stress cuts.
    Cut,
}

/// The features and errors of a model's calibration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeatureSet {
    further: [Option<Feature>; MOST_FURTHER],
    /// Errors that are estimated: of H_c, H_min, state, then traction, then the temperature rise.
    pub(super) errors: usize,
}

/// Quantities whose features are named below, or are among those of every solution.
const NAMED: [Quantity; 9] = [
    Quantity::M,
    Quantity::L,
    Quantity::Alpha,
    Quantity::Viscosity,
    Quantity::Radius,
    Quantity::Modulus,
    Quantity::SlideToRollRatio,
    Quantity::NewtonianPlateauRatio,
    Quantity::RadiusRatio,
];

impl FeatureSet {
    /// Those of a model's domain.
    pub fn of(domain: &Domain) -> Self {
        let (space, heat, slides) = (&domain.space, domain.heats(), domain.slides());
        let lubricants = space.varies_lubricant() && !heat;
        let stresses = lubricants && domain.thins();
        let warmth = heat && space.knows(Quantity::Speed);
        let first = [
            (slides, Feature::Sliding),
            (slides && space.varies(Quantity::NewtonianPlateauRatio), Feature::Linear(Quantity::NewtonianPlateauRatio)),
            (warmth, Feature::Log(Quantity::Speed)),
            (warmth, Feature::Rise),
            (lubricants, Feature::Linear(Quantity::RoelandsExponent)),
            (stresses, Feature::Log(Quantity::StressUnit)),
            (stresses, Feature::Cut),
            (space.of_ellipses(), Feature::Log(Quantity::RadiusRatio)),
        ];
        let first = first.into_iter().filter(|(has, _)| *has).map(|(_, feature)| feature);
        let other = space.axes.iter().filter(|axis| !space.is_si_box() && !NAMED.contains(&axis.quantity));
        let other = other.map(|axis| match axis.scale {
            Scale::Linear => Feature::Linear(axis.quantity),
            Scale::Log => Feature::Log(axis.quantity),
        });
        let mut further = [None; MOST_FURTHER];
        further.iter_mut().zip(first.chain(other)).for_each(|(place, feature)| *place = Some(feature));
        Self { further, errors: ERRORS + usize::from(slides) + usize::from(heat) }
    }

    /// Returns the number of features.
    pub(super) fn count(&self) -> usize {
        FEATURES + self.further.iter().flatten().count()
    }
}

/// What is cheap to know of a reduced solution: ln M, L, ln α, ln e_f^I, the last modes' share, and what the model's
/// [`FeatureSet`] adds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Features {
    pub(super) values: [f64; MOST_FEATURES],
    pub(super) count: usize,
    pub(super) errors: usize,
}

impl Features {
    /// Returns the features of a reduced solution, given the contact that it is to the model.
    pub fn of(solution: &ReducedSolution, point: &OperatingPoint, set: &FeatureSet) -> Self {
        let ReducedSolution { coefficients, residual_estimate: residual, .. } = solution;
        let Moes { m, l } = point.moes();
        let norm = |c: &[f64]| c.iter().map(|v| v * v).sum::<f64>().sqrt();
        // Modes that an iteration was tried without are no sign.
        let used = coefficients.iter().rposition(|c| *c != 0.0).map_or(0, |last| last + 1);
        let last = norm(&coefficients[used.saturating_sub(LAST_MODES)..used]) / norm(coefficients);
        let (residual, last) = (residual.max(1e-300).ln(), last.max(1e-300).ln());
        let further = |feature: &Feature| match feature {
            Feature::Sliding => (point.sliding.slide_to_roll_ratio.abs() + SLOW).ln(),
            Feature::Linear(quantity) => quantity.of(point).unwrap_or(1.0),
            Feature::Log(quantity) => quantity.of(point).unwrap_or(1.0).ln(),
            Feature::Rise => {
                let rise = solution.heat.as_ref().map_or(0.0, |heat| heat.central.mid_film_k.abs());
                (rise + COOL_K).ln()
            }
            Feature::Cut => (solution.cut.filter(|cut| cut.is_finite()).unwrap_or(0.0) + LITTLE).ln(),
        };
        let mut values = [0.0; MOST_FEATURES];
        let every = [m.ln(), l, point.alpha_per_pa.ln(), residual, last];
        let own = every.into_iter().chain(set.further.iter().flatten().map(further));
        values.iter_mut().zip(own).for_each(|(place, value)| *place = value);
        Self { values, count: set.count(), errors: set.errors }
    }

    pub(super) fn finite(&self) -> bool {
        self.values.iter().take(self.count).all(|v| v.is_finite())
    }
}
