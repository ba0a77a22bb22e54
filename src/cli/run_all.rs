//! Command `run --all`: runs every scene below a folder and writes the results page.
//!
//! Scenes that train embedded models are left out unless `--only` names them, since these models are retrained one at a
//! time.

use super::failure::Failure;
use super::output;
use super::run::{RunArgs, keep_model, make_out, outcome_of, stem, tell};
use super::verdict::Verdict;
use crate::engine::results::{Entry, PAGE, SceneFile, entries_of, page, scenes_below, summary};
use crate::engine::{
    Store,
    job::{JobError, guarded},
};
use crate::scene::{TrainedModel, atomic_file};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Runs all selected scenes. An error in one scene does not stop the others. All scenes are read and checked before the
/// first one runs, and each result is on the page before the next scene starts.
pub fn run(args: &RunArgs) -> Result<Verdict, Failure> {
    let folder = &args.folder;
    let all = scenes_below(folder)?;
    let (chosen, left_out): (Vec<&SceneFile>, Vec<&SceneFile>) =
        all.iter().filter(|file| selected(file, args)).partition(|file| !embeds(file) || named(file, args));
    if chosen.is_empty() {
        let what = match (all.is_empty(), args.only.is_empty(), args.quick) {
            (true, _, _) => "no scene (.ron) lies below",
            _ if !left_out.is_empty() => {
                "only scenes that train embedded models, which --only must name one by one, lie below"
            }
            (_, true, _) => "no scene is marked `quick: true` below",
            (_, _, false) => "no path of a scene starts with a value of --only below",
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
        // The page is also updated if no scene had to run, since scenes may have been added or removed.
        atomic_file::replace(&target, page(&all, &recorded(&target)).as_bytes())?;
        sentence = format!("{sentence}; see {}", target.display());
    }
    match left_out.len() {
        0 => {}
        1 => sentence += "; 1 scene that trains an embedded model did not run, --only can name it",
        n => sentence += &format!("; {n} scenes that train embedded models did not run, --only can name them"),
    }
    output::complain(&sentence);
    Ok(if entries.iter().all(Entry::passed) { Verdict::Done } else { Verdict::FellShort })
}

/// Returns true if the options select a scene.
fn selected(file: &SceneFile, args: &RunArgs) -> bool {
    let below = args.only.is_empty() || args.only.iter().any(|place| file.place.starts_with(place.as_str()));
    below && (file.scene.quick || !args.quick)
}

/// Returns true if a scene trains an embedded model.
fn embeds(file: &SceneFile) -> bool {
    file.scene.training == TrainedModel::Embedded
}

/// Returns true if `--only` gives a scene's full path, with or without `.ron`.
fn named(file: &SceneFile, args: &RunArgs) -> bool {
    let place = file.place.strip_suffix(".ron").unwrap_or(&file.place);
    args.only.iter().any(|only| only.strip_suffix(".ron").unwrap_or(only) == place)
}

/// Reads the entries of the page, if it exists. It is read again each time, because other processes may run scenes of
/// the same folder.
fn recorded(page: &Path) -> BTreeMap<String, Entry> {
    std::fs::read_to_string(page).map(|text| entries_of(&text)).unwrap_or_default()
}

/// Returns true if the entry of a scene can be kept.
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
                // A model that cannot be written does not stop the other scenes.
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

    /// Returns the text of a scene of one contact at M = 10, L = 5 that expects H_c above `least`.
    fn scene(quick: bool, method: &str, least: f64) -> String {
        format!(
            "Scene(version: 1, title: \"t\", quick: {quick}, at: Moes(m: 10.0, l: 5.0), study: Point(methods: [{method}]), \
             expect: [(name: \"H_c\", within: AtLeast({least:?}), from: \"test\")])"
        )
    }

    fn below(scenes: &Path) -> RunArgs {
        RunArgs {
            scenes: Vec::new(),
            all: true,
            quick: false,
            folder: scenes.to_owned(),
            only: Vec::new(),
            resume: false,
            since: None,
            out: None,
            animate: None,
            json: false,
        }
    }

    #[test]
    fn embedded_training_scene_runs_only_if_named() {
        let folder = tempfile::tempdir().unwrap();
        let scenes = folder.path();
        std::fs::create_dir(scenes.join("training")).unwrap();
        std::fs::write(scenes.join("training/short.ron"), scene(true, "Reduced()", 0.0)).unwrap();
        let march =
            "Transient(inputs: (load: Harmonic(amplitude: 0.1, period: 4.0)), duration: 0.1, time_step: Fixed(0.05))";
        let march = format!(
            "Scene(version: 1, title: \"t\", training: Embedded, at: Moes(m: 10.0, l: 5.0), \
             grid: Uniform(dx: 0.05, domain: (-4.0, 2.0)), study: {march})"
        );
        std::fs::write(scenes.join("training/march.ron"), &march).unwrap();
        let only = |place: &str| RunArgs { only: vec![place.to_owned()], ..below(scenes) };
        let page = || std::fs::read_to_string(scenes.join(PAGE)).unwrap();
        let without = "1 scene with 1 expectation: all hold. 1 scene has not run as it is now.";
        for args in [below(scenes), only("training")] {
            assert_eq!(run(&args).unwrap(), Verdict::Done);
            assert!(page().contains(without), "{}", page());
        }
        assert!(format!("{:?}", run(&only("training/m")).unwrap_err()).contains("train embedded models"));
        for place in ["training/march", "training/march.ron"] {
            std::fs::remove_file(scenes.join(PAGE)).unwrap();
            assert_eq!(run(&only(place)).unwrap(), Verdict::Done);
            assert!(page().contains("](training/march.ron) |  | every solve converges | yes | ok |"), "{}", page());
        }
        assert_eq!(run(&below(scenes)).unwrap(), Verdict::Done);
        assert!(page().contains("2 scenes with 2 expectations: all hold.\n"), "{}", page());
    }

    #[test]
    fn all_scenes_run_and_quick_runs_keep_the_page() {
        let folder = tempfile::tempdir().unwrap();
        let (scenes, out) = (folder.path().join("scenes"), folder.path().join("out"));
        std::fs::create_dir_all(scenes.join("line")).unwrap();
        let write = |name: &str, text: String| std::fs::write(scenes.join(name), text).unwrap();
        write("line/good.ron", scene(true, "Reduced()", 0.0));
        write("line/no_model.ron", scene(false, "Reduced(model: File(\"none.rom\"))", 0.0));
        write("short.ron", scene(false, "Reduced()", 1e9));
        let args = |quick, resume| RunArgs { quick, resume, out: Some(out.clone()), ..below(&scenes) };
        assert_eq!(run(&args(true, false)).unwrap(), Verdict::Done);
        assert!(!scenes.join(PAGE).exists());
        assert_eq!(run(&args(false, false)).unwrap(), Verdict::FellShort);
        let page = std::fs::read_to_string(scenes.join(PAGE)).unwrap();
        assert!(page.contains("3 scenes with 3 expectations: 2 fall short"), "{page}");
        assert!(page.contains("](line/no_model.ron)") && page.contains("none.rom"), "{page}");
        // Results on the page are kept unless they are older than requested; failed scenes run again.
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
        // A result of a changed scene is not kept unless the scene runs; results of scenes not selected stay unchanged.
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
        assert!(refused(&only("nowhere")).contains("a value of --only"));
        let slow = RunArgs { quick: true, ..only("short") };
        assert!(refused(&slow).contains("no scene that --only names is marked `quick: true`"));
        write("line/wrong.ron", "Scene(".to_owned());
        assert!(run(&args(false, false)).is_err(), "all scenes are read before the first is run");
    }
}
