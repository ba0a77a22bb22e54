//! Command `cases`: table of load cases.

use super::failure::Failure;
use super::options::choices;
use super::output::{self, ProgressLine};
use super::verdict::Verdict;
use crate::engine::Workbench;
use crate::scene::study::load_cases::{LoadCases, Row};
use crate::scene::{
    CaseTable, Field, Grid, Method, ModelSource, ResultJson, Scene, Study, StudyObserver, StudyRow, atomic_file,
    run_scene,
};
use crate::solver::observer::{Observer, Progress};
use crate::solver::training::TrainingObserver;
use clap::Args;
use serde::Serialize;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

/// Options of `cases`.
#[derive(Debug, Args)]
pub struct CasesArgs {
    /// The table
    #[arg(value_name = "TABLE.csv", help = table_help())]
    table: PathBuf,
    /// Solution method; full,reduced for both
    #[arg(long, value_parser = choices(Field::Method), value_delimiter = ',', default_value = "full")]
    method: Vec<String>,
    /// Reduced model to use: a file, or the name of an embedded one (default: the embedded one for the contact)
    #[arg(long, value_name = "FILE")]
    rom: Option<PathBuf>,
    /// Write the results as CSV (default: print them)
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Print one JSON object per line and method
    #[arg(long)]
    json: bool,
}

fn table_help() -> String {
    format!(
        "Table: a line of titles, then one contact per line. Columns are name and the flags of `solve`: {}; units are given \
         in titles, such as `load [N/mm]`, or in cells",
        CaseTable::accepted()
    )
}

/// Runs the command. Refused lines are reported, all others are solved.
pub fn run(args: &CasesArgs) -> Result<Verdict, Failure> {
    let source = || args.rom.clone().map_or(ModelSource::Embedded, ModelSource::File);
    let method = |name: &String| if name == "reduced" { Method::reduced(source()) } else { Method::Full };
    let methods: Vec<Method> = args.method.iter().map(method).collect();
    if args.rom.is_some() && methods.iter().all(|method| *method == Method::Full) {
        return Err(Failure::Request("--rom has no effect here; add --method reduced".to_owned()));
    }
    let study = Study::LoadCases(LoadCases { cases: CaseTable::File(args.table.clone()), methods });
    let title = format!("Load cases of {}", args.table.display());
    let scene = Scene { title, grid: Grid::Usual, study, ..Scene::at_moes(40.0, 10.0) };
    let mut workbench = Workbench::new("");
    workbench.check_models(&scene)?;
    let watch = Watch { line: ProgressLine::new(false), rows: Mutex::default() };
    let outcome = run_scene(&scene, &mut workbench, &watch)?;
    watch.line.finish();
    let rows = watch.rows.into_inner().unwrap_or_else(PoisonError::into_inner);
    if args.json {
        rows.iter().try_for_each(print)?;
    }
    let text = outcome.tables.first().map(|table| table.to_csv()).unwrap_or_default();
    match &args.csv {
        Some(path) => atomic_file::replace(path, text.as_bytes())?,
        None if !args.json => output::print(&text)?,
        None => {}
    }
    outcome.found.warnings.iter().for_each(|warning| output::complain(&warning.to_string()));
    let failed = rows.iter().flat_map(|row| row.results.iter().flatten()).filter(|result| !result.converged).count();
    if failed > 0 {
        output::complain(&format!("{failed} solves did not converge; their results are left empty"));
    }
    Ok(if outcome.found.converged { Verdict::Done } else { Verdict::FellShort })
}

/// Line as JSON: its result by one method, or the reason why it is refused.
#[derive(Serialize)]
struct Line<'a> {
    line: usize,
    #[serde(skip_serializing_if = "str::is_empty")]
    name: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    measured_h_c_m: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    refused: Option<String>,
    #[serde(flatten)]
    result: Option<ResultJson<'a>>,
}

fn print(row: &Row) -> Result<(), Failure> {
    let Row { line, name, measured_m: measured_h_c_m, results } = row;
    let (line, measured_h_c_m) = (*line, *measured_h_c_m);
    let print = |refused, result| output::print_json(&Line { line, name, measured_h_c_m, refused, result });
    match results {
        Err(why) => print(Some(why.to_string()), None),
        Ok(results) => results.iter().try_for_each(|result| print(None, Some(result.json()))),
    }
}

/// Observer that shows the progress and stores the rows.
struct Watch {
    line: ProgressLine,
    rows: Mutex<Vec<Row>>,
}

impl Observer for Watch {
    fn progress(&self, progress: Progress) {
        self.line.progress(progress);
    }
}

impl TrainingObserver for Watch {}

impl StudyObserver for Watch {
    fn row(&self, row: StudyRow) {
        if let StudyRow::LoadCases(row) = row {
            self.rows.lock().unwrap_or_else(PoisonError::into_inner).push(row);
        }
    }
}
