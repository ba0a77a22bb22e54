//! Thermal contacts on the command line.

use crate::commands::{assert_refused, json, program};

const CONTACT: [&str; 13] = [
    "solve",
    "--radius",
    "0.01",
    "--speed",
    "2",
    "--load",
    "3e5",
    "--modulus",
    "231e9",
    "--viscosity",
    "0.02",
    "--alpha",
    "1.8e-8",
];
const SLIDING: [&str; 7] = ["--srr", "0.5", "--grid", "graded", "--domain=-10,2", "--heat", "--json"];

#[test]
fn a_contact_with_heat_tells_its_temperatures_and_writes_them() {
    let folder = tempfile::tempdir().unwrap();
    let profiles = folder.path().join("profiles.csv");
    let eyring = ["--shear", "eyring", "--shear-stress", "6e6", "--profiles", profiles.to_str().unwrap()];
    let warm = json(&program(&[&CONTACT[..], &SLIDING, &eyring].concat()));
    let heat = |name: &str| warm["heat"][name].as_f64().unwrap();
    // Values of an independent solver, extrapolated to vanishing spacings. Its body 1 is the faster one.
    for (found, wanted, within) in [
        (warm["H_c"].as_f64().unwrap(), 0.0744185, 3e-3),
        (warm["traction"].as_f64().unwrap(), 0.0327481, 1e-2),
        (heat("mid_film_rise_k"), 22.7812, 1e-2),
        (heat("surface_1_rise_k"), 14.7274, 1e-2),
        (heat("surface_2_rise_k"), 12.4927, 1e-2),
    ] {
        assert!((found / wanted - 1.0).abs() < within, "{found} {wanted}");
    }
    assert!(heat("energy_balance").abs() < 1e-3 && heat("into_bodies") > 0.99);
    let text = std::fs::read_to_string(profiles).unwrap();
    let mut lines = text.lines();
    assert!(lines.next().unwrap().ends_with("mid_film_rise_k,surface_1_rise_k,surface_2_rise_k"));
    let hottest = lines.map(|line| line.rsplit(',').nth(2).unwrap().parse::<f64>().unwrap()).fold(0.0, f64::max);
    assert!((hottest / heat("mid_film_rise_max_k") - 1.0).abs() < 1e-9);
    // The spike of this contact is cooler than its film.
    let (film, spike) = (heat("mid_film_rise_outside_spike_k"), heat("mid_film_rise_in_spike_k"));
    assert_eq!(film, heat("mid_film_rise_max_k"));
    assert!(spike > 0.8 * film && spike < 0.9 * film, "{film} {spike}");
}

#[test]
fn glass_keeps_the_heat_and_a_limit_makes_less_of_it() {
    let of = |more: &[&str]| json(&program(&[&CONTACT[..], &SLIDING, more].concat()));
    let rise = |object: &serde_json::Value, name: &str| object["heat"][name].as_f64().unwrap();
    let steel = of(&["--limiting-stress", "2e6,0.02"]);
    let glass = of(&["--limiting-stress", "2e6,0.02", "--body2", "glass"]);
    assert!(rise(&glass, "surface_2_rise_k") > 2.0 * rise(&steel, "surface_2_rise_k"));
    assert!(steel["traction"].as_f64().unwrap() < 0.025);
}

/// A glass disc and a steel ball, given by their elastic and thermal constants. The disc is slower.
#[test]
fn exchanged_bodies_and_reversed_sliding_agree() {
    let oil = ["--radius=0.0127", "--speed=0.74", "--load=1e5", "--viscosity=0.05", "--alpha=1.8e-8", "--heat"];
    let solve =
        |bodies: [&str; 7]| json(&program(&[&["solve", "--grid=graded", "--json"], &oil[..], &bodies].concat()));
    let disc = ["--e1=81e9", "--nu1=0.21", "--e2=210e9", "--nu2=0.3", "--body1=glass", "--body2=steel", "--srr=0.5"];
    let other = ["--e2=81e9", "--nu2=0.21", "--e1=210e9", "--nu1=0.3", "--body2=glass", "--body1=steel", "--srr=-0.5"];
    let [disc, other] = [disc, other].map(solve);
    let close = |a: &serde_json::Value, b: &serde_json::Value, sign: f64| {
        let [a, b] = [a, b].map(|value| value.as_f64().unwrap());
        assert!((sign * b / a - 1.0).abs() < 1e-6, "{a} {b}");
    };
    close(&disc["H_c"], &other["H_c"], 1.0);
    close(&disc["traction"], &other["traction"], -1.0);
    assert!(disc["traction"].as_f64().unwrap() > 0.0);
    let [heat, exchanged] = [&disc["heat"], &other["heat"]];
    close(&heat["mid_film_rise_k"], &exchanged["mid_film_rise_k"], 1.0);
    close(&heat["surface_1_rise_k"], &exchanged["surface_2_rise_k"], 1.0);
    close(&heat["surface_2_rise_k"], &exchanged["surface_1_rise_k"], 1.0);
    assert!(heat["surface_1_rise_k"].as_f64() > heat["surface_2_rise_k"].as_f64(), "{heat}");
}

/// Small thermal training around the contact.
const TRAINING: &str = "Scene(
    version: 1,
    title: \"heat\",
    heat: (inlet_temperature: 313.15),
    study: Training(
        title: \"Line contacts with heat\",
        range: (axes: {M: (18.0, 26.0), L: (9.0, 11.0), SlideToRollRatio: (0.0, 0.5)},
            limits: {HertzPressure: (0.0, 1.6e9)},
            fixed: {Radius: 0.01, Modulus: 231e9, Viscosity: 0.02, Alpha: 1.8e-8}),
        lubricant: (limiting_stress: (ambient: 5e6, slope: 0.05, eyring: 5e6)),
        plan: FarthestPoint(snapshots: 40),
        windows: Given([(m: (18.0, 26.0), grid: Graded(nodes: 280, domain: (-10.0, 2.0), registered: true))]),
        pressure_loss: 1e-7,
        deformation_loss: 0.1,
        sampling: All,
        rows_per_mode: 2.5,
        penalty: 1e5,
        positive_modes: true,
        evidence: 0,
        seed: 1,
    ),
)";

#[test]
fn thermal_model_reports_its_limits() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (scene, rom) = (path("heat.ron"), path("heat.rom"));
    std::fs::write(&scene, TRAINING).unwrap();
    assert!(program(&["train", &scene, "--out", &rom]).status.success());
    let oil = ["--lubricant", "mineral-oil", "--heat", "--srr", "0.3", "--json"];
    let solve = |more: &[&str]| json(&program(&[&CONTACT[..], &oil, more].concat()));
    let reduced = ["--method", "reduced", "--rom", &rom];
    let own = solve(&reduced);
    let full = solve(&["--grid", "model", "--rom", &rom]);
    assert_eq!((own["method"].as_str(), own["reduced"]["trained"].as_bool()), (Some("reduced"), Some(true)));
    for name in ["H_c", "H_min", "traction"] {
        let [a, b] = [&own, &full].map(|object| object[name].as_f64().unwrap());
        assert!((a / b - 1.0).abs() < 5e-3, "{name}: {a} {b}");
    }
    let [a, b] = [&own, &full].map(|object| object["heat"]["mid_film_rise_k"].as_f64().unwrap());
    assert!((a / b - 1.0).abs() < 1e-2 && a > 1.0, "{a} {b}");
    // Another lubricant is solved with a warning; an isothermal model refuses.
    let other = solve(&[&reduced[..], &["--inlet-temperature", "353.15"]].concat());
    assert!(other["warning"].as_str().unwrap().contains("other thermal constants"));
    let cold = json(&program(&[&CONTACT[..], &["--lubricant", "mineral-oil", "--json"], &reduced].concat()));
    assert!(cold["warning"].as_str().unwrap().contains("trained for thermal contacts"));
    let info = String::from_utf8(program(&["info", &rom]).stdout).unwrap();
    assert!(info.contains("varies: M 18…26, L 9…11, SRR 0…50 %\n") && info.contains("fixes: R 10 mm, "), "{info}");
}

#[test]
fn the_programs_model_answers_for_a_ball_with_heat() {
    let ball = ["solve", "--contact", "point", "--moes-m", "60", "--moes-l", "7", "--srr", "0.2", "--grid", "model"];
    let oil = ["--lubricant", "mineral-oil", "--heat", "--json"];
    let solved = |method: &str| json(&program(&[&ball[..], &oil, &["--method", method]].concat()));
    let [own, full] = ["reduced", "full"].map(solved);
    assert_eq!(own["reduced"]["trained"], true, "{own}");
    for name in ["H_c", "traction"] {
        let [a, b] = [&own, &full].map(|object| object[name].as_f64().unwrap());
        assert!((a / b - 1.0).abs() < 1e-2, "{name}: {a} {b}");
    }
    let [a, b] = [&own, &full].map(|object| object["heat"]["mid_film_rise_k"].as_f64().unwrap());
    assert!(b > 1.0 && (a / b - 1.0).abs() < 3e-2, "{a} {b}");
    assert!(own["heat"]["energy_balance"].as_f64().unwrap().abs() < 3e-2);
}

#[test]
fn embedded_thermal_model_covers_inlets_and_bodies() {
    let oil = ["--lubricant", "mineral-oil", "--heat", "--srr", "0.3", "--grid", "model", "--json"];
    let solve =
        |more: &[&str], method: &str| json(&program(&[&CONTACT[..], &oil, more, &["--method", method]].concat()));
    for more in [
        &["--inlet-temperature", "353.15", "--body2", "silicon-nitride"][..],
        &["--oil-thermal", "1900,0.12,880", "--viscosity-temperature", "0.03", "--body1", "tungsten-carbide"],
    ] {
        let [own, full] = ["reduced", "full"].map(|method| solve(more, method));
        assert_eq!((&own["method"], &own["reduced"]["trained"]), (&"reduced".into(), &true.into()), "{own}");
        for (name, bar) in [("H_c", 2e-3), ("traction", 5e-3)] {
            let [a, b] = [&own, &full].map(|object| object[name].as_f64().unwrap());
            assert!((a / b - 1.0).abs() < bar, "{name}: {a} {b}");
        }
        let [a, b] = [&own, &full].map(|object| object["heat"]["mid_film_rise_k"].as_f64().unwrap());
        assert!((a / b - 1.0).abs() < 1e-2 && a > 1.0, "{a} {b}");
    }
    // The same contact with exchanged bodies and the opposite sliding.
    let one = solve(&["--body1", "silicon-nitride"], "reduced");
    let mut words = [&CONTACT[..], &oil, &["--body2", "silicon-nitride", "--method", "reduced"]].concat();
    words.iter_mut().filter(|word| **word == "0.3").for_each(|word| *word = "-0.3");
    let other = json(&program(&words));
    for (sign, a, b) in [
        (1.0, &one["H_c"], &other["H_c"]),
        (-1.0, &one["traction"], &other["traction"]),
        (1.0, &one["heat"]["surface_1_rise_k"], &other["heat"]["surface_2_rise_k"]),
        (1.0, &one["heat"]["surface_2_rise_k"], &other["heat"]["surface_1_rise_k"]),
    ] {
        let [a, b] = [a, b].map(|value| value.as_f64().unwrap());
        assert!((sign * b / a - 1.0).abs() < 1e-6, "{a} {b}");
    }
    let hot = solve(&["--inlet-temperature", "420"], "reduced");
    assert!(hot["warning"].as_str().unwrap().contains("the inlet temperature = 420 K lies outside"), "{hot}");
}

#[test]
fn what_heat_cannot_be_computed_for_is_refused_in_one_sentence() {
    for (more, words) in [
        (&["--body1", "glass"][..], "no effect without --heat"),
        (&["--inlet-temperature", "313"], "no effect without --heat"),
        (&["--heat", "--srr", "2"], "moving heat sources"),
        (&["--heat", "--inlet-temperature", "20"], "inlet temperature in kelvin is 20"),
        (&["--heat", "--body2", "0,1,2"], "body 2's thermal conductivity"),
        (&["--heat", "--body2", "wood"], "silicon-nitride"),
        (&["--heat", "--oil-thermal", "2000,0.14"], "three numbers"),
        (&["--heat", "--viscosity-temperature", "NaN"], "temperature coefficient"),
        (&["--shear", "eyring"], "needs --shear-stress"),
        (&["--shear", "carreau", "--shear-stress", "1e4"], "needs --shear-n"),
        (&["--shear-stress", "1e4"], "belongs to --shear"),
        (&["--shear-n", "0.5"], "belong to --shear carreau"),
        (&["--limiting-stress", "5e6"], "two numbers"),
    ] {
        assert_refused(&[&CONTACT[..], more].concat(), words);
    }
}

#[test]
fn thermal_ellipse_falls_back_to_the_full_solver() {
    let ellipse = ["solve", "--contact", "point", "--moes-m", "50", "--moes-l", "8", "--radius-y", "0.03"];
    let warm = json(&program(&[&ellipse[..], &["--heat", "--method", "reduced", "--json"]].concat()));
    assert_eq!(warm["method"], "full");
    let warning = warm["warning"].as_str().unwrap();
    assert!(warning.contains("circular contacts only") && warning.contains("full solver took over"), "{warning}");
}
