//! README and manual are correct: commands run or at least parse, files and links exist, lists are complete.

use crate::common::scene_files as repository;
use crate::common::scratch::Scratch;
use ehl_explorer::scene::{Scene, Study};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Options whose value is a file or folder to be written.
const WRITTEN: [&str; 7] = ["--csv", "--profiles", "--report", "--stress", "--film-shear", "--out", "--arrays"];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Texts of the repository's page: README, manual, and other documents next to the README.
fn papers() -> Vec<(PathBuf, String)> {
    let mut papers = Vec::new();
    for folder in [root().to_owned(), root().join("assets/manual")] {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|extension| extension == "md") {
                let text = std::fs::read_to_string(&path).unwrap();
                papers.push((path, text));
            }
        }
    }
    papers.sort();
    assert!(papers.len() > 10, "README and manual are where they are looked for");
    papers
}

fn readme() -> String {
    std::fs::read_to_string(root().join("README.md")).unwrap()
}

/// Returns the command lines of all documents in their order, without repetitions.
fn commands() -> Vec<Vec<String>> {
    let mut seen = BTreeSet::new();
    let all = papers().into_iter().flat_map(|(_, text)| commands_of(&text));
    all.filter(|words| seen.insert(words.clone())).collect()
}

/// Returns command lines in fenced `sh` blocks, without comments and with continued lines joined, and those in text.
fn commands_of(text: &str) -> Vec<Vec<String>> {
    let mut commands = Vec::new();
    let (mut inside, mut pending) = (false, String::new());
    for line in text.lines() {
        if line.starts_with("```") {
            assert!(pending.is_empty(), "a block ends in the middle of `{pending}`");
            inside = line == "```sh";
            continue;
        }
        if !inside {
            let spans = line.split('`').skip(1).step_by(2);
            let calls = spans.filter(|span| span.starts_with("cargo ") || span.starts_with("ehl-explorer "));
            commands.extend(calls.map(words));
            continue;
        }
        let line = line.split(" #").next().unwrap_or_default().trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        assert!(!line.contains(['\'', '|', '$']), "this test knows double quotes only: {line}");
        if let Some(start) = line.strip_suffix('\\') {
            pending.push_str(start);
            continue;
        }
        commands.push(words(&(std::mem::take(&mut pending) + line)));
    }
    commands
}

/// Splits a command at spaces outside double quotes.
fn words(command: &str) -> Vec<String> {
    let mut words = Vec::new();
    for (k, part) in command.split('"').enumerate() {
        match k % 2 {
            0 => words.extend(part.split_whitespace().map(str::to_owned)),
            _ => words.push(part.to_owned()),
        }
    }
    words
}

/// Returns the arguments of every command line of this program. All others must be `cargo`'s.
fn own_commands() -> Vec<Vec<String>> {
    let prefixes: [&[&str]; 2] = [&["ehl-explorer"], &["cargo", "run", "--release", "--"]];
    let own = |words: &Vec<String>| {
        let prefix =
            prefixes.iter().find(|prefix| words.iter().zip(**prefix).filter(|(a, b)| a == b).count() == prefix.len());
        match prefix {
            Some(prefix) => Some(words[prefix.len()..].to_vec()),
            None => {
                let known = matches!(words[0].as_str(), "cargo" | "git" | "cd" | "pip" | "python3" | "rustup");
                // Scripts of the repository take long.
                let known = known || root().join(&words[0]).is_file();
                assert!(known, "an unknown program: {words:?}");
                None
            }
        }
    };
    commands().iter().filter_map(own).collect()
}

fn program<S: AsRef<std::ffi::OsStr>>(arguments: &[S]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ehl-explorer")).args(arguments).current_dir(root()).output().unwrap()
}

fn assert_done(arguments: &[String], output: &Output) {
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{}: {error}", arguments.join(" "));
}

fn scene_files(arguments: &[String]) -> Vec<(PathBuf, Scene)> {
    let is_scene = |argument: &&String| Path::new(argument).extension().is_some_and(|extension| extension == "ron");
    let read = |argument: &String| {
        let path = root().join(argument);
        let scene = Scene::read(&path).unwrap_or_else(|error| panic!("{error}"));
        (path, scene)
    };
    arguments.iter().filter(is_scene).map(read).collect()
}

/// A request for help after other arguments is refused if one of them is unknown, and runs nothing.
fn assert_parses(arguments: &[String]) {
    assert_done(arguments, &program(&[arguments, &["--help".to_owned()]].concat()));
}

fn is_quick(scene: &Scene) -> bool {
    matches!(scene.study, Study::Point(_) | Study::GridStudy(_) | Study::FormulaComparison(_))
}

/// Returns true if a scene trains a steady or transient model.
fn trains(scene: &Scene) -> bool {
    matches!(&scene.study, Study::Training(_) | Study::Transient(_))
}

#[test]
fn every_command_runs_or_at_least_parses() {
    let folder = Scratch::new("readme");
    let mut seen = BTreeSet::new();
    // Models trained by previous lines are missing, since nothing is trained here.
    let mut trained: Vec<String> = Vec::new();
    for mut arguments in own_commands() {
        let command = arguments.first().cloned().unwrap_or_default();
        let scenes = if command == "campaign" { Vec::new() } else { scene_files(&arguments) };
        let executed = match command.as_str() {
            "solve" | "sweep" | "cases" => !arguments.iter().any(|argument| trained.contains(argument)),
            "info" => !trained.contains(&arguments[1]),
            "run" => !scenes.is_empty() && scenes.iter().all(|(_, scene)| is_quick(scene)),
            "train" => {
                assert!(scenes.len() == 1 && trains(&scenes[0].1), "{arguments:?}");
                trained.extend(arguments.iter().skip_while(|a| *a != "--out").nth(1).cloned());
                false
            }
            "campaign" => arguments[1] == "plan",
            // A unit needs a library that is built separately.
            "bench" | "export" => false,
            // The window needs a display. The test only checks that the scene can be read.
            _ => {
                assert_eq!(arguments.len(), scenes.len(), "{arguments:?}");
                continue;
            }
        };
        seen.insert(command);
        assert_parses(&arguments);
        if !executed {
            continue;
        }
        let mut written = Vec::new();
        for k in 1..arguments.len() {
            if WRITTEN.contains(&arguments[k - 1].as_str()) {
                let path = folder.join(&arguments[k]);
                arguments[k] = path.to_string_lossy().into_owned();
                written.push(path);
            }
        }
        let output = program(&arguments);
        assert_done(&arguments, &output);
        assert!(!output.stdout.is_empty() || !written.is_empty(), "{arguments:?} says nothing");
        assert!(written.iter().all(|path| path.exists()), "{arguments:?} writes nothing");
    }
    let all = ["bench", "campaign", "cases", "export", "info", "run", "solve", "sweep", "train"];
    assert!(all.iter().all(|command| seen.contains(*command)), "commands without an example: seen are {seen:?}");
}

#[test]
fn unknown_options_do_not_pass_as_parsed() {
    for bad in [["bench", "--slow", "--help"], ["train", "--wings", "--help"]] {
        assert_eq!(program(&bad).status.code(), Some(2), "{bad:?}");
    }
}

#[test]
fn tests_that_are_named_exist() {
    let mut count = 0;
    for words in commands().iter().filter(|words| words.starts_with(&["cargo".to_owned(), "test".to_owned()])) {
        let Some(k) = words.iter().position(|word| word == "--test") else { continue };
        let path = root().join("tests").join(&words[k + 1]);
        let files = std::fs::read_dir(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        if let Some(filter) = words.get(k + 2).filter(|word| !word.starts_with('-')) {
            // A filter is part of `file::name_of_the_test`.
            let (file, name) = filter.split_once("::").unwrap_or(("", filter));
            let mut texts = files.map(|entry| entry.unwrap().path()).filter(|path| {
                let stem = path.file_stem().unwrap().to_string_lossy();
                file.is_empty() || stem.ends_with(file)
            });
            let found = texts.any(|path| std::fs::read_to_string(path).unwrap().contains(&format!("fn {name}")));
            assert!(found, "{} has no test {filter}", path.display());
        }
        count += 1;
    }
    assert!(count > 0);
}

#[test]
fn files_that_are_named_exist_and_every_scene_is_listed() {
    let scenes: BTreeSet<String> = repository::all().iter().map(|file| repository::name(&file.path) + ".ron").collect();
    for (path, text) in papers() {
        let words = text.split(|c: char| c.is_whitespace() || "`()[],;|".contains(c));
        for word in words.map(|word| word.trim_end_matches(['.', ':'])) {
            let ours = ["scenes/", "assets/", "tests/", "src/"].iter().any(|folder| word.starts_with(folder));
            let exists = !ours || word.contains('*') || root().join(word).exists();
            assert!(exists, "{}: {word} does not exist", path.display());
            let name =
                word.strip_suffix(".ron").filter(|name| name.contains(char::is_lowercase) && !name.contains('/'));
            assert!(name.is_none() || scenes.contains(word), "{}: there is no scene {word}", path.display());
        }
    }
    let list = std::fs::read_to_string(root().join("assets/manual/scenes.md")).unwrap();
    for name in scenes {
        assert!(list.contains(&format!("`{name}`")), "the manual's list of scenes lacks {name}");
    }
    for name in ["LICENSE-MIT", "LICENSE-APACHE"] {
        assert!(readme().contains(name) && root().join(name).is_file(), "{name}");
    }
}

#[test]
fn links_lead_somewhere_and_the_readme_is_short() {
    assert!(readme().len() <= 10_240, "the README has {} bytes", readme().len());
    let mut count = 0;
    for (path, text) in papers() {
        let folder = path.parent().unwrap();
        for target in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            let elsewhere = target.starts_with("https://");
            assert!(elsewhere || folder.join(target).is_file(), "{}: {target} leads nowhere", path.display());
            count += 1;
        }
    }
    assert!(count > 30, "links are found: {count}");
    let manual = std::fs::read_to_string(root().join("assets/manual/start.md")).unwrap();
    for (path, text) in papers().iter().filter(|(path, _)| path.parent() != Some(root())) {
        let name = path.file_name().unwrap().to_string_lossy();
        assert!(text.starts_with("# "), "{name} begins with its title");
        assert!(name == "start.md" || manual.contains(&format!("]({name})")), "the manual's contents lack {name}");
    }
}

#[test]
fn every_direct_dependency_is_explained() {
    let manifest = std::fs::read_to_string(root().join("Cargo.toml")).unwrap();
    let mut section = "";
    let mut dependencies = BTreeSet::new();
    for line in manifest.lines() {
        if line.starts_with('[') {
            section = line;
        } else if section.ends_with("dependencies]") {
            dependencies.extend(line.split_once('=').map(|(name, _)| name.trim().to_owned()));
        }
    }
    assert!(dependencies.len() > 10, "{dependencies:?}");
    let text = readme();
    let table =
        text.split("\n## ").find(|section| section.starts_with("Dependencies")).expect("a section Dependencies");
    let rows: BTreeSet<String> = table
        .lines()
        .filter_map(|line| line.strip_prefix("| `")?.split_once('`'))
        .inspect(|(name, reason)| assert!(reason.len() > 20, "{name} has no reason"))
        .map(|(name, _)| name.to_owned())
        .collect();
    assert_eq!(rows, dependencies, "README (left) and Cargo.toml (right) name other dependencies");
}

/// With other versions the program and its bindings could not share compiled crates.
#[test]
fn bindings_are_locked_to_what_the_program_is() {
    let versions = |path: &str| -> BTreeSet<(String, String)> {
        let text = std::fs::read_to_string(root().join(path)).unwrap();
        let value = |line: Option<&str>, name: &str| {
            line?.strip_prefix(name)?.strip_prefix(" = \"")?.strip_suffix('"').map(str::to_owned)
        };
        let package = |text: &str| {
            let mut lines = text.trim_start().lines();
            Some((value(lines.next(), "name")?, value(lines.next(), "version")?))
        };
        text.split("[[package]]").skip(1).map(|text| package(text).unwrap()).collect()
    };
    let (program, bindings) = (versions("Cargo.lock"), versions("bindings/Cargo.lock"));
    let both = |(name, _): &&(String, String)| program.iter().any(|(other, _)| other == name);
    let other: Vec<_> = bindings.iter().filter(both).filter(|package| !program.contains(package)).collect();
    assert!(bindings.len() > 100 && other.is_empty(), "bindings/Cargo.lock has others than Cargo.lock: {other:?}");
}
