//! Error and time of the reduced model over its modes and equations, and the result of dragging both.

use crate::driver::{Window, click, drag_line, shows, wait, wait_until, window};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use ehl_explorer::app::Explorer;
use std::time::{Duration, Instant};

fn modes(harness: &Window) -> Option<usize> {
    let told = harness.query_all_by_label_contains(" modes").filter_map(|node| {
        let node = node.accesskit_node();
        node.label().or(node.value()).filter(|text| text.starts_with("Local model"))
    });
    let text = told.into_iter().next()?;
    text.split(", ").last()?.split(' ').next()?.parse().ok()
}

#[test]
fn error_over_modes_appears_and_can_be_dragged() {
    let mut harness = window(Explorer::with_embedded_models().without_system_dialogs(), [1280.0, 800.0]);
    wait(&mut harness, "the picture", |app| app.central_film().is_some());
    click(&mut harness, "Reduced basis");
    let all = modes(&harness).unwrap();
    let (begin, load) = (Instant::now(), load());
    click(&mut harness, "Error and time");
    let busy = |window: &Window| window.query_by_label("Progress of the sizes").is_some();
    wait_until(Duration::from_secs(120), &mut harness, "the study to begin", busy);
    wait_until(Duration::from_secs(120), &mut harness, "all sizes", |window| !busy(window));
    let took = begin.elapsed().as_secs_f64();
    let slower = if cfg!(debug_assertions) { 60.0 } else { 1.0 };
    assert!(took < 5.0 * slower * load, "{took} s at a load of {load}");
    for plot in ["Error against modes", "Time against modes", "Error against equations", "Time against equations"] {
        assert!(harness.query_by_label(plot).is_some(), "{plot}");
    }
    let plot = harness.get_by_label("Error against modes").rect();
    drag_line(&mut harness, (plot.left(), plot.right()), plot.center().y, -120.0);
    let fewer = modes(&harness).unwrap();
    assert!(fewer < all, "{fewer} of {all} modes");
    let grey = |harness: &Window, name: &str| harness.state().drawn().find(|drawn| drawn.0 == name).unwrap().2;
    assert!(!grey(&harness, "sizes by modes"), "any number of modes is there");
    assert!(grey(&harness, "sizes by rows"), "rows were tried with all modes");
    let title = harness.state().model_title().unwrap().to_owned();
    let plot = harness.get_by_label("Error against equations").rect();
    drag_line(&mut harness, (plot.left(), plot.right()), plot.center().y, -120.0);
    assert_ne!(harness.state().model_title().unwrap(), title, "another model serves");
    assert!(grey(&harness, "sizes by modes"), "modes were tried with other rows");
    click(&mut harness, "The model’s own equations");
    assert_eq!(harness.state().model_title().unwrap(), title);
    click(&mut harness, "Profile and difference");
    assert!(shows(&harness, "Pressure profile"));
}

/// Load on the machine, at least one thread for each of its processors.
fn load() -> f64 {
    let cores = std::thread::available_parallelism().map_or(1, usize::from) as f64;
    let waiting = std::fs::read_to_string("/proc/loadavg").ok();
    let waiting = waiting.and_then(|text| text.split(' ').next()?.parse::<f64>().ok()).unwrap_or(cores);
    1.0 + waiting / cores
}
