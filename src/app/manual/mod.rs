//! Manual: a window with the pages of `assets/manual`.

mod pictures;
mod plots;

use self::pictures::Pictures;
use crate::engine::results::PAGE;
use crate::engine::validation;
use crate::scene::examples;
use egui::{Context, Frame, Label, Panel, Rect, RichText, ScrollArea, TextStyle, Ui, Window, vec2};
use egui_commonmark::{CommonMarkCache, CommonMarkViewer};
use std::path::Path;
use std::sync::LazyLock;

/// Page of the manual: its file name, which links use, and the function that returns its text.
struct Page {
    file: &'static str,
    text: fn() -> &'static str,
}

impl Page {
    /// Returns the first heading.
    fn title(&self) -> &'static str {
        (self.text)().lines().next().unwrap_or_default().trim_start_matches("# ")
    }
}

macro_rules! pages {
    ($($file:literal),* $(,)?) => {
        [$(Page { file: $file, text: || include_str!(concat!("../../../assets/manual/", $file)) }),*]
    };
}

/// Page with the speed table.
const SPEED: &str = include_str!("../../../assets/manual/speed.md");

/// Page that is generated from the results of the scenes.
const VALIDATION: Page = Page {
    file: "validation.md",
    text: || {
        static TEXT: LazyLock<String> = LazyLock::new(|| {
            let results = examples::text_of(&Path::new(examples::ROOT).join(PAGE));
            validation::page(results.unwrap_or_default(), SPEED)
        });
        &TEXT
    },
};

/// Pages of `assets/manual` in the order of the list. The first page is the table of contents.
const WRITTEN: &[Page] = &pages![
    "start.md",
    "first_contact.md",
    "tour.md",
    "engineering.md",
    "machines.md",
    "friction.md",
    "heat.md",
    "starvation.md",
    "rough.md",
    "transient.md",
    "waves.md",
    "trust.md",
    "export.md",
    "keyboard.md",
    "limits.md",
    "command_line.md",
    "load_cases.md",
    "measured.md",
    "scenes.md",
    "campaigns.md",
    "python.md",
    "fmu.md",
    "web.md",
    "models.md",
    "training.md",
    "results.md",
    "files.md",
    "arrays.md",
    "model_file.md",
    "physics.md",
    "thermal_theory.md",
    "numerics.md",
    "reduction.md",
    "transient_theory.md",
    "accuracy.md",
    "speed.md",
    "misprints.md",
];

/// Iterates over all pages.
fn pages() -> impl Iterator<Item = &'static Page> {
    WRITTEN.iter().chain(std::iter::once(&VALIDATION))
}

/// Maximum line width \[points\].
const READABLE_WIDTH: f32 = 780.0;

/// Window of the manual.
#[derive(Default)]
pub struct Manual {
    open: bool,
    page: usize,
    cache: CommonMarkCache,
    pictures: Pictures,
}

impl Manual {
    /// Returns true if the window is open. Escape then closes it.
    pub fn is_open(&self) -> bool {
        self.open
    }

    /// Opens the window at the page of a file.
    pub fn open_at(&mut self, file: &str) {
        self.open = true;
        self.page = pages().position(|page| page.file == file).unwrap_or_default();
    }

    pub fn close(&mut self) {
        self.open = false;
    }

    /// Draws the window if it is open.
    pub fn ui(&mut self, ctx: &Context) {
        let mut open = self.open;
        let room = ctx.content_rect();
        let size = vec2((0.85 * room.width()).min(1050.0), 0.8 * room.height());
        let place = Rect::from_center_size(room.center(), size);
        Window::new("Manual").open(&mut open).default_rect(place).collapsible(false).show(ctx, |ui| {
            Panel::left("manual pages").resizable(false).default_size(178.0).show(ui, |ui| self.contents(ui));
            self.text(ui);
        });
        self.open = open;
    }

    fn contents(&mut self, ui: &mut Ui) {
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            for (k, page) in pages().enumerate() {
                if ui.selectable_label(self.page == k, page.title()).clicked() {
                    self.page = k;
                }
            }
        });
    }

    fn text(&mut self, ui: &mut Ui) {
        let Some(page) = pages().nth(self.page) else { return };
        for page in pages() {
            self.cache.add_link_hook(page.file);
        }
        ScrollArea::vertical().id_salt(page.file).auto_shrink(false).show(ui, |ui| {
            Frame::NONE.inner_margin(8.0).show(ui, |ui| {
                ui.set_max_width(ui.available_width().min(READABLE_WIDTH));
                // The rows are as high as their text, so that links and other words share a baseline.
                ui.spacing_mut().interact_size.y = ui.text_style_height(&TextStyle::Body);
                // Code fences are at the beginning of a line, so every second part is a code block.
                for (k, part) in (page.text)().split("\n```").enumerate() {
                    ui.push_id(k, |ui| if k % 2 == 0 { self.prose(ui, part) } else { code(ui, part) });
                }
            });
        });
    }

    /// Draws text with the pictures between its paragraphs.
    fn prose(&mut self, ui: &mut Ui, text: &str) {
        for (k, part) in text.split("\n![").enumerate() {
            let picture = if k == 0 { None } else { pictures::reference(part) };
            let text = picture.as_ref().map_or(part, |picture| picture.rest);
            if let Some(picture) = picture {
                self.pictures.ui(ui, &picture);
            }
            ui.push_id(k, |ui| CommonMarkViewer::new().show(ui, &mut self.cache, text));
        }
        let followed = |page: &Page| self.cache.get_link_hook(page.file) == Some(true);
        if let Some(k) = pages().position(followed) {
            self.page = k;
        }
    }
}

/// Draws a code block. The first line holds the name of its language. The code block of the Markdown widget is not
/// used, because the symbol of its button is missing in the fonts.
fn code(ui: &mut Ui, text: &str) {
    let text = text.split_once('\n').map_or(text, |(_, lines)| lines);
    Frame::group(ui.style()).fill(ui.visuals().code_bg_color).show(ui, |ui| {
        ScrollArea::horizontal().show(ui, |ui| {
            ui.add(Label::new(RichText::new(text).monospace()).extend().selectable(true));
        });
        if ui.small_button("Copy").clicked() {
            ui.ctx().copy_text(text.to_owned());
        }
    });
}

/// Returns the texts of all pages.
#[cfg(test)]
pub fn texts() -> impl Iterator<Item = &'static str> {
    pages().map(|page| (page.text)())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::Explorer;
    use crate::app::command::MENUS;
    use crate::app::tab::Tab;
    use crate::app::tabs::View as _;
    use crate::app::tabs::all::Tabs;
    use egui::accesskit::Role;
    use egui::{Key, ModifierNames, Modifiers};
    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable as _;
    use std::collections::BTreeSet;

    fn open() -> Harness<'static, Explorer> {
        let explorer = Explorer::new(None).without_system_dialogs();
        let builder = Harness::builder().with_size([1280.0, 800.0]);
        let mut harness = builder.build_ui_state(|ui, app: &mut Explorer| app.ui(ui), explorer);
        press(&mut harness, Key::F1);
        harness
    }

    fn press(harness: &mut Harness<'_, Explorer>, key: Key) {
        harness.key_press_modifiers(Modifiers::NONE, key);
        harness.run_steps(3);
    }

    /// Returns true if the page text, not the list of pages, contains this wording.
    fn reads(harness: &Harness<'_, Explorer>, wording: &str) -> bool {
        harness.query_all_by_role_and_label(Role::Label, wording).next().is_some()
    }

    #[test]
    fn f1_opens_it_every_page_shows_its_title_and_escape_closes_it() {
        let mut harness = open();
        for page in pages() {
            let entries = harness.query_all_by_role_and_label(Role::Button, page.title());
            let entry = entries.min_by(|a, b| a.rect().left().total_cmp(&b.rect().left())).unwrap();
            // The last entries lie below the visible part of the list.
            entry.click_accesskit();
            harness.run_steps(3);
            assert!(reads(&harness, page.title()), "{}", page.file);
        }
        press(&mut harness, Key::Escape);
        assert!(!reads(&harness, VALIDATION.title()), "Escape closes it");
        press(&mut harness, Key::F1);
        let tour = pages().find(|page| page.file == Tabs::default().profiles.about().page).unwrap();
        assert!(reads(&harness, tour.title()), "it opens at the page of the tab in front");
        press(&mut harness, Key::F1);
        assert!(!reads(&harness, tour.title()), "a second F1 closes it");
    }

    #[test]
    fn every_tab_has_a_page() {
        let tabs = Tabs::default();
        assert!(Tab::ALL.iter().all(|tab| pages().any(|page| page.file == tabs.of(*tab).about().page)));
    }

    #[test]
    fn a_link_leads_to_its_page() {
        let mut harness = open();
        harness.query_all_by_role_and_label(Role::Button, WRITTEN[0].title()).next().unwrap().click();
        harness.run_steps(3);
        harness.query_all_by_role_and_label(Role::Link, "Physics").next().unwrap().click();
        harness.run_steps(3);
        assert!(reads(&harness, "Physics"));
    }

    #[test]
    fn every_file_of_the_manual_is_a_page() {
        let folder = std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/manual")).unwrap();
        let files: BTreeSet<String> =
            folder.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
        let files: BTreeSet<String> = files.into_iter().filter(|file| file != "pictures").collect();
        let pages: BTreeSet<String> = WRITTEN.iter().map(|page| page.file.to_owned()).collect();
        assert_eq!(files, pages);
        assert_eq!(pages.len(), WRITTEN.len());
    }

    #[test]
    fn pages_have_titles_of_their_own() {
        let titles: BTreeSet<&str> = pages().map(Page::title).collect();
        assert_eq!(titles.len(), pages().count());
        for page in pages() {
            assert!((page.text)().starts_with("# ") && page.title().len() > 3, "{}", page.file);
        }
    }

    #[test]
    fn the_page_of_keys_lists_every_key() {
        let page = pages().find(|page| page.file == "keyboard.md").unwrap();
        for item in MENUS {
            let Some(shortcut) = item.shortcut() else { continue };
            let (name, key) = (item.name.trim_end_matches('…'), shortcut.format(&ModifierNames::NAMES, false));
            let row = format!("| {name} | {key} |");
            assert!((page.text)().contains(&row), "{} lacks: {row}", page.file);
        }
    }
}
