//! Any plot as a picture: every plot that is on the screen offers itself by its name; one that is asked for leaves as a
//! drawing (SVG) or as an image (PNG), with its name and the contact's parameters above it.

mod subject;
mod svg;
mod texture;

pub use subject::Subject;
pub use texture::Texture;

use super::controls::named;
use super::png;
use super::purpose::{Purpose, Written};
use egui::{ColorImage, Context, FontId, Id, LayerId, Modal, Order, Rect, Ui, ViewportCommand, pos2, vec2};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

/// Names of axes and numbers at their ends stand out of a plot's rectangle by as much.
const OVERHANG: egui::Vec2 = vec2(8.0, 2.0);
/// Sizes of the title and of the parameters above a picture.
const TITLE: f32 = 15.0;
const PARAMETERS: f32 = 10.5;
/// Frames after which whatever was open over the plot is gone.
const SETTLED: u8 = 2;
/// Frames after which a screenshot that was asked for does not come any more.
const PATIENCE: u8 = 200;

/// A plot on the screen.
#[derive(Clone, Debug, PartialEq)]
struct Offered {
    name: String,
    /// With its axes.
    rect: Rect,
    layer: LayerId,
    subject: Subject,
}

/// The plots of this frame and of the one before.
#[derive(Clone, Default)]
struct Offers {
    now: Vec<Offered>,
    last: Vec<Offered>,
}

/// What a picture is made as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Svg,
    Png,
}

/// A picture that was asked for.
struct Wanted {
    name: String,
    format: Format,
    frames: u8,
    screenshot: Option<(Receiver<Arc<ColorImage>>, Rect)>,
    /// The plot with the lines above it.
    whole: Rect,
}

impl Wanted {
    fn new(name: &str, format: Format) -> Self {
        Self { name: name.to_owned(), format, frames: 0, screenshot: None, whole: Rect::NOTHING }
    }
}

/// Pictures that are asked for.
#[derive(Default)]
pub struct Figures {
    asks: bool,
    wanted: Option<Wanted>,
}

impl Figures {
    /// Exports a plot that is on the screen as a drawing.
    pub fn draw(&mut self, name: &str) {
        self.wanted = Some(Wanted::new(name, Format::Svg));
    }

    /// Asks which plot is to be exported.
    pub fn ask(&mut self) {
        self.asks = true;
    }

    /// Whether the question stands.
    pub fn asks(&self) -> bool {
        self.asks
    }
}

fn offers(ctx: &Context, change: impl FnOnce(&mut Offers)) {
    ctx.data_mut(|data| change(data.get_temp_mut_or_default(Id::unique("plots on the screen"))));
}

/// Lets a plot be exported under its name, as far as it can be seen.
pub fn offer(ui: &Ui, name: &str, rect: Rect) {
    offer_of(ui, name, rect, Subject::Sliders);
}

/// The same for plots of something else than the contact of the sliders. Plots within it are of the same, and one of
/// its name gives way to it: it is that plot with what belongs to it.
pub fn offer_of(ui: &Ui, name: &str, rect: Rect, subject: Subject) {
    let rect = rect.expand2(OVERHANG).intersect(ui.clip_rect().expand2(OVERHANG));
    if !rect.is_positive() {
        return;
    }
    let offered = Offered { name: name.to_owned(), rect, layer: ui.layer_id(), subject };
    offers(ui.ctx(), |Offers { now, .. }| {
        now.retain(|other| other.name != name || !rect.contains_rect(other.rect));
        let within = now.iter_mut().filter(|other| rect.contains_rect(other.rect));
        if subject != Subject::Sliders {
            within.for_each(|other| other.subject = subject);
        }
        now.push(offered);
    });
}

/// Begins a frame.
pub fn begin(ctx: &Context) {
    offers(ctx, |offers| offers.last = std::mem::take(&mut offers.now));
}

impl Figures {
    /// The question, and the picture once the screen shows nothing but the plot, or why there is none. Called when
    /// everything else is drawn.
    pub fn ui(&mut self, ctx: &Context, caption: impl Fn(Subject) -> String) -> Option<Result<Purpose, String>> {
        if self.asks {
            self.choose_figure(ctx);
        }
        let mut wanted = self.wanted.take()?;
        wanted.frames += 1;
        let mut plot = None;
        offers(ctx, |offers| plot = offers.now.iter().find(|offered| offered.name == wanted.name).cloned());
        let subject = plot.as_ref().map_or(Subject::Sliders, |plot| plot.subject);
        let caption = [wanted.name.clone(), caption(subject)];
        match (&wanted.screenshot, plot) {
            (Some((receiver, rect)), _) => match receiver.try_recv() {
                Ok(image) => {
                    let bytes = png::encode(&cropped(&image, wanted.whole, ctx.pixels_per_point()));
                    return Some(Ok(Purpose::Write(Written::Png, bytes.into())));
                }
                Err(TryRecvError::Empty) if wanted.frames < PATIENCE => {
                    draw_caption(ctx, *rect, &caption);
                }
                Err(_) => {
                    let message = "the system gave no image of the window; the same plot can be exported as SVG";
                    return Some(Err(message.to_owned()));
                }
            },
            (None, None) if wanted.frames > SETTLED => {
                return Some(Err(format!("the plot “{}” is not on the screen any more", wanted.name)));
            }
            (None, Some(plot)) if wanted.frames > SETTLED && wanted.format == Format::Svg => {
                let background = ctx.style_of(ctx.theme()).visuals.panel_fill;
                let textures = texture::known(ctx);
                let text = ctx.graphics(|graphics| {
                    let shapes = graphics.get(plot.layer).map(|list| list.all_entries());
                    svg::drawing(shapes.into_iter().flatten(), plot.rect, &caption, background, &textures)
                });
                return Some(Ok(Purpose::Write(Written::Svg, text.into_bytes().into())));
            }
            (None, Some(plot)) if wanted.frames > SETTLED => {
                let rect = draw_caption(ctx, plot.rect, &caption);
                let (sender, receiver) = channel();
                let again = ctx.clone();
                let callback = egui::ScreenshotCallback::new(move |image| {
                    // The window may be gone by now.
                    if sender.send(image).is_ok() {
                        again.request_repaint();
                    }
                });
                ctx.send_viewport_cmd(ViewportCommand::Screenshot(callback));
                wanted.screenshot = Some((receiver, plot.rect));
                wanted.whole = rect;
            }
            (None, _) => {}
        }
        self.wanted = Some(wanted);
        ctx.request_repaint();
        None
    }

    fn choose_figure(&mut self, ctx: &Context) {
        let mut plots = Vec::new();
        offers(ctx, |offers| plots.clone_from(&offers.now));
        let mut close = false;
        let response = Modal::new(Id::unique("export a plot")).show(ctx, |ui| {
            ui.set_width(420.0);
            ui.heading("Export a plot");
            ui.weak("With its axes, its name and the contact above it, in the colours of the theme.");
            ui.add_space(4.0);
            if plots.is_empty() {
                ui.label("No plot is on the screen.");
            }
            egui::Grid::new("plots").num_columns(3).striped(true).show(ui, |ui| {
                for plot in &plots {
                    ui.label(&plot.name);
                    for (format, word) in [(Format::Svg, "SVG…"), (Format::Png, "PNG…")] {
                        let button = ui.button(word);
                        if named(ui, button, &format!("{} as {}", plot.name, word)).clicked() {
                            self.wanted = Some(Wanted::new(&plot.name, format));
                            close = true;
                        }
                    }
                    ui.end_row();
                }
            });
            ui.add_space(4.0);
            close |= ui.button("Cancel").clicked();
        });
        if close || response.should_close() {
            self.asks = false;
        }
    }
}

/// The lines above a plot, drawn over the window for the moment of the screenshot; returns the plot with them.
fn draw_caption(ctx: &Context, plot: Rect, [title, parameters]: &[String; 2]) -> Rect {
    let visuals = &ctx.style_of(ctx.theme()).visuals;
    let painter = ctx.layer_painter(LayerId::new(Order::Foreground, Id::unique("caption of a picture")));
    let width = plot.width() - 16.0;
    let (ink, quiet) = (visuals.text_color(), visuals.weak_text_color());
    let title = painter.layout(title.clone(), FontId::proportional(TITLE), ink, width);
    let parameters = painter.layout(parameters.clone(), FontId::proportional(PARAMETERS), quiet, width);
    let height = title.size().y + parameters.size().y + 12.0;
    let strip = Rect::from_min_max(pos2(plot.left(), (plot.top() - height).max(0.0)), plot.right_top());
    painter.rect_filled(strip, 0.0, visuals.panel_fill);
    let below = strip.top() + 4.0 + title.size().y;
    painter.galley(pos2(strip.left() + 8.0, strip.top() + 4.0), title, ink);
    painter.galley(pos2(strip.left() + 8.0, below), parameters, quiet);
    plot.with_min_y(strip.top())
}

/// The part of an image of the window under a rectangle in screen points.
fn cropped(image: &ColorImage, rect: Rect, pixels_per_point: f32) -> ColorImage {
    let [width, height] = image.size;
    let pixel = |at: f32, most: usize| ((at * pixels_per_point).round().max(0.0) as usize).min(most);
    let (left, right) = (pixel(rect.left(), width), pixel(rect.right(), width));
    let (top, bottom) = (pixel(rect.top(), height), pixel(rect.bottom(), height));
    let rows = image.pixels.chunks_exact(width.max(1)).take(bottom).skip(top);
    let pixels = rows.flat_map(|row| row.get(left..right).unwrap_or(&[]).iter().copied()).collect();
    ColorImage::new([right - left, bottom - top], pixels)
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::Color32;

    #[test]
    fn a_screenshot_is_cut_to_the_plot_in_its_own_pixels() {
        let color = |k: usize| Color32::from_rgb((k % 40) as u8, (k / 40) as u8, 0);
        let image = ColorImage::new([40, 20], (0..800).map(color).collect());
        let rect = Rect::from_min_max(pos2(5.0, 2.0), pos2(10.0, 4.0));
        let part = cropped(&image, rect, 2.0);
        assert_eq!(part.size, [10, 4]);
        assert_eq!((part.pixels[0], part.pixels[39]), (Color32::from_rgb(10, 4, 0), Color32::from_rgb(19, 7, 0)));
        let beyond = cropped(&image, Rect::from_min_max(pos2(-3.0, 0.0), pos2(90.0, 90.0)), 1.0);
        assert_eq!(beyond.size, [40, 20]);
    }
}
