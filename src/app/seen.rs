//! Read access to the state of the window for tests.

use super::answers::PassedOver;
use super::tab::Tab;
use super::{Explorer, badge, panels};
use crate::scene::Table;
use crate::solver::full::Problem;
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::{Moes, OperatingPoint};
use crate::solver::physics::lubricant::Lubricant;

impl Explorer {
    /// Returns the contact on the screen.
    pub fn point(&self) -> OperatingPoint {
        self.desk.document.point
    }

    /// Returns M and L of the sliders.
    pub fn moes(&self) -> Moes {
        self.desk.document.point.moes()
    }

    /// Returns the load of the sliders, in N/m for a line contact and in N for a point contact.
    pub fn load(&self) -> f64 {
        self.desk.document.point.load
    }

    /// Returns H_c of the picture if it belongs to the sliders.
    pub fn central_film(&self) -> Option<f64> {
        self.desk.answers.current_picture().map(|p| p.solution.scalars.h_c)
    }

    /// Returns true if the contact of the sliders was requested and its picture, if there is one, was solved for
    /// that contact.
    pub fn answers_the_request(&self) -> bool {
        let (document, answers) = (&self.desk.document, &self.desk.answers);
        let asked = Problem::new(&document.point, document.lubricant);
        let solved = answers.current_picture().map(|picture| picture.solution.problem);
        answers.is_answer_to(document) && solved.is_none_or(|solved| asked == Ok(solved))
    }

    /// Returns true if the contact of the sliders is a point contact.
    pub fn is_point(&self) -> bool {
        self.desk.document.point.kind.is_point()
    }

    /// Returns the number of nodes along X and across of the picture's grid.
    pub fn nodes(&self) -> Option<(usize, usize)> {
        self.desk.answers.picture().map(|p| (p.solution.x.len(), p.solution.y.len()))
    }

    /// Returns the position of the cuts through a point contact: X of the profile across, Y of the profile along.
    pub fn cuts(&self) -> (f64, f64) {
        (self.desk.display.cuts.x, self.desk.display.cuts.y)
    }

    /// Returns the maximum pressures of the drawn profiles along X and, for a point contact, across.
    pub fn profile_peaks(&self) -> Option<(f64, Option<f64>)> {
        let peak = |curve: &[egui_plot::PlotPoint]| curve.iter().map(|p| p.y).reduce(f64::max);
        self.desk.answers.picture().and_then(|p| Some((peak(&p.pressure)?, peak(&p.across.pressure))))
    }

    /// Returns the estimated relative grid errors of H_c and H_min if they belong to the sliders.
    pub fn grid_errors(&self) -> Option<(f64, f64)> {
        self.desk.answers.grid_error().map(|error| (error.accuracy.h_c_error, error.accuracy.h_min_error))
    }

    /// Returns the title of the trust badge.
    pub fn badge(&self) -> String {
        badge::verdict(&self.desk.answers, self.desk.display.thresholds).title
    }

    /// Returns the text of the trust badge after its title, with symbols in braces.
    pub fn badge_detail(&self) -> String {
        badge::verdict(&self.desk.answers, self.desk.display.thresholds).detail
    }

    /// Returns whether the contact is inside the trained range, and the warnings of its picture, one sentence each.
    /// `None` without a picture.
    pub fn trust(&self) -> Option<(bool, Vec<String>)> {
        let answers = &self.desk.answers;
        let said = answers.current_picture()?.warnings.iter().map(ToString::to_string);
        match answers.passed_over() {
            None => Some((true, said.collect())),
            Some(PassedOver::Outside(why)) => Some((false, std::iter::once(why.clone()).chain(said).collect())),
            Some(_) => None,
        }
    }

    /// Returns true while a computation runs or waits.
    pub fn busy(&self) -> bool {
        self.desk.answers.busy()
    }

    /// Returns true while the study of the open scene runs.
    pub fn running_study(&self) -> bool {
        self.desk.tabs.results.standing().is_some()
    }

    /// Returns whether all expectations of the open scene were met. `None` before its study has ended.
    pub fn verdict(&self) -> Option<bool> {
        self.desk.tabs.results.verdict()
    }

    /// Returns a table of the open scene's study, as far as it is computed, as CSV.
    pub fn result_table(&self, name: &str) -> Option<String> {
        self.desk.tabs.results.table(name).map(Table::to_csv)
    }

    /// Returns the tab in front.
    pub fn front(&self) -> Option<&'static str> {
        self.tabs_in_front().next().map(Tab::title)
    }

    /// Returns true while a training or a comparison runs.
    pub fn training(&self) -> bool {
        self.desk.tabs.training.work.standing().is_some()
    }

    /// Returns the title of the reduced model in use.
    pub fn model_title(&self) -> Option<&str> {
        self.desk.model().map(|model| model.title.as_str())
    }

    /// Returns true while a study of the Accuracy tab runs.
    pub fn studying(&self) -> bool {
        self.desk.tabs.accuracy.works()
    }

    /// Returns true while a transient run is computed or waits.
    pub fn marching(&self) -> bool {
        self.desk.transient.standing().is_some() || self.desk.transient.waits()
    }

    /// Returns whether the transient contact on the screen is the requested one, the number of its complete runs,
    /// and how many of them use models that were made for a previous set-up.
    pub fn in_time(&self) -> (bool, usize, usize) {
        let view = &self.desk.transient;
        let ended = || view.runs.iter().filter(|run| run.ended);
        (view.is_current(), ended().count(), ended().filter(|run| run.replayed).count())
    }

    /// Returns true if the amplitude curve is that of the contact on the screen.
    pub fn has_amplitude_curve(&self) -> bool {
        self.desk.tabs.transient.amplitude().is_of(&self.desk.document)
    }

    /// Returns true while an animation is drawn.
    pub fn animating(&self) -> bool {
        self.desk.animations.standing().is_some()
    }

    /// Returns true while the study of the number of operating points runs.
    pub fn studying_points(&self) -> bool {
        self.desk.transient.number.work.standing().is_some()
    }

    /// Returns the number of operating points of the displayed linearised model.
    pub fn operating_points(&self) -> Option<usize> {
        self.desk.transient.linearised.as_ref().map(|linearised| linearised.model.points.len())
    }

    /// Returns the number of contacts of the traction curve if it is the requested one, and the number of full
    /// solutions drawn with it.
    pub fn traction_contacts(&self) -> (Option<usize>, usize) {
        let view = &self.desk.tabs.traction.sweeps;
        let curve = view.curve.as_ref().filter(|_| view.curve_is_current());
        (curve.map(|curve| curve.samples.len()), view.markers.as_ref().map_or(0, |markers| markers.samples.len()))
    }

    /// Returns true while full solutions along the traction curve are computed.
    pub fn solving_along(&self) -> bool {
        self.desk.tabs.traction.sweeps.full.standing().is_some()
    }

    /// Returns SRR and NPR of the sliders.
    pub fn sliding(&self) -> (f64, f64) {
        (self.desk.document.point.sliding.slide_to_roll_ratio, self.desk.document.plateau_ratio())
    }

    /// Returns the traction coefficient of the picture if it belongs to the sliders.
    pub fn traction(&self) -> Option<f64> {
        self.desk.answers.current_picture().map(|picture| picture.traction)
    }

    /// Returns the number of computed time steps of all transient runs.
    pub fn transient_moments(&self) -> usize {
        self.desk.transient.runs.iter().map(|run| run.trajectory.moments.len()).sum()
    }

    /// Returns what the last frame drew: the name, whether it belongs to the present request, and whether it is
    /// grey.
    pub fn drawn(&self) -> impl Iterator<Item = (&'static str, bool, bool)> {
        let context = self.desk.context();
        self.drawn.iter().map(move |drawn| (drawn.name, drawn.of.is_present(&context), drawn.grey))
    }

    /// Returns the laws of the lubricant on the screen.
    pub fn lubricant(&self) -> Lubricant {
        self.desk.document.lubricant
    }

    /// Returns the fields of the SI quantities with their accessible names.
    pub fn fields() -> [(Quantity, &'static str); 7] {
        panels::operating_point::FIELDS
    }

    /// Returns the quantities that were typed and stay fixed.
    pub fn held(&self) -> impl Iterator<Item = Quantity> {
        let all = Quantity::SI.into_iter().chain([Quantity::RadiusY]);
        all.filter(|quantity| self.desk.document.holds(*quantity))
    }

    /// Returns the time to build the last frame \[s\].
    pub fn frame_s(&self) -> f64 {
        self.frame_s
    }
}
