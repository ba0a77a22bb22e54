//! Validity range of a reduced model: a space of contacts with the laws of one lubricant, and tests whether a contact
//! is inside.

use crate::solver::full::{Problem, SolveError};
use crate::solver::parameters::{Outside, ParameterSpace, Quantity, REFERENCE_ROUGHNESS_M, enlarged};
use crate::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, si_from_moes};
use crate::solver::physics::lubricant::{Lubricant, LubricantOfModel, ShearLaw};
use crate::solver::physics::surfaces::Roughness;
use serde::{Deserialize, Serialize};

/// Contacts that a reduced model covers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Domain {
    /// Line or point contacts.
    pub contact: ContactKind,
    /// Varied and fixed quantities.
    pub space: ParameterSpace,
    /// Laws of the lubricant.
    #[serde(with = "LubricantOfModel")]
    pub lubricant: Lubricant,
}

/// Result of the test whether a model covers a problem.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Trust {
    /// Inside the trained range.
    Trained,
    /// Outside, with the reason.
    Outside(Outside),
}

/// Relative tolerance at the ends of an interval, for rounding.
const ROUNDING: f64 = 1e-6;
/// Relative tolerance of a radius or a modulus, which users state to few digits.
const STATED: f64 = 1e-3;

impl Domain {
    /// Returns the interval of a quantity over all contacts; `None` if the quantity is not restricted.
    pub fn interval(&self, quantity: Quantity) -> Option<(f64, f64)> {
        self.space.interval(quantity, self.contact)
    }

    /// Returns the interval of M (Moes load parameter).
    pub fn m(&self) -> (f64, f64) {
        self.interval(Quantity::M).unwrap_or((0.0, f64::INFINITY))
    }

    /// Returns the interval of L (Moes lubricant parameter).
    pub fn l(&self) -> (f64, f64) {
        self.interval(Quantity::L).unwrap_or((0.0, f64::INFINITY))
    }

    /// Returns the largest Hertzian pressure p_H \[Pa\]; infinity if it is not limited.
    pub fn highest_pressure_pa(&self) -> f64 {
        self.interval(Quantity::HertzPressure).map_or(f64::INFINITY, |(_, highest)| highest)
    }

    /// Returns the viscosity η₀ \[Pa·s\] of the contacts, or the geometric mean of its interval.
    pub fn middle_viscosity_pa_s(&self) -> f64 {
        self.space
            .axis(Quantity::Viscosity)
            .map_or_else(|| self.interval(Quantity::Viscosity).map_or(f64::NAN, |(low, _)| low), |axis| axis.value(0.5))
    }

    /// Returns true for thermal contacts.
    pub fn heats(&self) -> bool {
        self.lubricant.heat.is_some()
    }

    /// Returns true for isothermal contacts with shear-thinning lubricants, whose film thickness depends on sliding.
    pub fn is_shear_thinning(&self) -> bool {
        self.lubricant.shear != ShearLaw::Newtonian && !self.heats()
    }

    /// Returns true if the film thickness depends on sliding, by shear-thinning or by heat.
    pub fn slides(&self) -> bool {
        self.is_shear_thinning() || self.heats()
    }

    /// Returns true for contacts with rough surfaces.
    pub fn is_rough(&self) -> bool {
        self.space.is_rough()
    }

    /// Returns true if errors are measured against converged full solutions. For shear-thinning, thermal, rough and
    /// lubricant-parameterised models a few Newton steps do not show all errors.
    pub fn measured_in_full(&self) -> bool {
        self.slides() || self.space.varies_lubricant() || self.is_rough()
    }

    /// Returns the interval of |SRR| (slide-to-roll ratio); `None` if the film thickness does not depend on sliding.
    pub fn srr(&self) -> Option<(f64, f64)> {
        self.slides().then(|| self.space.interval(Quantity::SlideToRollRatio, self.contact))?
    }

    /// Returns true if the Eyring stress τ₀ is free: a lubricant-parameterised model depends only on the product with
    /// the reduced modulus, E′ τ₀.
    fn frees_eyring_stress(&self) -> bool {
        self.is_shear_thinning() && self.space.varies_lubricant()
    }

    /// Returns τ₀ of a lubricant relative to that of the model; `None` if τ₀ is not free or the lubricant has none.
    fn stress_ratio(&self, lubricant: &Lubricant) -> Option<f64> {
        let stress = |laws: &Lubricant| Quantity::EyringStress.of_contact(&OperatingPoint::TABLE_2_1, laws);
        if self.frees_eyring_stress() { Some(stress(lubricant)? / stress(&self.lubricant)?) } else { None }
    }

    /// Returns the contact with the model's own τ₀ that has the same dimensionless film: M, L, p_H, lubricant, SRR
    /// and E′ τ₀ are equal. For rough surfaces, returns the contact with the reference roughness that has the same M,
    /// L, p_H and film ratio. Returns the contact itself if neither τ₀ nor the roughness is free.
    pub(crate) fn as_trained(&self, point: &OperatingPoint, lubricant: &Lubricant) -> OperatingPoint {
        if let Some(Roughness { sigma, .. }) = lubricant.roughness.filter(|rough| self.is_rough() && rough.sigma > 0.0)
        {
            return enlarged(point, REFERENCE_ROUGHNESS_M / sigma);
        }
        let Some(stresses) = self.stress_ratio(lubricant) else { return *point };
        // At constant L, 2U is proportional to E′⁻⁴. The speed then follows from 2U E′ R, and the load from M.
        let load = stresses.powi(-point.kind.radius_power());
        OperatingPoint {
            modulus_pa: point.modulus_pa * stresses,
            speed_m_per_s: point.speed_m_per_s * stresses.powi(-3),
            load: point.load * load,
            ..*point
        }
    }

    /// Returns the problem whose equations are solved: with the reference roughness for rough surfaces, otherwise the
    /// problem itself. Both have the same dimensionless numbers.
    pub(crate) fn as_solved(&self, problem: &Problem) -> Result<Problem, SolveError> {
        let Some(roughness) = problem.lubricant.roughness.filter(|_| self.is_rough()) else { return Ok(*problem) };
        let roughness = Some(Roughness { sigma: REFERENCE_ROUGHNESS_M, ..roughness });
        let lubricant = Lubricant { roughness, ..problem.lubricant };
        Problem::new(&self.as_trained(&problem.point, &problem.lubricant), lubricant)
    }

    /// Returns true if the traction quadrature is valid for the limiting stress of a problem. It is fitted to unlimited
    /// stresses; for lubricant-parameterised Eyring models also to limited ones; with heat to the model's own limit.
    pub(crate) fn knows_traction(&self, problem: &Problem) -> bool {
        let Some(limit) = problem.lubricant.limiting_stress else { return true };
        match self.stress_ratio(&problem.lubricant) {
            Some(stresses) => {
                let slope = Quantity::LimitSlope;
                let ends = self.space.constant(slope);
                ends.is_some_and(|ends| {
                    Outside::of(slope, self.contact, limit.slope / stresses, ends, ROUNDING).is_none()
                })
            }
            None => problem.heat.is_some(),
        }
    }

    /// Returns whether the model covers a problem. The ends of intervals count as inside.
    pub fn trust(&self, problem: &Problem) -> Trust {
        let other = |why: &str| Trust::Outside(Outside::Other(why.to_owned()));
        if let Some(why) = self.other_laws(problem) {
            return other(why);
        }
        if problem.supply.is_some() {
            return other("the model was trained with a fully flooded inlet, not with a starved one");
        }
        let found = self.other_shape(&problem.point).or_else(|| self.other_plateau(problem));
        let found = found.or_else(|| self.other_constants(&problem.lubricant));
        let found = found.or_else(|| self.other_surfaces(problem));
        found.or_else(|| self.outside(problem, |_| true)).map_or(Trust::Trained, Trust::Outside)
    }

    /// Returns the reason why the shapes of pressure and film are not covered, for any lubricant: M, L, p_H, the film
    /// thickness or the radius ratio is outside. If they are inside, the bases apply to other lubricants as well, and
    /// the reduced equations are exact.
    pub fn strange_shape(&self, problem: &Problem) -> Option<Outside> {
        self.other_shape(&problem.point).or_else(|| self.outside(problem, Quantity::changes_shapes))
    }

    /// Returns true if the domain is of this lubricant. The limiting stress and the cavitation model are not compared.
    pub fn is_of(&self, lubricant: &Lubricant) -> bool {
        self.with_own_constants(*lubricant).of_the_liquid() == self.lubricant.of_the_liquid()
    }

    /// Replaces the constants that the model leaves free by the model's own.
    fn with_own_constants(&self, mut laws: Lubricant) -> Lubricant {
        if !self.space.constants.is_empty() && laws.heat.is_some() && self.heats() {
            (laws.heat, laws.limiting_stress) = (self.lubricant.heat, self.lubricant.limiting_stress);
        }
        if self.is_rough() {
            laws.roughness = self.lubricant.roughness;
        }
        match (laws.shear, self.lubricant.shear) {
            (ShearLaw::Eyring { npr, .. }, ShearLaw::Eyring { critical_stress, .. }) if self.frees_eyring_stress() => {
                Lubricant { shear: ShearLaw::Eyring { critical_stress, npr }, ..laws }
            }
            _ => laws,
        }
    }

    /// Returns a sentence if a problem has laws that the model was not trained with.
    fn other_laws(&self, problem: &Problem) -> Option<&'static str> {
        match (problem.rough.is_some(), self.is_rough()) {
            (true, false) => return Some("the model was trained for smooth surfaces"),
            (false, true) => return Some("the model was trained for rough surfaces"),
            _ => {}
        }
        let (asked, own) = (self.with_own_constants(problem.lubricant), self.lubricant);
        match (asked.heat, own.heat) {
            (Some(_), None) => return Some("the model was trained for isothermal contacts"),
            (None, Some(_)) => return Some("the model was trained for thermal contacts"),
            _ => {}
        }
        let without_heat = |laws: Lubricant| Lubricant { heat: None, ..laws.of_the_liquid() };
        if without_heat(asked) != without_heat(own) {
            return Some("the model was trained with other lubricant laws");
        }
        // In a thermal contact the limiting stress also limits the heat generated by shear.
        if asked.heat.is_some() && asked.limiting_stress != own.limiting_stress {
            return Some(
                "the model was trained with another limiting stress, which changes the film thickness of thermal contacts",
            );
        }
        (asked.heat != own.heat).then_some("the model was trained with other thermal constants of lubricant or bodies")
    }

    fn other_shape(&self, point: &OperatingPoint) -> Option<Outside> {
        let ellipse = !self.space.of_ellipses() && point.is_elliptic();
        ellipse.then(|| Outside::Other("the model was trained for circular contacts only".to_owned()))
    }

    /// Checks a constant plateau ratio. Eyring and thermal models use the lubricant's own.
    fn other_plateau(&self, problem: &Problem) -> Option<Outside> {
        let plateau = problem.lubricant.shear.plateau();
        let given = problem.point.sliding.newtonian_plateau_ratio.unwrap_or(plateau);
        let fixed = self.slides() && problem.shear.is_some() && !self.space.knows(Quantity::NewtonianPlateauRatio);
        (fixed && given != plateau)
            .then(|| Outside::Other(format!("the model was trained with an NPR of {plateau}, not {given}")))
    }

    /// Checks the constants of a thermal lubricant and its bodies that the model leaves free within intervals.
    pub(crate) fn other_constants(&self, lubricant: &Lubricant) -> Option<Outside> {
        if !self.heats() || self.space.constants.is_empty() {
            return None;
        }
        if lubricant.heat.is_some_and(|heat| heat.oil.free_volume.is_some()) {
            let why = "the model was trained with lubricants whose α does not change with temperature";
            return Some(Outside::Other(why.to_owned()));
        }
        let point = OperatingPoint::TABLE_2_1;
        self.space.constants.iter().find_map(|axis| match axis.quantity.of_contact(&point, lubricant) {
            Some(value) => Outside::of(axis.quantity, self.contact, value, axis.ends, ROUNDING),
            None => Some(Outside::Other(format!(
                "the model was trained with limiting stresses that have a τ_E, which changes the film thickness of thermal contacts; {} is missing",
                axis.quantity.short()
            ))),
        })
    }

    /// Returns true if a quantity has an influence in addition to M, L, α, η₀ and p_H.
    fn counts(&self, quantity: Quantity) -> bool {
        match quantity {
            Quantity::Load => false,
            Quantity::Radius | Quantity::Speed | Quantity::SlidingSpeed => self.heats(),
            Quantity::Modulus | Quantity::SlideToRollRatio | Quantity::NewtonianPlateauRatio => self.slides(),
            _ => true,
        }
    }

    /// Returns the first quantity that is outside, of those selected by `asked`.
    fn outside(&self, problem: &Problem, asked: impl Fn(Quantity) -> bool) -> Option<Outside> {
        let point = self.as_trained(&problem.point, &problem.lubricant);
        let space = &self.space;
        let given = space.axes.iter().map(|axis| axis.quantity).chain(space.fixed.iter().map(|(fixed, _)| *fixed));
        let limits = space.limits.iter().map(|(limited, _)| *limited).filter(|limited| !space.gives(*limited));
        let followers = [Quantity::M, Quantity::L, Quantity::Alpha, Quantity::Viscosity, Quantity::HertzPressure];
        let followers =
            followers.into_iter().filter(|follows| !space.gives(*follows) && space.limit(*follows).is_none());
        let checked =
            given.chain(limits).chain(followers).filter(|quantity| asked(*quantity) && self.counts(*quantity));
        let mut found = checked.filter_map(|quantity| self.value_outside(quantity, &point, &problem.lubricant));
        found.next().or_else(|| self.outside_box(&point).filter(|_| asked(Quantity::M)))
    }

    fn value_outside(&self, quantity: Quantity, point: &OperatingPoint, lubricant: &Lubricant) -> Option<Outside> {
        let ends = self.interval(quantity)?;
        let value = match quantity {
            // For another law there is no stress to compare with.
            Quantity::GradientStress => self.stress_ratio(lubricant).and_then(|_| quantity.of(point))?,
            // A Newtonian lubricant has no plateau.
            Quantity::NewtonianPlateauRatio => quantity.of(point).unwrap_or(1.0),
            // Film thickness is even in SRR if both bodies are of the same material, or if the model was trained with
            // either order.
            Quantity::SlideToRollRatio if !self.distinguishes_bodies(lubricant) => quantity.of(point)?.abs(),
            _ => quantity.of(point)?,
        };
        let tolerance = match quantity {
            Quantity::Radius | Quantity::Modulus => STATED,
            _ => ROUNDING,
        };
        let found = Outside::of(quantity, self.contact, value, ends, tolerance)?;
        Some(match self.stress_ratio(lubricant) {
            Some(stresses) if quantity == Quantity::Modulus => {
                self.other_stress(point, stresses, ends).unwrap_or(found)
            }
            _ => found,
        })
    }

    /// Expresses E′ τ₀ outside its interval as an interval of τ₀ for the contact's own E′.
    fn other_stress(&self, point: &OperatingPoint, stresses: f64, (low, high): (f64, f64)) -> Option<Outside> {
        let stress = Quantity::EyringStress.of_contact(point, &self.lubricant)? * stresses;
        let at = |own: f64| stress * own / point.modulus_pa;
        Outside::of(Quantity::EyringStress, self.contact, stress, (at(low), at(high)), 0.0)
    }

    /// Returns true if exchanging the bodies changes the film: their materials differ, and the model was not trained
    /// with either order.
    fn distinguishes_bodies(&self, lubricant: &Lubricant) -> bool {
        let differ = lubricant.heat.is_some_and(|heat| heat.bodies[0] != heat.bodies[1]);
        differ && self.space.constants.is_empty()
    }

    /// Checks a box of radius R, speed u_m and load w: whether some contact of the box has the M, L, α and η₀ of the
    /// given one. For given values u_m/R and w/R (w/R² for circular contacts) are fixed by the box's E′, so that R
    /// alone is free.
    fn outside_box(&self, point: &OperatingPoint) -> Option<Outside> {
        if !self.space.is_si_box() {
            return None;
        }
        let moes = point.moes();
        let ends = |quantity| self.space.interval(quantity, self.contact);
        let (radius, speed, load) = (ends(Quantity::Radius)?, ends(Quantity::Speed)?, ends(Quantity::Load)?);
        let request = MoesRequest {
            radius_m: Some(radius.0),
            modulus_pa: Some(ends(Quantity::Modulus)?.0),
            viscosity_pa_s: Some(point.viscosity_pa_s),
            alpha_per_pa: Some(point.alpha_per_pa),
            ..MoesRequest::new(self.contact, moes.m, moes.l)
        };
        let outside = Some(Outside::Box { m: moes.m, l: moes.l });
        let Ok(smallest) = si_from_moes(&request) else { return outside };
        let power = f64::from(self.contact.radius_power());
        // Interval of R that the intervals of u_m and w permit.
        let by_speed = |speed: f64| radius.0 * speed / smallest.speed_m_per_s;
        let by_load = |load: f64| radius.0 * (load / smallest.load).powf(1.0 / power);
        let least = radius.0.max(by_speed(speed.0)).max(by_load(load.0));
        let most = radius.1.min(by_speed(speed.1)).min(by_load(load.1));
        if least <= most * (1.0 + ROUNDING) { None } else { outside }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::parameters::Axis;
    use crate::solver::physics::lubricant::ViscosityLaw;
    use crate::solver::training::random_points;
    use fastrand::Rng;

    const LINE: ContactKind = ContactKind::Line;

    fn domain(alpha: (f64, f64)) -> Domain {
        let space = ParameterSpace::of([
            Axis::new(Quantity::M, (2.0, 500.0)),
            Axis::new(Quantity::L, (1.0, 21.2)),
            Axis::new(Quantity::Alpha, alpha),
        ])
        .limited([(Quantity::HertzPressure, (0.0, 3.2e9))])
        .fixing([(Quantity::Viscosity, 0.01)]);
        Domain { contact: LINE, space, lubricant: Lubricant::default() }
    }

    fn line(m: f64, l: f64) -> OperatingPoint {
        si_from_moes(&MoesRequest::new(LINE, m, l)).unwrap()
    }

    #[test]
    fn a_contact_outside_is_named_with_quantity_value_and_interval() {
        let domain = domain((5e-9, 20e-9));
        let trust = |m, l| domain.trust(&Problem::new(&line(m, l), Lubricant::default()).unwrap());
        let why = |m, l| match trust(m, l) {
            Trust::Outside(why) => why.to_string(),
            Trust::Trained => panic!("{m} {l}"),
        };
        assert_eq!(trust(40.0, 10.0), Trust::Trained);
        assert_eq!(why(1.0, 10.0), "M = 1 lies outside the trained range 2…500");
        let pressure = why(200.0, 15.0);
        assert!(
            pressure.starts_with("p_H = 4.8") && pressure.ends_with("GPa lies above the trained 3.2 GPa"),
            "{pressure}"
        );
    }

    #[test]
    fn another_lubricant_may_have_shapes_the_model_covers() {
        let barus = Lubricant { viscosity: ViscosityLaw::Barus, ..Lubricant::default() };
        let shape = |m, l, lubricant| {
            let domain = domain((1e-9, 2e-9));
            let problem = Problem::new(&line(m, l), lubricant).unwrap();
            assert!(matches!(domain.trust(&problem), Trust::Outside(_)));
            domain.strange_shape(&problem).map(|why| why.to_string())
        };
        assert_eq!(shape(40.0, 10.0, barus), None);
        assert_eq!(shape(40.0, 10.0, Lubricant::default()), None);
        assert!(shape(1.0, 10.0, barus).is_some_and(|why| why.starts_with("M = 1 lies outside")));
        assert!(shape(200.0, 15.0, barus).is_some_and(|why| why.starts_with("p_H")));
    }

    #[test]
    fn a_box_covers_contacts_with_equal_numbers_only() {
        for (contact, space) in [(LINE, ParameterSpace::table_3_1()), (ContactKind::Point, ParameterSpace::table_3_4())]
        {
            let domain = Domain { contact, space: space.clone(), lubricant: Lubricant::default() };
            let trusted = |point: &OperatingPoint| {
                domain.trust(&Problem::new(point, Lubricant::default()).unwrap()) == Trust::Trained
            };
            let mut rng = Rng::with_seed(5);
            for point in random_points(&space, contact, 300, 1) {
                assert!(trusted(&point), "{point:?}");
                // The same numbers with another R and E′ describe the same contact.
                let request = MoesRequest {
                    radius_m: Some(0.1 * rng.f64() + 1e-3),
                    modulus_pa: Some(1e11),
                    viscosity_pa_s: Some(point.viscosity_pa_s),
                    alpha_per_pa: Some(point.alpha_per_pa),
                    ..MoesRequest::new(contact, point.moes().m, point.moes().l)
                };
                assert!(trusted(&si_from_moes(&request).unwrap()));
            }
            // Random numbers of the surrounding rectangle: inside exactly if some R of the box fits, found by trial.
            let [m, l] = [domain.m(), domain.l()];
            let (mut inside, mut outside) = (0, 0);
            for _ in 0..300 {
                let between = |(low, high): (f64, f64), t: f64| low * (high / low).powf(t);
                let alpha = between((5e-9, 20e-9), rng.f64());
                let request = MoesRequest {
                    viscosity_pa_s: Some(0.01),
                    alpha_per_pa: Some(alpha),
                    ..MoesRequest::new(contact, between(m, rng.f64()), between(l, rng.f64()))
                };
                let Ok(point) = si_from_moes(&request) else { continue };
                let (from, to) = space.axis(Quantity::Radius).unwrap().ends;
                let within = |quantity: Quantity, value: f64| {
                    let (low, high) = space.axis(quantity).unwrap().ends;
                    (low..=high).contains(&value)
                };
                let some = (0..=4000).any(|k| {
                    let radius = from + (to - from) * f64::from(k) / 4000.0;
                    let own = si_from_moes(&MoesRequest { radius_m: Some(radius), ..request }).unwrap();
                    within(Quantity::Speed, own.speed_m_per_s) && within(Quantity::Load, own.load)
                });
                assert_eq!(trusted(&point), some, "{request:?}");
                if some { inside += 1 } else { outside += 1 }
            }
            assert!(inside > 20 && outside > 20, "{inside} {outside}");
        }
    }
}
