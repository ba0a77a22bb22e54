//! Terms that the program does not use, because the field has others: in texts of the source, in the output of
//! `--help`, in the manual, the lessons and the README.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Terms that are wrong wherever they occur, each with the term of the field.
const TERMS: &[(&str, &str)] = &[
    ("rupture", "cavitation"),
    ("ruptures", "cavitation"),
    ("ruptured", "cavitated"),
    ("film breaks", "cavitation"),
    ("by a penalty", "cavitation: penalty"),
    ("truncation error", "domain-truncation error"),
    ("smallest film", "minimum film thickness"),
    ("thinnest film", "minimum film thickness"),
    ("supplied film", "inlet film thickness"),
    ("many oils", "lubricant-parameterised"),
    ("oils that thin", "shear-thinning lubricants"),
    ("light contact", "lightly loaded"),
    ("light contacts", "lightly loaded"),
    ("light ball", "lightly loaded"),
    ("light balls", "lightly loaded"),
    ("light circle", "lightly loaded"),
    ("heavy contact", "heavily loaded"),
    ("heavy contacts", "heavily loaded"),
    ("grid costs", "discretisation error"),
    ("the grid costs", "discretisation error"),
    ("window around", "local model"),
    ("windows around", "local models"),
    ("sampled rows", "sampled equations"),
    ("rule for the traction", "traction quadrature"),
    ("kept start", "stored starting value"),
    ("kept starts", "stored starting values"),
    ("rounded starts", "stored starting values"),
    ("kriged start", "kriging prediction as initial guess"),
    ("kriged starts", "kriging predictions as initial guesses"),
    ("untrained", "outside the trained range"),
    ("held against", "checked against"),
    ("hold against", "check against"),
    ("load left over", "load residual"),
    ("load left", "load residual"),
    ("displacement h₀", "rigid separation h₀"),
    ("displacement h_0", "rigid separation h_0"),
    ("stiffening", "piezoviscous parameter"),
    ("shear below", "maximum subsurface shear stress"),
    ("former", "previous"),
    ("beside", "next to, in addition to"),
    ("anew", "again"),
    ("so many", "that many"),
    ("told", "reported"),
    ("tells", "reports"),
    ("knows", "supports, stores"),
    ("stands in", "substitutes"),
    ("to and fro", "oscillates"),
    ("somebody", "name the person"),
    ("nobody", "name the person"),
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Returns the files below a folder with an ending.
fn files(folder: &str, ending: &str) -> Vec<PathBuf> {
    let (mut found, mut folders) = (Vec::new(), vec![root().join(folder)]);
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == ending) {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// Returns the string literals of a source, without its tests. Comments and characters are skipped.
fn literals(source: &str) -> Vec<String> {
    let source = source.split("#[cfg(test)]\nmod tests {").next().unwrap();
    let (mut found, mut rest) = (Vec::new(), source);
    while let Some(first) = rest.chars().next() {
        let literal = |start: &str, end: &str| rest.strip_prefix(start)?.split_once(end);
        if rest.starts_with("//") {
            rest = rest.split_once('\n').map_or("", |(_, after)| after);
        } else if let Some((text, after)) = literal("r#\"", "\"#") {
            found.push(text.to_owned());
            rest = after;
        } else if let Some(after) = rest.strip_prefix("'\"'").or_else(|| rest.strip_prefix("'\\\"'")) {
            rest = after;
        } else if first == '"' {
            let mut escaped = false;
            let ends = |(_, c): &(usize, char)| {
                let end = *c == '"' && !escaped;
                escaped = *c == '\\' && !escaped;
                end
            };
            let end = rest[1..].char_indices().find(ends).map_or(rest.len() - 1, |(k, _)| k);
            found.push(rest[1..=end].replace("\\\n", " ").replace("\\n", " "));
            rest = rest.get(end + 2..).unwrap_or_default();
        } else {
            rest = &rest[first.len_utf8()..];
        }
    }
    found
}

/// Returns true for a name in a file format or of a folder, which users do not read as a sentence.
fn is_name(text: &str) -> bool {
    text.chars().all(|c| c.is_ascii_lowercase() || "_./".contains(c))
}

/// Returns the terms of a text that should be others. Paths and code between backquotes do not count.
fn wrong(text: &str) -> Vec<&'static (&'static str, &'static str)> {
    let prose: Vec<&str> = text.split('`').step_by(2).collect();
    let prose = prose.join(" ").to_lowercase().split_whitespace().collect::<Vec<_>>().join(" ");
    let prose = prose.replace("domain-truncation error", "");
    let is_word = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_');
    let occurs = |term: &str| {
        prose.match_indices(term).any(|(at, _)| {
            !is_word(prose[..at].chars().next_back()) && !is_word(prose[at + term.len()..].chars().next())
        })
    };
    TERMS.iter().filter(|(term, _)| occurs(term)).collect()
}

fn check(texts: impl IntoIterator<Item = (String, String)>) {
    let (mut count, mut found) = (0, Vec::new());
    for (place, text) in texts {
        count += 1;
        found.extend(wrong(&text).into_iter().map(|(term, use_)| format!("{place}: “{term}” in “{text}”: {use_}")));
    }
    assert!(count > 10, "the texts are where they are looked for");
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn a_wrong_term_is_found_and_a_name_is_not() {
    let source =
        "let a = \"The film \\\n  ruptures\"; // rupture\nlet b = '\"'; let c = \"a \\\"light ball\\\"\"; \"former\"";
    let texts = literals(source);
    assert_eq!(texts.len(), 3, "{texts:?}");
    let terms: Vec<&str> = texts.iter().flat_map(|text| wrong(text)).map(|(term, _)| *term).collect();
    assert_eq!(terms, ["ruptures", "light ball", "former"]);
    assert!(wrong("see `scenes/rupture/a.ron`, domain-truncation error, formerly").is_empty());
    assert!(is_name("scenes/rupture") && !is_name("Rupture") && !is_name("a rupture"));
}

#[test]
fn texts_of_the_program_use_the_terms_of_the_field() {
    check(files("src", "rs").into_iter().filter(|path| !path.to_string_lossy().ends_with("tests.rs")).flat_map(
        |path| {
            let texts = literals(&std::fs::read_to_string(&path).unwrap());
            let place = path.strip_prefix(root()).unwrap().display().to_string();
            texts.into_iter().filter(|text| !is_name(text)).map(move |text| (place.clone(), text)).collect::<Vec<_>>()
        },
    ));
}

#[test]
fn help_uses_the_terms_of_the_field() {
    let help = |words: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_ehl-explorer")).args(words).arg("--help").output().unwrap();
        assert!(output.status.success(), "{words:?}");
        String::from_utf8(output.stdout).unwrap()
    };
    let overview = help(&[]);
    let listed = overview.split("Commands:").nth(1).unwrap().lines().skip(1).take_while(|line| !line.is_empty());
    let first = listed.filter_map(|line| line.split_whitespace().next());
    let commands: Vec<&str> = first.filter(|command| *command != "help").collect();
    assert!(commands.contains(&"solve") && commands.len() > 5, "{commands:?}");
    let pages: Vec<(String, String)> =
        commands.iter().map(|command| ((*command).to_owned(), help(&[command]))).collect();
    let lines = |(command, page): &(String, String)| -> Vec<(String, String)> {
        page.split("\n\n").map(|part| (format!("{command} --help"), part.to_owned())).collect()
    };
    check(pages.iter().flat_map(lines).chain([("--help".to_owned(), overview.clone())]));
}

#[test]
fn manual_lessons_and_readme_use_the_terms_of_the_field() {
    let papers = [files("assets/manual", "md"), files("assets/lessons", "md"), vec![root().join("README.md")]];
    check(papers.into_iter().flatten().flat_map(|path| {
        let text = std::fs::read_to_string(&path).unwrap();
        let place = path.strip_prefix(root()).unwrap().display().to_string();
        text.split("\n\n").map(|part| (place.clone(), part.to_owned())).collect::<Vec<_>>()
    }));
}
