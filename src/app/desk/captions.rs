//! What a plot is of, in the caption of its figure.

use super::Desk;
use crate::app::numbers;
use crate::app::tab::Tab;
use crate::app::tabs::{contact_map, traction, transient};
use crate::scene::named_lubricant;
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::{Lubricant, ShearLaw};

impl Desk {
    /// The parameters of what the plots of a tab are of.
    pub(super) fn caption(&self, tab: Tab) -> String {
        let is_line = self.document.point.kind == ContactKind::Line;
        let lines = match tab {
            Tab::ContactMap if !is_line => {
                contact_map::particulars(&self.answers, &self.views.map.view).map(|more| vec![self.contact(), more])
            }
            Tab::Traction => traction::export::parameters(&self.traction)
                .map(|(key, notes)| std::iter::once(contact(&key.point, &key.lubricant)).chain(notes).collect()),
            Tab::ContactMap | Tab::Transient | Tab::Tpwl => self
                .transient
                .setup
                .as_ref()
                .map(|setup| vec![contact(&setup.point, &setup.lubricant), transient::export::inputs(setup)]),
            _ => None,
        };
        lines.map_or_else(|| self.contact(), |lines: Vec<String>| lines.join("; "))
    }

    /// The contact of the sliders.
    fn contact(&self) -> String {
        contact(&self.document.point, &self.document.lubricant)
    }
}

/// A contact in a line.
fn contact(point: &OperatingPoint, lubricant: &Lubricant) -> String {
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
