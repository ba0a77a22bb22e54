//! Search for entries of the palette.

use super::entry::Entry;

/// Returns the entries that contain every word of a query, best first. A match at the start of a word ranks before
/// one inside a word, a match in the name before one in the keywords, and among equal ones a name that starts with the
/// whole query. Unavailable commands come last. Returns all entries without a query.
pub fn find<'a>(entries: &'a [Entry], query: &str) -> Vec<&'a Entry> {
    let query = folded(query);
    let words: Vec<&str> = query.split_whitespace().collect();
    let mut found: Vec<(u32, &Entry)> =
        entries.iter().filter_map(|entry| Some((distance(entry, &words)?, entry))).collect();
    found.sort_by_key(|(distance, entry)| {
        (entry.refusal.is_some(), *distance, !folded(&entry.name).starts_with(query.trim()))
    });
    found.into_iter().map(|(_, entry)| entry).collect()
}

/// Returns the rank of an entry for some words. `None` if a word is missing.
fn distance(entry: &Entry, words: &[&str]) -> Option<u32> {
    let (name, other) = (folded(&entry.name), folded(&format!("{} {}", entry.group, entry.synonyms)));
    let begins = |text: &str, word: &str| text.split(|c: char| !c.is_alphanumeric()).any(|own| own.starts_with(word));
    let of = |word: &&str| match () {
        () if begins(&name, word) => Some(0),
        () if name.contains(word) => Some(1),
        () if begins(&other, word) => Some(2),
        () => other.contains(word).then_some(3),
    };
    words.iter().map(of).sum()
}

/// Returns text in lower case without hyphens, ellipses and apostrophes.
fn folded(text: &str) -> String {
    text.to_lowercase().chars().filter(|c| !matches!(c, '-' | '…' | '’' | '\'')).collect()
}

#[cfg(test)]
mod tests {
    use super::super::entry;
    use super::*;
    use crate::app::desk::Desk;
    use crate::app::document::Document;
    use crate::app::model_source::Models;
    use crate::engine::Store;
    use std::path::PathBuf;

    fn names(desk: &Desk, query: &str) -> Vec<String> {
        find(&entry::all(desk), query).into_iter().map(|entry| entry.name.clone()).collect()
    }

    #[test]
    fn words_are_found_in_any_order_and_beginnings_come_first() {
        let mut desk = Desk::new(Document::default(), Models::only(None), Store::default());
        desk.files.recent.push(PathBuf::from("/home/me/contacts/bearing_47.ron"));
        assert_eq!(names(&desk, "theme dark"), ["Dark theme"]);
        assert_eq!(names(&desk, "READOUTS")[0], "Copy read-outs");
        assert_eq!(names(&desk, "trac")[0], "Go to Traction");
        assert_eq!(names(&desk, "pip squa"), ["Lubricant: Squalane with PIP"]);
        assert_eq!(names(&desk, "47"), ["Open bearing_47.ron"]);
        assert_eq!(names(&desk, "interferogram"), ["Go to Contact map"]);
        assert_eq!(names(&desk, "contacts bearing"), ["Open bearing_47.ron"]);
        assert_eq!(names(&desk, "run transient")[0], "Run transient");
        assert!(names(&desk, "no such thing").is_empty());
        assert_eq!(names(&desk, " ").len(), entry::all(&desk).len());
    }

    /// Words of the field, and an entry that each finds first or among the first four.
    const SYNONYMS: [(&str, &str); 28] = [
        ("starvation", "Cavitation and oil supply"),
        ("starved", "Cavitation and oil supply"),
        ("rough", "Surfaces: roughness, film ratio, mixed lubrication"),
        ("lambda", "Surfaces: roughness, film ratio, mixed lubrication"),
        ("film ratio", "Surfaces: roughness, film ratio, mixed lubrication"),
        ("temperature", "Heat"),
        ("thermal", "Heat"),
        ("heat", "Heat"),
        ("report", "Export report as PDF…"),
        ("sheet", "Export report as PDF…"),
        ("pdf", "Export report as PDF…"),
        ("print", "Export report as PDF…"),
        ("stribeck", "Go to Traction"),
        ("friction", "Go to Traction"),
        ("power loss", "Go to Traction"),
        ("grease", "Cavitation and oil supply"),
        ("grease", "Lubricant"),
        ("hertz", "Load, speed and radius"),
        ("bearing", "From a bearing…"),
        ("gear", "From a gear pair…"),
        ("tappet", "From a cam…"),
        ("cavitation", "Cavitation and oil supply"),
        ("film thickness", "Go to Profiles"),
        ("film thickness", "Go to Regimes"),
        ("hamrock", "Go to Regimes"),
        ("worksheet", "Lessons"),
        ("validation", "Go to Accuracy"),
        ("excel", "Export profiles as CSV…"),
    ];

    #[test]
    fn words_of_the_field_find_their_command() {
        let desk = Desk::new(Document::default(), Models::only(None), Store::default());
        for (word, wanted) in SYNONYMS {
            let found = names(&desk, word);
            assert!(found.iter().take(4).any(|name| name == wanted), "{word}: {found:?}");
        }
        for entry in entry::all(&desk) {
            assert!(!entry.synonyms.is_empty() || entry.group == "Recent scene", "{} has no keywords", entry.name);
        }
    }

    #[test]
    fn what_cannot_be_done_says_why_and_comes_last() {
        let desk = Desk::new(Document::default(), Models::only(None), Store::default());
        let entries = entry::all(&desk);
        let found = find(&entries, "contact");
        let at = |name: &str| found.iter().position(|entry| entry.name == name).unwrap();
        assert!(at("Ball") < at("Roller"));
        assert_eq!(found[at("Roller")].refusal, Some("It is already selected"));
        let undo = find(&entries, "undo")[0];
        assert_eq!((undo.name.as_str(), undo.refusal), ("Undo", Some("Nothing has been changed")));
        // Without a picture, no curve can be pinned.
        let why = |name: &str| entries.iter().find(|entry| entry.name == name).unwrap().refusal;
        assert_eq!(why("Pin curve"), Some("There is no picture yet"));
        assert_eq!(why("Remove all pins"), Some("Nothing is pinned"));
        assert_eq!(why("Cancel"), Some("Nothing runs"));
        assert_eq!(why("Run transient"), None);
    }
}
