//! Execution of commands and of choices in the palette.

use super::command::Command;
use super::context::Commands;
use super::controls::show;
use super::desk::files::Pending;
use super::display::Display;
use super::layouts::Layout;
use super::links::Fragment;
use super::notice::Notice;
use super::presentation::{Presentation, enlargement};
use super::purpose::Purpose;
use super::session::Place;
use super::tab::Tab;
use super::units::{self, Units};
use super::wake::wake;
use super::{Explorer, export};
use crate::app::animations::loads;
use crate::app::document::{Edit, Key};
use crate::app::refusal::Refusal;
use crate::app::tabs::transient::Setup;
use egui::{Context, ThemePreference, ViewportCommand};
use egui_tiles::Tile;

impl Explorer {
    /// Executes all commands of the list.
    pub(super) fn execute_all(&mut self, ctx: &Context, commands: &mut Commands) {
        for command in commands.take() {
            self.execute(ctx, command);
            ctx.request_repaint();
        }
    }

    fn execute(&mut self, ctx: &Context, command: Command) {
        let desk = &mut self.desk;
        match command {
            Command::New => desk.request(ctx, Pending::New),
            Command::Open => desk.request(ctx, Pending::OpenDialog),
            Command::Examples => self.examples.open(),
            Command::LoadCases => desk.load_cases.open(),
            Command::Measured => desk.measured.open(),
            Command::SolveCases(scene) => {
                desk.solve_cases(&scene, wake(ctx));
                self.show(Tab::Results);
            }
            Command::OpenLoadCases(text) => desk.load_cases.paste(text),
            Command::Machine(kind) => desk.machines.open(kind, &desk.document),
            Command::CopyLink => match Fragment::link(&desk.document, &self.tree) {
                Ok(link) => {
                    ctx.copy_text(link);
                    desk.files.notice = Some(Notice::Done("A link to this is on the clipboard".to_owned()));
                }
                Err(why) => desk.files.notice = Some(Notice::wrong(why)),
            },
            Command::OpenLink => self.link_window.open(),
            Command::OpenFragment(text) => desk.request(ctx, Pending::OpenLink(text)),
            Command::Save => desk.save(ctx),
            Command::SaveAs => desk.ask_path(ctx, Purpose::Save),
            Command::ExportFigures => desk.figures.ask(None, desk.display.units),
            Command::ExportFigure(tab) => desk.figures.ask(Some(tab), desk.display.units),
            Command::ExportProfiles => {
                if let Some(text) = export::profiles(&desk.answers, desk.display.cuts) {
                    self.execute(ctx, Command::csv(text));
                }
            }
            Command::AnimateRun => {
                let march = desk.transient.animated().map(|run| run.trajectory.clone());
                march.into_iter().for_each(|march| desk.animations.march(ctx, desk.answers.store(), march));
            }
            Command::AnimateLoad => {
                let scene = loads(&desk.document, &desk.answers);
                scene.into_iter().for_each(|scene| desk.animations.sweep(ctx, desk.answers.store(), scene));
            }
            Command::ExportReport(form) => {
                desk.reports.begin(ctx, (&desk.document, &desk.answers), form, desk.display.system);
            }
            Command::ExportWorksheet => match self.lessons.running().cloned() {
                Some(lesson) => {
                    if let Err(why) = desk.reports.begin_worksheet(ctx, (&desk.document, &desk.answers), lesson) {
                        desk.files.notice = Some(Notice::wrong(why));
                    }
                }
                None => {
                    let text = "A worksheet belongs to a lesson: open one first (Help, Lessons)";
                    desk.files.notice = Some(Notice::Done(text.to_owned()));
                    if !self.lessons.is_open() {
                        self.lessons.toggle();
                    }
                }
            },
            Command::FinishLesson(title) => {
                if !desk.finished.contains(&title) {
                    desk.finished.push(title);
                }
            }
            Command::Quit => ctx.send_viewport_cmd(ViewportCommand::Close),
            Command::Undo => {
                desk.history.undo(&mut desk.document);
                desk.entries.clear();
            }
            Command::Redo => {
                desk.history.redo(&mut desk.document);
                desk.entries.clear();
            }
            Command::CopyReadouts => ctx.copy_text(export::readouts_table(&desk.answers, desk.display.system)),
            Command::Pin => desk.answers.pin(),
            Command::SwapPin => {
                if let Some(Key { point, lubricant }) = desk.answers.swap_pin() {
                    desk.edit(Edit::Contact(point, Box::new(lubricant)), "contact");
                }
            }
            Command::Unpin => desk.answers.unpin_all(),
            Command::Settings => self.settings.open = true,
            Command::SetThresholds(thresholds) => desk.display.thresholds = thresholds,
            Command::Palette => self.palette.open(ctx),
            Command::Presentation => self.present(ctx),
            Command::Overlay => {
                let overlay = &mut desk.tabs.profiles.choices.overlay;
                *overlay = !*overlay;
                self.show(Tab::Profiles);
            }
            Command::Difference => {
                let difference = &mut desk.tabs.profiles.choices.difference;
                *difference = !*difference;
                self.show(Tab::Profiles);
            }
            Command::Arrange(layout) => {
                self.tree = layout.tree(ctx.content_rect().width());
                desk.tabs.regimes.choices.training_points = layout == Layout::ModelReduction;
                if layout == Layout::Engineer {
                    self.desk.display.units = Units::Dimensional;
                }
                self.hold_axes();
            }
            Command::Lessons => {
                self.lessons.toggle();
                self.hold_axes();
            }
            Command::PointAt(control) => show(ctx, control),
            Command::ShowWhy => desk.display.why = !desk.display.why,
            Command::FitPlots => desk.fit_plots = true,
            Command::SwitchUnits => desk.display.units = desk.display.units.other(),
            Command::Reports(settings) => desk.reports.settings = settings,
            Command::System(system) => {
                desk.display.system = system;
                // Texts that are being edited have the previous units.
                desk.entries.clear();
                units::set_system(ctx, system);
            }
            Command::LockAxes => {
                let front: Vec<Tab> = self.tabs_in_front().collect();
                let locked = !front.iter().all(|tab| self.desk.locked.contains(tab));
                front.into_iter().for_each(|tab| self.desk.lock(tab, locked));
            }
            Command::LockAxesOf(tab) => desk.lock(tab, !desk.locked.contains(&tab)),
            Command::Theme(theme) => {
                desk.display.theme = theme;
                ctx.set_theme(theme);
            }
            Command::PresentSliders(chosen) => desk.display.sliders = chosen,
            Command::LightPresentation => desk.display.light_presentation = !desk.display.light_presentation,
            Command::LargerText => self.set_zoom(self.desk.display.zoom * 1.1),
            Command::SmallerText => self.set_zoom(self.desk.display.zoom / 1.1),
            Command::NormalText => self.set_zoom(1.0),
            Command::ResetLayout => {
                self.tree = Layout::Explore.tree(ctx.content_rect().width());
                self.place.sliders = Place::default().sliders;
                self.desk.fit_plots = true;
                ctx.memory_mut(|m| m.data.clear());
            }
            Command::Verify => desk.answers.verify(ctx, &desk.document),
            Command::EstimateGridError => desk.answers.estimate_grid_error(ctx),
            Command::SolveAlong => {
                desk.tabs.traction.solve_along(ctx, &desk.document, &desk.answers);
                self.show(Tab::Traction);
            }
            Command::RunInTime => {
                let setup = Setup::of(&desk.document, desk.files.path.as_deref());
                desk.transient.start(ctx, desk.answers.store(), setup);
                self.show(Tab::Transient);
            }
            Command::Train => {
                desk.request(ctx, Pending::Train);
                self.show(Tab::Training);
            }
            Command::DiscardTraining => desk.request(ctx, Pending::DiscardTraining),
            Command::ThrowModelAway => desk.request(ctx, Pending::ThrowModelAway),
            Command::Cancel if self.settings.open => self.settings.open = false,
            Command::Cancel if self.examples.is_open() => self.examples.close(),
            Command::Cancel if desk.machines.is_open() => desk.machines.close(),
            Command::Cancel if desk.load_cases.is_open() => desk.load_cases.close(),
            Command::Cancel if desk.measured.is_open() => desk.measured.close(),
            Command::Cancel if self.help.about => self.help.about = false,
            Command::Cancel if self.help.manual.is_open() => self.help.manual.close(),
            Command::Cancel if self.lessons.is_open() => self.lessons.close(),
            Command::Cancel if desk.presentation.is_some() => self.present(ctx),
            Command::Cancel => desk.stop_all(),
            Command::Manual if self.help.manual.is_open() => self.help.manual.close(),
            Command::Manual => {
                let front = self.tabs_in_front().next();
                self.help.manual.open_at(front.map_or("start.md", |tab| self.desk.tabs.of(tab).about().page));
            }
            Command::Keyboard => self.help.manual.open_at("keyboard.md"),
            Command::About => self.help.about = true,
            Command::Transient(command) => desk.transient.execute(ctx, desk.answers.store(), command),
            Command::CompareModels => desk.tabs.training.work.compare(ctx, &desk.answers, &desk.document),
            Command::Training(command) => desk.tabs.training.work.execute(ctx, &mut desk.answers, command),
            Command::Edit(edit, field) => desk.edit(edit, field),
            Command::Refuse(field, why) => desk.entries.answer(field, Err(Refusal::new(why))),
            Command::Go(tab) => self.show(tab),
            Command::Cut(cuts) => desk.display.cuts = cuts,
            Command::RemovePin(place) => {
                desk.answers.unpin(place);
            }
            Command::UseModel(wanted) => _ = desk.answers.use_model(wanted.model),
            Command::OpenPath(path) => desk.request(ctx, Pending::Open(path)),
            Command::OpenScene(scene) => desk.request(ctx, Pending::OpenScene(scene)),
            Command::Ask(purpose) => desk.ask_path(ctx, purpose),
            Command::RunStudy => {
                desk.run_study(wake(ctx));
                self.show(Tab::Results);
            }
            Command::CloseHeadline => desk.headline = None,
            Command::Dismiss => desk.files.notice = None,
        }
    }

    /// Brings a tab to the front.
    pub(super) fn show(&mut self, wanted: Tab) {
        self.tree.make_active(|_, tile| matches!(tile, Tile::Pane(tab) if *tab == wanted));
    }

    /// Starts or ends the presentation mode.
    fn present(&mut self, ctx: &Context) {
        match self.desk.presentation.take() {
            Some(presentation) => {
                self.desk.locked = presentation.end(ctx);
                self.desk.fit_plots = true;
                ctx.set_theme(self.desk.display.theme);
            }
            None => {
                self.desk.presentation = Some(Presentation::begin(ctx, &self.desk.locked));
                self.hold_axes();
                if self.desk.display.light_presentation {
                    ctx.set_theme(ThemePreference::Light);
                }
            }
        }
    }

    /// Locks the axes of the tabs in front in a lecture, so that changes of the curves are visible. This applies to
    /// a presentation with several tabs in view or with an open lesson.
    fn hold_axes(&mut self) {
        let front: Vec<Tab> = self.tabs_in_front().collect();
        if self.desk.presentation.is_some() && (front.len() > 1 || self.lessons.is_open()) {
            front.into_iter().for_each(|tab| self.desk.lock(tab, true));
            self.desk.fit_plots = true;
        }
    }

    fn set_zoom(&mut self, zoom: f32) {
        let (least, most) = Display::ZOOMS;
        self.desk.display.zoom = zoom.clamp(least, most);
    }

    /// Sets the zoom factor: the chosen one, larger in a presentation.
    pub(super) fn scale(&self, ctx: &Context) {
        let (present, chosen) = (ctx.zoom_factor(), self.desk.display.zoom);
        let window = ctx.content_rect().size() * present / chosen;
        let presents = self.desk.presentation.is_some();
        let larger = if presents { enlargement(window, self.tabs_in_front().count()) } else { 1.0 };
        let wanted = chosen * larger;
        if (wanted - present).abs() > 1e-3 {
            ctx.set_zoom_factor(wanted);
        }
    }
}
