//! All colours, line widths and text styles of the explorer. A quantity has the same hue everywhere (Okabe–Ito).
//! Reduced solutions are thick lines, full solutions thin lines of the same hue, and pinned curves fade.

use egui::ecolor::{Hsva, Rgba};
use egui::text::{LayoutJob, TextFormat};
use egui::{Align, Color32, Context, CornerRadius, FontId, Stroke, TextStyle, Theme, Ui, Visuals};

/// Width of the curve of the present contact \[points\].
pub const LIVE_WIDTH: f32 = 3.0;
/// Width of a full solution drawn over a reduced one \[points\].
pub const FULL_WIDTH: f32 = 1.1;
/// Width of reference and pinned curves \[points\].
pub const THIN_WIDTH: f32 = 1.2;

/// Minimum contrast of readable text (WCAG 2.2, level AA).
pub const READABLE: f32 = 4.5;

/// Returns the contrast of two opaque colours, 1…21, as defined in WCAG 2.2.
pub fn contrast(a: Color32, b: Color32) -> f32 {
    let luminance = |color: Color32| {
        let [r, g, b, _] = Rgba::from(color).to_array();
        0.2126 * r + 0.7152 * g + 0.0722 * b + 0.05
    };
    let (a, b) = (luminance(a), luminance(b));
    a.max(b) / a.min(b)
}

/// Colours of one theme.
#[derive(Clone, Copy, Debug)]
pub struct Palette {
    dark: bool,
    /// Background on which text has the lowest contrast.
    paper: Color32,
    pub pressure: Color32,
    /// Film thickness.
    pub film: Color32,
    pub deformation: Color32,
    pub traction: Color32,
    /// Hertz and published formulas, always dashed.
    pub reference: Color32,
    /// Draggable and selected objects.
    pub accent: Color32,
    /// A result that was checked against the full solution.
    pub verified: Color32,
    /// A warning: usable with reservation.
    pub warning: Color32,
    /// An error.
    pub wrong: Color32,
    pub text: Color32,
    /// Secondary text and outlines.
    pub quiet: Color32,
    /// Grid lines of plots.
    pub grid: Color32,
    /// Shade of the cavitated region.
    pub cavitated: Color32,
    /// Shades of the regimes: rigid-isoviscous, elastic-isoviscous, rigid-piezoviscous, elastic-piezoviscous.
    pub regimes: [Color32; 4],
}

impl Palette {
    /// Returns the shade of a hue that is visible on top of its thick line: lighter in the dark theme, darker in
    /// the light theme.
    pub fn over(&self, color: Color32) -> Color32 {
        color.lerp_to_gamma(if self.dark { Color32::WHITE } else { Color32::BLACK }, 0.62)
    }

    /// Returns the shade of a hue in which text is readable on every background of the theme.
    pub fn ink(&self, color: Color32) -> Color32 {
        self.ink_on(color, self.paper)
    }

    /// Returns the shade of a hue in which text is readable on every colour of the chart of regimes.
    pub fn ink_on_regimes(&self, color: Color32) -> Color32 {
        self.regimes.iter().fold(self.ink(color), |ink, shade| self.ink_on(ink, *shade))
    }

    /// Returns the shade of a hue in which text is readable on one opaque background.
    pub fn ink_on(&self, color: Color32, background: Color32) -> Color32 {
        // Text is opaque, even if it names a faint line.
        let color = color.to_opaque();
        let shades = (0..=20).map(|step| color.lerp_to_gamma(self.text, step as f32 / 20.0));
        shades.into_iter().find(|shade| contrast(*shade, background) >= READABLE).unwrap_or(self.text)
    }

    /// Returns the hue of a pinned curve by its number from 1. Neighbouring numbers are far apart on the circle of
    /// hues.
    pub fn pin(&self, number: usize) -> Color32 {
        const GOLDEN: f32 = 0.618_034;
        let hue = (0.12 + number as f32 * GOLDEN).fract();
        let (saturation, value) = if self.dark { (0.55, 0.88) } else { (0.85, 0.55) };
        Hsva::new(hue, saturation, value, 1.0).into()
    }

    /// Returns the colours of the present theme.
    pub fn of(ui: &Ui) -> Self {
        Self::for_visuals(ui.visuals())
    }

    /// Returns the colours of the present theme if no `Ui` is available.
    pub fn of_screen(ctx: &Context) -> Self {
        Self::for_visuals(&ctx.style_of(ctx.theme()).visuals)
    }

    /// Returns the colours for the visuals of a theme.
    pub fn for_visuals(visuals: &Visuals) -> Self {
        if visuals.dark_mode {
            Self {
                dark: true,
                paper: Color32::from_rgb(0x26, 0x27, 0x2B),
                pressure: Color32::from_rgb(0xF0, 0x7A, 0x28),
                film: Color32::from_rgb(0x3C, 0x9F, 0xDE),
                deformation: Color32::from_rgb(0x1F, 0xB8, 0x8C),
                traction: Color32::from_rgb(0xD9, 0x8C, 0xB6),
                reference: Color32::from_gray(0x93),
                accent: Color32::from_rgb(0xA3, 0x8F, 0xF5),
                verified: Color32::from_rgb(0x6F, 0xC0, 0x8B),
                warning: Color32::from_rgb(0xE6, 0xB4, 0x50),
                wrong: Color32::from_rgb(0xF2, 0x6D, 0x6D),
                text: Color32::from_gray(0xDE),
                quiet: Color32::from_gray(0x9A),
                grid: Color32::from_white_alpha(34),
                cavitated: Color32::from_white_alpha(10),
                regimes: [
                    Color32::from_rgb(0x2B, 0x2E, 0x33),
                    Color32::from_rgb(0x23, 0x35, 0x42),
                    Color32::from_rgb(0x3B, 0x33, 0x26),
                    Color32::from_rgb(0x2A, 0x3A, 0x30),
                ],
            }
        } else {
            Self {
                dark: false,
                paper: Color32::from_rgb(0xF0, 0xF0, 0xF2),
                pressure: Color32::from_rgb(0xD5, 0x5E, 0x00),
                film: Color32::from_rgb(0x00, 0x72, 0xB2),
                deformation: Color32::from_rgb(0x00, 0x9E, 0x73),
                traction: Color32::from_rgb(0xA8, 0x47, 0x8A),
                reference: Color32::from_gray(0x78),
                accent: Color32::from_rgb(0x62, 0x4C, 0xC0),
                verified: Color32::from_rgb(0x26, 0x70, 0x45),
                warning: Color32::from_rgb(0x8A, 0x5C, 0x00),
                wrong: Color32::from_rgb(0xB8, 0x23, 0x23),
                text: Color32::from_gray(0x24),
                quiet: Color32::from_gray(0x6A),
                grid: Color32::from_black_alpha(44),
                cavitated: Color32::from_black_alpha(10),
                regimes: [
                    Color32::from_rgb(0xEE, 0xEE, 0xF0),
                    Color32::from_rgb(0xDF, 0xEC, 0xF5),
                    Color32::from_rgb(0xF7, 0xEC, 0xDC),
                    Color32::from_rgb(0xE2, 0xF0, 0xE6),
                ],
            }
        }
    }
}

/// Sets the styles of both themes. Call once at start.
pub fn install(ctx: &Context) {
    for theme in [Theme::Light, Theme::Dark] {
        ctx.style_mut_of(theme, |style| {
            let visuals = &mut style.visuals;
            let palette = Palette::for_visuals(visuals);
            if theme == Theme::Light {
                visuals.panel_fill = Color32::from_rgb(0xF7, 0xF7, 0xF8);
                visuals.window_fill = Color32::from_rgb(0xF2, 0xF2, 0xF4);
                visuals.extreme_bg_color = Color32::WHITE;
                visuals.faint_bg_color = Color32::from_rgb(0xF0, 0xF0, 0xF2);
                visuals.override_text_color = Some(palette.text);
            } else {
                visuals.panel_fill = Color32::from_rgb(0x1E, 0x1F, 0x22);
                visuals.window_fill = Color32::from_rgb(0x26, 0x27, 0x2B);
                visuals.extreme_bg_color = Color32::from_rgb(0x16, 0x17, 0x1A);
                visuals.faint_bg_color = Color32::from_rgb(0x26, 0x27, 0x2B);
                visuals.override_text_color = Some(palette.text);
            }
            visuals.weak_text_color = Some(palette.quiet);
            visuals.warn_fg_color = palette.warning;
            visuals.error_fg_color = palette.wrong;
            visuals.hyperlink_color = palette.accent;
            visuals.selection.bg_fill = palette.accent.gamma_multiply(if visuals.dark_mode { 0.45 } else { 0.30 });
            visuals.selection.stroke = Stroke::new(1.0, palette.accent);
            visuals.slider_trailing_fill = true;
            visuals.window_corner_radius = CornerRadius::same(6);
            style.spacing.item_spacing = egui::vec2(8.0, 5.0);
            style.spacing.button_padding = egui::vec2(8.0, 3.0);
            style.spacing.slider_width = 150.0;
            style.spacing.interact_size.y = 22.0;
            style.spacing.tooltip_width = 300.0;
            style.text_styles.insert(TextStyle::Small, FontId::proportional(11.0));
            style.text_styles.insert(TextStyle::Body, FontId::proportional(13.5));
            style.text_styles.insert(TextStyle::Button, FontId::proportional(13.5));
            style.text_styles.insert(TextStyle::Heading, FontId::proportional(16.0));
            style.animation_time = 0.06;
        });
    }
}

/// Returns a symbol as in the literature: slanted letter, upright subscript.
pub fn symbol(ui: &Ui, base: &str, subscript: &str) -> LayoutJob {
    let mut job = LayoutJob::default();
    append_symbol(&mut job, TextStyle::Body.resolve(ui.style()).size, ui.visuals().text_color(), base, subscript);
    job
}

/// Returns a name followed by its symbol for the rows of panels, such as "Load number *M*".
pub fn name_and_symbol(ui: &Ui, name: &str, base: &str, subscript: &str) -> LayoutJob {
    let mark = if subscript.is_empty() { format!("{{{base}}}") } else { format!("{{{base}_{subscript}}}") };
    rich(&format!("{name} {mark}"), TextStyle::Body.resolve(ui.style()).size, ui.visuals().text_color())
}

/// Returns formatted text. Symbols are in braces, as in `Pressure {P} = {p}/{p_H}`.
pub fn rich(text: &str, size: f32, color: Color32) -> LayoutJob {
    let mut job = LayoutJob::default();
    let plain = TextFormat { font_id: FontId::proportional(size), color, ..TextFormat::default() };
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('{') {
        job.append(before, 0.0, plain.clone());
        let (inside, behind) = after.split_once('}').unwrap_or((after, ""));
        let (base, subscript) = inside.split_once('_').unwrap_or((inside, ""));
        append_symbol(&mut job, size, color, base, subscript);
        rest = behind;
    }
    job.append(rest, 0.0, plain);
    job
}

/// Appends a symbol. Only Latin letters are slanted.
fn append_symbol(job: &mut LayoutJob, size: f32, color: Color32, base: &str, subscript: &str) {
    let italics = base.starts_with(|c: char| c.is_ascii_alphabetic());
    let format = TextFormat { font_id: FontId::proportional(size), color, italics, ..TextFormat::default() };
    job.append(base, 0.0, format.clone());
    if !subscript.is_empty() {
        let font_id = FontId::proportional(size * 0.74);
        job.append(subscript, 0.5, TextFormat { font_id, italics: false, valign: Align::BOTTOM, ..format });
    }
}

/// Returns the colour at t of a perceptually uniform scale (viridis), 0 ≤ t ≤ 1. The colour at t = 0 is close to the
/// background of the theme, and that at t = 1 is far from it.
pub fn sequential(t: f32, dark: bool) -> Color32 {
    const STOPS: [(u8, u8, u8); 6] = [
        (0x44, 0x01, 0x54),
        (0x41, 0x44, 0x87),
        (0x2A, 0x78, 0x8E),
        (0x22, 0xA8, 0x84),
        (0x7A, 0xD1, 0x51),
        (0xFD, 0xE7, 0x25),
    ];
    // The end of the scale that is close to the background is left out.
    let t = t.clamp(0.0, 1.0);
    let place = if dark { 0.2 + 0.8 * t } else { 0.9 - 0.9 * t } * (STOPS.len() - 1) as f32;
    let at = (place.floor() as usize).min(STOPS.len() - 2);
    let color = |(r, g, b): (u8, u8, u8)| Color32::from_rgb(r, g, b);
    color(STOPS[at]).lerp_to_gamma(color(STOPS[at + 1]), place - at as f32)
}

/// Returns a colour faded by `strength` (1 keeps it), for curves behind that of the present contact.
pub fn faded(color: Color32, strength: f32) -> Color32 {
    color.gamma_multiply(strength)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn text_can_be_read_in_both_themes() {
        assert!((contrast(Color32::WHITE, Color32::BLACK) - 21.0).abs() < 1e-3);
        let ctx = Context::default();
        install(&ctx);
        for theme in [Theme::Light, Theme::Dark] {
            let style = ctx.style_of(theme);
            let (visuals, widgets) = (&style.visuals, &style.visuals.widgets);
            let palette = Palette::for_visuals(visuals);
            let papers = [visuals.panel_fill, visuals.window_fill, visuals.extreme_bg_color, visuals.faint_bg_color];
            let quantities = [
                palette.pressure,
                palette.film,
                palette.deformation,
                palette.traction,
                palette.reference,
                palette.accent,
            ];
            let inks = quantities.into_iter().chain((1..=8).map(|pin| palette.pin(pin))).map(|hue| palette.ink(hue));
            let said = [palette.text, palette.quiet, palette.verified, palette.warning, palette.wrong];
            for ink in inks.chain(said) {
                for paper in papers {
                    let contrast = contrast(ink, paper);
                    assert!(contrast >= READABLE, "{theme:?}: {ink:?} on {paper:?} has {contrast}");
                }
            }
            for (hue, shade) in quantities
                .into_iter()
                .chain([palette.quiet, palette.warning])
                .flat_map(|hue| palette.regimes.map(|shade| (hue, shade)))
            {
                let contrast = contrast(palette.ink_on_regimes(hue), shade);
                assert!(contrast >= READABLE, "{theme:?}: {hue:?} on the regime {shade:?} has {contrast}");
            }
            // Controls keep readable text in every state.
            let states = [&widgets.inactive, &widgets.hovered, &widgets.active, &widgets.open];
            let selected = visuals.panel_fill.blend(visuals.selection.bg_fill);
            for fill in states.into_iter().flat_map(|state| [state.bg_fill, state.weak_bg_fill]).chain([selected]) {
                let contrast = contrast(palette.text, visuals.panel_fill.blend(fill));
                assert!(contrast >= READABLE, "{theme:?}: text on {fill:?} has {contrast}");
            }
            // Neighbouring pins can be distinguished.
            for pin in 1..8 {
                let [a, b] = [palette.pin(pin), palette.pin(pin + 1)];
                let apart = a.to_array().iter().zip(b.to_array()).map(|(a, b)| a.abs_diff(b)).max();
                assert!(apart > Some(60), "{theme:?}: pin {pin} {a:?} and the next {b:?}");
            }
        }
    }

    /// Collects the text of every source file below a folder, without tests.
    fn collect_sources(folder: &Path, sources: &mut Vec<String>) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                // Commands print to a terminal, which has its own fonts.
                if !path.ends_with("src/cli") {
                    collect_sources(&path, sources);
                }
            } else if !path.ends_with("tests.rs") && !path.ends_with("engine/model_text.rs") {
                let text = std::fs::read_to_string(&path).unwrap();
                sources.push(text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default().to_owned());
            }
        }
    }

    /// The fonts must contain all characters outside ASCII that the screen uses: symbols, units and quotation
    /// marks.
    #[test]
    fn every_character_on_the_screen_has_a_glyph() {
        let mut sources = Vec::new();
        // The other folders contain text for the terminal only.
        for folder in ["app", "engine", "scene", "solver"] {
            collect_sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src").join(folder), &mut sources);
        }
        assert!(sources.len() > 100, "the sources are where they are looked for");
        sources.extend(crate::app::manual::texts().map(str::to_owned));
        let mut used: Vec<char> = sources
            .iter()
            .flat_map(|s| s.lines())
            .filter(|line| !line.trim_start().starts_with("//"))
            .flat_map(str::chars)
            .filter(|c| !c.is_ascii())
            .collect();
        used.sort_unstable();
        used.dedup();
        let ctx = Context::default();
        let mut missing = String::new();
        let _output = ctx.run_ui(egui::RawInput::default(), |ui| {
            let font = FontId::proportional(13.0);
            missing = ui.ctx().fonts_mut(|f| used.iter().copied().filter(|c| !f.has_glyph(&font, *c)).collect());
        });
        assert!(missing.is_empty(), "no glyph for {missing:?}");
    }
}
