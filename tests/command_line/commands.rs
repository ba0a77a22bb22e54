//! The built program as users see it: JSON output, exit codes, messages.

use crate::common::scratch::Scratch;
use serde_json::Value;
use std::process::{Command, Output};

pub const TABLE_2_1: [&str; 12] = [
    "--radius",
    "0.0225",
    "--speed",
    "5.0365",
    "--load",
    "646110",
    "--modulus",
    "287.8e9",
    "--viscosity",
    "0.004",
    "--alpha",
    "22e-9",
];

pub fn program(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ehl-explorer")).args(arguments).output().unwrap()
}

pub fn json(output: &Output) -> Value {
    let text = String::from_utf8(output.stdout.clone()).unwrap();
    assert_eq!(text.lines().count(), 1, "{text}");
    serde_json::from_str(&text).unwrap()
}

/// Asserts exit code 2, no standard output, and one sentence on standard error that contains `words`.
pub fn assert_refused(arguments: &[&str], words: &str) {
    let output = program(arguments);
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
    assert!(output.stdout.is_empty(), "{arguments:?}");
    assert_eq!(error.lines().count(), 1, "{arguments:?}: {error}");
    assert!(!error.contains("panicked"), "{arguments:?}: {error}");
    assert!(error.contains(words), "{arguments:?}: {error}");
}

#[test]
fn complementarity_writes_its_multiplier() {
    let folder = tempfile::tempdir().unwrap();
    let profiles = folder.path().join("profiles.csv");
    let asked = ["solve", "--json", "--moes-m", "20", "--moes-l", "5", "--cavitation", "complementarity"];
    let to = ["--profiles", profiles.to_str().unwrap()];
    let object = json(&program(&[&asked[..], &to].concat()));
    assert_eq!(object["cavitation"], "complementarity");
    let usual = json(&program(&asked[..6]));
    assert_eq!(usual["cavitation"], "penalty");
    let [held, penalised] = [&object, &usual].map(|o| o["H_c"].as_f64().unwrap());
    assert!(held != penalised && (held / penalised - 1.0).abs() < 1e-6);
    let text = std::fs::read_to_string(profiles).unwrap();
    let mut lines = text.lines();
    assert!(lines.next().unwrap().ends_with(",lambda"));
    let mut ruptured = 0;
    for line in lines {
        let values: Vec<f64> = line.split(',').map(|value| value.parse().unwrap()).collect();
        let (pressure, multiplier) = (values[2], values[8]);
        assert!(pressure >= 0.0 && multiplier >= 0.0 && pressure * multiplier == 0.0);
        ruptured += usize::from(multiplier > 0.0);
    }
    assert!(ruptured > 50);
    // The models of line and circular contacts were trained with complementarity and also serve contacts with the
    // penalty. The model of elliptical contacts was trained with the penalty.
    let reduced = |of: &[&str]| json(&program(&[of, &["--method", "reduced"]].concat()));
    let point = ["solve", "--json", "--contact", "point", "--moes-m", "50", "--moes-l", "6"];
    let held = [&point[..], &["--cavitation", "complementarity"]].concat();
    for of in [&asked[..], &asked[..6], &point, &held] {
        let answer = reduced(of);
        assert_eq!((&answer["cavitation"], answer.get("warning")), (&"complementarity".into(), None));
    }
    let ellipse = reduced(&[&held[..], &["--radius-y", "0.02"]].concat());
    assert_eq!(ellipse["cavitation"], "penalty");
    assert!(ellipse["warning"].as_str().unwrap().contains("complementarity"));
}

#[test]
fn inlet_film_starves_and_writes_the_fraction() {
    let folder = tempfile::tempdir().unwrap();
    let profiles = folder.path().join("profiles.csv");
    let asked = ["solve", "--json", "--moes-m", "40", "--moes-l", "10", "--cavitation", "mass-conserving"];
    let flooded = json(&program(&asked));
    assert_eq!(flooded["cavitation"], "mass-conserving");
    assert!(flooded.get("X_meniscus").is_none() && flooded.get("supply_film_m").is_none());
    let drawn = flooded["h_c_m"].as_f64().unwrap();
    let supply = format!("{:e}", 0.5 * drawn);
    let to = ["--supply-film", &supply, "--profiles", profiles.to_str().unwrap()];
    let starved = json(&program(&[&asked[..], &to].concat()));
    let (film, meniscus) = (starved["h_c_m"].as_f64().unwrap(), starved["X_meniscus"].as_f64().unwrap());
    // The lubricant is compressed by a fifth where the film thickness is reported.
    assert!(film < 0.5 * drawn && film > 0.35 * drawn && (-1.5..-1.0).contains(&meniscus), "{film} {meniscus}");
    let text = std::fs::read_to_string(&profiles).unwrap();
    let mut lines = text.lines();
    assert!(lines.next().unwrap().ends_with(",theta"));
    for line in lines {
        let values: Vec<f64> = line.split(',').map(|value| value.parse().unwrap()).collect();
        let (pressure, fraction) = (values[2], values[8]);
        assert!(pressure >= 0.0 && (0.0..=1.0).contains(&fraction) && pressure * (1.0 - fraction) == 0.0);
    }
    let reduced = json(&program(&[&asked[..], &to[..2], &["--method", "reduced"]].concat()));
    assert!(reduced["warning"].as_str().unwrap().contains("flooded inlet"), "{}", reduced["warning"]);
    let usual = ["solve", "--moes-m", "40", "--moes-l", "10"];
    assert_refused(&[&usual[..], &to[..2]].concat(), "mass-conserving");
    assert_refused(&[&asked[..], &["--supply-film", "-1e-9"]].concat(), "above zero");
}

#[test]
fn solve_json_has_the_fields_of_the_contract_and_no_others() {
    let output = program(&[&["solve", "--json"], &TABLE_2_1[..]].concat());
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stderr.is_empty());
    let object = json(&output);
    let mut names: Vec<&str> = object.as_object().unwrap().keys().map(String::as_str).collect();
    let wanted = "contact method converged si srr moes hertz cavitation grid H_c H_min X_H_min P_c P_max X_P_max H_0 h_c_m h_min_m \
        traction rolling_resistance rolling_resistance_fit load_residual residual_norm newton_iterations linear_iterations wall_s";
    let mut wanted: Vec<&str> = wanted.split_whitespace().collect();
    names.sort_unstable();
    wanted.sort_unstable();
    assert_eq!(names, wanted);
    assert_eq!(object["si"]["radius"], 0.0225);
    assert_eq!(object["contact"], "line");
    assert_eq!(object["grid"]["kind"], "uniform");
    assert_eq!(object["grid"]["nx"], 1201);
    assert_eq!(object["grid"]["ny"], 1);
    assert_eq!(object["grid"]["dofs"], 1200);
    assert!((object["moes"]["M"].as_f64().unwrap() - 40.0).abs() < 1e-3);
    assert!((object["hertz"]["p_h_pa"].as_f64().unwrap() / 1.1469e9 - 1.0).abs() < 1e-4);
    let h_c = object["H_c"].as_f64().unwrap();
    assert!((h_c / 0.039_972_008_944 - 1.0).abs() < 1e-6);
    let scale = object["hertz"]["a_m"].as_f64().unwrap().powi(2) / 0.0225;
    assert!((object["h_c_m"].as_f64().unwrap() / (h_c * scale) - 1.0).abs() < 1e-12);
}

#[test]
fn moes_numbers_two_bodies_and_overrides_are_printed_back() {
    let object = json(&program(&["solve", "--json", "--moes-m", "40", "--moes-l", "10", "--grid", "graded"]));
    assert_eq!(object["grid"]["kind"], "graded");
    assert_eq!(object["si"]["radius"], 0.003);
    assert!((object["moes"]["L"].as_f64().unwrap() - 10.0).abs() < 1e-9);
    let bodies = ["--e1", "206e9", "--nu1", "0.3", "--e2", "206e9", "--nu2", "0.3"];
    let object = json(&program(
        &[&["solve", "--json", "--moes-m", "40", "--moes-l", "5", "--load", "2e5"], &bodies[..]].concat(),
    ));
    assert!((object["si"]["modulus"].as_f64().unwrap() / 226.373_626e9 - 1.0).abs() < 1e-6);
    assert_eq!(object["si"]["load"], 2e5);
}

#[test]
fn srr_changes_only_traction_and_high_pressure_warns() {
    let point = ["solve", "--json", "--moes-m", "10", "--moes-l", "3"];
    let still = json(&program(&point));
    let sliding = json(&program(&[&point[..], &["--srr", "-0.5"]].concat()));
    assert_eq!(still["traction"], 0.0);
    assert!(sliding["traction"].as_f64().unwrap() < 0.0);
    assert_eq!(still["H_c"], sliding["H_c"]);
    assert!(still.get("warning").is_none());
    let heavy = json(&program(&["solve", "--json", "--moes-m", "300", "--moes-l", "10", "--grid", "graded"]));
    assert!(heavy["warning"].as_str().unwrap().contains("3.2 GPa"));
}

#[test]
fn reduced_solve_reports_model_and_trained_range() {
    let object = json(&program(&["solve", "--json", "--moes-m", "40", "--moes-l", "10", "--method", "reduced"]));
    assert_eq!((&object["method"], &object["converged"]), (&"reduced".into(), &true.into()));
    assert_eq!(object["grid"]["kind"], "model");
    let reduced = &object["reduced"];
    assert_eq!(reduced["trained"], true);
    let modes = reduced["basis_p"].as_u64().unwrap();
    assert_eq!(object["grid"]["dofs"].as_u64().unwrap(), modes + 1);
    assert!(reduced["sampled_rows"].as_u64().unwrap() >= modes && reduced["basis_delta"].as_u64().unwrap() > 0);
    assert!(reduced["residual_estimate"].as_f64().unwrap() > 0.0);
    let bound = reduced["h_c_error_bound"].as_f64().unwrap();
    assert!(bound > 0.0 && bound < 1e-2 && reduced["h_min_error_bound"].as_f64().is_some(), "{bound}");
    assert!(object.get("linear_iterations").is_none() && object.get("warning").is_none());
    let full = json(&program(&["solve", "--json", "--moes-m", "40", "--moes-l", "10", "--grid", "model"]));
    assert_eq!(full["grid"]["nx"], object["grid"]["nx"]);
    assert!((object["H_c"].as_f64().unwrap() / full["H_c"].as_f64().unwrap() - 1.0).abs() < 1e-3);
    // Another lubricant is solved as well, with a warning that the model was not trained for it.
    let reduced = |of: &[&str]| json(&program(&[&["solve", "--json", "--method", "reduced"], of].concat()));
    assert_eq!(reduced(&TABLE_2_1)["reduced"]["trained"], true);
    let other = reduced(&["--moes-m", "40", "--moes-l", "10", "--viscosity", "0.0015"]);
    assert_eq!(other["reduced"]["trained"], false);
    assert!(other["warning"].as_str().unwrap().contains("η₀ = 1.5 mPa·s lies outside"));
}

#[test]
fn what_a_point_contacts_grid_costs_is_estimated_on_request() {
    let point = ["solve", "--json", "--contact", "point", "--moes-m", "50", "--moes-l", "5"];
    let grid = ["--dx", "0.05", "--dy", "0.1", "--domain=-3,1.8,-1.4", "--accuracy"];
    let report = json(&program(&[&point[..], &grid].concat()));
    let accuracy = &report["accuracy"];
    assert_eq!((&accuracy["nx"], &accuracy["ny"]), (&193.into(), &29.into()));
    let number = |value: &Value| value.as_f64().unwrap();
    let (h_c, limit) = (number(&report["H_c"]), number(&accuracy["H_c_limit"]));
    assert!((number(&accuracy["h_c_error"]) - (h_c / limit - 1.0).abs()).abs() < 1e-12);
    assert!((1e-3..0.1).contains(&number(&accuracy["h_c_error"])), "{accuracy}");
    let line = program(&["solve", "--moes-m", "40", "--moes-l", "10", "--accuracy"]);
    assert_eq!(line.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&line.stderr).contains("--accuracy belongs to"));
}

#[test]
fn stiffness_and_damping_have_units_in_their_names() {
    let frequencies = ["--dynamics", "0,500,5000,20000"];
    let line = ["solve", "--json", "--moes-m", "40", "--moes-l", "10", "--dx", "0.02"];
    let ball =
        ["solve", "--json", "--contact", "point", "--moes-m", "50", "--moes-l", "5", "--dx", "0.06", "--dy", "0.1"];
    for (contact, [stiffness, damping]) in [
        (&line[..], ["stiffness_n_per_m2", "damping_ns_per_m2"]),
        (&ball[..], ["stiffness_n_per_m", "damping_ns_per_m"]),
    ] {
        let report = json(&program(&[contact, &frequencies].concat()));
        let of = |k: usize, name: &str| report["dynamics"][k][name].as_f64().unwrap();
        assert_eq!(report["dynamics"].as_array().unwrap().len(), 4);
        assert_eq!((of(0, "frequency_hz"), of(3, "frequency_hz")), (0.0, 20000.0));
        assert!(of(3, stiffness) > of(0, stiffness) && of(0, damping) > of(3, damping) && of(3, damping) > 0.0);
        // The element is softest at rest, as the film.
        let maxwell = &report["maxwell"];
        let softest = maxwell[format!("static_{stiffness}")].as_f64().unwrap();
        assert!((softest / of(0, stiffness) - 1.0).abs() < 0.1, "{maxwell}");
        assert!(maxwell["deviation"].as_f64().unwrap() < 0.2, "{maxwell}");
    }
    for (options, part) in [
        (&["--dynamics=-1"][..], "between 0 and 1e9 Hz"),
        (&["--dynamics", "NaN"], "between 0 and 1e9 Hz"),
        (&["--dynamics", "100", "--method", "reduced"], "--dynamics belongs to full solutions"),
        (&["--dynamics", "100", "--cavitation", "mass-conserving"], "not mass-conserving cavitation"),
    ] {
        let refused = program(&[&["solve", "--moes-m", "40", "--moes-l", "10"][..], options].concat());
        assert_eq!(refused.status.code(), Some(2), "{options:?}");
        assert!(String::from_utf8_lossy(&refused.stderr).contains(part), "{options:?}");
    }
}

#[test]
fn a_point_contact_prints_its_plane_and_its_fields() {
    let folder = Scratch::new("point");
    let profiles = folder.join("fields.csv");
    let path = profiles.to_string_lossy().into_owned();
    let fixed = ["solve", "--json", "--contact", "point", "--dx", "0.06", "--dy", "0.1", "--domain=-3,1.8,-1.5"];
    let report = json(&program(&[&fixed[..], &["--moes-m", "200", "--moes-l", "10", "--profiles", &path]].concat()));
    assert_eq!((&report["contact"], &report["converged"]), (&"point".into(), &true.into()));
    let grid = &report["grid"];
    assert_eq!((&grid["kind"], &grid["nx"], &grid["ny"]), (&"uniform".into(), &81.into(), &16.into()));
    assert_eq!(grid["dofs"], 79 * 15 + 1);
    let number = |name: &str| report[name].as_f64().unwrap();
    assert!((report["moes"]["M"].as_f64().unwrap() / 200.0 - 1.0).abs() < 1e-9);
    assert!((-1.2..0.0).contains(&number("Y_H_min")) && number("H_min") < number("H_c"));
    assert!(number("load_residual") < 1e-12 && number("linear_iterations") > number("newton_iterations"));
    // The side lobes are as narrow as this grid's spacing across, which the report must state.
    assert!(report["warning"].as_str().unwrap().contains("H_min"));
    let table = std::fs::read_to_string(&profiles).unwrap();
    assert_eq!(table.lines().count(), 1 + 81 * 16);
    assert_eq!(table.lines().next().unwrap(), "X,Y,P,H,x_m,y_m,p_pa,h_m");
    let line = json(&program(&["solve", "--json", "--moes-m", "20", "--moes-l", "5", "--dx", "0.02"]));
    assert!(line["Y_H_min"].is_null() && line["grid"]["ny"] == 1);
}

/// On the default grid, on a given grid, and by the full solver.
#[test]
fn a_grid_that_does_not_do_is_said_and_the_default_one_does() {
    let short = ["solve", "--json", "--moes-m", "0.25", "--moes-l", "5.86"];
    let default = json(&program(&short));
    assert!(
        (default["H_c"].as_f64().unwrap() / 16.7 - 1.0).abs() < 0.02 && default.get("warning").is_none(),
        "{default}"
    );
    let own = json(&program(&[&short[..], &["--domain=-4,2", "--dx", "0.02"]].concat()));
    assert!(
        own["warning"].as_str().is_some_and(|words| words.contains("the inlet at X = -4.000 is too near")),
        "{own}"
    );
    assert!(own["grid"]["truncation_error"].as_f64().unwrap() > 0.1);
    let sweep = program(&["sweep", "m=10:200:2", "--moes-l", "5", "--dx", "0.05"]);
    assert!(String::from_utf8_lossy(&sweep.stderr).contains("H_c is off by about"));
    assert_refused(&["solve", "--contact", "point", "--moes-m", "9e4", "--moes-l", "0.1"], "too thin");
}

/// The speeds of both surfaces are u_m and SRR, and α = 0 is a contact.
#[test]
fn opposed_surfaces_and_zero_alpha_are_solved() {
    let at = ["solve", "--json", "--radius", "0.01", "--load", "1e5", "--modulus", "2e11", "--viscosity", "0.02"];
    let by = |more: &[&str]| json(&program(&[&at[..], &["--dx", "0.02"], more].concat()));
    let reversing = by(&["--alpha", "0", "--u1", "-0.5", "--u2", "4.5"]);
    let rolling = by(&["--alpha", "0", "--speed", "2", "--srr", "2.5"]);
    assert_eq!((&reversing["H_c"], &reversing["srr"]), (&rolling["H_c"], &2.5.into()), "{reversing}");
    assert_eq!((&reversing["si"]["u1"], &reversing["si"]["u2"]), (&(-0.5).into(), &4.5.into()), "{reversing}");
    assert_eq!((&reversing["moes"]["L"], &reversing["converged"]), (&0.0.into(), &true.into()), "{reversing}");
    // Thinner than Roelands' law holds for.
    let thin = ["--radius", "0.01", "--load", "1e5", "--modulus", "2e11", "--viscosity", "4.7e-5", "--alpha", "1e-8"];
    let thin = json(&program(&[&["solve", "--json", "--speed", "5", "--dx", "0.01"], &thin[..]].concat()));
    assert_eq!(thin["converged"], true, "{thin}");
}

/// M = 0.06 is far outside the range of the embedded model.
#[test]
fn full_solver_replaces_a_failed_reduced_solve() {
    let answer = json(&program(&["solve", "--json", "--method", "reduced", "--moes-m", "0.06", "--moes-l", "5"]));
    assert_eq!((&answer["method"], &answer["converged"]), (&"full".into(), &true.into()), "{answer}");
    let warning = answer["warning"].as_str().unwrap();
    assert!(warning.contains("the full solver took over") && answer["H_min"].as_f64().unwrap() > 0.0, "{warning}");
}

#[test]
fn a_reduced_point_contact_agrees_with_the_full_one_on_its_grid() {
    let at = ["solve", "--json", "--contact", "point", "--moes-m", "100", "--moes-l", "6"];
    let reduced = json(&program(&[&at[..], &["--method", "reduced"]].concat()));
    let full = json(&program(&[&at[..], &["--grid", "model"]].concat()));
    assert_eq!((&reduced["converged"], &reduced["reduced"]["trained"]), (&true.into(), &true.into()));
    assert_eq!((&reduced["grid"]["nx"], &reduced["grid"]["ny"]), (&full["grid"]["nx"], &full["grid"]["ny"]));
    assert_eq!(reduced["grid"]["kind"], "model");
    let number = |report: &Value, name: &str| report[name].as_f64().unwrap();
    for (name, bar) in [("H_c", 5e-3), ("H_min", 1e-2), ("P_max", 1e-2)] {
        let error = (number(&reduced, name) / number(&full, name) - 1.0).abs();
        assert!(error < bar, "{name}: {error:.1e}");
    }
    assert!(number(&reduced["reduced"], "h_c_error_bound") > 0.0 && number(&reduced, "Y_H_min") < 0.0);
}

#[test]
fn sweep_writes_a_table() {
    let folder = Scratch::new("sweep");
    let csv = folder.join("sweep.csv");
    let csv_name = csv.to_string_lossy();
    let grid = ["--grid", "uniform", "--dx", "0.02", "--csv", &csv_name];
    let output =
        program(&[&["sweep", "m=10:40:3:log", "l=3:6:2", "--moes-m", "1", "--moes-l", "1"], &grid[..]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let text = std::fs::read_to_string(&csv).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 7);
    assert!(lines[0].starts_with("moes.M,moes.L,si.radius"));
    assert!(lines[3].starts_with("20") && lines[6].starts_with("40,6,"));
    // Both Moes numbers may be given by the sweep alone.
    let output = program(&["sweep", "m=10:40:2", "--moes-l", "5", "--dx", "0.02"]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(String::from_utf8(output.stdout).unwrap().lines().count(), 3);
    for (range, words) in [
        ("m", "NAME=FROM:TO:N"),
        ("m=1:2", "NAME=FROM:TO:N"),
        ("m=1:nan:3", "finite"),
        ("m=-1:2:3:log", "positive"),
        ("m=1:2:3:graded", "NAME=FROM:TO:N"),
        ("m=1:2:3:graded:1.5", "half of the values up to 1.5 do not fit between 1 and 2"),
        ("m=1:2:99999999", "100000"),
        ("mass=1:2:3", "moes-m"),
        ("m=-5:-2:3", "Moes number M"),
    ] {
        assert_refused(&["sweep", range, "--moes-l", "5"], words);
    }
}

#[test]
fn a_contact_that_makes_no_sense_refuses_its_own_row_of_a_sweep() {
    let contact = ["--moes-l", "10", "--method", "reduced"];
    let sweep = [&["sweep", "m=-5:45:3"][..], &contact].concat();
    let output = program(&sweep);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(
        said.contains("1 of 3 points are refused, the first of them: ") && said.contains("Moes number M"),
        "{said}"
    );
    let text = String::from_utf8(output.stdout).unwrap();
    let rows: Vec<&str> = text.lines().collect();
    assert!(rows[0].ends_with(",status,reason,warning"), "{}", rows[0]);
    assert!(rows[1].starts_with("-5,") && rows[1].contains(",refused,") && rows[1].contains("Moes number M"), "{text}");
    assert!(rows[2..].iter().all(|row| row.ends_with(",converged,,")) && rows.len() == 4, "{text}");
    let place = rows[0].split(',').position(|title| title == "H_c").unwrap();
    for (row, m) in rows[2..].iter().zip(["20", "45"]) {
        let solved = json(&program(&[&["solve", "--json", "--moes-m", m][..], &contact].concat()));
        let film: f64 = row.split(',').nth(place).unwrap().parse().unwrap();
        assert!((film / solved["H_c"].as_f64().unwrap() - 1.0).abs() < 1e-9, "{row}");
    }
    let output = program(&[&sweep[..], &["--json"]].concat());
    let first = String::from_utf8(output.stdout).unwrap().lines().next().unwrap().to_owned();
    let object: Value = serde_json::from_str(&first).unwrap();
    assert_eq!(object["moes.M"], -5.0);
    assert!(object["refused"].as_str().unwrap().contains("Moes number M"), "{object}");
}

#[test]
fn help_names_every_command_and_lubricant() {
    let text = |arguments: &[&str]| {
        let output = program(arguments);
        assert_eq!(output.status.code(), Some(0));
        String::from_utf8(output.stdout).unwrap()
    };
    let help = text(&["--help"]);
    assert!(["solve", "sweep", "run", "train", "bench", "info"].iter().all(|command| help.contains(command)));
    let help = text(&["solve", "--help"]);
    assert!(help.contains("roelands-oil") && help.contains("barus-oil"));
    assert!(text(&["--version"]).contains(env!("CARGO_PKG_VERSION")));
}

#[test]
#[cfg(unix)]
fn a_reader_that_leaves_early_is_no_panic() {
    use std::process::Stdio;
    let mut child = Command::new(env!("CARGO_BIN_EXE_ehl-explorer"))
        .args(["sweep", "m=10:40:40", "--moes-l", "5", "--dx", "0.02", "--json"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert!(!String::from_utf8_lossy(&output.stderr).contains("panicked"));
}

#[test]
fn sliding_shear_thinning_contacts_show_film_shear() {
    let folder = Scratch::new("film_shear");
    let file = folder.join("shear.csv");
    let path = file.to_string_lossy().into_owned();
    let contact = [
        "solve",
        "--json",
        "--lubricant",
        "squalane-pip",
        "--radius",
        "0.0127",
        "--speed",
        "0.74",
        "--modulus",
        "1.2388e11",
        "--srr",
        "0.5",
    ];
    let line = json(&program(&[&contact[..], &["--load", "144000", "--dx", "0.01", "--film-shear", &path]].concat()));
    // Independent solutions on the same grids.
    let traction = line["traction"].as_f64().unwrap();
    assert!((traction / 0.032052 - 1.0).abs() < 0.01, "{traction}");
    let point = json(&program(&[&contact[..], &["--contact", "point", "--load", "23"]].concat()));
    let traction = point["traction"].as_f64().unwrap();
    assert!((traction / 0.029735 - 1.0).abs() < 0.01, "{traction}");
    let table = std::fs::read_to_string(&file).unwrap();
    assert_eq!(table.lines().next().unwrap(), "X,Z,tau_zx_pa,rate_per_s");
    assert_eq!(table.lines().count(), 1 + 601 * 11);
}

#[test]
fn models_are_named_in_place_of_their_files() {
    let solve = |model: &[&str]| {
        program(&[&["solve", "--moes-m", "40", "--moes-l", "10", "--method", "reduced", "--json"], model].concat())
    };
    let (named, usual) = (json(&solve(&["--rom", "line"])), json(&solve(&[])));
    assert_eq!(named["H_c"], usual["H_c"]);
    let unknown = solve(&["--rom", "no_such_model"]);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&unknown.stderr).contains("no_such_model"));
}
