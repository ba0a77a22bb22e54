//! Choice of the reduced model for the curve of a sweep, and its trained range.

use super::sweeps::Choices;
use crate::app::answers::Answers;
use crate::app::document::{Document, Key};
use crate::app::in_use::InUse;
use crate::app::refusal::Refusal;
use crate::app::tabs::traction::{Sweep, Varied};
use crate::solver::full::Problem;
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::lubricant::{LARGEST_HEATED_SRR, ShearLaw};
use crate::solver::reduced::{Domain, Trust};

/// Minimum lower end of a logarithmic axis of NPR.
const LOG_NPR: f64 = 1e-2;

/// Method that computes a curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Served {
    /// Reduced model with its truncation; `None` for full solutions that are fast enough.
    pub by: Option<InUse>,
    /// Reason why the curve is outside the trained range, such as another fluid. The model solves the equations of
    /// these contacts, but its errors have not been calibrated for them.
    pub untrained: Option<String>,
}

/// Returns the sweep through the contact of the sliders, with its reduced model or the reason why there is none.
///
/// `None` if the quantity has no effect on the fluid or does not exist for the kind of contact.
pub fn sweep(document: &Document, answers: &Answers, choices: &Choices) -> Option<(Sweep, Result<Served, Refusal>)> {
    let varied = choices.against.varied();
    let key = document.key();
    let key = if key.point.sliding.slide_to_roll_ratio < 0.0 { key.exchanged() } else { key };
    let point = key.point;
    if varied == Varied::Plateau && key.lubricant.shear == ShearLaw::Newtonian || !choices.against.is_of(point.kind) {
        return None;
    }
    // Reduced models are trained for smooth surfaces.
    let rough = key.lubricant.is_rough();
    let (ends, served) = match answers.in_use(document).filter(|_| !rough) {
        // Each full solution of a rough line contact takes some 15 ms from its neighbour.
        None if rough && point.kind == ContactKind::Line => {
            (varied.everywhere(&key), Ok(Served { by: None, untrained: None }))
        }
        None if rough => (varied.everywhere(&key), Err(Refusal::new("reduced models are trained for smooth surfaces"))),
        None => (varied.everywhere(&key), Err(Refusal::new("there is no reduced model of this contact"))),
        Some(by) => match varied.trained(&by.model.domain, &point) {
            Some(ends) => match untrained(&by.model.domain, &key, varied, ends) {
                Ok(untrained) => {
                    let ends = if untrained.is_some() { varied.around(&key, ends) } else { ends };
                    (ends, Ok(Served { by: Some(by), untrained }))
                }
                Err(why) => (ends, Err(why)),
            },
            None => {
                let what = match varied {
                    Varied::RadiusRatio => "circular contacts only",
                    Varied::Plateau => "one plateau ratio only",
                    Varied::SlideToRoll | Varied::Speed => "other speeds",
                };
                (varied.everywhere(&key), Err(Refusal::new(format!("the reduced model was trained for {what}"))))
            }
        },
    };
    // In a thermal contact both bodies must move.
    let ends = match (varied, key.lubricant.heat) {
        (Varied::SlideToRoll, Some(_)) => (ends.0, ends.1.min(LARGEST_HEATED_SRR)),
        _ => ends,
    };
    // The contacts of a sliding sweep do not depend on the scale of the axis.
    let logarithmic = choices.logarithmic.0 && varied != Varied::SlideToRoll;
    let ends = match varied {
        Varied::Plateau if logarithmic => (ends.0.max(LOG_NPR), ends.1),
        _ => ends,
    };
    let base = Key { point: varied.at(&point, ends.0), lubricant: key.lubricant };
    Some((Sweep { varied, base, ends, logarithmic }, served))
}

/// Returns why the contacts of a sweep are outside the trained range. `None` if they are inside.
///
/// # Errors
/// A sentence if the model cannot solve the sweep at all, because it lacks the shapes of pressure and film
/// thickness, or because a contact is refused.
fn untrained(domain: &Domain, key: &Key, varied: Varied, ends: (f64, f64)) -> Result<Option<String>, Refusal> {
    let mut untrained = None;
    for value in [ends.0, ends.1] {
        let problem = Problem::new(&varied.at(&key.point, value), key.lubricant)?;
        if let Some(why) = domain.strange_shape(&problem) {
            return Err(Refusal::new(why.to_string()));
        }
        if let Trust::Outside(why) = domain.trust(&problem) {
            if problem.heat.is_some() {
                // Refuse here, because full solutions are available and a thermal model depends on the oil and the
                // bodies.
                return Err(Refusal::new(why.to_string()));
            }
            untrained.get_or_insert(why.to_string());
        }
    }
    Ok(untrained)
}
