//! Table of load cases: its location, how it is read, and its lines.

use super::columns::{Column, accepted, titles};
use super::error::{CasesError, LineError};
use super::line::{measured, request};
use crate::host::files;
use crate::scene::answer::Request;
use crate::scene::check::MAX_POINTS;
use crate::scene::csv::records;
use crate::scene::examples;
use crate::scene::experiment::Experiment;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Largest accepted size of a table \[bytes\].
const MAX_BYTES: u64 = 32 << 20;

/// Location of a table of load cases or of measured values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum CaseTable {
    /// CSV file.
    File(PathBuf),
    /// Text in the scene, as pasted.
    Text(String),
}

/// Line of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadCase {
    /// Line number, from 1.
    pub line: usize,
    /// Name; may be empty.
    pub name: String,
    /// Measured central film thickness \[m\], with which the computed one is compared.
    pub measured_m: Option<f64>,
    /// Request, or the reason why the line is refused.
    pub request: Result<Request, LineError>,
}

impl CaseTable {
    /// Reads the table. `resolve` returns the full path of a file of the scene.
    ///
    /// # Errors
    /// If the table cannot be read, or if its titles are invalid. An invalid line is refused without affecting the
    /// others.
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

    /// Returns the accepted titles, in addition to those of the columns of names and measured film thicknesses.
    pub fn accepted() -> String {
        accepted()
    }

    /// Returns the text of the table. `resolve` returns the full path of a file of the scene.
    ///
    /// # Errors
    /// If the file cannot be read.
    pub fn text(&self, resolve: &dyn Fn(&Path) -> PathBuf) -> Result<String, CasesError> {
        match self {
            Self::Text(text) => Ok(text.clone()),
            Self::File(path) => text_of(&resolve(path)),
        }
    }

    /// Returns the table of a file as a text that can be edited.
    ///
    /// # Errors
    /// If it cannot be read.
    pub fn pasted(path: &Path) -> Result<Self, CasesError> {
        text_of(path).map(Self::Text)
    }
}

fn text_of(path: &Path) -> Result<String, CasesError> {
    if let Some(text) = examples::text_of(path) {
        return Ok(text.to_owned());
    }
    let unreadable = |reason: String| CasesError::Read { path: path.to_owned(), reason };
    let bytes = files::read_at_most(path, MAX_BYTES + 1).map_err(|error| unreadable(error.to_string()))?;
    if bytes.len() as u64 > MAX_BYTES {
        return Err(unreadable(format!("it is larger than {} MiB", MAX_BYTES >> 20)));
    }
    String::from_utf8(bytes).map_err(|_| unreadable("it is not UTF-8 text; save it as CSV in UTF-8".to_owned()))
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
        let (measured_m, request) = match measured(columns, &cells) {
            Ok(measured) => (measured, request(columns, &cells, experiment)),
            Err(refused) => (None, Err(refused)),
        };
        cases.push(LoadCase { line, name, measured_m, request });
    }
    if cases.is_empty() { Err(CasesError::Empty) } else { Ok(cases) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::solver::physics::contact::{ContactKind, OperatingPoint};
    use crate::solver::physics::engineering::{Grade, Oil, OilFamily};

    fn read(text: &str) -> Result<Vec<LoadCase>, CasesError> {
        cases(text, &Scene::at_moes(40.0, 10.0).experiment())
    }

    fn point(case: &LoadCase) -> OperatingPoint {
        case.request.as_ref().unwrap().point
    }

    #[test]
    fn units_and_separators_of_spreadsheets_are_read() {
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
        let oil = Oil {
            grade: Grade::IsoVg(68.0),
            family: OilFamily::Mineral,
            temperature_k: 333.15,
            density_15: 880.0,
            alpha_per_pa: None,
        };
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
    fn measured_film_thickness_is_positive_or_missing() {
        let cases = read("M,L,Measured h_c [nm]\n40,10,80\n40,10,0.1 µm\n40,10,\n40,10,3 N\n40,10,-1\n").unwrap();
        let films: Vec<_> = cases.iter().map(|case| case.measured_m.map(|film| (1e9 * film).round())).collect();
        assert_eq!(films, [Some(80.0), Some(100.0), None, None, None]);
        let accepted: Vec<bool> = cases.iter().map(|case| case.request.is_ok()).collect();
        assert_eq!(accepted, [true, true, true, false, false]);
        assert!(cases[4].request.as_ref().unwrap_err().to_string().contains("above zero"));
        assert!(read("M,L,measured [N]\n40,10,80\n").unwrap_err().to_string().contains("no unit of a length"));
    }

    #[test]
    fn what_a_line_leaves_out_is_the_scenes() {
        let here = Scene { at: OperatingPoint::TABLE_2_1.into(), ..Scene::at_moes(40.0, 10.0) };
        let cases = cases("load\n1e5\n2e5\n", &here.experiment()).unwrap();
        assert_eq!(point(&cases[1]), OperatingPoint { load: 2e5, ..OperatingPoint::TABLE_2_1 });
        let ball = super::cases("contact\npoint\n", &here.experiment()).unwrap();
        assert!(ball[0].request.as_ref().unwrap_err().to_string().contains("give load too"));
    }

    #[test]
    fn bad_lines_and_bad_titles_are_refused() {
        let head = "radius,speed,load,modulus,viscosity,alpha,oil,temperature,contact,M,L,srr";
        for (line, part) in [
            ("0.012,3,-3e5,2e11,0.02,2e-8", "load is -300000 N"),
            ("0.012,3,abc,2e11,0.02,2e-8", "load: “abc” is no number"),
            ("0.012,3,3 m,2e11,0.02,2e-8", "load: “m” is no unit of a load per length"),
            ("0.012,3,,2e11,0.02,", "give load, alpha too"),
            (",,,,,,,,,40,,", "M and L belong together"),
            ("0.012,3,3e5,2e11,,,ISO VG 69,60", "69 is no ISO viscosity grade"),
            ("0.012,3,3e5,2e11,,,thick,60", "oil: “thick” is not valid; enter a grade such as ISO VG 68"),
            ("0.012,3,3e5,2e11,,,68", "needs a temperature"),
            ("0.012,3,3e5,2e11,0.02,,68,60", "or both of them"),
            ("0.012,3,3e5,2e11,0.02,2e-8,,,ellipsoid", "“ellipsoid” is not valid"),
            ("0.012,3,3e5,2e11,0.02,2e-8,,,,,,nan", "srr"),
            ("0.012,3,3e5,2e11,0.02,2e-8,,,,,,11", "srr is 11, but must be a finite number between -10 and 10"),
            ("0.012,3,3e5,2e11,0.02,2e-8,,,,,,,80 N", "there are 13 cells"),
            ("1,2,3,4,5,6,7,8,9,10,11,12,13", "there are 13 cells, but 12 titles"),
            ("0.012,3,3e5,2e11,0.02,2e-8,,,point,40,10", "M and L leave"),
        ] {
            let cases = read(&format!("{head}\n{line}\n0.012,3,3e5,2e11,0.02,2e-8\n")).unwrap();
            let why = cases[0].request.as_ref().expect_err(line).to_string();
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
