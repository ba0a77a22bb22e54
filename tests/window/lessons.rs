//! Lessons can be done as their texts say.

use crate::driver::{Window, choose, click, press, set, shows, wait, window, write};
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use ehl_explorer::app::Explorer;
use std::path::Path;

/// Returns the lessons of the program as text, in their order.
fn texts() -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/lessons");
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files.iter().map(|file| std::fs::read_to_string(file).unwrap()).collect()
}

/// Does what a goal of a step requires, as a reader of the lesson would.
fn carry_out(harness: &mut Window, goal: &str) {
    let words: Vec<&str> = goal.split_whitespace().collect();
    match words[..] {
        ["read"] => {}
        ["checked"] => {
            wait(harness, "a full solution", |app| {
                ["Verified", "Roughly right", "Far off"].contains(&app.badge().as_str())
            });
        }
        ["tab", ..] => {
            let title = goal.trim_start_matches("tab ");
            click(harness, &format!("Open {title}"));
        }
        ["starved"] => {
            choose(harness, "Cavitation", "Mass-conserving");
            // The text of the lesson names the switch too.
            harness.get_by_role_and_label(Role::CheckBox, "Starved inlet").click();
            harness.run_steps(2);
        }
        ["heat"] => {
            harness.get_by_role_and_label(Role::CheckBox, "Heat").click();
            harness.run_steps(2);
        }
        ["mixed"] => {
            // The text of the lesson names the group too.
            harness.query_all_by_label("Surfaces").next().unwrap().click();
            // The group opens slowly.
            harness.run_steps(20);
            harness.get_by_role_and_label(Role::CheckBox, "Mixed lubrication").click();
            harness.run_steps(2);
        }
        ["roughness", "between", from, "and", to] => {
            let middle = 0.5 * (from.parse::<f64>().unwrap() + to.parse::<f64>().unwrap());
            set(harness, Role::Slider, "Composite roughness", middle);
        }
        ["u_m", "between", from, "and", to] => {
            let middle = 0.5 * (from.parse::<f64>().unwrap() + to.parse::<f64>().unwrap());
            write(harness, "Speed u_m", &middle.to_string());
            press(harness, Modifiers::NONE, Key::Enter);
        }
        ["inlet", "film", "between", from, "and", to] => {
            let middle = 0.5 * (from.parse::<f64>().unwrap() + to.parse::<f64>().unwrap());
            write(harness, "Inlet film thickness", &middle.to_string());
            press(harness, Modifiers::NONE, Key::Enter);
        }
        // Whichever tab is in front.
        ["pin", _] => press(harness, Modifiers::COMMAND, Key::D),
        [quantity, "between", from, "and", to] => {
            let name = match quantity {
                "M" => "Load number M",
                "L" => "Lubricant number L",
                "R_y/R" => "Ratio of radii R_y/R",
                "SRR" => "Slide-to-roll ratio SRR",
                _ => "Newtonian plateau ratio NPR",
            };
            let middle = 0.5 * (from.parse::<f64>().unwrap() + to.parse::<f64>().unwrap());
            // The slider is in percent.
            set(harness, Role::Slider, name, if quantity == "SRR" { 100.0 * middle } else { middle });
        }
        _ => panic!("the test does not know how to do “{goal}”"),
    }
}

#[test]
fn each_is_walked_through_from_a_fresh_start() {
    let texts = texts();
    assert_eq!(texts.len(), 14);
    for (k, text) in texts.iter().enumerate() {
        // The switches of lubricant and surfaces are below the other controls.
        let low = ["starved", "heat", "mixed"].iter().any(|goal| text.contains(&format!("Do: {goal}")));
        let size = [1280.0, if low { 1900.0 } else { 800.0 }];
        let mut harness = window(Explorer::with_embedded_models().without_system_dialogs(), size);
        harness.run_steps(3);
        click(&mut harness, "Help");
        click(&mut harness, "Lessons");
        let title = text.lines().next().unwrap().trim_start_matches("# ");
        click(&mut harness, &format!("{}. {title}", k + 1));
        let steps: Vec<&str> = text.split("\n## ").skip(1).collect();
        for (n, step) in steps.iter().enumerate() {
            let lines = || step.lines().map(|line| line.trim_start_matches("- "));
            let heading = step.lines().next().unwrap();
            assert!(shows(&harness, heading), "{title}: {heading}");
            assert!(shows(&harness, &format!("Step {} of {}", n + 1, steps.len())));
            let goals = lines().find_map(|line| line.strip_prefix("Do: ")).unwrap_or("read");
            if goals != "read" && goals != "checked" {
                assert!(!shows(&harness, "Done"), "{title}: “{heading}” is done before anything was done");
            }
            goals.split(", ").for_each(|goal| carry_out(&mut harness, goal));
            wait(&mut harness, "the picture", |app| !app.busy());
            harness.run_steps(3);
            let seen = lines().find_map(|line| line.strip_prefix("Seen: ")).unwrap();
            let words: Vec<&str> = seen.split_whitespace().take(5).collect();
            assert!(shows(&harness, &words.join(" ")), "{title}: “{heading}” does not see that it was done");
            click(&mut harness, if n + 1 == steps.len() { "Finish" } else { "Next" });
        }
        assert!(shows(&harness, "Each lesson starts from its own contact"), "the list is back");
        let name = format!("{}. {title}", k + 1);
        let done = harness
            .query_all_by_label(&name)
            .any(|entry| entry.accesskit_node().description().as_deref() == Some("done"));
        assert!(done, "{title}: the list marks it as finished");
        press(&mut harness, Modifiers::NONE, Key::Escape);
        assert!(!shows(&harness, "Each lesson starts from its own contact"), "Escape closes it");
    }
}
