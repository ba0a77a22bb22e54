//! The window with a damaged session, and under random gestures.

use crate::common::cases::cases;
use crate::common::scratch::Scratch;
use crate::{NOW, alone, spoil};
use egui::accesskit::Role;
use egui::{Key, Modifiers, MouseWheelUnit, Pos2, TouchPhase, Vec2, pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use ehl_explorer::app::Explorer;
use fastrand::Rng;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

const SIZE: Vec2 = vec2(1280.0, 800.0);
/// Maximum memory of the window \[MB\] after any number of steps: idle, and during a long study.
const HELD: [f64; 2] = [700.0, 1500.0];
/// Number of gestures between comparisons of picture and request.
const BURST: usize = 5;
/// Maximum duration of the last solves.
const PATIENCE: Duration = Duration::from_secs(60);
/// Roles of controls.
const ROLES: [Role; 9] = [
    Role::Button,
    Role::Slider,
    Role::SpinButton,
    Role::CheckBox,
    Role::RadioButton,
    Role::ComboBox,
    Role::TextInput,
    Role::ListBoxOption,
    Role::Tab,
];
const TEXTS: [&str; 9] = ["", "7.5", "1e300", "-inf", "NaN", "0", "1e-300", "µ°\u{202e}", "999999999999999999999"];
const KEYS: [Key; 12] = [
    Key::Escape,
    Key::Enter,
    Key::Tab,
    Key::Space,
    Key::ArrowUp,
    Key::ArrowDown,
    Key::ArrowLeft,
    Key::ArrowRight,
    Key::Delete,
    Key::Home,
    Key::End,
    Key::F11,
];
const CHORDS: [Key; 8] = [Key::Z, Key::Y, Key::P, Key::D, Key::N, Key::Plus, Key::Minus, Key::Num0];

fn explorer() -> Explorer {
    Explorer::new(None).without_system_dialogs()
}

fn window(explorer: Explorer) -> Harness<'static, Explorer> {
    // Damaged text may have characters that no font contains; the program draws boxes for them.
    Harness::builder()
        .with_size(SIZE)
        .allow_missing_glyphs()
        .build_ui_state(|ui, app: &mut Explorer| app.ui(ui), explorer)
}

#[test]
fn a_damaged_session_starts_and_is_kept() {
    let _alone = alone();
    let (mut rng, folder) = (Rng::with_seed(4), Scratch::new("damaged-session"));
    let path = folder.join("session.ron");
    let mut first = window(explorer().keeping_session_in(&folder, true));
    first.get_by_role_and_label(Role::Slider, "Load number M").set_value_accesskit(80.0);
    first.run_steps(3);
    drop(first);
    let whole = std::fs::read_to_string(&path).unwrap();
    let mut kept = 0;
    for case in 0..cases(200, 20_000) {
        let spoiled = spoil::text(&mut rng, &whole);
        std::fs::write(&path, &spoiled).unwrap();
        let started = explorer().keeping_session_in(&folder, true);
        if let Ok(bad) = std::fs::read_to_string(folder.join("session.ron.bad")) {
            assert_eq!(bad, spoiled, "case {case}");
            std::fs::remove_file(folder.join("session.ron.bad")).unwrap();
            kept += 1;
        }
        if case % 10 == 0 {
            window(started).run_steps(3);
        }
    }
    println!("{kept} damaged sessions were kept");
}

/// Controls that are not used: those that end the program, and those that occupy all cores for minutes.
fn is_left_alone(name: &str) -> bool {
    ["Train", "Resume", "Quit", "Close"].iter().any(|word| name.contains(word))
}

/// Makes one random gesture.
fn gesture(rng: &mut Rng, window: &mut Harness<'static, Explorer>) {
    let place = |rng: &mut Rng| pos2(rng.f32() * SIZE.x, rng.f32() * SIZE.y);
    match rng.u8(..20) {
        0 => window.key_press(*spoil::one(rng, &KEYS)),
        1 => window.key_press_modifiers(Modifiers::COMMAND, *spoil::one(rng, &CHORDS)),
        2 => {
            let to: Pos2 = place(rng);
            window.drag_at(place(rng));
            window.step();
            window.hover_at(to);
            window.step();
            window.drop_at(to);
        }
        3 => {
            window.hover_at(place(rng));
            let delta = vec2(0.0, 200.0 * (rng.f32() - 0.5));
            let (unit, phase) = (MouseWheelUnit::Point, TouchPhase::Move);
            let modifiers = if rng.bool() { Modifiers::COMMAND } else { Modifiers::NONE };
            window.event(egui::Event::MouseWheel {
                unit,
                delta,
                phase,
                modifiers,
                source: egui::MouseWheelSource::Unknown,
            });
        }
        4 => {
            let size = vec2(900.0 + 800.0 * rng.f32(), 560.0 + 500.0 * rng.f32());
            window.set_size(size);
        }
        _ => {
            let role = *spoil::one(rng, &ROLES);
            let nodes: Vec<_> = window.query_all_by_role(role).collect();
            if nodes.is_empty() {
                return;
            }
            let node = spoil::one(rng, &nodes);
            if node.accesskit_node().label().is_some_and(|name| is_left_alone(&name)) {
                return;
            }
            match role {
                Role::Slider | Role::SpinButton if rng.bool() => {
                    let values = [0.0, -1.0, 0.3, 10.0, 1e3, 1e300, f64::NAN, f64::INFINITY];
                    node.set_value_accesskit(*spoil::one(rng, &values));
                }
                Role::TextInput => {
                    node.focus();
                    node.type_text(TEXTS[rng.usize(..TEXTS.len())]);
                }
                _ => node.click(),
            }
        }
    }
}

/// Returns the memory of the program \[MB\], without memory that the allocator keeps for later.
fn held_megabytes() -> f64 {
    NOW.load(Ordering::Relaxed) as f64 * 1e-6
}

/// Waits for the end of solves, whose memory is no leak.
fn rest(window: &mut Harness<'static, Explorer>) {
    let begin = Instant::now();
    while window.state().busy() && begin.elapsed() < PATIENCE {
        window.step();
        std::thread::sleep(Duration::from_millis(5));
    }
}

#[test]
fn a_hand_that_knows_nothing_breaks_nothing() {
    let _alone = alone();
    let (mut rng, folder) = (Rng::with_seed(5), Scratch::new("senseless"));
    // Folder for saved and exported files.
    std::env::set_current_dir(&folder).unwrap();
    let mut window = window(explorer().keeping_session_in(&folder, true));
    let (steps, mut held) = (cases(1000, 10_000), Vec::new());
    // Data stored for every contact kind exist from the beginning.
    for name in ["Ball", "Heat", "Ellipse", "Heat", "Roller"] {
        window.get_by_label(name).click();
        window.run_steps(3);
        rest(&mut window);
    }
    for step in 0..steps {
        gesture(&mut rng, &mut window);
        window.step();
        let app = window.state();
        // A displayed answer belongs to the request.
        if let Some(film) = app.central_film() {
            assert!(film.is_finite() && film > 0.0, "step {step}: {film}");
        }
        let (moes, load) = (app.moes(), app.load());
        assert!(moes.m > 0.0 && moes.l >= 0.0 && load > 0.0 && (moes.m * moes.l * load).is_finite(), "step {step}");
        if step % BURST == BURST - 1 {
            window.step();
            let app = window.state();
            assert!(app.answers_the_request(), "step {step}: an answer to another request");
            let stale = app.drawn().find(|(_, present, grey)| !present && !grey);
            assert!(stale.is_none(), "step {step}: {stale:?} is of another request, and not grey");
        }
        if step % (steps / 10) == 0 {
            held.push(held_megabytes());
        }
    }
    rest(&mut window);
    let (busy, last) = (window.state().busy(), held_megabytes());
    println!("{steps} steps; MB held after every tenth of them: {held:.0?}, then {last:.0}, busy: {busy}");
    assert!(last < HELD[usize::from(busy)], "{held:.0?}, then {last:.0}, busy: {busy}");
    std::env::set_current_dir(env!("CARGO_MANIFEST_DIR")).unwrap();
}
