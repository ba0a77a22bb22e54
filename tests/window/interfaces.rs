//! The window compared with the engine: the same numbers, trust and warnings.

use crate::common::scratch::Scratch;
use crate::common::six_contacts::Stated;
use crate::driver::{wait, window};
use ehl_explorer::app::Explorer;
use ehl_explorer::engine::{Warning, Workbench};
use ehl_explorer::scene::{Bench, Grid, Method, Request};

#[test]
fn six_contacts_are_answered_as_by_the_engine() {
    let folder = Scratch::new("six-contacts-window");
    let mut harness = window(Explorer::with_embedded_models().without_system_dialogs(), [1280.0, 800.0]);
    for contact in Stated::all() {
        let name = contact.name();
        let scene = contact.scene("Point(methods: [Reduced(model: Embedded)])");
        let request = Request { method: Method::EMBEDDED, ..scene.experiment().request().unwrap() };
        let mut bench = Workbench::new("");
        let reduced = bench.answer(&request, None, &()).unwrap();
        assert_eq!(reduced.result.untrained(), !contact.trained(), "{name}");
        let by_model = reduced.result.warnings.clone();
        // Without a trained model the window solves in full, on the model's grid.
        let wanted = match contact.trained() {
            true => reduced,
            false => {
                let full = Request { method: Method::Full, grid: Grid::Model, ..request };
                bench.answer(&full, None, &()).unwrap()
            }
        };
        let path = folder.write("contact.ron", &scene.to_ron().unwrap());
        harness.state_mut().open_scene(&path).unwrap();
        wait(&mut harness, name, |app| !app.busy() && app.trust().is_some());
        let app = harness.state();
        let (trained, said) = app.trust().unwrap();
        assert_eq!(trained, contact.trained(), "{name}: {said:?}");
        let scalars = wanted.result.scalars.unwrap();
        let film = app.central_film().unwrap();
        assert!((film / scalars.h_c - 1.0).abs() < 1e-6, "{name}: {film}, not {}", scalars.h_c);
        let traction = app.traction().unwrap_or(0.0);
        assert!((traction - wanted.result.traction.unwrap().abs()).abs() < 1e-7, "{name}: {traction}");
        let own = by_model.iter().take(usize::from(!trained)).chain(&wanted.result.warnings);
        // Oscillation of the boundary depends on the initial guess: in the window it is the reduced solution.
        let cycled = Warning::CavitationBoundaryOscillated.to_string();
        let [said, own] = [said, own.map(ToString::to_string).collect()]
            .map(|said: Vec<String>| said.into_iter().filter(|said| *said != cycled).collect::<Vec<_>>());
        assert_eq!(said, own, "{name}");
    }
}
