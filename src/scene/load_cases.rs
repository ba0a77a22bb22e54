//! A table of load cases as engineers keep them: one contact a line, quantities in columns, units in the titles or in
//! the cells. A line that makes no sense is refused by itself; the others stand.
//!
//! ```text
//! name;       R [mm]; u;       w;        oil;       temperature; SRR
//! shaft, new; 12;     3 m/s;   300 N/mm; ISO VG 68; 60 °C;       5 %
//! ```

use super::At;
use super::bench::Request;
use super::check::MAX_POINTS;
use super::examples;
use super::experiment::Experiment;
use super::grid;
use super::named_lubricant::by_name;
use crate::solver::full::Problem;
use crate::solver::physics::contact::{ContactKind, OperatingPoint, Quantity};
use crate::solver::physics::engineering::{Dimension, Grade, Oil, OilFamily, parse};
use csv_core::ReadFieldResult;
use serde::{Deserialize, Serialize};
use std::io::Read as _;
use std::path::{Path, PathBuf};

/// Largest table that is read \[bytes\].
const MAX_BYTES: u64 = 32 << 20;

/// Where a table of load cases is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum CaseTable {
    /// In a CSV file.
    File(PathBuf),
    /// Here, as it was pasted.
    Text(String),
}

/// One line of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadCase {
    /// Its line in the table, from 1.
    pub line: usize,
    /// What it is called; empty where it has no name.
    pub name: String,
    /// What is to be solved, or why that makes no sense.
    pub request: Result<Request, String>,
}

/// Why a whole table is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CasesError {
    /// The file cannot be read.
    #[error("cannot read the load cases {}: {reason}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        reason: String,
    },
    /// It holds nothing.
    #[error(
        "the table of load cases is empty; it needs a line of titles, as `radius, speed, load`, and a line for each contact"
    )]
    Empty,
    /// It holds too much.
    #[error("the table of load cases has more than {MAX_POINTS} lines")]
    TooLong,
    /// A title is unknown.
    #[error(
        "line {line}: the column “{title}” is unknown; accepted are {}; put # before a title that is not to be read",
        accepted()
    )]
    Title {
        /// Line of the titles.
        line: usize,
        /// The title.
        title: String,
    },
    /// A column is there twice.
    #[error("line {line}: two columns say the same thing, “{title}” and one before it")]
    Twice {
        /// Line of the titles.
        line: usize,
        /// The second title.
        title: String,
    },
    /// The unit in a title is none of its quantity.
    #[error("line {line}: the column “{title}”: {problem}")]
    Unit {
        /// Line of the titles.
        line: usize,
        /// The title.
        title: String,
        /// What is wrong, and what would be accepted.
        problem: String,
    },
}

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Column {
    Name,
    Contact,
    Lubricant,
    Oil,
    Temperature,
    Number(Quantity),
    Skipped,
}

/// Titles of columns, in lower case and without spaces: the word first, then what people write instead.
const TITLES: [(Column, &[&str]); 16] = [
    (Column::Name, &["name", "case", "id", "loadcase"]),
    (Column::Contact, &["contact", "kind"]),
    (Column::Lubricant, &["lubricant"]),
    (Column::Oil, &["oil", "isovg", "vg", "iso_vg"]),
    (Column::Temperature, &["temperature", "t"]),
    (Column::Number(Quantity::Radius), &["radius", "r", "r_x"]),
    (Column::Number(Quantity::RadiusY), &["radius-y", "r_y", "ry"]),
    (Column::Number(Quantity::Speed), &["speed", "u_m", "um", "u"]),
    (Column::Number(Quantity::Load), &["load", "w", "f"]),
    (Column::Number(Quantity::Modulus), &["modulus", "e'", "e’", "e\u{2032}"]),
    (Column::Number(Quantity::Viscosity), &["viscosity", "eta_0", "eta0", "η₀", "η0"]),
    (Column::Number(Quantity::Alpha), &["alpha", "α"]),
    (Column::Number(Quantity::M), &["m", "moes-m", "moes_m"]),
    (Column::Number(Quantity::L), &["l", "moes-l", "moes_l"]),
    (Column::Number(Quantity::SlideToRollRatio), &["srr", "slip"]),
    (Column::Number(Quantity::NewtonianPlateauRatio), &["npr"]),
];

fn accepted() -> String {
    TITLES.iter().filter_map(|(_, titles)| titles.first().copied()).collect::<Vec<_>>().join(", ")
}

impl CaseTable {
    /// Reads the table; `resolve` finds a file of the scene's.
    ///
    /// # Errors
    /// When it cannot be read, or its titles make no sense. A bad line is refused by itself.
    pub fn cases(
        &self,
        experiment: &Experiment,
        resolve: &dyn Fn(&Path) -> PathBuf,
    ) -> Result<Vec<LoadCase>, CasesError> {
        match self {
            Self::Text(text) => cases(text, experiment),
            Self::File(path) => cases(&text_of(&resolve(path))?, experiment),
        }
    }

    /// The table in a file, as a text that can be edited.
    ///
    /// # Errors
    /// When it cannot be read.
    pub fn pasted(path: &Path) -> Result<Self, CasesError> {
        text_of(path).map(Self::Text)
    }
}

fn text_of(path: &Path) -> Result<String, CasesError> {
    if let Some(text) = examples::text_of(path) {
        return Ok(text.to_owned());
    }
    let unreadable = |reason: String| CasesError::Read { path: path.to_owned(), reason };
    let file = std::fs::File::open(path).map_err(|error| unreadable(error.to_string()))?;
    let mut bytes = Vec::new();
    file.take(MAX_BYTES + 1).read_to_end(&mut bytes).map_err(|error| unreadable(error.to_string()))?;
    if bytes.len() as u64 > MAX_BYTES {
        return Err(unreadable(format!("it is larger than {} MiB", MAX_BYTES >> 20)));
    }
    String::from_utf8(bytes).map_err(|_| unreadable("it is no UTF-8 text; save it as CSV in UTF-8".to_owned()))
}

/// What separates cells: tabs where they were pasted from a spreadsheet, semicolons where commas are decimal.
fn delimiter(text: &str) -> u8 {
    let titles = text.lines().find(|line| !line.trim().is_empty()).unwrap_or("");
    [b'\t', b';'].into_iter().find(|&mark| titles.contains(char::from(mark))).unwrap_or(b',')
}

fn cases(text: &str, experiment: &Experiment) -> Result<Vec<LoadCase>, CasesError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut columns: Option<Vec<(Column, String)>> = None;
    let mut cases = Vec::new();
    for (line, record) in records(text) {
        let cells: Vec<&str> = record.iter().map(|cell| cell.trim()).collect();
        if cells.iter().all(|cell| cell.is_empty()) {
            continue;
        }
        let Some(columns) = &columns else {
            columns = Some(titles(line, &cells)?);
            continue;
        };
        if cases.len() == MAX_POINTS {
            return Err(CasesError::TooLong);
        }
        let name = columns.iter().zip(&cells).find(|((column, _), _)| *column == Column::Name);
        let name = name.map_or(String::new(), |(_, cell)| (*cell).to_owned());
        cases.push(LoadCase { line, name, request: request(columns, &cells, experiment) });
    }
    if cases.is_empty() { Err(CasesError::Empty) } else { Ok(cases) }
}

/// The cells of each record, with the line in which it begins, from 1.
fn records(text: &str) -> Vec<(usize, Vec<String>)> {
    let mut reader = csv_core::ReaderBuilder::new().delimiter(delimiter(text)).build();
    let (mut input, mut out) = (text.as_bytes(), vec![0; text.len() + 1]);
    let (mut records, mut cells, mut cell) = (Vec::new(), Vec::new(), Vec::new());
    let (mut line, mut begin) = (1, 1);
    loop {
        if cells.is_empty() && cell.is_empty() {
            begin = line + input.iter().take_while(|byte| byte.is_ascii_whitespace()).filter(|&&b| b == b'\n').count();
        }
        let (result, read, written) = reader.read_field(input, &mut out);
        let (done, rest) = input.split_at_checked(read).unwrap_or((input, &[]));
        line += done.iter().filter(|&&byte| byte == b'\n').count();
        input = rest;
        cell.extend(out.iter().take(written));
        match result {
            // At the end of the input the next call ends the field; the output has room for all of it.
            ReadFieldResult::InputEmpty | ReadFieldResult::OutputFull => {}
            ReadFieldResult::Field { record_end } => {
                cells.push(String::from_utf8_lossy(&cell).into_owned());
                cell.clear();
                if record_end {
                    records.push((begin, std::mem::take(&mut cells)));
                }
            }
            ReadFieldResult::End => return records,
        }
    }
}

/// What each column holds, with the unit of its numbers.
fn titles(line: usize, cells: &[&str]) -> Result<Vec<(Column, String)>, CasesError> {
    let mut columns: Vec<(Column, String)> = Vec::new();
    for &cell in cells {
        let title = || cell.to_owned();
        let (word, unit) = split_title(cell);
        let key: String = word.to_lowercase().split_whitespace().collect();
        let column = if word.is_empty() || word.starts_with('#') {
            Column::Skipped
        } else {
            let known = TITLES.iter().find(|(_, titles)| titles.contains(&key.as_str()));
            known.ok_or_else(|| CasesError::Title { line, title: title() })?.0
        };
        if column != Column::Skipped && columns.iter().any(|(other, _)| *other == column) {
            return Err(CasesError::Twice { line, title: title() });
        }
        check_unit(column, unit).map_err(|problem| CasesError::Unit { line, title: title(), problem })?;
        columns.push((column, unit.to_owned()));
    }
    Ok(columns)
}

/// Title and unit of `load [N/mm]` or `load (N/mm)`.
fn split_title(cell: &str) -> (&str, &str) {
    match cell.split_once(['[', '(']) {
        Some((word, unit)) => (word.trim(), unit.trim().trim_end_matches([']', ')']).trim()),
        None => (cell.trim(), ""),
    }
}

/// The unit of a title must be one of its quantity, for one of both kinds of contact.
fn check_unit(column: Column, unit: &str) -> Result<(), String> {
    let dimensions = match column {
        _ if unit.is_empty() => return Ok(()),
        Column::Number(quantity) => [ContactKind::Line, ContactKind::Point].map(|kind| Dimension::of(quantity, kind)),
        Column::Temperature => [Dimension::Temperature; 2],
        _ => return Ok(()),
    };
    let [first, second] = dimensions.map(|dimension| parse("1", dimension, unit).map(drop));
    first.or(second).map_err(|error| error.to_string())
}

/// Units of numbers that have none: those of the command line, and °C.
fn si_unit(dimension: Dimension) -> &'static str {
    match dimension {
        Dimension::Length => "m",
        Dimension::Speed { .. } => "m/s",
        Dimension::Force => "N",
        Dimension::LineLoad => "N/m",
        Dimension::Pressure => "Pa",
        Dimension::Viscosity { .. } => "Pa·s",
        Dimension::PressureCoefficient => "1/Pa",
        Dimension::Temperature => "°C",
        _ => "",
    }
}

/// The cells of a line by what they hold.
struct Cells<'a>(Vec<(Column, &'a str, &'a str)>);

impl Cells<'_> {
    fn text(&self, wanted: Column) -> Option<&str> {
        self.0.iter().find(|(column, ..)| *column == wanted).map(|(_, _, cell)| *cell)
    }

    fn number(&self, wanted: Column, name: &str, dimension: Dimension) -> Result<Option<f64>, String> {
        let Some((_, unit, cell)) = self.0.iter().find(|(column, ..)| *column == wanted) else { return Ok(None) };
        let unit = if unit.is_empty() { si_unit(dimension) } else { unit };
        parse(cell, dimension, unit).map(Some).map_err(|error| format!("{name}: {error}"))
    }

    fn quantity(&self, quantity: Quantity, kind: ContactKind) -> Result<Option<f64>, String> {
        self.number(Column::Number(quantity), quantity.name(), Dimension::of(quantity, kind))
    }
}

/// What a line asks for. What it leaves out is the scene's, where that is written in SI units.
fn request(columns: &[(Column, String)], cells: &[&str], experiment: &Experiment) -> Result<Request, String> {
    let filled = cells.iter().skip(columns.len()).any(|cell| !cell.is_empty());
    if filled {
        return Err(format!("{} cells are there, but {} titles", cells.len(), columns.len()));
    }
    let pairs = columns.iter().zip(cells).filter(|(_, cell)| !cell.is_empty());
    let cells = Cells(pairs.map(|((column, unit), cell)| (*column, unit.as_str(), *cell)).collect());
    let kind = match cells.text(Column::Contact) {
        None => experiment.contact,
        Some("line" | "roller") => ContactKind::Line,
        Some("point" | "ball") => ContactKind::Point,
        Some(word) => return Err(format!("contact: “{word}” is none; accepted are line, point")),
    };
    let named = cells.text(Column::Lubricant).map(by_name).transpose().map_err(|why| format!("lubricant: {why}"))?;
    let lubricant = named.map_or(experiment.lubricant, |named| named.laws);
    let mut given = [None; 6];
    for (place, quantity) in given.iter_mut().zip(Quantity::SI) {
        *place = cells.quantity(quantity, kind)?;
    }
    let radius_y = cells.quantity(Quantity::RadiusY, kind)?;
    let [radius, speed, load, modulus, mut viscosity, mut alpha] = given;
    if let Some(oil) = oil(&cells)? {
        if viscosity.is_some() || named.is_some() {
            return Err("oil says what viscosity and lubricant say; give one of them".to_owned());
        }
        let state = oil.state().map_err(|error| format!("oil: {error}"))?;
        viscosity = Some(state.viscosity_pa_s);
        alpha = alpha.or(Some(state.alpha_per_pa));
    }
    viscosity = viscosity.or(named.and_then(|named| named.viscosity_pa_s));
    if let Some(own) = lubricant.own_coefficient() {
        if alpha.is_some() {
            return Err(format!(
                "alpha follows from the lubricant's viscosity law ({own:.4e} 1/Pa); leave its cell empty"
            ));
        }
        alpha = Some(own);
    }
    let (m, l) = (cells.quantity(Quantity::M, kind)?, cells.quantity(Quantity::L, kind)?);
    let at = match (m, l) {
        (Some(m), Some(l)) => At::Moes { m, l, radius, radius_y, speed, load, modulus, viscosity, alpha },
        (None, None) => si([radius, speed, load, modulus, viscosity, alpha], radius_y, kind, experiment)?,
        _ => return Err("M and L belong together; give both".to_owned()),
    };
    let mut sliding = experiment.sliding;
    if let Some(srr) = cells.quantity(Quantity::SlideToRollRatio, kind)? {
        sliding.slide_to_roll_ratio = srr;
    }
    sliding.newtonian_plateau_ratio =
        cells.quantity(Quantity::NewtonianPlateauRatio, kind)?.or(sliding.newtonian_plateau_ratio);
    let point = at.point(kind).map_err(|error| error.to_string())?;
    let point = OperatingPoint { sliding, ..point };
    Problem::new(&point, lubricant).map_err(|error| error.to_string())?;
    grid::check(&experiment.grid, kind).map_err(|error| error.to_string())?;
    let grid = experiment.grid.for_contact(&point).map_err(|error| error.to_string())?;
    Ok(Request { lubricant, grid, ..experiment.request_at(point) })
}

/// The oil of a line by its grade and temperature.
fn oil(cells: &Cells<'_>) -> Result<Option<Oil>, String> {
    let temperature = cells.number(Column::Temperature, "temperature", Dimension::Temperature)?;
    let (grade, temperature_k) = match (cells.text(Column::Oil), temperature) {
        (Some(grade), Some(temperature)) => (grade, temperature),
        (Some(_), None) => return Err("an oil of a grade needs a temperature; add the column temperature".to_owned()),
        (None, Some(_)) => return Err("a temperature needs an oil; add the column oil, as ISO VG 68".to_owned()),
        (None, None) => return Ok(None),
    };
    let digits = grade.trim_start_matches(|c: char| !c.is_ascii_digit());
    let number: f64 = digits.parse().map_err(|_| format!("oil: “{grade}” is no grade; write it like ISO VG 68"))?;
    let family = OilFamily::Mineral;
    Ok(Some(Oil { grade: Grade::IsoVg(number), family, temperature_k, density_15: family.usual_density() }))
}

/// The contact in SI units; what is not given is the scene's.
fn si(
    given: [Option<f64>; 6],
    radius_y: Option<f64>,
    kind: ContactKind,
    experiment: &Experiment,
) -> Result<At, String> {
    let mut radius_y = radius_y;
    let own = match experiment.at {
        At::Si { radius, radius_y: own, speed, load, modulus, viscosity, alpha } => {
            if kind == ContactKind::Point {
                radius_y = radius_y.or(own);
            }
            // A load per length is no load.
            let load = (kind == experiment.contact).then_some(load);
            [Some(radius), Some(speed), load, Some(modulus), Some(viscosity), Some(alpha)]
        }
        At::Moes { .. } => [None; 6],
    };
    let all: Vec<Option<f64>> = given.into_iter().zip(own).map(|(given, own)| given.or(own)).collect();
    let [Some(radius), Some(speed), Some(load), Some(modulus), Some(viscosity), Some(alpha)] = *all else {
        let missing = Quantity::SI.into_iter().zip(&all).filter(|(_, value)| value.is_none());
        let missing: Vec<&str> = missing.map(|(quantity, _)| quantity.name()).collect();
        return Err(format!("the contact is incomplete: give {} too, or M and L", missing.join(", ")));
    };
    Ok(At::Si { radius, radius_y, speed, load, modulus, viscosity, alpha })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    fn read(text: &str) -> Result<Vec<LoadCase>, CasesError> {
        cases(text, &Scene::at_moes(40.0, 10.0).experiment())
    }

    fn point(case: &LoadCase) -> OperatingPoint {
        case.request.as_ref().unwrap().point
    }

    #[test]
    fn units_stand_in_titles_or_cells_and_cells_are_separated_as_spreadsheets_do() {
        let wanted = [0.012, 3.0, 3e5, 2.31e11, 0.02, 2e-8];
        for text in [
            "radius,speed,load,modulus,viscosity,alpha\n0.012,3,3e5,2.31e11,0.02,2e-8\n",
            "R [mm]; u_m; w (N/mm); E'; eta_0; alpha\r\n12; 3 m/s; 300; 231 GPa; 20 mPa·s; 20 1/GPa\r\n",
            "\u{feff}R [mm];u;w;E' [GPa];η₀ [mPa·s];α [1/GPa]\n12,0;3,0;300 N/mm;231;20;20\n",
            "\n#note\tR [mm]\tu\tw\tmodulus\tviscosity\talpha\nold\t12\t3\t300 kN/m\t231 GPa\t20 cP\t20 1/GPa\n",
        ] {
            let cases = read(text).unwrap();
            let got = point(&cases[0]).quantities();
            assert!(got.iter().zip(wanted).all(|(got, wanted)| (got / wanted - 1.0).abs() < 1e-12), "{text}: {got:?}");
        }
    }

    #[test]
    fn moes_numbers_oils_and_named_lubricants_are_understood() {
        let text = "name,contact,M,L,R [mm],u,w,E' [GPa],oil,temperature,lubricant,srr\n\
                    a,point,40,10,,,,,,,,5 %\n\
                    b,line,,,12,3,300 N/mm,231,ISO VG 68,60,,\n\
                    c,point,,,12.7,0.5,20,123.8,,,squalane-pip,0.1\n";
        let cases = read(text).unwrap();
        let [a, b, c] = [0, 1, 2].map(|k| point(&cases[k]));
        assert!((a.moes().m - 40.0).abs() < 1e-9 && a.kind == ContactKind::Point);
        assert_eq!(a.sliding.slide_to_roll_ratio, 0.05);
        let oil =
            Oil { grade: Grade::IsoVg(68.0), family: OilFamily::Mineral, temperature_k: 333.15, density_15: 880.0 };
        assert_eq!((b.viscosity_pa_s, b.alpha_per_pa), {
            let state = oil.state().unwrap();
            (state.viscosity_pa_s, state.alpha_per_pa)
        });
        assert_eq!(c.viscosity_pa_s, 0.0705);
        assert_eq!(
            cases.iter().map(|case| (case.line, case.name.as_str())).collect::<Vec<_>>(),
            [(2, "a"), (3, "b"), (4, "c")]
        );
    }

    #[test]
    fn what_a_line_leaves_out_is_the_scenes() {
        let here = Scene { at: OperatingPoint::TABLE_2_1.into(), ..Scene::at_moes(40.0, 10.0) };
        let cases = cases("load\n1e5\n2e5\n", &here.experiment()).unwrap();
        assert_eq!(point(&cases[1]), OperatingPoint { load: 2e5, ..OperatingPoint::TABLE_2_1 });
        let ball = super::cases("contact\npoint\n", &here.experiment()).unwrap();
        assert!(ball[0].request.as_ref().unwrap_err().contains("give load too"));
    }

    #[test]
    fn a_bad_line_is_refused_by_itself_and_bad_titles_refuse_the_table() {
        let head = "radius,speed,load,modulus,viscosity,alpha,oil,temperature,contact,M,L,srr";
        for (line, part) in [
            ("0.012,3,-3e5,2e11,0.02,2e-8", "load is -300000 N"),
            ("0.012,3,abc,2e11,0.02,2e-8", "load: “abc” is no number"),
            ("0.012,3,3 m,2e11,0.02,2e-8", "load: “m” is no unit of a load per length"),
            ("0.012,3,,2e11,0.02,", "give load, alpha too"),
            (",,,,,,,,,40,,", "M and L belong together"),
            ("0.012,3,3e5,2e11,,,ISO VG 69,60", "69 is no ISO viscosity grade"),
            ("0.012,3,3e5,2e11,,,thick,60", "“thick” is no grade"),
            ("0.012,3,3e5,2e11,,,68", "needs a temperature"),
            ("0.012,3,3e5,2e11,0.02,,68,60", "give one of them"),
            ("0.012,3,3e5,2e11,0.02,2e-8,,,ellipsoid", "“ellipsoid” is none"),
            ("0.012,3,3e5,2e11,0.02,2e-8,,,,,,nan", "srr"),
            ("0.012,3,3e5,2e11,0.02,2e-8,,,,,,11", "slide-to-roll ratio is 11"),
            ("1,2,3,4,5,6,7,8,9,10,11,12,13", "13 cells are there, but 12 titles"),
            ("0.012,3,3e5,2e11,0.02,2e-8,,,point,40,10", "M and L leave"),
        ] {
            let cases = read(&format!("{head}\n{line}\n0.012,3,3e5,2e11,0.02,2e-8\n")).unwrap();
            let why = cases[0].request.as_ref().expect_err(line);
            assert!(why.contains(part), "{line}: {why}");
            assert!(cases[1].request.is_ok() && cases[1].line == 3, "the line after it stands");
        }
        for (text, part) in [
            ("", "is empty"),
            ("radius,speed\n", "is empty"),
            ("radius,laod\n1,1\n", "“laod” is unknown"),
            ("radius,R\n1,1\n", "two columns"),
            ("radius [kg]\n1\n", "“kg” is no unit of a length"),
        ] {
            let why = read(text).unwrap_err().to_string();
            assert!(why.contains(part), "{text}: {why}");
        }
    }
}
