//! Published formula for the rolling resistance.

use super::OperatingPoint;

impl OperatingPoint {
    /// Returns the rolling resistance ½∫h dp of each body of a line contact \[N/m\]: E′R (2U)^¾ · 1.4 √M/(1 + (1.4
    /// √M/1.45)¹⁰)^⅒. `None` for a point contact.
    ///
    /// Source: Biboulet & Houpert, Proc. IMechE J 224 (2010). It is a curve fit from the rigid to the elastic regime,
    /// for isothermal, fully flooded Newtonian films with Barus' viscosity. Solutions of this program agree with it
    /// within 7 % for M 10…200, L 4…10.
    pub fn rolling_resistance_fit(&self) -> Option<f64> {
        if self.kind.is_point() {
            return None;
        }
        let rigid = 1.4 * self.moes().m.sqrt();
        let group = rigid / (1.0 + (rigid / 1.45).powi(10)).powf(0.1);
        Some(self.modulus_pa * self.radius_m * self.speed_group().powf(0.75) * group)
    }
}

#[cfg(test)]
mod tests {
    use crate::solver::physics::contact::{ContactKind, MoesRequest, si_from_moes};

    #[test]
    fn resistance_grows_with_the_root_of_light_loads() {
        let at = |m: f64| si_from_moes(&MoesRequest::new(ContactKind::Line, m, 5.0)).unwrap();
        let group = |m: f64| {
            let point = at(m);
            point.rolling_resistance_fit().unwrap()
                / (point.modulus_pa * point.radius_m * point.speed_group().powf(0.75))
        };
        assert!((group(0.1) / (1.4 * 0.1f64.sqrt()) - 1.0).abs() < 1e-6);
        assert!((group(500.0) / 1.45 - 1.0).abs() < 1e-6);
        let ball = si_from_moes(&MoesRequest::new(ContactKind::Point, 50.0, 5.0)).unwrap();
        assert_eq!(ball.rolling_resistance_fit(), None);
    }
}
