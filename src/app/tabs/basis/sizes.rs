//! Plots of error and time against the numbers of modes and of sampled equations. Both numbers can be dragged.

use super::field::TRUNCATION;
use crate::app::command::Command;
use crate::app::context::{Commands, Context};
use crate::app::controls::{message_ui, standing_ui};
use crate::app::document::{Edit, Key};
use crate::app::drawn::{self, Owner};
use crate::app::in_use::{InUse, question};
use crate::app::plot::axes;
use crate::app::plot::grip::Grip;
use crate::app::theme::Palette;
use crate::app::{export, numbers};
use crate::engine::job::{Background, Standing};
use crate::scene::study::model_sizes::{ModelSizes, Row, Varied};
use crate::scene::{Grid, ModelSource, Study, StudyRow, View};
use crate::solver::reduced::{ReducedModel, Window};
use egui::Ui;
use egui_plot::{HoverPosition, Line, MarkerShape, PlotPoint, PlotPoints, Points, VLine};
use std::sync::Arc;

/// Seed of the contacts.
const SEED: u64 = 5;
/// Number of tested numbers of modes.
const MODES: usize = 9;
/// Tested numbers of sampled equations per mode.
const ROWS_PER_MODE: [f64; 5] = [1.0, 1.25, 1.5, 2.0, 3.0];
/// Distance in screen points within which the pointer can grab a number.
const GRAB: f32 = 9.0;

/// Results for a local model.
#[derive(Default)]
pub struct Sizes {
    /// Model before its sampled equations were changed, and the index of its local model.
    of: Option<(Arc<ReducedModel>, usize)>,
    rows: Vec<Row>,
    work: Background<StudyRow>,
}

impl Sizes {
    /// Returns the progress of the study.
    pub fn standing(&self) -> Option<Standing> {
        self.work.standing()
    }

    pub fn stop(&self) {
        self.work.stop();
    }

    /// Receives results since the last frame.
    pub fn receive(&mut self) {
        let rows = &mut self.rows;
        self.work.receive(|row| {
            if let StudyRow::ModelSizes(row) = row {
                rows.push(row);
            }
        });
    }

    /// Requests the study of a local model, unless it has been requested already.
    fn follow(&mut self, ui: &Ui, context: &Context<'_>, model: &Arc<ReducedModel>, window: usize) {
        let same = |other: &Arc<ReducedModel>| Arc::ptr_eq(other, model);
        let resampled = self.rows.iter().filter_map(|row| row.model.as_ref()).any(same);
        if self.of.as_ref().is_some_and(|(base, k)| *k == window && (same(base) || resampled)) {
            return;
        }
        let contacts = if model.contact().is_line() { 16 } else { 4 };
        let study = ModelSizes {
            model: ModelSource::Embedded,
            contacts,
            seed: SEED,
            modes: MODES,
            rows_per_mode: ROWS_PER_MODE.to_vec(),
        };
        let key = Key { point: context.document.point, lubricant: model.domain.lubricant };
        let question = question("Modes and equations", &key, Grid::Model, Study::ModelSizes(study));
        let in_use = InUse::new(model, &View::default());
        *self = Self { of: Some((Arc::clone(model), window)), ..Self::default() };
        self.work.run(in_use.ask(ui.ctx(), context.answers.store(), question));
    }

    /// Returns all results of a kind. The model itself is included among the numbers of sampled equations.
    fn varied(&self, varied: Varied) -> Vec<&Row> {
        let own = self.rows.iter().rfind(|row| row.varied == Varied::Modes).filter(|_| varied == Varied::Rows);
        let mut found: Vec<&Row> = self.rows.iter().filter(|row| row.varied == varied).chain(own).collect();
        found.sort_by_key(|row| size(row, varied));
        found
    }

    /// Returns the model with the number of sampled equations nearest to the wanted one.
    fn with_rows(&self, wanted: f64) -> Option<&Arc<ReducedModel>> {
        let (base, _) = self.of.as_ref()?;
        let far = |row: &&&Row| (row.rows as f64 / wanted).ln().abs();
        let nearest = self.varied(Varied::Rows);
        let nearest = nearest.iter().min_by(|a, b| far(a).total_cmp(&far(b)))?;
        Some(nearest.model.as_ref().unwrap_or(base))
    }
}

/// Returns the number on the horizontal axis.
fn size(row: &Row, varied: Varied) -> usize {
    if varied == Varied::Modes { row.modes } else { row.rows }
}

/// Column of plots: the varied number, the title of its axis, and the present number of the model.
struct Column {
    varied: Varied,
    axis: &'static str,
    present: usize,
    /// True if its curves were computed with other settings than those in use.
    grey: bool,
}

/// Draws the curves.
pub fn ui(
    ui: &mut Ui,
    own: &mut Sizes,
    context: &Context<'_>,
    commands: &mut Commands,
    (model, at, window): (&Arc<ReducedModel>, usize, &Window),
) {
    own.follow(ui, context, model, at);
    let modes = context.answers.options(context.document).pressure_modes.unwrap_or(window.pressure.count());
    ui.horizontal_wrapped(|ui| {
        let label = ui
            .label("Median (line) and maximum (dots) of random contacts of this local model. Drag the vertical lines");
        let tip = "Numbers of modes are tested with the model’s own equations, numbers of equations with all modes, \
                   both with the exact deformation. Grey: not the settings in use";
        label.on_hover_text(tip);
        if ui.add_enabled(!own.rows.is_empty(), egui::Button::new("Export sizes…")).clicked() {
            commands.push(Command::csv(csv(own)));
        }
        let (base, _) = own.of.as_ref().map_or((None, 0), |(base, k)| (Some(base), *k));
        let changed = base.filter(|base| !Arc::ptr_eq(base, model));
        let back = ui.add_enabled(changed.is_some(), egui::Button::new("The model’s own equations"));
        if let (true, Some(base)) = (back.clicked(), changed) {
            commands.push(Command::UseModel(InUse::new(base, &context.document.view)));
        }
        standing_ui(ui, own.standing(), "Progress of the sizes");
    });
    if let Some(message) = &own.work.message {
        message_ui(ui, message);
    }
    // Owners of the curves: the original model with any number of modes, and the model with any number of sampled
    // equations and all modes.
    let any_modes = View { pressure_loss: context.document.view.pressure_loss, ..View::default() };
    let made = own.of.as_ref().map_or(model, |(base, _)| base);
    let grey = |name: &'static str, of: InUse| drawn::is_grey(ui.ctx(), name, Owner::Model(of), context);
    let grey = [
        grey("sizes by modes", InUse::new(made, &any_modes)),
        grey("sizes by rows", InUse::new(model, &View::default())),
    ];
    let columns = [
        Column { varied: Varied::Modes, axis: "Pressure modes {k}", present: modes, grey: grey[0] },
        Column { varied: Varied::Rows, axis: "Sampled equations", present: window.sampled_rows.len(), grey: grey[1] },
    ];
    let height = (0.5 * ui.available_height() - 4.0).max(80.0);
    let width = 0.5 * ui.available_width() - 6.0;
    ui.horizontal_top(|ui| {
        for column in columns {
            let moved = ui.vertical(|ui| {
                ui.set_width(width);
                let moved = plot(ui, own, &column, true, height, context.fit);
                plot(ui, own, &column, false, height, context.fit).or(moved)
            });
            let Some(to) = moved.inner else { continue };
            match column.varied {
                Varied::Modes => {
                    let most = window.pressure.count();
                    let wanted = (to.round().max(1.0) as usize).min(most);
                    // The loss is slightly increased, so that rounding errors do not remove a mode.
                    let loss = (wanted < most).then(|| window.pressure.basis().loss(wanted) * (1.0 + 1e-6));
                    let view = View { pressure_loss: loss, ..context.document.view.clone() };
                    if view != context.document.view {
                        commands.edit(Edit::View(view.into()), TRUNCATION);
                    }
                }
                Varied::Rows => {
                    if let Some(wanted) = own.with_rows(to.max(1.0)).filter(|wanted| !Arc::ptr_eq(wanted, model)) {
                        commands.push(Command::UseModel(InUse::new(wanted, &context.document.view)));
                    }
                }
            }
        }
    });
}

/// Draws errors or times of a column. Returns the number to which the user drags the present one.
fn plot(ui: &mut Ui, own: &Sizes, column: &Column, errors: bool, height: f32, fit: bool) -> Option<f64> {
    let palette = Palette::of(ui);
    let Column { varied, axis, present, grey } = *column;
    let (y_title, what) = if errors { ("Error of {H_c}", "Error") } else { ("Time [ms]", "Time") };
    let against = if varied == Varied::Modes { "modes" } else { "equations" };
    let name = format!("{what} against {against}");
    let rows = own.varied(varied);
    let point = |row: &&Row, value: f64| [size(row, varied) as f64, if errors { value.log10() } else { 1e3 * value }];
    let of = |k: usize| -> Vec<[f64; 2]> {
        let points = rows.iter().map(|row| point(row, row.summary()[k]));
        points.filter(|[_, y]| y.is_finite()).collect()
    };
    let (middle, largest) = if errors { (of(0), of(1)) } else { (of(2), Vec::new()) };
    let color = match errors {
        _ if grey => palette.reference,
        true => palette.pressure,
        false => palette.accent,
    };
    let grip = Grip::new("sizes", &name);
    let mut drawn = axes::plot(ui, &name, height, if errors { "" } else { axis }, y_title)
        .allow_drag(!grip.is_held(ui))
        .label_formatter(move |hover| match hover {
            HoverPosition::NearDataPoint { position, .. } if errors => {
                Some(format!("{:.0} {against}\n{}", position.x, numbers::error_percent(10f64.powf(position.y))))
            }
            HoverPosition::NearDataPoint { position, .. } => {
                Some(format!("{:.0} {against}\n{} ms", position.x, numbers::digits(position.y, 3)))
            }
            HoverPosition::Elsewhere { .. } => None,
        });
    if errors {
        drawn = drawn.decades_y(8.0);
    } else {
        drawn = drawn.include_y(0.0);
    }
    let held = grip.is_held(ui);
    let shown = axes::show(drawn, ui, &name, |plot| {
        axes::fit(plot, fit);
        let dots = Points::new("median", PlotPoints::from(middle.clone())).id("medians").color(color).radius(2.5);
        plot.line(Line::new("median", PlotPoints::from(middle)).color(color).width(2.0));
        plot.points(dots);
        let crosses = Points::new("largest", PlotPoints::from(largest)).color(palette.reference).radius(3.0);
        plot.points(crosses.shape(MarkerShape::Diamond));
        let line = VLine::new("", present as f64).id("present").color(palette.accent);
        plot.vline(line.width(if held { 2.6 } else { 1.6 }).allow_hover(false));
    });
    let place = shown.transform.position_from_point(&PlotPoint::new(present as f64, 0.0)).x;
    let near = shown.response.hover_pos().is_some_and(|pointer| (pointer.x - place).abs() < GRAB);
    if near || held {
        ui.ctx().set_cursor_icon(egui::CursorIcon::ResizeHorizontal);
    }
    let pointer = grip.follow(ui, near && !rows.is_empty())?;
    Some(shown.transform.value_from_position(pointer).x)
}

fn csv(own: &Sizes) -> String {
    let row = |row: &Row| {
        let [middle, largest, seconds] = row.summary();
        let numbers = [row.modes as f64, row.rows as f64, row.failures as f64, middle, largest, seconds];
        numbers.map(Some).to_vec()
    };
    let header = ["modes", "equations", "failures", "H_c_error_median", "H_c_error_max", "median_s"];
    let comment = own.of.as_ref().map_or_else(String::new, |(model, window)| {
        format!("{}, window {}, random contacts with seed {SEED}", model.title, window + 1)
    });
    export::csv(&[comment], &header, own.rows.iter().map(row))
}
