//! Charts of study results as plain data: lines and points over axes with units.

use super::drawing::{Pen, Pixels, Rgb, TextAnchor, Words};
use super::table::Table;

/// A chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// Title above the chart.
    pub title: String,
    /// Horizontal axis.
    pub x: ChartAxis,
    /// Vertical axis.
    pub y: ChartAxis,
    /// Series in drawing order: the first one is below all others.
    pub series: Vec<Series>,
    /// Colour map below everything else.
    pub map: Option<Map>,
    /// Filled areas behind the series.
    pub bands: Vec<Band>,
    /// Filled polygons behind the series.
    pub areas: Vec<Area>,
    /// Text notes inside the axes.
    pub notes: Vec<Note>,
    /// True if both axes have the same scale.
    pub equal: bool,
    /// True if braces in axis labels and names mark symbols, as in `{H_c}`.
    pub marked: bool,
    /// Names of the quantities along both axes in results, if the chart shows values of results as they are.
    pub quantities: Option<[String; 2]>,
}

/// An axis of a chart.
#[derive(Clone, Debug, PartialEq)]
pub struct ChartAxis {
    /// Quantity, with its unit if it has one.
    pub label: String,
    /// True for a logarithmic axis.
    pub log: bool,
    /// First and last value; `None` to fit the data.
    pub ends: Option<(f64, f64)>,
    /// Named positions shown in place of numbers; empty for a numeric axis.
    pub names: Vec<(f64, String)>,
}

/// Points of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name for the legend.
    pub name: String,
    /// How they are drawn.
    pub marks: Marks,
    /// Abscissa and ordinate, always finite.
    pub points: Vec<[f64; 2]>,
    /// Line style and colour of marks; `None` to let the chart choose.
    pub pen: Option<Pen>,
}

/// Field over the axes, drawn as an image.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// Horizontal extent.
    pub x: (f64, f64),
    /// Vertical extent.
    pub y: (f64, f64),
    /// Its pixels.
    pub pixels: Pixels,
    /// Scale that explains the colours.
    pub scale: Option<ColorScale>,
}

/// Colour scale of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct ColorScale {
    /// The quantity, with its unit.
    pub label: String,
    /// Values at the lower and the upper end.
    pub ends: (f64, f64),
    /// Colours from the lower end to the upper one.
    pub colors: Vec<Rgb>,
}

/// Filled rectangle. An infinite end extends to the end of the axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    /// Horizontal extent.
    pub x: (f64, f64),
    /// Vertical extent.
    pub y: (f64, f64),
    /// Its colour.
    pub color: Rgb,
    /// Opacity, 0 to 1.
    pub opacity: f64,
}

/// Filled polygon.
#[derive(Clone, Debug, PartialEq)]
pub struct Area {
    /// Corners in order, always finite.
    pub corners: Vec<[f64; 2]>,
    /// Its colour.
    pub color: Rgb,
    /// Opacity, 0 to 1.
    pub opacity: f64,
}

/// Text at a position in the axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Note {
    /// Position.
    pub at: [f64; 2],
    /// Text.
    pub words: Words,
    /// Horizontal side of the position on which the text stands.
    pub beside: TextAnchor,
    /// Vertical placement: above the position (1), on it (0) or below it (−1).
    pub above: i8,
    /// Colour of the text; `None` for the colour of the axes.
    pub color: Option<Rgb>,
}

/// How points are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marks {
    /// Joined by a line.
    Line,
    /// Dots.
    Dots,
    /// Crosses, for failures.
    Crosses,
    /// Open circles.
    Rings,
}

impl Chart {
    /// Returns an empty chart.
    pub fn new(title: impl Into<String>, x: ChartAxis, y: ChartAxis) -> Self {
        Self {
            title: title.into(),
            x,
            y,
            series: Vec::new(),
            map: None,
            bands: Vec::new(),
            areas: Vec::new(),
            notes: Vec::new(),
            equal: false,
            marked: false,
            quantities: None,
        }
    }

    /// Adds a series of the points that are finite and can be drawn on the axes. Adds nothing if there are none.
    pub fn add(&mut self, name: impl Into<String>, marks: Marks, points: impl IntoIterator<Item = [f64; 2]>) {
        let shown = |point: &[f64; 2]| {
            let [x, y] = *point;
            x.is_finite() && y.is_finite() && (x > 0.0 || !self.x.log) && (y > 0.0 || !self.y.log)
        };
        let points: Vec<[f64; 2]> = points.into_iter().filter(shown).collect();
        if !points.is_empty() {
            self.series.push(Series { name: name.into(), marks, points, pen: None });
        }
    }

    /// Parses text with or without marked symbols, as set in [`Chart::marked`].
    pub fn words(&self, text: &str) -> Words {
        if self.marked { Words::marked(text) } else { Words::plain(text) }
    }

    /// Returns the drawn numbers as a table: one row per point, labelled with the name of its series.
    pub fn to_table(&self) -> Table {
        let [x, y] = [&self.x, &self.y].map(|axis| self.words(&axis.label).text());
        let mut table = Table::new(self.title.clone(), &[&x, &y]);
        for series in &self.series {
            let name = self.words(&series.name).text();
            table.labels.extend(series.points.iter().map(|_| name.clone()));
            table.rows.extend(series.points.iter().map(|point| point.to_vec()));
        }
        table
    }
}

impl ChartAxis {
    /// Returns a logarithmic (`log`) or linear axis.
    pub fn new(label: impl Into<String>, log: bool) -> Self {
        Self { label: label.into(), log, ends: None, names: Vec::new() }
    }

    /// Returns a linear axis.
    pub fn linear(label: impl Into<String>) -> Self {
        Self::new(label, false)
    }

    /// Returns a logarithmic axis.
    pub fn log(label: impl Into<String>) -> Self {
        Self::new(label, true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_drawn_is_left_out() {
        let mut chart = Chart::new("t", ChartAxis::log("x"), ChartAxis::linear("y"));
        chart.add("some", Marks::Line, [[1.0, -2.0], [0.0, 1.0], [2.0, f64::NAN]]);
        chart.add("none", Marks::Dots, [[-1.0, 1.0]]);
        assert_eq!(chart.series.len(), 1);
        assert_eq!(chart.series[0].points, [[1.0, -2.0]]);
    }
}
