//! Report as one self-contained page of HTML, which prints on one sheet.

use super::rows::{Row, Section};
use super::{Paper, Report, program};
use crate::scene::chart_page::Page;
use crate::scene::drawing::escaped;
use std::fmt::Write as _;

/// Size of a figure \[mm\].
const FIGURE_MM: [f64; 2] = [86.0, 58.0];

/// Returns text with symbols in braces as HTML: letters italic, subscripts lowered.
fn symbols(text: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('{') {
        let (inside, behind) = after.split_once('}').unwrap_or((after, ""));
        let (base, subscript) = inside.split_once('_').unwrap_or((inside, ""));
        out += &escaped(before);
        // Writing to a string cannot fail.
        let _ = write!(out, "<i>{}</i>", escaped(base));
        if !subscript.is_empty() {
            let _ = write!(out, "<sub>{}</sub>", escaped(subscript));
        }
        rest = behind;
    }
    out + &escaped(rest)
}

fn table(section: &Section) -> String {
    let row = |Row { name, value }: &Row| format!("<tr><td>{}</td><td>{}</td></tr>\n", symbols(name), symbols(value));
    let rows: String = section.rows.iter().map(row).collect();
    format!("<h2>{}</h2>\n<table>\n{rows}</table>\n", escaped(section.title))
}

fn tables(sections: &[Section]) -> String {
    sections.iter().filter(|section| !section.rows.is_empty()).map(table).collect()
}

impl Report {
    /// Returns the page.
    pub(super) fn to_html(&self) -> String {
        let title = escaped(&self.title);
        let [inputs, results] = [&self.inputs, &self.results].map(|sections| tables(sections));
        let warnings: String =
            self.warnings.iter().map(|warning| format!("<p class=\"warning\">{}</p>\n", escaped(warning))).collect();
        let [width_mm, height_mm] = FIGURE_MM;
        let page = Page { width_mm, height_mm, ..Page::default() };
        let figures: String = self.figures.iter().map(|figure| figure.to_svg(&page)).collect();
        let paper = match self.paper {
            Paper::A4 => "A4",
            Paper::Letter => "letter",
        };
        format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{title}</title>\n<style>\n\
             @page {{ size: {paper}; margin: 12mm 14mm }}\n\
             body {{ font: 9pt/1.3 sans-serif; color: #222; max-width: 182mm; margin: 0 auto; padding: 4mm }}\n\
             @media print {{ body {{ padding: 0 }} }}\n\
             header {{ border-bottom: 1.5pt solid #0072B2; margin-bottom: 3mm }}\n\
             h1 {{ font-size: 15pt; margin: 0 }}\n\
             header p {{ margin: 0 0 1.5mm; color: #555 }}\n\
             main {{ display: grid; grid-template-columns: 1fr 1fr; column-gap: 6mm }}\n\
             h2 {{ font-size: 9.5pt; color: #0072B2; margin: 2mm 0 0.5mm }}\n\
             table {{ border-collapse: collapse; width: 100% }}\n\
             td {{ border-bottom: 0.5pt solid #e4e4e4; padding: 0.3mm 2mm 0.3mm 0; vertical-align: top }}\n\
             td:first-child {{ width: 44%; color: #555 }}\n\
             .warning {{ border-left: 2pt solid #D55E00; padding-left: 2mm; margin: 2mm 0 }}\n\
             figure {{ display: flex; flex-wrap: wrap; justify-content: space-between; margin: 3mm 0 0 }}\n\
             footer {{ color: #777; font-size: 7.5pt; margin-top: 2mm }}\n</style>\n</head>\n<body>\n\
             <header><h1>{title}</h1><p>{credits}</p></header>\n\
             <main>\n<div>\n{inputs}</div>\n<div>\n{results}</div>\n</main>\n{warnings}\
             <figure>\n{figures}</figure>\n<footer>{program}</footer>\n</body>\n</html>\n",
            credits = escaped(&self.credits),
            program = escaped(&program()),
        )
    }
}
