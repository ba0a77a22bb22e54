//! Selects reduced models by the contacts that they cover.

use crate::solver::full::Problem;
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::{Lubricant, ShearLaw};
use crate::solver::reduced::{Domain, Trust};
use std::cmp::Ordering;
use std::mem::discriminant;

/// Ranking of a model for a contact; the smallest value is best.
///
/// Models that cover the contact come first, among these the one for its shape with the smallest range. Models that do
/// not cover it are ranked by agreement in surfaces, heat, shear law, shape and lubricant, then by the distance in M.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Remoteness {
    outside: bool,
    kinds: [u8; 5],
    far: f64,
}

impl Remoteness {
    fn of(domain: &Domain, problem: Option<&Problem>, point: &OperatingPoint, lubricant: &Lubricant) -> Self {
        let outside = problem.is_none_or(|problem| domain.trust(problem) != Trust::Trained);
        let other_shape = domain.space.of_ellipses() != point.is_elliptic();
        if !outside {
            return Self { outside, kinds: [other_shape.into(), 0, 0, 0, 0], far: extent(domain) };
        }
        let law = match (
            discriminant(&domain.lubricant.shear) == discriminant(&lubricant.shear),
            is_shear_thinning(lubricant),
        ) {
            (true, _) => 0,
            (false, thinning) => 1 + u8::from(thinning != is_shear_thinning(&domain.lubricant)),
        };
        let other_surfaces = domain.is_rough() != lubricant.is_rough();
        let other_heat = domain.heats() != lubricant.heat.is_some();
        let other_lubricant = !domain.is_of(lubricant);
        let ((low, high), m) = (domain.m(), point.moes().m);
        let far = (low / m).max(m / high).max(1.0).ln();
        Self {
            outside,
            kinds: [other_surfaces.into(), other_heat.into(), law, other_shape.into(), other_lubricant.into()],
            far,
        }
    }

    fn cmp(&self, other: &Self) -> Ordering {
        let kinds = (self.outside, self.kinds).cmp(&(other.outside, other.kinds));
        kinds.then(self.far.total_cmp(&other.far))
    }
}

/// True if a lubricant is shear-thinning.
fn is_shear_thinning(laws: &Lubricant) -> bool {
    laws.shear != ShearLaw::Newtonian
}

/// Returns the logarithmic size of a range in M, L, α, η₀ and p_H.
fn extent(domain: &Domain) -> f64 {
    let quantities = [Quantity::M, Quantity::L, Quantity::Alpha, Quantity::Viscosity, Quantity::HertzPressure];
    let widths = quantities.iter().filter_map(|quantity| domain.interval(*quantity));
    widths.map(|(low, high)| (high / low.max(1e-3 * high)).ln()).sum()
}

/// Returns the best model for a contact with a lubricant: the one with the smallest range among those that cover it, or
/// otherwise the nearest. `None` if there is no model of the contact kind, or if none supports the shear law:
/// shear-thinning or not.
pub fn best<'a, T>(
    models: impl IntoIterator<Item = (T, &'a Domain)>,
    point: &OperatingPoint,
    lubricant: &Lubricant,
) -> Option<T> {
    let problem = Problem::new(point, *lubricant).ok();
    // A model for another shear-thinning law only has a larger error. A model without shear thinning has no equations
    // for it.
    let serves =
        |domain: &Domain| domain.heats() || is_shear_thinning(&domain.lubricant) == is_shear_thinning(lubricant);
    let of_kind = models.into_iter().filter(|(_, domain)| domain.contact == point.kind && serves(domain));
    let judged = of_kind.map(|(model, domain)| (Remoteness::of(domain, problem.as_ref(), point, lubricant), model));
    judged.min_by(|(a, _), (b, _)| a.cmp(b)).map(|(_, model)| model)
}

/// Returns true if two models are alternatives: same contact kind, surfaces, heat, shear law and shape, and overlapping
/// loads.
pub fn alike(one: &Domain, other: &Domain) -> bool {
    let kind = |domain: &Domain| (domain.contact, domain.space.of_ellipses(), domain.heats(), domain.is_rough());
    let law = |domain: &Domain| discriminant(&domain.lubricant.shear);
    kind(one) == kind(other) && law(one) == law(other) && loads_in_common(one, other) > 0.0
}

/// Returns the overlap of two models in ln M.
pub fn loads_in_common(one: &Domain, other: &Domain) -> f64 {
    let (a, b) = (one.m(), other.m());
    (a.1.min(b.1) / a.0.max(b.0)).ln()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::catalogue;
    use crate::scene::named_lubricant::SQUALANE_PIP;
    use crate::solver::physics::contact::{ContactKind, MoesRequest, si_from_moes};
    use crate::solver::physics::lubricant::{Heat, ViscosityLaw};
    use crate::solver::physics::surfaces::Roughness;

    fn serves(point: &OperatingPoint, lubricant: &Lubricant) -> &'static str {
        best(catalogue().iter().map(|entry| (entry.name, &entry.domain)), point, lubricant).unwrap()
    }

    #[test]
    fn a_contact_is_served_by_the_model_of_its_shape_and_lubricant() {
        let at = |kind, m| si_from_moes(&MoesRequest::new(kind, m, 5.0)).unwrap();
        let (circle, light, line) =
            (at(ContactKind::Point, 50.0), at(ContactKind::Point, 6.0), at(ContactKind::Line, 50.0));
        let ellipse = Quantity::RadiusRatio.at(&circle, 2.0);
        let oil = Lubricant::default();
        let eyring = Lubricant { shear: ShearLaw::Eyring { critical_stress: 5e6, npr: 0.0 }, ..oil };
        let warm = Lubricant { heat: Some(Heat::default()), ..oil };
        let rough = oil.on_rough_surfaces(Some(Roughness::new(1e-7)));
        for (point, lubricant, wanted) in [
            (circle, oil, "point"),
            (Quantity::RadiusRatio.at(&circle, 1.0), oil, "point"),
            (ellipse, oil, "ellipse"),
            (light, oil, "point_light"),
            (at(ContactKind::Point, 900.0), oil, "point"),
            (line, oil, "line"),
            (ellipse, SQUALANE_PIP, "point_shear"),
            (line, SQUALANE_PIP, "line_shear"),
            (line, eyring, "line_sliding"),
            (circle, eyring, "point_sliding"),
            (ellipse, eyring, "point_sliding"),
            (light, eyring, "point_light_sliding"),
            (line, rough, "line_rough"),
            (at(ContactKind::Line, 900.0), rough, "line_rough"),
            (circle, rough, "point_rough"),
            (light, rough, "point_rough"),
            (line, warm, "line_heat"),
            (circle, warm, "point_heat"),
            (ellipse, warm, "point_heat"),
        ] {
            assert_eq!(serves(&point, &lubricant), wanted, "{point:?}");
        }
    }

    #[test]
    fn the_covering_model_with_the_smallest_range_is_used() {
        let wide = catalogue().iter().find(|entry| entry.name == "line").unwrap().domain.clone();
        let mut narrow = wide.clone();
        narrow.space.axis_mut(Quantity::M).unwrap().ends = (20.0, 80.0);
        let models = [("wide", &wide), ("narrow", &narrow)];
        let at = |m| si_from_moes(&MoesRequest::new(ContactKind::Line, m, 5.0)).unwrap();
        let oil = Lubricant::default();
        assert_eq!(best(models, &at(40.0), &oil), Some("narrow"));
        assert_eq!(best(models, &at(100.0), &oil), Some("wide"));
        assert_eq!(
            best(models, &at(40.0), &SQUALANE_PIP),
            None,
            "neither has equations for a lubricant that is shear-thinning"
        );
        let waxy = Lubricant { viscosity: ViscosityLaw::Barus, ..oil };
        assert_eq!(best(models, &at(40.0), &waxy), Some("wide"), "the first of equals");
        assert_eq!(
            best([("wide", &wide)], &si_from_moes(&MoesRequest::new(ContactKind::Point, 40.0, 5.0)).unwrap(), &oil),
            None
        );
    }
}
