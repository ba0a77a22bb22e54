//! Entries of the palette: commands, tabs, places of the panels, kinds of contact, lubricants, recent scenes.

use super::places::PLACES;
use crate::app::command::{Command, MENUS};
use crate::app::desk::Desk;
use crate::app::document::{Edit, Shape};
use crate::app::panels::lubricant::GROUP;
use crate::app::panels::operating_point::SHAPE;
use crate::app::tab::Tab;
use crate::scene::named_lubricant::{NAMED, of_laws};
use egui::KeyboardShortcut;
use std::path::Path;

/// Entry of the palette.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Name.
    pub name: String,
    /// Menu or group of the entry.
    pub group: &'static str,
    /// Keywords for the search.
    pub synonyms: String,
    /// Key, if it has one.
    pub shortcut: Option<KeyboardShortcut>,
    /// Reason why the command is not available.
    pub refusal: Option<&'static str>,
    /// Command.
    pub command: Command,
}

impl Entry {
    fn new(group: &'static str, name: String, synonyms: &str, command: Command) -> Self {
        Self { name, group, synonyms: synonyms.to_owned(), shortcut: None, refusal: None, command }
    }

    fn refused_where(self, refused: bool, why: &'static str) -> Self {
        Self { refusal: refused.then_some(why), ..self }
    }
}

/// Returns all entries in their order.
pub fn all(desk: &Desk) -> Vec<Entry> {
    let go_to = |tab: &Tab| {
        let name = format!("Go to {}", tab.title());
        Entry::new("Tab", name, desk.tabs.of(*tab).about().keywords, Command::Go(*tab))
    };
    let tabs = Tab::ALL.iter().map(go_to);
    // The palette itself is open already.
    let commands = MENUS.iter().filter(|item| item.is_there() && item.command != Command::Palette);
    let commands = commands.map(|item| Entry {
        shortcut: item.shortcut(),
        refusal: desk.refusal(&item.command),
        ..Entry::new(item.menu, item.name.to_owned(), item.synonyms, item.command.clone())
    });
    let mut entries: Vec<Entry> = tabs.chain(commands).collect();
    entries.extend(
        PLACES
            .iter()
            .map(|place| Entry::new("Panel", place.name.to_owned(), place.keywords, Command::PointAt(place.control))),
    );
    let present = Shape::of(&desk.document.point);
    entries.extend(Shape::ALL.map(|shape| {
        let edit = Command::Edit(Edit::Shape(shape), SHAPE);
        let entry = Entry::new("Contact", shape.name().to_owned(), shape.synonyms(), edit);
        entry.refused_where(shape == present, "It is already selected")
    }));
    let present = of_laws(&desk.document.lubricant, &desk.document.point).filter(|_| !desk.own_lubricant);
    entries.extend(NAMED.iter().map(|named| {
        let name = format!("Lubricant: {}", named.title);
        let entry = Entry::new("Lubricant", name, named.about, Command::Edit(Edit::Named(named), GROUP));
        entry.refused_where(present == Some(named), "It is already selected")
    }));
    entries.extend(desk.files.recent.iter().map(|path| {
        let name =
            path.file_name().map_or_else(|| path.display().to_string(), |name| name.to_string_lossy().into_owned());
        let folder = path.parent().unwrap_or(Path::new("")).display().to_string();
        Entry::new("Recent scene", format!("Open {name}"), &folder, Command::OpenPath(path.clone()))
    }));
    entries
}
