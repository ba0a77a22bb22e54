//! Oils by grade and temperature: viscosity, density and pressure–viscosity coefficient.

use super::units::KELVIN;
use crate::solver::physics::lubricant::OilHeat;
use serde::{Deserialize, Serialize};

/// Reason for refusing an oil.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum OilError {
    /// A kinematic viscosity outside the chart.
    #[error("a kinematic viscosity of {0:.4} mm²/s is outside the chart of ASTM D341; 0.3 to 2e7 mm²/s are accepted")]
    Viscosity(f64),
    /// A temperature outside the accepted range.
    #[error("a temperature of {0:.1} °C is outside what lubricating oils are used at; −60 to 300 °C are accepted")]
    Temperature(f64),
    /// Both viscosities belong to the same temperature.
    #[error(
        "two viscosities at the same temperature of {0:.1} °C do not say how the oil thins; give another temperature"
    )]
    SameTemperature(f64),
    /// The viscosity rises with the temperature.
    #[error("the oil would be thicker at {0:.1} °C than at {1:.1} °C; a higher temperature has the lower viscosity")]
    Rising(f64, f64),
    /// A density outside the accepted range.
    #[error("a density of {0} kg/m³ is none of an oil; 500 to 2000 kg/m³ are accepted")]
    Density(f64),
    /// A pressure–viscosity coefficient outside the accepted range.
    #[error("a pressure–viscosity coefficient of {0}/GPa is none of an oil; 1 to 100/GPa are accepted")]
    Alpha(f64),
    /// A number that is not an ISO viscosity grade.
    #[error("{0} is no ISO viscosity grade; 10, 15, 22, 32, 46, 68, 100, 150, 220, 320, 460, 680, 1000 and 1500 are")]
    Grade(f64),
}

/// Density of water at 15 °C \[kg/m³\].
const WATER: f64 = 999.1;

/// ISO 3448 viscosity grades: kinematic viscosity at 40 °C, and at 100 °C for a viscosity index of 95 by ASTM D2270,
/// both in mm²/s.
pub const ISO_VG: [(f64, f64); 14] = [
    (10.0, 2.637),
    (15.0, 3.381),
    (22.0, 4.254),
    (32.0, 5.289),
    (46.0, 6.645),
    (68.0, 8.530),
    (100.0, 11.07),
    (150.0, 14.55),
    (220.0, 18.75),
    (320.0, 23.96),
    (460.0, 30.35),
    (680.0, 39.06),
    (1000.0, 49.86),
    (1500.0, 64.22),
];

/// Oil at the temperature of its contact.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Oil {
    /// Viscosity grade.
    pub grade: Grade,
    /// Base oil.
    #[serde(default)]
    pub family: OilFamily,
    /// Temperature \[K\].
    pub temperature_k: f64,
    /// Density at 15 °C \[kg/m³\].
    pub density_15: f64,
    /// Measured α at the temperature \[1/Pa\]. If absent, the correlation of the base oil estimates it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub alpha_per_pa: Option<f64>,
}

/// Specification of an oil's viscosity.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Grade {
    /// A mineral oil of an ISO viscosity grade with a viscosity index of 95.
    IsoVg(f64),
    /// Kinematic viscosity \[m²/s\] at two temperatures \[K\].
    Two((f64, f64), (f64, f64)),
}

/// Properties of an oil at its temperature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OilState {
    /// Dynamic viscosity η₀ \[Pa·s\].
    pub viscosity_pa_s: f64,
    /// Kinematic viscosity \[m²/s\].
    pub kinematic_m2_per_s: f64,
    /// Density \[kg/m³\].
    pub density: f64,
    /// Pressure–viscosity coefficient α \[1/Pa\] by the correlation of its family, or as measured.
    pub alpha_per_pa: f64,
    /// Thermal constants: β from the viscosity over temperature, density and its coefficient from the expansion, heat
    /// capacity and conductivity by Cragoe 1929.
    pub heat: OilHeat,
}

impl Oil {
    /// Returns viscosity, density and α at its temperature.
    ///
    /// # Errors
    /// If the grade, a viscosity, the temperature or the density is outside the accepted range.
    pub fn state(&self) -> Result<OilState, OilError> {
        if !(500.0..=2000.0).contains(&self.density_15) {
            return Err(OilError::Density(self.density_15));
        }
        let law = match self.grade {
            Grade::IsoVg(grade) => ViscosityTemperature::iso_vg(grade)?,
            Grade::Two(first, second) => ViscosityTemperature::through(first, second)?,
        };
        let kinematic_m2_per_s = law.at(self.temperature_k)?;
        let density = density_at(self.density_15, self.temperature_k);
        let viscosity_pa_s = kinematic_m2_per_s * density;
        let alpha_per_pa = match self.alpha_per_pa {
            Some(alpha) if (1e-9..=1e-7).contains(&alpha) => alpha,
            Some(alpha) => return Err(OilError::Alpha(1e9 * alpha)),
            None => self.family.coefficient(viscosity_pa_s, kinematic_m2_per_s),
        };
        let expansion = expansion_at(self.density_15, self.temperature_k);
        let heat = OilHeat {
            heat_capacity: heat_capacity(self.density_15, self.temperature_k),
            conductivity: conductivity(self.density_15, self.temperature_k),
            density,
            viscosity_temperature: law.coefficient(self.temperature_k)? + expansion,
            density_temperature: expansion,
            free_volume: None,
        };
        Ok(OilState { viscosity_pa_s, kinematic_m2_per_s, density, alpha_per_pa, heat })
    }
}

/// Temperature dependence of the kinematic viscosity, log₁₀ log₁₀ Z = A − B log₁₀ T (ASTM D341).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViscosityTemperature {
    a: f64,
    b: f64,
}

impl ViscosityTemperature {
    /// Creates the law through two points of temperature \[K\] and kinematic viscosity \[m²/s\].
    ///
    /// # Errors
    /// If a point lies outside the chart, both have the same temperature, or the viscosity rises with the
    /// temperature.
    pub fn through(first: (f64, f64), second: (f64, f64)) -> Result<Self, OilError> {
        let (cold, hot) = if first.0 <= second.0 { (first, second) } else { (second, first) };
        for (temperature, viscosity) in [cold, hot] {
            check_temperature(temperature)?;
            check_viscosity(1e6 * viscosity)?;
        }
        if hot.0 - cold.0 < 1.0 {
            return Err(OilError::SameTemperature(cold.0 - KELVIN));
        }
        if hot.1 >= cold.1 {
            return Err(OilError::Rising(hot.0 - KELVIN, cold.0 - KELVIN));
        }
        let height = |(_, viscosity): (f64, f64)| z_of(1e6 * viscosity).log10().log10();
        let b = (height(cold) - height(hot)) / (hot.0.log10() - cold.0.log10());
        Ok(Self { a: height(cold) + b * cold.0.log10(), b })
    }

    /// Creates the law of a mineral oil of an ISO grade with a viscosity index of 95.
    ///
    /// # Errors
    /// If the number is not an ISO grade.
    pub fn iso_vg(grade: f64) -> Result<Self, OilError> {
        let found = ISO_VG.into_iter().find(|(at_40, _)| *at_40 == grade);
        let (at_40, at_100) = found.ok_or(OilError::Grade(grade))?;
        Self::through((KELVIN + 40.0, 1e-6 * at_40), (KELVIN + 100.0, 1e-6 * at_100))
    }

    /// Returns −d ln ν/dT \[1/K\] at a temperature \[K\], by central differences of the chart.
    ///
    /// # Errors
    /// As [`ViscosityTemperature::at`].
    pub fn coefficient(&self, temperature_k: f64) -> Result<f64, OilError> {
        let step = 0.01;
        let (cold, hot) = (self.unchecked(temperature_k - step), self.unchecked(temperature_k + step));
        self.at(temperature_k).map(|_| (cold / hot).ln() / (2.0 * step))
    }

    /// Returns the kinematic viscosity \[mm²/s\] at a temperature \[K\] without a check.
    fn unchecked(&self, temperature_k: f64) -> f64 {
        viscosity_of(10f64.powf(10f64.powf(self.a - self.b * temperature_k.log10())))
    }

    /// Returns the kinematic viscosity \[m²/s\] at a temperature \[K\].
    ///
    /// # Errors
    /// If the temperature is outside the accepted range, or the viscosity at it is outside the chart.
    pub fn at(&self, temperature_k: f64) -> Result<f64, OilError> {
        check_temperature(temperature_k)?;
        let viscosity = self.unchecked(temperature_k);
        check_viscosity(viscosity)?;
        Ok(1e-6 * viscosity)
    }
}

/// Returns the heat capacity c_p \[J/(kg K)\] at a temperature \[K\] of an oil with a given density at 15 °C \[kg/m³\].
/// Source: Cragoe 1929 for petroleum oils; synthetic oils differ from it by some 15 %.
pub fn heat_capacity(density_15: f64, temperature_k: f64) -> f64 {
    (1684.8 + 3.3913 * (temperature_k - KELVIN)) / (density_15 / WATER).sqrt()
}

/// Returns the thermal conductivity k \[W/(m K)\] at a temperature \[K\] of an oil with a given density at 15 °C
/// \[kg/m³\]. Source: Cragoe 1929 for petroleum oils; synthetic oils differ from it by some 15 %.
pub fn conductivity(density_15: f64, temperature_k: f64) -> f64 {
    0.1172 * (1.0 - 5.4e-4 * (temperature_k - KELVIN)) / (density_15 / WATER)
}

fn check_temperature(kelvin: f64) -> Result<(), OilError> {
    let celsius = kelvin - KELVIN;
    if (-60.0..=300.0).contains(&celsius) { Ok(()) } else { Err(OilError::Temperature(celsius)) }
}

fn check_viscosity(mm2_per_s: f64) -> Result<(), OilError> {
    if (0.3..=2e7).contains(&mm2_per_s) { Ok(()) } else { Err(OilError::Viscosity(mm2_per_s)) }
}

/// Returns Z of ASTM D341 for a kinematic viscosity \[mm²/s\].
fn z_of(nu: f64) -> f64 {
    nu + 0.7 + (-1.47 - 1.84 * nu - 0.51 * nu * nu).exp()
}

/// Returns the kinematic viscosity \[mm²/s\] for Z.
fn viscosity_of(z: f64) -> f64 {
    let x = z - 0.7;
    x - (-0.7487 - 3.295 * x + 0.6119 * x * x - 0.3193 * x * x * x).exp()
}

/// Returns the density \[kg/m³\] at a temperature \[K\] of an oil with a given density at 15 °C \[kg/m³\]. Uses the
/// thermal expansion of lubricating oils by ASTM D1250, coefficient 0.6278/ρ₁₅.
pub fn density_at(density_15: f64, temperature_k: f64) -> f64 {
    let expansion = 0.6278 / density_15 * (temperature_k - KELVIN - 15.0);
    density_15 * (-expansion * (1.0 + 0.8 * expansion)).exp()
}

/// Returns −d ln ρ/dT \[1/K\] of [`density_at`].
fn expansion_at(density_15: f64, temperature_k: f64) -> f64 {
    let coefficient = 0.6278 / density_15;
    coefficient * (1.0 + 1.6 * coefficient * (temperature_k - KELVIN - 15.0))
}

/// Base oils whose pressure–viscosity coefficient has a published correlation with the viscosity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Default)]
pub enum OilFamily {
    /// Mineral oil.
    #[default]
    Mineral,
    /// Polyalphaolefin.
    Polyalphaolefin,
    /// Ester.
    Ester,
    /// Polyglycol.
    Polyglycol,
}

impl OilFamily {
    /// All families.
    pub const ALL: [Self; 4] = [Self::Mineral, Self::Polyalphaolefin, Self::Ester, Self::Polyglycol];

    /// Returns its display name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Mineral => "Mineral oil",
            Self::Polyalphaolefin => "Polyalphaolefin (PAO)",
            Self::Ester => "Ester",
            Self::Polyglycol => "Polyglycol",
        }
    }

    /// Returns a typical density at 15 °C \[kg/m³\].
    pub fn usual_density(self) -> f64 {
        match self {
            Self::Mineral => 880.0,
            Self::Polyalphaolefin => 840.0,
            Self::Ester => 930.0,
            Self::Polyglycol => 1030.0,
        }
    }

    /// Returns the source of its correlation and the typical deviation of oils from it.
    pub fn source(self) -> &'static str {
        match self {
            Self::Mineral => {
                "Wooster: α = (6 + 9.65 log₁₀ η₀)/GPa, η₀ in mPa·s; measured mineral oils lie between 0.85 and 1.4 times it"
            }
            _ => {
                "Gold, Schmidt, Dicke, Loos and Assmann 2001: α = s·ν^t at the temperature of the contact; \
                 oils of one family differ from it by some 20 %"
            }
        }
    }

    /// Returns the pressure–viscosity coefficient α \[1/Pa\] of an oil from its dynamic viscosity \[Pa·s\] and its
    /// kinematic viscosity \[m²/s\] at the temperature of the contact. Below 0.5 mPa·s, Wooster's correlation is kept
    /// constant.
    pub fn coefficient(self, viscosity_pa_s: f64, kinematic_m2_per_s: f64) -> f64 {
        let gold = |s: f64, t: f64| 1e-9 * s * (1e6 * kinematic_m2_per_s).powf(t);
        match self {
            Self::Mineral => 1e-9 * (6.0 + 9.65 * (1e3 * viscosity_pa_s).max(0.5).log10()),
            Self::Polyalphaolefin => gold(7.382, 0.1335),
            Self::Ester => gold(6.605, 0.136),
            Self::Polyglycol => gold(5.489, 0.1485),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn celsius(degrees: f64) -> f64 {
        KELVIN + degrees
    }

    #[test]
    fn the_chart_goes_through_its_points_down_to_its_thin_end() {
        for (grade, at_100) in ISO_VG {
            let oil = ViscosityTemperature::iso_vg(grade).unwrap();
            for (degrees, viscosity) in [(40.0, grade), (100.0, at_100)] {
                assert!((1e6 * oil.at(celsius(degrees)).unwrap() / viscosity - 1.0).abs() < 2e-4, "VG {grade}");
            }
        }
        // The low end of the chart, where Z is no longer ν + 0.7.
        let thin = ViscosityTemperature::through((celsius(20.0), 1.2e-6), (celsius(80.0), 0.55e-6)).unwrap();
        assert!((1e6 * thin.at(celsius(80.0)).unwrap() - 0.55).abs() < 2e-3);
    }

    #[test]
    fn measured_oils_follow_the_chart_between_two_temperatures() {
        // Dynamic viscosities [mPa·s] of mineral oils at 30, 60 and 100 °C, of the table below.
        for [cold, warm, hot] in [[153.0, 34.0, 9.1], [250.0, 50.5, 12.6], [810.0, 135.0, 26.8], [122.0, 26.3, 7.3]] {
            let kinematic = |eta: f64, degrees: f64| 1e-3 * eta / density_at(880.0, celsius(degrees));
            let at = |eta: f64, degrees: f64| (celsius(degrees), kinematic(eta, degrees));
            let oil = ViscosityTemperature::through(at(cold, 30.0), at(hot, 100.0)).unwrap();
            let ratio = oil.at(celsius(60.0)).unwrap() / kinematic(warm, 60.0);
            assert!((ratio - 1.0).abs() < 0.05, "{warm} mPa·s at 60 °C: {ratio}");
        }
    }

    #[test]
    fn oils_that_make_no_sense_are_refused() {
        let through = |a, b| ViscosityTemperature::through(a, b).unwrap_err().to_string();
        assert!(through((celsius(40.0), 8e-6), (celsius(100.0), 68e-6)).contains("thicker at 100.0 °C"));
        assert!(through((celsius(40.0), 68e-6), (celsius(40.0), 8e-6)).contains("same temperature"));
        assert!(through((celsius(40.0), f64::NAN), (celsius(100.0), 8e-6)).contains("outside the chart"));
        assert!(through((celsius(-300.0), 68e-6), (celsius(100.0), 8e-6)).contains("−60 to 300 °C"));
        assert!(ViscosityTemperature::iso_vg(33.0).unwrap_err().to_string().contains("no ISO viscosity grade"));
        assert!(ViscosityTemperature::iso_vg(1500.0).unwrap().at(celsius(301.0)).is_err());
    }

    #[test]
    fn grade_and_temperature_give_viscosity_and_coefficient() {
        let oil = Oil {
            grade: Grade::IsoVg(68.0),
            family: OilFamily::Mineral,
            temperature_k: celsius(60.0),
            density_15: 880.0,
            alpha_per_pa: None,
        };
        let state = oil.state().unwrap();
        assert!((24e-3..28e-3).contains(&state.viscosity_pa_s), "{state:?}");
        assert!((state.viscosity_pa_s / state.kinematic_m2_per_s / state.density - 1.0).abs() < 1e-12);
        assert!((18e-9..21e-9).contains(&state.alpha_per_pa), "{state:?}");
        assert!(Oil { density_15: f64::NAN, ..oil }.state().unwrap_err().to_string().contains("none of an oil"));
    }

    #[test]
    fn thermal_constants_are_slopes_and_published_values() {
        let oil = Oil {
            grade: Grade::IsoVg(68.0),
            family: OilFamily::Mineral,
            temperature_k: celsius(60.0),
            density_15: 880.0,
            alpha_per_pa: None,
        };
        let heat = oil.state().unwrap().heat;
        let at = |shift: f64| Oil { temperature_k: celsius(60.0 + shift), ..oil }.state().unwrap();
        let slope = |of: fn(&OilState) -> f64| (of(&at(-0.5)) / of(&at(0.5))).ln();
        assert!((heat.viscosity_temperature / slope(|s| s.viscosity_pa_s) - 1.0).abs() < 1e-4);
        assert!((heat.density_temperature / slope(|s| s.density) - 1.0).abs() < 1e-4);
        // Cragoe 1929 at 15 °C for a specific gravity of 0.88 (from memory): 0.4418 kcal/(kg K), 0.132 W/(m K).
        assert!((heat_capacity(880.0, celsius(15.0)) / (0.4418 * 4186.8) - 1.0).abs() < 2e-3);
        assert!((conductivity(880.0, celsius(15.0)) - 0.132).abs() < 5e-4);
        // A measured α replaces the estimate.
        let measured = Oil { alpha_per_pa: Some(2.2e-8), ..oil };
        assert_eq!(measured.state().unwrap().alpha_per_pa, 2.2e-8);
        let refused = Oil { alpha_per_pa: Some(f64::NAN), ..oil }.state().unwrap_err().to_string();
        assert!(refused.contains("1 to 100/GPa"), "{refused}");
    }

    #[test]
    fn oil_expands_by_seven_parts_in_ten_thousand_and_kelvin() {
        let warm = density_at(880.0, celsius(65.0));
        assert_eq!(density_at(880.0, celsius(15.0)), 880.0);
        assert!((warm / 880.0 - (1.0 - 50.0 * 0.6278 / 880.0)).abs() < 1e-3, "{warm}");
    }

    /// Viscosities \[mPa·s\] and coefficients \[1/GPa\] of mineral oils at 30, 60 and 100 °C as printed by Stachowiak
    /// and Batchelor, Engineering Tribology, Table 2.3.
    const PRINTED: [(f64, f64); 20] = [
        (12.1, 18.4),
        (5.3, 13.4),
        (153.0, 23.7),
        (34.0, 20.5),
        (9.1, 15.8),
        (250.0, 25.0),
        (50.5, 21.3),
        (12.6, 17.6),
        (810.0, 34.0),
        (135.0, 28.0),
        (26.8, 22.0),
        (122.0, 27.0),
        (26.3, 21.6),
        (7.3, 17.5),
        (171.0, 28.0),
        (31.0, 23.0),
        (7.5, 18.0),
        (18.6, 20.0),
        (6.3, 16.0),
        (2.4, 13.0),
    ];

    #[test]
    fn the_correlation_of_mineral_oils_is_as_good_as_it_says() {
        for (viscosity, printed) in PRINTED {
            let ours = 1e9 * OilFamily::Mineral.coefficient(1e-3 * viscosity, 0.0);
            let ratio = printed / ours;
            assert!((0.85..=1.4).contains(&ratio), "{viscosity} mPa·s: {printed} is {ratio} times {ours}");
        }
    }

    #[test]
    fn synthetic_oils_stiffen_less_than_mineral_ones() {
        // At 40 mm²/s: mineral about 20/GPa, PAO 12, ester 11, polyglycol 9.5.
        let of = |family: OilFamily| 1e9 * family.coefficient(0.034, 40e-6);
        let [mineral, pao, ester, glycol] = OilFamily::ALL.map(of);
        assert!(mineral > pao && pao > ester && ester > glycol);
        assert!((pao - 12.1).abs() < 0.2 && (glycol - 9.5).abs() < 0.2, "{pao} {glycol}");
    }
}
