//! Dialog for figures: size, theme, title, caption, and export.

use super::settings::{FigureSettings, SIZES};
use super::sitting::with_sitting;
use crate::app::controls::{message_ui, named, standing_ui};
use crate::app::purpose::{Purpose, Written};
use crate::app::refusal::Refusal;
use crate::app::tab::Tab;
use crate::app::units::Units;
use crate::app::wake::wake;
use crate::engine::Store;
use crate::engine::job::{Background, Ending, Job, Reporter, Standing, Task};
use crate::scene::drawing::{DPI, Drawing, Pixels};
use crate::scene::{Chart, Page, drawn};
use egui::{
    Color32, ColorImage, ComboBox, Context, DragValue, Id, Modal, TextEdit, TextureHandle, TextureOptions, Theme,
    ThemePreference, Ui, vec2,
};
use serde::{Deserialize, Serialize};

/// Widths of a column and of a page of journals \[mm\].
const WIDTHS: [f64; 2] = [85.0, 170.0];
/// Space for the preview on the screen.
const PREVIEW: egui::Vec2 = vec2(430.0, 360.0);
/// Space for the settings.
const SETTINGS: f32 = 356.0;

/// Choice of the plots to export.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Choice {
    One(usize),
    /// All plots of a tab, one below the other.
    All(Tab),
}

/// State of the dialog.
struct Dialog {
    charts: Vec<(Tab, Chart)>,
    choice: Choice,
    title: String,
    caption: String,
    preview: Option<(Vec<Chart>, Page, Result<TextureHandle, Refusal>)>,
}

/// Requested figures.
#[derive(Default)]
pub struct Figures {
    /// Set if plots shall be recorded in the next frame: those of one tab, or of all tabs.
    wanted: Option<Option<Tab>>,
    /// True if plots are recorded in this frame.
    noting: bool,
    /// Size, resolution, theme and units.
    pub settings: FigureSettings,
    dialog: Option<Dialog>,
    /// Image that is being rendered.
    work: Background<Image>,
}

/// Image of a figure.
#[derive(Serialize, Deserialize)]
pub enum Image {
    File(Vec<u8>),
    Clipboard(Pixels),
}

/// Drawing to be rendered as an image. A large one takes seconds.
#[derive(Serialize, Deserialize)]
pub struct ToImage {
    drawing: Drawing,
    dpi: f64,
    leaves: Leaves,
}

/// Export format of a figure.
#[derive(Clone, Copy, Serialize, Deserialize)]
enum Leaves {
    Svg,
    Png,
    Data,
    Copy,
}

impl Figures {
    /// Opens the dialog with the plots of one tab, or of all visible tabs, in these units.
    pub fn ask(&mut self, tab: Option<Tab>, units: Units) {
        self.settings.units = units;
        self.wanted = Some(tab);
        self.dialog = None;
    }

    /// Returns the progress of the image.
    pub fn standing(&self) -> Option<Standing> {
        self.work.standing()
    }

    /// Stops rendering the image.
    pub fn stop(&mut self) {
        self.work = Background::default();
    }

    /// Returns true if the dialog is open or about to open.
    pub fn asks(&self) -> bool {
        self.dialog.is_some() || self.wanted.is_some()
    }

    /// Returns the units of plots in this frame if a figure is being recorded.
    pub fn units(&self) -> Option<Units> {
        self.noting.then_some(self.settings.units)
    }

    /// Starts a frame. A frame that is recorded uses the theme of the figure.
    pub fn begin(&mut self, ui: &mut Ui) {
        self.noting = self.wanted.is_some();
        let ctx = ui.ctx().clone();
        with_sitting(&ctx, |sitting| {
            sitting.on = self.noting;
            sitting.charts.clear();
        });
        if self.noting {
            let theme = if self.settings.dark { Theme::Dark } else { Theme::Light };
            ctx.set_theme(theme);
            ui.set_style(ctx.style_of(theme));
        }
    }

    /// Ends a frame. Recorded plots go to the dialog, and that frame is discarded. Then draws the dialog. Returns a
    /// file to write. `caption` returns the caption of a tab's plots, `theme` is that of the screen.
    pub fn ui(&mut self, ctx: &Context, theme: ThemePreference, caption: impl Fn(Tab) -> String) -> Option<Purpose> {
        if std::mem::take(&mut self.noting) {
            let of = self.wanted.take().flatten();
            let charts = with_sitting(ctx, |sitting| {
                sitting.on = false;
                std::mem::take(&mut sitting.charts)
            });
            ctx.set_theme(theme);
            self.noted(charts.into_iter().filter(|(tab, _)| of.is_none_or(|of| of == *tab)).collect(), &caption);
            ctx.request_discard("a figure was drawn");
            ctx.request_repaint();
            return None;
        }
        let made = self.received(ctx);
        let mut dialog = self.dialog.take()?;
        if made.is_some() {
            return made;
        }
        let before = (self.settings.dark, self.settings.units);
        let mut leaves = None;
        let response = Modal::new(Id::unique("export a figure")).show(ctx, |ui| {
            ui.heading("Export a figure");
            if dialog.charts.is_empty() {
                ui.label("No plot is on the screen.");
                return ui.button("Cancel").clicked();
            }
            let close = ui.horizontal_top(|ui| {
                let close = ui.vertical(|ui| {
                    ui.set_width(SETTINGS);
                    dialog.settings(ui, &mut self.settings, &caption);
                    ui.add_space(6.0);
                    let close = buttons(ui, &dialog, &mut leaves);
                    standing_ui(ui, self.work.standing(), "Progress of the image");
                    if let Some(why) = &self.work.message {
                        message_ui(ui, why);
                    }
                    close
                });
                dialog.preview(ui, &self.settings);
                close.inner
            });
            close.inner
        });
        let purpose = leaves.and_then(|leaves| match leaves {
            Leaves::Svg | Leaves::Data => dialog.text(&self.settings, leaves),
            Leaves::Png | Leaves::Copy => {
                let task = ToImage { drawing: dialog.drawing(&self.settings), dpi: self.settings.dpi, leaves };
                self.work.run(Job::of(ToImage::STAGE, wake(ctx), &Store::default(), task));
                None
            }
        });
        if response.inner || response.should_close() {
            self.stop();
        }
        if !response.inner && !response.should_close() && purpose.is_none() {
            if (self.settings.dark, self.settings.units) != before {
                self.wanted = Some(None);
                ctx.request_repaint();
            }
            self.dialog = Some(dialog);
        }
        purpose
    }

    /// Receives the rendered image. Returns a file to write, or copies the image to the clipboard.
    fn received(&mut self, ctx: &Context) -> Option<Purpose> {
        let mut made = None;
        self.work.receive(|image| made = Some(image));
        match made? {
            Image::File(file) => Some(Purpose::Write(Written::Png, file.into())),
            Image::Clipboard(image) => {
                ctx.copy_image(color_image(&image));
                None
            }
        }
    }

    /// Receives recorded plots. Keeps the choice and the texts of the dialog.
    fn noted(&mut self, charts: Vec<(Tab, Chart)>, caption: &impl Fn(Tab) -> String) {
        let known = self.dialog.take().filter(|_| !charts.is_empty());
        self.dialog = Some(match known {
            Some(dialog) => {
                let found = |k: usize| {
                    let (tab, chart) = dialog.charts.get(k)?;
                    charts.iter().position(|(other, same)| other == tab && same.title == chart.title)
                };
                let choice = match dialog.choice {
                    Choice::One(k) => Choice::One(found(k).unwrap_or(0)),
                    Choice::All(tab) => Choice::All(tab),
                };
                Dialog { charts, choice, ..dialog }
            }
            None => {
                let first = charts.first();
                let title = first.map_or_else(String::new, |(_, chart)| chart.title.clone());
                let caption = first.map_or_else(String::new, |(tab, _)| caption(*tab));
                Dialog { charts, choice: Choice::One(0), title, caption, preview: None }
            }
        });
    }
}

fn buttons(ui: &mut Ui, dialog: &Dialog, leaves: &mut Option<Leaves>) -> bool {
    ui.horizontal_wrapped(|ui| {
        if ui.button("SVG…").on_hover_text("A drawing, sharp at any size").clicked() {
            *leaves = Some(Leaves::Svg);
        }
        if ui.button("PNG…").on_hover_text("An image with the resolution above").clicked() {
            *leaves = Some(Leaves::Png);
        }
        if ui.button("Copy").on_hover_text("The same image onto the clipboard").clicked() {
            *leaves = Some(Leaves::Copy);
        }
        let one = matches!(dialog.choice, Choice::One(_));
        let tip = "The numbers of its lines and marks as a table";
        if ui.add_enabled(one, egui::Button::new("Data as CSV…")).on_hover_text(tip).clicked() {
            *leaves = Some(Leaves::Data);
        }
        ui.button("Cancel").clicked()
    })
    .inner
}

impl Dialog {
    /// Returns the charts to export: the chosen plot with its title, or all plots of a tab with their own titles.
    fn chosen(&self) -> Vec<Chart> {
        match self.choice {
            Choice::One(k) => {
                let chart = self.charts.get(k).map(|(_, chart)| Chart { title: self.title.clone(), ..chart.clone() });
                chart.into_iter().collect()
            }
            Choice::All(wanted) => {
                self.charts.iter().filter(|(tab, _)| *tab == wanted).map(|(_, chart)| chart.clone()).collect()
            }
        }
    }

    fn page(&self, settings: &FigureSettings) -> Page {
        let FigureSettings { width_mm, height_mm, dark, .. } = *settings;
        Page { width_mm, height_mm, dark, caption: self.caption.clone() }
    }

    fn drawing(&self, settings: &FigureSettings) -> Drawing {
        drawn(&self.chosen(), &self.page(settings))
    }

    fn name(&self, choice: Choice) -> String {
        match choice {
            Choice::One(k) => self.charts.get(k).map_or_else(String::new, |(_, chart)| chart.title.clone()),
            Choice::All(tab) => format!("All plots of {}", tab.title()),
        }
    }

    fn settings(&mut self, ui: &mut Ui, settings: &mut FigureSettings, caption: &impl Fn(Tab) -> String) {
        let mut tabs: Vec<Tab> = self.charts.iter().map(|(tab, _)| *tab).collect();
        tabs.dedup();
        let several = |tab: &Tab| self.charts.iter().filter(|(other, _)| other == tab).count() > 1;
        let choices: Vec<Choice> =
            (0..self.charts.len()).map(Choice::One).chain(tabs.into_iter().filter(several).map(Choice::All)).collect();
        let before = self.choice;
        let label = ui.label("Plot");
        let mut choice = before;
        ComboBox::from_id_salt("plot of the figure")
            .width(SETTINGS - 12.0)
            .selected_text(self.name(before))
            .show_ui(ui, |ui| {
                for other in choices {
                    ui.selectable_value(&mut choice, other, self.name(other));
                }
            })
            .response
            .labelled_by(label.id);
        if choice != before {
            let tab = |choice: Choice| match choice {
                Choice::One(k) => self.charts.get(k).map(|(tab, _)| *tab),
                Choice::All(tab) => Some(tab),
            };
            if tab(choice) != tab(before) {
                self.caption = tab(choice).map_or_else(String::new, caption);
            }
            self.choice = choice;
            self.title = self.name(choice);
        }
        egui::Grid::new("settings of the figure").num_columns(2).show(ui, |ui| {
            ui.label("Width");
            ui.horizontal(|ui| {
                size(ui, &mut settings.width_mm, "Width in mm");
                for width in WIDTHS {
                    ui.selectable_value(&mut settings.width_mm, width, format!("{width}"));
                }
            });
            ui.end_row();
            ui.label("Height");
            size(ui, &mut settings.height_mm, "Height in mm");
            ui.end_row();
            ui.label("Resolution");
            let dpi = DragValue::new(&mut settings.dpi).range(DPI.0..=DPI.1).suffix(" dpi");
            let dpi = ui.add(dpi).on_hover_text("Resolution of a PNG; an SVG has none");
            named(ui, dpi, "Resolution in dpi");
            ui.end_row();
            ui.label("Theme");
            ui.horizontal(|ui| {
                ui.selectable_value(&mut settings.dark, false, "Light").on_hover_text("For paper");
                ui.selectable_value(&mut settings.dark, true, "Dark").on_hover_text("For a dark slide");
            });
            ui.end_row();
            ui.label("Units");
            ui.horizontal(|ui| {
                ui.selectable_value(&mut settings.units, Units::Dimensionless, "Dimensionless");
                ui.selectable_value(&mut settings.units, Units::Dimensional, "With units");
            });
            ui.end_row();
        });
        let label = ui.label("Title");
        let one = matches!(self.choice, Choice::One(_));
        ui.add_enabled(one, TextEdit::singleline(&mut self.title).desired_width(f32::INFINITY)).labelled_by(label.id);
        let label = ui.label("Caption");
        ui.add(TextEdit::multiline(&mut self.caption).desired_rows(4).desired_width(f32::INFINITY))
            .labelled_by(label.id);
    }

    /// Draws the preview of the figure as large as possible.
    fn preview(&mut self, ui: &mut Ui, settings: &FigureSettings) {
        let (chosen, page) = (self.chosen(), self.page(settings));
        let fits = self.preview.as_ref().is_some_and(|(of, on, _)| *of == chosen && *on == page);
        if !fits {
            let drawing = self.drawing(settings);
            let [wide, high] = drawing.size();
            let scale = (f64::from(PREVIEW.x) / wide).min(f64::from(PREVIEW.y) / high);
            let dpi = 72.0 * scale * f64::from(ui.ctx().pixels_per_point());
            let texture = drawing.to_pixels(dpi).map(|pixels| {
                ui.ctx().load_texture("preview of a figure", color_image(&pixels), TextureOptions::LINEAR)
            });
            self.preview = Some((chosen, page, texture.map_err(|why| Refusal::new(why.to_string()))));
        }
        let (rect, response) = ui.allocate_exact_size(PREVIEW, egui::Sense::hover());
        named(ui, response, "Preview of the figure");
        match &self.preview {
            Some((_, _, Ok(texture))) => {
                let size = texture.size_vec2() / ui.ctx().pixels_per_point();
                let place = egui::Rect::from_center_size(rect.center(), size);
                let whole = egui::Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
                ui.painter().image(texture.id(), place, whole, Color32::WHITE);
            }
            Some((_, _, Err(why))) => message_ui(ui, why),
            None => {}
        }
    }

    /// Returns a file of text: SVG or CSV. `None` for formats that need pixels.
    fn text(&self, settings: &FigureSettings, leaves: Leaves) -> Option<Purpose> {
        if matches!(leaves, Leaves::Svg) {
            return Some(Purpose::Write(Written::Svg, self.drawing(settings).to_svg().into_bytes().into()));
        }
        let chart = self.chosen().into_iter().next()?;
        let text = format!("# {}\n# {}\n{}", chart.title, self.caption, chart.to_table().to_csv());
        Some(Purpose::Write(Written::Table, text.into_bytes().into()))
    }
}

impl ToImage {
    const STAGE: &str = "Drawing the figure";
}

impl Task for ToImage {
    const KIND: &'static str = "figure";
    const LANE: usize = 1;
    type Message = Image;

    fn run(self, _store: &Store, reporter: &Reporter<Image>) -> Ending {
        let Self { drawing, dpi, leaves } = self;
        reporter.stage(Self::STAGE, 0, 2);
        let drawn = || reporter.stage(Self::STAGE, 1, 2);
        let image = match leaves {
            Leaves::Copy => drawing.to_pixels(dpi).map(Image::Clipboard),
            _ => drawing.to_png(dpi, drawn).map(Image::File),
        };
        reporter.send(image.map_err(|why| why.to_string())?);
        Ok(())
    }
}

fn size(ui: &mut Ui, mm: &mut f64, name: &str) {
    let response = ui.add(DragValue::new(mm).range(SIZES.0..=SIZES.1).max_decimals(1).suffix(" mm"));
    named(ui, response, name);
}

fn color_image(pixels: &Pixels) -> ColorImage {
    let color = |rgb: &[u8]| match rgb {
        [r, g, b] => Color32::from_rgb(*r, *g, *b),
        _ => Color32::TRANSPARENT,
    };
    ColorImage::new([pixels.width, pixels.height()], pixels.rgb.chunks_exact(3).map(color).collect())
}
