//! Contacts along the path of a machine: a table of load cases, and the inputs of a transient run.

use super::kind::MachineKind;
use crate::app::document::Document;
use crate::app::refusal::Refusal;
use crate::scene::TransientStudy;
use crate::solver::full::transient::{Inputs, Signal, TimeStep};
use crate::solver::physics::engineering::UnitSystem;
use crate::solver::physics::machines::{Machine, MachineContact};

/// Number of lines of a table of load cases.
const LINES: usize = 41;
/// Number of samples of each input of a transient run.
const SAMPLES: usize = 241;
/// Time step, if the run has not too many of them.
const STEP: f64 = 0.05;
const MOST_STEPS: f64 = 2000.0;

/// Returns a table of load cases with a line for each position. Contacts that entrain no lubricant are left out.
///
/// # Errors
/// A sentence if the machine does not exist.
pub(super) fn load_cases(machine: &Machine, document: &Document) -> Result<String, Refusal> {
    let base = document.bodies();
    let modulus_pa = base.reduced_modulus_pa()?;
    let (_, position) = MachineKind::of(machine).position();
    let unit = position.unit(UnitSystem::Engineering);
    let kind = machine.kind().name();
    let load = if machine.kind().is_line() { "w [N/mm]" } else { "w [N]" };
    let mut text =
        format!("name;#position [{}];contact;R [mm];R_y [mm];u1 [m/s];u2 [m/s];{load};E' [GPa]\n", unit.name);
    for (k, contact) in machine.path(modulus_pa, LINES)?.iter().enumerate() {
        let Ok(point) = contact.operating_point(base, document.point) else { continue };
        let [first, second] = point.surface_speeds();
        let across = point.radius_y_m.map_or(String::new(), |radius| format!("{:.9}", 1e3 * radius));
        let load = if point.kind.is_line() { 1e-3 * point.load } else { point.load };
        let (name, place, modulus) = (machine.name(), unit.number(contact.position), 1e-9 * point.modulus_pa);
        let radius = 1e3 * point.radius_m;
        text += &format!(
            "{name} {};{place:.4};{kind};{radius:.9};{across};{first:.9};{second:.9};{load:.9};{modulus:.9}\n",
            k + 1
        );
    }
    Ok(text)
}

/// Returns a transient study in which R, u_m and w follow the path, relative to the contact of the machine's position.
/// It is computed by the full solver; trained models do not cover such ranges.
///
/// # Errors
/// A sentence if the machine has no contact there.
pub(super) fn transient(machine: &Machine, document: &Document) -> Result<TransientStudy, Refusal> {
    let base = document.bodies();
    let modulus_pa = base.reduced_modulus_pa()?;
    let reference = machine.contact(modulus_pa)?;
    let point = reference.operating_point(base, document.point)?;
    let path = machine.path(modulus_pa, SAMPLES)?;
    let unit = point.hertz().half_width_m / point.speed_m_per_s;
    let times: Vec<f64> = path.iter().map(|contact| contact.time_s / unit).collect();
    let signal = |of: &dyn Fn(&MachineContact) -> f64| Signal::Sampled {
        times: times.clone(),
        values: path.iter().map(of).collect(),
    };
    let duration = times.last().copied().unwrap_or(1.0);
    let inputs = Inputs {
        radius: signal(&|contact| contact.radius_m() / point.radius_m),
        speed: signal(&|contact| contact.mean_speed() / reference.mean_speed()),
        load: signal(&|contact| contact.load / point.load),
    };
    let step = STEP.max(duration / MOST_STEPS);
    let TransientStudy { frames, separation, surfaces, scheme, .. } = document.transient_study();
    let study = TransientStudy::new(inputs, duration, TimeStep::Fixed(step));
    Ok(TransientStudy { frames, separation, surfaces, scheme, ..study })
}
