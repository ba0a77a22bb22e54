//! Data that all plots of a linearised model share in one frame.

use crate::app::context::Context;
use crate::app::numbers;
use crate::app::tabs::transient::linearised::{Linearised, PointNow};
use crate::app::tabs::transient::method::{WEIGHTINGS, weighting_name};
use crate::app::tabs::transient::{Run, TransientRuns};
use crate::app::theme::Palette;
use crate::solver::full::transient::Quantity;
use crate::solver::reduced::tpwl::Weighting;
use egui::{Color32, Pos2, Response};
use egui_plot::{PlotPoint, PlotTransform};

/// Minimum height of a readable plot.
pub const LEAST_HEIGHT: f32 = 118.0;
/// Maximum distance of the pointer from a point, in screen points.
const GRAB: f32 = 12.0;

/// Settings of the plots.
pub struct Choices {
    /// Quantity drawn along the training trajectory.
    pub quantity: Quantity,
    /// Coordinates of the plane, from 0. The last one is H_0.
    pub coordinates: [usize; 2],
    /// Index of the drawn training trajectory.
    pub trajectory: usize,
    /// True if the points of the other rule are shown instead of the table.
    pub other: bool,
}

impl Default for Choices {
    fn default() -> Self {
        Self { quantity: Quantity::CentralFilm, coordinates: [0, 1], trajectory: 0, other: false }
    }
}

/// Data that all plots of one frame share.
pub struct ShownModel<'a> {
    pub(super) view: &'a TransientRuns,
    pub(super) choices: &'a Choices,
    pub(super) linearised: &'a Linearised,
    pub(super) runs: Vec<(Weighting, &'a Run)>,
    /// Operating points at the displayed time.
    pub(super) points: Vec<PointNow>,
    pub(super) palette: Palette,
    pub(super) fit: bool,
}

impl<'a> ShownModel<'a> {
    pub fn new(palette: Palette, choices: &'a Choices, context: &Context<'a>, linearised: &'a Linearised) -> Self {
        let view = context.transient;
        let runs: Vec<_> = view.runs_of(linearised).collect();
        let points = linearised.points_at(&runs, view.player.time());
        Self { view, choices, linearised, runs, points, palette, fit: context.fit }
    }

    /// Returns the operating points of the drawn trajectory.
    pub(super) fn of_trajectory(&self) -> impl Iterator<Item = &PointNow> {
        self.points.iter().filter(|now| {
            let trained = self.linearised.model.points.get(now.point);
            trained.is_some_and(|trained| trained.trajectory == self.choices.trajectory)
        })
    }

    /// Returns the colour of a weighting, by its index in [`WEIGHTINGS`].
    pub(super) fn color(&self, weighting: usize) -> Color32 {
        [self.palette.accent, self.palette.warning][weighting]
    }

    /// Returns true if a weighting, by its index in [`WEIGHTINGS`], was run.
    pub(super) fn was_run(&self, weighting: usize) -> bool {
        self.runs.iter().any(|(own, _)| *own == WEIGHTINGS[weighting])
    }

    /// Returns true if a weighting is part of this set-up, even if it has not been run yet. Its place in the plots
    /// is reserved.
    pub(super) fn is_run(&self, weighting: usize) -> bool {
        let linearised = self.view.setup.as_ref().and_then(|setup| setup.study.linearised.as_ref());
        linearised.is_some_and(|linearised| linearised.weightings.contains(&WEIGHTINGS[weighting]))
    }
}

/// Returns the point nearest to the pointer on the screen, if it is near enough.
pub fn near<T>(places: impl Iterator<Item = (T, PlotPoint)>, transform: &PlotTransform, pointer: Pos2) -> Option<T> {
    let distance = |place: &PlotPoint| transform.position_from_point(place).distance(pointer);
    let measured = places.map(|(what, place)| (what, distance(&place)));
    measured.filter(|(_, d)| *d < GRAB).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(what, _)| what)
}

/// Returns the weights of a point as text.
pub fn weights_text(shown: &ShownModel<'_>, now: &PointNow) -> String {
    let each = (0..WEIGHTINGS.len()).filter(|&k| shown.was_run(k));
    let said = each.map(|k| format!("{} {}", weighting_name(WEIGHTINGS[k]).0, numbers::digits(now.weights[k], 3)));
    said.collect::<Vec<_>>().join(", ")
}

/// Shows a tooltip for the operating point under the pointer. Returns its time if it is clicked.
pub fn point_under(shown: &ShownModel<'_>, response: Response, under: Option<&PointNow>) -> Option<f64> {
    let (now, trained) = under.and_then(|now| Some((now, shown.linearised.model.points.get(now.point)?)))?;
    let clicked = response.clicked();
    response.on_hover_text_at_pointer(format!(
        "Operating point {}, T = {}\nWeights: {}\nClick to go to its time",
        now.point + 1,
        numbers::significant(trained.moment.time),
        weights_text(shown, now)
    ));
    if clicked { shown.linearised.moment_of(now.point, &shown.runs) } else { None }
}
