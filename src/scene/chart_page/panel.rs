//! One chart in its part of a page: axes, curves, text, legend and colour bar.

use super::scale::{Scale, scale_ticks};
use super::{LETTERS, LINE, Page, SMALL};
use crate::scene::chart::{Chart, ColorScale, Map, Marks, Note, Series};
use crate::scene::drawing::{Lettering, Mark, Pen, Pixels, Rgb, TextAnchor, Words, wrapped};

/// Width of bold text over that of regular text.
const BOLD: f64 = 1.08;
/// Radius of a dot over its pen width.
const DOT: f64 = 1.4;
/// Width of the colour bar.
const BAR: f64 = 8.0;
/// Colours by Okabe and Ito that people with colour blindness can distinguish.
const COLORS: [Rgb; 6] = [
    [0x00, 0x72, 0xB2],
    [0xD5, 0x5E, 0x00],
    [0x00, 0x9E, 0x73],
    [0xCC, 0x79, 0xA7],
    [0x8A, 0x6D, 0x00],
    [0x56, 0xB4, 0xE9],
];
const DASHES: [&[f64]; 4] = [&[], &[5.0, 2.0], &[1.5, 1.5], &[6.0, 2.0, 1.5, 2.0]];

fn width_of(text: &str) -> f64 {
    Words::plain(text).length(LETTERS)
}

/// Returns the default pen of the k-th series.
fn pen(k: usize) -> Pen {
    let color = COLORS.get(k % COLORS.len()).copied().unwrap_or_default();
    let dashes = DASHES.get(k % DASHES.len()).map_or_else(Vec::new, |dashes| dashes.to_vec());
    Pen { color, opacity: 1.0, width: 1.1, dashes }
}

fn thin(color: Rgb, width: f64) -> Pen {
    Pen { color, opacity: 1.0, width, dashes: Vec::new() }
}

/// Chart that is drawn into its part of a page.
pub struct Panel<'a> {
    /// The chart.
    pub chart: &'a Chart,
    /// Page settings.
    pub page: &'a Page,
    /// Output list of marks.
    pub marks: &'a mut Vec<Mark>,
    /// Width of the page.
    pub width: f64,
}

/// Plot area and scales of the axes.
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

    /// Returns the rectangle between values. An infinite value extends it to the end of the axis.
    fn between(&self, x: (f64, f64), y: (f64, f64)) -> [f64; 4] {
        let or = |value: f64, end: f64| if value.is_finite() { value } else { end };
        let (left, right) = (or(self.x(x.0), self.left), or(self.x(x.1), self.right));
        let (bottom, top) = (or(self.y(y.0), self.bottom), or(self.y(y.1), self.top));
        [left.min(right), top.min(bottom), (right - left).abs(), (bottom - top).abs()]
    }
}

impl Panel<'_> {
    /// Draws the chart between two heights of the page.
    pub fn draw(&mut self, top: f64, bottom: f64) {
        let (chart, width) = (self.chart, self.width);
        let title = wrapped(&chart.title, BOLD * LETTERS, width - 8.0);
        let legend = chart.legend(width);
        let mut base = top + 4.0 + LETTERS;
        for line in &title {
            self.lettering(Words::plain(line), [4.0, base], TextAnchor::Right, |words| words.bold = true);
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
        for area in &chart.areas {
            let corners = area.corners.iter().map(|corner| axes.at(*corner)).collect();
            self.marks.push(Mark::Polygon(corners, area.color, area.opacity));
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

    /// Returns the plot area and scales between two heights of the page.
    fn axes(&self, top: f64, bottom: f64) -> Axes {
        let chart = self.chart;
        let bottom = bottom.max(top + 20.0);
        let all = || chart.series.iter().flat_map(|series| &series.points);
        let map =
            |end: fn(&Map) -> (f64, f64)| chart.map.as_ref().map(end).into_iter().flat_map(|(from, to)| [from, to]);
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
            // For equal scales, the longer axis is shortened.
            let (across, up) = (axes.x.to - axes.x.from, axes.y.to - axes.y.from);
            let unit = ((axes.right - axes.left) / across).min((axes.bottom - axes.top) / up);
            (axes.right, axes.bottom) = (axes.left + unit * across, axes.top + unit * up);
        }
        axes
    }

    fn lettering(&mut self, words: Words, at: [f64; 2], beside: TextAnchor, change: impl FnOnce(&mut Lettering)) {
        let color = self.page.ink();
        let mut lettering =
            Lettering { words, at, beside, upwards: false, size: LETTERS, bold: false, color, class: "".into() };
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

    /// Draws the frame with numbers and axis titles.
    fn numbers(&mut self, axes: &Axes) {
        let pen = thin(self.page.ink(), 0.6);
        let mut free = f64::NEG_INFINITY;
        for (value, text) in &axes.x.ticks {
            let (at, half) = (axes.x(*value), 0.5 * width_of(text));
            self.marks.push(Mark::Line(vec![[at, axes.bottom], [at, axes.bottom - 2.5]], pen.clone()));
            if at - half > free {
                let place = [at, axes.bottom + LETTERS * LINE];
                self.lettering(Words::plain(text), place, TextAnchor::Middle, |words| words.class = "x".into());
                free = at + half + 2.0;
            }
        }
        for (value, text) in &axes.y.ticks {
            let at = axes.y(*value);
            self.marks.push(Mark::Line(vec![[axes.left, at], [axes.left + 2.5, at]], pen.clone()));
            let place = [axes.left - 3.0, at + 0.35 * LETTERS];
            self.lettering(Words::plain(text), place, TextAnchor::Left, |words| words.class = "y".into());
        }
        self.marks.push(Mark::Frame(axes.rect(), pen));
        let [x, y] = [&self.chart.x, &self.chart.y].map(|axis| self.chart.words(&axis.label));
        let across = [0.5 * (axes.left + axes.right), axes.bottom + 2.0 * LETTERS * LINE];
        self.lettering(x, across, TextAnchor::Middle, |words| words.class = "x title".into());
        let up = [LETTERS + 2.0, 0.5 * (axes.top + axes.bottom)];
        self.lettering(y, up, TextAnchor::Middle, |words| {
            (words.upwards, words.class) = (true, "y title".into());
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
        self.lettering(name, [x + 19.0, y + 0.35 * LETTERS], TextAnchor::Right, |words| words.class = "legend".into());
    }

    fn note(&mut self, axes: &Axes, note: &Note) {
        let [x, y] = axes.at(note.at);
        let aside = match note.beside {
            TextAnchor::Right => 2.0,
            TextAnchor::Middle => 0.0,
            TextAnchor::Left => -2.0,
        };
        let down = match note.above {
            1.. => -2.0,
            0 => 0.3 * SMALL,
            _ => SMALL + 1.0,
        };
        self.lettering(note.words.clone(), [x + aside, y + down], note.beside, |words| {
            (words.size, words.class) = (SMALL, "note".into());
            words.color = note.color.unwrap_or(words.color);
        });
    }

    /// Draws the colour bar to the right of the axes.
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
            self.lettering(Words::plain(text), place, TextAnchor::Right, |words| words.class = "scale".into());
        }
        let numbers = scale_ticks(scale).iter().map(|(_, text)| width_of(text)).fold(0.0, f64::max);
        let title = self.chart.words(&scale.label);
        let place = [left + BAR + 4.0 + numbers + LETTERS, top + 0.5 * high];
        self.lettering(title, place, TextAnchor::Middle, |words| {
            (words.upwards, words.class) = (true, "scale title".into());
        });
    }
}
