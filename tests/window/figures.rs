//! Export of figures and data, the same in every tab: drawn for paper, with the numbers of the table, in the requested
//! units, on axes that may be fixed.

use crate::common::scratch::Scratch;
use crate::driver::{
    TABS, Table, Window, click, export, export_plot, give_path, press, set, shows, wait, wait_until, window, write,
};
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use ehl_explorer::app::Explorer;
use ehl_explorer::engine::{Workbench, embedded, run_scene};
use ehl_explorer::scene::{Grid, Scene};
use std::path::Path;
use std::time::{Duration, Instant};

fn open() -> Window {
    let explorer = Explorer::new(Some(embedded("line").unwrap()));
    let mut harness = window(explorer.without_system_dialogs(), [1280.0, 800.0]);
    wait(&mut harness, "the picture and its check", |app| app.central_film().is_some() && !app.busy());
    harness
}

/// Opens the window of figures for a plot of a tab.
fn figure(harness: &mut Window, tab: &str) {
    click(harness, &format!("Export from {tab}"));
    click(harness, "Figure…");
    assert!(shows(harness, "Export a figure") && !shows(harness, "No plot is on the screen"));
}

fn attribute<'a>(line: &'a str, name: &str) -> &'a str {
    let (_, rest) = line.split_once(&format!(" {name}=\"")).unwrap();
    rest.split_once('"').unwrap().0
}

/// Returns positions of the numbers of an axis on paper, and their values.
fn ticks(svg: &str, class: &str) -> Vec<(f64, f64)> {
    let of_class = svg.lines().filter(|line| line.contains(&format!("class=\"{class}\"")));
    let words = |line: &str| line.split_once('>').unwrap().1.split_once('<').unwrap().0.replace('−', "-");
    let value = |line: &str| words(line).parse().unwrap();
    of_class.map(|line| (attribute(line, class).parse().unwrap(), value(line))).collect()
}

/// Returns the value at a position on paper, from the outermost numbers of its axis.
fn value(ticks: &[(f64, f64)], at: f64) -> f64 {
    let (first, last) = (ticks[0], ticks[ticks.len() - 1]);
    first.1 + (at - first.0) / (last.0 - first.0) * (last.1 - first.1)
}

/// Returns the curves of a drawing in the values of its axes. Grid lines have two points.
fn curves(svg: &str) -> Vec<Vec<[f64; 2]>> {
    let (x, y) = (ticks(svg, "x"), ticks(svg, "y"));
    // Numbers of the vertical axis are a little below their marks.
    let lowered = 0.35 * 8.0;
    let lines = svg.lines().filter(|line| line.starts_with("<polyline") && line.matches(',').count() > 2);
    let place = |pair: &str| pair.split_once(',').map(|(x, y)| (x.parse::<f64>().unwrap(), y.parse::<f64>().unwrap()));
    let point = |pair: &str| place(pair).map(|(across, up)| [value(&x, across), value(&y, up + lowered)]).unwrap();
    lines.map(|line| attribute(line, "points").split(' ').map(point).collect()).collect()
}

/// Returns the size of a PNG in pixels, and its pixels per metre.
fn size_of(file: &[u8]) -> (u32, u32, u32) {
    let word = |at: usize| u32::from_be_bytes(file[at..at + 4].try_into().unwrap());
    let physical = file.windows(4).position(|name| name == b"pHYs").unwrap();
    (word(16), word(20), word(physical + 4))
}

#[test]
fn every_tab_has_its_export_at_the_same_place() {
    let mut harness = open();
    let mut places = Vec::new();
    for tab in TABS {
        click(&mut harness, tab);
        let names = [format!("Export from {tab}"), format!("Lock the axes of {tab}"), "Units".to_owned()];
        places.push(names.map(|name| harness.get_by_label(&name).rect()));
        let switches = ["Profiles", "Contact map", "Reduced basis", "Transient", "TPWL"].contains(&tab);
        assert_eq!(
            !harness.get_by_label("Units").accesskit_node().is_disabled(),
            switches,
            "{tab}: it has units or has none"
        );
        let bar = harness.get_by_label(tab).rect();
        assert!(places.iter().flatten().all(|rect| rect.y_range().intersects(bar.y_range())), "{tab}: not in the bar");
    }
    assert!(places.iter().all(|place| *place == places[0]), "{places:?}");
}

#[test]
fn a_figure_is_drawn_for_paper_with_the_numbers_of_the_table() {
    let mut harness = open();
    for (width, pixels) in [(85.0, 1004), (170.0, 2008)] {
        let folder = Scratch::new(&format!("figures-{width}"));
        let leave = |harness: &mut Window, button: &str, path: &Path| {
            figure(harness, "Profiles");
            set(harness, Role::SpinButton, "Width in mm", width);
            set(harness, Role::SpinButton, "Height in mm", 65.0);
            set(harness, Role::SpinButton, "Resolution in dpi", 300.0);
            write(harness, "Title", "Pressure of a roller");
            harness.get_by_role_and_label(Role::Button, button).click();
            let asks = |harness: &Window| harness.query_by_label("Path of the file").is_some();
            wait_until(Duration::from_secs(60), harness, "the file", asks);
            give_path(harness, path, "Export");
            std::fs::read(path).unwrap()
        };
        let svg = String::from_utf8(leave(&mut harness, "SVG…", &folder.join("figure.svg"))).unwrap();
        assert!(svg.contains(&format!("width=\"{width}mm\" height=\"65mm\"")), "{}", &svg[..300]);
        assert!(
            svg.contains("fill=\"#ffffff\"") && svg.contains(">Pressure of a roller</text>"),
            "light, with its title"
        );
        for class in ["x title", "y title", "caption", "legend", "x", "y"] {
            assert!(svg.contains(&format!("class=\"{class}\"")), "{class}");
        }
        assert!(svg.contains("M 40.00, L 10.00") && svg.contains("Pa·s"), "the contact with units");
        let png = leave(&mut harness, "PNG…", &folder.join("figure.png"));
        let (across, down, per_metre) = size_of(&png);
        assert_eq!((across, per_metre), (pixels, 11811));
        assert_eq!(down, 768);
        // The same numbers in the drawing, in its table, and in the table of the profiles.
        let text = String::from_utf8(leave(&mut harness, "Data as CSV…", &folder.join("figure.csv"))).unwrap();
        let rows: Vec<[f64; 2]> = text
            .lines()
            .filter(|line| !line.starts_with('#'))
            .skip(1)
            .map(|line| line.rsplit(',').take(2).map(|cell| cell.parse().unwrap()).collect::<Vec<f64>>())
            .map(|cells| [cells[1], cells[0]])
            .collect();
        let drawn: Vec<[f64; 2]> = curves(&svg).concat();
        let profiles = Table::of(&export(&mut harness, "Profiles", "Profiles as CSV…", &folder.join("profiles.csv")));
        for (x, p) in profiles.column("X").into_iter().zip(profiles.column("P")) {
            assert!(rows.iter().any(|row| (row[0] - x).abs() < 1e-12 && (row[1] - p).abs() < 1e-12), "{x}, {p}");
        }
        assert!(drawn.len() > profiles.rows.len(), "{} points for {} rows", drawn.len(), profiles.rows.len());
        for [x, p] in &drawn {
            let near = |row: &&[f64; 2]| (row[0] - x).abs() < 5e-3 && (row[1] - p).abs() < 5e-3;
            assert!(rows.iter().any(|row| near(&row)), "{x}, {p}");
        }
    }
}

#[test]
fn units_are_switched_for_all_plots_and_figures() {
    let mut harness = open();
    let folder = Scratch::new("units");
    let plain = export_plot(&mut harness, "Profiles", "Film profile", &folder.join("plain.svg"));
    assert!(plain.contains(">X<") || plain.contains(">X</tspan>"), "ratios at first");
    press(&mut harness, Modifiers::NONE, Key::F7);
    let path = folder.join("si.svg");
    let si = export_plot(&mut harness, "Profiles", "Film profile", &path);
    assert!(si.contains(" / µm") && si.contains(" / mm"), "units of both axes");
    let profiles = Table::of(&export(&mut harness, "Profiles", "Profiles as CSV…", &folder.join("profiles.csv")));
    let (x, h) = (profiles.column("x_m"), profiles.column("h_m"));
    // The centre of the contact in both.
    let k = (0..x.len()).min_by(|a, b| x[*a].abs().total_cmp(&x[*b].abs())).unwrap();
    let all = curves(&si).concat();
    let near = all.iter().min_by(|a, b| (a[0] - 1e3 * x[k]).abs().total_cmp(&(b[0] - 1e3 * x[k]).abs())).unwrap();
    assert!((near[1] / (1e6 * h[k]) - 1.0).abs() < 2e-2, "{near:?} and {}", 1e6 * h[k]);
}

#[test]
fn locked_axes_stand_still_while_the_load_runs_from_2_to_500() {
    let mut harness = open();
    let folder = Scratch::new("lock");
    let axes = |harness: &mut Window, m: f64| {
        set(harness, Role::Slider, "Load number M", m);
        wait(harness, "the picture", |app| app.central_film().is_some() && !app.busy());
        let path = folder.join("film.svg");
        let svg = export_plot(harness, "Profiles", "Film profile", &path);
        std::fs::remove_file(&path).unwrap();
        (ticks(&svg, "x"), ticks(&svg, "y"))
    };
    let first = axes(&mut harness, 20.0);
    click(&mut harness, "Lock the axes of Profiles");
    for m in [2.0, 60.0, 500.0] {
        assert_eq!(axes(&mut harness, m), first, "M {m}");
    }
    // Axes in SI units are fixed as well, though their scales depend on the load.
    press(&mut harness, Modifiers::NONE, Key::F7);
    let second = axes(&mut harness, 20.0);
    assert_eq!(axes(&mut harness, 500.0), second);
    click(&mut harness, "Lock the axes of Profiles");
    assert_ne!(axes(&mut harness, 2.0), second, "let go they fit again");
}

#[test]
fn figure_of_all_plots_has_one_caption() {
    let mut harness = open();
    click(&mut harness, "Reduced basis");
    let folder = Scratch::new("all");
    let svg = export_plot(&mut harness, "Reduced basis", "All plots of Reduced basis", &folder.join("all.svg"));
    for name in ["Mode shapes", "Singular values"] {
        assert!(svg.contains(&format!(">{name}</text>")), "{name}");
    }
    figure(&mut harness, "Reduced basis");
    harness.get_by_role_and_label(Role::Button, "Copy").click();
    let copied = |command: &egui::OutputCommand| match command {
        egui::OutputCommand::CopyImage(image) => image.size[0] > 500,
        _ => false,
    };
    let copied = |harness: &Window| harness.output().platform_output.commands.iter().any(copied);
    let begin = Instant::now();
    while !copied(&harness) {
        assert!(begin.elapsed() < Duration::from_secs(60), "an image on the clipboard");
        std::thread::sleep(Duration::from_millis(5));
        harness.step();
    }
    harness.run_steps(2);
    click(&mut harness, "Cancel");
    assert!(!shows(&harness, "Export a figure"));
}

#[test]
fn a_report_leaves_with_the_numbers_of_a_headless_solve() {
    let mut harness = open();
    let folder = Scratch::new("report");
    for (item, name) in [("Report as PDF…", "report.pdf"), ("Report as HTML…", "report.html")] {
        click(&mut harness, "Export from Profiles");
        click(&mut harness, item);
        let asks = |harness: &Window| harness.query_by_label("Path of the file").is_some();
        wait_until(Duration::from_secs(60), &mut harness, "the report", asks);
        give_path(&mut harness, &folder.join(name), "Export");
    }
    let text = "Scene(version: 1, title: \"t\", at: Moes(m: 40.0, l: 10.0), study: Point(methods: [Full]))";
    let scene = Scene { grid: Grid::Graded, ..Scene::from_ron(text).unwrap() };
    let outcome = run_scene(&scene, &mut Workbench::new(""), &()).unwrap();
    let headless = outcome.found.values.iter().find(|value| value.name == "h_c_m").unwrap().value;
    let page = std::fs::read_to_string(folder.join("report.html")).unwrap();
    let film = format!("{:.4}", 1e6 * headless);
    assert!(page.contains(&format!("{} µm", film.trim_end_matches('0'))), "{headless}");
    for part in ["Full solution", "Reduced model", "reduced against full", "Stress below the surface of body 1"] {
        assert!(page.contains(part), "{part}");
    }
    assert_eq!(page.matches("<svg ").count(), 3, "pressure, film thickness and stress");
    assert!(std::fs::read(folder.join("report.pdf")).unwrap().starts_with(b"%PDF-"));
}

#[test]
fn formulas_and_bases_leave_for_other_programs() {
    let mut harness = open();
    let folder = Scratch::new("arrays");
    click(&mut harness, "Regimes");
    let formulas = export(&mut harness, "Regimes", "Formulas as CSV…", &folder.join("formulas.csv"));
    assert!(formulas.contains("name,film_m,own_film_m,deviation,in_range,remark") && formulas.contains("Moes"));
    click(&mut harness, "Reduced basis");
    click(&mut harness, "Export from Reduced basis");
    click(&mut harness, "Model as npz…");
    let path = folder.join("model.npz");
    give_path(&mut harness, &path, "Export");
    let archive = std::fs::read(&path).unwrap();
    assert!(archive.starts_with(b"PK\x03\x04"));
    for name in ["window_1_pressure_modes.npy", "window_1_sampled_nodes.npy", "window_1_snapshots.npy"] {
        assert!(archive.windows(name.len()).any(|bytes| bytes == name.as_bytes()), "{name}");
    }
}
