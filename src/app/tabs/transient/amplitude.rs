//! Amplitude curve: the amplitude A_d of the film's waviness at the centre of the contact over the amplitude A_i of a wavy
//! surface that passes it, for ten wavelengths, next to a published formula.

use crate::app::caption;
use crate::app::context::{Commands, Context};
use crate::app::controls::{message_ui, sentence, warning_ui};
use crate::app::document::{Document, Key};
use crate::app::drawn::{self, Owner};
use crate::app::export;
use crate::app::in_use::question;
use crate::app::numbers;
use crate::app::plot::axes;
use crate::app::plot::key::{self, Entry, Sample};
use crate::app::tabs::Offer;
use crate::app::theme::{Palette, THIN_WIDTH, rich};
use crate::app::units;
use crate::app::wake::wake;
use crate::engine::job::{Background, Standing};
use crate::engine::{Store, Workbench};
use crate::scene::study::amplitude::{Amplitude, Derivative, Row};
use crate::scene::{Grid, Scene, Study, StudyRow};
use crate::solver::discrete::grid::PointGridSpec;
use crate::solver::full::response::{check_lubricant, published_reduction, reduction_parameter};
use crate::solver::full::transient::MovingSurface;
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::engineering::UnitSystem;
use crate::solver::warning::Warning;
use egui::{Align, Layout, Ui};
use egui_plot::{HoverPosition, Line, LineStyle, MarkerShape, PlotPoint, PlotPoints, Points};

/// Number of wavelengths.
const WAVELENGTHS: usize = 10;
/// Range of the parameter Ψ of the published formula.
const PSI: (f64, f64) = (1.0, 50.0);
/// Longest wavelength in units of the Hertzian half width a, and the shortest in spacings of the grid.
const LONGEST: f64 = 4.0;
const SPACINGS: f64 = 8.0;
/// Number of points of the published curve.
const CURVE: usize = 200;
/// Name under which the plot is drawn.
const NAME: &str = "Amplitude over wavelength";

/// Contact for which a curve is wanted, and the body that is wavy.
#[derive(Clone, Debug, PartialEq)]
struct Wanted {
    key: Key,
    body: u8,
}

/// Amplitude curve and its computation in the background.
pub struct AmplitudeCurve {
    body: u8,
    wanted: Option<Wanted>,
    computed: Option<(Wanted, Vec<Row>)>,
    work: Background<StudyRow>,
    rows: Vec<Row>,
}

impl Default for AmplitudeCurve {
    fn default() -> Self {
        Self { body: 1, wanted: None, computed: None, work: Background::default(), rows: Vec::new() }
    }
}

impl Wanted {
    /// Returns the grid of the steady contact and its spacing.
    fn grid(&self) -> (Grid, f64) {
        if self.key.point.kind.is_line() {
            (Grid::DISSERTATION, 0.005)
        } else {
            (Grid::Plane(PointGridSpec::QUICK), PointGridSpec::QUICK.dx)
        }
    }

    /// Returns Ψ for a wavelength equal to a.
    fn unit(&self) -> f64 {
        reduction_parameter(self.key.point.kind, self.key.point.moes(), 1.0)
    }

    /// Returns geometrically spaced wavelengths λ/a within the range of Ψ that the grid resolves.
    fn wavelengths(&self) -> Vec<f64> {
        let (unit, shortest) = (self.unit(), SPACINGS * self.grid().1);
        let low = (PSI.0 / unit).max(shortest).min(0.5 * LONGEST);
        let high = (PSI.1 / unit).clamp(2.0 * low, LONGEST.max(2.0 * low));
        let ratio = (high / low).ln() / (WAVELENGTHS - 1) as f64;
        (0..WAVELENGTHS).map(|k| numbers::rounded(low * (ratio * k as f64).exp(), 4)).collect()
    }

    fn question(&self) -> Scene {
        let study = Amplitude {
            wavelengths: self.wavelengths(),
            body: self.body,
            derivatives: vec![Derivative::Exact],
            time_step: None,
        };
        question("Amplitude curve", &self.key, self.grid().0, Study::Amplitude(study))
    }

    /// Returns the speed of the wavy surface in units of u_m.
    fn speed(&self) -> f64 {
        MovingSurface::speed_of(self.body, self.key.point.sliding.slide_to_roll_ratio)
    }
}

/// Returns why the curve of a contact cannot be computed; `None` if it can.
fn refused(document: &Document) -> Option<String> {
    check_lubricant(&document.lubricant).err().map(|problem| sentence(&problem.to_string()))
}

impl AmplitudeCurve {
    /// Receives the results since the last frame.
    pub fn receive(&mut self) {
        let works = self.work.job().is_some();
        let rows = &mut self.rows;
        self.work.receive(|row| {
            if let StudyRow::Amplitude(row) = row {
                rows.push(row);
            }
        });
        if works && self.work.job().is_none() && !self.rows.is_empty() {
            self.computed = self.wanted.clone().map(|wanted| (wanted, std::mem::take(&mut self.rows)));
        }
    }

    /// Returns the progress of the job.
    pub fn standing(&self) -> Option<Standing> {
        self.work.standing()
    }

    /// Stops the job.
    pub fn stop(&self) {
        self.work.stop();
    }

    /// Returns true if the curve is that of a document's contact.
    pub fn is_of(&self, document: &Document) -> bool {
        let wanted = Wanted { key: document.key(), body: self.body };
        self.computed.as_ref().is_some_and(|(of, _)| *of == wanted)
    }

    /// Computes the curve of the present contact when no other one is being computed.
    fn follow(&mut self, ctx: &egui::Context, store: &Store, wanted: Wanted) {
        if self.work.job().is_none() && self.wanted.as_ref() != Some(&wanted) {
            self.rows.clear();
            self.work.run(wanted.question().ask(Workbench::on(store, ""), wake(ctx)));
            self.wanted = Some(wanted);
        }
    }

    /// Draws the curve.
    pub fn ui(&mut self, ui: &mut Ui, context: &Context<'_>, _: &mut Commands) {
        if let Some(why) = refused(context.document) {
            ui.weak(why);
            return;
        }
        let wanted = Wanted { key: context.document.key(), body: self.body };
        self.follow(ui.ctx(), context.answers.store(), wanted.clone());
        self.head(ui, &wanted);
        let Some((of, rows)) = &self.computed else {
            ui.weak("The curve is being computed");
            return;
        };
        let size = ui.available_size();
        ui.allocate_ui_with_layout(size, Layout::top_down(Align::LEFT), |ui| {
            if drawn::is_grey(ui.ctx(), "amplitude curve", Owner::Contact(of.key), context) || *of != wanted {
                drawn::fade(ui, self.work.job().is_some());
            }
            plot(ui, of, rows, (context.fit, (size.y - 26.0).max(120.0)));
            legend(ui, of.key.point.kind);
        });
    }

    /// Draws the choice of the body, and the state of the computation in a line that is always there.
    fn head(&mut self, ui: &mut Ui, wanted: &Wanted) {
        ui.horizontal_wrapped(|ui| {
            ui.label("Wavy surface")
                .on_hover_text("Body with the wavy surface. The slide-to-roll ratio sets its speed");
            for body in [1, 2] {
                ui.selectable_value(&mut self.body, body, format!("Body {body}"));
            }
            let srr = wanted.key.point.sliding.slide_to_roll_ratio;
            let text = format!(
                "moves with {} {{u_m}};  {{SRR}} {}",
                numbers::digits(wanted.speed(), 3),
                numbers::quantity(100.0 * srr, "%")
            );
            ui.label(rich(&text, 13.5, ui.visuals().weak_text_color()));
        });
        ui.horizontal(|ui| {
            ui.set_min_height(ui.spacing().interact_size.y);
            let warnings = self.computed.iter().flat_map(|(_, rows)| rows.iter().flat_map(|row| &row.warnings));
            // The curve has no traction.
            let of_traction = |warning: &&Warning| matches!(warning, Warning::UnphysicalExponent { .. });
            let mut warnings = warnings.filter(|warning| !of_traction(warning));
            if let Some(message) = &self.work.message {
                message_ui(ui, message);
            } else if let Some(warning) = warnings.next() {
                warning_ui(ui, &warning.to_string());
            } else if wanted.key.point.sliding.slide_to_roll_ratio != 0.0 {
                ui.weak("The published curve holds for pure rolling; with sliding, a second wave moves with u_m.");
            }
        });
    }

    /// Returns the export of the curve.
    pub fn offer<'a>(&'a self) -> Offer<'a> {
        let tip = "Wavelength, reduction parameter, published and computed |A_d/A_i| of every point";
        Offer::table("Amplitude curve as CSV…", tip, self.computed.as_ref(), |(of, rows)| csv(of, rows))
    }

    /// Returns the contact of the curve for the caption of a figure.
    pub fn caption(&self, system: UnitSystem) -> Option<String> {
        let (of, _) = self.computed.as_ref()?;
        let contact = caption::contact(&of.key.point, &of.key.lubricant, system);
        Some(format!("{contact}; wavy surface on body {}", of.body))
    }
}

/// Draws computed points and the published curve over Ψ.
fn plot(ui: &mut Ui, of: &Wanted, rows: &[Row], (fit, height): (bool, f32)) {
    let palette = Palette::of(ui);
    let place = |row: &Row| Some(PlotPoint::new(row.nabla.log10(), row.responses.first()?.ratio()));
    let half_width_m = of.key.point.hertz().half_width_m;
    let system = units::system(ui.ctx());
    let hover = |at: &HoverPosition<'_>| {
        let (HoverPosition::NearDataPoint { position, .. } | HoverPosition::Elsewhere { position }) = at;
        let apart = |row: &&Row| (row.nabla.log10() - position.x).abs();
        let row = rows.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)))?;
        let nabla = format!("Ψ = {}", numbers::significant(row.nabla));
        Some(format!(
            "λ = {} ({} a)\n{nabla}\n|A_d/A_i| = {}\npublished {}",
            numbers::length(row.wavelength * half_width_m, system),
            numbers::digits(row.wavelength, 3),
            numbers::significant(row.responses.first()?.ratio()),
            numbers::significant(row.published)
        ))
    };
    let (low, high) = (PSI.0.log10() - 0.05, PSI.1.log10() + 0.05);
    let line = of.key.point.kind.is_line();
    let title = if line { "Ψ = (λ/{a}) {M}^(3/4)/{L}^(1/2)" } else { "Ψ = (λ/{a}) ({M}/{L})^(1/2)" };
    let frame = axes::plot(ui, "amplitude curve", height, title, "|{A_d}/{A_i}|")
        .log_x()
        .default_x_bounds(low, high)
        .default_y_bounds(0.0, 1.1)
        .label_formatter(hover);
    axes::show(frame, ui, NAME, |plot| {
        axes::fit(plot, fit);
        let published = published_reduction(of.key.point.kind);
        let curve = (0..=CURVE).map(|k| low + (high - low) * k as f64 / CURVE as f64);
        let points = curve.map(|x| PlotPoint::new(x, published.at(10f64.powf(x)))).collect();
        let line = Line::new(PUBLISHED, PlotPoints::Owned(points)).color(palette.reference).width(THIN_WIDTH);
        plot.line(line.style(LineStyle::dashed_dense()).allow_hover(false));
        let points: Vec<PlotPoint> = rows.iter().filter_map(place).collect();
        let line = Line::new(COMPUTED, PlotPoints::Owned(points.clone())).color(palette.film).width(THIN_WIDTH);
        plot.line(line.allow_hover(false));
        let dots = Points::new(COMPUTED, PlotPoints::Owned(points)).id("dots").shape(MarkerShape::Circle);
        plot.points(dots.color(palette.film).radius(4.0));
    });
}

/// Names of the curves.
const COMPUTED: &str = "computed, small amplitudes";
const PUBLISHED: &str = "published, pure rolling";

fn legend(ui: &mut Ui, kind: ContactKind) {
    let palette = Palette::of(ui);
    let source = if kind.is_line() {
        "published: 1/(1 + 0.17Ψ + 0.03Ψ²), Venner and others 1997"
    } else {
        "published: 1/(1 + 0.15Ψ + 0.015Ψ²), Venner and Lubrecht 2000"
    };
    key::ui(
        ui,
        vec![
            Entry::new(COMPUTED, palette.film, Sample::of_line(LineStyle::Solid, 2.0)),
            Entry::new(source, palette.reference, Sample::of_line(LineStyle::dashed_dense(), THIN_WIDTH)),
        ],
    );
}

fn csv(of: &Wanted, rows: &[Row]) -> String {
    let half_width_m = of.key.point.hertz().half_width_m;
    let comments = [
        export::describe_contact(&of.key.point, &of.key.lubricant),
        format!("wavy surface on body {}, speed {} u_m", of.body, of.speed()),
    ];
    let columns = ["wavelength", "wavelength_m", "nabla", "published", "amplitude", "real", "imaginary"];
    let row = |row: &Row| {
        let response = row.responses.first();
        let (ratio, parts) = (response.map(|r| r.ratio()), response.map(|r| r.amplitude));
        let own = [row.wavelength, row.wavelength * half_width_m, row.nabla, row.published].map(Some);
        own.into_iter().chain([ratio, parts.map(|p| p.0), parts.map(|p| p.1)]).collect::<Vec<_>>()
    };
    export::csv(&comments, &columns, rows.iter().map(row))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::document::Shape;
    use crate::solver::physics::contact::Moes;

    #[test]
    fn wavelengths_are_accepted_for_all_contacts() {
        for shape in [Shape::Roller, Shape::Ball] {
            for (m, l) in [(4.0, 4.0), (40.0, 10.0), (200.0, 12.0)] {
                let mut document = Document::default();
                document.set_shape(shape).unwrap();
                document.set_moes(Moes { m, l }).unwrap();
                let wanted = Wanted { key: document.key(), body: 2 };
                let lengths = wanted.wavelengths();
                assert!(lengths.is_sorted() && lengths[WAVELENGTHS - 1] > 1.9 * lengths[0], "{lengths:?}");
                wanted.question().check().unwrap();
            }
        }
    }
}
