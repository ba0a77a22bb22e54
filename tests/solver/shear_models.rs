//! The embedded models of shear-thinning contacts: shared helpers of both tests.

use crate::common::scene_files;

use ehl_explorer::engine::model_file::from_bytes;
use ehl_explorer::engine::{bytes_of, embedded};
use ehl_explorer::scene::Study;
use ehl_explorer::scene::named_lubricant::SQUALANE_PIP;
use ehl_explorer::solver::full::{Problem, Solution};
use ehl_explorer::solver::parameters::{ParameterSpace, Quantity};
use ehl_explorer::solver::physics::contact::{ContactKind, OperatingPoint, Sliding};
use ehl_explorer::solver::reduced::{Calibration, Online, ReducedError, ReducedOptions, Trust};
use ehl_explorer::solver::training::{TrainingSpec, random_points};

/// Returns the trained range of the model for a contact kind, from its scene.
pub fn range(kind: ContactKind) -> ParameterSpace {
    let name = if kind == ContactKind::Line { "embedded_shear_model" } else { "embedded_point_shear_model" };
    match scene_files::read(name).study {
        Study::Training(TrainingSpec { range, .. }) if range.varies(Quantity::NewtonianPlateauRatio) => range,
        other => panic!("{name} trains no range with sliding: {other:?}"),
    }
}

/// Returns random contacts of a range.
pub fn points(kind: ContactKind, range: &ParameterSpace, count: usize, seed: u64) -> Vec<OperatingPoint> {
    random_points(range, kind, count, seed)
}

/// Returns a range with other intervals of some of its axes.
pub fn narrowed<const N: usize>(mut range: ParameterSpace, ends: [(Quantity, (f64, f64)); N]) -> ParameterSpace {
    ends.iter().for_each(|(quantity, ends)| range.axis_mut(*quantity).unwrap().ends = *ends);
    range
}

fn thinning(kind: ContactKind) -> &'static str {
    match kind {
        ContactKind::Line => "line_shear",
        ContactKind::Point => "point_shear",
    }
}

/// Returns the embedded model.
pub fn online(kind: ContactKind) -> Online {
    Online::new(embedded(thinning(kind)).unwrap(), ReducedOptions::default())
}

/// Returns relative errors of H_c, H_min and traction coefficient; that of the traction is zero without sliding.
pub fn errors(reduced: &Solution, traction: f64, truth: &Solution) -> [f64; 3] {
    let off = |reduced: f64, full: f64| (reduced / full - 1.0).abs();
    let slides = truth.problem.point.sliding.slide_to_roll_ratio > 0.0;
    let traction = if slides { off(traction, truth.traction_coefficient()) } else { 0.0 };
    [off(reduced.scalars.h_c, truth.scalars.h_c), off(reduced.scalars.h_min, truth.scalars.h_min), traction]
}

/// Asserts that the opposite sliding gives the same film thickness and the opposite traction, and that sliding has no
/// effect with a plateau ratio of 1.
pub fn assert_mirrored(mut online: Online, point: OperatingPoint, tolerance: f64) {
    let mut film = |srr: f64, npr: f64| {
        online.forget();
        let solved = online.solve(&OperatingPoint { sliding: sliding(srr, npr), ..point }, SQUALANE_PIP).unwrap();
        let fields = online.reconstruct(&solved).unwrap();
        (fields.scalars.h_c, fields.traction_coefficient())
    };
    let (one, other) = (film(0.4, 0.3), film(-0.4, 0.3));
    assert!(
        (one.0 / other.0 - 1.0).abs() < tolerance && (one.1 / other.1 + 1.0).abs() < tolerance,
        "{one:?} {other:?}"
    );
    assert!((film(0.0, 1.0).0 / film(0.9, 1.0).0 - 1.0).abs() < tolerance);
}

/// Asserts that each contact is outside the range by the named quantity, as SRR, NPR and the modulus are compared with
/// `base`, and that the model of Newtonian contacts refuses the lubricant.
pub fn assert_limits_are_said(online: &Online, base: OperatingPoint, further: &[(OperatingPoint, &str)]) {
    let trust = |point: &OperatingPoint| online.model.trust(&Problem::new(point, SQUALANE_PIP).unwrap());
    let common = [
        (OperatingPoint { sliding: sliding(1.5, 0.5), ..base }, "SRR"),
        (OperatingPoint { sliding: sliding(0.5, 0.1), ..base }, "NPR"),
        (OperatingPoint { modulus_pa: 2.0 * base.modulus_pa, ..base }, "E'"),
    ];
    for (point, word) in common.iter().chain(further) {
        assert!(matches!(trust(point), Trust::Outside(why) if why.to_string().contains(word)), "{word}");
    }
    let mut newtonian = Online::new(embedded(base.kind.name()).unwrap(), ReducedOptions::default());
    let refused = newtonian.solve(&OperatingPoint { sliding: sliding(0.5, 0.3), ..base }, SQUALANE_PIP);
    assert_eq!(refused.unwrap_err(), ReducedError::ShearThinning);
}

/// Asserts that the file of the model stores what Newtonian models do not have. A test of the library checks that files
/// are written as they were read.
pub fn assert_file_keeps_everything(kind: ContactKind) {
    let model = embedded(thinning(kind)).unwrap();
    assert!(model.domain.space.varies(Quantity::NewtonianPlateauRatio));
    let window = &model.windows[0];
    assert!(window.traction.is_some() && window.calibration.as_ref().map(Calibration::evidence).is_some());
    let bytes = bytes_of(thinning(kind)).unwrap();
    assert!(from_bytes(&bytes[..bytes.len() - 8]).is_err());
}

fn sliding(slide_to_roll_ratio: f64, npr: f64) -> Sliding {
    Sliding { slide_to_roll_ratio, newtonian_plateau_ratio: Some(npr) }
}
