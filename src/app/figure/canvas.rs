//! Recording of a plot for print: lines, marks, texts and images in the coordinates of its axes. It is active only
//! while a figure is requested. Items drawn without the canvas are for interaction and stay on the screen.

use super::sitting::{pixels, rgb, with_sitting};
use super::texture::known;
use crate::scene::drawing::{Pen, Rgb, TextAnchor, Words};
use crate::scene::{Area, Band, Chart, ChartAxis, Map, Marks, Note, Series};
use egui::epaint::{ColorMode, TextShape};
use egui::{Align, Color32, Context, Id, Shape, TextureId, Ui, UiBuilder, pos2};
use egui_plot::{
    BarChart, FilledArea, HLine, Line, LineStyle, PlotBounds, PlotGeometry, PlotImage, PlotItem, PlotPoint, PlotUi,
    Points, Span, Text, VLine,
};
use std::ops::{Deref, DerefMut};

/// Width on paper of one point on the screen \[pt\].
const PAPER: f32 = 0.5;

/// Distance from the screen from which on lines are solid \[points\].
const FAR: f32 = 3e4;

/// Axis of a plot.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Title, with symbols in braces.
    pub title: String,
    /// Title on paper, if the screen shows it elsewhere.
    pub on_paper: String,
    /// True if it shows decimal logarithms.
    pub log: bool,
    /// Factor to the unit of the axis.
    pub factor: f64,
    /// Positions labelled with names instead of numbers.
    pub names: Vec<(f64, String)>,
}

impl Default for Axis {
    fn default() -> Self {
        Self { title: String::new(), on_paper: String::new(), log: false, factor: 1.0, names: Vec::new() }
    }
}

impl Axis {
    fn value(&self, place: f64) -> f64 {
        self.factor * if self.log { 10f64.powf(place) } else { place }
    }

    fn on_a_chart(&self) -> ChartAxis {
        let title = if self.title.is_empty() { &self.on_paper } else { &self.title };
        let mut axis = ChartAxis::new(title, self.log);
        axis.names = self.names.iter().map(|(place, name)| (self.value(*place), name.clone())).collect();
        axis
    }
}

/// Line across the whole plot.
enum Rule {
    Across(f64, Pen),
    Up(f64, Pen),
}

/// Content of a plot recorded so far.
pub struct Recording {
    /// Invisible `Ui` that yields the shapes of the items.
    probe: Ui,
    chart: Chart,
    axes: [Axis; 2],
    rules: Vec<Rule>,
}

impl Recording {
    /// Starts a recording. `None` if no figure of the present drawing is requested.
    pub fn wanted(ctx: &Context, name: &str, axes: [&Axis; 2], equal: bool) -> Option<Self> {
        with_sitting(ctx, |sitting| sitting.is_on()).then(|| {
            let [x, y] = axes.map(Axis::on_a_chart);
            let mut chart = Chart::new(name, x, y);
            (chart.equal, chart.marked) = (equal, true);
            let probe = Ui::new(ctx.clone(), Id::unique(("probe", name.to_owned())), UiBuilder::new().invisible());
            Self { probe, chart, axes: axes.map(Clone::clone), rules: Vec::new() }
        })
    }

    /// Ends the recording with the bounds of the axes, and stores it.
    pub fn end(mut self, ctx: &Context, bounds: &PlotBounds) {
        let ([left, below], [right, above]) = (bounds.min(), bounds.max());
        let [x, y] = &self.axes;
        let (across, up) = ((x.value(left), x.value(right)), (y.value(below), y.value(above)));
        for rule in self.rules {
            let (points, pen) = match rule {
                Rule::Across(height, pen) => ([[across.0, y.value(height)], [across.1, y.value(height)]], pen),
                Rule::Up(place, pen) => ([[x.value(place), up.0], [x.value(place), up.1]], pen),
            };
            let series = Series { name: String::new(), marks: Marks::Line, points: points.to_vec(), pen: Some(pen) };
            self.chart.series.insert(0, series);
        }
        (self.chart.x.ends, self.chart.y.ends) = (Some(across), Some(up));
        with_sitting(ctx, |sitting| sitting.keep(self.chart));
    }

    fn value(&self, place: PlotPoint) -> [f64; 2] {
        let [x, y] = &self.axes;
        [x.value(place.x), y.value(place.y)]
    }

    fn shapes(&mut self, plot: &PlotUi<'_>, item: &impl PlotItem) -> Vec<Shape> {
        let mut shapes = Vec::new();
        item.shapes(&self.probe, plot.transform(), &mut shapes);
        shapes
    }

    fn series(&mut self, item: &impl PlotItem, marks: Marks, pen: Pen) {
        let PlotGeometry::Points(points) = item.geometry() else { return };
        let points = points.iter().map(|point| self.value(*point));
        let points: Vec<[f64; 2]> = points.filter(|point| point.iter().all(|value| value.is_finite())).collect();
        if !points.is_empty() {
            self.chart.series.push(Series { name: item.name().to_owned(), marks, points, pen: Some(pen) });
        }
    }

    /// Records a text at its position relative to its anchor on the screen.
    fn note(&mut self, plot: &PlotUi<'_>, text: &Text) {
        let place = PlotPoint { x: text.bounds().min()[0], y: text.bounds().min()[1] };
        for shape in self.shapes(plot, text) {
            let Shape::Text(drawn) = shape else { continue };
            let (at, size) = (plot.transform().position_from_point(&place), drawn.galley.size());
            let beside = match (at.x - drawn.pos.x) / size.x.max(1.0) {
                share if share < 0.25 => TextAnchor::Right,
                share if share < 0.75 => TextAnchor::Middle,
                _ => TextAnchor::Left,
            };
            let above = match (at.y - drawn.pos.y) / size.y.max(1.0) {
                share if share < 0.25 => -1,
                share if share < 0.75 => 0,
                _ => 1,
            };
            let (words, color) = read(&drawn);
            self.chart.notes.push(Note { at: self.value(place), words, beside, above, color: Some(color) });
        }
    }

    /// Records filled rectangles.
    fn bands(&mut self, plot: &PlotUi<'_>, item: &impl PlotItem) {
        let frame = *plot.transform().frame();
        for shape in self.shapes(plot, item) {
            let Shape::Rect(rect) = shape else { continue };
            if rect.fill == Color32::TRANSPARENT {
                continue;
            }
            let value = |x: f32, y: f32| self.value(plot.transform().value_from_position(pos2(x, y)));
            let ([left, below], [right, above]) =
                (value(rect.rect.left(), rect.rect.bottom()), value(rect.rect.right(), rect.rect.top()));
            // A rectangle that reaches the edge of the plot also reaches the edge on paper.
            let open = |value: f64, open: bool, end: f64| if open { end } else { value };
            let x = (
                open(left, rect.rect.left() <= frame.left() + 0.5, f64::NEG_INFINITY),
                open(right, rect.rect.right() >= frame.right() - 0.5, f64::INFINITY),
            );
            let y = (
                open(below, rect.rect.bottom() >= frame.bottom() - 0.5, f64::NEG_INFINITY),
                open(above, rect.rect.top() <= frame.top() + 0.5, f64::INFINITY),
            );
            let (color, opacity) = rgb(rect.fill);
            self.chart.bands.push(Band { x, y, color, opacity });
        }
    }
}

/// Returns the words of a text and their colour.
fn read(drawn: &TextShape) -> (Words, Rgb) {
    let job = &drawn.galley.job;
    let large = job.sections.iter().map(|section| section.format.font_id.size).fold(0.0, f32::max);
    let mut words = Words::default();
    let mut color = drawn.override_text_color;
    let last = job.sections.len().saturating_sub(1);
    for (k, section) in job.sections.iter().enumerate() {
        let (format, range) = (&section.format, &section.byte_range);
        let mut text = job.text.get(range.start.into()..range.end.into()).unwrap_or_default();
        // Leading and trailing blanks only separate the text from a curve on the screen.
        if k == 0 {
            text = text.trim_start();
        }
        if k == last {
            text = text.trim_end();
        }
        let subscript = format.valign == Align::BOTTOM && format.font_id.size < large;
        words.push(&text.replace('\n', " "), format.italics, subscript);
        let own = if format.color == Color32::PLACEHOLDER { drawn.fallback_color } else { format.color };
        color = color.or(Some(own));
    }
    (words, rgb(color.unwrap_or(drawn.fallback_color)).0)
}

/// Returns the pen of a line from its shapes.
fn pen(shapes: &[Shape]) -> Option<Pen> {
    let pen = |color: Color32, width: f32, dashes: &[f64]| {
        let (color, opacity) = rgb(color);
        Pen { color, opacity, width: f64::from((PAPER * width).clamp(0.4, 2.5)), dashes: dashes.to_vec() }
    };
    shapes.iter().find_map(|shape| match shape {
        Shape::LineSegment { stroke, .. } => Some(pen(stroke.color, stroke.width, &[3.0, 1.8])),
        Shape::Circle(dot) => Some(pen(dot.fill, 1.4 * dot.radius, &[0.8, 1.6])),
        Shape::Path(path) => match &path.stroke.color {
            ColorMode::Solid(color) => Some(pen(*color, path.stroke.width, &[])),
            ColorMode::UV(_) => None,
        },
        _ => None,
    })
}

/// Returns the pen width whose dots have the size of a mark.
fn dot(shape: &Shape) -> f64 {
    let radius = 0.5 * shape.visual_bounding_rect().width();
    f64::from((0.7 * PAPER * radius).clamp(0.4, 2.0))
}

/// Returns the kind of marks from their shapes.
fn marks(shapes: &[Shape]) -> Marks {
    match shapes.first() {
        Some(Shape::Circle(circle)) if circle.fill == Color32::TRANSPARENT => Marks::Rings,
        Some(Shape::LineSegment { .. }) => Marks::Crosses,
        Some(Shape::Path(path)) if path.fill == Color32::TRANSPARENT => Marks::Rings,
        _ => Marks::Dots,
    }
}

/// Drawing surface of a plot. Everything drawn through it belongs to the figure. [`Deref`] gives access to the plot
/// itself.
pub struct Canvas<'p, 'a> {
    plot: &'p mut PlotUi<'a>,
    recording: Option<Recording>,
    /// True if the axes are locked.
    pub locked: bool,
}

impl<'a> Deref for Canvas<'_, 'a> {
    type Target = PlotUi<'a>;

    fn deref(&self) -> &PlotUi<'a> {
        self.plot
    }
}

impl DerefMut for Canvas<'_, '_> {
    fn deref_mut(&mut self) -> &mut Self::Target {
        self.plot
    }
}

impl<'p, 'a> Canvas<'p, 'a> {
    /// Creates the canvas of a plot.
    pub fn new(plot: &'p mut PlotUi<'a>, recording: Option<Recording>, locked: bool) -> Self {
        Self { plot, recording, locked }
    }

    /// Returns the recording.
    pub fn recorded(self) -> Option<Recording> {
        self.recording
    }

    /// A line. It is solid where it leaves the screen by far: the toolkit would make a shape of each dash.
    pub fn line(&mut self, mut line: Line<'a>) {
        if self.leaves_by_far(&line) {
            line = line.style(LineStyle::Solid);
        }
        if let Some(recording) = &mut self.recording {
            line.initialize(self.plot.plot_bounds().range_x());
            if let Some(pen) = pen(&recording.shapes(self.plot, &line)) {
                recording.series(&line, Marks::Line, pen);
            }
        }
        self.plot.line(line);
    }

    fn leaves_by_far(&self, line: &Line<'_>) -> bool {
        let PlotGeometry::Points(points) = line.geometry() else { return false };
        let place = |point| self.plot.transform().position_from_point(point);
        points.iter().map(place).any(|place| place.x.abs() > FAR || place.y.abs() > FAR)
    }

    /// Draws marks.
    pub fn points(&mut self, points: Points<'a>) {
        if let Some(recording) = &mut self.recording {
            let (color, opacity) = rgb(PlotItem::color(&points));
            let shapes = recording.shapes(self.plot, &points);
            let width = shapes.first().map_or(1.0, dot);
            let pen = Pen { color, opacity, width, dashes: Vec::new() };
            let marks = marks(&shapes);
            recording.series(&points, marks, pen);
        }
        self.plot.points(points);
    }

    /// Draws a text.
    pub fn text(&mut self, text: Text) {
        if let Some(recording) = &mut self.recording {
            recording.note(self.plot, &text);
        }
        self.plot.text(text);
    }

    /// Draws a horizontal line.
    pub fn hline(&mut self, line: HLine) {
        self.rule(&line, |pen| Rule::Across(line.bounds().min()[1], pen));
        self.plot.hline(line);
    }

    /// Draws a vertical line.
    pub fn vline(&mut self, line: VLine) {
        self.rule(&line, |pen| Rule::Up(line.bounds().min()[0], pen));
        self.plot.vline(line);
    }

    /// Records a line across the whole plot.
    fn rule(&mut self, line: &impl PlotItem, rule: impl FnOnce(Pen) -> Rule) {
        if let Some(recording) = &mut self.recording {
            let pen = pen(&recording.shapes(self.plot, line));
            recording.rules.extend(pen.map(rule));
        }
    }

    /// Fills the area between two curves with the same abscissas.
    pub fn between(&mut self, id: &str, lower: &[PlotPoint], upper: &[PlotPoint], fill: Color32) {
        let (x, upper_y): (Vec<f64>, Vec<f64>) = upper.iter().map(|point| (point.x, point.y)).unzip();
        let lower_y: Vec<f64> = lower.iter().map(|point| point.y).collect();
        if x.is_empty() || lower_y.len() != x.len() {
            return;
        }
        if let Some(recording) = &mut self.recording {
            let corners = upper.iter().chain(lower.iter().rev()).map(|point| recording.value(*point));
            let corners = corners.filter(|corner| corner.iter().all(|value| value.is_finite())).collect();
            let (color, opacity) = rgb(fill);
            recording.chart.areas.push(Area { corners, color, opacity });
        }
        let area = FilledArea::new("", &x, &lower_y, &upper_y).fill_color(fill);
        self.plot.add(area.id(id).allow_hover(false));
    }

    /// Draws a filled strip.
    pub fn span(&mut self, span: Span) {
        if let Some(recording) = &mut self.recording {
            recording.bands(self.plot, &span);
        }
        self.plot.span(span);
    }

    pub fn bar_chart(&mut self, bars: BarChart) {
        if let Some(recording) = &mut self.recording {
            recording.bands(self.plot, &bars);
        }
        self.plot.bar_chart(bars);
    }

    /// Draws a field as an image between the two values of each axis.
    pub fn field(&mut self, id: &str, texture: TextureId, x: (f64, f64), y: (f64, f64), tint: Color32) {
        if let Some(recording) = &mut self.recording
            && let Some(image) = known(self.plot.ctx()).get(&texture).and_then(std::sync::Weak::upgrade)
        {
            let ends = |axis: &Axis, (from, to): (f64, f64)| (axis.value(from), axis.value(to));
            let [across, up] = &recording.axes;
            let (x, y) = (ends(across, x), ends(up, y));
            recording.chart.map = Some(Map { x, y, pixels: pixels(&image), scale: None });
        }
        let center = PlotPoint::new(0.5 * (x.0 + x.1), 0.5 * (y.0 + y.1));
        let size = egui::vec2((x.1 - x.0) as f32, (y.1 - y.0) as f32);
        self.plot.image(PlotImage::new("", texture, center, size).tint(tint).id(id).allow_hover(false));
    }
}
