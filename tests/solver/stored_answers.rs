//! The embedded models compared with 200 stored answers of each, computed when a model was trained last, or before its
//! file got the present format.
//!
//! `tests/data/model_answers.bin` contains the answers: for each model of the catalogue its 200 contacts (nine numbers
//! of four bytes each, [`Contact`]), then the model's results for each of them ([`answer`], numbers of eight bytes).
//! The values along a march of each transient model follow ([`marched`]). All numbers are little-endian.
//! `EHL_WRITE_ANSWERS=1 cargo test --release --test solver stored_answers` writes the file again, with the contacts of a
//! fixed seed.

use crate::common::cases::long;
use ehl_explorer::engine::{catalogue, embedded, in_time};
use ehl_explorer::solver::full::Problem;
use ehl_explorer::solver::full::transient::{Transient, march};
use ehl_explorer::solver::physics::contact::{ContactKind, OperatingPoint};
use ehl_explorer::solver::physics::lubricant::Sliding;
use ehl_explorer::solver::reduced::transient::ReducedMarch;
use ehl_explorer::solver::reduced::{Online, ReducedModel, ReducedOptions, Trust};
use ehl_explorer::solver::training::ResponseTraining;
use fastrand::Rng;
use rayon::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;

const CONTACTS: usize = 200;
/// The ordinary run computes the answers of every fourth contact from this one on, the one with `EHL_LONG` those of all.
const FIRST: usize = 1;
/// Numbers of an answer that are values, then bounds.
const VALUES: usize = 12;
const BOUNDS: usize = 5;
/// Allowed relative differences of both.
const TOLERANCES: [f64; 2] = [1e-12, 1e-9];
/// The same for thermal contacts. When these answers were stored, body 1 was the faster one. Temperatures of the
/// mirrored contact are iterated in another order, and a few end elsewhere within the tolerance of their iterations.
const TOLERANCES_WITH_HEAT: [f64; 2] = [1e-4, 0.1];
/// Nearly all thermal contacts agree to this.
const USUAL_WITH_HEAT: f64 = 1e-8;

/// R, u_m, w, E′, η₀, α, SRR, NPR, R_y; the last two are NaN for a contact without one.
type Contact = [f32; 9];

fn path() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data/model_answers.bin")
}

fn point_of(model: &ReducedModel, contact: &Contact) -> OperatingPoint {
    let [radius, speed, load, modulus, viscosity, alpha, srr, npr, radius_y] = contact.map(f64::from);
    let newtonian_plateau_ratio = Some(npr).filter(|npr| !npr.is_nan());
    let sliding = Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio };
    let quantities = [radius, speed, load, modulus, viscosity, alpha];
    let point = OperatingPoint::from_quantities(model.contact(), quantities, sliding);
    OperatingPoint { radius_y_m: Some(radius_y).filter(|radius| !radius.is_nan()), ..point }
}

/// Returns a contact between two training contacts: ranges are boxes in the logarithms of the quantities.
fn between(model: &ReducedModel, rng: &mut Rng) -> Contact {
    let mut drawn = || {
        let window = &model.windows[rng.usize(..model.windows.len())];
        window.snapshots[rng.usize(..window.snapshots.len())].point
    };
    let (a, b) = (drawn(), drawn());
    let t = rng.f64();
    let mean = |a: f64, b: f64| a.powf(1.0 - t) * b.powf(t);
    let linear = |a: f64, b: f64| (1.0 - t) * a + t * b;
    let [own, other] = [a, b].map(|point| point.quantities());
    let npr = [a, b].map(|point| point.sliding.newtonian_plateau_ratio.unwrap_or(f64::NAN));
    let radius_y = [a, b].map(|point| point.radius_y_m.unwrap_or(f64::NAN));
    let quantities = (0..6).map(|k| mean(own[k], other[k]));
    let srr = linear(a.sliding.slide_to_roll_ratio, b.sliding.slide_to_roll_ratio);
    let rest = [srr, linear(npr[0], npr[1]), mean(radius_y[0], radius_y[1])];
    let all: Vec<f32> = quantities.chain(rest).map(|value| value as f32).collect();
    all.try_into().unwrap()
}

/// H_c, H_min, P_c, P_max, H₀, traction, rise at mid-film, P and H at a node, the root mean squares of both, p̃₁. The
/// bounds of H_c, H_min, the state, traction and rise follow. Results that the model does not compute are NaN. `None`
/// if the contact is outside the trained range, or the model finds no solution with known errors.
fn answer(online: &mut Online, contact: &Contact) -> Option<[f64; VALUES + BOUNDS]> {
    let model = Arc::clone(&online.model);
    let (point, lubricant) = (point_of(&model, contact), model.domain.lubricant);
    let problem = Problem::new(&point, lubricant).ok()?;
    if model.trust(&problem) != Trust::Trained {
        return None;
    }
    online.forget();
    let solved = online.solve(&point, lubricant).ok()?;
    let (error, fields) = (solved.error?, online.reconstruct(&solved).ok()?);
    let (scalars, nodes) = (fields.scalars, fields.pressure.len());
    let node = (contact[2].to_bits() as usize % (nodes / 2)) + nodes / 4;
    let mean_square = |values: &[f64]| (values.iter().map(|value| value * value).sum::<f64>() / nodes as f64).sqrt();
    let rise = solved.heat.as_ref().map_or(f64::NAN, |heat| heat.central.mid_film_k);
    Some([
        scalars.h_c,
        scalars.h_min,
        scalars.p_c,
        scalars.p_max,
        scalars.h_0,
        solved.traction.unwrap_or(f64::NAN),
        rise,
        fields.pressure[node],
        fields.film[node],
        mean_square(&fields.pressure),
        mean_square(&fields.film),
        solved.coefficients[0],
        error.h_c.bound,
        error.h_min.bound,
        error.state.bound,
        error.traction.map_or(f64::NAN, |traction| traction.bound),
        error.rise.map_or(f64::NAN, |rise| rise.bound),
    ])
}

/// H_c, H_min, P_c and P_max at fifty times of a march that begins at the start of the first training: along its inputs,
/// or along the sweep of a circular contact.
fn marched(kind: ContactKind) -> Vec<f64> {
    let model = in_time(kind).unwrap();
    let start = &model.starts[0];
    let (inputs, duration) = match kind {
        ContactKind::Line => (start.inputs.clone(), start.duration),
        ContactKind::Point => ResponseTraining::of_model(&model).sweep(),
    };
    let own = Transient::new(start.point, inputs, duration, model.domain.step);
    let transient = Transient { frame: model.frame, lubricant: model.domain.reference.lubricant, ..own };
    let trajectory = march(&mut ReducedMarch::new(&model, &transient).unwrap(), &transient, &()).unwrap();
    assert!(trajectory.finished());
    let moments = &trajectory.moments;
    let some = (0..50).map(|k| &moments[k * (moments.len() - 1) / 49]);
    some.flat_map(|moment| [moment.h_c, moment.h_min, moment.p_c, moment.p_max]).collect()
}

fn both_marched() -> impl Iterator<Item = f64> {
    [ContactKind::Line, ContactKind::Point].into_iter().flat_map(marched)
}

/// Model with its contacts and their answers.
fn of_model(name: &str, contacts: Option<&[Contact]>) -> Vec<(Contact, [f64; VALUES + BOUNDS])> {
    let model = embedded(name).unwrap();
    let mut online = Online::new(Arc::clone(&model), ReducedOptions::default());
    if let Some(contacts) = contacts {
        let answer = |contact: &Contact| (*contact, answer(&mut online, contact).expect("it was answered"));
        return contacts.iter().map(answer).collect();
    }
    let mut rng = Rng::with_seed(56);
    let mut found = Vec::new();
    while found.len() < CONTACTS {
        let contact = between(&model, &mut rng);
        found.extend(answer(&mut online, &contact).map(|answer| (contact, answer)));
    }
    found
}

fn write() {
    let models: Vec<_> = catalogue().par_iter().map(|entry| of_model(entry.name, None)).collect();
    let mut bytes = Vec::new();
    for answers in models {
        answers.iter().flat_map(|(contact, _)| contact).for_each(|value| bytes.extend(value.to_le_bytes()));
        answers.iter().flat_map(|(_, answer)| answer).for_each(|value| bytes.extend(value.to_le_bytes()));
    }
    both_marched().for_each(|value| bytes.extend(value.to_le_bytes()));
    std::fs::write(path(), bytes).unwrap();
}

/// Returns the largest relative differences of values and of bounds from the stored ones. Fields are included, since
/// they are solutions of the same equations from the same numbers.
fn differences(stored: &[f64], found: &[f64; VALUES + BOUNDS]) -> [f64; 2] {
    let off = |(stored, found): (&f64, &f64)| match (stored.is_nan(), found.is_nan()) {
        (true, true) => 0.0,
        (false, false) if stored == found => 0.0,
        _ => ((found - stored) / stored).abs(),
    };
    let largest = |range: std::ops::Range<usize>| {
        stored[range.clone()]
            .iter()
            .zip(&found[range])
            .map(off)
            .fold(0.0, |a: f64, b| if b.is_nan() { b } else { a.max(b) })
    };
    [largest(0..VALUES), largest(VALUES..VALUES + BOUNDS)]
}

#[test]
fn the_embedded_models_compute_what_was_stored() {
    if std::env::var_os("EHL_WRITE_ANSWERS").is_some() {
        write();
    }
    let bytes = std::fs::read(path()).unwrap();
    let of_contact = size_of::<Contact>();
    let of_model_bytes = CONTACTS * (of_contact + 8 * (VALUES + BOUNDS));
    let doubles = |bytes: &[u8]| -> Vec<f64> {
        bytes.chunks_exact(8).map(|value| f64::from_le_bytes(value.try_into().unwrap())).collect()
    };
    let (models, transient) = bytes.split_at(catalogue().len() * of_model_bytes);
    catalogue().par_iter().zip(models.par_chunks_exact(of_model_bytes)).for_each(|(entry, bytes)| {
        let (contacts, answers) = bytes.split_at(CONTACTS * of_contact);
        let single = |bytes: &[u8]| f32::from_le_bytes(bytes.try_into().unwrap());
        let contacts: Vec<f32> = contacts.chunks_exact(4).map(single).collect();
        let (first, every) = if long() { (0, 1) } else { (FIRST, 4) };
        let contacts = contacts.chunks_exact(9).skip(first).step_by(every).map(|contact| contact.try_into().unwrap());
        let contacts: Vec<Contact> = contacts.collect();
        let answers = doubles(answers);
        let found = of_model(entry.name, Some(&contacts));
        let heats = entry.domain.heats();
        let tolerances = if heats { TOLERANCES_WITH_HEAT } else { TOLERANCES };
        let mut unusual = 0;
        let stored = answers.chunks_exact(VALUES + BOUNDS).skip(first).step_by(every);
        for ((contact, found), stored) in found.iter().zip(stored) {
            let [values, bounds] = differences(stored, found);
            let (name, within) = (entry.name, values <= tolerances[0] && bounds <= tolerances[1]);
            assert!(within, "{name}: {contact:?} is off by {values:e}, its bounds by {bounds:e}");
            unusual += usize::from(heats && values > USUAL_WITH_HEAT);
        }
        assert!(
            unusual <= contacts.len() / 50,
            "{}: {unusual} contacts differ by more than {USUAL_WITH_HEAT:e}",
            entry.name
        );
    });
    let stored = doubles(transient);
    let found: Vec<f64> = both_marched().collect();
    assert_eq!(stored.len(), found.len());
    for (stored, found) in stored.iter().zip(&found) {
        assert!((found / stored - 1.0).abs() <= TOLERANCES[0], "{found} instead of {stored}");
    }
}
