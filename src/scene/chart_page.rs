//! Charts on a page for print: sizes in millimetres, axes with their names and units, a legend that covers nothing, a
//! caption below. Lines differ by dashes as well as by colour, so that they can be told apart in grey.

use super::chart::{Chart, ChartAxis, ColorScale, Marks, Note, Series};
use super::drawing::{Beside, Drawing, Lettering, Mark, Pen, Pixels, Rgb, Words, wrapped};
use super::table::significant;

/// Size of the letters \[pt\].
const LETTERS: f64 = 8.0;
/// Size of the caption's letters.
const SMALL: f64 = 6.8;
/// How much longer heavy letters are.
const BOLD: f64 = 1.08;
/// Distance of lines of text over the size of letters.
const LINE: f64 = 1.3;
/// Radius of a dot over the width of its pen.
const DOT: f64 = 1.4;
/// Width of the bar of a map's colours.
const BAR: f64 = 8.0;
/// Colours by Okabe and Ito that can be told apart by all.
const COLORS: [Rgb; 6] = [
    [0x00, 0x72, 0xB2],
    [0xD5, 0x5E, 0x00],
    [0x00, 0x9E, 0x73],
    [0xCC, 0x79, 0xA7],
    [0x8A, 0x6D, 0x00],
    [0x56, 0xB4, 0xE9],
];
const DASHES: [&[f64]; 4] = [&[], &[5.0, 2.0], &[1.5, 1.5], &[6.0, 2.0, 1.5, 2.0]];

/// What a drawing is made for.
#[derive(Clone, Debug, PartialEq)]
pub struct Page {
    /// Width \[mm\], 40 to 500.
    pub width_mm: f64,
    /// Height \[mm\], 30 to 500.
    pub height_mm: f64,
    /// Light letters on a dark ground.
    pub dark: bool,
    /// What stands below: parameters, source.
    pub caption: String,
}

impl Default for Page {
    /// One column of a journal, for paper.
    fn default() -> Self {
        Self { width_mm: 85.0, height_mm: 65.0, dark: false, caption: String::new() }
    }
}

impl Page {
    fn ink(&self) -> Rgb {
        if self.dark { [0xee; 3] } else { [0x22; 3] }
    }

    fn grid(&self) -> Rgb {
        if self.dark { [0x44; 3] } else { [0xdd; 3] }
    }

    fn ground(&self) -> Rgb {
        if self.dark { [0x1b; 3] } else { [0xff; 3] }
    }
}

/// An axis as it is drawn: its ends and its marks, in the coordinate that is linear on paper.
struct Scale {
    log: bool,
    from: f64,
    to: f64,
    ticks: Vec<(f64, String)>,
}

impl Scale {
    /// The axis with about so many marks, or with its names.
    fn of(axis: &ChartAxis, values: impl Iterator<Item = f64>, marks: f64) -> Self {
        let scale = Self::counted(axis, values, marks);
        if axis.names.is_empty() { scale } else { Self { ticks: axis.names.clone(), ..scale } }
    }

    fn counted(axis: &ChartAxis, values: impl Iterator<Item = f64>, marks: f64) -> Self {
        let place = |value: f64| if axis.log { value.log10() } else { value };
        if let Some((from, to)) = axis.ends.map(|(from, to)| (place(from), place(to)))
            && from < to
            && from.is_finite()
            && to.is_finite()
        {
            return Self::between(axis.log, from, to, marks);
        }
        let (mut from, mut to) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values.map(place) {
            (from, to) = (from.min(value), to.max(value));
        }
        if from > to {
            (from, to) = (0.0, 1.0);
        }
        if to - from <= 1e-12 * from.abs().max(to.abs()) {
            let half = if from == 0.0 { 1.0 } else { 0.5 * from.abs() };
            (from, to) = (from - half, to + half);
        }
        let margin = 0.03 * (to - from);
        Self::between(axis.log, from - margin, to + margin, marks)
    }

    fn between(log: bool, from: f64, to: f64, marks: f64) -> Self {
        Self { log, from, to, ticks: if log { decades(from, to) } else { steps(from, to, marks) } }
    }

    /// Where a value lies between both ends, 0 to 1.
    fn share(&self, value: f64) -> f64 {
        ((if self.log { value.log10() } else { value }) - self.from) / (self.to - self.from)
    }
}

/// Marks at multiples of 1, 2 or 5.
fn steps(from: f64, to: f64, marks: f64) -> Vec<(f64, String)> {
    let rough = (to - from) / marks;
    let power = 10f64.powf(rough.log10().floor());
    let step = power * [1.0, 2.0, 5.0, 10.0].into_iter().find(|times| times * power >= rough).unwrap_or(10.0);
    let (first, last) = ((from / step).ceil() as i64, (to / step).floor() as i64);
    let decimals = (-step.log10().floor()).max(0.0) as usize;
    let far = from.abs().max(to.abs());
    let text = |value: f64| match value {
        0.0 => "0".to_owned(),
        _ if (1e-3..1e5).contains(&far) => format!("{value:.decimals$}"),
        _ => significant(value, 2),
    };
    (first..=last).map(|k| k as f64 * step).map(|value| (value, text(value))).collect()
}

/// Marks at powers of ten, at 2 and 5 times them where there are few.
fn decades(from: f64, to: f64) -> Vec<(f64, String)> {
    let (first, last) = (from.floor() as i32, to.ceil() as i32);
    let times: &[f64] = if to - from < 2.0 { &[1.0, 2.0, 5.0] } else { &[1.0] };
    let sparse = ((last - first) / 6).max(1);
    let all = (first..=last).filter(|k| (k - first) % sparse == 0);
    all.flat_map(|k| times.iter().map(move |times| times * 10f64.powi(k)))
        .filter(|value| (from..=to).contains(&value.log10()))
        .map(|value| (value, significant(value, 1)))
        .collect()
}

fn width_of(text: &str) -> f64 {
    Words::plain(text).length(LETTERS)
}

/// The pen of a series that brings none.
fn pen(k: usize) -> Pen {
    let color = COLORS.get(k % COLORS.len()).copied().unwrap_or_default();
    let dashes = DASHES.get(k % DASHES.len()).map_or_else(Vec::new, |dashes| dashes.to_vec());
    Pen { color, opacity: 1.0, width: 1.1, dashes }
}

fn thin(color: Rgb, width: f64) -> Pen {
    Pen { color, opacity: 1.0, width, dashes: Vec::new() }
}

/// Charts on a page, one below the other, with one caption.
pub fn drawn(charts: &[Chart], page: &Page) -> Drawing {
    let mut drawing = Drawing {
        size_mm: [page.width_mm, page.height_mm],
        title: charts.first().map_or_else(String::new, |chart| chart.title.clone()),
        ground: page.ground(),
        marks: Vec::new(),
    };
    let [width, height] = drawing.size();
    let caption = wrapped(&page.caption, SMALL, width - 8.0);
    let below = SMALL * LINE * caption.len() as f64;
    let room = (height - below - 4.0) / charts.len().max(1) as f64;
    for (k, chart) in charts.iter().enumerate() {
        let top = room * k as f64;
        Panel { chart, page, marks: &mut drawing.marks, width }.draw(top, top + room);
    }
    for (k, line) in caption.iter().enumerate() {
        let at = [4.0, height - below - 4.0 + SMALL + SMALL * LINE * k as f64];
        let words = Words::plain(line);
        drawing.marks.push(Mark::Words(Lettering {
            words,
            at,
            beside: Beside::Right,
            upwards: false,
            size: SMALL,
            bold: false,
            color: page.ink(),
            class: "caption",
        }));
    }
    drawing
}

impl Chart {
    /// The chart on a page.
    pub fn to_svg(&self, page: &Page) -> String {
        drawn(std::slice::from_ref(self), page).to_svg()
    }

    /// Which series stand in each line of the legend, and where: each name once, and none that stands at its curve.
    fn legend(&self, width: f64) -> Vec<Vec<(usize, f64)>> {
        if self.series.len() < 2 && self.series.iter().all(|series| series.name == self.title) {
            return Vec::new();
        }
        let first = |k: usize, name: &str| self.series.iter().position(|series| series.name == name) == Some(k);
        let noted: Vec<String> = self.notes.iter().map(|note| note.words.text().to_lowercase()).collect();
        let at_its_curve = |name: &str| noted.contains(&self.words(name).text().to_lowercase());
        let shown = |k: usize, name: &str| !name.is_empty() && first(k, name) && !at_its_curve(name);
        let named = self.series.iter().enumerate().filter(|(k, series)| shown(*k, &series.name));
        let mut lines: Vec<Vec<(usize, f64)>> = Vec::new();
        let mut at = f64::INFINITY;
        for (k, series) in named {
            let wide = 26.0 + self.words(&series.name).length(LETTERS);
            if at + wide > width {
                lines.push(Vec::new());
                at = 4.0;
            }
            if let Some(line) = lines.last_mut() {
                line.push((k, at));
            }
            at += wide;
        }
        lines
    }
}

/// A chart as it comes onto its part of a page.
struct Panel<'a> {
    chart: &'a Chart,
    page: &'a Page,
    marks: &'a mut Vec<Mark>,
    width: f64,
}

/// What axes enclose on paper, and their scales.
struct Axes {
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
    x: Scale,
    y: Scale,
}

impl Axes {
    fn rect(&self) -> [f64; 4] {
        [self.left, self.top, self.right - self.left, self.bottom - self.top]
    }

    fn x(&self, value: f64) -> f64 {
        self.left + self.x.share(value) * (self.right - self.left)
    }

    fn y(&self, value: f64) -> f64 {
        self.bottom - self.y.share(value) * (self.bottom - self.top)
    }

    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.x(x), self.y(y)]
    }

    /// A rectangle between values; one without end reaches to the end of the axes.
    fn between(&self, x: (f64, f64), y: (f64, f64)) -> [f64; 4] {
        let or = |value: f64, end: f64| if value.is_finite() { value } else { end };
        let (left, right) = (or(self.x(x.0), self.left), or(self.x(x.1), self.right));
        let (bottom, top) = (or(self.y(y.0), self.bottom), or(self.y(y.1), self.top));
        [left.min(right), top.min(bottom), (right - left).abs(), (bottom - top).abs()]
    }
}

impl Panel<'_> {
    fn draw(&mut self, top: f64, bottom: f64) {
        let (chart, width) = (self.chart, self.width);
        let title = wrapped(&chart.title, BOLD * LETTERS, width - 8.0);
        let legend = chart.legend(width);
        let mut base = top + 4.0 + LETTERS;
        for line in &title {
            self.lettering(Words::plain(line), [4.0, base], Beside::Right, |words| words.bold = true);
            base += LETTERS * LINE;
        }
        for line in &legend {
            for (k, at) in line {
                self.legend_item(*at, base - 0.35 * LETTERS, *k);
            }
            base += LETTERS * LINE;
        }
        let axes = self.axes(base - LETTERS + 4.0, bottom - LETTERS * (2.0 * LINE) - 4.0);
        if let Some(map) = &chart.map {
            self.marks.push(Mark::Within(Some(axes.rect())));
            self.marks.push(Mark::Image(axes.between(map.x, map.y), map.pixels.clone()));
            self.marks.push(Mark::Within(None));
        } else {
            self.grid(&axes);
        }
        self.marks.push(Mark::Within(Some(axes.rect())));
        for band in &chart.bands {
            self.marks.push(Mark::Area(axes.between(band.x, band.y), band.color, band.opacity));
        }
        for (k, series) in chart.series.iter().enumerate() {
            self.series(&axes, series, &series.pen.clone().unwrap_or_else(|| pen(k)));
        }
        for note in &chart.notes {
            self.note(&axes, note);
        }
        self.marks.push(Mark::Within(None));
        self.numbers(&axes);
        if let Some(scale) = chart.map.as_ref().and_then(|map| map.scale.as_ref()) {
            self.scale(&axes, scale);
        }
    }

    /// Where axes stand between both heights of the page.
    fn axes(&self, top: f64, bottom: f64) -> Axes {
        let chart = self.chart;
        let bottom = bottom.max(top + 20.0);
        let all = || chart.series.iter().flat_map(|series| &series.points);
        let map = |end: fn(&super::chart::Map) -> (f64, f64)| {
            chart.map.as_ref().map(end).into_iter().flat_map(|(from, to)| [from, to])
        };
        let y =
            Scale::of(&chart.y, all().map(|p| p[1]).chain(map(|map| map.y)), ((bottom - top) / 24.0).clamp(2.0, 6.0));
        let numbers = y.ticks.iter().map(|(_, text)| width_of(text)).fold(0.0, f64::max);
        let left = 8.0 + LETTERS * LINE + numbers;
        let scale = chart.map.as_ref().and_then(|map| map.scale.as_ref()).map_or(0.0, |scale| {
            BAR + 14.0 + LETTERS * LINE + scale_ticks(scale).iter().map(|(_, text)| width_of(text)).fold(0.0, f64::max)
        });
        let right = (self.width - 8.0 - scale).max(left + 20.0);
        let x =
            Scale::of(&chart.x, all().map(|p| p[0]).chain(map(|map| map.x)), ((right - left) / 40.0).clamp(2.0, 8.0));
        let mut axes = Axes { left, right, top, bottom, x, y };
        if chart.equal {
            // One scale for both: what is too long is shortened.
            let (across, up) = (axes.x.to - axes.x.from, axes.y.to - axes.y.from);
            let unit = ((axes.right - axes.left) / across).min((axes.bottom - axes.top) / up);
            (axes.right, axes.bottom) = (axes.left + unit * across, axes.top + unit * up);
        }
        axes
    }

    fn lettering(&mut self, words: Words, at: [f64; 2], beside: Beside, change: impl FnOnce(&mut Lettering)) {
        let color = self.page.ink();
        let mut lettering =
            Lettering { words, at, beside, upwards: false, size: LETTERS, bold: false, color, class: "" };
        change(&mut lettering);
        self.marks.push(Mark::Words(lettering));
    }

    fn grid(&mut self, axes: &Axes) {
        let pen = thin(self.page.grid(), 0.4);
        for (value, _) in &axes.x.ticks {
            let x = axes.x(*value);
            self.marks.push(Mark::Line(vec![[x, axes.top], [x, axes.bottom]], pen.clone()));
        }
        for (value, _) in &axes.y.ticks {
            let y = axes.y(*value);
            self.marks.push(Mark::Line(vec![[axes.left, y], [axes.right, y]], pen.clone()));
        }
    }

    /// The frame with numbers and titles.
    fn numbers(&mut self, axes: &Axes) {
        let pen = thin(self.page.ink(), 0.6);
        let mut free = f64::NEG_INFINITY;
        for (value, text) in &axes.x.ticks {
            let (at, half) = (axes.x(*value), 0.5 * width_of(text));
            self.marks.push(Mark::Line(vec![[at, axes.bottom], [at, axes.bottom - 2.5]], pen.clone()));
            if at - half > free {
                let place = [at, axes.bottom + LETTERS * LINE];
                self.lettering(Words::plain(text), place, Beside::Middle, |words| words.class = "x");
                free = at + half + 2.0;
            }
        }
        for (value, text) in &axes.y.ticks {
            let at = axes.y(*value);
            self.marks.push(Mark::Line(vec![[axes.left, at], [axes.left + 2.5, at]], pen.clone()));
            let place = [axes.left - 3.0, at + 0.35 * LETTERS];
            self.lettering(Words::plain(text), place, Beside::Left, |words| words.class = "y");
        }
        self.marks.push(Mark::Frame(axes.rect(), pen));
        let [x, y] = [&self.chart.x, &self.chart.y].map(|axis| self.chart.words(&axis.label));
        let across = [0.5 * (axes.left + axes.right), axes.bottom + 2.0 * LETTERS * LINE];
        self.lettering(x, across, Beside::Middle, |words| words.class = "x title");
        let up = [LETTERS + 2.0, 0.5 * (axes.top + axes.bottom)];
        self.lettering(y, up, Beside::Middle, |words| {
            (words.upwards, words.class) = (true, "y title");
        });
    }

    fn series(&mut self, axes: &Axes, series: &Series, pen: &Pen) {
        let places = series.points.iter().map(|point| axes.at(*point));
        if series.marks == Marks::Line {
            self.marks.push(Mark::Line(places.collect(), pen.clone()));
        } else {
            places.for_each(|place| self.mark(place, series.marks, pen));
        }
    }

    fn mark(&mut self, [x, y]: [f64; 2], marks: Marks, pen: &Pen) {
        let outline = thin(pen.color, 0.9);
        match marks {
            Marks::Line => self.marks.push(Mark::Line(vec![[x - 8.0, y], [x + 8.0, y]], pen.clone())),
            Marks::Dots => self.marks.push(Mark::Dot([x, y], DOT * pen.width, pen.color)),
            Marks::Rings => self.marks.push(Mark::Ring([x, y], 1.9, outline)),
            Marks::Crosses => {
                self.marks.push(Mark::Line(vec![[x - 2.0, y - 2.0], [x + 2.0, y + 2.0]], outline.clone()));
                self.marks.push(Mark::Line(vec![[x - 2.0, y + 2.0], [x + 2.0, y - 2.0]], outline));
            }
        }
    }

    fn legend_item(&mut self, x: f64, y: f64, k: usize) {
        let Some(series) = self.chart.series.get(k) else { return };
        self.mark([x + 8.0, y], series.marks, &series.pen.clone().unwrap_or_else(|| pen(k)));
        let name = self.chart.words(&series.name);
        self.lettering(name, [x + 19.0, y + 0.35 * LETTERS], Beside::Right, |words| words.class = "legend");
    }

    fn note(&mut self, axes: &Axes, note: &Note) {
        let [x, y] = axes.at(note.at);
        let aside = match note.beside {
            Beside::Right => 2.0,
            Beside::Middle => 0.0,
            Beside::Left => -2.0,
        };
        let down = match note.above {
            1.. => -2.0,
            0 => 0.3 * SMALL,
            _ => SMALL + 1.0,
        };
        self.lettering(note.words.clone(), [x + aside, y + down], note.beside, |words| {
            (words.size, words.class) = (SMALL, "note");
            words.color = note.color.unwrap_or(words.color);
        });
    }

    /// What the colours mean, to the right of the axes.
    fn scale(&mut self, axes: &Axes, scale: &ColorScale) {
        let [left, top, high] = [axes.right + 8.0, axes.top, axes.bottom - axes.top];
        let rect = [left, top, BAR, high];
        let rgb: Vec<u8> = scale.colors.iter().rev().flatten().copied().collect();
        self.marks.push(Mark::Image(rect, Pixels { width: 1, rgb }));
        self.marks.push(Mark::Frame(rect, thin(self.page.ink(), 0.6)));
        let (low, end) = scale.ends;
        for (value, text) in scale_ticks(scale) {
            let y = axes.bottom - (value - low) / (end - low) * high;
            let place = [left + BAR + 2.0, y + 0.35 * LETTERS];
            self.lettering(Words::plain(text), place, Beside::Right, |words| words.class = "scale");
        }
        let numbers = scale_ticks(scale).iter().map(|(_, text)| width_of(text)).fold(0.0, f64::max);
        let title = self.chart.words(&scale.label);
        let place = [left + BAR + 4.0 + numbers + LETTERS, top + 0.5 * high];
        self.lettering(title, place, Beside::Middle, |words| {
            (words.upwards, words.class) = (true, "scale title");
        });
    }
}

fn scale_ticks(scale: &ColorScale) -> Vec<(f64, String)> {
    if scale.ends.1 > scale.ends.0 { steps(scale.ends.0, scale.ends.1, 5.0) } else { Vec::new() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::drawing::PT_PER_MM;

    fn films() -> Chart {
        let mut chart =
            Chart::new("Film & load", ChartAxis::log("Load number M"), ChartAxis::linear("h [µm] <central>"));
        chart.add(
            "full",
            Marks::Line,
            (0..40).map(|k| [10f64.powf(0.06 * f64::from(k)), 0.3 - 0.001 * f64::from(k * k)]),
        );
        chart.add("reduced", Marks::Dots, [[3.0, 0.29], [30.0, -0.5]]);
        chart
    }

    fn attribute<'a>(line: &'a str, name: &str) -> &'a str {
        line.split_once(&format!(" {name}=\""))
            .and_then(|(_, rest)| rest.split_once('"'))
            .map(|(value, _)| value)
            .unwrap()
    }

    /// Abscissae or ordinates of the marks on paper and their values, as they are printed.
    fn marks(svg: &str, class: &str, name: &str) -> Vec<(f64, f64)> {
        let of_class = svg.lines().filter(|line| line.contains(&format!("class=\"{class}\"")));
        let words = |line: &str| line.split_once('>').unwrap().1.split_once('<').unwrap().0.parse().unwrap();
        of_class.map(|line| (attribute(line, name).parse().unwrap(), words(line))).collect()
    }

    #[test]
    fn the_numbers_of_the_axes_give_the_data_back() {
        for (width_mm, height_mm) in [(85.0, 60.0), (170.0, 100.0)] {
            let chart = films();
            let svg = chart.to_svg(&Page { width_mm, height_mm, ..Page::default() });
            let (across, up) = (marks(&svg, "x", "x"), marks(&svg, "y", "y"));
            // Lines of the grid have two points.
            let drawn = |line: &&str| line.starts_with("<polyline") && line.matches(',').count() > 2;
            let line = svg.lines().find(drawn).unwrap();
            let points: Vec<[f64; 2]> = attribute(line, "points")
                .split(' ')
                .map(|pair| pair.split_once(',').map(|(x, y)| [x.parse().unwrap(), y.parse().unwrap()]).unwrap())
                .collect();
            assert_eq!(points.len(), chart.series[0].points.len());
            let between = |marks: &[(f64, f64)], at: f64, log: bool| {
                let (first, last) = (marks[0], marks[marks.len() - 1]);
                let place = |value: f64| if log { value.log10() } else { value };
                let value = place(first.1) + (at - first.0) / (last.0 - first.0) * (place(last.1) - place(first.1));
                if log { 10f64.powf(value) } else { value }
            };
            // Numbers stand a little below their marks.
            let lowered = 0.35 * LETTERS;
            for (drawn, [x, y]) in points.iter().zip(&chart.series[0].points) {
                assert!((between(&across, drawn[0], true) / x - 1.0).abs() < 2e-3, "{x}");
                assert!((between(&up, drawn[1] + lowered, false) - y).abs() < 2e-3, "{y}");
            }
        }
    }

    #[test]
    fn a_page_has_its_size_its_words_and_room_for_them() {
        let caption = "M 40; L 10; R 0.012 m; u_m 3 m/s, a caption that is much too long for one line of such a page";
        let svg = films().to_svg(&Page { caption: caption.to_owned(), ..Page::default() });
        assert!(svg.starts_with("<svg ") && svg.contains("width=\"85mm\" height=\"65mm\""));
        assert!(svg.contains("Film &amp; load") && svg.contains("h [µm] &lt;central&gt;") && svg.contains("reduced"));
        assert!(svg.matches("class=\"caption\"").count() > 1);
        let (right, low) = (85.0 * PT_PER_MM, 65.0 * PT_PER_MM);
        for line in svg.lines().filter(|line| line.starts_with("<text")) {
            let (x, y): (f64, f64) = (attribute(line, "x").parse().unwrap(), attribute(line, "y").parse().unwrap());
            assert!((0.0..right).contains(&x) && (0.0..low).contains(&y), "{line}");
        }
        let dark = films().to_svg(&Page { dark: true, ..Page::default() });
        assert!(dark.contains("#eeeeee") && !dark.contains("#222222"));
    }

    #[test]
    fn nothing_to_draw_and_one_value_are_drawn_as_well() {
        let mut chart = Chart::new("t", ChartAxis::linear("x"), ChartAxis::linear("y"));
        assert!(chart.to_svg(&Page::default()).ends_with("</svg>\n"));
        chart.add("one", Marks::Line, [[0.0, 5.0]]);
        assert!(!chart.to_svg(&Page::default()).contains("NaN"));
    }
}
