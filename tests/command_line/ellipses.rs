//! Elliptical contacts on the command line and in scenes.

use crate::commands::{assert_refused, json, program};
use ehl_explorer::scene::Scene;

const POINT: [&str; 7] = ["solve", "--contact", "point", "--moes-m", "50", "--moes-l", "8"];
const COARSE: [&str; 5] = ["--dx", "0.06", "--dy", "0.2", "--json"];

#[test]
fn a_radius_across_makes_an_ellipse_that_is_printed_back() {
    let folder = tempfile::tempdir().unwrap();
    let profiles = folder.path().join("plane.csv");
    let ellipse = ["--radius-y", "0.05", "--profiles", profiles.to_str().unwrap()];
    let object = json(&program(&[&POINT[..], &COARSE, &ellipse].concat()));
    assert_eq!((&object["contact"], &object["si"]["radius_y"]), (&"point".into(), &0.05.into()));
    let of = |group: &str, name: &str| object[group][name].as_f64().unwrap();
    // M and L are formed with the radius along the rolling direction.
    assert!((of("moes", "M") - 50.0).abs() < 1e-9 && of("si", "radius") == 0.01);
    let (a, b, kappa) = (of("hertz", "a_m"), of("hertz", "b_m"), of("hertz", "kappa"));
    assert!((kappa / 2.8901810398 - 1.0).abs() < 1e-9 && (b / (kappa * a) - 1.0).abs() < 1e-12);
    let load = 2.0 / 3.0 * std::f64::consts::PI * a * b * of("hertz", "p_h_pa");
    assert!((load / of("si", "load") - 1.0).abs() < 1e-12);
    let text = std::fs::read_to_string(profiles).unwrap();
    let titles: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let [x, y, x_m, y_m] = ["X", "Y", "x_m", "y_m"].map(|name| titles.iter().position(|title| *title == name).unwrap());
    for line in text.lines().skip(1).step_by(97) {
        let row: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        assert!((row[x_m] - a * row[x]).abs() < 1e-15 && (row[y_m] - b * row[y]).abs() < 1e-15);
    }
    let circle = json(&program(&[&POINT[..], &COARSE].concat()));
    assert_eq!((&circle["hertz"]["kappa"], &circle["hertz"]["b_m"]), (&1.0.into(), &circle["hertz"]["a_m"]));
    assert_ne!(circle["H_c"], object["H_c"]);
    let equal = json(&program(&[&POINT[..], &COARSE, &["--radius-y", "0.01"]].concat()));
    assert_eq!((&equal["H_c"], &equal["H_min"], &equal["H_0"]), (&circle["H_c"], &circle["H_min"], &circle["H_0"]));
}

#[test]
fn what_is_no_ellipse_is_refused_in_one_sentence() {
    for (radius_y, words) in [
        ("-0.05", "convex together in both directions"),
        ("0", "convex together"),
        ("NaN", "radius-y is NaN"),
        ("10", "radius ratio R_y/R_x is 1000"),
        ("1e-5", "must be a finite number between 2e-2 and 5e2"),
    ] {
        assert_refused(&[&POINT[..], &["--radius-y", radius_y]].concat(), words);
    }
    assert_refused(&["solve", "--moes-m", "40", "--moes-l", "10", "--radius-y", "0.05"], "no radius across");
    let text = |contact: &str, radius_y: &str| {
        format!(
            "Scene(version: 1, title: \"t\", source: \"s\", contact: {contact}, \
             at: Moes(m: 50.0, l: 8.0, radius_y: {radius_y}), study: Point(methods: [Full]))"
        )
    };
    assert!(Scene::from_ron(&text("Point", "0.05")).is_ok());
    for (contact, radius_y, words) in
        [("Point", "-0.05", "convex"), ("Point", "NaN", "NaN"), ("Line", "0.05", "across")]
    {
        let refused = Scene::from_ron(&text(contact, radius_y)).unwrap_err().to_string();
        assert!(refused.contains(words), "{refused}");
    }
}

/// The embedded model of elliptical contacts is used; a model of circular contacts reports that it supports no others.
#[test]
fn a_reduced_model_does_not_pass_a_circle_off_as_an_ellipse() {
    let asked = [&POINT[..], &["--radius-y", "0.05", "--method", "reduced", "--json"]].concat();
    let object = json(&program(&asked));
    assert_eq!((&object["method"], &object["converged"]), (&"reduced".into(), &true.into()));
    let circles = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/point.rom");
    let full = json(&program(&[&asked[..], &["--rom", circles]].concat()));
    assert_eq!((&full["method"], &full["converged"]), (&"full".into(), &true.into()));
    let warning = full["warning"].as_str().unwrap();
    assert!(warning.contains("circular contacts only") && warning.contains("full solver took over"), "{warning}");
    let [reduced, full] = [&object, &full].map(|object| object["H_c"].as_f64().unwrap());
    assert!((reduced / full - 1.0).abs() < 3e-2, "{reduced} {full}: each on its own grid");
}

#[test]
fn radii_and_their_ratio_are_swept() {
    let folder = tempfile::tempdir().unwrap();
    let csv = folder.path().join("sweep.csv");
    let asked = ["sweep", "radius-y=0.005:0.02:3:log", "--contact", "point", "--moes-m", "50", "--moes-l", "8"];
    let output = program(&[&asked[..], &COARSE[..4], &["--csv", csv.to_str().unwrap()]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let text = std::fs::read_to_string(csv).unwrap();
    let titles: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let column = titles.iter().position(|title| title.ends_with("h_c_m")).unwrap();
    let films: Vec<f64> =
        text.lines().skip(1).map(|line| line.split(',').nth(column).unwrap().parse().unwrap()).collect();
    assert!(films.len() == 3 && films.windows(2).all(|pair| pair[1] > pair[0]), "{films:?}");
}
