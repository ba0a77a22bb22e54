//! Point contacts in the window: selection, map, cuts, grids, interferogram.

use crate::common::scratch::Scratch;
use crate::driver::{
    Window, assert_cheap, caption, choose, click, drag_line, export, export_plot, give_path, rest, rest_in_time, shows,
    undo, wait,
};
use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use ehl_explorer::app::Explorer;
use std::path::Path;
use std::time::Duration;

fn open() -> Window {
    crate::driver::window(Explorer::new(None).without_system_dialogs(), [1280.0, 1500.0])
}

/// Waits for a full solution on this number of nodes.
fn solved(harness: &mut Window, nodes: (usize, usize)) {
    wait(harness, "the chosen grid", |app| {
        app.nodes() == Some(nodes) && app.central_film().is_some() && !app.busy() && app.badge() != "Quick grid"
    });
    harness.run();
}

/// A window on the point contact of the first look, solved on an equidistant grid of so many nodes.
fn point_on(nodes: (usize, usize)) -> Window {
    let spacing = |length: f64, nodes: usize| length / (nodes as f64 - 1.0);
    let scene = format!(
        "Scene(version: 1, title: \"A ball\", contact: Point, at: Moes(m: 40.0, l: 10.0), study: Point(methods: [Full]),
            grid: Plane(dx: {}, dy: {}, domain: (-4.0, 2.0, -2.0)))",
        spacing(6.0, nodes.0),
        spacing(2.0, nodes.1)
    );
    let folder = Scratch::new("a-ball");
    let mut explorer = Explorer::new(None).without_system_dialogs();
    explorer.open_scene(&folder.write("ball.ron", &scene)).unwrap();
    let mut harness = crate::driver::window(explorer, [1280.0, 1500.0]);
    solved(&mut harness, nodes);
    harness
}

/// The same on the quick grid.
fn quick_point() -> Window {
    point_on((151, 41))
}

#[test]
fn the_switch_keeps_m_and_l_and_undo_brings_the_line_back() {
    let mut harness = open();
    let before = harness.state().moes();
    click(&mut harness, "Ball");
    assert!(harness.state().is_point());
    let after = harness.state().moes();
    assert!((after.m / before.m - 1.0).abs() < 1e-9 && (after.l / before.l - 1.0).abs() < 1e-9);
    // The quick grid is used first, the graded one when the sliders are idle.
    wait(&mut harness, "the first picture", |app| app.central_film().is_some());
    assert_eq!(harness.state().nodes(), Some((151, 41)));
    assert_eq!(harness.state().badge(), "Quick grid");
    let detail = harness.state().badge_detail();
    assert!(detail.starts_with("sketch on a quick grid, error of {H_c} about "), "{detail}");
    solved(&mut harness, (301, 59));
    assert_eq!(harness.state().badge(), "Verified");
    let load = harness.get_by_role_and_label(Role::TextInput, "Load w").accesskit_node().value();
    assert!(load.is_some_and(|w| w.parse::<f64>().is_ok_and(|w| (1.0..10.0).contains(&w))), "in newtons");
    undo(&mut harness);
    wait(&mut harness, "the line contact", |app| !app.is_point() && app.central_film().is_some() && !app.busy());
    assert_eq!(harness.state().nodes().map(|n| n.1), Some(1));
}

#[test]
fn line_contact_shows_film_over_time_and_offers_a_ball() {
    let mut harness = open();
    wait(&mut harness, "the first picture", |app| app.central_film().is_some() && !app.busy());
    click(&mut harness, "Contact map");
    rest_in_time(&mut harness);
    assert!(shows(&harness, "Film over space and time"));
    click(&mut harness, "Pressure over time");
    assert!(shows(&harness, "Pressure over space and time"));
    let map = harness.get_by_label("Pressure over space and time").rect();
    assert!(map.width() > 400.0 && map.height() > 400.0);
    click(&mut harness, "Show a circular contact");
    assert!(harness.state().is_point());
    wait(&mut harness, "the ball", |app| app.central_film().is_some());
    assert!(shows(&harness, "Map of the contact"));
    click(&mut harness, "Transient");
    assert!(shows(&harness, "Run transient") && !shows(&harness, "Film over space and time"));
    click(&mut harness, "TPWL");
    wait(&mut harness, "the ball in time", |app| app.in_time() == (true, 1, 1));
    assert!(shows(&harness, "Press Run transient"), "the roller's linearised model is not that of a ball");
    click(&mut harness, "Ellipse");
    click(&mut harness, "Show a line contact");
    click(&mut harness, "Transient");
    assert!(!harness.state().is_point() && shows(&harness, "Load amplitude"));
}

#[test]
fn map_shows_fields_and_fringes_with_cuts() {
    let mut harness = point_on((101, 21));
    let (along, across) = harness.state().profile_peaks().unwrap();
    assert!(along > 0.9 && across.is_some_and(|p| p > 0.9));
    click(&mut harness, "Contact map");
    let said = harness.get_by_label("Map of the contact").accesskit_node().description().unwrap_or_default();
    assert!(said.starts_with("Film map of M") && said.contains("minimum"), "{said}");
    for name in ["Pressure map", "Contours", "Interferogram", "Monochromatic", "Three colours", "Film map"] {
        click(&mut harness, name);
    }
    let map = harness.get_by_label("Map of the contact").rect();
    assert_eq!(harness.state().cuts(), (0.0, 0.0));
    harness.get_by_label("Cut across at X").set_value_accesskit(0.9);
    harness.run();
    let (_, moved) = harness.state().profile_peaks().unwrap();
    assert_eq!(harness.state().cuts().0, 0.9);
    assert!(moved.unwrap() < 0.8 * across.unwrap(), "the profile across lies near the edge of the contact now");
    harness.get_by_label("Cut along at Y").set_value_accesskit(0.5);
    harness.run();
    assert!(harness.state().profile_peaks().unwrap().0 < along);
    assert!(map.width() > 300.0 && map.height() > 300.0);
    click(&mut harness, "Profiles");
}

#[test]
fn cuts_are_dragged_by_the_hand_in_the_map_and_in_the_profiles() {
    let mut harness = point_on((101, 21));
    // The profile across fills the right part of the window; its line is where the profile along lies.
    drag_line(&mut harness, (960.0, 1270.0), 250.0, 60.0);
    let (x, y) = harness.state().cuts();
    assert!(x == 0.0 && y > 0.15, "{x} {y}");
    click(&mut harness, "Contact map");
    let map = harness.get_by_label("Map of the contact").rect();
    drag_line(&mut harness, (map.left(), map.right()), map.top() + 0.8 * map.height(), 60.0);
    let (moved, same) = harness.state().cuts();
    assert!(moved > 0.15 && same == y, "{moved} {same}");
}

#[test]
fn grids_are_chosen_estimated_and_taken_back() {
    let mut harness = open();
    click(&mut harness, "Ball");
    choose(&mut harness, "Nodes", "Quick, 151×41");
    solved(&mut harness, (151, 41));
    let coarse = harness.state().central_film().unwrap();
    click(&mut harness, "Estimate grid error");
    wait(&mut harness, "the estimate", |app| app.grid_errors().is_some());
    let (h_c, h_min) = harness.state().grid_errors().unwrap();
    assert!((1e-3..0.1).contains(&h_c) && (1e-3..0.5).contains(&h_min), "{h_c} {h_min}");
    choose(&mut harness, "Nodes", "Dissertation, 301×41");
    solved(&mut harness, (301, 41));
    assert!(harness.state().grid_errors().is_none(), "the estimate belonged to the other grid");
    let fine = harness.state().central_film().unwrap();
    // Half the spacing ΔX removes three quarters of the error in X.
    assert!((fine / coarse - 1.0).abs() < 1.2 * h_c && fine > coarse, "{coarse} {fine} {h_c}");
    undo(&mut harness);
    solved(&mut harness, (151, 41));
}

#[test]
fn unresolved_side_lobes_are_reported() {
    let mut harness = quick_point();
    harness.get_by_label("Load number M").set_value_accesskit(700.0);
    harness.run();
    solved(&mut harness, (151, 41));
    assert_eq!(harness.state().badge(), "Grid insufficient");
    assert!(harness.query_by_label_contains("H_min is not resolved").is_some());
}

#[test]
fn lightly_loaded_ball_uses_its_model_and_reports_its_domain() {
    // While the model is being read, pictures are full solutions on another grid, which do not measure the model.
    let explorer = Explorer::with_embedded_models().without_system_dialogs();
    let mut harness = crate::driver::window(explorer, [1280.0, 1500.0]);
    click(&mut harness, "Ball");
    for (name, value) in [("Lubricant number L", 5.0), ("Load number M", 7.8)] {
        // Repaints continue while the model is being read.
        harness.get_by_label(name).set_value_accesskit(value);
        harness.run_steps(2);
    }
    let of_model = |app: &Explorer| app.nodes() == Some((364, 51)) && !app.busy();
    let known = ["Verified", "Roughly right"];
    wait(&mut harness, "its true errors", |app| of_model(app) && known.contains(&app.badge().as_str()));
    let film = harness.state().central_film().unwrap();
    harness.get_by_label("Load number M").set_value_accesskit(3.5);
    harness.run_steps(2);
    wait(&mut harness, "those of a lighter one", |app| of_model(app) && app.badge() == "Grid insufficient");
    assert!(harness.state().central_film().unwrap() > 1.5 * film, "H counts in a²/R, and a is smaller");
    let detail = harness.state().badge_detail();
    assert!(detail.contains("discretisation error of"), "{detail}");
}

#[test]
fn the_scenes_of_point_contacts_open_with_their_own_grid() {
    let mut harness = open();
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/point/table_2_2.ron");
    harness.state_mut().open_scene(&scene).unwrap();
    solved(&mut harness, (301, 41));
    assert!((harness.state().moes().m - 192.4).abs() < 0.05);
    for (tab, text) in [
        ("Contact map", "Map of the contact"),
        ("Regimes", "Chart of M and L"),
        ("Reduced basis", "there is no basis to show"),
        ("Accuracy", "there is no model to validate"),
        ("Training", "Start training"),
        ("Profiles", "Pin curve"),
    ] {
        click(&mut harness, tab);
        assert!(shows(&harness, text), "{tab} lacks {text:?}");
    }
    let idle = rest(&mut harness);
    assert!(idle > Duration::from_secs(60), "repaint after {idle:?}");
}

#[test]
fn the_map_leaves_as_table_and_picture() {
    let mut harness = quick_point();
    click(&mut harness, "Contact map");
    let folder = Scratch::new("map");
    let table = export(&mut harness, "Contact map", "Map as CSV…", &folder.join("map.csv"));
    assert_eq!(table.lines().nth(2), Some("X,Y,P,H,x_m,y_m,p_pa,h_m"));
    let means = table.lines().nth(1).unwrap();
    assert!(means.starts_with("# full solution on 151×41 nodes; grid error H_c "), "{means}");
    assert_eq!(table.lines().count(), 3 + 151 * 81);
    let drawing = export_plot(&mut harness, "Contact map", "Map of the contact", &folder.join("map.svg"));
    assert!(drawing.starts_with("<svg") && drawing.contains("polyline") && drawing.trim_end().ends_with("</svg>"));
    assert!(
        drawing.contains("href=\"data:image/png;base64,") && caption(&drawing).contains("151×41 nodes"),
        "field and grid"
    );
    assert!(
        drawing.contains("class=\"scale title\"") && drawing.contains("class=\"scale\""),
        "the scale stands beside it"
    );
    click(&mut harness, "Export from Contact map");
    click(&mut harness, "Bare map as PNG…");
    give_path(&mut harness, &folder.join("map.png"), "Export");
    let picture = std::fs::read(folder.join("map.png")).unwrap();
    assert_eq!(&picture[1..4], b"PNG");
}

#[test]
fn a_frame_with_the_map_is_cheap() {
    let mut harness = quick_point();
    click(&mut harness, "Contact map");
    click(&mut harness, "Interferogram");
    // A new phase in every frame, so that the picture is computed again every time.
    assert_cheap(&mut harness, 40, 8.0, |harness, k| {
        harness.get_by_label("Phase").set_value_accesskit(f64::from(9 * k));
    });
}
