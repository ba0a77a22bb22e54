//! What commands and choices of the palette do.

use super::Explorer;
use super::command::Command;
use super::export;
use super::files::{Pending, Purpose};
use super::palette::Action;
use super::panels;
use super::presentation::{Presentation, enlargement};
use super::tabs::{self, Tab};
use egui::{Context, ThemePreference, ViewportCommand};
use egui_tiles::Tile;

impl Explorer {
    pub(super) fn act(&mut self, ctx: &Context, action: Action) {
        let state = &mut self.state;
        match action {
            Action::Command(command) => self.execute(ctx, command),
            Action::Tab(tab) => self.show(tab),
            Action::Kind(kind) => panels::operating_point::go_over(state, kind),
            Action::Lubricant(named) => panels::lubricant::take(state, named),
            Action::Scene(path) => state.request(ctx, Pending::Open(path)),
        }
        ctx.request_repaint();
    }

    pub(super) fn execute(&mut self, ctx: &Context, command: Command) {
        let state = &mut self.state;
        match command {
            Command::New => state.request(ctx, Pending::New),
            Command::Open => state.request(ctx, Pending::OpenDialog),
            Command::Save => state.save(ctx),
            Command::SaveAs => state.ask_path(ctx, Purpose::Save),
            Command::ExportPlot => state.ask_figure(),
            Command::ExportProfiles => {
                if let Some(text) = export::profiles(state) {
                    state.ask_path(ctx, Purpose::Csv { text });
                }
            }
            Command::Quit => ctx.send_viewport_cmd(ViewportCommand::Close),
            Command::Undo => {
                state.history.undo(&mut state.document);
                state.forget_entries();
            }
            Command::Redo => {
                state.history.redo(&mut state.document);
                state.forget_entries();
            }
            Command::CopyReadouts => ctx.copy_text(export::readouts_table(state)),
            Command::Pin => state.pin(),
            Command::Unpin => state.pins.clear(),
            Command::Palette => self.palette.open(ctx),
            Command::Presentation => self.present(ctx),
            Command::Overlay => {
                state.display.overlay = !state.display.overlay;
                self.show(Tab::Profiles);
            }
            Command::Difference => {
                state.display.difference = !state.display.difference;
                self.show(Tab::Profiles);
            }
            Command::FitPlots => state.fit_plots = true,
            Command::LightTheme => self.set_theme(ctx, ThemePreference::Light),
            Command::DarkTheme => self.set_theme(ctx, ThemePreference::Dark),
            Command::SystemTheme => self.set_theme(ctx, ThemePreference::System),
            Command::LargerText => self.set_zoom(self.state.display.zoom * 1.1),
            Command::SmallerText => self.set_zoom(self.state.display.zoom / 1.1),
            Command::NormalText => self.set_zoom(1.0),
            Command::ResetLayout => {
                self.tree = tabs::default_tree();
                self.state.fit_plots = true;
                ctx.memory_mut(|m| m.data.clear());
            }
            Command::Verify => state.verify(ctx),
            Command::EstimateGridError => state.estimate_grid_error(ctx),
            Command::SolveAlong => {
                if let Some((sweep, served)) = state.sweep() {
                    state.start_markers(ctx, &sweep, &served);
                    self.show(Tab::Traction);
                }
            }
            Command::RunInTime => {
                state.start_transient(ctx);
                self.show(Tab::Transient);
            }
            Command::Train => {
                state.start_training(ctx);
                self.show(Tab::Training);
            }
            Command::Cancel if self.help.manual.is_open() => self.help.manual.close(),
            Command::Cancel if state.presentation.is_some() => self.present(ctx),
            Command::Cancel => state.stop_all(),
            Command::Manual => self.help.manual.open(),
            Command::Keyboard => self.help.manual.open_keys(),
            Command::About => self.help.about = true,
        }
        ctx.request_repaint();
    }

    /// Brings a tab to the front.
    fn show(&mut self, wanted: Tab) {
        self.tree.make_active(|_, tile| matches!(tile, Tile::Pane(tab) if *tab == wanted));
    }

    /// Begins a presentation or ends it.
    fn present(&mut self, ctx: &Context) {
        match self.state.presentation.take() {
            Some(presentation) => presentation.end(ctx),
            None => self.state.presentation = Some(Presentation::begin(ctx)),
        }
    }

    fn set_theme(&mut self, ctx: &Context, theme: ThemePreference) {
        self.state.display.theme = theme;
        ctx.set_theme(theme);
    }

    fn set_zoom(&mut self, zoom: f32) {
        self.state.display.zoom = zoom.clamp(0.6, 3.0);
    }

    /// Sets the size of everything: as it was chosen, and larger in a presentation.
    pub(super) fn scale(&self, ctx: &Context) {
        let (present, chosen) = (ctx.zoom_factor(), self.state.display.zoom);
        let larger = self.state.presentation.map_or(1.0, |_| enlargement(ctx.content_rect().size() * present / chosen));
        let wanted = chosen * larger;
        if (wanted - present).abs() > 1e-3 {
            ctx.set_zoom_factor(wanted);
        }
    }
}
