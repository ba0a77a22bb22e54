//! Transient tab: the inputs of the contact, the response of film thickness and pressure, and the difference
//! between frames.

use super::amplitude::AmplitudeCurve;
use super::features::{self, Features};
use super::plane_map::PlaneMap;
use super::runs::{TransientCommand, TransientRuns};
use super::{badge, cost, dials, form, profiles};
use crate::app::command::Command;
use crate::app::context::{Commands, Context};
use crate::app::form::LastField;
use crate::app::tabs::transient::space_time::{self, SpaceTime};
use crate::app::tabs::transient::{export, series, shared};
use crate::app::tabs::{About, Offer, View, view};
use crate::engine::job::Standing;
use crate::solver::physics::contact::ContactKind;
use egui::Ui;
use serde::{Deserialize, Serialize};

/// Width of the form.
const FORM_WIDTH: f32 = 300.0;
/// Width from which the profiles are placed next to the time series.
const SIDE_BY_SIDE: f32 = 560.0;
/// Height of the rows above the time series, with the space between plots.
const HEADS: f32 = 48.0;
/// Minimum height of a readable plot.
const LEAST_HEIGHT: f32 = 96.0;

/// Form next to the plots.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Pane {
    /// Inputs, steps, frames and methods.
    SetUp,
    /// Features of the surfaces.
    Surfaces,
}

/// Content of the tab.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
enum Page {
    /// Runs of the transient contact.
    #[default]
    Runs,
    /// Amplitude of wavy surfaces over the wavelength.
    Amplitude,
}

/// Transient tab: its forms with the state of their entries, and its plots.
#[derive(Default)]
pub struct Transient {
    page: Page,
    pane: Option<Pane>,
    last: LastField,
    features: Features,
    along: series::Along,
    map: SpaceTime,
    plane: PlaneMap,
    amplitude: AmplitudeCurve,
}

const ABOUT: About = About {
    keywords: "time load speed radius frames cam gear harmonic surfaces dent bump ridge wave roughness amplitude reduction",
    page: "transient.md",
    has_units: true,
    why: "When load, speed or curvature change quickly, the contact still contains oil that entered before the change. \
          A change of film thickness in the inlet travels through the contact at the mean speed of the surfaces and \
          reaches the outlet later. Film thickness and load are therefore out of phase, and the phase shift grows with \
          the rate of change.",
};

impl View for Transient {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn ui(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        if self.page == Page::Amplitude {
            ui.horizontal_wrapped(|ui| self.page_button(ui));
            self.amplitude.ui(ui, context, commands);
            return;
        }
        let page = ("transient", self.pane.map(|_| FORM_WIDTH), context.document.no_transient());
        let form = |tab: &mut Self, ui: &mut Ui, commands: &mut Commands| match tab.pane {
            Some(Pane::Surfaces) => tab.features.ui(ui, context, commands),
            Some(Pane::SetUp) | None => form::ui(ui, &mut tab.last, context, commands),
        };
        shared::page(ui, self, page, (context, commands), form, |tab, ui, commands| tab.results(ui, context, commands));
    }

    fn offers<'a>(&'a self, context: &Context<'a>) -> Vec<Offer<'a>> {
        let view = context.transient;
        let there = view.runs.iter().any(|run| !run.trajectory.moments.is_empty()).then_some(view);
        type Text = fn(&TransientRuns) -> Option<String>;
        let table = |name, tip, text: Text| {
            Offer::table(name, tip, there, move |view: &&TransientRuns| text(view).unwrap_or_default())
        };
        let tip = "All time steps of every run, dimensionless and in SI units, each run in separate columns";
        vec![
            table("Series as CSV…", tip, export::series),
            table(
                "Profiles as CSV…",
                "Pressure and film thickness of every run at the displayed time",
                export::profiles,
            ),
            space_time::offer(context),
            Offer::new(
                "Animation as APNG…",
                "The first full run as a film of 960×540 pixels for slides and web pages",
                view.animated().map(|_| || Command::AnimateRun),
            ),
            self.amplitude.offer(),
        ]
    }

    fn caption(&self, context: &Context<'_>) -> Option<String> {
        match self.page {
            Page::Runs => shared::caption(context.transient, context.system),
            Page::Amplitude => self.amplitude.caption(context.system),
        }
    }

    fn receive(&mut self) {
        self.amplitude.receive();
    }

    fn jobs(&self, context: &Context<'_>) -> Vec<Standing> {
        let runs = context.transient;
        let following = [runs.replaying(), self.amplitude.standing()].into_iter().filter_map(view::lasting);
        runs.standing().into_iter().chain(following).collect()
    }

    fn stop(&mut self) {
        self.amplitude.stop();
    }

    fn kept(&self) -> Option<String> {
        view::kept(&self.page)
    }

    fn restore(&mut self, text: &str) -> bool {
        view::restore(&mut self.page, text, |_| true)
    }
}

impl Transient {
    fn results(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        let (top, height) = (ui.cursor().top(), ui.available_height());
        self.buttons(ui, context, commands);
        ui.horizontal_wrapped(|ui| {
            dials::ui(ui, context, commands);
            badge::ui(ui, context);
        });
        let of_dials = [("transient", Pane::SetUp), (features::NAME, Pane::Surfaces)];
        let hidden = of_dials.into_iter().filter(|(_, pane)| self.pane != Some(*pane));
        shared::status(ui, context, hidden.filter_map(|(name, _)| context.entries.message(name)));
        let view = context.transient;
        // Runs of a line contact say nothing about a ball.
        let other = view.setup.as_ref().is_some_and(|setup| setup.point.kind != context.document.point.kind);
        if other || view.runs.iter().all(|run| run.trajectory.moments.is_empty()) {
            if !shared::is_coming(context) {
                ui.weak("Press Run transient to see how pressure and film thickness follow the inputs.");
            }
            return;
        }
        let rest = height - (ui.cursor().top() - top);
        let wanted = ui.vertical(|ui| {
            shared::grey_where_stale(ui, context, "contact in time");
            let room = rest - cost::height(view);
            let wanted = self.plots(ui, context, room);
            ui.allocate_ui([ui.available_width(), cost::height(view)].into(), |ui| {
                ui.set_min_height(cost::height(view));
                cost::ui(ui, view);
            });
            wanted
        });
        commands.extend(wanted.inner.map(|time| Command::Transient(TransientCommand::GoTo(time))));
    }

    fn buttons(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        ui.horizontal_wrapped(|ui| {
            for (pane, name, tip) in [
                (Pane::SetUp, "Set-up", "Shows or hides the inputs of the contact"),
                (
                    Pane::Surfaces,
                    "Moving surfaces",
                    "Shows or hides dents, bumps and waves that move through the contact",
                ),
            ] {
                let mut on = self.pane == Some(pane);
                if ui.toggle_value(&mut on, name).on_hover_text(tip).clicked() {
                    self.pane = on.then_some(pane);
                }
            }
            self.page_button(ui);
            shared::run_button(ui, context, commands);
        });
    }

    /// Returns the amplitude curve.
    pub fn amplitude(&self) -> &AmplitudeCurve {
        &self.amplitude
    }

    /// Draws the button that switches between runs and amplitude curve.
    fn page_button(&mut self, ui: &mut Ui) {
        let mut on = self.page == Page::Amplitude;
        let tip = "What remains in the film of a wavy surface, over its wavelength";
        if ui.toggle_value(&mut on, "Amplitude curve").on_hover_text(tip).clicked() {
            self.page = if on { Page::Amplitude } else { Page::Runs };
        }
    }
}

impl Transient {
    /// Draws the map over space and time, or that of a point contact, next to the profiles, and the time series below.
    /// Returns the time of a click.
    fn plots(&mut self, ui: &mut Ui, context: &Context<'_>, height: f32) -> Option<f64> {
        let view = context.transient;
        let several = view.setup.as_ref().is_some_and(|setup| setup.runs() > 1);
        let parts = if several { [0.5, 0.28, 0.22] } else { [0.58, 0.42, 0.0] };
        let [upper, middle, lower] = parts.map(|part| (part * (height - HEADS)).max(LEAST_HEIGHT));
        let upper = upper.max(2.0 * LEAST_HEIGHT);
        let width = ui.available_width();
        let kind = view.setup.as_ref().map_or(ContactKind::Line, |setup| setup.point.kind);
        let draw_map = |tab: &mut Self, ui: &mut Ui| {
            if kind.is_line() { tab.map.ui(ui, context, upper) } else { tab.plane.ui(ui, context, &mut tab.map, upper) }
        };
        let map = if width < SIDE_BY_SIDE {
            let map = draw_map(self, ui);
            profiles::ui(ui, view, context.fit, 0.5 * upper);
            map
        } else {
            let both = ui.horizontal_top(|ui| {
                let map = ui.vertical(|ui| {
                    ui.set_width(0.5 * width);
                    draw_map(self, ui)
                });
                ui.vertical(|ui| profiles::ui(ui, view, context.fit, 0.5 * upper));
                map.inner
            });
            both.inner
        };
        let series = self.along.ui(ui, view, middle, several);
        let deviation = if several { self.along.deviation(ui, view, lower) } else { None };
        map.or(series).or(deviation)
    }
}
