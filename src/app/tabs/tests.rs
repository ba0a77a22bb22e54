//! Test that every tab can be drawn.

use super::frame::tab_ui;
use crate::app::context::Commands;
use crate::app::desk::Desk;
use crate::app::document::Document;
use crate::app::model_source::Models;
use crate::app::tab::Tab;
use crate::engine::Store;
use egui::Ui;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

/// Texts of each tab when it is drawn alone.
const SHOWN: [(Tab, &[&str]); 10] = [
    (Tab::Profiles, &["Pin curve", "Pressure profile", "Film profile"]),
    (Tab::ContactMap, &["Show a circular contact"]),
    (Tab::Regimes, &["Chart of M and L", "Film thickness by published formulas"]),
    (Tab::Traction, &["Laws of the fluid"]),
    (Tab::Basis, &["Mode shapes", "Singular values"]),
    (Tab::Accuracy, &["Failure map"]),
    (Tab::Training, &["Start training", "Pre-computed"]),
    (Tab::Transient, &["Load amplitude"]),
    (Tab::Tpwl, &["Number of operating points"]),
    (Tab::Results, &["Run the study"]),
];

#[test]
fn every_tab_can_be_drawn_alone() {
    let store = Store::default();
    let model = store.embedded("line").unwrap();
    assert_eq!(SHOWN.map(|(tab, _)| tab), Tab::ALL);
    for (tab, _) in SHOWN {
        let desk = Desk::new(Document::default(), Models::only(Some(model.clone())), store.clone());
        let draw = move |ui: &mut Ui, desk: &mut Desk| {
            desk.receive();
            desk.answers.refresh(ui.ctx(), &desk.document);
            tab_ui(ui, tab, desk, &mut Commands::default());
        };
        let mut harness = Harness::builder().with_size([1000.0, 700.0]).build_ui_state(draw, desk);
        harness.run_steps(3);
        for (other, texts) in SHOWN {
            for text in texts {
                let shown = harness.query_all_by_label_contains(text).next().is_some();
                assert_eq!(shown, other == tab, "{text:?} in {tab:?}");
            }
        }
    }
}
