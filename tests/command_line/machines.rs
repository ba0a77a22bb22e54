//! Contacts stated by a machine: a bearing, a gear pair, a cam.

use crate::commands::{json, program};
use crate::common::scratch::Scratch;

const FZG: &str = "Gear(teeth: (16, 24), module_m: 0.0045, shifts: (0.1817, 0.1715), face_width_m: 0.014, \
                   pinion_rpm: 1500, torque_n_m: 200)";
const STEEL: [&str; 4] = ["--e1=206e9", "--nu1=0.3", "--e2=206e9", "--nu2=0.3"];
const OIL: [&str; 3] = ["--viscosity=0.02", "--alpha=2e-8", "--dx=0.02"];

#[test]
fn a_gear_pair_is_solved_as_its_contact_is() {
    let machine = format!("--machine={FZG}");
    let of = |words: &[&str]| json(&program(&[&["solve", "--json"], words, &STEEL, &OIL].concat()));
    let gear = of(&[&machine]);
    // Published for the FZG type C gear at the pitch point: p_H 1347.3 MPa, half width 199.57 µm.
    let number = |name: &str| gear["hertz"][name].as_f64().unwrap();
    assert!((number("p_h_pa") / 1347.3e6 - 1.0).abs() < 2e-4 && (number("a_m") / 199.57e-6 - 1.0).abs() < 2e-4);
    // A table states the same, and overrides nothing else.
    let folder = Scratch::new("machines");
    let path = folder.join("gears.csv");
    let text = format!("name;machine;e1;nu1;e2;nu2;viscosity;alpha;dx\nfzg;{FZG};206e9;0.3;206e9;0.3;0.02;2e-8;0.02\n");
    std::fs::write(&path, text).unwrap();
    let table = json(&program(&["cases", &path.to_string_lossy(), "--json"]));
    assert_eq!((&table["H_c"], &table["moes"]), (&gear["H_c"], &gear["moes"]));
}

#[test]
fn machines_that_do_not_exist_and_double_statements_are_refused() {
    let undercut = format!("--machine={}", FZG.replace("0.1817", "0"));
    let gear = format!("--machine={FZG}");
    for (words, said) in [
        (vec![&*undercut], "--machine: the pinion with 16 teeth is undercut"),
        (vec![&*gear, "--radius=0.01"], "--machine determines --radius; leave one of them out"),
        (vec!["--machine=Gear(teeth: 3)"], "accepted are Bearing(…), Gear(…) and Cam(…)"),
    ] {
        let output = program(&[&["solve"], &words[..], &STEEL, &OIL].concat());
        let error = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(2) && error.contains(said), "{error}");
    }
}
