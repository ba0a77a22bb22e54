//! Generalised Newtonian laws: the dependence of the viscosity on the shear stress, and the limiting shear stress.
//!
//! Every law is a factor F(τ/τ₀) ≤ 1 on the low-shear viscosity μ, explicit in the effective shear stress τ with the
//! stress scale τ₀. It is combined with a second Newtonian plateau as in (3.40): η = μ(p) \[NPR + (1 − NPR) F\]. NPR
//! is the Newtonian plateau ratio. The film integrals (3.24) use the fluidity μ/η.

use super::elementary;
use super::error::{LubricantError, check_constant};
use crate::solver::physics::contact::{OperatingPoint, Sliding};
use serde::{Deserialize, Serialize};

/// Dependence of the viscosity on the shear stress. `npr` is the lubricant's Newtonian plateau ratio, used unless the
/// operating conditions give one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, Default)]
pub enum ShearLaw {
    /// η = μ.
    #[default]
    Newtonian,
    /// Modified Carreau law (3.40): F = (1 + (τ/G_c)^β)^((1 − 1/n)/β); Carreau 1972, as modified by Bair 2004.
    Carreau {
        /// Critical shear stress G_c \[Pa\].
        critical_stress: f64,
        /// Exponent β_c \[-\], which sets the width of the transition.
        beta: f64,
        /// Power-law exponent n_c \[-\], in (0, 1\].
        n: f64,
        /// Newtonian plateau ratio \[-\].
        #[serde(default)]
        npr: f64,
    },
    /// Ellis' law, F = 1/(1 + (τ/G)^(1/n − 1)): a Newtonian plateau followed by a power law. It is Cross's law (1965)
    /// written in stress instead of rate; Matsuhisa & Bird 1965.
    Ellis {
        /// Shear stress G \[Pa\] at which the viscosity has fallen to one half.
        critical_stress: f64,
        /// Power-law exponent n \[-\], in (0, 1\].
        n: f64,
        /// Newtonian plateau ratio \[-\].
        #[serde(default)]
        npr: f64,
    },
    /// Ree & Eyring 1955, F = (τ/τ_E)/sinh(τ/τ_E); in lubrication since Johnson & Tevaarwerk 1977.
    Eyring {
        /// Eyring stress τ_E \[Pa\].
        critical_stress: f64,
        /// Newtonian plateau ratio \[-\].
        #[serde(default)]
        npr: f64,
    },
}

/// Limiting shear stress of a film, τ_L = τ_L0 + Λ p, beyond which the lubricant slips or yields; Bair & Winer 1979.
/// It limits traction only. Pressure and film thickness, which the inlet determines, are computed without it. With an
/// Eyring stress τ_E, the stress τ_N of a Newtonian film is first reduced to τ = τ_E asinh(τ_N/τ_E), Johnson &
/// Tevaarwerk 1977.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LimitingStress {
    /// Limiting stress τ_L0 at ambient pressure \[Pa\].
    pub ambient: f64,
    /// Slope Λ of the limiting stress with pressure \[-\].
    pub slope: f64,
    /// Eyring stress τ_E \[Pa\] of the traction. Accepted only if the shear law of the film is Newtonian.
    #[serde(default)]
    pub eyring: Option<f64>,
}

impl ShearLaw {
    /// Returns the lubricant's Newtonian plateau ratio.
    pub fn plateau(&self) -> f64 {
        match *self {
            Self::Newtonian => 1.0,
            Self::Carreau { npr, .. } | Self::Ellis { npr, .. } | Self::Eyring { npr, .. } => npr,
        }
    }

    /// Refuses constants for which the law is not defined.
    pub(super) fn check(&self) -> Result<(), LubricantError> {
        let exponent = |n| check_constant("the power-law exponent n", n, 0.05, 1.0);
        let stress = |g| check_constant("the critical shear stress", g, 1.0, 1e12);
        match *self {
            Self::Newtonian => return Ok(()),
            Self::Carreau { critical_stress, beta, n, .. } => {
                stress(critical_stress)?;
                check_constant("the exponent beta", beta, 0.1, 20.0)?;
                exponent(n)?;
            }
            Self::Ellis { critical_stress, n, .. } => {
                stress(critical_stress)?;
                exponent(n)?;
            }
            Self::Eyring { critical_stress, .. } => stress(critical_stress)?,
        }
        check_plateau(self.plateau())
    }
}

/// Refuses Newtonian plateau ratios outside 0…1.
fn check_plateau(ratio: f64) -> Result<(), LubricantError> {
    check_constant("the Newtonian plateau ratio", ratio, 0.0, 1.0)
}

impl LimitingStress {
    /// Refuses constants for which the law is not defined.
    pub(super) fn check(&self) -> Result<(), LubricantError> {
        check_constant("the limiting stress at ambient pressure", self.ambient, 0.0, 1e10)?;
        check_constant("the slope of the limiting stress", self.slope, 0.0, 1.0)?;
        self.eyring.map_or(Ok(()), |stress| check_constant("the Eyring stress of the traction", stress, 1.0, 1e12))
    }

    /// Returns the stress that the film carries for a stress τ \[Pa\] ≥ 0 at p \[Pa\]: reduced by the Eyring stress
    /// and limited by τ_L.
    pub fn carried(&self, stress: f64, p: f64) -> f64 {
        self.eyring.map_or(stress, |eyring| eyring * (stress / eyring).asinh()).min(self.at(p))
    }

    /// Returns τ_L \[Pa\] at p \[Pa\].
    pub fn at(&self, p: f64) -> f64 {
        self.ambient + self.slope * p.max(0.0)
    }
}

/// Fluidity g = μ/η of a law as a function of t = τ/τ₀, including its plateau.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fluidity {
    factor: Factor,
    plateau: f64,
}

/// Factor F(t) in the form in which it is evaluated.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Factor {
    /// F = (1 + t^β)^q, where q = (1 − 1/n)/β.
    Power { beta: f64, q: f64, n: f64 },
    /// F = t/sinh t.
    HyperbolicSine,
}

/// Upper limit of t in the hyperbolic sine, so that it stays finite. Only intermediate Newton iterates exceed it.
const STEEPEST: f64 = 150.0;

impl Fluidity {
    /// Returns the law's fluidity with a Newtonian plateau ratio, and its stress scale τ₀ \[Pa\]; `None` for a
    /// Newtonian fluid.
    pub fn of(law: ShearLaw, plateau: f64) -> Option<(Self, f64)> {
        let power = |beta: f64, n: f64| Factor::Power { beta, q: (1.0 - 1.0 / n) / beta, n };
        let (factor, scale) = match law {
            ShearLaw::Newtonian => return None,
            ShearLaw::Carreau { critical_stress, beta, n, .. } => (power(beta, n), critical_stress),
            ShearLaw::Ellis { critical_stress, n, .. } => (power((1.0 / n - 1.0).max(1e-3), n), critical_stress),
            ShearLaw::Eyring { critical_stress, .. } => (Factor::HyperbolicSine, critical_stress),
        };
        Some((Self { factor, plateau }, scale))
    }

    /// Returns true for Eyring's law, which is a smooth function of t². Other laws may have a kink where the stress
    /// changes its sign.
    #[inline]
    pub fn is_smooth(&self) -> bool {
        self.factor == Factor::HyperbolicSine
    }

    /// Returns g and t dg/dt at t ≥ 0.
    #[inline]
    pub fn at(&self, t: f64) -> (f64, f64) {
        let ([fluidity], [slope]) = self.at_all(&[t]);
        (fluidity, slope)
    }

    /// Returns g and t dg/dt at several t at once.
    #[inline]
    pub fn at_all<const N: usize>(&self, t: &[f64; N]) -> ([f64; N], [f64; N]) {
        let (factor, slope) = match self.factor {
            Factor::Power { beta, q, .. } => power(beta, q, t),
            Factor::HyperbolicSine => hyperbolic_sine(t),
        };
        let (mut fluidity, mut fluidity_slope) = ([0.0; N], [0.0; N]);
        let thinning = 1.0 - self.plateau;
        for i in 0..N {
            let g = 1.0 / (self.plateau + thinning * factor[i]);
            (fluidity[i], fluidity_slope[i]) = (g, -g * g * thinning * slope[i]);
        }
        (fluidity, fluidity_slope)
    }

    /// Returns an approximate stress t at which t g(t) is `rate` ≥ 0. Uses Newton's method in logarithms, in which
    /// the laws are nearly linear.
    #[inline]
    pub fn stress_near(&self, rate: f64) -> f64 {
        if rate < 1e-9 {
            return rate;
        }
        let without_plateau = match self.factor {
            Factor::Power { n, .. } if rate > 1.0 => rate.powf(n),
            Factor::Power { .. } => rate,
            Factor::HyperbolicSine => rate.asinh(),
        };
        let wanted = rate.ln();
        let mut log = without_plateau.max(self.plateau * rate).ln();
        for _ in 0..4 {
            let (g, slope) = self.at(log.exp());
            let step = (log + g.ln() - wanted) / (1.0 + slope / g);
            log -= step;
            if step.abs() < 1e-3 {
                break;
            }
        }
        log.exp()
    }
}

/// Returns F = (1 + t^β)^q and t dF/dt.
fn power<const N: usize>(beta: f64, q: f64, t: &[f64; N]) -> ([f64; N], [f64; N]) {
    let mut y = *t;
    elementary::raise(&mut y, beta);
    // 1 + y may lose the digits of a small y, because such a y has no effect.
    let mut factor = y.map(|y| 1.0 + y);
    elementary::raise(&mut factor, q);
    let mut slope = [0.0; N];
    for i in 0..N {
        slope[i] = q * beta * factor[i] * (y[i] / (1.0 + y[i]));
    }
    (factor, slope)
}

/// Returns F = t/sinh t and t dF/dt.
fn hyperbolic_sine<const N: usize>(t: &[f64; N]) -> ([f64; N], [f64; N]) {
    let (mut factors, mut slopes) = (t.map(|t| t.min(STEEPEST)), [0.0; N]);
    elementary::hyperbolic_sines(&mut factors, &mut slopes);
    for (slope, t) in slopes.iter_mut().zip(t) {
        *slope = if *t < STEEPEST { *slope } else { 0.0 };
    }
    (factors, slopes)
}

/// Shear-thinning law at one operating point. It converts P, P_X and H into the scalars of the film integrals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScaledShear {
    /// Fluidity of the law.
    pub fluidity: Fluidity,
    /// Stress scale τ₀ \[Pa\] of the law.
    pub stress_scale_pa: f64,
    /// κ₁/τ₀ with κ₁ = p_H a/R. The stresses at the two surfaces differ by this factor times H P_X.
    pub gradient: f64,
    /// κ₂/τ₀ with κ₂ = η₀ (u₂ − u₁) R/a². The Newtonian stress due to sliding is this factor times μ̄/H.
    pub sliding: f64,
    /// Slide-to-roll ratio SRR.
    pub slide_to_roll_ratio: f64,
}

impl ScaledShear {
    /// Creates the law of a lubricant under operating conditions. `None` for a Newtonian fluid: without a law, or for
    /// NPR = 1.
    ///
    /// # Errors
    /// If NPR lies outside 0…1 or SRR outside −10…10, or if NPR < 1 is given for a lubricant without a law.
    pub fn new(law: ShearLaw, sliding: Sliding, point: &OperatingPoint) -> Result<Option<Self>, LubricantError> {
        let srr = sliding.slide_to_roll_ratio;
        check_constant("the slide-to-roll ratio", srr, -10.0, 10.0)?;
        let plateau = sliding.newtonian_plateau_ratio.unwrap_or(law.plateau());
        check_plateau(plateau)?;
        if plateau < 1.0 && law == ShearLaw::Newtonian {
            return Err(LubricantError(format!(
                "the Newtonian plateau ratio is {plateau}, but the lubricant has no shear constants; only 1 (Newtonian) \
                 is accepted"
            )));
        }
        let Some((fluidity, stress_scale_pa)) = Fluidity::of(law, plateau).filter(|_| plateau < 1.0) else {
            return Ok(None);
        };
        Ok(Some(Self {
            fluidity,
            stress_scale_pa,
            gradient: point.gradient_stress_pa() / stress_scale_pa,
            sliding: point.viscosity_pa_s * point.speed_m_per_s * srr / point.film_scale_m() / stress_scale_pa,
            slide_to_roll_ratio: srr,
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn laws() -> [ShearLaw; 4] {
        [
            ShearLaw::Carreau { critical_stress: 1e4, beta: 2.198, n: 0.8, npr: 0.2227 },
            ShearLaw::Carreau { critical_stress: 3.1e4, beta: 2.0, n: 0.74, npr: 0.0 },
            ShearLaw::Ellis { critical_stress: 1e5, n: 0.6, npr: 0.1 },
            ShearLaw::Eyring { critical_stress: 5e6, npr: 0.0 },
        ]
    }

    #[test]
    fn slopes_agree_with_finite_differences() {
        for law in laws() {
            let (fluidity, _) = Fluidity::of(law, law.plateau()).unwrap();
            let mut former = 1.0;
            for t in [1e-3, 0.1, 0.9, 1.0, 3.0, 20.0, 100.0] {
                let (g, slope) = fluidity.at(t);
                let step = 1e-6 * t;
                let difference = (fluidity.at(t + step).0 - fluidity.at(t - step).0) / 2e-6;
                assert!((difference - slope).abs() < 1e-6 * slope.abs().max(1e-3), "{law:?} at {t}");
                assert!(g >= former && g * law.plateau() <= 1.0, "{law:?} at {t}");
                former = g;
            }
            assert_eq!(fluidity.at(0.0).0, 1.0);
        }
    }

    #[test]
    fn the_printed_law_at_its_critical_stress() {
        // (3.40) at τ = G_c: NPR + (1 − NPR) 2^((1 − 1/n)/β).
        let (fluidity, scale) = Fluidity::of(laws()[0], 0.2227).unwrap();
        assert_eq!(scale, 1e4);
        let wanted = 0.2227 + 0.7773 * 2f64.powf((1.0 - 1.0 / 0.8) / 2.198);
        assert!((1.0 / fluidity.at(1.0).0 - wanted).abs() < 1e-14);
    }

    #[test]
    fn the_stress_of_a_rate_is_found_over_all_magnitudes() {
        for law in laws() {
            let (fluidity, _) = Fluidity::of(law, law.plateau()).unwrap();
            for exponent in -12..12 {
                let rate = 10f64.powi(exponent);
                let t = fluidity.stress_near(rate);
                assert!((t * fluidity.at(t).0 / rate - 1.0).abs() < 2e-2, "{law:?} at {rate}: {t}");
            }
        }
    }

    #[test]
    fn constants_outside_their_sense_are_refused_by_name() {
        let carreau = |critical_stress, n, npr| ShearLaw::Carreau { critical_stress, beta: 2.0, n, npr };
        for (law, word) in [
            (carreau(0.0, 0.8, 0.2), "critical shear stress"),
            (carreau(-1e4, 0.8, 0.2), "critical shear stress"),
            (carreau(f64::NAN, 0.8, 0.2), "critical shear stress"),
            (carreau(1e4, 1.3, 0.2), "exponent n"),
            (carreau(1e4, 0.8, 1.2), "plateau"),
            (ShearLaw::Eyring { critical_stress: -5e6, npr: 0.0 }, "critical shear stress"),
        ] {
            let message = law.check().unwrap_err().to_string();
            assert!(message.contains(word), "{message}");
        }
        assert!(laws().iter().all(|law| law.check().is_ok()));
    }
}
