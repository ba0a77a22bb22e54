//! Studies of moving surfaces and of circular contacts in time: their results and refusals.

use ehl_explorer::engine::{SceneOutcome, Workbench, run_scene};
use ehl_explorer::scene::Scene;

const LINE: &str =
    "at: Si(radius: 0.003, speed: 1.695, load: 242400.0, modulus: 231e9, viscosity: 0.01, alpha: 1.309e-8),
    grid: Uniform(dx: 0.02, domain: (-4.0, 2.0))";
const BALL: &str = "contact: Point, cavitation: Complementarity,
    at: Si(radius: 0.01, speed: 0.26, load: 4.8, modulus: 231e9, viscosity: 0.04, alpha: 2e-8),
    grid: Plane(dx: 0.08, dy: 0.1, domain: (-4.0, 2.0, -2.0))";

fn scene(contact: &str, study: &str) -> Result<Scene, String> {
    let text = format!("Scene(version: 1, title: \"study\", {contact}, study: {study})");
    Scene::from_ron(&text).map_err(|error| error.to_string())
}

fn run(contact: &str, study: &str) -> SceneOutcome {
    let scene = scene(contact, study).unwrap();
    assert_eq!(Scene::from_ron(&scene.to_ron().unwrap()).unwrap(), scene);
    let outcome = run_scene(&scene, &mut Workbench::new(""), &()).unwrap();
    assert!(outcome.found.converged, "{:?}", outcome.found.warnings);
    outcome
}

fn value(outcome: &SceneOutcome, name: &str) -> f64 {
    outcome.found.value(name, None).unwrap_or_else(|| panic!("no {name}"))
}

#[test]
fn sliding_sets_the_speed_of_the_wavy_body() {
    let study = |body: u8| format!("Amplitude(wavelengths: [1.0, 0.5], body: {body})");
    let sliding = |srr: f64| format!("srr: {srr:?}, {LINE}");
    let [slow, fast] = [1, 2].map(|body| run(&sliding(0.5), &study(body)));
    let mirrored = run(&sliding(-0.5), &study(1));
    for k in 0..2 {
        let name = format!("exact.amplitude_{k}");
        assert!(value(&slow, &name) < value(&fast, &name), "the faster surface keeps more of its waves");
        assert_eq!(value(&fast, &name), value(&mirrored, &name), "body 2 at SRR is body 1 at −SRR");
        let (real, imaginary) =
            (value(&slow, &format!("exact.real_{k}")), value(&slow, &format!("exact.imaginary_{k}")));
        assert!((real.hypot(imaginary) - value(&slow, &name)).abs() < 1e-12);
    }
    let table = &slow.tables[0];
    assert_eq!((table.rows.len(), table.columns.len()), (2, 6));
}

#[test]
fn a_feature_passes_the_contact_at_the_speed_of_its_body() {
    // T at which a dent on either body, from X = −2.5 at T = 0, is at X = 0: 2.5 u_m/u.
    let passed = |body: u8| {
        let shape = "Gauss(height: -1e-8, width: 4e-5, at: -2.5)";
        let study =
            format!("Transient(duration: 5.0, time_step: Fixed(0.02), surfaces: [(body: {body}, shape: {shape})])");
        let outcome = run(&format!("srr: 0.5, {LINE}"), &study);
        let series = &outcome.tables[0];
        let column = |name: &str| series.columns.iter().position(|column| column == name).unwrap();
        let (time, film) = (column("T"), column("H_c"));
        let peak = series.rows.iter().max_by(|a, b| a[film].total_cmp(&b[film])).unwrap();
        peak[time]
    };
    // The film of the slower body's dent is dragged ahead of it, that of the faster one behind.
    let (slow, fast) = (passed(1), passed(2));
    assert!((2.5..3.5).contains(&slow) && (1.9..2.6).contains(&fast) && slow > fast, "{slow} {fast}");
}

#[test]
fn a_profile_from_a_file_is_the_shape_that_it_samples() {
    let folder = tempfile::tempdir().unwrap();
    let a = 8.953_462_156_216_784e-5;
    let mut text = String::from("x,height\n");
    for k in -400..=400 {
        let y = 0.01 * f64::from(k);
        text += &format!("{},{}\n", (y - 2.5) * a, 2e-8 * (-(y / 0.4).powi(2)).exp());
    }
    std::fs::write(folder.path().join("bump.csv"), text).unwrap();
    let study = |shape: &str| {
        format!(
            "Transient(duration: 3.0, time_step: Fixed(0.02), surfaces: [(shape: {shape})], scheme: Characteristic)"
        )
    };
    let run = |shape: &str| {
        let scene = scene(LINE, &study(shape)).unwrap();
        run_scene(&scene, &mut Workbench::new(folder.path()), &()).unwrap()
    };
    let (sampled, stated) =
        (run("Profile(\"bump.csv\")"), run(&format!("Gauss(height: 2e-8, width: {:e}, at: -2.5)", 0.4 * a)));
    for name in ["fixed.H_c.min", "fixed.P_c.max"] {
        assert!((value(&sampled, name) / value(&stated, name) - 1.0).abs() < 1e-3, "{name}");
    }
}

#[test]
fn a_ball_follows_load_speed_and_approach() {
    let loaded = run(
        BALL,
        "Transient(inputs: (load: Harmonic(amplitude: 0.2, period: 1.0)), duration: 1.0, time_step: Fixed(0.05))",
    );
    assert!(value(&loaded, "fixed.P_c.max") > 1.1 * value(&loaded, "fixed.P_c.min"));
    let faster = "Transient(inputs: (speed: Sampled(times: [0.0, 1.0], values: [1.0, 1.5])), duration: 6.0, time_step: Fixed(0.1))";
    let faster = run(BALL, faster);
    let growth = value(&faster, "fixed.H_c.max") / value(&faster, "fixed.H_c.start");
    assert!((1.2..1.5).contains(&growth), "1.5^0.67 = 1.31: {growth}");
    let nearer = run(
        BALL,
        "Transient(separation: Sampled(times: [0.0, 1.0], values: [1.0, 0.9]), duration: 4.0, time_step: Fixed(0.05))",
    );
    let load = value(&nearer, "fixed.load.max");
    assert!((1.1..1.25).contains(&load), "1 + 1.5 · 0.1: {load}");
}

#[test]
fn invalid_surfaces_are_refused_with_their_field() {
    let surface = |shape: &str, rest: &str| {
        format!("Transient(duration: 2.0, time_step: Fixed(0.02), surfaces: [(shape: {shape})]{rest})")
    };
    let gauss = "Gauss(height: 1e-8, width: 2e-5, at: -2.5)";
    for (contact, study, part) in [
        (LINE, surface("Gauss(height: 2e-6, width: 2e-5, at: -2.5)", ""), "at most the flattening"),
        (LINE, surface("Venner(height: 1e-8, width: 7e-6, at: -2.5)", ""), "4 spacings"),
        (LINE, surface("Venner(height: 1e-8, width: -1.0, at: -2.5)", ""), "study.surfaces.0.shape.width"),
        (LINE, surface("Wave(height: NaN, wavelength: 2e-5, at: -2.5)", ""), "study.surfaces.0.shape.height"),
        (LINE, surface(gauss, ", reduced: (loss: 1e-5)"), "`study.surfaces` needs the full solver"),
        (LINE, surface(gauss, ", frames: [ArbitraryLagrangianEulerian]"), "fixed frame"),
        (LINE, surface(gauss, ", inputs: (speed: Harmonic(amplitude: 0.1, period: 1.0))"), "constant"),
        (
            LINE,
            "Transient(duration: 2.0, time_step: Fixed(0.01), scheme: Characteristic)".to_owned(),
            "equal to its spacing",
        ),
        (LINE, surface(gauss, "").replace("Fixed(0.02)", "Fixed(0.5)"), "a quarter of its length"),
        (LINE, surface(gauss, "").replace("(shape:", "(body: 3, shape:"), "study.surfaces.0.body"),
        (BALL, "Transient(duration: 1.0, time_step: Fixed(0.1), reduced: (loss: 1e-5))".to_owned(), "`responses: ()`"),
        (BALL, "Transient(duration: 1.0, time_step: Fixed(0.1), mass_between: (-1.0, 0.0))".to_owned(), "mass_between"),
        (
            BALL,
            "Transient(duration: 1.0, time_step: Fixed(0.1), inputs: (speed: Reversing(amplitude: 1.0, period: 2.0)))"
                .to_owned(),
            "does not reverse",
        ),
        (LINE, "Amplitude(wavelengths: [0.05])".to_owned(), "four spacings"),
        (LINE, "Amplitude(wavelengths: [1.0], body: 0)".to_owned(), "study.body"),
        (LINE, "Amplitude(wavelengths: [])".to_owned(), "study.wavelengths"),
        (BALL, "Amplitude(wavelengths: [1.0], derivatives: [Characteristic])".to_owned(), "Characteristic"),
    ] {
        let refused = scene(contact, &study).unwrap_err();
        assert!(refused.contains(part), "{study}: {refused}");
    }
}
