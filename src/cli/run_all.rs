//! `run --all`: every scene below a folder, and the page of what came of them.

use super::Verdict;
use super::failure::Failure;
use super::output;
use super::run::{RunArgs, keep_model, make_out, outcome_of, stem, tell};
use crate::engine::results::{Entry, PAGE, SceneFile, page, scenes_below, summary};
use crate::engine::{Store, job::guarded};
use crate::scene::atomic_file;
use std::path::{Path, PathBuf};

/// Runs them, each whatever became of the others. All are read and checked before the first runs.
pub fn run(args: &RunArgs) -> Result<Verdict, Failure> {
    let folder = &args.folder;
    let mut files = scenes_below(folder)?;
    let there = files.len();
    if args.quick {
        files.retain(|file| file.scene.quick);
    }
    if files.is_empty() {
        let what = if there == 0 { "no scene (.ron) lies below" } else { "no scene is marked `quick: true` below" };
        return Err(Failure::Request(format!("{what} {}; --scenes names their folder", folder.display())));
    }
    make_out(args)?;
    let store = Store::default();
    let paths: Vec<PathBuf> = files.iter().map(|file| file.path.clone()).collect();
    let mut entries = Vec::with_capacity(files.len());
    for file in &files {
        let kept = args.out.as_ref().map(|out| out.join(format!("{}.entry", stem(&file.path, &paths))));
        let known = kept.as_deref().filter(|_| args.resume).and_then(|kept| known(file, kept));
        let entry = match known {
            Some(entry) => entry,
            None => {
                let entry = entry_of(file, args, &store, &paths)?;
                if let Some(kept) = &kept {
                    atomic_file::replace(kept, entry.to_text().as_bytes())?;
                }
                entry
            }
        };
        entries.push(entry);
    }
    let mut sentence = summary(&entries);
    if args.quick {
        sentence = format!("{sentence}; of {there} scenes only those marked `quick: true`, so {PAGE} is left as it is");
    } else {
        let target = folder.join(PAGE);
        atomic_file::replace(&target, page(&entries).as_bytes())?;
        sentence = format!("{sentence}; see {}", target.display());
    }
    output::complain(&sentence);
    Ok(if entries.iter().all(Entry::passed) { Verdict::Done } else { Verdict::FellShort })
}

/// What an earlier run kept of a scene.
fn known(file: &SceneFile, kept: &Path) -> Option<Entry> {
    Entry::kept(file, &std::fs::read_to_string(kept).ok()?)
}

fn entry_of(file: &SceneFile, args: &RunArgs, store: &Store, all: &[PathBuf]) -> Result<Entry, Failure> {
    let ran = guarded(|| outcome_of(&file.path, &file.scene, store));
    let outcome = ran.and_then(|outcome| outcome.map_err(|refused| refused.to_string()));
    match &outcome {
        Ok(outcome) => {
            if let Some(out) = &args.out {
                let name = stem(&file.path, all);
                outcome.write(out, &name)?;
                // A model that no file can hold does not end the others.
                if let Err(refused) = keep_model(&file.scene, store, out, &name) {
                    output::complain(&refused.to_string());
                }
            }
            tell(outcome, args.json)?;
        }
        Err(why) => output::complain(&format!("{}: {why}", file.place)),
    }
    Ok(Entry::new(file, &outcome))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A scene of one contact at M = 10, L = 5, which expects a film above `least`.
    fn scene(quick: bool, method: &str, least: f64) -> String {
        format!(
            "Scene(version: 1, title: \"t\", quick: {quick}, at: Moes(m: 10.0, l: 5.0), study: Point(methods: [{method}]), \
             expect: [(name: \"H_c\", within: AtLeast({least:?}), from: \"test\")])"
        )
    }

    #[test]
    fn every_scene_is_run_whatever_became_of_the_others_and_only_a_full_run_writes_the_page() {
        let folder = tempfile::tempdir().unwrap();
        let (scenes, out) = (folder.path().join("scenes"), folder.path().join("out"));
        std::fs::create_dir_all(scenes.join("line")).unwrap();
        let write = |name: &str, text: String| std::fs::write(scenes.join(name), text).unwrap();
        write("line/good.ron", scene(true, "Reduced()", 0.0));
        write("line/no_model.ron", scene(false, "Reduced(model: File(\"none.rom\"))", 0.0));
        write("short.ron", scene(false, "Reduced()", 1e9));
        let args = |quick, resume| RunArgs {
            scenes: Vec::new(),
            all: true,
            quick,
            folder: scenes.clone(),
            resume,
            out: Some(out.clone()),
            json: false,
        };
        assert_eq!(run(&args(true, false)).unwrap(), Verdict::Done);
        assert!(!scenes.join(PAGE).exists());
        assert_eq!(run(&args(false, false)).unwrap(), Verdict::FellShort);
        let page = std::fs::read_to_string(scenes.join(PAGE)).unwrap();
        assert!(page.contains("3 scenes with 3 expectations: 2 fall short"), "{page}");
        assert!(page.contains("](line/no_model.ron)") && page.contains("none.rom"), "{page}");
        // What was kept is taken over, and gives the same page.
        std::fs::remove_file(scenes.join(PAGE)).unwrap();
        assert_eq!(run(&args(false, true)).unwrap(), Verdict::FellShort);
        assert_eq!(std::fs::read_to_string(scenes.join(PAGE)).unwrap(), page);
        write("line/wrong.ron", "Scene(".to_owned());
        assert!(run(&args(false, false)).is_err(), "all scenes are read before the first is run");
    }
}
