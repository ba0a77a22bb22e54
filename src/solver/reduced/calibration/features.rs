//! Features of a reduced solution, and its measured errors.

use crate::solver::parameters::{Quantity, Scale};
use crate::solver::physics::contact::{Moes, OperatingPoint};
use crate::solver::reduced::{Domain, ReducedSolution};

/// Number of features of every reduced solution: ln M, L, ln α, ln e_f^I (Moes parameters M and L, pressure–viscosity
/// coefficient α, residual e_f^I), and the logarithm of the last modes' share.
pub(super) const FEATURES: usize = 5;
/// Maximum number of features.
pub(super) const MOST_FEATURES: usize = FEATURES + MOST_FURTHER;
/// Maximum number of features in addition to these.
const MOST_FURTHER: usize = 6;
/// Number of errors of every reduced solution: of the film thicknesses H_c and H_min and of the state.
pub(super) const ERRORS: usize = 3;
/// The two features that indicate the error directly and are not part of the position.
pub(super) const SIGNS: std::ops::Range<usize> = 3..5;
/// Number of modes at the end of the basis whose share indicates what the basis lacks.
const LAST_MODES: usize = 3;
/// Value added to |SRR| before the logarithm. Tractions of nearly zero sliding have larger relative errors.
const SLOW: f64 = 0.01;
/// Value added to the share of traction that a limiting stress removes, before the logarithm. A fully limited
/// traction follows the load, which is met exactly, and an unlimited one the film.
const LITTLE: f64 = 1e-3;
/// Temperature rise \[K\] added before the logarithm.
const COOL_K: f64 = 1.0;

/// Error that the calibrations of some models estimate in addition to the three of all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FurtherError {
    /// Traction coefficient; for rough surfaces that of the film.
    Traction,
    /// Mid-film temperature rise.
    Rise,
    /// Asperity load share.
    LoadShare,
}

/// One measured case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evidence {
    /// Features of the reduced solution.
    pub features: Features,
    /// Measured relative errors.
    pub errors: Measured,
}

/// Measured relative errors of a reduced solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// Error of the central film thickness H_c; for rough surfaces relative to σ/2 if H_c is smaller.
    pub h_c: f64,
    /// Error of the minimum film thickness H_min, relative to the same.
    pub h_min: f64,
    /// Error of the state, e_z.
    pub state: f64,
    /// Error of the traction coefficient; for rough surfaces of the film's. `None` without sliding, if the traction is
    /// unphysical, or if the model has no traction quadrature.
    pub traction: Option<f64>,
    /// Error of the mid-film temperature rise at X = 0 of thermal contacts.
    pub rise: Option<f64>,
    /// Absolute error of the asperity load share of rough surfaces.
    pub load_share: Option<f64>,
}

impl Measured {
    /// Returns the errors of every solution: of H_c, H_min and state.
    pub(super) fn of_every_solution(&self) -> [f64; ERRORS] {
        [self.h_c, self.h_min, self.state]
    }

    /// Returns these errors and further ones; NaN if not measured.
    pub(super) fn values(&self, further: &'static [FurtherError]) -> impl Iterator<Item = f64> {
        let further = further.iter().map(|error| match error {
            FurtherError::Traction => self.traction,
            FurtherError::Rise => self.rise,
            FurtherError::LoadShare => self.load_share,
        });
        self.of_every_solution().into_iter().chain(further.map(|value| value.unwrap_or(f64::NAN)))
    }
}

/// Feature of some models in addition to those of all.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Feature {
    /// ln(|SRR| + 0.01).
    Sliding,
    /// NPR (Newtonian plateau ratio), or another quantity as it is.
    Linear(Quantity),
    /// Logarithm of a quantity.
    Log(Quantity),
    /// Logarithm of the mid-film temperature rise.
    Rise,
    /// Logarithm of the share of traction that a limiting stress removes.
    Cut,
}

/// Features and errors of a model's calibration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeatureSet {
    further: [Option<Feature>; MOST_FURTHER],
    /// Estimated errors in addition to those of H_c, H_min and state, in the order of their laws.
    pub(super) errors: &'static [FurtherError],
}

/// Quantities that are listed below, or are features of every solution.
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
    /// Returns the features of a model with this domain.
    pub fn of(domain: &Domain) -> Self {
        let (space, heat, slides) = (&domain.space, domain.heats(), domain.slides());
        let lubricants = space.varies_lubricant() && !heat;
        let stresses = lubricants && domain.is_shear_thinning();
        let warmth = heat && space.knows(Quantity::Speed);
        let first = [
            (slides || domain.is_rough(), Feature::Sliding),
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
        let errors: &[FurtherError] = match (domain.is_rough(), heat, slides) {
            (true, ..) => &[FurtherError::Traction, FurtherError::LoadShare],
            (_, true, _) => &[FurtherError::Traction, FurtherError::Rise],
            (_, _, true) => &[FurtherError::Traction],
            _ => &[],
        };
        Self { further, errors }
    }

    /// Returns the number of features.
    pub(super) fn count(&self) -> usize {
        FEATURES + self.further.iter().flatten().count()
    }
}

/// Features of a reduced solution: ln M, L, ln α, ln e_f^I, the last modes' share, and those of the model's
/// [`FeatureSet`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Features {
    pub(super) values: [f64; MOST_FEATURES],
    pub(super) count: usize,
    pub(super) errors: &'static [FurtherError],
}

impl Features {
    /// Returns the features of a reduced solution. `point` is the contact as the model solves it.
    pub fn of(solution: &ReducedSolution, point: &OperatingPoint, set: &FeatureSet) -> Self {
        let ReducedSolution { coefficients, residual_estimate: residual, .. } = solution;
        let Moes { m, l } = point.moes();
        let norm = |c: &[f64]| c.iter().map(|v| v * v).sum::<f64>().sqrt();
        // Modes that the iteration did not use are ignored.
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
