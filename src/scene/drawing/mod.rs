//! Drawings for print: lines, areas, words and images at places in points of a printer, written as SVG or, by the same
//! list, as PNG with any resolution. Letters are those that the program ships, so that nothing depends on a system.

use serde::{Deserialize, Serialize};
use std::borrow::Cow;

mod png;
mod svg;
mod words;

pub use png::{DPI, PngError, encode};
pub use svg::escaped;
pub use words::{Words, wrapped};

/// Points of a printer in a millimetre.
pub const PT_PER_MM: f64 = 72.0 / 25.4;

/// A colour: red, green, blue.
pub type Rgb = [u8; 3];

/// How a line is drawn.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pen {
    /// Its colour.
    pub color: Rgb,
    /// How much it covers, 0 to 1.
    pub opacity: f64,
    /// Its width \[pt\].
    pub width: f64,
    /// Lengths of dashes and of gaps in turn \[pt\]; none for a line without gaps.
    pub dashes: Vec<f64>,
}

/// Where words stand beside their place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Beside {
    /// They begin there.
    Right,
    /// Their middle is there.
    Middle,
    /// They end there.
    Left,
}

/// Words on a drawing, on one line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Lettering {
    /// The words.
    pub words: Words,
    /// Where their baseline begins, is halved, or ends \[pt\].
    pub at: [f64; 2],
    /// Which of these.
    pub beside: Beside,
    /// Whether they run upwards.
    pub upwards: bool,
    /// Size of their letters \[pt\].
    pub size: f64,
    /// Whether they are heavy.
    pub bold: bool,
    /// Their colour.
    pub color: Rgb,
    /// What they are, for programs that read the drawing; empty where nobody asks.
    pub class: Cow<'static, str>,
}

/// Pixels over a rectangle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pixels {
    /// How many across.
    pub width: usize,
    /// Rows from the top, each from the left: red, green, blue.
    pub rgb: Vec<u8>,
}

/// What is drawn. Rectangles are left, top, width and height \[pt\].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Mark {
    /// A line through points.
    Line(Vec<[f64; 2]>, Pen),
    /// A filled rectangle: its colour, and how much it covers.
    Area([f64; 4], Rgb, f64),
    /// The outline of a rectangle.
    Frame([f64; 4], Pen),
    /// A filled circle: centre, radius, colour.
    Dot([f64; 2], f64, Rgb),
    /// A circle.
    Ring([f64; 2], f64, Pen),
    /// An image over a rectangle.
    Image([f64; 4], Pixels),
    /// Words.
    Words(Lettering),
    /// What follows is cut off outside a rectangle, until the next of these.
    Within(Option<[f64; 4]>),
}

/// A drawing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Drawing {
    /// Width and height \[mm\].
    pub size_mm: [f64; 2],
    /// What it is called.
    pub title: String,
    /// The paper.
    pub ground: Rgb,
    /// What is on it, the first below all others.
    pub marks: Vec<Mark>,
}

impl Pixels {
    /// Rows of pixels.
    pub fn height(&self) -> usize {
        self.rgb.len() / (3 * self.width.max(1))
    }
}

impl Drawing {
    /// Width and height \[pt\].
    pub fn size(&self) -> [f64; 2] {
        self.size_mm.map(|mm| mm * PT_PER_MM)
    }
}
