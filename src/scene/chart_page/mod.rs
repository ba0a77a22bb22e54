//! Charts for print: size in millimetres, axes with names and units, a legend outside the curves, a caption below.
//! Lines differ by dashes as well as by colour, so that they can be distinguished in greyscale.

mod panel;
mod scale;

use super::chart::Chart;
use super::drawing::{Drawing, Lettering, Mark, Rgb, TextAnchor, Words, wrapped};
use panel::Panel;

/// Font size \[pt\].
const LETTERS: f64 = 8.0;
/// Font size of the caption \[pt\].
const SMALL: f64 = 6.8;
/// Line spacing over font size.
const LINE: f64 = 1.3;
/// Page settings of a chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Page {
    /// Width \[mm\], 40 to 500.
    pub width_mm: f64,
    /// Height \[mm\], 30 to 500.
    pub height_mm: f64,
    /// True for light text on a dark background.
    pub dark: bool,
    /// Caption below the chart: parameters, source.
    pub caption: String,
}

impl Default for Page {
    /// Returns the size of one journal column, with a light background.
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

/// Draws charts on a page, one below the other, with one caption.
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
            beside: TextAnchor::Right,
            upwards: false,
            size: SMALL,
            bold: false,
            color: page.ink(),
            class: "caption".into(),
        }));
    }
    drawing
}

impl Chart {
    /// Draws one chart on a page as SVG.
    pub fn to_svg(&self, page: &Page) -> String {
        drawn(std::slice::from_ref(self), page).to_svg()
    }

    /// Returns the series in each line of the legend, and their positions. Each name appears once. Names that are
    /// written at their curve are left out.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::chart::{ChartAxis, Marks};
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

    /// Reads the positions of axis labels in the SVG and the numbers printed there.
    fn marks(svg: &str, class: &str, name: &str) -> Vec<(f64, f64)> {
        let of_class = svg.lines().filter(|line| line.contains(&format!("class=\"{class}\"")));
        let words = |line: &str| line.split_once('>').unwrap().1.split_once('<').unwrap().0.replace('−', "-").parse();
        let words = |line: &str| words(line).unwrap();
        of_class.map(|line| (attribute(line, name).parse().unwrap(), words(line))).collect()
    }

    #[test]
    fn the_numbers_of_the_axes_give_the_data_back() {
        for (width_mm, height_mm) in [(85.0, 60.0), (170.0, 100.0)] {
            let chart = films();
            let svg = chart.to_svg(&Page { width_mm, height_mm, ..Page::default() });
            let (across, up) = (marks(&svg, "x", "x"), marks(&svg, "y", "y"));
            // Grid lines have two points.
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
            // Axis numbers are drawn slightly below their tick marks.
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
