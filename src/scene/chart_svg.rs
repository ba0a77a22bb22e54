//! A chart as a drawing for print (SVG): sizes in millimetres, axes with their names and units, a legend that covers
//! nothing, a caption below. Lines differ by dashes as well as by colour, so that they can be told apart in grey.

use super::chart::{Chart, ChartAxis, Marks};
use super::table::significant;
use std::fmt::Write as _;

/// Points of a printer in a millimetre.
const PT_PER_MM: f64 = 72.0 / 25.4;
/// Size of the letters \[pt\].
const LETTERS: f64 = 8.0;
/// Width of a letter over its size, about; a little more than most have.
const LETTER_WIDTH: f64 = 0.56;
/// Distance of lines of text over the size of letters.
const LINE: f64 = 1.3;
/// Colours by Okabe and Ito that can be told apart by all.
const COLORS: [&str; 6] = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#8A6D00", "#56B4E9"];
const DASHES: [&str; 4] = ["", "5 2", "1.5 1.5", "6 2 1.5 2"];

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

/// An axis as it is drawn: its ends and its marks, in the coordinate that is linear on paper.
struct Scale {
    log: bool,
    from: f64,
    to: f64,
    ticks: Vec<(f64, String)>,
}

impl Scale {
    fn of(axis: &ChartAxis, values: impl Iterator<Item = f64>) -> Self {
        let place = |value: f64| if axis.log { value.log10() } else { value };
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
        (from, to) = (from - margin, to + margin);
        Self { log: axis.log, from, to, ticks: if axis.log { decades(from, to) } else { steps(from, to) } }
    }

    /// Where a value lies between both ends, 0 to 1.
    fn share(&self, value: f64) -> f64 {
        ((if self.log { value.log10() } else { value }) - self.from) / (self.to - self.from)
    }
}

/// Marks at multiples of 1, 2 or 5.
fn steps(from: f64, to: f64) -> Vec<(f64, String)> {
    let rough = (to - from) / 5.0;
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

/// Text in lines of at most so many letters, broken between words.
pub fn wrapped(text: &str, letters: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + word.chars().count() < letters => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

fn width_of(text: &str) -> f64 {
    text.chars().count() as f64 * LETTER_WIDTH * LETTERS
}

/// Text for XML.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// A series' colour and dashes.
fn pen(k: usize) -> (&'static str, &'static str) {
    let color = COLORS.get(k % COLORS.len()).copied().unwrap_or("#000");
    (color, DASHES.get(k % DASHES.len()).copied().unwrap_or(""))
}

impl Chart {
    /// The chart on a page.
    pub fn to_svg(&self, page: &Page) -> String {
        let (width, height) = (page.width_mm * PT_PER_MM, page.height_mm * PT_PER_MM);
        let all = || self.series.iter().flat_map(|series| &series.points);
        let (x, y) = (Scale::of(&self.x, all().map(|p| p[0])), Scale::of(&self.y, all().map(|p| p[1])));
        let caption = wrapped(&page.caption, ((width - 8.0) / (0.85 * LETTER_WIDTH * LETTERS)) as usize);
        let legend = self.legend(width);
        let title = wrapped(&self.title, ((width - 8.0) / (LETTER_WIDTH * LETTERS)) as usize);
        let top = 4.0 + LETTERS * LINE * (title.len() + legend.len()) as f64 + 4.0;
        let below = 0.85 * LETTERS * LINE * caption.len() as f64;
        let bottom = height - below - LETTERS * (2.0 * LINE) - 8.0;
        let left = 8.0 + LETTERS * LINE + y.ticks.iter().map(|(_, text)| width_of(text)).fold(0.0, f64::max);
        let mut drawing = Drawing {
            text: String::new(),
            frame: [left, width - 8.0, top, bottom.max(top + 20.0)],
            ink: if page.dark { "#eeeeee" } else { "#222222" },
            grid: if page.dark { "#444444" } else { "#dddddd" },
        };
        let ground = if page.dark { "#1b1b1b" } else { "#ffffff" };
        drawing.line(format_args!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}mm\" height=\"{}mm\" viewBox=\"0 0 {width:.2} {height:.2}\" \
             font-family=\"sans-serif\" font-size=\"{LETTERS}\">",
            page.width_mm, page.height_mm
        ));
        drawing.line(format_args!("<title>{}</title>", escaped(&self.title)));
        drawing.line(format_args!("<rect width=\"{width:.2}\" height=\"{height:.2}\" fill=\"{ground}\"/>"));
        let mut base = 4.0 + LETTERS;
        for line in &title {
            drawing.words(4.0, base, "start", line, "font-weight=\"bold\"");
            base += LETTERS * LINE;
        }
        for line in &legend {
            for (k, at) in line {
                drawing.legend_item(*at, base - 0.35 * LETTERS, *k, self);
            }
            base += LETTERS * LINE;
        }
        drawing.axes(&x, &y, [&self.x.label, &self.y.label]);
        for (k, series) in self.series.iter().enumerate() {
            drawing.series(k, series.marks, series.points.iter().map(|p| [x.share(p[0]), y.share(p[1])]));
        }
        let first = height - below - 4.0 + 0.85 * LETTERS;
        for (k, line) in caption.iter().enumerate() {
            let at = first + 0.85 * LETTERS * LINE * k as f64;
            drawing.words(4.0, at, "start", line, "class=\"caption\" font-size=\"6.8\"");
        }
        drawing.text.push_str("</svg>\n");
        drawing.text
    }

    /// Which series stand in each line of the legend, and where.
    fn legend(&self, width: f64) -> Vec<Vec<(usize, f64)>> {
        if self.series.len() < 2 && self.series.iter().all(|series| series.name == self.title) {
            return Vec::new();
        }
        let mut lines: Vec<Vec<(usize, f64)>> = vec![Vec::new()];
        let mut at = 4.0;
        for (k, series) in self.series.iter().enumerate() {
            let wide = 26.0 + width_of(&series.name);
            if at + wide > width && at > 4.0 {
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

struct Drawing {
    text: String,
    /// Left, right, top and bottom of what the axes enclose.
    frame: [f64; 4],
    ink: &'static str,
    grid: &'static str,
}

impl Drawing {
    fn line(&mut self, line: std::fmt::Arguments<'_>) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.text, "{line}");
    }

    fn words(&mut self, x: f64, y: f64, anchor: &str, words: &str, more: &str) {
        let ink = self.ink;
        self.line(format_args!(
            "<text x=\"{x:.2}\" y=\"{y:.2}\" text-anchor=\"{anchor}\" fill=\"{ink}\" {more}>{}</text>",
            escaped(words)
        ));
    }

    fn axes(&mut self, x: &Scale, y: &Scale, [x_label, y_label]: [&str; 2]) {
        let ([left, right, top, bottom], grid, ink) = (self.frame, self.grid, self.ink);
        let mut free = f64::NEG_INFINITY;
        for (value, text) in &x.ticks {
            let at = left + x.share(*value) * (right - left);
            self.line(format_args!(
                "<path d=\"M{at:.2} {top:.2}V{bottom:.2}\" stroke=\"{grid}\" stroke-width=\"0.4\"/>"
            ));
            let half = 0.5 * width_of(text);
            if at - half > free {
                self.words(at, bottom + LETTERS * LINE, "middle", text, "class=\"x\"");
                free = at + half + 2.0;
            }
        }
        for (value, text) in &y.ticks {
            let at = bottom - y.share(*value) * (bottom - top);
            self.line(format_args!(
                "<path d=\"M{left:.2} {at:.2}H{right:.2}\" stroke=\"{grid}\" stroke-width=\"0.4\"/>"
            ));
            self.words(left - 3.0, at + 0.35 * LETTERS, "end", text, "class=\"y\"");
        }
        let (wide, high) = (right - left, bottom - top);
        self.line(format_args!(
            "<rect x=\"{left:.2}\" y=\"{top:.2}\" width=\"{wide:.2}\" height=\"{high:.2}\" fill=\"none\" stroke=\"{ink}\" stroke-width=\"0.6\"/>"
        ));
        self.words(0.5 * (left + right), bottom + 2.0 * LETTERS * LINE, "middle", x_label, "");
        let middle = 0.5 * (top + bottom);
        let turned = format!("transform=\"rotate(-90 {:.2} {middle:.2})\"", LETTERS + 2.0);
        self.words(LETTERS + 2.0, middle, "middle", y_label, &turned);
    }

    fn series(&mut self, k: usize, marks: Marks, places: impl Iterator<Item = [f64; 2]>) {
        let ([left, right, top, bottom], (color, dashes)) = (self.frame, pen(k));
        let on_paper = |[x, y]: [f64; 2]| [left + x * (right - left), bottom - y * (bottom - top)];
        let places = places.map(on_paper);
        match marks {
            Marks::Line => {
                let points: Vec<String> = places.map(|[x, y]| format!("{x:.3},{y:.3}")).collect();
                let dashes = if dashes.is_empty() { String::new() } else { format!(" stroke-dasharray=\"{dashes}\"") };
                self.line(format_args!(
                    "<polyline points=\"{}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"1.1\" stroke-linejoin=\"round\"{dashes}/>",
                    points.join(" ")
                ));
            }
            Marks::Dots => places.for_each(|[x, y]| {
                self.line(format_args!("<circle cx=\"{x:.3}\" cy=\"{y:.3}\" r=\"1.5\" fill=\"{color}\"/>"));
            }),
            Marks::Crosses => places.for_each(|[x, y]| {
                self.line(format_args!(
                    "<path d=\"M{:.2} {:.2}l4 4m0 -4l-4 4\" stroke=\"{color}\" stroke-width=\"0.9\" fill=\"none\"/>",
                    x - 2.0,
                    y - 2.0
                ));
            }),
        }
    }

    fn legend_item(&mut self, x: f64, y: f64, k: usize, chart: &Chart) {
        let Some(series) = chart.series.get(k) else { return };
        let (color, dashes) = pen(k);
        match series.marks {
            Marks::Line => self.line(format_args!(
                "<path class=\"legend\" d=\"M{x:.2} {y:.2}h16\" stroke=\"{color}\" stroke-width=\"1.1\" stroke-dasharray=\"{dashes}\"/>"
            )),
            Marks::Dots => {
                self.line(format_args!("<circle class=\"legend\" cx=\"{:.2}\" cy=\"{y:.2}\" r=\"1.5\" fill=\"{color}\"/>", x + 8.0));
            }
            Marks::Crosses => self.line(format_args!(
                "<path class=\"legend\" d=\"M{:.2} {:.2}l4 4m0 -4l-4 4\" stroke=\"{color}\" stroke-width=\"0.9\"/>",
                x + 6.0,
                y - 2.0
            )),
        }
        self.words(x + 19.0, y + 0.35 * LETTERS, "start", &series.name, "");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
            let line = svg.lines().find(|line| line.starts_with("<polyline")).unwrap();
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
