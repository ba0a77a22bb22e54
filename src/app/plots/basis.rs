//! stub
use crate::app::state::State;
use egui::Ui;
/// stub
#[derive(Default)]
pub struct BasisView {}
/// stub
pub fn ui(ui: &mut Ui, _state: &mut State) {
    ui.weak("soon");
}
