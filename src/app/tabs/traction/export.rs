//! Export of traction and film thickness along a quantity.

use super::sweeps::Sweeps;
use crate::app::document::Key;
use crate::app::export as tables;
use crate::app::in_use::InUse;
use crate::app::tabs::traction::{Companion, Sample, Served, Sweep};
use crate::scene::names;
use crate::solver::full::Mixed;

/// Returns the description of a sweep as lines above a table.
pub fn describe(sweep: &Sweep) -> Vec<String> {
    std::iter::once(described(sweep)).chain(notes(sweep)).collect()
}

/// Returns the notes that follow the description of the first contact.
fn notes(sweep: &Sweep) -> impl Iterator<Item = String> {
    let of = match sweep.base.lubricant.heat {
        Some(_) => "a thermal contact over the area under pressure",
        None => "an isothermal contact over the whole domain, (3.41)",
    };
    std::iter::once(format!("traction is that of {of}; the first contact is described above")).chain(sweep.unphysical())
}

/// Returns the first contact of the drawn curve, otherwise of the full solutions, and the notes below it.
pub fn parameters(view: &Sweeps) -> Option<(&Key, Vec<String>)> {
    match (&view.curve, &view.markers) {
        (Some(curve), _) => Some((&curve.sweep.base, notes(&curve.sweep).chain(untrained(&curve.served)).collect())),
        (None, markers) => markers.as_ref().map(|markers| (&markers.sweep.base, notes(&markers.sweep).collect())),
    }
}

/// Returns a note if the contacts of a curve are outside the trained range.
fn untrained(served: &Served) -> Option<String> {
    let why = served.untrained.as_ref()?;
    Some(format!("this curve is outside the trained range of the reduced model ({why}): there is no error bound"))
}

fn described(sweep: &Sweep) -> String {
    tables::describe_contact(&sweep.base.point, &sweep.base.lubricant)
}

/// Returns the curve and the full solutions as CSV; the column `full` distinguishes them. `None` if there is
/// neither.
pub fn csv(view: &Sweeps) -> Option<String> {
    let companion =
        view.curve.iter().map(|curve| &curve.sweep).chain(view.markers.iter().map(|markers| &markers.sweep));
    let companion = companion.filter_map(Sweep::companion).next().unwrap_or(Companion::Newtonian);
    let columns = [
        "full",
        names::SRR,
        names::NPR,
        names::SPEED,
        names::M,
        names::L,
        names::TRACTION,
        names::H_C_M,
        names::H_MIN_M,
        companion.column(),
        "unphysical",
        names::MIXED_FILM_RATIO_C,
        names::MIXED_LOAD_SHARE,
        names::MIXED_BOUNDARY_TRACTION,
        names::MIXED_FLUID_TRACTION,
    ];
    let curve = view.curve.iter().map(|curve| (0.0, &curve.sweep, curve.samples.as_slice()));
    let markers = view.markers.iter().map(|markers| (1.0, &markers.sweep, markers.samples.as_slice()));
    let blocks: Vec<(f64, &Sweep, &[Sample])> = curve.chain(markers).collect();
    let (_, first, _) = blocks.iter().find(|block| !block.2.is_empty())?;
    let mut comments = describe(first);
    for served in view.curve.iter().map(|curve| &curve.served) {
        let by = served.by.as_ref().map_or_else(|| "full solutions".to_owned(), InUse::describe);
        comments.push(format!("full 0: {by}"));
        comments.extend(untrained(served));
    }
    if let Some(markers) = view.markers.as_ref().filter(|markers| markers.sweep != **first) {
        comments.push(format!("full 1 belongs to {}", described(&markers.sweep)));
    }
    let rows = blocks
        .into_iter()
        .flat_map(|(full, sweep, samples)| samples.iter().map(move |sample| row(full, sweep, sample)));
    Some(tables::csv(&comments, &columns, rows))
}

fn row(full: f64, sweep: &Sweep, sample: &Sample) -> Vec<Option<f64>> {
    let (point, moes) = (&sample.point, sample.point.moes());
    let key = Key { point: *point, lubricant: sweep.base.lubricant };
    let npr = super::Varied::Plateau.of(&key);
    let srr = point.sliding.slide_to_roll_ratio;
    let unphysical = f64::from(u8::from(sample.unphysical.is_some()));
    let values = [full, srr, npr, point.speed_m_per_s, moes.m, moes.l, sample.traction, sample.h_c_m, sample.h_min_m];
    let mixed = |of: fn(&Mixed) -> f64| sample.mixed.as_ref().map(of);
    let rough = [
        mixed(|mixed| mixed.film_ratio_c),
        mixed(|mixed| mixed.asperity_load_share),
        mixed(|mixed| mixed.boundary_traction.abs()),
        mixed(|mixed| mixed.fluid_traction.abs()),
    ];
    values.map(Some).into_iter().chain([sample.companion, Some(unphysical)]).chain(rough).collect()
}
