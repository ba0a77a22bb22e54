//! How rows are best looked at: lines and points over axes with units, as plain data.

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
}

/// An axis of a chart.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChartAxis {
    /// What it counts, with its unit where it has one.
    pub label: String,
    /// Whether equal lengths are equal ratios.
    pub log: bool,
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
}

impl Chart {
    /// An empty chart.
    pub fn new(title: impl Into<String>, x: ChartAxis, y: ChartAxis) -> Self {
        Self { title: title.into(), x, y, series: Vec::new() }
    }

    /// Adds what is finite of some points; nothing where nothing is.
    pub fn add(&mut self, name: impl Into<String>, marks: Marks, points: impl IntoIterator<Item = [f64; 2]>) {
        let shown = |point: &[f64; 2]| {
            let [x, y] = *point;
            x.is_finite() && y.is_finite() && (x > 0.0 || !self.x.log) && (y > 0.0 || !self.y.log)
        };
        let points: Vec<[f64; 2]> = points.into_iter().filter(shown).collect();
        if !points.is_empty() {
            self.series.push(Series { name: name.into(), marks, points });
        }
    }
}

impl ChartAxis {
    /// An axis with equal steps.
    pub fn linear(label: impl Into<String>) -> Self {
        Self { label: label.into(), log: false }
    }

    /// An axis with equal ratios.
    pub fn log(label: impl Into<String>) -> Self {
        Self { label: label.into(), log: true }
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
