//! Window of the example scenes by subject. Each scene has its question and a sketch of its result.

use super::question::question;
use super::sketch;
use crate::app::command::Command;
use crate::app::context::Commands;
use crate::app::theme::Palette;
use crate::scene::Scene;
use crate::scene::examples::{self, Example};
use egui::{
    Context, Frame, Key, Margin, Panel, Rect, RichText, Role, ScrollArea, Sense, TextEdit, Ui, WidgetInfo, Window, vec2,
};
use std::sync::{Arc, LazyLock};

/// The manual's page of scenes. Its headings name the folders.
const PAGE: &str = include_str!("../../../assets/manual/scenes.md");
/// Size of a sketch \[points\].
const SKETCH: egui::Vec2 = vec2(84.0, 52.0);

/// Maximum number of expectations that are listed.
const NAMED: usize = 4;

/// Folder of scenes.
struct Subject {
    folder: &'static str,
    title: &'static str,
}

/// Folders in the order of the manual.
static SUBJECTS: LazyLock<Vec<Subject>> = LazyLock::new(|| {
    let headings =
        PAGE.lines().filter_map(|line| line.strip_prefix("## ")?.strip_suffix('`')?.split_once(": `scenes/"));
    headings.map(|(title, folder)| Subject { folder, title }).collect()
});

/// Window of the example scenes.
#[derive(Default)]
pub struct Examples {
    open: bool,
    /// True if it was opened in this frame. The search field then gets the focus.
    fresh: bool,
    search: String,
    /// Folder whose scenes are shown. All folders if `None`.
    folder: Option<&'static str>,
}

impl Examples {
    /// Returns true if the window is open. Escape then closes it.
    pub fn is_open(&self) -> bool {
        self.open
    }

    pub fn open(&mut self) {
        (self.open, self.fresh) = (true, true);
    }

    pub fn close(&mut self) {
        self.open = false;
    }

    /// Draws the window if it is open.
    pub fn ui(&mut self, ctx: &Context, commands: &mut Commands) {
        let mut open = self.open;
        let room = ctx.content_rect();
        let size = vec2((0.85 * room.width()).min(980.0), 0.8 * room.height());
        let place = Rect::from_center_size(room.center(), size);
        let (mut chosen, mut left) = (None, false);
        Window::new("Examples").open(&mut open).default_rect(place).collapsible(false).show(ctx, |ui| {
            Panel::left("subjects").resizable(false).default_size(222.0).show(ui, |ui| self.subjects(ui));
            let label = ui.label("Search");
            let field = TextEdit::singleline(&mut self.search).hint_text("title, question, source, folder");
            let field = ui.add(field.desired_width(f32::INFINITY)).labelled_by(label.id);
            if std::mem::take(&mut self.fresh) {
                field.request_focus();
            }
            left |= field.lost_focus() && ui.input(|i| i.key_pressed(Key::Escape));
            chosen = self.list(ui);
        });
        self.open = open && !left;
        if let Some(example) = chosen {
            self.open = false;
            commands.push(Command::OpenScene(Arc::new(example.scene.clone())));
        }
    }

    fn subjects(&mut self, ui: &mut Ui) {
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            if ui.selectable_label(self.folder.is_none(), format!("All {}", examples::all().len())).clicked() {
                self.folder = None;
            }
            for Subject { folder, title } in SUBJECTS.iter() {
                if ui.selectable_label(self.folder == Some(folder), *title).clicked() {
                    self.folder = Some(folder);
                }
            }
        });
    }

    /// Draws the scenes that match the search. Returns the chosen one.
    fn list(&self, ui: &mut Ui) -> Option<&'static Example> {
        let words: Vec<String> = self.search.to_lowercase().split_whitespace().map(str::to_owned).collect();
        let mut chosen = None;
        ScrollArea::vertical().id_salt(self.folder).auto_shrink(false).show(ui, |ui| {
            let mut none = true;
            for Subject { folder, title } in SUBJECTS.iter() {
                let inside = examples::all().iter().filter(|example| example.folder() == *folder);
                let found: Vec<_> =
                    inside.filter(|example| self.folder.is_none_or(|of| of == example.folder())).collect();
                let found: Vec<_> = found.into_iter().filter(|example| fits(example, title, &words)).collect();
                if let Some(first) = found.first() {
                    none = false;
                    ui.push_id(first.path, |ui| ui.heading(*title));
                }
                for example in found {
                    if card(ui, example) {
                        chosen = Some(example);
                    }
                }
            }
            if none {
                ui.weak("No scene has all these words");
            }
        });
        chosen
    }
}

/// Returns true if the text about a scene contains all words.
fn fits(Example { path, scene }: &Example, subject: &str, words: &[String]) -> bool {
    let text = [&scene.title, &scene.source, *path, subject, &question(scene)].join(" ").to_lowercase();
    words.iter().all(|word| text.contains(word))
}

/// Draws a scene with its sketch, its question and its expectations. Returns true if it is chosen.
fn card(ui: &mut Ui, Example { path, scene }: &Example) -> bool {
    let id = ui.scope_id().with(path);
    let hovered = ui.ctx().read_response(id).is_some_and(|before| before.hovered() || before.has_focus());
    let fill = if hovered { ui.visuals().widgets.hovered.weak_bg_fill } else { ui.visuals().faint_bg_color };
    let frame = Frame::new().inner_margin(Margin::same(6)).corner_radius(4.0).fill(fill);
    let drawn = frame.show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.style_mut().interaction.selectable_labels = false;
        ui.horizontal_top(|ui| {
            let (area, _) = ui.allocate_exact_size(SKETCH, Sense::hover());
            sketch::draw(ui, area, scene);
            ui.vertical(|ui| {
                ui.add(egui::Label::new(RichText::new(&scene.title).strong()).wrap());
                ui.label(question(scene));
                ui.label(RichText::new(expected(scene)).small().color(Palette::of(ui).quiet));
            });
        });
    });
    let response = ui.interact(drawn.response.rect, id, Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("Open {}", scene.title)));
    response.on_hover_text(*path).clicked()
}

/// Returns the expectations of a scene, its source, and whether it takes long.
fn expected(scene: &Scene) -> String {
    let mut names: Vec<&str> = scene.expect.iter().map(|expectation| expectation.name.as_str()).collect();
    names.dedup();
    let more = names.len().saturating_sub(NAMED);
    names.truncate(NAMED);
    let mut parts = vec![match (names.is_empty(), more) {
        (true, _) => "Expects nothing but convergence".to_owned(),
        (false, 0) => format!("Expects {}", names.join(", ")),
        (false, more) => format!("Expects {} and {more} more", names.join(", ")),
    }];
    parts.extend((!scene.source.is_empty()).then(|| scene.source.clone()));
    parts.push(if scene.quick { "Takes seconds" } else { "Takes longer" }.to_owned());
    parts.join("   ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_folder_has_its_title_and_every_scene_its_question() {
        for Example { path, scene } in examples::all() {
            let folder = path.split('/').next().unwrap();
            assert!(SUBJECTS.iter().any(|subject| subject.folder == folder), "{path}");
            let question = question(scene);
            assert!(question.ends_with('?') && question.len() < 160, "{path}: {question}");
            assert!(!scene.title.is_empty() && !sketch::marks(scene).is_empty(), "{path}");
        }
        assert!(
            SUBJECTS.iter().all(|subject| examples::all().iter().any(|example| example.folder() == subject.folder))
        );
    }

    #[test]
    fn search_matches_title_source_and_question() {
        let found = |words: &str| {
            let words: Vec<String> = words.split(' ').map(str::to_owned).collect();
            examples::all().iter().filter(|example| fits(example, "", &words)).map(|example| example.path).collect()
        };
        let of_table: Vec<&str> = found("table 2.1");
        assert!(of_table.contains(&"line/table_2_1.ron"), "{of_table:?}");
        let of_question: Vec<&str> = found("random contacts fail");
        assert!(of_question.contains(&"reduced/random_test_embedded.ron"), "{of_question:?}");
        assert!(found("table 2.1 zebra").is_empty());
    }
}
