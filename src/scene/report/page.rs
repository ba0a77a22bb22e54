//! Report as a drawing of one page: heading, inputs to the left, results to the right, warnings, figures, footer.

use super::rows::{Row, Section};
use super::{Report, program};
use crate::scene::chart_page::{self, Page};
use crate::scene::drawing::{Drawing, Lettering, Mark, PT_PER_MM, Pen, Rgb, TextAnchor, Words, wrapped};

/// Margins at the sides, and at top and bottom \[pt\].
const MARGINS: [f64; 2] = [40.0, 34.0];
/// Space between the columns \[pt\].
const GUTTER: f64 = 18.0;
/// Font sizes: title, headings, text, footer \[pt\].
const TITLE: f64 = 16.0;
const HEADING: f64 = 9.0;
const TEXT: f64 = 7.8;
const FOOTER: f64 = 6.8;
/// Line spacing over font size.
const SPACING: f64 = 1.32;
/// Share of a column that names take.
const NAMES: f64 = 0.45;
/// Heights of the figures \[pt\].
const FIGURES: (f64, f64) = (95.0, 185.0);
/// Most lines of warnings; the rest is in the HTML report.
const MOST_WARNING_LINES: usize = 9;

const INK: Rgb = [0x22; 3];
const QUIET: Rgb = [0x66; 3];
const RULE: Rgb = [0xdd; 3];
const ACCENT: Rgb = [0x00, 0x72, 0xB2];
const WARNING: Rgb = [0xD5, 0x5E, 0x00];

/// Draws from the top down.
struct Writer<'a> {
    marks: &'a mut Vec<Mark>,
}

impl Writer<'_> {
    fn text(&mut self, words: Words, at: [f64; 2], (size, bold, color): (f64, bool, Rgb)) {
        let beside = TextAnchor::Right;
        let class = "".into();
        self.marks.push(Mark::Words(Lettering { words, at, beside, upwards: false, size, bold, color, class }));
    }

    fn rule(&mut self, from: [f64; 2], width: f64, (thick, color): (f64, Rgb)) {
        let [x, y] = from;
        let pen = Pen { color, opacity: 1.0, width: thick, dashes: Vec::new() };
        self.marks.push(Mark::Line(vec![[x, y], [x + width, y]], pen));
    }

    /// Draws sections below a height. Returns the height below them.
    fn sections(&mut self, sections: &[Section], left: f64, width: f64, top: f64) -> f64 {
        let mut y = top;
        for section in sections.iter().filter(|section| !section.rows.is_empty()) {
            y += HEADING + 5.0;
            self.text(Words::plain(section.title), [left, y], (HEADING, true, ACCENT));
            y += 3.5;
            self.rule([left, y], width, (0.6, ACCENT));
            for row in &section.rows {
                y = self.row(row, left, width, y);
            }
        }
        y
    }

    fn row(&mut self, Row { name, value }: &Row, left: f64, width: f64, top: f64) -> f64 {
        let split = NAMES * width;
        // Marks of symbols take no room, so that only a name that is too long without them is broken.
        let names = match Words::marked(name).length(TEXT) <= split - 4.0 {
            true => vec![name.clone()],
            false => wrapped(name, TEXT, split - 4.0),
        };
        let values = wrapped(value, TEXT, width - split);
        let line = |k: usize| top + TEXT * (1.05 + SPACING * k as f64) + 1.0;
        for (k, name) in names.iter().enumerate() {
            self.text(Words::marked(name), [left, line(k)], (TEXT, false, QUIET));
        }
        for (k, value) in values.iter().enumerate() {
            self.text(Words::marked(value), [left + split, line(k)], (TEXT, false, INK));
        }
        let bottom = line(names.len().max(values.len()).max(1) - 1) + 2.6;
        self.rule([left, bottom], width, (0.35, RULE));
        bottom
    }
}

impl Report {
    /// Returns the page.
    pub(super) fn drawing(&self) -> Drawing {
        let size_mm = self.paper.size_mm();
        let mut drawing = Drawing { size_mm, title: self.title.clone(), ground: [0xff; 3], marks: Vec::new() };
        let [width, height] = drawing.size();
        let [side, margin] = MARGINS;
        let inner = width - 2.0 * side;
        let mut pen = Writer { marks: &mut drawing.marks };
        let mut y = margin;
        for line in wrapped(&self.title, TITLE, inner) {
            y += TITLE;
            pen.text(Words::plain(line), [side, y], (TITLE, true, INK));
        }
        y += 13.0;
        pen.text(Words::plain(self.credits.as_str()), [side, y], (TEXT + 0.6, false, QUIET));
        y += 6.0;
        pen.rule([side, y], inner, (1.4, ACCENT));
        let column = 0.5 * (inner - GUTTER);
        let left = pen.sections(&self.inputs, side, column, y);
        let right = pen.sections(&self.results, side + column + GUTTER, column, y);
        y = left.max(right) + 4.0;
        let lines: Vec<String> = self
            .warnings
            .iter()
            .flat_map(|warning| wrapped(&format!("Warning: {warning}"), TEXT, inner - 8.0))
            .collect();
        for line in lines.iter().take(MOST_WARNING_LINES) {
            y += TEXT * SPACING;
            pen.text(Words::plain(line.as_str()), [side + 8.0, y], (TEXT, false, INK));
            pen.marks.push(Mark::Area([side, y - TEXT, 2.0, TEXT * SPACING], WARNING, 1.0));
        }
        let bottom = height - margin;
        pen.rule([side, bottom - FOOTER - 3.0], inner, (0.35, RULE));
        pen.text(Words::plain(program()), [side, bottom], (FOOTER, false, QUIET));
        self.figures(&mut drawing.marks, [side, y + 8.0], [inner, bottom - FOOTER - 8.0]);
        drawing
    }

    /// Draws the figures between two heights, as large as fits: up to three in one row, more in two rows if there is
    /// room.
    fn figures(&self, marks: &mut Vec<Mark>, [left, top]: [f64; 2], [width, bottom]: [f64; 2]) {
        let (count, room) = (self.figures.len().max(1), bottom - top);
        let across = if count > 3 && 0.5 * room >= FIGURES.0 { count.div_ceil(2) } else { count };
        let height = (room / count.div_ceil(across) as f64).min(FIGURES.1);
        let wide = width / across as f64;
        let page = Page { width_mm: (wide - 4.0) / PT_PER_MM, height_mm: height / PT_PER_MM, ..Page::default() };
        for (k, figure) in self.figures.iter().enumerate() {
            let origin = [left + wide * (k % across) as f64, top + height * (k / across) as f64];
            let figure = chart_page::drawn(std::slice::from_ref(figure), &page);
            marks.extend(figure.marks.into_iter().map(|mark| mark.moved(origin)));
        }
    }
}
