//! Features of the surfaces, amplitude curve and circular contacts in the Transient tab, without a display.

use crate::common::scratch::Scratch;
use crate::driver::{
    Table, Window, choose, click, export, export_plot, give_path, press, rest_in_time, run_in_time, set, shows, time,
    undo, wait,
};
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use ehl_explorer::app::Explorer;
use ehl_explorer::scene::study::transient::SurfaceShape;
use ehl_explorer::scene::{Scene, Study};
use ehl_explorer::solver::full::transient::Scheme;

/// A line contact at rest on a coarse grid, so that a run takes about half a second.
const LINE: &str = "Scene(version: 1, title: \"features\", at: Moes(m: 20.0, l: 5.0), srr: 0.2,
    grid: Uniform(dx: 0.02, domain: (-4.0, 2.0)), study: Transient(duration: 1.0, time_step: Fixed(0.05)))";

/// A circular contact on a coarse grid.
const BALL: &str = "Scene(version: 1, title: \"ball\", contact: Point, at: Moes(m: 20.0, l: 6.0),
    grid: Plane(dx: 0.08, dy: 0.1, domain: (-3.0, 2.0, -2.0)),
    study: Transient(inputs: (load: Harmonic(amplitude: 0.1, period: 1.0)), duration: 1.0, time_step: Fixed(0.05)))";

/// Opens the Transient tab on a scene.
fn open(name: &str, text: &str) -> (Window, Scratch) {
    let folder = Scratch::new(name);
    let path = folder.write("scene.ron", text);
    let mut explorer = Explorer::new(None).without_system_dialogs();
    explorer.open_scene(&path).unwrap();
    let mut harness = crate::driver::window(explorer, [1280.0, 1000.0]);
    wait(&mut harness, "the first picture", |app| app.central_film().is_some() && !app.busy());
    click(&mut harness, "Transient");
    (harness, folder)
}

fn saved(harness: &mut Window, folder: &Scratch) -> ehl_explorer::scene::TransientStudy {
    press(harness, Modifiers::COMMAND, Key::S);
    let Study::Transient(study) = Scene::read(&folder.join("scene.ron")).unwrap().study else { panic!() };
    study
}

#[test]
fn a_feature_is_picked_dragged_refused_undone_and_passes_the_contact() {
    let (mut harness, folder) = open("feature", LINE);
    rest_in_time(&mut harness);
    click(&mut harness, "Moving surfaces");
    click(&mut harness, "Dent");
    assert!(shows(&harness, "Depth d") && shows(&harness, "body 1 at"));
    // SRR 0.2: body 1 moves with nine tenths of the mean speed.
    assert!(shows(&harness, "0.9"));
    rest_in_time(&mut harness);
    assert!(harness.state().in_time().0, "the run belongs to the dent");
    let map = export(&mut harness, "Transient", "Series as CSV…", &folder.join("series.csv"));
    assert!(map.contains("dent of ") && map.contains("speed 0.900 u_m"), "{}", &map[..400]);
    let film = Table::of(&map).column("full.fixed.H_c");
    let high = film.iter().copied().fold(0.0, f64::max);
    assert!(high > 1.1 * film[0], "the dent passes: {} {high}", film[0]);
    let plot = export_plot(&mut harness, "Transient", "Film at this moment", &folder.join("film.svg"));
    assert!(plot.contains("Undeformed feature"), "drawn below the film");

    // The solver's sentence stands next to the entry, and the entry returns.
    let depth = |harness: &Window| harness.get_by_role_and_label(Role::SpinButton, "Depth d").value().unwrap();
    let before = depth(&harness);
    set(&mut harness, Role::SpinButton, "Depth d", 1e4);
    assert!(shows(&harness, "at most the flattening of the Hertzian contact") && depth(&harness) == before);
    set(&mut harness, Role::SpinButton, "Step ΔT", 0.9);
    assert!(shows(&harness, "moves a feature") || shows(&harness, "equal to its spacing"));
    choose(&mut harness, "Shape", "Wave packet");
    assert!(shows(&harness, "Width W"));
    choose(&mut harness, "Body", "Body 2");
    assert!(shows(&harness, "body 2 at"));
    set(&mut harness, Role::Slider, "Feature start", -2.0);
    let study = saved(&mut harness, &folder);
    assert_eq!((study.surfaces.len(), study.surfaces[0].body, study.scheme), (1, 2, Scheme::Characteristic));
    assert!(matches!(study.surfaces[0].shape, SurfaceShape::Venner { at: -2.0, .. }), "{study:?}");
    undo(&mut harness);
    let study = saved(&mut harness, &folder);
    assert!(matches!(study.surfaces[0].shape, SurfaceShape::Venner { at: -2.5, .. }), "{study:?}");

    // Models are refused as long as there are features.
    click(&mut harness, "Set-up");
    click(&mut harness, "Reduced model");
    assert!(shows(&harness, "needs the full solver"));
    click(&mut harness, "Moving surfaces");
    click(&mut harness, "Remove");
    assert!(!shows(&harness, "body 2 at") && shows(&harness, "Add a feature"));
}

#[test]
fn profiles_are_read_from_tables() {
    let (mut harness, folder) = open("profile", LINE);
    let table = folder.join("profile.csv");
    std::fs::write(&table, "x,height\n0,1e-7\n-1e-5,0\n").unwrap();
    click(&mut harness, "Moving surfaces");
    click(&mut harness, "Profile from CSV…");
    give_path(&mut harness, &table, "Read");
    assert!(shows(&harness, "must be greater than the previous"));
    let width = 5e-5;
    std::fs::write(&table, format!("x,height\n{:e},0\n0,5e-8\n{width:e},0\n", -width)).unwrap();
    click(&mut harness, "Read");
    assert!(shows(&harness, "3 points"));
    let study = saved(&mut harness, &folder);
    let SurfaceShape::Sampled { places, heights, at } = &study.surfaces[0].shape else { panic!("{study:?}") };
    assert_eq!((places.as_slice(), heights.as_slice(), *at), (&[-width, 0.0, width][..], &[0.0, 5e-8, 0.0][..], -2.5));
    run_in_time(&mut harness);
    assert!(harness.state().transient_moments() > 100);
}

#[test]
fn the_amplitude_curve_follows_the_contact() {
    let (mut harness, folder) = open("amplitude", LINE);
    click(&mut harness, "Amplitude curve");
    let there = |harness: &mut Window| {
        crate::driver::wait_until(std::time::Duration::from_secs(120), harness, "the curve", |harness| {
            harness.state().has_amplitude_curve()
        });
    };
    there(&mut harness);
    assert!(shows(&harness, "Venner and others 1997") && shows(&harness, "moves with 0.900"));
    let curve = |harness: &mut Window, name: &str| {
        Table::of(&export(harness, "Transient", "Amplitude curve as CSV…", &folder.join(name)))
    };
    let first = curve(&mut harness, "first.csv");
    let (nabla, amplitude) = (first.column("nabla"), first.column("amplitude"));
    assert!(nabla.len() == 10 && nabla.is_sorted() && amplitude[0] > 0.7 && amplitude[9] < 0.2, "{amplitude:?}");
    let lambda = first.column("wavelength");
    assert!((nabla[3] / (lambda[3] * 20f64.powf(0.75) / 5f64.sqrt()) - 1.0).abs() < 1e-9);

    harness.get_by_label("Load number M").set_value_accesskit(40.0);
    harness.run_steps(3);
    there(&mut harness);
    let second = curve(&mut harness, "second.csv");
    assert!(second.column("wavelength")[0] < lambda[0], "the same Ψ is a shorter wave");
    click(&mut harness, "Body 2");
    there(&mut harness);
    assert!(shows(&harness, "moves with 1.10"));
    click(&mut harness, "Amplitude curve");
    assert!(shows(&harness, "Set-up"));
}

#[test]
fn circular_contacts_run_play_and_are_saved() {
    let (mut harness, folder) = open("ball", BALL);
    assert!(shows(&harness, "Run transient") && !shows(&harness, "line contact"));
    run_in_time(&mut harness);
    assert_eq!(harness.state().transient_moments(), 21);
    assert!(shows(&harness, "Contact at this moment") && shows(&harness, "Film map"));
    let series = Table::of(&export(&mut harness, "Transient", "Series as CSV…", &folder.join("series.csv")));
    let (p_c, load) = (series.column("full.fixed.P_c"), series.column("full.fixed.load"));
    let hertz = load.iter().zip(&p_c).map(|(w, p)| (p / p_c[0] / w.cbrt() - 1.0).abs()).fold(0.0, f64::max);
    assert!(hertz < 0.03, "P_c follows Hertz: {hertz}");
    let profiles = Table::of(&export(&mut harness, "Transient", "Profiles as CSV…", &folder.join("profiles.csv")));
    let (x, p) = (profiles.column("full.fixed.X"), profiles.column("full.fixed.P"));
    let centre = (0..x.len()).min_by(|a, b| x[*a].abs().total_cmp(&x[*b].abs())).unwrap();
    assert!((p[centre] / p_c[20] - 1.0).abs() < 1e-2, "the profile is that of the axis");
    for map in ["Pressure map", "Interferogram", "Axis over time", "Film map"] {
        click(&mut harness, map);
    }
    let drawing = export_plot(&mut harness, "Transient", "Contact at this moment", &folder.join("map.svg"));
    assert!(drawing.contains("href=\"data:image/png;base64,"));
    click(&mut harness, "Play");
    wait(&mut harness, "the player", |app| !app.marching());
    assert!(time(&harness) < 1.0);
    click(&mut harness, "Pause");

    // What point contacts do not have is not offered.
    click(&mut harness, "Set-up");
    assert!(harness.query_by_label("Radius").is_none() && !shows(&harness, "Moving nodes (ALE)"));
    set(&mut harness, Role::SpinButton, "Load A", 0.2);
    let study = saved(&mut harness, &folder);
    assert!(format!("{:?}", study.inputs.load).contains("0.2"));
    click(&mut harness, "TPWL");
    assert!(shows(&harness, "has no linearised model yet"));
    // A linearised model of a circular contact needs the basis of a reduced one.
    click(&mut harness, "Linearise this run");
    let study = saved(&mut harness, &folder);
    assert!(study.linearised.is_some() && study.reduced.is_some_and(|reduced| reduced.is_embedded()));
    click(&mut harness, "Ellipse");
    assert!(shows(&harness, "covers line and circular contacts only"));
    click(&mut harness, "Show a line contact");
    assert!(!shows(&harness, "covers line and circular contacts only"));
}

#[test]
fn a_run_is_exported_as_an_animation() {
    let (mut harness, folder) = open("animation", BALL);
    run_in_time(&mut harness);
    click(&mut harness, "Export from Transient");
    click(&mut harness, "Animation as APNG…");
    wait(&mut harness, "the animation", |app| !app.animating());
    let path = folder.join("ball.png");
    give_path(&mut harness, &path, "Export");
    let file = std::fs::read(&path).unwrap();
    let reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
    let (info, control) = (reader.info(), reader.info().animation_control().unwrap());
    assert_eq!((info.width, info.height, control.num_frames), (960, 540, 21));
}
