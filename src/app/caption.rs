//! Captions of figures: a contact in one line, and the method that computed its picture.

use crate::app::answers::Answers;
use crate::app::answers::picture::Origin;
use crate::app::numbers;
use crate::scene::named_lubricant;
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::engineering::KELVIN;
use crate::solver::physics::lubricant::{Cavitation, Lubricant, ShearLaw};

/// Returns a contact with its lubricant in one line.
pub fn contact(point: &OperatingPoint, lubricant: &Lubricant) -> String {
    let significant = numbers::significant;
    let load = match point.kind {
        ContactKind::Line => format!("{} N/mm", significant(1e-3 * point.load)),
        ContactKind::Point => format!("{} N", significant(point.load)),
    };
    let laws = named_lubricant::of_laws(lubricant, point)
        .map_or_else(|| laws_alone(lubricant).describe(), |named| named.title.to_owned());
    let limit = lubricant.limiting_stress.map_or_else(String::new, |limit| {
        format!(", limiting stress {} MPa + {} p", significant(1e-6 * limit.ambient), significant(limit.slope))
    });
    let conditions = conditions(lubricant);
    let plateau = point.sliding.newtonian_plateau_ratio.unwrap_or(lubricant.shear.plateau());
    let slides = match (point.sliding.slide_to_roll_ratio, lubricant.shear) {
        (0.0, ShearLaw::Newtonian) => String::new(),
        (srr, ShearLaw::Newtonian) => format!(", SRR {}", significant(srr)),
        (srr, _) => format!(", SRR {}, NPR {}", significant(srr), significant(plateau)),
    };
    let across = point.radius_y_m.map_or_else(String::new, |radius_y| format!(", R_y {}", numbers::length(radius_y)));
    format!(
        "{}, R {}{across}, speed {} m/s, load {load}, E' {} GPa, η₀ {} Pa·s, α {} 1/GPa, {laws}{limit}{slides}{conditions}",
        numbers::moes(point.moes()),
        numbers::length(point.radius_m),
        significant(point.speed_m_per_s),
        significant(1e-9 * point.modulus_pa),
        significant(point.viscosity_pa_s),
        significant(1e9 * point.alpha_per_pa)
    )
}

/// Returns the laws of the liquid alone. The conditions are written separately.
fn laws_alone(lubricant: &Lubricant) -> Lubricant {
    Lubricant { heat: None, roughness: None, cavitation: Cavitation::default(), ..lubricant.of_the_film() }
}

/// Returns roughness, oil supply and heat, each after a comma; empty for a smooth, flooded and isothermal contact.
fn conditions(lubricant: &Lubricant) -> String {
    let rough = lubricant.roughness.filter(|_| lubricant.is_rough());
    let rough = rough.map(|rough| format!(", roughness σ {}", numbers::length(rough.sigma)));
    let supply = lubricant.cavitation.supply_film_m();
    let supply = supply.map(|film| format!(", starved with an inlet film of {}", numbers::length(film)));
    let heat = lubricant.heat.map(|heat| format!(", heat from {:.1} °C at the inlet", heat.inlet_temperature - KELVIN));
    [rough, supply, heat].into_iter().flatten().collect()
}

/// Returns the method that computed the picture and its error. `None` without a picture.
pub fn means(answers: &Answers) -> Option<String> {
    let picture = answers.picture()?;
    Some(match picture.origin {
        Origin::Full => {
            let sketch = if answers.is_quick() { ", a sketch on a quick grid" } else { "" };
            let off = picture.grid_errors().map_or_else(String::new, |(h_c, h_min)| {
                let [h_c, h_min] = [h_c, h_min].map(numbers::error_percent);
                format!(", discretisation error {h_c} of H_c, {h_min} of H_min")
            });
            format!("full solution{sketch}{off}")
        }
        Origin::Reduced { error: Some(error), .. } => {
            format!("reduced model, H_c within {}", numbers::error_percent(error.h_c.bound))
        }
        Origin::Reduced { error: None, .. } => "reduced model".to_owned(),
    })
}
