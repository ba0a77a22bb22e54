//! Results of all scenes of a folder: finding the scenes, and the results page.
//!
//! The page is also the record of when every scene ran, so that a run of several hours can be continued later, also on
//! another machine.

use super::SceneOutcome;
use super::table::significant;
use crate::host::clock::today;
use crate::scene::{Expectation, Scene, SceneFileError, Verdict};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt::Display;
use std::path::{Path, PathBuf};
use time::Date;
use time::format_description::well_known::Iso8601;
use xxhash_rust::xxh3::xxh3_64;

/// File name of the page in the folder of the scenes.
pub const PAGE: &str = "RESULTS.md";

/// Scene with its location.
#[derive(Clone, Debug)]
pub struct SceneFile {
    /// Path of the file.
    pub path: PathBuf,
    /// Path relative to the folder of all scenes, with slashes: `line/table_2_1.ron`.
    pub place: String,
    /// Content.
    pub scene: Scene,
}

/// Reads all scenes below a folder, sorted by their paths.
///
/// # Errors
/// If the folder cannot be read or a scene is refused.
pub fn scenes_below(folder: &Path) -> Result<Vec<SceneFile>, SceneFileError> {
    let mut paths = Vec::new();
    find(folder, &mut paths)?;
    let read = |path: PathBuf| {
        let inside = path.strip_prefix(folder).unwrap_or(&path);
        let parts: Vec<_> = inside.iter().map(|part| part.to_string_lossy()).collect();
        Ok(SceneFile { place: parts.join("/"), scene: Scene::read(&path)?, path })
    };
    let mut files = paths.into_iter().map(read).collect::<Result<Vec<_>, SceneFileError>>()?;
    files.sort_by(|a, b| a.place.cmp(&b.place));
    Ok(files)
}

fn find(folder: &Path, paths: &mut Vec<PathBuf>) -> Result<(), SceneFileError> {
    let unreadable =
        |reason: std::io::Error| SceneFileError::Read { path: folder.to_owned(), reason: reason.to_string() };
    for entry in std::fs::read_dir(folder).map_err(unreadable)? {
        let entry = entry.map_err(unreadable)?;
        let path = entry.path();
        // Links to folders are not followed, to avoid cycles.
        if entry.file_type().map_err(unreadable)?.is_dir() {
            find(&path, paths)?;
        } else if path.extension().is_some_and(|extension| extension == "ron") {
            paths.push(path);
        }
    }
    Ok(())
}

/// Rows of the page for one scene that ran.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    place: String,
    /// [`hash`] of the scene that ran.
    hash: u64,
    day: Date,
    lines: Vec<Line>,
}

/// One line of an entry. Texts are cells of the page, with `|` escaped.
#[derive(Clone, Debug, PartialEq)]
struct Line {
    wanted: String,
    value: String,
    holds: bool,
}

impl Line {
    fn new(wanted: &str, value: &str, holds: bool) -> Self {
        Self { wanted: cell(wanted), value: cell(value), holds }
    }
}

impl Entry {
    /// Returns the entry of a scene that ran today, or of one that could not run, with the reason.
    pub fn new(file: &SceneFile, outcome: &Result<SceneOutcome, impl Display>) -> Self {
        let (place, hash, day) = (file.place.clone(), hash(&file.scene), today());
        let mut lines = Vec::new();
        match outcome {
            Ok(outcome) => {
                lines.extend(outcome.verdicts.iter().map(|Verdict { expected, value, holds }| {
                    let value = value.map_or("no such value".to_owned(), |value| significant(value, 4));
                    Line::new(&wanted(expected), &value, *holds)
                }));
                if lines.is_empty() || (lines.iter().all(|line| line.holds) && !outcome.passed()) {
                    let converged = if outcome.found.converged { "yes" } else { "no" };
                    lines.push(Line::new("every solve converges", converged, outcome.passed()));
                }
            }
            Err(why) => lines.push(Line::new("it runs", &why.to_string(), false)),
        }
        Self { place, hash, day, lines }
    }

    /// Returns true if all expectations are met.
    pub fn passed(&self) -> bool {
        self.short() == 0
    }

    fn short(&self) -> usize {
        self.lines.iter().filter(|line| !line.holds).count()
    }

    /// Returns true if the entry belongs to the current scene: same path, same [`meaning`].
    pub fn belongs(&self, file: &SceneFile) -> bool {
        self.place == file.place && self.hash == hash(&file.scene)
    }

    /// Returns true if the scene ran on this day or later.
    pub fn ran_since(&self, day: Date) -> bool {
        self.day >= day
    }

    /// Returns the entry of a scene on a page; `None` if it has not run.
    fn of(written: &Written<'_>) -> Option<Self> {
        let (day, hash) = written.run.strip_suffix(" -->")?.split_once(" <!-- ")?;
        let (day, hash) = (day_of(day)?, u64::from_str_radix(hash, 16).ok()?);
        let line = |&(wanted, value, holds): &(&str, &str, bool)| Line {
            wanted: wanted.to_owned(),
            value: value.to_owned(),
            holds,
        };
        Some(Self { place: written.place.to_owned(), hash, day, lines: written.lines.iter().map(line).collect() })
    }

    /// Returns the lines of the page. Title, source and the origin of each expected value are taken from the current
    /// scene.
    fn rows(&self, file: &SceneFile) -> String {
        let run = format!("{} <!-- {:016x} -->", self.day, self.hash);
        let mut expected = file.scene.expect.iter().map(|expected| cell(&wanted(expected)));
        let mut rows = String::new();
        for (i, line) in self.lines.iter().enumerate() {
            let current = if line.wanted.starts_with('`') { expected.next() } else { None };
            let verdict = if line.holds { "ok" } else { SHORT };
            let run = (i == 0).then_some(&*run);
            rows += &row(file, run, current.as_ref().unwrap_or(&line.wanted), &line.value, verdict);
        }
        rows
    }
}

/// Text for a failed verdict.
const SHORT: &str = "**short**";

/// Describes an expectation: `` `H_c` (full): 0.04 ± 1e-3; Table 2.1 ``.
fn wanted(expected: &Expectation) -> String {
    let method = expected.method.as_ref().map_or(String::new(), |method| format!(" ({})", method.name()));
    let wanted = format!("`{}`{method}: {}", expected.name, expected.wanted());
    if expected.from.is_empty() { wanted } else { format!("{wanted}; {}", expected.from) }
}

/// Formats a line of a page's table from cells. `run`, title and source are given only in the first line of a scene.
fn row(file: &SceneFile, run: Option<&str>, wanted: &str, value: &str, verdict: &str) -> String {
    let (title, source) = match run {
        Some(_) => (format!("[{}]({})", cell(&file.scene.title), file.place), cell(&file.scene.source)),
        None => Default::default(),
    };
    let run = run.unwrap_or_default();
    format!("| {title} | {source} | {wanted} | {value} | {verdict} | {run} |\n")
}

/// Parses a day such as `2026-11-29`.
pub fn day_of(text: &str) -> Option<Date> {
    Date::parse(text, &Iso8601::DATE).ok()
}

/// Rows of one scene on a page, as written there.
pub(super) struct Written<'a> {
    pub title: &'a str,
    pub place: &'a str,
    pub source: &'a str,
    /// Day of the run and hash; empty if the scene has not run.
    pub run: &'a str,
    /// Expectation, value, and whether it holds.
    pub lines: Vec<(&'a str, &'a str, bool)>,
}

/// Reads the scenes of a page, in its order.
pub(super) fn written(page: &str) -> Vec<Written<'_>> {
    let mut scenes: Vec<Written<'_>> = Vec::new();
    for line in page.lines() {
        let inside = line.strip_prefix("| ").and_then(|line| line.strip_suffix(" |")).unwrap_or_default();
        let cells: Vec<&str> = inside.split(" | ").collect();
        let &[name, source, wanted, value, verdict, run] = &cells[..] else { continue };
        let named = name.strip_prefix('[').and_then(|name| name.strip_suffix(')')?.rsplit_once("]("));
        match named {
            Some((title, place)) => scenes.push(Written { title, place, source, run, lines: Vec::new() }),
            None if name.trim().is_empty() => {}
            // The head of a table.
            None => continue,
        }
        if let Some(scene) = scenes.last_mut() {
            scene.lines.push((wanted, value, verdict != SHORT));
        }
    }
    scenes
}

/// Reads the entries of a page, by the paths of the scenes. Scenes that have not run have none.
pub fn entries_of(page: &str) -> BTreeMap<String, Entry> {
    written(page).iter().filter_map(Entry::of).map(|entry| (entry.place.clone(), entry)).collect()
}

/// Returns the hash of a scene's [`meaning`].
fn hash(scene: &Scene) -> u64 {
    xxh3_64(meaning(scene).to_string().as_bytes())
}

/// Returns what a scene computes and expects, in a normal form: keys sorted, fields without a value left out, numbers
/// as `f64`. An entry of the page belongs to every scene with the same normal form.
///
/// Fields that affect neither values nor verdicts are left out: version, titles, sources, the explorer's view, and the
/// fields that select scenes for `run --all`.
pub fn meaning(scene: &Scene) -> Value {
    let mut form = serde_json::to_value(scene).unwrap_or_default();
    if let Value::Object(fields) = &mut form {
        for name in ["version", "title", "source", "quick", "training", "view"] {
            fields.remove(name);
        }
    }
    if let Some(Value::Object(training)) = form.pointer_mut("/study/Training") {
        training.remove("title");
    }
    for expected in form.pointer_mut("/expect").and_then(Value::as_array_mut).into_iter().flatten() {
        if let Value::Object(fields) = expected {
            fields.remove("from");
        }
    }
    unify(&mut form);
    form.sort_all_objects();
    form
}

/// Removes fields without a value, and normalises numbers.
fn unify(form: &mut Value) {
    match form {
        Value::Object(fields) => {
            fields.retain(|_, value| !value.is_null());
            fields.values_mut().for_each(unify);
        }
        Value::Array(values) => values.iter_mut().for_each(unify),
        Value::Number(number) => {
            // Adding zero removes the sign of -0. Integers that no `f64` holds stay as they are.
            let exact = number.as_u64().is_none_or(|integer| integer <= 1 << f64::MANTISSA_DIGITS);
            if let Some(value) = number.as_f64().filter(|_| exact) {
                *form = Value::from(value + 0.0);
            }
        }
        Value::Null | Value::Bool(_) | Value::String(_) => {}
    }
}

/// Escapes text for a table cell.
fn cell(text: &str) -> String {
    text.replace('|', "\\|").split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Describes the numbers of scenes, expectations and failed expectations.
pub fn summary<'a>(entries: impl IntoIterator<Item = &'a Entry>) -> String {
    let (mut scenes, mut expectations, mut short) = (0, 0, 0);
    for entry in entries {
        (scenes, expectations, short) = (scenes + 1, expectations + entry.lines.len(), short + entry.short());
    }
    let short = match short {
        0 => "all hold".to_owned(),
        1 => "1 falls short".to_owned(),
        n => format!("{n} fall short"),
    };
    let plural = |count: usize| if count == 1 { "" } else { "s" };
    format!("{scenes} scene{} with {expectations} expectation{}: {short}", plural(scenes), plural(expectations))
}

/// Returns the page: a table for each folder with all scenes. Scenes that have not run in their current form are
/// marked.
pub fn page(files: &[SceneFile], entries: &BTreeMap<String, Entry>) -> String {
    let version = env!("CARGO_PKG_VERSION");
    let entry = |file: &SceneFile| entries.get(&file.place).filter(|entry| entry.belongs(file));
    let known: Vec<_> = files.iter().filter_map(entry).collect();
    let mut text = format!(
        "# Results\n\nWhat the scenes of this folder gave, and what is expected of them. Generated by `ehl-explorer run --all`, \
         version {version}; do not edit.\n\n{}.",
        summary(known.iter().copied())
    );
    match files.len() - known.len() {
        0 => {}
        1 => text += " 1 scene has not run as it is now.",
        n => text += &format!(" {n} scenes have not run as they are now."),
    }
    text.push('\n');
    let mut folders: BTreeMap<&str, Vec<&SceneFile>> = BTreeMap::new();
    for file in files {
        let folder = file.place.rsplit_once('/').map_or(".", |(folder, _)| folder);
        folders.entry(folder).or_default().push(file);
    }
    for (folder, files) in folders {
        text += &format!(
            "\n## {folder}\n\n| Scene | Source | Expected | Value | Verdict | Run |\n| --- | --- | --- | --- | --- | --- |\n"
        );
        for file in files {
            match entry(file) {
                Some(entry) => text += &entry.rows(file),
                None => text += &row(file, Some(""), "it runs", "not yet", ""),
            }
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Method, Within};

    fn file(place: &str) -> SceneFile {
        SceneFile { path: place.into(), place: place.to_owned(), scene: Scene::at_moes(40.0, 10.0) }
    }

    fn outcome(holds: bool) -> SceneOutcome {
        let expected = Expectation {
            name: "H_c".to_owned(),
            method: Some(Method::Full),
            value: Some(0.04),
            within: Within::Absolute(1e-3),
            from: "Table 2.1 | given".to_owned(),
        };
        let verdicts = vec![Verdict { expected, value: Some(0.039_971_9), holds }];
        SceneOutcome { verdicts, ..SceneOutcome::default() }
    }

    fn entry(file: &SceneFile, outcome: SceneOutcome) -> Entry {
        Entry::new(file, &Ok::<_, String>(outcome))
    }

    fn record(entries: impl IntoIterator<Item = Entry>) -> BTreeMap<String, Entry> {
        entries.into_iter().map(|entry| (entry.place.clone(), entry)).collect()
    }

    #[test]
    fn pages_have_a_table_per_folder_with_failures_and_gaps() {
        let refused: Result<SceneOutcome, _> = Err("no such model");
        let files = ["line/b.ron", "line/c.ron", "time/a.ron", "time/later.ron"].map(file);
        let entries = record([
            entry(&files[2], outcome(false)),
            entry(&files[0], outcome(true)),
            Entry::new(&files[1], &refused),
        ]);
        let page = page(&files, &entries);
        assert!(
            page.contains("3 scenes with 3 expectations: 2 fall short. 1 scene has not run as it is now.\n"),
            "{page}"
        );
        let day = entries["line/b.ron"].day;
        assert!(
            page.contains(&format!(
                "](line/b.ron) |  | `H_c` (full): 0.04 ± 1e-3; Table 2.1 \\| given | 0.03997 | ok | {day} <!-- "
            )),
            "{page}"
        );
        assert!(page.contains("| it runs | no such model | **short** |") && page.contains("| 0.03997 | **short** |"));
        assert!(page.contains("](time/later.ron) |  | it runs | not yet |  |  |\n"), "{page}");
        assert!(page.find("## line").unwrap() < page.find("## time").unwrap());
    }

    #[test]
    fn page_entries_are_read_back_for_their_own_scene() {
        let mut several = outcome(true);
        several.verdicts.extend(outcome(false).verdicts);
        let (mut titled, refused) = (file("line/b.ron"), Err("a | b"));
        titled.scene.title = "a | b ](c) [d".to_owned();
        let files = [titled, file("line/c.ron"), file("time/a.ron"), file("time/later.ron")];
        let entries =
            record([entry(&files[0], several), Entry::new(&files[1], &refused), entry(&files[2], outcome(true))]);
        let first = page(&files, &entries);
        let read = entries_of(&first);
        assert_eq!(read, entries);
        assert_eq!(page(&files, &read), first);
        assert!(read.get("line/b.ron").is_some_and(|entry| (entry.lines.len(), entry.short()) == (2, 1)));

        let entry = &read["time/a.ron"];
        let other = SceneFile { scene: Scene::at_moes(41.0, 10.0), ..files[2].clone() };
        assert!(entry.belongs(&files[2]) && !entry.belongs(&other) && !entry.belongs(&files[3]));
        assert!(page(&[other], &read).contains("1 scene has not run as it is now"));
        assert!(entry.ran_since(entry.day) && !entry.ran_since(entry.day.next_day().unwrap()));
    }

    #[test]
    fn entries_survive_respelled_scenes_under_new_titles() {
        let text = |fields: &str| format!("Scene(version: 1, {fields})");
        let of = |fields: &str| Scene::from_ron(&text(fields)).unwrap();
        let old = of(
            r#"title: "a", study: Sweep(over: [(vary: Alpha, values: Log(from: 5e-9, to: 2e-8, n: 3))], methods: [Full]),
            at: Si(radius: 0.02, speed: 5, load: 1e6, modulus: 2.2e11, viscosity: 0.004, alpha: 2.2e-8),
            expect: [(name: "H_c", within: AtMost(1), from: "b")]"#,
        );
        let same =
            of(r#"expect: [(name: "H_c", method: None, within: AtMost(1.0), from: "other")], source: "s", quick: true,
            srr: -0.0, lubricant: (), contact: Line, title: "new title", view: (),
            at: Si(alpha: 0.22e-7, radius: 2e-2, speed: 5.0, load: 1000000.0, modulus: 220e9, viscosity: 4e-3),
            study: Sweep(methods: [Full], over: [(vary: Alpha, values: Log(to: 20e-9, from: 0.5e-8, n: 3))])"#);
        assert_eq!(meaning(&same).to_string(), meaning(&old).to_string());
        let (mut first, mut second) = (file("line/a.ron"), file("line/a.ron"));
        (first.scene, second.scene) = (old.clone(), same);
        let verdicts = vec![Verdict { expected: old.expect[0].clone(), value: Some(0.5), holds: true }];
        let outcome: Result<_, String> = Ok(SceneOutcome { verdicts, ..SceneOutcome::default() });
        let entry = Entry::new(&first, &outcome);
        assert!(entry.belongs(&second));
        let page = page(&[second], &record([entry.clone()]));
        assert!(page.contains("| [new title](line/a.ron) | s | `H_c`: at most 1.0; other | 0.5000 | ok |"), "{page}");

        let mut others = vec![old.clone(); 5];
        others[0].srr = 0.1;
        others[1].expect[0].within = Within::AtMost(2.0);
        others[2].expect[0].method = Some(Method::Full);
        others[3].expect.clear();
        others[4].failures_expected = true;
        for other in others {
            first.scene = other;
            assert!(!entry.belongs(&first), "{:?}", first.scene);
        }
    }

    #[test]
    fn of_pages_of_others_nothing_is_taken_over() {
        for text in [
            "",
            "# Results\n",
            "| [t](a.ron) |  | it runs | yes | ok |\n",
            "| [\n|  |\n",
            "| [t](a.ron) | 2026-13-01 <!-- 0 --> |",
        ] {
            assert_eq!(entries_of(text), BTreeMap::new(), "{text}");
        }
        assert_eq!(day_of("2026-11-29").map(|day| day.to_string()).as_deref(), Some("2026-11-29"));
        assert_eq!((day_of("29.11.2026"), day_of("2026-02-30"), day_of("today")), (None, None, None));
    }
}
