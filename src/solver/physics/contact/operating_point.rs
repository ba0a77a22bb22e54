//! Operating point in SI units with its Hertzian scales and its Moes numbers.

use super::ellipse::Ellipse;
use super::error::ContactError;
use super::film_asymptotes::FilmShape;
use super::kind::ContactKind;
use super::limits::{self, Limit};
use super::sliding::Sliding;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Hertzian pressure \[Pa\] beyond which bearing steel yields below the surface. Results beyond it carry a warning.
pub const PLAUSIBLE_HERTZ_PRESSURE_PA: f64 = 3.2e9;

/// Operating point in SI units. It is valid if [`OperatingPoint::check`] accepts it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OperatingPoint {
    /// Line or point contact.
    pub kind: ContactKind,
    /// Reduced radius of curvature R \[m\], (2.3).
    pub radius_m: f64,
    /// Mean entrainment speed u_m \[m/s\], (2.1).
    pub speed_m_per_s: f64,
    /// Load w: \[N/m\] for a line contact, \[N\] for a point contact, (2.9).
    pub load: f64,
    /// Reduced modulus E′ \[Pa\], (2.5).
    pub modulus_pa: f64,
    /// Viscosity at ambient pressure η₀ \[Pa·s\].
    pub viscosity_pa_s: f64,
    /// Pressure–viscosity coefficient α \[1/Pa\].
    pub alpha_per_pa: f64,
    /// Sliding and plateau ratio.
    pub sliding: Sliding,
    /// Reduced radius R_y across the rolling direction \[m\] of a point contact. `None` if it equals R, and for a
    /// line contact.
    #[serde(default)]
    pub radius_y_m: Option<f64>,
}

/// Scales of the dry Hertzian contact, (2.21).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hertz {
    /// Half width (line contact) or semi-axis along the rolling direction (point contact) a \[m\].
    pub half_width_m: f64,
    /// Semi-axis across b \[m\]; equal to a for circular and line contacts.
    pub half_length_m: f64,
    /// Maximum pressure p_H \[Pa\].
    pub pressure_pa: f64,
}

/// Moes numbers of load and lubricant, (3.19) and (3.22).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Moes {
    /// Load number M \[-\].
    pub m: f64,
    /// Lubricant number L \[-\].
    pub l: f64,
}

impl Moes {
    /// Refuses numbers outside the accepted range.
    pub fn check(self) -> Result<(), ContactError> {
        limits::M.accept(self.m)?;
        limits::L.accept(self.l)
    }
}

impl OperatingPoint {
    /// Table 2.1 of the dissertation: a rolling line contact with M = 40, L = 10.
    pub const TABLE_2_1: Self = Self {
        kind: ContactKind::Line,
        radius_m: 0.0225,
        speed_m_per_s: 5.0365,
        load: 646_110.0,
        modulus_pa: 287.8e9,
        viscosity_pa_s: 0.004,
        alpha_per_pa: 22e-9,
        sliding: Sliding::NONE,
        radius_y_m: None,
    };

    /// Table 4.2 of the dissertation: the line contact of its first transient cases.
    pub const TABLE_4_2: Self = Self {
        radius_m: 2e-3,
        speed_m_per_s: 5.0,
        load: 2e5,
        modulus_pa: 231e9,
        viscosity_pa_s: 0.01,
        alpha_per_pa: 1e-8,
        ..Self::TABLE_2_1
    };

    /// Case 1 of the dissertation's Table 4.5; case 2 is its sixfold load.
    pub const TABLE_4_5: Self = Self { radius_m: 0.01, speed_m_per_s: 2.5, alpha_per_pa: 2e-8, ..Self::TABLE_4_2 };

    /// Creates a point of a kind from the six SI quantities in the order of [`OperatingPoint::quantities`].
    pub fn from_quantities(kind: ContactKind, quantities: [f64; 6], sliding: Sliding) -> Self {
        let [radius_m, speed_m_per_s, load, modulus_pa, viscosity_pa_s, alpha_per_pa] = quantities;
        Self {
            kind,
            radius_m,
            speed_m_per_s,
            load,
            modulus_pa,
            viscosity_pa_s,
            alpha_per_pa,
            sliding,
            radius_y_m: None,
        }
    }

    /// Returns R_y/R_x; 1 for circular and line contacts.
    pub fn radius_ratio(&self) -> f64 {
        self.radius_y_m.map_or(1.0, |radius_y| radius_y / self.radius_m)
    }

    /// Returns true if R_y/R_x is in a closed interval.
    pub fn has_ratio_in(&self, (low, high): (f64, f64)) -> bool {
        (low..=high).contains(&self.radius_ratio())
    }

    /// Returns R_y/R_x of a contact with a stated radius across; `None` without one.
    pub fn stated_ratio(&self) -> Option<f64> {
        self.radius_y_m.map(|_| self.radius_ratio())
    }

    /// Returns ln R_y/R_x; 0 for circular and line contacts.
    pub fn log_ratio(&self) -> f64 {
        self.radius_ratio().ln()
    }

    /// Returns the logarithm of R_y/R_x over that of another contact.
    pub fn log_ratio_over(&self, other: &Self) -> f64 {
        (self.radius_ratio() / other.radius_ratio()).ln()
    }

    /// Returns true for an elliptical contact that is long along the rolling direction: R_y is smaller than R_x.
    pub fn is_narrow(&self) -> bool {
        self.radius_ratio() < 1.0
    }

    /// Returns true for an elliptical contact, false for a circular or line contact.
    pub fn is_elliptic(&self) -> bool {
        self.radius_ratio() != 1.0
    }

    /// Returns the shape of the dry contact; a circle for a line contact.
    pub fn ellipse(&self) -> Ellipse {
        Ellipse::near(self.radius_ratio())
    }

    /// Returns the speeds u₁ and u₂ of the surfaces \[m/s\], u_m(1 ∓ SRR/2).
    pub fn surface_speeds(&self) -> [f64; 2] {
        let half = 0.5 * self.sliding.slide_to_roll_ratio;
        [1.0 - half, 1.0 + half].map(|share| share * self.speed_m_per_s)
    }

    /// Returns the six SI quantities in the order radius, speed, load, modulus, viscosity, alpha.
    pub fn quantities(&self) -> [f64; 6] {
        [self.radius_m, self.speed_m_per_s, self.load, self.modulus_pa, self.viscosity_pa_s, self.alpha_per_pa]
    }

    /// Returns the contact at the share `t` (0…1) between this one and another one, linear in the logarithms of the
    /// SI quantities and of R_y/R.
    pub fn towards(&self, other: &Self, t: f64) -> Self {
        let (from, to) = (self.quantities(), other.quantities());
        let q: [f64; 6] = std::array::from_fn(|i| match (from[i], to[i]) {
            // α may be zero, which has no logarithm.
            (from, to) if from == 0.0 || to == 0.0 => from + (to - from) * t,
            (from, to) => from * (to / from).powf(t),
        });
        let mut point = Self::from_quantities(other.kind, q, self.sliding.towards(other.sliding, t));
        if self.radius_y_m.or(other.radius_y_m).is_some() {
            let [here, there] = [self, other].map(Self::radius_ratio);
            point.radius_y_m = Some(here * (there / here).powf(t) * point.radius_m);
        }
        point
    }

    /// Refuses values that are not finite, not positive, or outside the accepted range.
    pub fn check(&self) -> Result<(), ContactError> {
        for (value, limit) in self.quantities().into_iter().zip(limits::SI) {
            limit.accept(value)?;
        }
        match (self.kind, self.radius_y_m) {
            (_, None) => {}
            (ContactKind::Line, Some(_)) => return Err(ContactError::LineAcross),
            (ContactKind::Point, Some(radius_y)) if radius_y <= 0.0 => return Err(ContactError::Concave { radius_y }),
            (ContactKind::Point, Some(radius_y)) => {
                limits::RADIUS_Y.accept(radius_y)?;
                Ellipse::of_ratio(self.radius_ratio())?;
            }
        }
        self.moes().check()
    }

    /// Returns the Hertzian semi-axes and pressure, (2.21).
    pub fn hertz(&self) -> Hertz {
        let (w, r, e) = (self.load, self.radius_m, self.modulus_pa);
        match self.kind {
            ContactKind::Line => {
                let half_width_m = (8.0 * w * r / (e * PI)).sqrt();
                let pressure_pa = (w * e / (2.0 * PI * r)).sqrt();
                Hertz { half_width_m, half_length_m: half_width_m, pressure_pa }
            }
            ContactKind::Point if self.radius_y_m.is_none_or(|radius_y| radius_y == r) => {
                let half_width_m = (1.5 * w * r / e).cbrt();
                let pressure_pa = (1.5 * w * e * e / (PI * PI * PI * r * r)).cbrt();
                Hertz { half_width_m, half_length_m: half_width_m, pressure_pa }
            }
            ContactKind::Point => {
                let Ellipse { kappa, integral, .. } = self.ellipse();
                let half_width_m = (3.0 * w * r * integral / (PI * e)).cbrt();
                let half_length_m = kappa * half_width_m;
                Hertz { half_width_m, half_length_m, pressure_pa: 1.5 * w / (PI * half_width_m * half_length_m) }
            }
        }
    }

    /// Returns the central film thickness \[m\] by the film formula of all regimes, [`FilmShape::film`].
    pub fn formula_film_m(&self) -> f64 {
        // H = (h/R)(2U)^(−1/2)
        FilmShape::of(self).film(self.moes()) * self.radius_m * self.speed_group().sqrt()
    }

    /// Returns the same contact under the load at which the Hertzian pressure is this one \[Pa\], above 0.
    pub fn at_hertz_pressure(mut self, pressure_pa: f64) -> Self {
        let ratio = pressure_pa / self.hertz().pressure_pa;
        self.load *= ratio.powi(self.kind.radius_power() + 1);
        self
    }

    /// Returns the same contact at the speed at which the film formula gives a film thickness \[m\] above 0.
    pub fn at_film_m(mut self, film_m: f64) -> Self {
        // The film grows with a power of the speed between 0 and 2; half a step converges for all of them.
        for _ in 0..200 {
            self.speed_m_per_s *= (film_m / self.formula_film_m()).sqrt();
        }
        self
    }

    /// Returns the dimensionless speed 2U = 2 η₀ u_m / (E′ R), a factor of both Moes numbers.
    pub fn speed_group(&self) -> f64 {
        2.0 * self.viscosity_pa_s * self.speed_m_per_s / (self.modulus_pa * self.radius_m)
    }

    /// Returns the Moes numbers, (3.19) for a line contact and (3.22) for a point contact.
    pub fn moes(&self) -> Moes {
        let u = self.speed_group();
        let (e, r) = (self.modulus_pa, self.radius_m);
        let m = match self.kind {
            ContactKind::Line => self.load / (e * r * u.sqrt()),
            ContactKind::Point => self.load / (e * r * r * u.powf(self.kind.speed_power())),
        };
        Moes { m, l: self.alpha_per_pa * e * u.powf(0.25) }
    }

    /// Returns λ̄ = 12 u_m η₀ R² / (p_H a³), the only parameter of the scaled Reynolds equation (2.23).
    pub fn lambda_bar(&self) -> f64 {
        let hertz = self.hertz();
        12.0 * self.speed_m_per_s * self.viscosity_pa_s * self.radius_m.powi(2)
            / (hertz.pressure_pa * hertz.half_width_m.powi(3))
    }

    /// Returns the film thickness scale a²/R \[m\], so that h = (a²/R) H, (2.22).
    pub fn film_scale_m(&self) -> f64 {
        self.hertz().half_width_m.powi(2) / self.radius_m
    }

    /// Returns κ₁ = p_H a/R \[Pa\], (3.27). The difference of the shear stress across a film is κ₁ H ∂P/∂X.
    pub fn gradient_stress_pa(&self) -> f64 {
        let Hertz { half_width_m, pressure_pa, .. } = self.hertz();
        pressure_pa * half_width_m / self.radius_m
    }

    /// Returns the factor \[1/Pa\] between the integral of a stress \[Pa\] over X, and Y, and its share of the load:
    /// a/w for a line contact, ab/w for a point contact.
    pub fn area_per_load(&self) -> f64 {
        let Hertz { half_width_m, half_length_m, .. } = self.hertz();
        if self.kind.is_line() { half_width_m / self.load } else { half_width_m * half_length_m / self.load }
    }

    /// Returns the piezoviscous parameter α p_H \[-\], the exponent of the viscosity rise in the contact.
    pub fn alpha_hertz(&self) -> f64 {
        self.alpha_per_pa * self.hertz().pressure_pa
    }
}

/// Returns the reduced modulus E′ \[Pa\] of two bodies, (2.5). Young's moduli are in Pa, Poisson ratios in \[0,
/// 0.5\].
pub fn reduced_modulus(e1: f64, nu1: f64, e2: f64, nu2: f64) -> Result<f64, ContactError> {
    let young = |name| Limit { name, ..limits::MODULUS };
    let poisson = |name| Limit { name, unit: "", range: (0.0, 0.5), or_zero: false };
    young("Young's modulus e1").accept(e1)?;
    young("Young's modulus e2").accept(e2)?;
    poisson("Poisson ratio nu1").accept(nu1)?;
    poisson("Poisson ratio nu2").accept(nu2)?;
    Ok(2.0 / ((1.0 - nu1 * nu1) / e1 + (1.0 - nu2 * nu2) / e2))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: f64, b: f64, relative: f64) {
        assert!((a / b - 1.0).abs() < relative, "{a} against {b}");
    }

    #[test]
    fn table_2_1_has_the_moes_numbers_the_dissertation_prints() {
        let moes = OperatingPoint::TABLE_2_1.moes();
        close(moes.m, 40.0, 1e-5);
        close(moes.l, 10.0, 1e-5);
        let hertz = OperatingPoint::TABLE_2_1.hertz();
        close(hertz.pressure_pa, 1146878557.184226, 1e-12);
        close(hertz.half_width_m, 0.0003586486106552479, 1e-12);
        close(OperatingPoint::TABLE_2_1.lambda_bar(), 0.002313184217737941, 1e-12);
    }

    #[test]
    fn speed_for_a_film_gives_this_film() {
        let point =
            OperatingPoint { kind: ContactKind::Point, load: 50.0, radius_m: 0.01, ..OperatingPoint::TABLE_2_1 };
        // From thin to thick films, in which the film grows with the square of the speed.
        for (contact, film) in
            [OperatingPoint::TABLE_2_1, point].into_iter().flat_map(|c| [1e-9, 1e-7, 1e-5, 1e-3].map(|h| (c, h)))
        {
            let moved = contact.at_film_m(film);
            close(moved.formula_film_m(), film, 1e-9);
            assert_eq!(OperatingPoint { speed_m_per_s: contact.speed_m_per_s, ..moved }, contact);
        }
        let expected = crate::solver::physics::contact::expected_film(&OperatingPoint::TABLE_2_1);
        close(OperatingPoint::TABLE_2_1.formula_film_m() / OperatingPoint::TABLE_2_1.film_scale_m(), expected, 1e-9);
    }

    #[test]
    fn hertz_pressure_carries_the_load() {
        let line = OperatingPoint::TABLE_2_1;
        let h = line.hertz();
        close(h.pressure_pa * h.half_width_m * PI / 2.0, line.load, 1e-12);
        let point = OperatingPoint { kind: ContactKind::Point, load: 50.0, radius_m: 0.01, ..line };
        let h = point.hertz();
        close(h.pressure_pa * h.half_width_m.powi(2) * 2.0 * PI / 3.0, point.load, 1e-12);
    }

    #[test]
    fn alpha_hertz_is_the_moes_combination_whatever_the_realisation() {
        for kind in [ContactKind::Line, ContactKind::Point] {
            let load = if kind == ContactKind::Line { 3e5 } else { 60.0 };
            let point = OperatingPoint { kind, load, ..OperatingPoint::TABLE_2_1 };
            let Moes { m, l } = point.moes();
            let expected = match kind {
                ContactKind::Line => l * (m / (2.0 * PI)).sqrt(),
                ContactKind::Point => l * (1.5 * m / PI.powi(3)).cbrt(),
            };
            close(point.alpha_hertz(), expected, 1e-12);
        }
    }

    #[test]
    fn equal_steel_bodies_give_the_textbook_modulus() {
        close(reduced_modulus(210e9, 0.3, 210e9, 0.3).unwrap(), 210e9 / 0.91, 1e-12);
        assert!(reduced_modulus(210e9, 0.7, 210e9, 0.3).is_err());
    }

    #[test]
    fn nonsense_is_refused_with_a_sentence() {
        for bad in [f64::NAN, f64::INFINITY, 0.0, -1.0] {
            let point = OperatingPoint { radius_m: bad, ..OperatingPoint::TABLE_2_1 };
            let message = point.check().unwrap_err().to_string();
            assert!(message.starts_with("radius is"), "{message}");
        }
        assert!(OperatingPoint::TABLE_2_1.check().is_ok());
    }
}
