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
    /// First and last value that the model covers, if full solutions continue the curve beyond them.
    pub part: Option<(f64, f64)>,
}

impl Served {
    /// Full solutions, which are fast enough.
    const IN_FULL: Self = Self { by: None, untrained: None, part: None };

    /// Returns the part of a sweep that its method computes at once.
    pub(super) fn part_of(&self, sweep: &Sweep) -> Sweep {
        let Some(ends) = self.part else { return sweep.clone() };
        let base = Key { point: sweep.varied.at(&sweep.base.point, ends.0), ..sweep.base };
        Sweep { base, ends, ..sweep.clone() }
    }
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
    let rough = key.lubricant.is_rough();
    let (ends, served) = match answers.in_use(document).filter(|by| by.model.domain.is_rough() == rough) {
        by if rough => {
            let ends = varied.everywhere(&key);
            let part = by.and_then(|by| Some((covered(&by.model.domain, &key, varied, ends)?, by)));
            of_rough(point.kind, ends, part)
        }
        None => (varied.everywhere(&key), Err(Refusal::new("there is no reduced model of this contact"))),
        Some(by) => match varied.trained(&by.model.domain, &point) {
            Some(ends) => match untrained(&by.model.domain, &key, varied, ends) {
                Ok(untrained) => {
                    let ends = if untrained.is_some() { varied.around(&key, ends) } else { ends };
                    (ends, Ok(Served { by: Some(by), untrained, part: None }))
                }
                Err(why) => (ends, Err(why)),
            },
            None => {
                let what = varied.trained_without();
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

/// Returns the ends of a sweep of rough contacts and its method, from the `part` that a model covers, with the model.
fn of_rough(
    kind: ContactKind,
    ends: (f64, f64),
    part: Option<((f64, f64), InUse)>,
) -> ((f64, f64), Result<Served, Refusal>) {
    match (kind, part) {
        // Each full solution of a rough line contact takes some 15 ms from its neighbour.
        (ContactKind::Line, None) => (ends, Ok(Served::IN_FULL)),
        (ContactKind::Line, Some((part, by))) => {
            let part = Some(part).filter(|part| *part != ends);
            (ends, Ok(Served { by: Some(by), part, ..Served::IN_FULL }))
        }
        // Those of point contacts take too long for the rest of a curve.
        (ContactKind::Point, Some((part, by))) => (part, Ok(Served { by: Some(by), ..Served::IN_FULL })),
        (ContactKind::Point, None) => {
            (ends, Err(Refusal::new("the reduced model of rough circular contacts covers no part of this curve")))
        }
    }
}

/// Number of values of a sweep that are checked, and of halvings that refine the ends.
const CHECKED: u32 = 56;
const HALVINGS: u32 = 40;

/// Returns the part of a sweep of rough contacts that a model covers, from its first covered value to its last one;
/// `None` if it covers fewer than two of the checked ones. The values are checked in equal ratios, or in equal steps
/// from zero.
fn covered(domain: &Domain, key: &Key, varied: Varied, (from, to): (f64, f64)) -> Option<(f64, f64)> {
    let at = |share: f64| if from > 0.0 { from * (to / from).powf(share) } else { from + share * (to - from) };
    let inside = |share: f64| {
        let problem = Problem::new(&varied.at(&key.point, at(share)), key.lubricant);
        problem.is_ok_and(|problem| domain.trust(&problem) == Trust::Trained)
    };
    let share = |k: u32| f64::from(k) / f64::from(CHECKED);
    let first = (0..=CHECKED).find(|k| inside(share(*k)))?;
    let last = (0..=CHECKED).rev().find(|k| inside(share(*k))).filter(|last| *last > first)?;
    let refined = |mut good: f64, mut bad: f64| {
        for _ in 0..HALVINGS {
            let middle = 0.5 * (good + bad);
            *(if inside(middle) { &mut good } else { &mut bad }) = middle;
        }
        at(good)
    };
    let low = if first == 0 { from } else { refined(share(first), share(first - 1)) };
    let high = if last == CHECKED { to } else { refined(share(last), share(last + 1)) };
    Some((low, high))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rough_curves_without_a_model_are_full_for_lines_only() {
        let ends = (0.1, 10.0);
        let (all, served) = of_rough(ContactKind::Line, ends, None);
        assert!(all == ends && served.is_ok_and(|served| served == Served::IN_FULL));
        let (_, refused) = of_rough(ContactKind::Point, ends, None);
        assert!(refused.is_err_and(|why| why.to_string().contains("circular contacts covers no part")));
    }
}
