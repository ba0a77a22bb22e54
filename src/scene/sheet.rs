//! Report sheet of one contact: inputs with units, results, how they were checked, a comparison with published
//! formulas, and the program version. Written as Markdown, HTML with figures, or CSV.

use super::answer::Answer;
use super::chart::{Chart, ChartAxis, Marks};
use super::chart_page::Page;
use super::contact_result::ContactResult;
use super::drawing::escaped;
use super::regime::{Ratios, RegimeMap};
use super::regimes;
use super::table::{quoted, significant};
use crate::solver::physics::bodies::{Bodies, film_regime};
use crate::solver::physics::contact::{ContactKind, FilmFormula, FilmShape};
use crate::solver::physics::engineering::largest_shear;
use std::ffi::OsStr;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Significant digits of numbers in Markdown and HTML. The CSV form has all digits.
const DIGITS: i32 = 5;

/// Report sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    /// Title.
    pub title: String,
    /// Sections.
    pub parts: Vec<Part>,
    /// Figures: pressure, film thickness, and the contact on the regime chart.
    pub figures: Vec<Chart>,
}

/// Section of a sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Title.
    pub title: String,
    /// Lines.
    pub lines: Vec<Line>,
}

/// Line of a sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Name of the quantity.
    pub name: String,
    /// Value.
    pub value: Value,
    /// Unit; empty without one.
    pub unit: &'static str,
    /// Remark.
    pub remark: String,
}

/// Number or text.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A finite number.
    Number(f64),
    /// Text.
    Words(String),
}

impl Part {
    fn new(title: &str) -> Self {
        Self { title: title.to_owned(), lines: Vec::new() }
    }

    fn words(&mut self, name: &str, words: impl Into<String>) {
        self.lines.push(Line {
            name: name.to_owned(),
            value: Value::Words(words.into()),
            unit: "",
            remark: String::new(),
        });
    }

    fn number(&mut self, name: &str, value: impl Into<Option<f64>>, unit: &'static str) {
        self.said(name, value, unit, "");
    }

    fn said(&mut self, name: &str, value: impl Into<Option<f64>>, unit: &'static str, remark: impl Into<String>) {
        let Some(value) = value.into().filter(|value| value.is_finite()) else { return };
        self.lines.push(Line { name: name.to_owned(), value: Value::Number(value), unit, remark: remark.into() });
    }
}

impl Sheet {
    /// Builds the sheet of one contact solved by one or more methods. The first one is the reference. If the bodies are
    /// given, the film thickness is compared with their roughness.
    pub fn new(title: &str, solved: &[Answer], bodies: Option<&Bodies>) -> Self {
        let mut parts = Vec::new();
        let mut figures = Vec::new();
        if let Some(first) = solved.first() {
            parts.push(inputs(first, bodies));
            parts.push(results(first, bodies));
            parts.extend(solved.iter().map(verification));
            parts.extend(difference(solved));
            parts.extend(formulas(&first.result));
            figures = pictures(solved);
        }
        parts.push(program());
        Self { title: title.to_owned(), parts, figures }
    }

    /// Returns its figures: pressure, film thickness and the chart of regimes.
    pub fn figures(&self) -> &[Chart] {
        &self.figures
    }

    /// Returns the files of the sheet with their texts. The extension of the path selects the format: md with separate
    /// figures, html or csv. Empty for other extensions.
    pub fn files(&self, path: &Path) -> Vec<(PathBuf, String)> {
        let text = match path.extension().and_then(OsStr::to_str) {
            Some("md") => return self.notes(path),
            Some("html" | "htm") => self.to_html(),
            Some("csv") => self.to_csv(),
            _ => return Vec::new(),
        };
        vec![(path.to_owned(), text)]
    }

    /// Returns the sheet as a Markdown file, followed by its figures as separate files.
    pub fn notes(&self, path: &Path) -> Vec<(PathBuf, String)> {
        let figures = self.figures.iter().map(|figure| (beside(path, figure), figure.to_svg(&Page::default())));
        std::iter::once((path.to_owned(), self.to_markdown(path))).chain(figures).collect()
    }

    /// Writes a table for each section, and links to the figures.
    fn to_markdown(&self, path: &Path) -> String {
        let cell = |text: &str| text.replace('|', "\\|").replace('\n', " ");
        let mut text = format!("# {}\n", self.title);
        for part in &self.parts {
            // Writing to a string cannot fail.
            let _ = write!(text, "\n## {}\n\n| Quantity | Value | Unit | Remark |\n|---|---|---|---|\n", part.title);
            for line in &part.lines {
                let (name, value, remark) = (cell(&line.name), cell(&line.value.shown()), cell(&line.remark));
                let _ = writeln!(text, "| {name} | {value} | {} | {remark} |", line.unit);
            }
        }
        for figure in &self.figures {
            let file = beside(path, figure);
            // The link is in angle brackets because a file name may contain blanks and brackets.
            let name = file.file_name().unwrap_or_default().to_string_lossy();
            let _ = write!(text, "\n![{}](<{name}>)\n", figure.title);
        }
        text
    }

    /// Returns the sheet as one self-contained page of HTML with its figures.
    pub fn to_html(&self) -> String {
        let title = escaped(&self.title);
        let mut text = format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{title}</title>\n<style>\n\
             body {{ font: 11pt sans-serif; color: #222; max-width: 46em; margin: 2em auto; padding: 0 1em }}\n\
             table {{ border-collapse: collapse; width: 100% }}\n\
             td {{ border-bottom: 1px solid #ddd; padding: 0.2em 0.6em 0.2em 0; vertical-align: top }}\n\
             td.value {{ text-align: right; white-space: nowrap }}\n\
             td.remark {{ color: #666 }}\n\
             h2 {{ font-size: 1.1em; margin: 1.4em 0 0.3em }}\n\
             svg {{ margin: 0.5em 0.5em 0 0 }}\n</style>\n</head>\n<body>\n<h1>{title}</h1>\n"
        );
        for part in &self.parts {
            let _ = write!(text, "<h2>{}</h2>\n<table>\n", escaped(&part.title));
            for line in &part.lines {
                let (name, remark) = (escaped(&line.name), escaped(&line.remark));
                let value = escaped(format!("{} {}", line.value.shown(), line.unit).trim());
                let class = if matches!(line.value, Value::Number(_)) { " class=\"value\"" } else { "" };
                let _ =
                    writeln!(text, "<tr><td>{name}</td><td{class}>{value}</td><td class=\"remark\">{remark}</td></tr>");
            }
            text.push_str("</table>\n");
        }
        for figure in &self.figures {
            text.push_str(&figure.to_svg(&Page::default()));
        }
        text.push_str("</body>\n</html>\n");
        text
    }

    /// Returns the sheet as CSV with the columns part, quantity, value, unit, remark. Numbers have the shortest form
    /// that reads back exactly.
    pub fn to_csv(&self) -> String {
        let mut text = String::from("part,quantity,value,unit,remark\n");
        for part in &self.parts {
            for line in &part.lines {
                let cells = [&part.title, &line.name, &line.value.exact(), &line.unit.to_owned(), &line.remark];
                let cells: Vec<String> = cells.into_iter().map(|cell| quoted(cell)).collect();
                text.push_str(&cells.join(","));
                text.push('\n');
            }
        }
        text
    }
}

/// Returns the file name of a figure of a sheet: `contact_pressure.svg` for `contact.md`.
fn beside(path: &Path, figure: &Chart) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}_{}.svg", figure.title.to_lowercase()))
}

impl Value {
    fn shown(&self) -> String {
        match self {
            Self::Number(number) => significant(*number, DIGITS),
            Self::Words(words) => words.clone(),
        }
    }

    fn exact(&self) -> String {
        match self {
            Self::Number(number) => super::table::Number(*number).to_string(),
            Self::Words(words) => words.clone(),
        }
    }
}

fn inputs(solved: &Answer, bodies: Option<&Bodies>) -> Part {
    let point = &solved.result.point;
    let mut part = Part::new("Contact");
    let (kind, load) = match (point.kind, point.radius_y_m) {
        (ContactKind::Line, _) => ("line contact", "N/m"),
        (ContactKind::Point, None) => ("circular point contact", "N"),
        (ContactKind::Point, Some(_)) => ("elliptical point contact", "N"),
    };
    part.words("Kind", kind);
    part.number("Reduced radius R", point.radius_m, "m");
    part.number("Reduced modulus E’", point.modulus_pa, "Pa");
    part.number("Load w", point.load, load);
    part.number("Entrainment speed u_m", point.speed_m_per_s, "m/s");
    part.number("Slide-to-roll ratio SRR", point.sliding.slide_to_roll_ratio, "");
    for (number, body) in (1..).zip(bodies.iter().flat_map(|bodies| bodies.0)) {
        let material = body.material().map_or("", |material| material.name);
        part.said(&format!("Speed of body {number}"), body.speed_m_per_s, "m/s", material);
    }
    part.number("Viscosity at ambient pressure η₀", point.viscosity_pa_s, "Pa·s");
    part.number("Pressure–viscosity coefficient α", point.alpha_per_pa, "1/Pa");
    if let Some(solution) = solved.fields() {
        part.words("Laws of the lubricant", solution.problem.lubricant.describe());
    }
    part.number("Load number M", point.moes().m, "");
    part.number("Lubricant number L", point.moes().l, "");
    let estimate = || RegimeMap::new(FilmShape::of(point)).at(point.moes());
    let ratios = solved.fields().map_or_else(estimate, Ratios::of);
    part.words("Regime", format!("{}: {}", ratios.regime().title().to_lowercase(), ratios.describe()));
    part
}

fn results(solved: &Answer, bodies: Option<&Bodies>) -> Part {
    let result = &solved.result;
    let (point, hertz) = (&result.point, result.point.hertz());
    let value = |name: &str| result.value(name);
    let mut part = Part::new("Results");
    part.number("Central film thickness h_c", value("h_c_m"), "m");
    part.number("Minimum film thickness h_min", value("h_min_m"), "m");
    part.number("Hertzian pressure p_H", hertz.pressure_pa, "Pa");
    let width = match (point.kind, point.radius_y_m) {
        (ContactKind::Line, _) => "Half width a",
        (ContactKind::Point, None) => "Radius of the contact a",
        (ContactKind::Point, Some(_)) => "Semi-axis of the contact along a",
    };
    part.number(width, hertz.half_width_m, "m");
    if point.radius_y_m.is_some() {
        part.number("Semi-axis of the contact across b", hertz.half_length_m, "m");
    }
    part.number("Maximum pressure", value("P_max").map(|p| p * hertz.pressure_pa), "Pa");
    if point.sliding.slide_to_roll_ratio != 0.0 {
        let (force, power) = if point.kind == ContactKind::Line { ("N/m", "W/m") } else { ("N", "W") };
        let traction = value("traction");
        let lost = point.sliding.slide_to_roll_ratio * point.speed_m_per_s;
        part.number("Friction coefficient µ", traction, "");
        part.number("Friction force", traction.map(|mu| mu * point.load), force);
        part.number("Power loss", traction.map(|mu| mu * point.load * lost), power);
    }
    if let (Some(bodies), Some(h_min)) = (bodies, value("h_min_m"))
        && let Ok(ratio) = bodies.film_ratio(h_min)
    {
        part.said("Film ratio λ", ratio, "", film_regime(ratio));
    }
    for (name, key) in [("mid-film", "mid_film"), ("body 1", "surface_1"), ("body 2", "surface_2")] {
        let rise = value(&format!("heat.{key}_rise_k"));
        part.said(&format!("Temperature rise of {name}"), rise, "K", "at X = 0, above the inlet");
    }
    let shear = largest_shear(point, bodies.map_or(0.3, |bodies| bodies.0[0].poisson));
    let depth = shear.depth_over_half_width * hertz.half_width_m;
    part.said(
        "Maximum subsurface shear stress",
        shear.over_hertz_pressure * hertz.pressure_pa,
        "Pa",
        format!("of the dry contact, {} m deep", significant(depth, 3)),
    );
    for name in ["H_c", "H_min", "P_max"] {
        part.number(&format!("Dimensionless {name}"), value(name), "");
    }
    part
}

fn verification(solved: &Answer) -> Part {
    let result = &solved.result;
    let mut part = Part::new(&format!("Solution method: {}", result.method));
    part.words("Converged", if result.converged { "yes" } else { "no" });
    let nodes = match result.nodes {
        (nx, 1) => nx.to_string(),
        (nx, ny) => format!("{nx} × {ny}"),
    };
    part.words("Grid", format!("{}, {nodes} nodes, {} unknowns", result.grid, result.dofs));
    part.number("Newton steps", result.newton_iterations as f64, "");
    part.said("Load-balance residual", result.value("load_residual"), "", "relative to the load");
    part.number("Residual norm", result.residual_norm, "");
    if let Some(cost) = result.grid_cost {
        part.said("Domain-truncation error", cost.truncation, "", "relative error of H_c, estimated");
        part.said("Discretisation error", cost.resolution, "", "relative error of H_c, estimated");
    }
    if let Some(reduced) = &result.reduced {
        part.words("Reduced model", reduced.size.to_string());
        part.words("Inside the trained range", if reduced.trained { "yes" } else { "no" });
        let bounds = [("h_c", "h_c"), ("h_min", "h_min"), ("traction", "µ")].map(|(name, symbol)| {
            (format!("Error bound of {symbol}"), result.value(&format!("reduced.{name}_error_bound")))
        });
        for (name, bound) in bounds {
            part.said(&name, bound, "", "relative; 99 % empirical error bound");
        }
    }
    for warning in &result.warnings {
        part.words("Warning", warning.to_string());
    }
    part
}

/// Compares the other methods with the first one.
fn difference(solved: &[Answer]) -> Option<Part> {
    let (first, others) = solved.split_first()?;
    let mut part = Part::new("Methods compared");
    for other in others {
        for name in ["h_c_m", "h_min_m", "traction"] {
            let (Some(here), Some(there)) = (first.result.value(name), other.result.value(name)) else { continue };
            if here != 0.0 {
                let symbol = name.trim_end_matches("_m");
                let title = format!("{symbol}, {} over {}, less 1", first.result.method, other.result.method);
                part.number(&title, here / there - 1.0, "");
            }
        }
    }
    (!part.lines.is_empty()).then_some(part)
}

/// Compares published formulas with the result.
fn formulas(result: &ContactResult) -> Option<Part> {
    let mut part = Part::new("Published film formulas");
    for &formula in FilmFormula::of(result.point.kind) {
        let predicted = formula.predict(&result.point);
        let (film, which) = if formula.predicts_minimum() { ("h_min_m", "h_min") } else { ("h_c_m", "h_c") };
        let off = result.value(film).map_or_else(String::new, |own| {
            format!("{:+.1} % against {which} here; ", 100.0 * (predicted.film_m / own - 1.0))
        });
        let range = if predicted.in_range { "" } else { "outside its range; " };
        let remark = format!("{off}{range}{}", formula.source());
        part.said(&format!("{which} by {}", formula.name()), predicted.film_m, "m", remark);
    }
    (!part.lines.is_empty()).then_some(part)
}

/// Draws pressure and film thickness in the plane Y = 0, in SI units, and the regime chart.
fn pictures(solved: &[Answer]) -> Vec<Chart> {
    let x = || ChartAxis::linear("x [mm]");
    let mut pressure = Chart::new("Pressure", x(), ChartAxis::linear("p [GPa]"));
    let mut film = Chart::new("Film", x(), ChartAxis::linear("h [µm]"));
    for (answer, solution) in solved.iter().filter_map(|answer| Some((answer, answer.fields()?))) {
        let result = &answer.result;
        let (hertz, scale) = (result.point.hertz(), result.point.film_scale_m());
        let near = || solution.profile().filter(|(x, ..)| (-2.0..=1.5).contains(x));
        let mm = 1e3 * hertz.half_width_m;
        pressure.add(result.method, Marks::Line, near().map(|(x, p, _)| [x * mm, p * hertz.pressure_pa * 1e-9]));
        // Film thicknesses far upstream of the contact are left out: they would dominate the scale.
        let most = 4.0 * solution.scalars.h_c;
        let close = near().filter(|(_, _, h)| *h <= most);
        film.add(result.method, Marks::Line, close.map(|(x, _, h)| [x * mm, h * scale * 1e6]));
    }
    let regime =
        solved.first().map(|first| regimes::chart(FilmShape::of(&first.result.point), first.result.point.moes()));
    [pressure, film].into_iter().chain(regime).collect()
}

fn program() -> Part {
    let mut part = Part::new("Program");
    part.words("Written by", format!("{} {}", env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION")));
    part
}
