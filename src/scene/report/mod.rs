//! Report of one contact on one page: inputs, results, how they were checked, figures. Written as
//! HTML or PDF, for A4 or Letter paper.

mod figures;
mod html;
mod inputs;
mod page;
mod results;
mod rows;
mod stated;

pub use figures::{film_over_plane, profiles};
pub use stated::Stated;

use super::answer::Answer;
use super::chart::Chart;
use super::subsurface::Subsurface;
use crate::host::clock::today;
use rows::Section;
use serde::{Deserialize, Serialize};
use std::ffi::OsStr;
use std::path::Path;

/// Paper of a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Paper {
    /// 210 mm by 297 mm.
    #[default]
    A4,
    /// 8.5 in by 11 in.
    Letter,
}

impl Paper {
    /// All papers.
    pub const ALL: [Self; 2] = [Self::A4, Self::Letter];

    /// Returns width and height \[mm\].
    pub const fn size_mm(self) -> [f64; 2] {
        match self {
            Self::A4 => [210.0, 297.0],
            Self::Letter => [215.9, 279.4],
        }
    }

    /// Returns the name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::A4 => "A4",
            Self::Letter => "Letter",
        }
    }
}

/// File format of a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReportFormat {
    /// One self-contained page for a browser.
    Html,
    /// One page of PDF.
    Pdf,
}

impl ReportFormat {
    /// Returns the format of a file by its extension: html, htm or pdf. `None` for others.
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension().and_then(OsStr::to_str)?.to_lowercase().as_str() {
            "html" | "htm" => Some(Self::Html),
            "pdf" => Some(Self::Pdf),
            _ => None,
        }
    }
}

/// Report of one contact.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    title: String,
    /// Author, company and date.
    credits: String,
    inputs: Vec<Section>,
    results: Vec<Section>,
    /// Sentences of the warnings.
    warnings: Vec<String>,
    figures: Vec<Chart>,
    paper: Paper,
}

impl Report {
    /// Builds the report of one contact solved by one or more methods. The first one is the reference. `stated` is what
    /// the answers do not contain.
    pub fn new(stated: &Stated, solved: &[Answer], paper: Paper) -> Self {
        let date = today().to_string();
        let credits: Vec<&str> =
            [stated.author.as_str(), &stated.company, &date].into_iter().filter(|part| !part.is_empty()).collect();
        let mut report = Self {
            title: stated.title.clone(),
            credits: credits.join(" · "),
            inputs: Vec::new(),
            results: Vec::new(),
            warnings: Vec::new(),
            figures: Vec::new(),
            paper,
        };
        let Some(first) = solved.first() else { return report };
        let field = first.fields().and_then(|solution| solution.subsurface_stress(stated.poisson()).ok());
        let below = field.as_ref().map(|field| Subsurface::of(field, &first.result.point));
        report.inputs = inputs::sections(stated, first);
        report.results = results::sections(stated, solved, below.as_ref());
        for warning in solved.iter().flat_map(|answer| &answer.result.warnings).map(ToString::to_string) {
            if !report.warnings.contains(&warning) {
                report.warnings.push(warning);
            }
        }
        report.figures = figures::of(solved, field.as_ref(), stated.system);
        report
    }

    /// Returns the file in a format.
    pub fn file(&self, format: ReportFormat) -> Vec<u8> {
        match format {
            ReportFormat::Html => self.to_html().into_bytes(),
            ReportFormat::Pdf => self.drawing().to_pdf(),
        }
    }
}

/// Returns the program with its version.
fn program() -> String {
    format!("{} {}", env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION"))
}

#[cfg(test)]
mod tests;
