//! Tests of units and of contacts in co-simulations.

use super::archive::platform_tuple;
use super::description::Description;
use super::{FIRST_TRUTH, FmiVersion, REALS, Role, TIME, TRUTHS, identity, library_place, pressed_of};
use super::{version_2, version_3};
use crate::engine::coupled::{Coupled, Inputs, Pressed};
use crate::engine::{SavedModel, Workbench, bytes_of, embedded};
use crate::scene::{Bench, names};
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use std::collections::HashSet;

fn first(which: &str) -> (Coupled, Inputs) {
    let model = embedded(which).unwrap();
    let inputs = Coupled::first_inputs(&model).unwrap();
    (Coupled::new(model, Pressed::Load).unwrap(), inputs)
}

#[test]
fn outputs_are_what_solve_answers_to_the_last_bit() {
    for which in ["line", "line_shear", "point"] {
        let (mut coupled, inputs) = first(which);
        let inputs = Inputs { slide_to_roll_ratio: 0.1, ..inputs };
        let own = coupled.solve(&inputs).unwrap();
        let request = coupled.request(&inputs, inputs.load).unwrap();
        let result = Workbench::new("").answer(&request, None, &()).unwrap().result;
        let named = [
            ("h_c_m", own.h_c_m),
            ("h_min_m", own.h_min_m),
            ("traction", own.friction_coefficient),
            ("hertz.p_h_pa", own.hertz_pressure_pa),
            ("reduced.h_c_error_bound", own.error_bounds[0]),
        ];
        for (name, value) in named {
            assert_eq!(result.value(name), Some(value), "{name}");
        }
        assert_eq!((own.trained, own.full, &own.warnings), (!result.untrained(), false, &result.warnings));
    }
}

#[test]
fn an_approach_gives_the_load_that_gives_it() {
    let model = embedded("point").unwrap();
    let inputs = Coupled::first_inputs(&model).unwrap();
    let mut by_approach = Coupled::new(model, Pressed::Approach).unwrap();
    for share in [0.9, 1.0, 1.3] {
        let wanted = Inputs { approach_m: share * inputs.approach_m, load: 0.7 * inputs.load, ..inputs };
        let found = by_approach.solve(&wanted).unwrap();
        assert!((found.approach_m / wanted.approach_m - 1.0).abs() < 1e-11, "{share}: {found:?}");
        assert!((found.load > inputs.load) == (share > 1.0 + 1e-9) || share == 1.0);
    }
    // Separated bodies carry a small load, and less the farther they are apart.
    let apart = [-1e-6, -4e-6].map(|approach_m| by_approach.solve(&Inputs { approach_m, ..inputs }).unwrap().load);
    assert!(apart[0] < inputs.load && 0.0 < apart[1] && apart[1] < apart[0], "{apart:?}");
}

#[test]
fn stiffness_agrees_between_two_units_and_one() {
    for which in ["line", "point"] {
        let (mut one, inputs) = first(which);
        let (mut other, _) = first(which);
        let heavier = Inputs { load: 1.01 * inputs.load, ..inputs };
        let [light, heavy] = [inputs, heavier].map(|inputs| one.solve(&inputs).unwrap());
        assert_eq!(other.solve(&heavier).unwrap().approach_m, heavy.approach_m);
        let stiffness = |from: f64, to: f64| (heavy.load - light.load) / (to - from);
        let own = stiffness(light.approach_m, heavy.approach_m);
        // Stiffness of the dry contact. The film adds a few per cent of compliance.
        let point = one.request(&inputs, inputs.load).unwrap().point;
        let dry = |load: f64| {
            let point = OperatingPoint { load, ..point };
            let hertz = point.hertz();
            let depth = hertz.half_width_m.powi(2) / point.radius_m;
            match point.kind {
                ContactKind::Line => 0.5 * depth * (0.5 + (2.0 * point.radius_m / hertz.half_width_m).ln()),
                ContactKind::Point => depth,
            }
        };
        let wanted = stiffness(dry(light.load), dry(heavy.load));
        assert!((own / wanted - 1.0).abs() < 0.1, "{which}: {own:e}, {wanted:e} when dry");
        assert_eq!(light.approach_reference_m.is_nan(), which == "point");
    }
}

#[test]
fn outside_the_training_the_reason_is_that_of_every_interface() {
    let (mut coupled, inputs) = first("line");
    let beyond = coupled.solve(&Inputs { load: 30.0 * inputs.load, ..inputs }).unwrap();
    let request = coupled.request(&inputs, 30.0 * inputs.load).unwrap();
    let result = Workbench::new("").answer(&request, None, &()).unwrap().result;
    let refused = beyond.of_training().unwrap_err().to_string();
    assert!(result.warning().starts_with(&refused), "{refused} against {}", result.warning());
    assert!(coupled.solve(&inputs).unwrap().of_training().is_ok());
}

#[test]
fn what_makes_no_sense_is_refused_and_what_is_unknown_is_told() {
    let (mut coupled, inputs) = first("line");
    for wrong in [
        Inputs { load: -1.0, ..inputs },
        Inputs { radius_m: 0.0, ..inputs },
        Inputs { slide_to_roll_ratio: 11.0, ..inputs },
        Inputs { speed_m_per_s: 1e30, ..inputs },
    ] {
        assert!(coupled.solve(&wrong).is_err(), "{wrong:?}");
    }
    let beyond = coupled.solve(&Inputs { load: 30.0 * inputs.load, ..inputs }).unwrap();
    assert!(!beyond.trained && !beyond.warnings.is_empty(), "{beyond:?}");
    let mut inputs = inputs;
    assert!(REALS[0].set(Role::Input, &mut inputs, f64::NAN).is_err_and(|why| why.to_string().contains("radius")));
    let follows = REALS.iter().find(|real| real.name == names::H_C_M).unwrap();
    assert!(follows.set(Role::Output, &mut inputs, 1.0).is_err());
}

/// Returns the model description of an embedded model.
fn described(which: &str, pressed: Pressed, version: FmiVersion) -> String {
    let bytes = &*bytes_of(which).unwrap();
    let unit = Description::of(&SavedModel::from_bytes(bytes).unwrap(), bytes, pressed).unwrap();
    match version {
        FmiVersion::Two => version_2::written(&unit),
        FmiVersion::Three => version_3::written(&unit),
    }
}

#[test]
fn descriptions_contain_every_variable_and_identity() {
    let bytes = &*bytes_of("point").unwrap();
    for pressed in [Pressed::Load, Pressed::Approach] {
        let [text, newer] = [FmiVersion::Two, FmiVersion::Three].map(|version| described("point", pressed, version));
        // All variables except the reference distance of line contacts and the three variables of rough surfaces.
        assert_eq!(text.matches("<ScalarVariable ").count(), REALS.len() - 4 + TRUTHS.len());
        assert_eq!(newer.matches("<Float64 ").count(), REALS.len() - 4 + 1);
        assert_eq!(newer.matches("<Boolean ").count(), TRUTHS.len());
        let own = identity(bytes, pressed);
        assert!(text.contains(&format!("guid=\"{own}\"")) && newer.contains(&format!("instantiationToken=\"{own}\"")));
        assert_eq!(pressed_of(&own, bytes), Some(pressed));
    }
    assert_eq!(pressed_of("load-0000000000000000", bytes), None);
    let text = described("line_rough", Pressed::Approach, FmiVersion::Two);
    assert_eq!(text.matches("<ScalarVariable ").count(), REALS.len() + TRUTHS.len());
}

/// Returns the values of an attribute in order.
fn values<'a>(text: &'a str, attribute: &'a str) -> Vec<&'a str> {
    let parts = text.split(&format!(" {attribute}=\"")).skip(1).collect::<Vec<_>>();
    parts.into_iter().filter_map(|rest| rest.split('"').next()).collect()
}

#[test]
fn value_references_of_fmi_3_are_unique_over_types() {
    let text = described("line_rough", Pressed::Load, FmiVersion::Three);
    let (variables, structure) = text.split_once("<ModelStructure>").unwrap();
    let references = values(variables, "valueReference");
    let unique: HashSet<&str> = references.iter().copied().collect();
    assert_eq!((references.len(), unique.len()), (REALS.len() + TRUTHS.len() + 1, references.len()));
    assert!(unique.contains(&*TIME.to_string()) && unique.contains(&*FIRST_TRUTH.to_string()));
    // Each output is listed as an output, and as an unknown of the initialisation.
    let outputs = variables.matches("causality=\"output\"").count();
    assert_eq!(structure.matches("<Output ").count(), outputs);
    assert_eq!(structure.matches("<InitialUnknown ").count(), outputs);
    assert!(values(structure, "valueReference").iter().all(|reference| unique.contains(reference)));
}

#[test]
fn only_steady_units_provide_derivatives() {
    for (which, provided) in [("point", "true"), ("line_in_time", "false")] {
        let two = described(which, Pressed::Load, FmiVersion::Two);
        assert_eq!(values(&two, "providesDirectionalDerivative"), [provided], "{which}");
        let three = described(which, Pressed::Load, FmiVersion::Three);
        assert_eq!(values(&three, "providesDirectionalDerivatives"), [provided], "{which}");
        assert_eq!(values(&three, "providesAdjointDerivatives"), [provided], "{which}");
        for flag in ["canGetAndSetFMUState", "canSerializeFMUState", "canHandleVariableCommunicationStepSize"] {
            assert_eq!(values(&three, flag), ["true"], "{which}");
        }
    }
}

#[test]
fn libraries_lie_in_the_folder_of_their_version() {
    assert_eq!(platform_tuple("x86_64", "linux"), "x86_64-linux");
    assert_eq!(platform_tuple("aarch64", "macos"), "aarch64-darwin");
    assert_eq!(platform_tuple("arm", "linux"), "aarch32-linux");
    let [two, three] = [FmiVersion::Two, FmiVersion::Three].map(library_place);
    assert!(two != three && two.starts_with("binaries/") && three.starts_with("binaries/"));
    assert!(["2", "3"].iter().all(|text| text.parse::<FmiVersion>().is_ok()));
    assert!(["1", "4", "two", ""].iter().all(|text| text.parse::<FmiVersion>().is_err()));
}

#[test]
fn an_ellipse_keeps_its_ratio_of_radii() {
    let (coupled, inputs) = first("ellipse");
    let request = coupled.request(&Inputs { radius_ratio: 2.0, ..inputs }, inputs.load).unwrap();
    let point: OperatingPoint = request.point;
    assert!((Quantity::RadiusRatio.of(&point).unwrap() - 2.0).abs() < 1e-12);
}
