//! `run --all`: every scene below a folder, and the page of what came of them.

use super::failure::Failure;
use super::output;
use super::run::{RunArgs, keep_model, make_out, outcome_of, stem, tell};
use super::verdict::Verdict;
use crate::engine::results::{Entry, PAGE, SceneFile, entries_of, page, scenes_below, summary};
use crate::engine::{
    Store,
    job::{JobError, guarded},
};
use crate::scene::atomic_file;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Runs them, each whatever became of the others. All are read and checked before the first runs, and what came of each
/// is on the page before the next one begins.
pub fn run(args: &RunArgs) -> Result<Verdict, Failure> {
    let folder = &args.folder;
    let all = scenes_below(folder)?;
    let chosen: Vec<&SceneFile> = all.iter().filter(|file| wanted(file, args)).collect();
    if chosen.is_empty() {
        let what = match (all.is_empty(), args.only.is_empty(), args.quick) {
            (true, _, _) => "no scene (.ron) lies below",
            (_, true, _) => "no scene is marked `quick: true` below",
            (_, _, false) => "no place of a scene begins with what --only says below",
            (_, _, true) => "no scene that --only names is marked `quick: true` below",
        };
        return Err(Failure::Request(format!("{what} {}; --scenes names their folder", folder.display())));
    }
    make_out(args)?;
    let (store, target) = (Store::default(), folder.join(PAGE));
    let paths: Vec<PathBuf> = all.iter().map(|file| file.path.clone()).collect();
    let mut entries = Vec::with_capacity(chosen.len());
    for file in &chosen {
        let known = recorded(&target).remove(&file.place).filter(|entry| serves(entry, file, args));
        let entry = match known {
            Some(entry) => entry,
            None => {
                let entry = entry_of(file, args, &store, &paths)?;
                if !args.quick {
                    let mut record = recorded(&target);
                    record.insert(file.place.clone(), entry.clone());
                    atomic_file::replace(&target, page(&all, &record).as_bytes())?;
                }
                entry
            }
        };
        entries.push(entry);
    }
    let mut sentence = summary(&entries);
    if args.quick {
        sentence =
            format!("{sentence}; of {} scenes only those marked `quick: true`, so {PAGE} is left as it is", all.len());
    } else {
        // Scenes may have gone or come where nothing had to run.
        atomic_file::replace(&target, page(&all, &recorded(&target)).as_bytes())?;
        sentence = format!("{sentence}; see {}", target.display());
    }
    output::complain(&sentence);
    Ok(if entries.iter().all(Entry::passed) { Verdict::Done } else { Verdict::FellShort })
}

/// Whether a scene is to be run at all.
fn wanted(file: &SceneFile, args: &RunArgs) -> bool {
    let named = args.only.is_empty() || args.only.iter().any(|place| file.place.starts_with(place.as_str()));
    named && (file.scene.quick || !args.quick)
}

/// What the page says, if there is one. It is read anew each time: others may run scenes of the same folder.
fn recorded(page: &Path) -> BTreeMap<String, Entry> {
    std::fs::read_to_string(page).map(|text| entries_of(&text)).unwrap_or_default()
}

/// Whether what the page says of a scene can be taken over.
fn serves(entry: &Entry, file: &SceneFile, args: &RunArgs) -> bool {
    args.resume && entry.belongs(file) && entry.passed() && args.since.is_none_or(|day| entry.ran_since(day))
}

fn entry_of(file: &SceneFile, args: &RunArgs, store: &Store, all: &[PathBuf]) -> Result<Entry, Failure> {
    let ran = guarded(|| outcome_of(&file.path, &file.scene, store));
    let outcome = ran.map_err(JobError::from).and_then(|outcome| outcome.map_err(JobError::failed));
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
    use time::Duration;

    /// A scene of one contact at M = 10, L = 5, which expects a film above `least`.
    fn scene(quick: bool, method: &str, least: f64) -> String {
        format!(
            "Scene(version: 1, title: \"t\", quick: {quick}, at: Moes(m: 10.0, l: 5.0), study: Point(methods: [{method}]), \
             expect: [(name: \"H_c\", within: AtLeast({least:?}), from: \"test\")])"
        )
    }

    #[test]
    fn every_scene_is_run_whatever_became_of_the_others_and_a_quick_run_leaves_the_page() {
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
            only: Vec::new(),
            resume,
            since: None,
            out: Some(out.clone()),
            json: false,
        };
        assert_eq!(run(&args(true, false)).unwrap(), Verdict::Done);
        assert!(!scenes.join(PAGE).exists());
        assert_eq!(run(&args(false, false)).unwrap(), Verdict::FellShort);
        let page = std::fs::read_to_string(scenes.join(PAGE)).unwrap();
        assert!(page.contains("3 scenes with 3 expectations: 2 fall short"), "{page}");
        assert!(page.contains("](line/no_model.ron)") && page.contains("none.rom"), "{page}");
        // What was kept is taken over, unless it is older than wanted; what fell short is tried again.
        let film = "| 0.1256 | ok |";
        assert!(page.contains(film), "{page}");
        std::fs::write(scenes.join(PAGE), page.replace(film, "| kept | ok |")).unwrap();
        assert_eq!(run(&args(false, true)).unwrap(), Verdict::FellShort);
        let page = std::fs::read_to_string(scenes.join(PAGE)).unwrap();
        assert!(
            page.contains("3 scenes with 3 expectations: 2 fall short") && page.contains("| kept | ok |"),
            "{page}"
        );
        let since = crate::host::clock::today().saturating_add(Duration::days(2));
        run(&RunArgs { since: Some(since), ..args(false, true) }).unwrap();
        assert!(std::fs::read_to_string(scenes.join(PAGE)).unwrap().contains(film));
        // Of a scene that is another now nothing is, unless it runs; what is not asked for stays as it is.
        write("line/good.ron", scene(true, "Reduced()", 1e9));
        write("short.ron", scene(false, "Reduced()", 1e-9));
        let only = |place: &str| RunArgs { only: vec![place.to_owned()], ..args(false, true) };
        assert_eq!(run(&only("sh")).unwrap(), Verdict::Done);
        let page = std::fs::read_to_string(scenes.join(PAGE)).unwrap();
        assert!(
            page.contains("2 scenes with 2 expectations: 1 falls short. 1 scene has not run as it is now."),
            "{page}"
        );
        assert_eq!(run(&only("line/good")).unwrap(), Verdict::FellShort);
        let refused = |args: &RunArgs| format!("{:?}", run(args).unwrap_err());
        assert!(refused(&only("nowhere")).contains("--only says"));
        let slow = RunArgs { quick: true, ..only("short") };
        assert!(refused(&slow).contains("no scene that --only names is marked `quick: true`"));
        write("line/wrong.ron", "Scene(".to_owned());
        assert!(run(&args(false, false)).is_err(), "all scenes are read before the first is run");
    }
}
