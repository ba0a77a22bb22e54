//! Fits of lubricant constants to synthetic measurements.

use ehl_explorer::engine::Workbench;
use ehl_explorer::scene::study::fit::{Fit, FitParameter};
use ehl_explorer::scene::{CaseTable, Method, Request, Scene, Study, answer_or_full, run_scene};
use fastrand::Rng;
use std::f64::consts::TAU;

const ALPHA: f64 = 2e-8;
const EYRING: f64 = 5e6;
const NOISE: f64 = 0.02;
const VALUES: usize = 12;
const RUNS: u64 = 100;

const CONTACT: &str = "Scene(version: 1, title: \"t\", lubricant: (viscosity: Roelands, density: DowsonHigginson, \
    limiting_stress: (ambient: 5e6, slope: 0.05, eyring: 5e6)), at: Si(radius: 0.01, speed: 1.0, load: 1e5, modulus: \
    231e9, viscosity: 0.02, alpha: 2e-8), study: Point(methods: [Full]))";

fn contact() -> Scene {
    Scene::from_ron(CONTACT).unwrap()
}

/// Returns speed and central film thickness, and slide-to-roll ratio and friction coefficient, by the reduced model.
fn exact() -> [Vec<[f64; 2]>; 2] {
    let request = Request { method: Method::EMBEDDED, ..contact().experiment().request().unwrap() };
    let mut bench = Workbench::new("");
    let mut solve = |speed: f64, srr: f64, name: &str| {
        let mut request = request.clone();
        request.point.speed_m_per_s = speed;
        request.point.sliding.slide_to_roll_ratio = srr;
        answer_or_full(&mut bench, &request, &()).unwrap().result.value(name).unwrap()
    };
    let along = |from: f64, to: f64| (0..VALUES).map(move |k| from * (to / from).powf(k as f64 / (VALUES - 1) as f64));
    let film = along(0.3, 4.0).map(|speed| [speed, solve(speed, 0.0, "h_c_m")]).collect();
    let friction = along(0.002, 0.2).map(|srr| [srr, solve(1.0, srr, "traction").abs()]).collect();
    [film, friction]
}

fn normal(rng: &mut Rng) -> f64 {
    (-2.0 * (1.0 - rng.f64()).ln()).sqrt() * (TAU * rng.f64()).cos()
}

fn table(titles: &str, values: &[[f64; 2]], rng: &mut Rng) -> CaseTable {
    let line = |[x, y]: &[f64; 2]| format!("{x:e},{:e}\n", y * (1.0 + NOISE * normal(rng)));
    CaseTable::Text(std::iter::once(format!("{titles}\n")).chain(values.iter().map(line)).collect())
}

fn fitted(bench: &mut Workbench, measured: Vec<CaseTable>, parameters: Vec<FitParameter>) -> Result<Vec<f64>, String> {
    let names: Vec<&str> = parameters.iter().map(|parameter| parameter.name()).collect();
    let study = Study::Fit(Fit { measured, parameters, method: Method::EMBEDDED });
    let outcome = run_scene(&Scene { study, ..contact() }, bench, &()).map_err(|error| error.to_string())?;
    let value = |name: String| outcome.found.values.iter().find(|value| value.name == name).unwrap().value;
    Ok(names.iter().flat_map(|name| ["", "_low", "_high"].map(|end| value(format!("{name}{end}")))).collect())
}

#[test]
fn constants_come_back_from_noise_within_their_intervals() {
    let [film, friction] = exact();
    let mut bench = Workbench::new("");
    let (mut near, mut covered) = ([0; 2], [0; 2]);
    for seed in 0..RUNS {
        let mut rng = Rng::with_seed(seed);
        let measured = vec![table("speed,film", &film, &mut rng), table("srr,friction", &friction, &mut rng)];
        let found = fitted(&mut bench, measured, vec![FitParameter::Alpha, FitParameter::EyringStress]).unwrap();
        for (k, (of, exact)) in found.chunks(3).zip([ALPHA, EYRING]).enumerate() {
            near[k] += usize::from((of[0] / exact - 1.0).abs() < 0.03);
            covered[k] += usize::from((of[1]..=of[2]).contains(&exact));
        }
    }
    assert!(
        near.iter().chain(&covered).all(|count| *count >= 90),
        "within 3 %: {near:?}, in the interval: {covered:?}"
    );
}

#[test]
fn a_fit_without_noise_returns_the_constants() {
    let [film, friction] = exact();
    let plain = |titles: &str, values: &[[f64; 2]]| {
        let lines = values.iter().map(|[x, y]| format!("{x:e};{y:e}\n"));
        CaseTable::Text(std::iter::once(format!("{titles}\n")).chain(lines).collect())
    };
    let measured = vec![plain("speed;film", &film), plain("srr;friction", &friction)];
    let found =
        fitted(&mut Workbench::new(""), measured, vec![FitParameter::EyringStress, FitParameter::Alpha]).unwrap();
    assert!((found[0] / EYRING - 1.0).abs() < 1e-5 && (found[3] / ALPHA - 1.0).abs() < 1e-5, "{found:?}");
}

#[test]
fn what_a_table_cannot_determine_is_refused() {
    let [film, _] = exact();
    let mut rng = Rng::with_seed(1);
    let refused =
        |text: CaseTable, parameter| fitted(&mut Workbench::new(""), vec![text], vec![parameter]).unwrap_err();
    let films = table("speed,film", &film, &mut rng);
    assert!(refused(films.clone(), FitParameter::EyringStress).contains("do not determine τ_E"));
    let hole = CaseTable::Text("speed,film [nm]\n1,200\n2,\n".to_owned());
    assert!(refused(hole, FitParameter::Alpha).contains("line 3: `film [nm]` is missing"));
    let few = CaseTable::Text("speed,film [nm]\n1,200\n2,300\n".to_owned());
    assert!(refused(few, FitParameter::Alpha).contains("needs at least 4"));
}
