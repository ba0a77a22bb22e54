//! Which reduced model draws the curve of a sweep, and whether it was trained for it.

use super::sweeps::Choices;
use crate::app::answers::Answers;
use crate::app::document::{Document, Key};
use crate::app::in_use::InUse;
use crate::app::refusal::Refusal;
use crate::app::tabs::traction::{Sweep, Varied};
use crate::solver::full::Problem;
use crate::solver::physics::lubricant::{LARGEST_HEATED_SRR, ShearLaw};
use crate::solver::reduced::{Domain, Trust};

/// What a logarithmic axis of NPR begins with at least.
const LOG_NPR: f64 = 1e-2;

/// The reduced model that draws a curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Served {
    /// The model and its truncation.
    pub by: InUse,
    /// Why it was not trained for the curve: of another fluid, say. It solves the contacts' own equations, but nothing
    /// is known of its errors.
    pub untrained: Option<String>,
}

/// The sweep through the contact of the sliders, and the reduced model that draws it or why none does. `None` where the
/// fluid does not answer to the quantity, or a line does not have it.
pub fn sweep(document: &Document, answers: &Answers, choices: &Choices) -> Option<(Sweep, Result<Served, Refusal>)> {
    let varied = choices.against.varied();
    let key = document.key();
    let key = if key.point.sliding.slide_to_roll_ratio < 0.0 { key.exchanged() } else { key };
    let point = key.point;
    if varied == Varied::Plateau && key.lubricant.shear == ShearLaw::Newtonian || !choices.against.is_of(point.kind) {
        return None;
    }
    let (ends, served) = match answers.in_use(document) {
        None => (varied.everywhere(&point), Err(Refusal::new("there is no reduced model of this contact"))),
        Some(by) => match varied.trained(&by.model.domain, &point) {
            Some(ends) => match untrained(&by.model.domain, &key, varied, ends) {
                Ok(untrained) => {
                    let ends = if untrained.is_some() { varied.around(&key, ends) } else { ends };
                    (ends, Ok(Served { by, untrained }))
                }
                Err(why) => (ends, Err(why)),
            },
            None => {
                let what = match varied {
                    Varied::RadiusRatio => "circles only",
                    Varied::Plateau => "one plateau ratio only",
                    Varied::SlideToRoll | Varied::Speed => "no such speed",
                };
                (varied.everywhere(&point), Err(Refusal::new(format!("the reduced model was trained for {what}"))))
            }
        },
    };
    // With heat both bodies must move on.
    let ends = match (varied, key.lubricant.heat) {
        (Varied::SlideToRoll, Some(_)) => (ends.0, ends.1.min(LARGEST_HEATED_SRR)),
        _ => ends,
    };
    // However sliding is shown, the contacts are the same.
    let logarithmic = choices.logarithmic.0 && varied != Varied::SlideToRoll;
    let ends = match varied {
        Varied::Plateau if logarithmic => (ends.0.max(LOG_NPR), ends.1),
        _ => ends,
    };
    let base = Key { point: varied.at(&point, ends.0), lubricant: key.lubricant };
    Some((Sweep { varied, base, ends, logarithmic }, served))
}

/// Why a model was not trained for a sweep, where it was not.
///
/// # Errors
/// A sentence where it cannot serve it at all: pressure and film have shapes there that it does not know, or a contact
/// is refused.
fn untrained(domain: &Domain, key: &Key, varied: Varied, ends: (f64, f64)) -> Result<Option<String>, Refusal> {
    let mut untrained = None;
    for value in [ends.0, ends.1] {
        let problem = Problem::new(&varied.at(&key.point, value), key.lubricant)?;
        if let Some(why) = domain.strange_shape(&problem) {
            return Err(Refusal::new(why.to_string()));
        }
        if let Trust::Outside(why) = domain.trust(&problem) {
            if problem.heat.is_some() {
                // Full solutions are at hand, and with heat the oil and its bodies count as well.
                return Err(Refusal::new(why.to_string()));
            }
            untrained.get_or_insert(why.to_string());
        }
    }
    Ok(untrained)
}
