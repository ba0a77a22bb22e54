//! The tabs, each a question with its picture.

pub mod accuracy;
mod axes;
pub mod badge;
pub mod basis;
pub mod contact_map;
mod cut_line;
mod direction;
pub mod film_shear;
mod formulas;
pub mod profiles;
mod raster;
mod regime_chart;
pub mod regimes;
pub mod tpwl;
mod traction;
mod training;
mod transient;

use super::figure;
use super::state::State;
use egui::Ui;
use egui_tiles::{Behavior, Tile, TileId, Tiles, Tree, UiResponse};
use serde::{Deserialize, Serialize};

/// A tab.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Tab {
    /// Pressure and film.
    Profiles,
    /// Film, pressure and interferogram of a point contact.
    ContactMap,
    /// The M–L chart.
    Regimes,
    /// Friction along one quantity.
    Traction,
    /// Singular values, modes, sampled rows.
    Basis,
    /// Residuals and errors.
    Accuracy,
    /// Making a reduced model.
    Training,
    /// The contact in time.
    Transient,
    /// The linearised model of it.
    Tpwl,
}

impl Tab {
    /// All tabs in their order.
    pub const ALL: [Self; 9] = [
        Self::Profiles,
        Self::ContactMap,
        Self::Regimes,
        Self::Traction,
        Self::Basis,
        Self::Accuracy,
        Self::Training,
        Self::Transient,
        Self::Tpwl,
    ];

    /// Title.
    pub fn title(self) -> &'static str {
        match self {
            Self::Profiles => "Profiles",
            Self::ContactMap => "Contact map",
            Self::Regimes => "Regimes",
            Self::Traction => "Traction",
            Self::Basis => "Reduced basis",
            Self::Accuracy => "Accuracy",
            Self::Training => "Training",
            Self::Transient => "Transient",
            Self::Tpwl => "TPWL",
        }
    }

    /// Words for what it shows.
    pub fn subjects(self) -> &'static str {
        match self {
            Self::Profiles => "pressure film spike shear",
            Self::ContactMap => "interferogram fringes contours horseshoe side lobes",
            Self::Regimes => "chart film formulas Moes asymptotes",
            Self::Traction => "friction Stribeck slide-to-roll fluid viscosity",
            Self::Basis => "singular values modes truncation sampled rows",
            Self::Accuracy => "error failure map residuals bound",
            Self::Training => "snapshots model plan range",
            Self::Transient => "time load speed radius frames",
            Self::Tpwl => "linearised operating points weights",
        }
    }
}

/// The tabs as they are at first.
pub fn default_tree() -> Tree<Tab> {
    Tree::new_tabs(egui::Id::unique("tabs"), Tab::ALL.to_vec())
}

/// Whether a restored layout still has every tab exactly once.
pub fn is_complete(tree: &Tree<Tab>) -> bool {
    Tab::ALL.iter().all(|tab| tree.tiles.tiles().filter(|t| matches!(t, Tile::Pane(p) if p == tab)).count() == 1)
        && tree.root().is_some()
}

/// Draws the tabs.
pub struct Tabs<'a> {
    /// What they show.
    pub state: &'a mut State,
}

impl Behavior<Tab> for Tabs<'_> {
    fn pane_ui(&mut self, ui: &mut Ui, _tile_id: TileId, tab: &mut Tab) -> UiResponse {
        egui::Frame::new().fill(ui.visuals().panel_fill).inner_margin(egui::Margin::symmetric(10, 8)).show(ui, |ui| {
            ui.set_min_size(ui.available_size());
            figure::offer(ui, &format!("The whole tab {}", tab.title()), ui.max_rect());
            match tab {
                Tab::Profiles => profiles::ui(ui, self.state),
                Tab::ContactMap => contact_map::ui(ui, self.state),
                Tab::Regimes => regimes::ui(ui, self.state),
                Tab::Traction => traction::ui(ui, self.state),
                Tab::Basis => basis::ui(ui, self.state),
                Tab::Accuracy => accuracy::ui(ui, self.state),
                Tab::Training => training::ui(ui, self.state),
                Tab::Transient => transient::ui(ui, self.state),
                Tab::Tpwl => tpwl::ui(ui, self.state),
            }
        });
        UiResponse::None
    }

    fn tab_title_for_pane(&mut self, tab: &Tab) -> egui::WidgetText {
        tab.title().into()
    }

    fn tab_bar_height(&self, _style: &egui::Style) -> f32 {
        30.0
    }

    fn tab_title_spacing(&self, _visuals: &egui::Visuals) -> f32 {
        10.0
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
