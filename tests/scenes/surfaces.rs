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
fn a_low_wave_at_rest_changes_the_film_as_the_linear_response_says() {
    let at_rest = format!("srr: 2.0, {LINE}");
    let wave = "Wave(height: 1e-10, wavelength: 8.953462156216784e-5, at: 3.0)";
    let linear = value(&run(&at_rest, "Amplitude(wavelengths: [1.0])"), "exact.real_0");
    let outcome = run(&at_rest, &format!("StationaryProfile(surface: {wave}, factors: [1.0, 2.0])"));
    let change = |k: usize| value(&outcome, &format!("H_c_{k}")) - value(&outcome, "smooth.H_c");
    // The nodes have the mean heights of their cells, which are lower by sin(πΔX)/(πΔX).
    let a = 8.953_462_156_216_784e-5_f64;
    let height = 1e-10 / (a * a / 0.003) * (0.02 * std::f64::consts::PI).sin() / (0.02 * std::f64::consts::PI);
    let ratio = change(0) / (-height * linear);
    assert!((ratio - 1.0).abs() < 2e-3, "{ratio}");
    assert!((change(1) / change(0) - 2.0).abs() < 2e-3, "{}", change(1) / change(0));
    let rq = value(&outcome, "Rq_m");
    assert!((rq / 1e-10 * 2f64.sqrt() - 1.0).abs() < 1e-2, "{rq:e}");
    assert!(value(&outcome, "resolved_share") > 0.99);
    let of_factor_1 = |row: &&Vec<f64>| row[0] == 1.0;
    assert!(outcome.tables[2].rows.iter().filter(of_factor_1).count() > 200);
}

#[test]
fn a_measured_surface_at_rest_is_levelled_and_averaged_over_cells() {
    let folder = tempfile::tempdir().unwrap();
    let a = 8.953_462_156_216_784e-5;
    let write = |name: &str, to: f64, height: &dyn Fn(f64) -> f64| {
        let points = (0..=3000).map(|k| -3.0 + (to + 3.0) * f64::from(k) / 3000.0);
        let lines: String = points.map(|x| format!("{},{}\n", x * a, height(x))).collect();
        std::fs::write(folder.path().join(name), format!("x,height\n{lines}")).unwrap();
    };
    let wave = |x: f64| 1e-8 * (std::f64::consts::TAU * x / 0.5).cos();
    write("level.csv", 3.0, &wave);
    write("tilted.csv", 3.0, &|x| wave(x) + 1e-7 * x + 3e-7);
    write("fine.csv", 3.0, &|x| wave(x) + 2e-8 * (std::f64::consts::TAU * x / 0.013).cos());
    write("short.csv", 0.5, &wave);
    let run = |name: &str| {
        let scene = scene(&format!("srr: -2.0, {LINE}"), &format!("StationaryProfile(surface: Profile(\"{name}\"))"));
        run_scene(&scene.unwrap(), &mut Workbench::new(folder.path()), &())
    };
    let [level, tilted, fine] = ["level.csv", "tilted.csv", "fine.csv"].map(|name| run(name).unwrap());
    for name in ["H_c_0", "H_min_0", "P_max_0", "Rq_m", "resolved_share"] {
        let (level, tilted) = (value(&level, name), value(&tilted, name));
        assert!((level / tilted - 1.0).abs() < 1e-6, "{name}: {level} {tilted}");
    }
    assert!(value(&level, "P_max_0") > 1.01 * value(&level, "smooth.P_max"), "crests carry more");
    // Three quarters of the roughness of the last profile are shorter than a cell.
    let warnings = format!("{:?}", fine.found.warnings);
    assert!(value(&fine, "resolved_share") < 0.6 && warnings.contains("SurfaceUnresolved"), "{warnings}");
    let change = value(&fine, "H_c_0") / value(&level, "H_c_0");
    assert!((change - 1.0).abs() < 0.01, "waves shorter than the cells average out: {change}");
    let short = run("short.csv").unwrap_err().to_string();
    assert!(short.contains("must cover the contact"), "{short}");
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
        (LINE, format!("StationaryProfile(surface: {gauss})"), "must be 2 or -2"),
        (BALL, format!("StationaryProfile(surface: {gauss})"), "must be Line"),
    ] {
        let refused = scene(contact, &study).unwrap_err();
        assert!(refused.contains(part), "{study}: {refused}");
    }
}
