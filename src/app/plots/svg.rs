//! Figures for other programs (SVG): a page with text, and charts with axes and curves on it.

use super::axes;
use egui_plot::{GridInput, GridMark};
use std::fmt::Write as _;

/// Hues of pressure, film and traction on paper.
pub const PRESSURE: &str = "#D55E00";
pub const FILM: &str = "#0072B2";
pub const TRACTION: &str = "#A8478A";

/// A white page that is written on.
pub struct Page {
    out: String,
}

impl Page {
    /// An empty one.
    pub fn new(width: f64, height: f64) -> Self {
        let mut out = String::new();
        // Writing to a string cannot fail, here and below.
        let _ok = writeln!(
            out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" viewBox=\"0 0 {width:.0} {height:.0}\" \
             font-family=\"sans-serif\" font-size=\"13\" fill=\"#222\">\n<rect width=\"{width:.0}\" height=\"{height:.0}\" fill=\"#fff\"/>"
        );
        Self { out }
    }

    /// Text at a place, with attributes of its own.
    pub fn text(&mut self, (x, y): (f64, f64), style: &str, content: &str) {
        let content = content.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
        self.line(&format!("<text x=\"{x:.1}\" y=\"{y:.1}\" {style}>{content}</text>"));
    }

    /// A line as it stands.
    pub fn line(&mut self, line: &str) {
        let _ok = writeln!(self.out, "{line}");
    }

    /// The whole figure.
    pub fn finish(mut self) -> String {
        self.out.push_str("</svg>\n");
        self.out
    }
}

/// A curve: attributes of its line, and its points.
pub struct Curve<'a> {
    /// Such as colour, width and dashes.
    pub stroke: String,
    /// In the units of the axes.
    pub points: &'a [[f64; 2]],
}

/// A rectangle on the page with what its edges stand for.
#[derive(Clone, Copy)]
pub struct Chart<'a> {
    /// Unlike that of other charts on the page.
    pub id: usize,
    /// Left and top.
    pub place: (f64, f64),
    /// Width and height.
    pub size: (f64, f64),
    /// Values at the left and the right edge.
    pub x: (f64, f64),
    /// Values at the lower and the upper edge.
    pub y: (f64, f64),
    /// Titles of both axes.
    pub titles: (&'a str, &'a str),
    /// Whether the values along and up are logarithms to base 10.
    pub logarithmic: (bool, bool),
}

impl Chart<'_> {
    /// Draws axes and curves.
    pub fn draw<'c>(&self, page: &mut Page, curves: impl IntoIterator<Item = Curve<'c>>) {
        let ((left, top), (width, height), id) = (self.place, self.size, self.id);
        page.line(&format!(
            "<clipPath id=\"chart{id}\"><rect x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\"/></clipPath>\n\
             <rect x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" fill=\"none\" stroke=\"#999\"/>"
        ));
        for (mark, label) in marks(self.x, width / 60.0, self.logarithmic.0) {
            let (x, below) = (self.across(mark), top + height);
            page.line(&format!("<path d=\"M{x:.1} {top}V{below}\" stroke=\"#ddd\"/>"));
            page.text((x, below + 15.0), "font-size=\"11\" text-anchor=\"middle\"", &label);
        }
        for (mark, label) in marks(self.y, height / 36.0, self.logarithmic.1) {
            let (y, right) = (self.up(mark), left + width);
            page.line(&format!("<path d=\"M{left} {y:.1}H{right}\" stroke=\"#ddd\"/>"));
            page.text((left - 6.0, y + 4.0), "font-size=\"11\" text-anchor=\"end\"", &label);
        }
        for Curve { stroke, points } in curves.into_iter().filter(|curve| !curve.points.is_empty()) {
            let points: Vec<String> =
                points.iter().map(|[x, y]| format!("{:.2},{:.2}", self.across(*x), self.up(*y))).collect();
            let points = points.join(" ");
            page.line(&format!("<polyline clip-path=\"url(#chart{id})\" {stroke} points=\"{points}\"/>"));
        }
        let middle = (left + 0.5 * width, top + height + 30.0);
        page.text(middle, "font-size=\"12\" font-style=\"italic\" text-anchor=\"middle\"", self.titles.0);
        page.text((left + 6.0, top + 15.0), "font-size=\"12\" font-style=\"italic\"", self.titles.1);
    }

    /// Sets a ring at each of some points.
    pub fn rings(&self, page: &mut Page, color: &str, points: &[[f64; 2]]) {
        for [x, y] in points {
            page.line(&format!(
                "<circle clip-path=\"url(#chart{})\" cx=\"{:.2}\" cy=\"{:.2}\" r=\"4\" fill=\"none\" stroke=\"{color}\"/>",
                self.id,
                self.across(*x),
                self.up(*y)
            ));
        }
    }

    fn across(&self, x: f64) -> f64 {
        self.place.0 + self.size.0 * (x - self.x.0) / (self.x.1 - self.x.0)
    }

    fn up(&self, y: f64) -> f64 {
        self.place.1 + self.size.1 * (self.y.1 - y) / (self.y.1 - self.y.0)
    }
}

/// Marks of an axis with their labels; about `wanted` of them where the axis is linear.
fn marks(bounds: (f64, f64), wanted: f64, logarithmic: bool) -> Vec<(f64, String)> {
    let input = GridInput { bounds, base_step_size: 1.0 };
    let linear = |mark: GridMark| format!("{}", (mark.value * 1e9).round() / 1e9).replace('-', "−");
    if logarithmic {
        axes::log_marks(input).into_iter().map(|mark| (mark.value, axes::log_label(mark))).collect()
    } else {
        axes::round_marks(input, wanted).into_iter().map(|mark| (mark.value, linear(mark))).collect()
    }
}

/// The range of all values with some room; never empty.
pub fn range<'a>(values: impl IntoIterator<Item = &'a f64>) -> (f64, f64) {
    let wider = |(low, high): (f64, f64), v: &f64| (low.min(*v), high.max(*v));
    let (low, high) = values.into_iter().fold((f64::INFINITY, f64::NEG_INFINITY), wider);
    let room = (0.06 * (high - low)).max(1e-9 * high.abs()).max(f64::MIN_POSITIVE);
    if low <= high { (low - room, high + room) } else { (-1.0, 1.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_hold_all_values_and_are_never_empty() {
        let (low, high) = range(&[1.0, 3.0, 2.0]);
        assert!(low < 1.0 && high > 3.0);
        for flat in [vec![2.0], vec![0.0], Vec::new()] {
            let (low, high) = range(&flat);
            assert!(low < high, "{flat:?}");
        }
    }

    #[test]
    fn logarithmic_axes_name_round_values() {
        let labels: Vec<String> = marks((-2.0, 0.0), 5.0, true).into_iter().map(|mark| mark.1).collect();
        for label in ["0.01", "0.02", "0.05", "0.1", "0.5", "1"] {
            assert!(labels.iter().any(|l| l == label), "{label} in {labels:?}");
        }
    }

    #[test]
    fn text_cannot_break_out_of_its_element() {
        let mut page = Page::new(10.0, 10.0);
        page.text((0.0, 0.0), "", "a < b & c");
        assert!(page.finish().contains("a &lt; b &amp; c"));
    }
}
