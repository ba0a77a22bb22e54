//! Command palette: all commands, found by typing part of their name.

use super::entry::{self, Entry};
use super::search;
use crate::app::command::Command;
use crate::app::controls::{described, named};
use crate::app::desk::Desk;
use crate::app::theme::Palette as Colors;
use egui::accesskit::Role;
use egui::text::{LayoutJob, TextWrapping};
use egui::{
    Align2, Context, FontId, Id, Key, Modal, Modifiers, Response, ScrollArea, Sense, TextEdit, Ui, WidgetInfo, pos2,
    vec2,
};

/// Width of the palette, space above it, height of a line, and number of visible lines.
const WIDTH: f32 = 560.0;
const TOP: f32 = 44.0;
const LINE: f32 = 26.0;
const LINES: f32 = 13.0;
/// Space for a key at the right end of a line.
const KEY_WIDTH: f32 = 96.0;
/// Number of lines that Page up and Page down move by.
const PAGE: isize = 10;
/// Number of frames after closing the palette until the previous widget gets the focus back.
const RELEASE: u8 = 2;

/// Command palette.
#[derive(Default)]
pub struct Palette {
    open: Option<Open>,
    /// Widget that had the focus, and the remaining frames until it gets it back.
    returns: Option<(Id, u8)>,
}

/// State of an open palette.
struct Open {
    query: String,
    chosen: usize,
    former_focus: Option<Id>,
    fresh: bool,
}

impl Palette {
    /// Returns true if it is open. It then receives the keys.
    pub fn is_open(&self) -> bool {
        self.open.is_some()
    }

    pub fn open(&mut self, ctx: &Context) {
        let former_focus = ctx.memory(|memory| memory.focused());
        self.open = Some(Open { query: String::new(), chosen: 0, former_focus, fresh: true });
    }

    /// Starts a frame. After closing, gives the focus back unless another widget has taken it.
    pub fn begin(&mut self, ctx: &Context) {
        let Some((id, frames)) = &mut self.returns else { return };
        if *frames > 0 {
            *frames -= 1;
            ctx.request_repaint();
            return;
        }
        let free = ctx.memory(|memory| memory.focused().is_none());
        if free {
            ctx.memory_mut(|memory| memory.request_focus(*id));
        }
        self.returns = None;
    }

    /// Draws the palette if it is open. Returns the chosen command.
    pub fn ui(&mut self, ctx: &Context, desk: &Desk) -> Option<Command> {
        let open = self.open.as_mut()?;
        let entries = entry::all(desk);
        let area = Modal::default_area(Id::unique("palette")).anchor(Align2::CENTER_TOP, vec2(0.0, TOP));
        let mut action = None;
        let response = Modal::new(Id::unique("palette")).area(area).show(ctx, |ui| {
            ui.set_width(WIDTH.min(ui.ctx().content_rect().width() - 40.0));
            action = open.content(ui, &entries);
        });
        let again =
            Command::Palette.shortcut().is_some_and(|shortcut| ctx.input_mut(|i| i.consume_shortcut(&shortcut)));
        if action.is_some() || again || response.should_close() {
            self.returns = open.former_focus.map(|id| (id, RELEASE));
            self.open = None;
            ctx.request_repaint();
        }
        action
    }
}

impl Open {
    fn content(&mut self, ui: &mut Ui, entries: &[Entry]) -> Option<Command> {
        let field = Id::unique("palette query");
        let typing = ui.memory(|memory| memory.has_focus(field));
        let (moved, entered) = if typing { keys(ui) } else { (0, false) };
        let edit = TextEdit::singleline(&mut self.query).id(field).desired_width(f32::INFINITY);
        let edit = ui.add(edit.hint_text("A command, tab, contact, lubricant or recent scene"));
        if std::mem::take(&mut self.fresh) {
            edit.request_focus();
        }
        if edit.changed() {
            self.chosen = 0;
        }
        let edit = named(ui, edit, "Find a command");
        let found = search::find(entries, &self.query);
        if found.is_empty() {
            ui.weak("No command has this name.");
            return None;
        }
        // Arrow keys wrap around at both ends, page keys stop there.
        let (count, wanted) = (found.len() as isize, self.chosen as isize + moved);
        let wanted = if moved.abs() == 1 { wanted.rem_euclid(count) } else { wanted.clamp(0, count - 1) };
        self.chosen = wanted as usize;
        let mut clicked = None;
        let height = (LINES * LINE).min(ui.ctx().content_rect().height() - TOP - 80.0);
        // The area remembers its size. A previous short list must not limit a longer one.
        let list = ScrollArea::vertical().max_height(height).min_scrolled_height(height);
        let mut list = list.auto_shrink([false, true]);
        if edit.changed() {
            list = list.vertical_scroll_offset(0.0);
        }
        list.show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            for (k, entry) in found.iter().enumerate() {
                let chosen = k == self.chosen;
                let response = line(ui, entry, chosen);
                if chosen && moved != 0 {
                    response.scroll_to_me(None);
                }
                if chosen {
                    // Let a screen reader follow the arrow keys while the field keeps the focus.
                    ui.ctx()
                        .accesskit_node_builder(field, |node| node.set_active_descendant(response.id.accesskit_id()));
                }
                if response.clicked() {
                    clicked = Some(*entry);
                }
            }
        });
        let entered = found.get(self.chosen).copied().filter(|_| entered);
        clicked.or(entered).filter(|entry| entry.refusal.is_none()).map(|entry| entry.command.clone())
    }
}

/// Returns the number of lines that the selection moves by, and whether it is confirmed.
fn keys(ui: &mut Ui) -> (isize, bool) {
    ui.input_mut(|i| {
        let mut pressed = |key| i.consume_key(Modifiers::NONE, key);
        let steps = [(Key::ArrowDown, 1), (Key::ArrowUp, -1), (Key::PageDown, PAGE), (Key::PageUp, -PAGE)];
        let moved = steps.into_iter().find_map(|(key, by)| pressed(key).then_some(by));
        (moved.unwrap_or(0), pressed(Key::Enter))
    })
}

/// Draws an entry: its name, its group or the reason why it is not available, and its key.
fn line(ui: &mut Ui, entry: &Entry, chosen: bool) -> Response {
    let enabled = entry.refusal.is_none();
    let colors = Colors::of(ui);
    let sense = if enabled { Sense::click() } else { Sense::hover() };
    let (area, response) = ui.allocate_exact_size(vec2(ui.available_width(), LINE), sense);
    response.widget_info(|| WidgetInfo::labeled(Role::ListBoxOption, enabled, &entry.name));
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_selected(chosen));
    if ui.is_rect_visible(area) {
        if chosen {
            ui.painter().rect_filled(area, 4.0, ui.visuals().selection.bg_fill);
        } else if enabled && response.hovered() {
            ui.painter().rect_filled(area, 4.0, ui.visuals().widgets.hovered.weak_bg_fill);
        }
        let ink = if enabled { colors.text } else { colors.quiet };
        let middle = |x: f32| pos2(x, area.center().y);
        let name = ui.painter().text(
            middle(area.left() + 10.0),
            Align2::LEFT_CENTER,
            &entry.name,
            FontId::proportional(13.5),
            ink,
        );
        let right = area.right() - KEY_WIDTH;
        if let Some(shortcut) = entry.shortcut {
            let key = ui.ctx().format_shortcut(&shortcut);
            ui.painter().text(
                middle(area.right() - 10.0),
                Align2::RIGHT_CENTER,
                key,
                FontId::proportional(12.0),
                colors.quiet,
            );
        }
        let mut detail = LayoutJob::simple_singleline(
            entry.refusal.unwrap_or(entry.group).to_owned(),
            FontId::proportional(12.0),
            colors.quiet,
        );
        detail.wrap = TextWrapping::truncate_at_width((right - name.right() - 16.0).max(0.0));
        let detail = ui.painter().layout_job(detail);
        let place = pos2(right - detail.size().x, area.center().y - 0.5 * detail.size().y);
        ui.painter().galley(place, detail, colors.quiet);
    }
    match (entry.refusal, &entry.command) {
        (Some(why), _) => described(ui, response, why).on_hover_text(why),
        (None, Command::OpenPath(path)) => response.on_hover_text(path.display().to_string()),
        (None, _) => response,
    }
}
