//! What a reduced model was trained for, and whether a contact lies inside.

mod eyring;
mod thermal;

pub use eyring::{EyringDomain, gradient_stress};
pub use thermal::ThermalDomain;

use self::eyring::eyring_stress;
use super::oils::expected_film;
use crate::solver::full::Problem;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::{Lubricant, ShearLaw, WholeLubricant, roelands_exponent};
use serde::{Deserialize, Serialize};

/// The range a model declares to be trained for: an interval each of M, L, α and p_H at its η₀, for its lubricant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Domain {
    /// Load number.
    pub m: (f64, f64),
    /// Lubricant number.
    pub l: (f64, f64),
    /// Pressure–viscosity coefficient \[1/Pa\].
    pub alpha_per_pa: (f64, f64),
    /// Largest Hertzian pressure \[Pa\].
    pub max_hertz_pressure_pa: f64,
    /// Ambient viscosity \[Pa·s\].
    pub viscosity_pa_s: f64,
    /// Laws of the lubricant.
    #[serde(with = "WholeLubricant")]
    pub lubricant: Lubricant,
    /// What else a shear-thinning lubricant was trained for.
    pub sliding: Option<SlidingDomain>,
    /// R_y/R; (1, 1) of a model that knows circles or lines.
    pub radius_ratio: (f64, f64),
    /// The oils of a model that knows many; none of one that knows the oils with its η₀ only.
    pub oils: Option<OilDomain>,
    /// What a model of contacts with heat was trained for; its lubricant has the thermal constants.
    pub heat: Option<HeatDomain>,
    /// What a model of many oils that thin under shear by Eyring's law was trained for beside these.
    pub eyring: Option<EyringDomain>,
}

/// What a model of contacts with heat is trained for beside M, L, α, η₀ and p_H.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeatDomain {
    /// |SRR|.
    pub srr: (f64, f64),
    /// R \[m\].
    pub radius_m: (f64, f64),
    /// E′ \[Pa\].
    pub modulus_pa: (f64, f64),
    /// u_m \[m/s\].
    #[serde(deserialize_with = "limits::pair")]
    pub speed_m_per_s: (f64, f64),
    /// Largest |SRR| u_m \[m/s\].
    #[serde(deserialize_with = "limits::one")]
    pub fastest_sliding_m_per_s: f64,
    /// The thermal constants and limiting stresses of a model that knows many; of others these are its lubricant's.
    pub thermal: Option<ThermalDomain>,
}

/// What a model of many oils was trained for beside M, L, α and the largest p_H; its η₀ is one in the middle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OilDomain {
    /// η₀ \[Pa·s\].
    pub viscosity_pa_s: (f64, f64),
    /// Roelands' exponent z.
    pub exponent: (f64, f64),
    /// Smallest p_H \[Pa\].
    pub lowest_hertz_pressure_pa: f64,
    /// Thinnest H_c, by [`expected_film`]; 0 where there is no limit.
    pub thinnest_film: f64,
}

/// What is left out where a contact is a circle.
pub(crate) fn circles() -> (f64, f64) {
    CIRCLES
}

/// Limits from JSON, which writes an infinite one as `null`.
mod limits {
    use serde::{Deserialize, Deserializer};

    pub fn one<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        Ok(Option::deserialize(deserializer)?.unwrap_or(f64::INFINITY))
    }

    pub fn pair<'de, D: Deserializer<'de>>(deserializer: D) -> Result<(f64, f64), D::Error> {
        let (low, high) = <(Option<f64>, Option<f64>)>::deserialize(deserializer)?;
        Ok((low.unwrap_or(f64::INFINITY), high.unwrap_or(f64::INFINITY)))
    }
}

/// R_y/R of models that know circles or lines only.
pub const CIRCLES: (f64, f64) = (1.0, 1.0);

/// What a shear-thinning model is trained for beside M, L, α and p_H.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SlidingDomain {
    /// |SRR|.
    pub srr: (f64, f64),
    /// NPR.
    pub npr: (f64, f64),
    /// E′ \[Pa\]: with M and L it fixes the shear stress.
    pub modulus_pa: f64,
}

/// Whether a model was trained for a problem.
#[derive(Clone, Debug, PartialEq)]
pub enum Trust {
    /// Inside the declared domain.
    Trained,
    /// Outside, with a sentence that says in which quantity and by how much.
    Outside(String),
}

impl Domain {
    /// Whether errors are measured against converged full solutions, since a few Newton steps do not tell them
    /// everywhere: where a lubricant thins under shear, with heat, and over the wide windows of many oils.
    pub fn measured_in_full(&self) -> bool {
        self.sliding.is_some() || self.heat.is_some() || self.oils.is_some()
    }

    /// |SRR| that was trained; none where films know no sliding.
    pub fn srr(&self) -> Option<(f64, f64)> {
        let heat_or_eyring = || self.heat.map(|heat| heat.srr).or(self.eyring.map(|eyring| eyring.srr));
        self.sliding.map(|sliding| sliding.srr).or_else(heat_or_eyring)
    }

    /// Whether lubricants of the model thin under shear.
    pub fn thins(&self) -> bool {
        self.sliding.is_some() || self.eyring.is_some()
    }

    /// Whether a problem lies inside; boundaries count as inside to rounding.
    pub fn trust(&self, problem: &Problem) -> Trust {
        if let Some(other) = self.other_laws(problem) {
            return Trust::Outside(other.to_owned());
        }
        if problem.supply.is_some() {
            return Trust::Outside("the model was trained with a flooded inlet, not with a supplied film".to_owned());
        }
        let point = &problem.point;
        if let Some(why) = self.no_circle(point) {
            return Trust::Outside(why);
        }
        if let Some(oils) = &self.oils {
            let film = || self.thinner_film(problem).or_else(|| self.sheared_film(problem));
            if let Some(outside) = oils.outside(point).or_else(film) {
                return Trust::Outside(outside);
            }
        } else if (point.viscosity_pa_s / self.viscosity_pa_s - 1.0).abs() > 1e-6 {
            return Trust::Outside(format!(
                "the model was trained at an ambient viscosity of {} Pa·s, not {} Pa·s",
                self.viscosity_pa_s, point.viscosity_pa_s
            ));
        }
        let sliding = self.sliding.and_then(|sliding| sliding.outside(point));
        let stresses = self.eyring.zip(self.stresses(&problem.lubricant));
        let sliding = sliding.or_else(|| stresses.and_then(|(eyring, stresses)| eyring.outside(problem, stresses)));
        if let Some(outside) = sliding.or_else(|| self.heat.and_then(|heat| heat.outside(problem))) {
            return Trust::Outside(outside);
        }
        let [m, l, ratio, p_h] = self.shapes(problem);
        let alpha =
            Bounded { name: "α", value: point.alpha_per_pa, range: self.alpha_per_pa, scale: 1e9, unit: "/GPa" };
        [m, l, ratio, alpha, p_h].iter().find_map(Bounded::outside).map_or(Trust::Trained, Trust::Outside)
    }

    /// The laws of a lubricant with the model's own τ₀, and thermal constants and limit, where it knows all.
    fn with_own_constants(&self, mut laws: Lubricant) -> Lubricant {
        if self.heat.is_some_and(|heat| heat.thermal.is_some()) && laws.heat.is_some() {
            (laws.heat, laws.limiting_stress) = (self.lubricant.heat, self.lubricant.limiting_stress);
        }
        match (self.stresses(&laws), eyring_stress(self.lubricant.shear), laws.shear) {
            (Some(_), Some(critical_stress), ShearLaw::Eyring { npr, .. }) => {
                Lubricant { shear: ShearLaw::Eyring { critical_stress, npr }, ..laws }
            }
            _ => laws,
        }
    }

    /// Whether it is of a lubricant, whatever limits its traction and however its films rupture.
    pub fn is_of(&self, lubricant: &Lubricant) -> bool {
        self.with_own_constants(*lubricant).of_the_liquid() == self.lubricant.of_the_liquid()
    }

    /// A sentence where a problem has other laws than those the model was trained with.
    fn other_laws(&self, problem: &Problem) -> Option<&'static str> {
        let (asked, own) = (self.with_own_constants(problem.lubricant), self.lubricant);
        match (asked.heat, own.heat) {
            (Some(_), None) => return Some("the model was trained without heat"),
            (None, Some(_)) => return Some("the model was trained with heat"),
            _ => {}
        }
        let without_heat = |laws: Lubricant| Lubricant { heat: None, ..laws.of_the_liquid() };
        if without_heat(asked) != without_heat(own) {
            return Some("the model was trained with other lubricant laws");
        }
        // Under heat a limit cuts the heat that shear makes.
        if asked.heat.is_some() && asked.limiting_stress != own.limiting_stress {
            return Some("the model was trained with another limiting stress, which with heat changes the film");
        }
        (asked.heat != own.heat).then_some("the model was trained with other thermal constants of oil or bodies")
    }

    /// A sentence where M, L or p_H lie outside, or the contact is an ellipse, with any fluid: pressures and films of
    /// such shapes were never trained. Of another fluid inside, the bases still know the shapes, and the reduced
    /// equations are its own.
    pub fn strange_shape(&self, problem: &Problem) -> Option<String> {
        let outside = || self.shapes(problem).iter().find_map(Bounded::outside);
        let film = || self.thinner_film(problem).or_else(|| self.sheared_film(problem));
        self.no_circle(&problem.point).or_else(outside).or_else(film)
    }

    /// A sentence where a film is thinner than the model's grid was made for.
    fn thinner_film(&self, problem: &Problem) -> Option<String> {
        let (least, film) = (self.oils?.thinnest_film, expected_film(problem.point.kind, problem.moes));
        (film < least * (1.0 - 1e-6)).then(|| {
            let [film, least] = [film, least].map(digits);
            format!(
                "by Moes’ formula its film is H_c = {film}, thinner than {least}, the thinnest that the model was trained for"
            )
        })
    }

    /// A sentence where a contact is an ellipse, and the model knows circles only.
    fn no_circle(&self, point: &OperatingPoint) -> Option<String> {
        let ellipse = self.radius_ratio == CIRCLES && point.radius_ratio() != 1.0;
        ellipse.then(|| "the model was trained for circular contacts only".to_owned())
    }

    /// What the shapes of pressure and film depend on most.
    fn shapes(&self, problem: &Problem) -> [Bounded; 4] {
        let ratio = problem.point.radius_ratio();
        let (p_h, highest) = (problem.point.hertz().pressure_pa, self.max_hertz_pressure_pa);
        let lowest = self.oils.map_or(0.0, |oils| oils.lowest_hertz_pressure_pa);
        [
            Bounded { name: "M", value: problem.moes.m, range: self.m, scale: 1.0, unit: "" },
            Bounded { name: "L", value: problem.moes.l, range: self.l, scale: 1.0, unit: "" },
            Bounded { name: "the ratio of radii", value: ratio, range: self.radius_ratio, scale: 1.0, unit: "" },
            Bounded { name: "p_H", value: p_h, range: (lowest, highest), scale: 1e-9, unit: " GPa" },
        ]
    }
}

/// A quantity with the range it was trained in.
struct Bounded {
    name: &'static str,
    value: f64,
    range: (f64, f64),
    /// Shown units per SI unit.
    scale: f64,
    unit: &'static str,
}

impl Bounded {
    /// A sentence where it lies outside.
    fn outside(&self) -> Option<String> {
        let Self { name, value, range: (low, high), scale, unit } = *self;
        if value >= low * (1.0 - 1e-6) && value <= high * (1.0 + 1e-6) {
            return None;
        }
        let range = if low > 0.0 {
            format!("outside the trained range {}…{}{unit}", digits(low * scale), digits(high * scale))
        } else {
            format!("above the trained {}{unit}", digits(high * scale))
        };
        Some(format!("{name} = {}{unit} lies {range}", digits(value * scale)))
    }
}

impl OilDomain {
    /// A sentence that says in what an oil lies outside.
    fn outside(&self, point: &OperatingPoint) -> Option<String> {
        let viscosity =
            Bounded {
                name: "η₀", value: point.viscosity_pa_s, range: self.viscosity_pa_s, scale: 1e3, unit: " mPa·s"
            };
        let exponent = roelands_exponent(point);
        let exponent = Bounded { name: "Roelands’ z", value: exponent, range: self.exponent, scale: 1.0, unit: "" };
        [viscosity, exponent].iter().find_map(Bounded::outside)
    }
}

/// How far from a radius or a modulus it counts as that one.
const ROUNDED: f64 = 1e-3;

impl HeatDomain {
    /// A sentence that says in what a contact lies outside.
    fn outside(&self, problem: &Problem) -> Option<String> {
        let point = &problem.point;
        let radius = other("radius", (point.radius_m, self.radius_m), 1e3, "mm");
        if let Some(outside) = radius.or_else(|| other_modulus(point, self.modulus_pa)) {
            return Some(format!("{outside}; with heat that is another contact at equal M and L"));
        }
        let (speed, range) = (point.speed_m_per_s, self.speed_m_per_s);
        let speed = Bounded { name: "u_m", value: speed, range, scale: 1.0, unit: " m/s" };
        let plateau = problem.lubricant.shear.plateau();
        let given = point.sliding.newtonian_plateau_ratio.unwrap_or(plateau);
        if problem.shear.is_some() && given != plateau {
            return Some(format!("the model was trained with an NPR of {plateau}, not {given}"));
        }
        if let Some(outside) = self.thermal.and_then(|thermal| thermal.outside(&problem.lubricant)) {
            return Some(outside);
        }
        // Which body is the faster one matters where they are of two materials, unless both were trained as either.
        let alike =
            problem.heat.is_none_or(|heat| heat.heat.bodies[0] == heat.heat.bodies[1]) || self.thermal.is_some();
        let srr = point.sliding.slide_to_roll_ratio;
        let srr = if alike { srr.abs() } else { srr };
        let srr = Bounded { name: "SRR", value: srr, range: self.srr, scale: 1.0, unit: "" };
        let value = (point.sliding.slide_to_roll_ratio * point.speed_m_per_s).abs();
        let range = (0.0, self.fastest_sliding_m_per_s);
        let sliding = Bounded { name: "the sliding speed SRR u_m", value, range, scale: 1.0, unit: " m/s" };
        [speed, srr, sliding].iter().find_map(Bounded::outside)
    }
}

/// That sentence of a contact's reduced modulus \[Pa\].
fn other_modulus(point: &OperatingPoint, trained: (f64, f64)) -> Option<String> {
    other("reduced modulus", (point.modulus_pa, trained), 1e-9, "GPa")
}

/// A sentence where a value lies outside the one value, or the interval, that was trained, in so many shown units of SI.
fn other(name: &str, (given, (low, high)): (f64, (f64, f64)), scale: f64, unit: &str) -> Option<String> {
    if given >= low * (1.0 - ROUNDED) && given <= high * (1.0 + ROUNDED) {
        return None;
    }
    let trained = digits(low * scale);
    let trained = if low == high { trained } else { format!("{trained}…{}", digits(high * scale)) };
    Some(format!("the model was trained with a {name} of {trained} {unit}, not {} {unit}", digits(given * scale)))
}

impl SlidingDomain {
    /// A sentence that says in what a point lies outside.
    fn outside(&self, point: &OperatingPoint) -> Option<String> {
        if let Some(other) = other_modulus(point, (self.modulus_pa, self.modulus_pa)) {
            return Some(other);
        }
        let npr = point.sliding.newtonian_plateau_ratio.unwrap_or(1.0);
        let checks = [("SRR", point.sliding.slide_to_roll_ratio.abs(), self.srr), ("NPR", npr, self.npr)];
        checks
            .into_iter()
            .find(|(_, value, (low, high))| *value < low - 1e-9 || *value > high + 1e-9)
            .map(|(name, value, (low, high))| format!("{name} = {value} lies outside the trained range {low}…{high}"))
    }
}

/// Four significant digits without trailing zeros.
pub(super) fn digits(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let decimals = (3 - value.abs().log10().floor() as i32).clamp(0, 12) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::physics::contact::{ContactKind, MoesRequest, si_from_moes};
    use crate::solver::physics::lubricant::ViscosityLaw;

    #[test]
    fn what_lies_outside_is_said_with_sensible_digits() {
        let domain = Domain {
            m: (2.0, 500.0),
            l: (1.0, 21.2),
            alpha_per_pa: (5e-9, 20e-9),
            max_hertz_pressure_pa: 3.2e9,
            viscosity_pa_s: 0.01,
            lubricant: Lubricant::default(),
            sliding: None,
            radius_ratio: CIRCLES,
            oils: None,
            heat: None,
            eyring: None,
        };
        let trust = |m, l| {
            let point = si_from_moes(&MoesRequest::new(ContactKind::Line, m, l)).unwrap();
            domain.trust(&Problem::new(&point, Lubricant::default()).unwrap())
        };
        assert_eq!(trust(40.0, 10.0), Trust::Trained);
        assert_eq!(trust(1.0, 10.0), Trust::Outside("M = 1 lies outside the trained range 2…500".to_owned()));
        let Trust::Outside(why) = trust(200.0, 15.0) else { panic!("beyond the pressure limit") };
        assert!(why.starts_with("p_H = 4.8") && why.ends_with("GPa lies above the trained 3.2 GPa"), "{why}");
        // Another fluid, or another α, may have shapes that are known.
        let barus = Lubricant { viscosity: ViscosityLaw::Barus, ..Lubricant::default() };
        let shape = |m, l, lubricant| {
            let point = si_from_moes(&MoesRequest::new(ContactKind::Line, m, l)).unwrap();
            let domain = Domain { alpha_per_pa: (1e-9, 2e-9), ..domain.clone() };
            let problem = Problem::new(&point, lubricant).unwrap();
            assert!(matches!(domain.trust(&problem), Trust::Outside(_)));
            domain.strange_shape(&problem)
        };
        assert_eq!(shape(40.0, 10.0, barus), None);
        assert_eq!(shape(40.0, 10.0, Lubricant::default()), None);
        assert!(shape(1.0, 10.0, barus).is_some_and(|why| why.starts_with("M = 1 lies outside")));
        assert!(shape(200.0, 15.0, barus).is_some_and(|why| why.starts_with("p_H")));
    }
}
