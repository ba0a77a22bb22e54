//! Frame around the tabs: bar of titles, menu of exports, switches for units and axes.

use super::offer;
use crate::app::command::Command;
use crate::app::context::Commands;
use crate::app::controls::{lock_ui, named, why};
use crate::app::desk::Desk;
use crate::app::figure;
use crate::app::tab::Tab;
use crate::app::units::{Manner, Units};
use egui::Ui;
use egui_tiles::{Behavior, TileId, Tiles, UiResponse};

/// Draws one tab without its frame.
pub fn tab_ui(ui: &mut Ui, tab: Tab, desk: &mut Desk, commands: &mut Commands) {
    // Move the tabs out while one is drawn, so that it can be changed while the rest of the state is borrowed.
    let mut tabs = std::mem::take(&mut desk.tabs);
    tabs.of_mut(tab).ui(ui, &desk.context(), commands);
    desk.tabs = tabs;
}

/// Draws the switch between dimensionless values and units. It is disabled on a tab without such units.
fn units_ui(ui: &mut Ui, there: bool, units: Units, commands: &mut Commands) {
    let switch = egui::Button::selectable(units == Units::Dimensional && there, "Units");
    let switch = ui.add_enabled(there, switch);
    let tip = "Axes and exports with units, or dimensionless (F7). Settings chooses the system";
    let none =
        "Errors, ratios and counts have no unit, and all other quantities of this tab are always shown with units";
    if switch.on_hover_text(tip).on_disabled_hover_text(none).clicked() {
        commands.push(Command::SwitchUnits);
    }
}

/// Drawing of the tabs.
pub struct Frame<'a> {
    /// State that the tabs show.
    pub desk: &'a mut Desk,
    /// Commands of the tabs.
    pub commands: &'a mut Commands,
    /// True if the titles are closely spaced.
    pub narrow: bool,
}

impl Frame<'_> {
    /// Draws one tab with a margin.
    pub fn tab_ui(&mut self, ui: &mut Ui, tab: Tab) {
        egui::Frame::new().fill(ui.visuals().panel_fill).inner_margin(egui::Margin::symmetric(10, 8)).show(ui, |ui| {
            ui.set_min_size(ui.available_size());
            if self.desk.display.why && self.desk.presentation.is_none() {
                why(ui, &self.desk.tabs.of(tab).why(&self.desk.context()));
            }
            figure::enter(ui.ctx(), Some(tab));
            let units = self.desk.figures.units().unwrap_or(self.desk.display.units);
            Manner { units, locked: self.desk.locked.contains(&tab) }.set(ui.ctx());
            tab_ui(ui, tab, self.desk, self.commands);
            figure::enter(ui.ctx(), None);
        });
    }
}

impl Behavior<Tab> for Frame<'_> {
    fn pane_ui(&mut self, ui: &mut Ui, _tile_id: TileId, tab: &mut Tab) -> UiResponse {
        self.tab_ui(ui, *tab);
        UiResponse::None
    }

    /// Draws the same controls for every tab: exports, units and axes of its plots, and the explanation for
    /// teaching.
    fn top_bar_right_ui(&mut self, tiles: &Tiles<Tab>, ui: &mut Ui, _: TileId, tabs: &egui_tiles::Tabs, _: &mut f32) {
        ui.add_space(6.0);
        // The tabs need the space.
        ui.spacing_mut().item_spacing.x = 2.0;
        ui.spacing_mut().button_padding.x = 4.0;
        let Some(tab) = tabs.active.and_then(|tile| tiles.get_pane(&tile)).copied() else { return };
        let presenting = self.desk.presentation.is_some();
        if !presenting {
            offer::menu(ui, tab, || self.desk.tabs.of(tab).offers(&self.desk.context()), self.commands);
        }
        let has_units = self.desk.tabs.of(tab).about().has_units;
        units_ui(ui, has_units, self.desk.display.units, self.commands);
        let (locked, tip) = (self.desk.locked.contains(&tab), "Locks the axes of this tab (F8)");
        let lock = lock_ui(ui, [20.0, 22.0], locked);
        if named(ui, lock, &format!("Lock the axes of {}", tab.title())).on_hover_text(tip).clicked() {
            self.commands.push(Command::LockAxesOf(tab));
        }
        // A narrow bar leaves its space to the tabs. The menu View also has this command.
        if !presenting && !self.narrow {
            let tip = "Explains the content of the tab in three sentences";
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
