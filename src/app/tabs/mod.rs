//! The tabs, each a question with its picture. A tab owns its view, sees the document and the answers, and asks for
//! everything else by commands; none knows another.

pub mod accuracy;
pub mod basis;
pub mod contact_map;
pub mod profiles;
pub mod regimes;
pub mod results;
mod take_away;
pub mod traction;
pub mod training;
pub mod transient;

use super::command::Command;
use super::context::Commands;
use super::controls::{lock_ui, named, why};
use super::desk::Desk;
use super::figure;
use super::tab::Tab;
use super::units::{Manner, Units};
use egui::Ui;
use egui_tiles::{Behavior, TileId, Tiles, UiResponse};
use take_away::Offer;

/// What each tab keeps of its own.
#[derive(Default)]
pub struct Views {
    /// Pressure and film.
    pub profiles: profiles::Profiles,
    /// The plane of a point contact.
    pub map: contact_map::ContactMap,
    /// The M–L chart.
    pub regimes: regimes::Regimes,
    /// The reduced basis.
    pub basis: basis::Basis,
    /// The studies of the Accuracy tab.
    pub accuracy: accuracy::AccuracyView,
    /// How the Traction tab shows it.
    pub traction: traction::Traction,
    /// The study of the open scene.
    pub results: results::ResultsView,
    /// How the Transient tab shows it.
    pub transient: transient::Transient,
    /// What is being entered for a training.
    pub training: training::TrainingTab,
    /// What the TPWL tab shows.
    pub tpwl: transient::tpwl::Tpwl,
}

/// Draws one tab, whatever is around it.
fn tab_ui(ui: &mut Ui, tab: Tab, desk: &mut Desk, commands: &mut Commands) {
    // A view is taken out while it is drawn: it sees everything else, and nobody sees it half changed.
    let mut views = std::mem::take(&mut desk.views);
    match tab {
        Tab::Profiles => views.profiles.ui(ui, &desk.context(), commands),
        Tab::ContactMap => views.map.ui(ui, &desk.context(), commands),
        Tab::Regimes => views.regimes.ui(ui, &desk.context(), commands),
        Tab::Basis => basis::ui(ui, &mut views.basis, &desk.context(), commands),
        Tab::Traction => views.traction.ui(ui, &desk.context(), commands),
        Tab::Results => views.results.ui(ui, &desk.context(), commands),
        Tab::Accuracy => accuracy::ui(ui, &mut views.accuracy, &desk.context(), commands),
        Tab::Training => views.training.ui(ui, &desk.context(), commands),
        Tab::Transient => views.transient.ui(ui, &desk.context(), commands),
        Tab::Tpwl => views.tpwl.ui(ui, &desk.context(), commands),
    }
    desk.views = views;
}

/// What can be taken away from a tab.
fn offers(tab: Tab, desk: &Desk) -> Vec<Offer<'_>> {
    let (views, context) = (&desk.views, desk.context());
    match tab {
        Tab::Profiles => profiles::offers(&context),
        Tab::ContactMap => views.map.offers(&context),
        Tab::Regimes => views.regimes.offers(&context),
        Tab::Basis => basis::offers(&context),
        Tab::Traction => traction::offers(&context),
        Tab::Results => views.results.offers(&context),
        Tab::Accuracy => accuracy::offers(&views.accuracy, &context),
        Tab::Training => Vec::new(),
        Tab::Transient => transient::offers(&context),
        Tab::Tpwl => views.tpwl.offers(&context),
    }
}

/// The switch between ratios and SI units; a tab on which it would change nothing says so.
fn units_ui(ui: &mut Ui, tab: Tab, units: Units, commands: &mut Commands) {
    let switch = egui::Button::selectable(units == Units::Si && tab.has_units(), "SI");
    let switch = ui.add_enabled(tab.has_units(), switch);
    let tip = "Axes and exports in SI units, or dimensionless (F7)";
    let none = "Errors, ratios and counts have no unit, and what has one is in SI units on this tab always";
    if switch.on_hover_text(tip).on_disabled_hover_text(none).clicked() {
        commands.push(Command::SiUnits);
    }
}

/// Draws the tabs.
pub struct Tabs<'a> {
    /// What they show.
    pub desk: &'a mut Desk,
    /// What they ask for.
    pub commands: &'a mut Commands,
    /// Whether their titles stand close.
    pub narrow: bool,
}

impl Behavior<Tab> for Tabs<'_> {
    fn pane_ui(&mut self, ui: &mut Ui, _tile_id: TileId, tab: &mut Tab) -> UiResponse {
        egui::Frame::new().fill(ui.visuals().panel_fill).inner_margin(egui::Margin::symmetric(10, 8)).show(ui, |ui| {
            ui.set_min_size(ui.available_size());
            why(ui, self.desk.display.why && self.desk.presentation.is_none(), tab.why());
            figure::enter(ui.ctx(), Some(*tab));
            let units = self.desk.figures.units().unwrap_or(self.desk.display.units);
            Manner { units, locked: self.desk.locked.contains(tab) }.set(ui.ctx());
            tab_ui(ui, *tab, self.desk, self.commands);
            figure::enter(ui.ctx(), None);
        });
        UiResponse::None
    }

    /// What is at the same place of every tab: what can be taken away, the manner of its plots, the note for teaching.
    fn top_bar_right_ui(&mut self, tiles: &Tiles<Tab>, ui: &mut Ui, _: TileId, tabs: &egui_tiles::Tabs, _: &mut f32) {
        ui.add_space(6.0);
        // Tabs want the room.
        ui.spacing_mut().item_spacing.x = 2.0;
        ui.spacing_mut().button_padding.x = 4.0;
        let Some(tab) = tabs.active.and_then(|tile| tiles.get_pane(&tile)).copied() else { return };
        let presenting = self.desk.presentation.is_some();
        if !presenting {
            take_away::menu(ui, tab, || offers(tab, self.desk), self.commands);
        }
        units_ui(ui, tab, self.desk.display.units, self.commands);
        let (locked, tip) = (self.desk.locked.contains(&tab), "The axes of this tab stand still (F8)");
        let lock = lock_ui(ui, [20.0, 22.0], locked);
        if named(ui, lock, &format!("Lock the axes of {}", tab.title())).on_hover_text(tip).clicked() {
            self.commands.push(Command::LockAxesOf(tab));
        }
        // A narrow bar leaves its room to the tabs: the note is in the menu View as well.
        if !presenting && !self.narrow {
            let tip = "What is seen in a tab and why it is so, in three sentences";
            if ui.selectable_label(self.desk.display.why, "Why").on_hover_text(tip).clicked() {
                self.commands.push(Command::ShowWhy);
            }
        }
    }

    fn tab_title_for_pane(&mut self, tab: &Tab) -> egui::WidgetText {
        tab.title().into()
    }

    fn tab_bar_height(&self, _style: &egui::Style) -> f32 {
        30.0
    }

    fn tab_title_spacing(&self, _visuals: &egui::Visuals) -> f32 {
        if self.narrow { 3.0 } else { 6.0 }
    }

    fn tab_bar_color(&self, visuals: &egui::Visuals) -> egui::Color32 {
        visuals.faint_bg_color
    }

    fn is_tab_closable(&self, _tiles: &Tiles<Tab>, _tile_id: TileId) -> bool {
        false
    }

    fn simplification_options(&self) -> egui_tiles::SimplificationOptions {
        egui_tiles::SimplificationOptions { all_panes_must_have_tabs: true, ..Default::default() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::document::Document;
    use crate::app::model_source::Models;
    use crate::engine::{Embedded, Store};
    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable as _;

    /// What stands in each tab when it is all there is.
    const SHOWN: [(Tab, &[&str]); 10] = [
        (Tab::Profiles, &["Pin curve", "Pressure profile", "Film profile"]),
        (Tab::ContactMap, &["Show a ball instead"]),
        (Tab::Regimes, &["Chart of M and L", "Film by published formulas"]),
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
        let model = store.embedded(Embedded::Line).unwrap();
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
}
