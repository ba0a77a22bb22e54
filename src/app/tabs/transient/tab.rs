//! Transient tab: the inputs of the contact, the response of film thickness and pressure, and the difference
//! between frames.

use super::runs::{TransientCommand, TransientRuns};
use super::{badge, cost, dials, form, profiles};
use crate::app::command::Command;
use crate::app::context::{Commands, Context};
use crate::app::form::LastField;
use crate::app::tabs::transient::space_time::{self, SpaceTime};
use crate::app::tabs::transient::{export, series, shared};
use crate::app::tabs::{About, Offer, View, view};
use crate::engine::job::Standing;
use egui::Ui;

/// Width of the form.
const FORM_WIDTH: f32 = 300.0;
/// Width from which the profiles are placed next to the time series.
const SIDE_BY_SIDE: f32 = 560.0;
/// Height of the rows above the time series, with the space between plots.
const HEADS: f32 = 48.0;
/// Minimum height of a readable plot.
const LEAST_HEIGHT: f32 = 96.0;

/// Transient tab: its form with the state of its entries, and its plots.
#[derive(Default)]
pub struct Transient {
    form: bool,
    last: LastField,
    along: series::Along,
    map: SpaceTime,
}

const ABOUT: About = About {
    keywords: "time load speed radius frames cam gear harmonic",
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
        let page = ("transient", self.form.then_some(FORM_WIDTH));
        let form = |tab: &mut Self, ui: &mut Ui, commands: &mut Commands| {
            form::ui(ui, &mut tab.last, context, commands);
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
        ]
    }

    fn caption(&self, context: &Context<'_>) -> Option<String> {
        shared::caption(context.transient, context.system)
    }

    fn jobs(&self, context: &Context<'_>) -> Vec<Standing> {
        let runs = context.transient;
        runs.standing().into_iter().chain(view::lasting(runs.replaying())).collect()
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
        shared::status(ui, context, context.entries.message("transient").filter(|_| !self.form));
        let view = context.transient;
        if view.runs.iter().all(|run| run.trajectory.moments.is_empty()) {
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
            ui.toggle_value(&mut self.form, "Set-up").on_hover_text("Shows or hides the inputs of the contact");
            shared::run_button(ui, context, commands);
        });
    }
}

impl Transient {
    /// Draws the map over space and time next to the profiles, and the time series below. Returns the time of a
    /// click.
    fn plots(&mut self, ui: &mut Ui, context: &Context<'_>, height: f32) -> Option<f64> {
        let view = context.transient;
        let several = view.setup.as_ref().is_some_and(|setup| setup.runs() > 1);
        let parts = if several { [0.5, 0.28, 0.22] } else { [0.58, 0.42, 0.0] };
        let [upper, middle, lower] = parts.map(|part| (part * (height - HEADS)).max(LEAST_HEIGHT));
        let upper = upper.max(2.0 * LEAST_HEIGHT);
        let width = ui.available_width();
        let map = if width < SIDE_BY_SIDE {
            let map = self.map.ui(ui, context, upper);
            profiles::ui(ui, view, context.fit, 0.5 * upper);
            map
        } else {
            let both = ui.horizontal_top(|ui| {
                let map = ui.vertical(|ui| {
                    ui.set_width(0.5 * width);
                    self.map.ui(ui, context, upper)
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
