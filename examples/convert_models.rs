//! Converts former model files: `cargo run --release --example convert_models -- OUT_FOLDER FILE.rom...`. Each model is read
//! again and compared with the former one, number by number, and both are timed.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "used once")]

use ehl_explorer::engine::SavedModel;
use ehl_explorer::engine::former::{read, read_present};
use ehl_explorer::solver::reduced::{CalibrationParts, PodBasis, Window};
use std::path::Path;
use std::time::Instant;

fn same_basis(a: &PodBasis, b: &PodBasis) -> bool {
    a.modes == b.modes && a.singular_values == b.singular_values
}

/// What differs between two windows.
fn differences(a: &Window, b: &Window) -> Vec<&'static str> {
    let parts = |window: &Window| {
        let parts = window.calibration.as_ref().map(|calibration| calibration.parts());
        parts.map(|CalibrationParts { ranges, places, laws, surplus }| {
            let bits = |values: Vec<f32>| values.into_iter().map(f32::to_bits).collect::<Vec<_>>();
            (ranges, bits(places), laws, surplus.into_iter().map(bits).collect::<Vec<_>>())
        })
    };
    let factors = |window: &Window| window.pressure.combined().map(|own| own.factors.clone());
    let shared = |window: &Window| window.pressure.combined().map(|own| own.shared.basis.modes.clone());
    let checks = [
        ("ranges", a.m == b.m && a.anchor == b.anchor && a.thins == b.thins),
        ("grid", a.grid.spec() == b.grid.spec()),
        ("settings", a.penalty == b.penalty && a.cavitation == b.cavitation && a.sampling == b.sampling),
        ("pressure", same_basis(a.pressure.basis(), b.pressure.basis())),
        ("factors", factors(a) == factors(b) && shared(a) == shared(b)),
        ("deformation", same_basis(&a.deformation, &b.deformation)),
        ("rows", a.sampled_rows == b.sampled_rows && a.scheme == b.scheme),
        ("reconstruction", a.reconstruction == b.reconstruction),
        ("residual", a.residual_reconstruction == b.residual_reconstruction),
        ("snapshots", a.snapshots == b.snapshots),
        ("traction", a.traction == b.traction),
        ("calibration", parts(a) == parts(b)),
        ("calibration itself", format!("{:?}", a.calibration) == format!("{:?}", b.calibration)),
        ("shapes", a.shapes.as_ref().map(|s| s.radius_ratio) == b.shapes.as_ref().map(|s| s.radius_ratio)),
    ];
    checks.into_iter().filter(|(_, same)| !same).map(|(name, _)| name).collect()
}

fn median(mut run: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..5)
        .map(|_| {
            let clock = Instant::now();
            run();
            1e3 * clock.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[2]
}

fn main() {
    let mut arguments = std::env::args().skip(1);
    let folder = arguments.next().unwrap();
    let (mut before, mut after) = (0, 0);
    for path in arguments {
        let bytes = std::fs::read(&path).unwrap();
        let model = read(&bytes).unwrap();
        let converted = model.to_bytes().unwrap();
        let again = SavedModel::from_bytes(&converted).unwrap();
        assert!(again.to_bytes().unwrap() == converted, "{path} changes when it is written again");
        let mut off = Vec::new();
        match (&model, &again) {
            (SavedModel::Stationary(a), SavedModel::Stationary(b)) => {
                assert_eq!((&a.title, &a.domain, &a.scene, &a.log), (&b.title, &b.domain, &b.scene, &b.log));
                assert_eq!(a.windows.len(), b.windows.len());
                a.windows.iter().zip(&b.windows).for_each(|(a, b)| off.extend(differences(a, b)));
            }
            (SavedModel::InTime(a), SavedModel::InTime(b)) => {
                assert_eq!((&a.title, &a.domain, &a.scene, &a.log), (&b.title, &b.domain, &b.scene, &b.log));
                assert!(a.starts == b.starts && a.frame == b.frame && a.locals.len() == b.locals.len());
                off.extend(differences(&a.window, &b.window));
                for (a, b) in a.locals.iter().zip(&b.locals) {
                    assert_eq!(a.centre, b.centre);
                    off.extend(differences(&a.window, &b.window));
                }
            }
            _ => panic!("{path} is of another kind"),
        }
        assert!(off.is_empty(), "{path}: {off:?}");
        let name = Path::new(&path).file_name().unwrap();
        std::fs::write(Path::new(&folder).join(name), &converted).unwrap();
        let former = median(|| drop(read(&bytes).unwrap()));
        let present = median(|| drop(read_present(&converted).unwrap()));
        let (from, to) = (bytes.len(), converted.len());
        println!("{:24} {from:>8} -> {to:>8} bytes, read in {former:7.1} -> {present:7.1} ms", name.to_string_lossy());
        before += from;
        after += to;
    }
    println!("{before} -> {after} bytes");
}
