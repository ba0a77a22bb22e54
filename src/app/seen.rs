//! What the window shows and does, for those who look at it from outside: the tests.

use super::answers::PassedOver;
use super::tab::Tab;
use super::{Explorer, badge, panels};
use crate::scene::Table;
use crate::solver::full::Problem;
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::{ContactKind, Moes, OperatingPoint};
use crate::solver::physics::lubricant::Lubricant;

impl Explorer {
    /// The contact on the screen.
    pub fn point(&self) -> OperatingPoint {
        self.desk.document.point
    }

    /// M and L of the sliders.
    pub fn moes(&self) -> Moes {
        self.desk.document.point.moes()
    }

    /// The load of the sliders: in N/m of a line contact, in N of a point contact.
    pub fn load(&self) -> f64 {
        self.desk.document.point.load
    }

    /// H_c of the picture, when it belongs to the sliders.
    pub fn central_film(&self) -> Option<f64> {
        self.desk.answers.current_picture().map(|p| p.solution.scalars.h_c)
    }

    /// True if the contact of the sliders was asked for, and its picture, if there is one, was solved for that contact.
    pub fn answers_the_request(&self) -> bool {
        let (document, answers) = (&self.desk.document, &self.desk.answers);
        let asked = Problem::new(&document.point, document.lubricant);
        let solved = answers.current_picture().map(|picture| picture.solution.problem);
        answers.is_answer_to(document) && solved.is_none_or(|solved| asked == Ok(solved))
    }

    /// Whether the contact of the sliders is a point contact.
    pub fn is_point(&self) -> bool {
        self.desk.document.point.kind == ContactKind::Point
    }

    /// Nodes along X and across of the picture's grid.
    pub fn nodes(&self) -> Option<(usize, usize)> {
        self.desk.answers.picture().map(|p| (p.solution.x.len(), p.solution.y.len()))
    }

    /// Where the profiles cut a point contact: X of the one across, Y of the one along.
    pub fn cuts(&self) -> (f64, f64) {
        (self.desk.display.cuts.x, self.desk.display.cuts.y)
    }

    /// Largest pressures of the drawn profiles: along X, and across where there is one.
    pub fn profile_peaks(&self) -> Option<(f64, Option<f64>)> {
        let peak = |curve: &[egui_plot::PlotPoint]| curve.iter().map(|p| p.y).reduce(f64::max);
        self.desk.answers.picture().and_then(|p| Some((peak(&p.pressure)?, peak(&p.across.pressure))))
    }

    /// Estimated relative grid errors of H_c and H_min, when they belong to the sliders.
    pub fn grid_errors(&self) -> Option<(f64, f64)> {
        self.desk.answers.grid_error().map(|error| (error.accuracy.h_c_error, error.accuracy.h_min_error))
    }

    /// The first words of the trust badge.
    pub fn badge(&self) -> String {
        badge::verdict(&self.desk.answers, self.desk.display.thresholds).title
    }

    /// What the trust badge says after its first words; symbols stand in braces.
    pub fn badge_detail(&self) -> String {
        badge::verdict(&self.desk.answers, self.desk.display.thresholds).detail
    }

    /// Whether a reduced model was trained for the contact, and what a reader must know of its picture, one sentence each;
    /// `None` until the picture is there.
    pub fn trust(&self) -> Option<(bool, Vec<String>)> {
        let answers = &self.desk.answers;
        let said = answers.current_picture()?.warnings.iter().map(ToString::to_string);
        match answers.passed_over() {
            None => Some((true, said.collect())),
            Some(PassedOver::Outside(why)) => Some((false, std::iter::once(why.clone()).chain(said).collect())),
            Some(_) => None,
        }
    }

    /// Whether a computation runs or waits.
    pub fn busy(&self) -> bool {
        self.desk.answers.busy()
    }

    /// Whether the study of the open scene runs.
    pub fn running_study(&self) -> bool {
        self.desk.tabs.results.standing().is_some()
    }

    /// Whether all expectations of the open scene were met, once its study has ended.
    pub fn verdict(&self) -> Option<bool> {
        self.desk.tabs.results.verdict()
    }

    /// The table of a name that the study of the open scene has given so far, as CSV.
    pub fn result_table(&self, name: &str) -> Option<String> {
        self.desk.tabs.results.table(name).map(Table::to_csv)
    }

    /// The tab in front.
    pub fn front(&self) -> Option<&'static str> {
        self.tabs_in_front().next().map(Tab::title)
    }

    /// Whether a training or a comparison runs.
    pub fn training(&self) -> bool {
        self.desk.tabs.training.work.standing().is_some()
    }

    /// Title of the reduced model in use.
    pub fn model_title(&self) -> Option<&str> {
        self.desk.model().map(|model| model.title.as_str())
    }

    /// Whether a study of the Accuracy tab runs.
    pub fn studying(&self) -> bool {
        self.desk.tabs.accuracy.works()
    }

    /// Whether a contact is taken through time, or about to be.
    pub fn marching(&self) -> bool {
        self.desk.transient.standing().is_some() || self.desk.transient.waits()
    }

    /// Whether the contact in time on the screen is the one that is wanted, by how many methods and frames it is there
    /// to its end, and how many of them are models that were made for a former set-up.
    pub fn in_time(&self) -> (bool, usize, usize) {
        let view = &self.desk.transient;
        let ended = || view.runs.iter().filter(|run| run.ended);
        (view.is_current(), ended().count(), ended().filter(|run| run.replayed).count())
    }

    /// Whether the number of operating points is studied.
    pub fn studying_points(&self) -> bool {
        self.desk.transient.number.work.standing().is_some()
    }

    /// Operating points of the linearised model that is shown.
    pub fn operating_points(&self) -> Option<usize> {
        self.desk.transient.linearised.as_ref().map(|linearised| linearised.model.points.len())
    }

    /// Contacts of the traction curve on the screen, when it is the one that was asked for last, and full solutions
    /// beside it.
    pub fn traction_contacts(&self) -> (Option<usize>, usize) {
        let view = &self.desk.tabs.traction.sweeps;
        let curve = view.curve.as_ref().filter(|_| view.curve_is_current());
        (curve.map(|curve| curve.samples.len()), view.markers.as_ref().map_or(0, |markers| markers.samples.len()))
    }

    /// Whether full solutions along the traction curve are being computed.
    pub fn solving_along(&self) -> bool {
        self.desk.tabs.traction.sweeps.full.standing().is_some()
    }

    /// SRR and NPR of the sliders.
    pub fn sliding(&self) -> (f64, f64) {
        (self.desk.document.point.sliding.slide_to_roll_ratio, self.desk.document.plateau_ratio())
    }

    /// Traction coefficient of the picture, when it belongs to the sliders.
    pub fn traction(&self) -> Option<f64> {
        self.desk.answers.current_picture().map(|picture| picture.traction)
    }

    /// Moments that have been computed of contacts in time.
    pub fn transient_moments(&self) -> usize {
        self.desk.transient.runs.iter().map(|run| run.trajectory.moments.len()).sum()
    }

    /// What the last frame drew: its name, whether it belongs to what is asked now, and whether it is grey.
    pub fn drawn(&self) -> impl Iterator<Item = (&'static str, bool, bool)> {
        let context = self.desk.context();
        self.drawn.iter().map(move |drawn| (drawn.name, drawn.of.is_present(&context), drawn.grey))
    }

    /// The laws of the lubricant on the screen.
    pub fn lubricant(&self) -> Lubricant {
        self.desk.document.lubricant
    }

    /// The fields of the SI quantities, by the names that screen readers know them by.
    pub fn fields() -> [(Quantity, &'static str); 7] {
        panels::operating_point::FIELDS
    }

    /// The quantities that were typed and stay.
    pub fn held(&self) -> impl Iterator<Item = Quantity> {
        let all = Quantity::SI.into_iter().chain([Quantity::RadiusY]);
        all.filter(|quantity| self.desk.document.holds(*quantity))
    }

    /// Seconds that the last frame took to build.
    pub fn frame_s(&self) -> f64 {
        self.frame_s
    }
}
