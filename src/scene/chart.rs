//! How rows are best looked at: lines and points over axes with units, as plain data.

use super::drawing::{Beside, Pen, Pixels, Rgb, Words};
use super::table::Table;

/// A chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// What it shows.
    pub title: String,
    /// What runs to the right.
    pub x: ChartAxis,
    /// What runs upwards.
    pub y: ChartAxis,
    /// What is drawn, the first one below all others.
    pub series: Vec<Series>,
    /// A map below everything.
    pub map: Option<Map>,
    /// Areas behind the series.
    pub bands: Vec<Band>,
    /// Words among the series.
    pub notes: Vec<Note>,
    /// Whether both axes have one scale.
    pub equal: bool,
    /// Whether braces in titles of axes and in names mark symbols, as in `{H_c}`.
    pub marked: bool,
}

/// An axis of a chart.
#[derive(Clone, Debug, PartialEq)]
pub struct ChartAxis {
    /// What it counts, with its unit where it has one.
    pub label: String,
    /// Whether equal lengths are equal ratios.
    pub log: bool,
    /// Where it begins and ends; none where the data say it.
    pub ends: Option<(f64, f64)>,
    /// Places with names in place of numbers; none where it counts.
    pub names: Vec<(f64, String)>,
}

/// Points of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// What they are, for the legend.
    pub name: String,
    /// How they are drawn.
    pub marks: Marks,
    /// Abscissa and ordinate, always finite.
    pub points: Vec<[f64; 2]>,
    /// How a line is drawn, and the colour of marks; none where the chart may choose.
    pub pen: Option<Pen>,
}

/// A field over the axes as an image.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// From where to where it lies to the right.
    pub x: (f64, f64),
    /// And upwards.
    pub y: (f64, f64),
    /// Its pixels.
    pub pixels: Pixels,
    /// What its colours mean.
    pub scale: Option<ColorScale>,
}

/// What the colours of a map mean.
#[derive(Clone, Debug, PartialEq)]
pub struct ColorScale {
    /// The quantity, with its unit.
    pub label: String,
    /// Its values at both ends.
    pub ends: (f64, f64),
    /// Colours from the lower end to the upper one.
    pub colors: Vec<Rgb>,
}

/// A filled area; one without an end reaches to that of the axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    /// From where to where it lies to the right.
    pub x: (f64, f64),
    /// And upwards.
    pub y: (f64, f64),
    /// Its colour.
    pub color: Rgb,
    /// How much it covers, 0 to 1.
    pub opacity: f64,
}

/// Words at a place of the axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Note {
    /// The place.
    pub at: [f64; 2],
    /// The words.
    pub words: Words,
    /// On which side of it they stand.
    pub beside: Beside,
    /// Whether they stand above it (1), on it (0) or below (-1).
    pub above: i8,
    /// Their colour; none for that of the axes.
    pub color: Option<Rgb>,
}

/// How points are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marks {
    /// Joined by a line.
    Line,
    /// As dots.
    Dots,
    /// As crosses: something failed there.
    Crosses,
    /// As open circles.
    Rings,
}

impl Chart {
    /// An empty chart.
    pub fn new(title: impl Into<String>, x: ChartAxis, y: ChartAxis) -> Self {
        Self {
            title: title.into(),
            x,
            y,
            series: Vec::new(),
            map: None,
            bands: Vec::new(),
            notes: Vec::new(),
            equal: false,
            marked: false,
        }
    }

    /// Adds what is finite of some points; nothing where nothing is.
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

    /// Words in the manner of this chart.
    pub fn words(&self, text: &str) -> Words {
        if self.marked { Words::marked(text) } else { Words::plain(text) }
    }

    /// The numbers that are drawn: a row for each point, named by its series.
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
    /// An axis with equal ratios or equal steps.
    pub fn new(label: impl Into<String>, log: bool) -> Self {
        Self { label: label.into(), log, ends: None, names: Vec::new() }
    }

    /// An axis with equal steps.
    pub fn linear(label: impl Into<String>) -> Self {
        Self::new(label, false)
    }

    /// An axis with equal ratios.
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
