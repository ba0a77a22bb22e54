//! All scenes of a folder: finding them, and the page of what came of them.
//!
//! The page is the record as well: it says of every scene when it ran, so that a run of hours can go on where it was
//! left, on another machine too.

use super::SceneOutcome;
use super::table::significant;
use crate::host::clock::today;
use crate::scene::{Scene, SceneFileError, Verdict};
use std::collections::BTreeMap;
use std::fmt::Display;
use std::path::{Path, PathBuf};
use time::Date;
use time::format_description::well_known::Iso8601;
use xxhash_rust::xxh3::xxh3_64;

/// Name of the page in the folder of the scenes.
pub const PAGE: &str = "RESULTS.md";

/// A scene and where it lies.
#[derive(Clone, Debug)]
pub struct SceneFile {
    /// The file.
    pub path: PathBuf,
    /// The same from the folder of all scenes, with slashes: `line/table_2_1.ron`.
    pub place: String,
    /// Its content.
    pub scene: Scene,
}

/// Reads every scene below a folder, in the order of their places.
///
/// # Errors
/// When the folder cannot be read or a scene is refused.
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
        // A link to a folder is not followed: it could lead back.
        if entry.file_type().map_err(unreadable)?.is_dir() {
            find(&path, paths)?;
        } else if path.extension().is_some_and(|extension| extension == "ron") {
            paths.push(path);
        }
    }
    Ok(())
}

/// What the page says of one scene that ran.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    place: String,
    /// Of the scene that ran.
    hash: u64,
    day: Date,
    expectations: usize,
    short: usize,
    /// Lines of the table.
    rows: String,
}

impl Entry {
    /// What is to be said of a scene that ran today, or of one that could not, with the reason.
    pub fn new(file: &SceneFile, outcome: &Result<SceneOutcome, impl Display>) -> Self {
        let (place, hash, day) = (file.place.clone(), hash(&file.scene), today());
        let mut entry = Self { place, hash, day, expectations: 0, short: 0, rows: String::new() };
        match outcome {
            Ok(outcome) => {
                for Verdict { expected, value, holds } in &outcome.verdicts {
                    let method =
                        expected.method.as_ref().map_or(String::new(), |method| format!(" ({})", method.name()));
                    let mut wanted = format!("`{}`{method}: {}", expected.name, expected.wanted());
                    if !expected.from.is_empty() {
                        wanted = format!("{wanted}; {}", expected.from);
                    }
                    let value = value.map_or("no such value".to_owned(), |value| significant(value, 4));
                    entry.push(file, &wanted, &value, *holds);
                }
                if outcome.verdicts.is_empty() || (entry.short == 0 && !outcome.passed()) {
                    let converged = if outcome.found.converged { "yes" } else { "no" };
                    entry.push(file, "every solve converges", converged, outcome.passed());
                }
            }
            Err(why) => entry.push(file, "it runs", &why.to_string(), false),
        }
        entry
    }

    /// Adds a line, with the scene, its source and the run in the first one only.
    fn push(&mut self, file: &SceneFile, wanted: &str, value: &str, holds: bool) {
        let verdict = if holds { "ok" } else { SHORT };
        let run = format!("{} <!-- {:016x} -->", self.day, self.hash);
        self.rows += &row(file, self.rows.is_empty().then_some(&*run), wanted, value, verdict);
        self.expectations += 1;
        self.short += usize::from(!holds);
    }

    /// Whether every expectation holds.
    pub fn passed(&self) -> bool {
        self.short == 0
    }

    /// Whether it belongs to the scene as it is now.
    pub fn belongs(&self, file: &SceneFile) -> bool {
        self.place == file.place && self.hash == hash(&file.scene)
    }

    /// Whether the scene ran on this day or later.
    pub fn ran_since(&self, day: Date) -> bool {
        self.day >= day
    }

    /// Reads the first line of an entry; `None` where it is of a scene that has not run, or of no scene at all.
    fn begin(line: &str) -> Option<Self> {
        let cells: Vec<_> = line.strip_prefix("| ")?.strip_suffix(" |")?.split(" | ").collect();
        let place = cells.first()?.rsplit_once("](")?.1.strip_suffix(')')?.to_owned();
        let (day, hash) = cells.last()?.strip_suffix(" -->")?.split_once(" <!-- ")?;
        let (day, hash) = (day_of(day)?, u64::from_str_radix(hash, 16).ok()?);
        Some(Self { place, hash, day, expectations: 0, short: 0, rows: String::new() })
    }
}

/// What stands for a verdict that is none too good.
const SHORT: &str = "**short**";

/// A line of a page's table; what a scene's first line alone says is there where the run is.
fn row(file: &SceneFile, run: Option<&str>, wanted: &str, value: &str, verdict: &str) -> String {
    let (title, source) = match run {
        Some(_) => (format!("[{}]({})", cell(&file.scene.title), file.place), cell(&file.scene.source)),
        None => Default::default(),
    };
    let run = run.unwrap_or_default();
    format!("| {title} | {source} | {} | {} | {verdict} | {run} |\n", cell(wanted), cell(value))
}

/// A day as `2026-11-29`.
pub fn day_of(text: &str) -> Option<Date> {
    Date::parse(text, &Iso8601::DATE).ok()
}

/// What a page says of the scenes that ran, by their places.
pub fn entries_of(page: &str) -> BTreeMap<String, Entry> {
    let mut entries: BTreeMap<String, Entry> = BTreeMap::new();
    let mut at = None;
    for line in page.lines() {
        if line.starts_with("| [") {
            at = Entry::begin(line).map(|entry| {
                let place = entry.place.clone();
                entries.insert(place.clone(), entry);
                place
            });
        } else if !line.starts_with("|  |") {
            at = None;
        }
        if let Some(entry) = at.as_ref().and_then(|place| entries.get_mut(place)) {
            entry.rows.extend([line, "\n"]);
            entry.expectations += 1;
            entry.short += usize::from(line.contains(&format!(" | {SHORT} | ")));
        }
    }
    entries
}

fn hash(scene: &Scene) -> u64 {
    xxh3_64(scene.to_ron().unwrap_or_default().as_bytes())
}

/// Text that does not end its cell.
fn cell(text: &str) -> String {
    text.replace('|', "\\|").split_whitespace().collect::<Vec<_>>().join(" ")
}

/// How many scenes and expectations there are, and how many of these fall short.
pub fn summary<'a>(entries: impl IntoIterator<Item = &'a Entry>) -> String {
    let (mut scenes, mut expectations, mut short) = (0, 0, 0);
    for entry in entries {
        (scenes, expectations, short) = (scenes + 1, expectations + entry.expectations, short + entry.short);
    }
    let short = match short {
        0 => "all hold".to_owned(),
        1 => "1 falls short".to_owned(),
        n => format!("{n} fall short"),
    };
    let plural = |count: usize| if count == 1 { "" } else { "s" };
    format!("{scenes} scene{} with {expectations} expectation{}: {short}", plural(scenes), plural(expectations))
}

/// The page: a table for each folder, with every scene; those that have not run as they are now are named.
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
                Some(entry) => text += &entry.rows,
                None => text += &row(file, Some(""), "it runs", "not yet", ""),
            }
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Expectation, Method, Within};

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
    fn a_page_has_a_table_for_each_folder_and_says_what_falls_short_or_has_not_run() {
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
    fn a_page_gives_its_entries_back_and_each_belongs_to_its_own_scene_only() {
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
        assert!(read.get("line/b.ron").is_some_and(|entry| (entry.expectations, entry.short) == (2, 1)));

        let entry = &read["time/a.ron"];
        let other = SceneFile { scene: Scene::at_moes(41.0, 10.0), ..files[2].clone() };
        assert!(entry.belongs(&files[2]) && !entry.belongs(&other) && !entry.belongs(&files[3]));
        assert!(page(&[other], &read).contains("1 scene has not run as it is now"));
        assert!(entry.ran_since(entry.day) && !entry.ran_since(entry.day.next_day().unwrap()));
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
