//! Published films of a contact through which a feature passes: found at their places, and refused without them.

use ehl_explorer::engine::{Workbench, run_scene};
use ehl_explorer::scene::Scene;
use ehl_explorer::solver::discrete::grid::GridSpec;
use ehl_explorer::solver::full::transient::{Inputs, Keep, MovingSurface, Shape, Transient, solve};
use ehl_explorer::solver::physics::contact::OperatingPoint;

const STEP: f64 = 0.05;
const DEPTH: f64 = 2e-7;

fn point() -> OperatingPoint {
    OperatingPoint {
        radius_m: 0.01,
        speed_m_per_s: 2.5,
        load: 2e5,
        modulus_pa: 231e9,
        viscosity_pa_s: 0.01,
        alpha_per_pa: 2e-8,
        ..OperatingPoint::TABLE_2_1
    }
}

/// Returns the film at a step of a march in µm and nm, displaced by a length in µm, and the position of the dent in µm.
fn film(step: usize, displaced: f64) -> (String, f64) {
    let (a, height) = (point().hertz().half_width_m, point().film_scale_m());
    let shape = Shape::Dent { depth: DEPTH / height, radius: 0.4 };
    let march = Transient {
        surfaces: vec![MovingSurface { speed: 1.0, at: -2.0, shape }],
        keep: Keep::Every(1),
        ..Transient::new(point(), Inputs::default(), 2.5, STEP)
    };
    let grid = GridSpec::Uniform { dx: 0.02, domain: (-4.0, 2.0) };
    let march = solve(grid, &march, &()).unwrap();
    let state = &march.states[step];
    let near = march.x.iter().zip(&state.film).filter(|(x, _)| x.abs() < 1.3);
    let points: Vec<String> =
        near.map(|(x, h)| format!("({}, {})", x * a * 1e6 + displaced, h * height * 1e9)).collect();
    (points.join(", "), (-2.0 + state.time) * a * 1e6)
}

fn scene(passing: &str, films: &str) -> Result<Scene, String> {
    let a = point().hertz().half_width_m;
    let text = format!(
        "Scene(version: 1, title: \"dent\", at: Si(radius: 0.01, speed: 2.5, load: 2e5, modulus: 231e9, viscosity: 0.01, alpha: 2e-8),
            grid: Uniform(dx: 0.02, domain: (-4.0, 2.0)), study: MeasuredFilm(between: (-{0:e}, {0:e}), {passing} films: [{films}]))",
        1.2 * a
    );
    Scene::from_ron(&text).map_err(|error| error.to_string())
}

fn passing(reading: f64) -> String {
    let radius = 0.4 * point().hertz().half_width_m;
    format!(
        "passing: (surfaces: [(shape: Dent(depth: {DEPTH:e}, radius: {radius:e}, at: -2.0))], time_step: {STEP}, reading: {reading}),"
    )
}

#[test]
fn films_are_compared_at_the_time_of_their_feature() {
    let (first, second) = (film(30, 2.0), film(45, 0.0));
    let films = format!(
        "(name: \"early\", from: \"\", at: {}, points: [{}]), (name: \"late\", from: \"\", at: {}, points: [{}])",
        first.1, first.0, second.1, second.0
    );
    let run = |reading: f64| {
        let scene = scene(&passing(reading), &films).unwrap();
        run_scene(&scene, &mut Workbench::new(""), &()).unwrap()
    };
    let outcome = run(4.0);
    let value = |name: &str| outcome.found.values.iter().find(|value| value.name == name).unwrap().value;
    assert!((value("early.moved_um") + 2.0).abs() < 0.11, "{}", value("early.moved_um"));
    assert!(value("late.moved_um").abs() < 0.11 && value("late.deviation_max") < 1e-5);
    assert!(value("early.deviation_max") < 2e-3 && value("early.minimum").abs() < 1e-3);
    // Without reading uncertainty, the displaced film differs at the flanks of the dent.
    let outcome = run(0.0);
    let value = |name: &str| outcome.found.values.iter().find(|value| value.name == name).unwrap().value;
    assert!(value("early.moved_um") == 0.0 && value("early.deviation_max") > 0.01);
}

#[test]
fn films_without_a_place_are_refused() {
    let film = |at: &str| format!("(name: \"film\", from: \"\", {at} points: [(-10.0, 300.0), (10.0, 300.0)])");
    let told = scene(&passing(0.0), &film("")).unwrap_err();
    assert!(told.contains("position of the feature"), "{told}");
    let told = scene("", &film("at: 0.0,")).unwrap_err();
    assert!(told.contains("must be left out without `passing`"), "{told}");
    assert!(scene(&passing(-1.0), &film("at: 0.0,")).unwrap_err().contains("reading"));
}
