//! A contact in one line, for captions of figures.

use crate::app::numbers;
use crate::scene::named_lubricant;
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::{Lubricant, ShearLaw};

/// Returns a contact with its lubricant in one line.
pub fn contact(point: &OperatingPoint, lubricant: &Lubricant) -> String {
    let significant = numbers::significant;
    let load = match point.kind {
        ContactKind::Line => format!("{} N/mm", significant(1e-3 * point.load)),
        ContactKind::Point => format!("{} N", significant(point.load)),
    };
    let laws = named_lubricant::of_laws(lubricant)
        .map_or_else(|| lubricant.of_the_film().describe(), |named| named.title.to_owned());
    let limit = lubricant.limiting_stress.map_or_else(String::new, |limit| {
        format!(", limiting stress {} MPa + {} p", significant(1e-6 * limit.ambient), significant(limit.slope))
    });
    let plateau = point.sliding.newtonian_plateau_ratio.unwrap_or(lubricant.shear.plateau());
    let slides = match (point.sliding.slide_to_roll_ratio, lubricant.shear) {
        (0.0, ShearLaw::Newtonian) => String::new(),
        (srr, ShearLaw::Newtonian) => format!(", SRR {}", significant(srr)),
        (srr, _) => format!(", SRR {}, NPR {}", significant(srr), significant(plateau)),
    };
    let across = point.radius_y_m.map_or_else(String::new, |radius_y| format!(", R_y {}", numbers::length(radius_y)));
    format!(
        "{}, R {}{across}, speed {} m/s, load {load}, E' {} GPa, η₀ {} Pa·s, α {} 1/GPa, {laws}{limit}{slides}",
        numbers::moes(point.moes()),
        numbers::length(point.radius_m),
        significant(point.speed_m_per_s),
        significant(1e-9 * point.modulus_pa),
        significant(point.viscosity_pa_s),
        significant(1e9 * point.alpha_per_pa)
    )
}
