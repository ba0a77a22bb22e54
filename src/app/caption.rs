//! Captions of figures: a contact in one line, and the method that computed its picture.

use crate::app::answers::Answers;
use crate::app::answers::picture::Origin;
use crate::app::numbers;
use crate::scene::named_lubricant;
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::engineering::{QuantityKind, UnitSystem};
use crate::solver::physics::lubricant::{Cavitation, Lubricant, ShearLaw};

/// Returns a contact with its lubricant in one line.
pub fn contact(point: &OperatingPoint, lubricant: &Lubricant, system: UnitSystem) -> String {
    let shown = |kind, si| numbers::shown(kind, si, system).replace(numbers::THIN, " ");
    let laws = named_lubricant::of_laws(lubricant, point)
        .map_or_else(|| laws_alone(lubricant).describe(), |named| named.title.to_owned());
    let limit = lubricant.limiting_stress.map_or_else(String::new, |limit| {
        let ambient = shown(QuantityKind::Stress, limit.ambient);
        format!(", limiting stress {ambient} + {} p", numbers::significant(limit.slope))
    });
    let conditions = conditions(lubricant, system);
    let plateau = point.sliding.newtonian_plateau_ratio.unwrap_or(lubricant.shear.plateau());
    let srr = point.sliding.slide_to_roll_ratio;
    let slides = match (srr, lubricant.shear) {
        (0.0, ShearLaw::Newtonian) => String::new(),
        (_, ShearLaw::Newtonian) => format!(", SRR {}", numbers::slide_to_roll(srr)),
        _ => format!(", SRR {}, NPR {}", numbers::slide_to_roll(srr), numbers::significant(plateau)),
    };
    let across = point.radius_y_m.map(|radius_y| format!(", R_y {}", numbers::length(radius_y, system)));
    format!(
        "{}, R {}{}, speed {}, load {}, E' {}, η₀ {}, α {}, {laws}{limit}{slides}{conditions}",
        numbers::moes(point.moes()),
        numbers::length(point.radius_m, system),
        across.unwrap_or_default(),
        shown(QuantityKind::Speed, point.speed_m_per_s),
        shown(Quantity::Load.kind(point.kind), point.load),
        shown(QuantityKind::Pressure, point.modulus_pa),
        shown(QuantityKind::Viscosity, point.viscosity_pa_s),
        shown(QuantityKind::PressureCoefficient, point.alpha_per_pa)
    )
}

/// Returns the laws of the liquid alone. The conditions are written separately.
fn laws_alone(lubricant: &Lubricant) -> Lubricant {
    Lubricant { heat: None, roughness: None, cavitation: Cavitation::default(), ..lubricant.of_the_film() }
}

/// Returns roughness, oil supply and heat, each after a comma; empty for a smooth, flooded and isothermal contact.
fn conditions(lubricant: &Lubricant, system: UnitSystem) -> String {
    let rough = lubricant.roughness.filter(|_| lubricant.is_rough());
    let rough = rough.map(|rough| format!(", roughness σ {}", numbers::length(rough.sigma, system)));
    let supply = lubricant.cavitation.supply_film_m();
    let supply = supply.map(|film| format!(", starved with an inlet film of {}", numbers::length(film, system)));
    let temperature = |kelvin: f64| numbers::shown(QuantityKind::Temperature, kelvin, system);
    let heat = lubricant.heat.map(|heat| format!(", heat from {} at the inlet", temperature(heat.inlet_temperature)));
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
