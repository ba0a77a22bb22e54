//! Flow between rough surfaces in the average model of Patir and Cheng: J. Lubr. Technol. 100 (1978) 12, pressure flow
//! factors, and 101 (1979) 220, shear flow factors.
//!
//! Below a separation l₀ the fitted factors leave their range: that of the pressure flow falls to zero at a finite
//! separation for γ < 1. There the flow decays exponentially with the separation instead.

/// Accepted range of the Peklenik number γ \[-\], the ratio of the correlation lengths along and across the flow.
pub const PEKLENIK: (f64, f64) = (1.0 / 9.0, 9.0);

/// Separation beyond which the surfaces count as smooth.
const SMOOTH: f64 = 60.0;
/// Separation beyond which the shear flow factor decays exponentially.
const WIDE: f64 = 5.0;

/// Constants of one Peklenik number.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Pattern {
    /// γ.
    peklenik: f64,
    /// C and r of the pressure flow factor: 1 − C e^(−r l) for γ ≤ 1, 1 + C l^(−r) for γ > 1.
    pressure: (f64, f64),
    /// l₀.
    touching: f64,
    /// A₁, α₁, α₂, α₃, A₂ of the shear flow factor A₁ l^α₁ e^(−α₂ l + α₃ l²), beyond l = 5 A₂ e^(−l/4).
    shear: [f64; 5],
}

const fn pattern(peklenik: f64, pressure: (f64, f64), touching: f64, shear: [f64; 5]) -> Pattern {
    Pattern { peklenik, pressure, touching, shear }
}

const PATTERNS: [Pattern; 7] = [
    pattern(1.0 / 9.0, (1.48, 0.42), 1.0, [2.046, 1.12, 0.78, 0.03, 1.856]),
    pattern(1.0 / 6.0, (1.38, 0.42), 1.0, [1.962, 1.08, 0.77, 0.03, 1.754]),
    pattern(1.0 / 3.0, (1.18, 0.42), 0.75, [1.858, 1.01, 0.76, 0.03, 1.561]),
    pattern(1.0, (0.90, 0.56), 0.5, [1.899, 0.98, 0.92, 0.05, 1.126]),
    pattern(3.0, (0.225, 1.5), 0.5, [1.560, 0.85, 1.13, 0.08, 0.556]),
    pattern(6.0, (0.520, 1.5), 0.5, [1.290, 0.62, 1.09, 0.08, 0.388]),
    pattern(9.0, (0.870, 1.5), 0.5, [1.011, 0.54, 1.07, 0.08, 0.295]),
];

/// Flow factors of a Peklenik number γ, interpolated linearly in ln γ between the tabulated numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlowFactors {
    lower: Pattern,
    upper: Pattern,
    /// Weight of the upper pattern.
    share: f64,
}

impl FlowFactors {
    /// Returns the factors of a Peklenik number. Numbers outside [`PEKLENIK`] are moved to its ends.
    pub fn new(peklenik: f64) -> Self {
        let above = PATTERNS.partition_point(|pattern| pattern.peklenik <= peklenik).clamp(1, PATTERNS.len() - 1);
        let (lower, upper) = (PATTERNS[above - 1], PATTERNS[above]);
        let share = (peklenik / lower.peklenik).ln() / (upper.peklenik / lower.peklenik).ln();
        Self { lower, upper, share: share.clamp(0.0, 1.0) }
    }

    /// Returns G = φ l³ and dG/dl at a separation l. φ is the ratio of the flow under a pressure gradient to that
    /// between smooth surfaces at the same distance of the mean planes.
    pub fn pressure(&self, separation: f64) -> (f64, f64) {
        if separation > SMOOTH {
            return (separation.powi(3), 3.0 * separation * separation);
        }
        self.interpolated(|pattern| pattern.pressure_flow(separation))
    }

    /// Returns Φ_s and dΦ_s/dl at a separation l: the flow, in units of σ, that the roughness of one surface carries if
    /// the other one is smooth, at half of the difference of speeds.
    pub fn shear(&self, separation: f64) -> (f64, f64) {
        self.interpolated(|pattern| pattern.shear_flow(separation))
    }

    fn interpolated(&self, of: impl Fn(&Pattern) -> (f64, f64)) -> (f64, f64) {
        match self.share {
            0.0 => of(&self.lower),
            1.0 => of(&self.upper),
            share => {
                let (lower, upper) = (of(&self.lower), of(&self.upper));
                (lower.0 + share * (upper.0 - lower.0), lower.1 + share * (upper.1 - lower.1))
            }
        }
    }
}

impl Pattern {
    fn pressure_flow(&self, l: f64) -> (f64, f64) {
        let from = l.max(self.touching);
        let (c, r) = self.pressure;
        let (factor, slope) = if self.peklenik <= 1.0 {
            let gap = c * (-r * from).exp();
            (1.0 - gap, r * gap)
        } else {
            let gap = c * from.powf(-r);
            (1.0 + gap, -r * gap / from)
        };
        let (flow, rate) = (factor * from.powi(3), 3.0 / from + slope / factor);
        if l >= self.touching {
            return (flow, flow * rate);
        }
        let flow = flow * (rate * (l - from)).exp();
        (flow, flow * rate)
    }

    fn shear_flow(&self, l: f64) -> (f64, f64) {
        let [a_1, alpha_1, alpha_2, alpha_3, a_2] = self.shear;
        if l > WIDE {
            let flow = a_2 * (-0.25 * l).exp();
            return (flow, -0.25 * flow);
        }
        let from = l.max(self.touching);
        let flow = a_1 * from.powf(alpha_1) * (from * (alpha_3 * from - alpha_2)).exp();
        let rate = alpha_1 / from - alpha_2 + 2.0 * alpha_3 * from;
        let flow = flow * (rate * (l - from)).exp();
        (flow, flow * rate)
    }
}
