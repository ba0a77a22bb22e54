//! All scenes of a folder: finding them, and the page of what came of them.

use super::SceneOutcome;
use super::table::significant;
use crate::scene::{Scene, SceneFileError, Verdict};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};
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

/// What the page says of one scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Entry {
    place: String,
    /// Of the scene that it was made from.
    hash: u64,
    expectations: usize,
    short: usize,
    /// Lines of the table.
    rows: String,
}

impl Entry {
    /// What is to be said of a scene that ran, or of one that could not, with the reason.
    pub fn new(file: &SceneFile, outcome: &Result<SceneOutcome, String>) -> Self {
        let mut entry = Self { place: file.place.clone(), hash: hash(&file.scene), ..Self::default() };
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
            Err(why) => entry.push(file, "it runs", why, false),
        }
        entry
    }

    /// Adds a line, with the scene and its source in the first one only.
    fn push(&mut self, file: &SceneFile, wanted: &str, value: &str, holds: bool) {
        let (title, source) = if self.rows.is_empty() {
            (format!("[{}]({})", cell(&file.scene.title), file.place), cell(&file.scene.source))
        } else {
            Default::default()
        };
        let verdict = if holds { "ok" } else { "**short**" };
        // Writing to a string cannot fail.
        let _ = writeln!(self.rows, "| {title} | {source} | {} | {} | {verdict} |", cell(wanted), cell(value));
        self.expectations += 1;
        self.short += usize::from(!holds);
    }

    /// Whether every expectation holds.
    pub fn passed(&self) -> bool {
        self.short == 0
    }

    /// As text that [`Entry::kept`] reads back.
    pub fn to_text(&self) -> String {
        format!("{:016x} {} {}\n{}", self.hash, self.expectations, self.short, self.rows)
    }

    /// An entry that was kept, where it belongs to the scene as it is now.
    pub fn kept(file: &SceneFile, text: &str) -> Option<Self> {
        let (head, rows) = text.split_once('\n')?;
        let [kept, expectations, short] = head.split(' ').collect::<Vec<_>>().try_into().ok()?;
        let (expectations, short) = (expectations.parse().ok()?, short.parse().ok()?);
        let kept = u64::from_str_radix(kept, 16).ok().filter(|kept| *kept == hash(&file.scene))?;
        Some(Self { place: file.place.clone(), hash: kept, expectations, short, rows: rows.to_owned() })
    }
}

fn hash(scene: &Scene) -> u64 {
    xxh3_64(scene.to_ron().unwrap_or_default().as_bytes())
}

/// Text that does not end its cell.
fn cell(text: &str) -> String {
    text.replace('|', "\\|").split_whitespace().collect::<Vec<_>>().join(" ")
}

/// How many scenes and expectations there are, and how many of these fall short.
pub fn summary(entries: &[Entry]) -> String {
    let count = |of: fn(&Entry) -> usize| entries.iter().map(of).sum::<usize>();
    let short = match count(|entry| entry.short) {
        0 => "all hold".to_owned(),
        1 => "1 falls short".to_owned(),
        n => format!("{n} fall short"),
    };
    format!("{} scenes with {} expectations: {short}", entries.len(), count(|entry| entry.expectations))
}

/// The page: a table for each folder. It changes only when results do.
pub fn page(entries: &[Entry]) -> String {
    let version = env!("CARGO_PKG_VERSION");
    let mut text = format!(
        "# Results\n\nWhat the scenes of this folder gave, and what is expected of them. Generated by `ehl-explorer run --all`, \
         version {version}; do not edit.\n\n{}.\n",
        summary(entries)
    );
    let mut folders: BTreeMap<&str, Vec<&Entry>> = BTreeMap::new();
    for entry in entries {
        let folder = entry.place.rsplit_once('/').map_or(".", |(folder, _)| folder);
        folders.entry(folder).or_default().push(entry);
    }
    for (folder, entries) in folders {
        let _ = writeln!(
            text,
            "\n## {folder}\n\n| Scene | Source | Expected | Value | Verdict |\n| --- | --- | --- | --- | --- |"
        );
        text.extend(entries.iter().map(|entry| entry.rows.as_str()));
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

    #[test]
    fn a_page_has_a_table_for_each_folder_and_says_what_falls_short() {
        let refused: Result<SceneOutcome, String> = Err("no such model".to_owned());
        let entries = [
            Entry::new(&file("time/a.ron"), &Ok(outcome(false))),
            Entry::new(&file("line/b.ron"), &Ok(outcome(true))),
            Entry::new(&file("line/c.ron"), &refused),
        ];
        let page = page(&entries);
        assert!(page.contains("3 scenes with 3 expectations: 2 fall short."), "{page}");
        assert!(
            page.contains("](line/b.ron) |  | `H_c` (full): 0.04 ± 1e-3; Table 2.1 \\| given | 0.03997 | ok |\n"),
            "{page}"
        );
        assert!(page.contains("| it runs | no such model | **short** |") && page.contains("| 0.03997 | **short** |"));
        assert!(page.find("## line").unwrap() < page.find("## time").unwrap());
    }

    #[test]
    fn an_entry_is_kept_for_its_own_scene_only() {
        let file = file("line/b.ron");
        let entry = Entry::new(&file, &Ok(outcome(true)));
        assert_eq!(Entry::kept(&file, &entry.to_text()), Some(entry.clone()));
        let other = SceneFile { scene: Scene::at_moes(41.0, 10.0), ..file.clone() };
        assert_eq!(Entry::kept(&other, &entry.to_text()), None);
        assert_eq!(Entry::kept(&file, "nonsense\n"), None);
    }
}
