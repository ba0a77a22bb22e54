//! The embedded scenes in their window, and tables of load cases.

use crate::driver::{Window, click, press, shows, wait, wait_within, window};
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use ehl_explorer::app::Explorer;
use ehl_explorer::engine::{Workbench, run_scene};
use ehl_explorer::scene::{CaseTable, Scene, Study};
use std::path::Path;
use std::time::Duration;

fn fresh() -> Window {
    let mut harness = window(Explorer::with_embedded_models().without_system_dialogs(), [1280.0, 800.0]);
    harness.run_steps(3);
    harness
}

/// Opens the window of examples and selects a scene.
fn open_example(harness: &mut Window, search: &str, title: &str) {
    click(harness, "File");
    click(harness, "Examples…");
    let field = harness.get_by_role_and_label(Role::TextInput, "Search");
    assert!(field.is_focused(), "it is ready for typing");
    field.type_text(search);
    harness.run_steps(3);
    let card = format!("Open {title}");
    harness.get_by_role_and_label(Role::Button, &card).click();
    harness.run_steps(3);
}

#[test]
fn example_is_found_and_opens_on_its_tab() {
    let mut harness = fresh();
    click(&mut harness, "File");
    click(&mut harness, "Examples…");
    assert!(shows(&harness, "Line contacts") && shows(&harness, "Contacts in time") && shows(&harness, "Expects"));
    press(&mut harness, Modifiers::NONE, Key::Escape);
    assert!(!shows(&harness, "Contacts in time"), "Escape closes it");
    open_example(&mut harness, "table 2.1", "Rolling line contact, stationary");
    assert_eq!(harness.state().front(), Some("Profiles"));
    assert!(shows(&harness, "What are pressure and film thickness of this line contact"), "its question stands above");
    assert!((harness.state().moes().m - 40.0).abs() < 0.1);
    press(&mut harness, Modifiers::COMMAND, Key::S);
    assert!(shows(&harness, "Path of the file"), "it has no file: saving asks for one");
    press(&mut harness, Modifiers::NONE, Key::Escape);
    click(&mut harness, "Close the headline");
    assert!(!shows(&harness, "What are pressure and film thickness of this line contact"));
}

#[test]
fn examples_that_refer_to_others_run_without_their_folder() {
    let mut harness = fresh();
    open_example(&mut harness, "rollers_and_balls", "Ten load cases of bearings, gears, cams and rigs");
    assert_eq!(harness.state().front(), Some("Results"));
    wait_within(Duration::from_secs(240), &mut harness, "ten contacts", |app| app.verdict().is_some());
    assert_eq!(harness.state().verdict(), Some(true));
}

#[test]
fn load_cases_are_read_while_typed_and_solved() {
    let mut harness = fresh();
    click(&mut harness, "File");
    click(&mut harness, "Load cases…");
    click(&mut harness, "Ten bearings, gears and rigs");
    assert!(shows(&harness, "10 contacts can be solved, 0 lines are refused"));
    let field = harness.get_by_role_and_label(Role::MultilineTextInput, "Table of load cases");
    field.focus();
    harness.run_steps(2);
    press(&mut harness, Modifiers::COMMAND, Key::End);
    let field = harness.get_by_role_and_label(Role::MultilineTextInput, "Table of load cases");
    field.type_text("\ntoo thin;line;0");
    harness.run_steps(3);
    assert!(shows(&harness, "10 contacts can be solved, 1 lines are refused"));
    assert!(shows(&harness, "(too thin): "));
    // Two of the three balls, whose solutions take longest, are covered by the test above.
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/load_cases/rollers_and_balls.ron");
    let all = std::fs::read_to_string(path.with_extension("csv")).unwrap();
    let kept = all.lines().filter(|line| !line.starts_with("ball on ")).collect::<Vec<_>>().join("\n");
    press(&mut harness, Modifiers::COMMAND, Key::A);
    let field = harness.get_by_role_and_label(Role::MultilineTextInput, "Table of load cases");
    field.type_text(&format!("{kept}\ntoo thin;line;0"));
    harness.run_steps(3);
    assert!(shows(&harness, "8 contacts can be solved, 1 lines are refused"));
    click(&mut harness, "Solve all");
    assert_eq!(harness.state().front(), Some("Results"));
    wait(&mut harness, "all lines", |app| app.verdict().is_some());
    let shown = harness.state().result_table("load_cases").unwrap();
    let mut scene = Scene { lubricant: harness.state().lubricant(), ..Scene::read(&path).unwrap() };
    let Study::LoadCases(study) = &mut scene.study else { panic!("no load cases") };
    study.cases = CaseTable::Text(kept);
    let headless = run_scene(&scene, &mut Workbench::new(path.parent().unwrap()), &()).unwrap();
    let (lines, wanted) = (timeless(&shown), timeless(&headless.tables[0].to_csv()));
    assert_eq!(lines[..wanted.len()], wanted[..], "{shown}");
    assert!(lines.len() == wanted.len() + 1 && shown.lines().last().unwrap().contains("refused"), "{shown}");
}

#[test]
fn load_cases_with_heat_are_a_table_of_all_of_them() {
    // High enough for the complete panel.
    let mut harness = window(Explorer::with_embedded_models().without_system_dialogs(), [1280.0, 1900.0]);
    harness.run_steps(3);
    click(&mut harness, "Heat");
    assert!(harness.state().lubricant().heat.is_some());
    click(&mut harness, "File");
    click(&mut harness, "Load cases…");
    let field = harness.get_by_role_and_label(Role::MultilineTextInput, "Table of load cases");
    field.focus();
    harness.run_steps(2);
    let field = harness.get_by_role_and_label(Role::MultilineTextInput, "Table of load cases");
    field.type_text("name,speed,load,srr\nslow,1,2e5,0.1\nfast,4,2e5,0.3\nbackwards,-1,2e5,0.1");
    harness.run_steps(3);
    assert!(shows(&harness, "2 contacts can be solved, 1 lines are refused"));
    // The document has changed and stays: nothing is asked.
    click(&mut harness, "Solve all");
    wait(&mut harness, "all lines", |app| app.verdict().is_some());
    assert!(shows(&harness, "Load cases"));
    let shown = harness.state().result_table("load_cases").unwrap();
    let lines: Vec<&str> = shown.lines().collect();
    let at = lines[0].split(',').position(|title| title == "full.heat.mid_film_rise_k").unwrap();
    let rise = |line: &str| line.split(',').nth(at).unwrap().parse::<f64>().unwrap();
    assert!(lines.len() == 4 && rise(lines[2]) > rise(lines[1]) && rise(lines[1]) > 0.0, "{shown}");
    assert!(lines[3].contains("refused"), "{shown}");
}

/// Returns the cells of a table without names and remarks, and without seconds, which differ between runs.
fn timeless(csv: &str) -> Vec<Vec<String>> {
    let numbers = |line: &str| match line.strip_prefix('"').and_then(|quoted| quoted.split_once("\",")) {
        Some((_, rest)) => rest.to_owned(),
        None => line.split_once(',').map_or("", |(_, rest)| rest).to_owned(),
    };
    let mut lines = csv.lines().map(|line| numbers(line).split(',').map(str::to_owned).collect::<Vec<_>>());
    let titles = lines.next().unwrap();
    let of_clock = titles.iter().position(|title| title.ends_with("wall_s"));
    let kept = titles.iter().position(|title| title == "status" || title == "warning").unwrap_or(titles.len());
    let numbers = |line: Vec<String>| {
        let cells = line.into_iter().take(kept).enumerate();
        cells.filter(|(k, _)| Some(*k) != of_clock).map(|(_, cell)| cell).collect()
    };
    lines.map(numbers).collect()
}
