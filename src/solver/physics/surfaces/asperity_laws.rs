//! Laws of the mean pressure that touching asperities carry, and of their real contact area, as functions of the
//! separation l = h/σ.

use super::mean_gap::mean_gap;
use super::roughness::{SurfaceConstant, SurfaceError};
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, SQRT_2};

/// Law of the asperity pressure. η (or n) is the number of summits per area, β their radius and σ the composite rms
/// roughness.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum AsperityLaw {
    /// Elastic spherical summits of Gaussian heights: Greenwood & Tripp, Proc. IMechE 185 (1970) 625, with the exact
    /// integral F_5/2.
    GreenwoodTripp {
        /// ηβσ \[-\].
        eta_beta_sigma: f64,
        /// σ/β \[-\].
        sigma_over_beta: f64,
    },
    /// Elastic–plastic summits: Zhao, Maietta & Chang, J. Tribol. 122 (2000) 86. A summit yields at 0.4 of the hardness
    /// and is fully plastic at 54 times the interference of first yield.
    ZhaoMaiettaChang {
        /// nβσ \[-\].
        n_beta_sigma: f64,
        /// σ/β \[-\].
        sigma_over_beta: f64,
        /// Hardness of the softer body \[Pa\].
        hardness: f64,
    },
    /// Empirical law p₀ e^(−l/c).
    Exponential {
        /// Pressure p₀ at l = 0 \[Pa\].
        pressure: f64,
        /// Separation c over which the pressure falls by the factor e \[-\].
        decay: f64,
    },
}

impl Default for AsperityLaw {
    /// Greenwood and Tripp with constants of ground steel: ηβσ = 0.05, σ/β = 0.01.
    fn default() -> Self {
        Self::GreenwoodTripp { eta_beta_sigma: 0.05, sigma_over_beta: 0.01 }
    }
}

/// Smallest nβσ of Zhao, Maietta and Chang: below it, the heights of summits have no variance.
const LEAST_SUMMITS: f64 = 0.0193;
/// 1 − (s_s/σ)² times (nβσ)², where s_s is the standard deviation of the heights of summits.
const SUMMIT_VARIANCE: f64 = 3.717e-4;
/// Distance of the mean plane of summits from that of heights in units of σ, times nβσ.
const SUMMIT_PLANE: f64 = 0.045944;
/// Mean pressure of a summit at first yield, relative to the hardness.
const YIELD: f64 = 0.4;
/// Ratio of the interferences of full plasticity and of first yield.
const PLASTIC: f64 = 54.0;

impl AsperityLaw {
    /// Returns the name of the law for use in sentences.
    pub fn name(self) -> &'static str {
        match self {
            Self::GreenwoodTripp { .. } => "Greenwood-Tripp",
            Self::ZhaoMaiettaChang { .. } => "Zhao-Maietta-Chang",
            Self::Exponential { .. } => "exponential",
        }
    }

    /// Refuses constants out of range.
    ///
    /// # Errors
    /// With the name of the constant and its range.
    pub fn check(self) -> Result<(), SurfaceError> {
        let within = |name, value, range| SurfaceError::check(SurfaceConstant::Asperities(name), value, range);
        match self {
            Self::GreenwoodTripp { eta_beta_sigma, sigma_over_beta } => {
                within("ηβσ of Greenwood-Tripp", eta_beta_sigma, (1e-4, 1.0))?;
                within("σ/β of Greenwood-Tripp", sigma_over_beta, (1e-8, 1.0))
            }
            Self::ZhaoMaiettaChang { n_beta_sigma, sigma_over_beta, hardness } => {
                within("nβσ of Zhao-Maietta-Chang", n_beta_sigma, (LEAST_SUMMITS, 1.0))?;
                within("σ/β of Zhao-Maietta-Chang", sigma_over_beta, (1e-8, 1.0))?;
                within("the hardness in Pa", hardness, (1e6, 1e12))
            }
            Self::Exponential { pressure, decay } => {
                within("p0 of the exponential law in Pa", pressure, (1.0, 1e13))?;
                within("c of the exponential law", decay, (0.05, 10.0))
            }
        }
    }

    /// Returns the mean pressure \[Pa\] and its derivative by l at a separation l. `modulus_pa` is the reduced modulus
    /// E′ of (2.5), twice the contact modulus E* of both papers.
    pub fn pressure(self, modulus_pa: f64, separation: f64) -> (f64, f64) {
        match self {
            Self::GreenwoodTripp { eta_beta_sigma, sigma_over_beta } => {
                let factor = 16.0 * SQRT_2 / 15.0 * PI * eta_beta_sigma.powi(2) * sigma_over_beta.sqrt();
                let scale = 0.5 * factor * modulus_pa;
                let [three_halves, five_halves] = greenwood_tripp_integrals(separation);
                (scale * five_halves, -2.5 * scale * three_halves)
            }
            Self::ZhaoMaiettaChang { n_beta_sigma, sigma_over_beta, hardness } => {
                let summits = Summits::new(n_beta_sigma, sigma_over_beta, hardness, modulus_pa);
                let [pressure, slope] = summits.mean(separation, |w| summits.carried(w));
                (pressure, slope)
            }
            Self::Exponential { pressure, decay } => {
                let pressure = pressure * (-separation / decay).exp();
                (pressure, -pressure / decay)
            }
        }
    }

    /// Returns the real contact area over the nominal area at a separation l; `None` if the law does not define it.
    pub fn contact_area(self, modulus_pa: f64, separation: f64) -> Option<f64> {
        match self {
            Self::GreenwoodTripp { eta_beta_sigma, .. } => {
                // F_2(l) = Φ(−l) − l F_1(l), and the functions of the mean gap at −l are F_1(l) and Φ(−l).
                let (first, share) = mean_gap(-separation);
                Some((PI * eta_beta_sigma).powi(2) * (share - separation * first))
            }
            Self::ZhaoMaiettaChang { n_beta_sigma, sigma_over_beta, hardness } => {
                let summits = Summits::new(n_beta_sigma, sigma_over_beta, hardness, modulus_pa);
                Some(summits.mean(separation, |w| summits.touched(w))[0])
            }
            Self::Exponential { .. } => None,
        }
    }
}

/// Returns F_3/2(l) and F_5/2(l). F_ν(l) is the integral of (s − l)^ν over the normal density of heights s > l:
/// √(2/π) ∫₀^∞ t^(2ν+1) e^(−(l+t²)²/2) dt. The trapezoidal rule converges exponentially here.
fn greenwood_tripp_integrals(l: f64) -> [f64; 2] {
    const STEP: f64 = 0.09;
    // The density is below e^(−50) beyond t² = 10 − l.
    let last = ((10.0 - l.min(0.0)).sqrt() / STEP) as u32;
    let (mut lower, mut upper) = (0.0, 0.0);
    for k in 1..=last {
        let square = (STEP * f64::from(k)).powi(2);
        let weight = square * square * (-0.5 * (l + square).powi(2)).exp();
        lower += weight;
        upper += square * weight;
    }
    [lower, upper].map(|sum| (2.0 / PI).sqrt() * STEP * sum)
}

/// Elastic–plastic summits of Gaussian heights. The interference w of a summit is its compression in units of σ.
struct Summits {
    /// E* = E′/2 \[Pa\].
    contact_modulus: f64,
    /// Hardness \[Pa\].
    hardness: f64,
    /// nβσ.
    density: f64,
    /// √(σ/β).
    root: f64,
    /// Interference w₁ at first yield.
    yields_at: f64,
}

/// Positive nodes and their weights of the Gauss–Legendre rule with eight points on (−1, 1).
const GAUSS_8: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_5),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_3),
];

impl Summits {
    fn new(density: f64, sigma_over_beta: f64, hardness: f64, modulus_pa: f64) -> Self {
        let first = 3.0 * PI * YIELD * hardness / (2.0 * modulus_pa);
        Self {
            contact_modulus: 0.5 * modulus_pa,
            hardness,
            density,
            root: sigma_over_beta.sqrt(),
            yields_at: first * first / sigma_over_beta,
        }
    }

    /// Returns the mean of a function of the interference over the heights of all summits, and its derivative by l.
    fn mean(&self, l: f64, of: impl Fn(f64) -> f64) -> [f64; 2] {
        const PANELS: f64 = 12.0;
        let distance = l - SUMMIT_PLANE / self.density;
        let variance = 1.0 - SUMMIT_VARIANCE / self.density.powi(2);
        // The density of heights is below e^(−40) of its largest value outside these interferences.
        let reach = (80.0 * variance).sqrt();
        let from = (-distance - reach).max(0.0);
        let to = if distance > 0.0 { distance.hypot(reach) - distance } else { reach - distance };
        let scale = (2.0 * PI * variance).sqrt().recip();
        let ends = [0.0, self.yields_at, PLASTIC * self.yields_at, f64::INFINITY];
        let (mut mean, mut slope) = (0.0, 0.0);
        for range in ends.windows(2) {
            let (low, high) = (range[0].max(from), range[1].min(to));
            if low >= high {
                continue;
            }
            // The load of a summit is a smooth function of √w at w = 0.
            let (low, width) = (low.sqrt(), high.sqrt() - low.sqrt());
            let panels = (PANELS * width / (to.sqrt() - from.sqrt())).ceil();
            let half = 0.5 * width / panels;
            for panel in 0..panels as u32 {
                let middle = low + (2.0 * f64::from(panel) + 1.0) * half;
                for (node, weight) in GAUSS_8.into_iter().flat_map(|(node, weight)| [(-node, weight), (node, weight)]) {
                    let root = middle + half * node;
                    let interference = root * root;
                    let height = distance + interference;
                    let density = scale * (-0.5 * height * height / variance).exp();
                    let part = 2.0 * root * half * weight * of(interference) * density;
                    mean += part;
                    slope -= part * height / variance;
                }
            }
        }
        [mean, slope]
    }

    /// Returns the contact area of a summit at an interference w, times the number of summits per area.
    fn touched(&self, w: f64) -> f64 {
        let (first, last) = (self.yields_at, PLASTIC * self.yields_at);
        let u = ((w - first) / (last - first)).clamp(0.0, 1.0);
        PI * self.density * w * (1.0 + u * u * (3.0 - 2.0 * u))
    }

    /// Returns the load of a summit at an interference w, times the number of summits per area \[Pa\].
    fn carried(&self, w: f64) -> f64 {
        let (first, last) = (self.yields_at, PLASTIC * self.yields_at);
        if w < first {
            4.0 / 3.0 * self.contact_modulus * self.density * self.root * w * w.sqrt()
        } else if w < last {
            self.hardness * (1.0 - (1.0 - YIELD) * (last / w).ln() / PLASTIC.ln()) * self.touched(w)
        } else {
            self.hardness * self.touched(w)
        }
    }
}
