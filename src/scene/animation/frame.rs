//! Frames of an animation: charts at the left and at the right above a caption, as an image for slides.

use crate::scene::chart::{Chart, Marks};
use crate::scene::chart_page::{Page, drawn};
use crate::scene::drawing::{AnimationError, Drawing, Lettering, Mark, Pen, Rgb, TextAnchor, Words, animated};
use crate::solver::observer::{Observer, Progress};

/// Width and height of a frame in pixels, and their resolution in dots per inch.
const PIXELS: [f64; 2] = [960.0, 540.0];
const DPI: f64 = 144.0;
/// Share of the width at the left.
const LEFT: f64 = 0.58;
/// Height of the caption \[pt\], and of its letters.
const CAPTION: f64 = 16.0;
const LETTERS: f64 = 8.5;
/// Abscissae X of profiles.
pub(super) const ALONG: (f64, f64) = (-2.2, 1.6);
/// Colours of pressure, film thickness and references.
pub(super) const PRESSURE: Rgb = [0xd5, 0x5e, 0x00];
pub(super) const FILM: Rgb = [0x00, 0x72, 0xb2];
pub(super) const REFERENCE: Rgb = [0x88, 0x88, 0x88];

/// Draws `count` frames and encodes them.
pub(super) fn encoded(
    count: usize,
    observer: &dyn Observer,
    frame: impl Fn(usize) -> Result<Drawing, AnimationError>,
) -> Result<Vec<u8>, AnimationError> {
    animated(count, |k| {
        observer.progress(Progress { stage: "drawing".to_owned(), done: k, total: count });
        if observer.cancelled() {
            return Err(AnimationError::Drawing("the animation was cancelled".to_owned()));
        }
        frame(k)?.to_pixels(DPI).map_err(|error| AnimationError::Drawing(error.to_string()))
    })
}

/// Returns charts at the left and at the right above a caption, in which braces mark symbols.
pub(super) fn composed((left, right): (&[Chart], &[Chart]), caption: &str, dark: bool) -> Drawing {
    let size_mm = PIXELS.map(|pixels| 25.4 * pixels / DPI);
    let [width, height] = size_mm;
    let page = |share: f64| Page {
        width_mm: share * width,
        height_mm: height - CAPTION * 25.4 / 72.0,
        dark,
        caption: String::new(),
    };
    let mut drawing = drawn(left, &page(LEFT));
    let offset = [drawing.size()[0], 0.0];
    let beside = drawn(right, &page(1.0 - LEFT));
    drawing.marks.extend(beside.marks.into_iter().map(|mark| mark.moved(offset)));
    drawing.size_mm = size_mm;
    let words = Lettering {
        words: Words::marked(caption),
        at: [8.0, drawing.size()[1] - 0.35 * CAPTION],
        beside: TextAnchor::Right,
        upwards: false,
        size: LETTERS,
        bold: false,
        color: if dark { [0xee; 3] } else { [0x22; 3] },
        class: "caption".into(),
    };
    drawing.marks.push(Mark::Words(words));
    drawing
}

/// Adds a line with its colour and width.
pub(super) fn add(chart: &mut Chart, name: &str, look: (Rgb, f64), points: impl IntoIterator<Item = [f64; 2]>) {
    put(chart, name, Marks::Line, look, points);
}

/// Adds a dot.
pub(super) fn dot(chart: &mut Chart, color: Rgb, at: [f64; 2]) {
    put(chart, "", Marks::Dots, (color, 2.0), [at]);
}

fn put(
    chart: &mut Chart,
    name: &str,
    marks: Marks,
    (color, width): (Rgb, f64),
    points: impl IntoIterator<Item = [f64; 2]>,
) {
    let before = chart.series.len();
    chart.add(name, marks, points);
    if let Some(series) = chart.series.get_mut(before) {
        series.pen = Some(Pen { color, opacity: 1.0, width, dashes: Vec::new() });
    }
}
