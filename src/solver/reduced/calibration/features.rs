//! What is known of a reduced solution, and what was measured of it.

use crate::solver::physics::contact::{Moes, OperatingPoint};
use crate::solver::physics::lubricant::roelands_exponent;
use crate::solver::reduced::ReducedSolution;
use crate::solver::reduced::domain::{CIRCLES, Domain};

/// Features of a contact without sliding: ln M, L, ln α, ln e_f^I, and the logarithm of the last modes' share.
pub(super) const FEATURES: usize = 5;
/// Those of one in a model that knows ellipses: ln(R_y/R) as well; or many oils: Roelands' exponent; or heat: ln(|SRR| +
/// 0.01).
pub(super) const ONE_MORE: usize = FEATURES + 1;
/// Those of one in a model that knows sliding: ln(|SRR| + 0.01) and NPR as well.
pub(super) const SLIDING_FEATURES: usize = FEATURES + 2;
/// Those of one in a model of heat of many oils: ln(|SRR| + 0.01), ln u_m and by how much the film warms.
pub(super) const HEATED_FEATURES: usize = FEATURES + 3;
/// Those of one in a model of many oils that thin under shear: Roelands' exponent, ln(|SRR| + 0.01), ln(p_H a/R) and by how
/// much a limiting stress cuts the traction.
pub(super) const MOST_FEATURES: usize = FEATURES + 4;
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
    /// H_c, H_min, state, of evidence about sliding and heat traction, and of that about heat the rise.
    pub(super) fn values(&self, beside: Beside) -> impl Iterator<Item = f64> {
        let known = |value: Option<f64>| value.unwrap_or(f64::NAN);
        [self.h_c, self.h_min, self.state, known(self.traction), known(self.rise)].into_iter().take(beside.quantities())
    }
}

/// What the contacts of a model have beside M, L and α.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beside {
    /// Nothing.
    Nothing,
    /// R_y/R.
    Shape,
    /// Roelands' exponent.
    Oil,
    /// SRR and NPR.
    Sliding,
    /// SRR, and heat.
    Heat,
    /// SRR and u_m, and heat.
    HeatOfOils,
    /// Roelands' exponent, SRR and stresses.
    SlidingOfOils,
}

impl Beside {
    /// All of them.
    pub(super) const ALL: [Self; 7] =
        [Self::Nothing, Self::Shape, Self::Oil, Self::Sliding, Self::Heat, Self::HeatOfOils, Self::SlidingOfOils];

    /// Those of a model's domain.
    pub fn of(domain: &Domain) -> Self {
        if domain.eyring.is_some() {
            return Self::SlidingOfOils;
        }
        match (domain.heat, domain.sliding, domain.oils) {
            (Some(_), _, Some(_)) => Self::HeatOfOils,
            (Some(_), _, None) => Self::Heat,
            (None, Some(_), _) => Self::Sliding,
            (None, None, Some(_)) => Self::Oil,
            (None, None, None) if domain.radius_ratio == CIRCLES => Self::Nothing,
            (None, None, None) => Self::Shape,
        }
    }

    /// The number of features.
    pub(super) fn features(self) -> usize {
        match self {
            Self::Nothing => FEATURES,
            Self::Shape | Self::Oil | Self::Heat => ONE_MORE,
            Self::Sliding => SLIDING_FEATURES,
            Self::HeatOfOils => HEATED_FEATURES,
            Self::SlidingOfOils => MOST_FEATURES,
        }
    }

    /// Whether a calibration may have so many features: those of former versions lack the last one of many oils.
    pub(super) fn has_had(self, features: usize) -> bool {
        let former = matches!(self, Self::HeatOfOils | Self::SlidingOfOils);
        features == self.features() || former && features + 1 == self.features()
    }

    /// The number of errors that are told: of H_c, H_min, state, then traction, then the rise of temperature.
    pub(super) fn quantities(self) -> usize {
        match self {
            Self::Nothing | Self::Shape | Self::Oil => 3,
            Self::Sliding | Self::SlidingOfOils => 4,
            Self::Heat | Self::HeatOfOils => 5,
        }
    }
}

/// What is cheap to know of a reduced solution: ln M, L, ln α, ln e_f^I, the last modes' share, of a model that knows
/// sliding ln(|SRR| + 0.01) and NPR, of one that knows ellipses ln(R_y/R), of heat of many oils ln(|SRR| + 0.01), ln u_m and
/// the logarithm of the rise at mid-film, and of many oils that thin under shear ln(|SRR| + 0.01), Roelands' exponent,
/// ln(p_H a/R) of the contact with the trained stress and the logarithm of the share of traction that is cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Features {
    pub(super) values: [f64; MOST_FEATURES],
    pub(super) beside: Beside,
}

impl Features {
    /// The features of a reduced solution in a model whose contacts have so much beside M, L and α, to which it is the
    /// contact at this point.
    pub fn of(solution: &ReducedSolution, point: &OperatingPoint, beside: Beside) -> Self {
        let ReducedSolution { coefficients, residual_estimate: residual, .. } = solution;
        let Moes { m, l } = point.moes();
        let norm = |c: &[f64]| c.iter().map(|v| v * v).sum::<f64>().sqrt();
        // Modes that an iteration was tried without are no sign.
        let used = coefficients.iter().rposition(|c| *c != 0.0).map_or(0, |last| last + 1);
        let last = norm(&coefficients[used.saturating_sub(LAST_MODES)..used]) / norm(coefficients);
        let srr = (point.sliding.slide_to_roll_ratio.abs() + SLOW).ln();
        let npr = point.sliding.newtonian_plateau_ratio.unwrap_or(1.0);
        let (residual, last) = (residual.max(1e-300).ln(), last.max(1e-300).ln());
        let rise = solution.heat.as_ref().map_or(0.0, |heat| heat.central.mid_film_k.abs());
        let cut = solution.cut.filter(|cut| cut.is_finite()).unwrap_or(0.0);
        let [first, second, third, fourth] = match beside {
            Beside::Shape => [point.radius_ratio().ln(), 0.0, 0.0, 0.0],
            Beside::Oil => [roelands_exponent(point), 0.0, 0.0, 0.0],
            Beside::HeatOfOils => [srr, point.speed_m_per_s.ln(), (rise + COOL_K).ln(), 0.0],
            Beside::SlidingOfOils => {
                [srr, roelands_exponent(point), point.gradient_stress_pa().ln(), (cut + LITTLE).ln()]
            }
            Beside::Nothing | Beside::Sliding | Beside::Heat => [srr, npr, 0.0, 0.0],
        };
        Self { values: [m.ln(), l, point.alpha_per_pa.ln(), residual, last, first, second, third, fourth], beside }
    }

    pub(super) fn used(&self) -> &[f64] {
        &self.values[..self.beside.features()]
    }

    pub(super) fn finite(&self) -> bool {
        self.used().iter().all(|v| v.is_finite())
    }
}
