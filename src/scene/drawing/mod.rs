//! Drawings for print: lines, areas, text and images with positions in points, written as SVG, as PDF, or as PNG
//! with any resolution. The program ships the font, so that drawings do not depend on the system.

use serde::{Deserialize, Serialize};
use std::borrow::Cow;

mod animation;
mod color_map;
mod pdf;
mod png;
mod svg;
mod words;

pub use animation::{AnimationError, animated};
pub use color_map::viridis;
pub use png::{DPI, PngError, encode};
pub use svg::escaped;
pub use words::{Words, wrapped};

/// Printer's points (pt) per millimetre.
pub const PT_PER_MM: f64 = 72.0 / 25.4;

/// Colour: red, green, blue.
pub type Rgb = [u8; 3];

/// Line style.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pen {
    /// Colour.
    pub color: Rgb,
    /// Opacity, 0 to 1.
    pub opacity: f64,
    /// Width \[pt\].
    pub width: f64,
    /// Lengths of dashes and gaps in turn \[pt\]; empty for a solid line.
    pub dashes: Vec<f64>,
}

/// Horizontal alignment of text at a position.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum TextAnchor {
    /// Text begins at the position.
    Right,
    /// Text is centred at the position.
    Middle,
    /// Text ends at the position.
    Left,
}

/// One line of text on a drawing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Lettering {
    /// The text.
    pub words: Words,
    /// Position of the baseline \[pt\].
    pub at: [f64; 2],
    /// Alignment at this position.
    pub beside: TextAnchor,
    /// True if the text runs upwards.
    pub upwards: bool,
    /// Font size \[pt\].
    pub size: f64,
    /// True for bold text.
    pub bold: bool,
    /// Colour.
    pub color: Rgb,
    /// Class for programs that read the SVG; may be empty.
    pub class: Cow<'static, str>,
}

/// Image in pixels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pixels {
    /// Number of pixels per row.
    pub width: usize,
    /// Pixels as red, green, blue, row by row from the top left.
    pub rgb: Vec<u8>,
}

/// Element of a drawing. Rectangles are left, top, width and height \[pt\].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Mark {
    /// Line through points.
    Line(Vec<[f64; 2]>, Pen),
    /// Filled rectangle: rectangle, colour, opacity.
    Area([f64; 4], Rgb, f64),
    /// Filled polygon: corners in order, colour, opacity.
    Polygon(Vec<[f64; 2]>, Rgb, f64),
    /// Outline of a rectangle.
    Frame([f64; 4], Pen),
    /// Filled circle: centre, radius, colour.
    Dot([f64; 2], f64, Rgb),
    /// Circle: centre, radius, pen.
    Ring([f64; 2], f64, Pen),
    /// Image in a rectangle.
    Image([f64; 4], Pixels),
    /// Text.
    Words(Lettering),
    /// Clips the following elements to a rectangle, until the next element of this kind.
    Within(Option<[f64; 4]>),
}

/// Drawing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Drawing {
    /// Width and height \[mm\].
    pub size_mm: [f64; 2],
    /// Title.
    pub title: String,
    /// Background colour.
    pub ground: Rgb,
    /// Elements in drawing order: the first one is below all others.
    pub marks: Vec<Mark>,
}

impl Mark {
    /// Returns the element moved right and down \[pt\].
    pub fn moved(self, by: [f64; 2]) -> Self {
        let point = |[x, y]: [f64; 2]| [x + by[0], y + by[1]];
        let area = |[x, y, width, height]: [f64; 4]| [x + by[0], y + by[1], width, height];
        match self {
            Self::Line(points, pen) => Self::Line(points.into_iter().map(point).collect(), pen),
            Self::Area(rect, color, opacity) => Self::Area(area(rect), color, opacity),
            Self::Polygon(corners, color, opacity) => {
                Self::Polygon(corners.into_iter().map(point).collect(), color, opacity)
            }
            Self::Frame(rect, pen) => Self::Frame(area(rect), pen),
            Self::Dot(at, radius, color) => Self::Dot(point(at), radius, color),
            Self::Ring(at, radius, pen) => Self::Ring(point(at), radius, pen),
            Self::Image(rect, pixels) => Self::Image(area(rect), pixels),
            Self::Words(words) => Self::Words(Lettering { at: point(words.at), ..words }),
            Self::Within(rect) => Self::Within(rect.map(area)),
        }
    }
}

impl Pixels {
    /// Returns the number of rows.
    pub fn height(&self) -> usize {
        self.rgb.len() / (3 * self.width.max(1))
    }
}

impl Drawing {
    /// Returns width and height \[pt\].
    pub fn size(&self) -> [f64; 2] {
        self.size_mm.map(|mm| mm * PT_PER_MM)
    }
}
