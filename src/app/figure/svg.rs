//! What was painted within a rectangle as a drawing for other programs (SVG): lines stay lines and text stays text.

use super::texture::Known;
use crate::app::png;
use crate::scene::{escaped, wrapped};
use egui::epaint::{ClippedShape, ColorMode, PathStroke, TextShape};
use egui::{Color32, ColorImage, Mesh, Pos2, Rect, Shape, Stroke, TextureId, vec2};
use std::fmt::Write as _;

/// Height of the title above the drawing, and of each line of parameters.
const TITLE: f32 = 28.0;
const LINE: f32 = 13.0;
/// Width of a letter of the parameters, about.
const LETTER: f32 = 5.2;

/// The drawing of all shapes that can be seen in `rect`, with a title and a line of parameters above.
pub fn drawing<'a>(
    shapes: impl Iterator<Item = &'a ClippedShape>,
    rect: Rect,
    [title, parameters]: &[String; 2],
    background: Color32,
    textures: &Known,
) -> String {
    let mut out = Drawing { text: String::new(), clips: 0, textures };
    let lines = wrapped(parameters, ((rect.width() - 16.0) / LETTER) as usize);
    let above = TITLE + LINE * lines.len() as f32 + 4.0;
    let (width, height) = (rect.width(), rect.height() + above);
    let (left, top) = (rect.left(), rect.top() - above);
    // Text that can be read on either background.
    let light = background.intensity() > 0.5;
    let (ink, quiet) = if light { ("#222", "#666") } else { ("#eee", "#aaa") };
    out.line(format_args!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" viewBox=\"{left:.1} {top:.1} {width:.1} {height:.1}\" \
         font-family=\"sans-serif\">"
    ));
    let fill = fill(background);
    out.line(format_args!("<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" {fill}/>"));
    let (x, y) = (left + 8.0, top + 20.0);
    out.line(format_args!("<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"15\" fill=\"{ink}\">{}</text>", escaped(title)));
    for (k, words) in lines.iter().enumerate() {
        let y = top + TITLE + LINE * (k as f32 + 0.7);
        let words = escaped(words);
        out.line(format_args!("<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"9.5\" fill=\"{quiet}\">{words}</text>"));
    }
    let mut clip = None;
    for ClippedShape { clip_rect, shape, .. } in shapes {
        let within = clip_rect.intersect(rect);
        if matches!(shape, Shape::Noop) || !within.is_positive() || !shape.visual_bounding_rect().intersects(within) {
            continue;
        }
        // What fills more than the plot lies behind it.
        if matches!(shape, Shape::Rect(behind) if behind.rect.contains_rect(rect) && behind.rect != rect) {
            continue;
        }
        if clip != Some(within) {
            if clip.is_some() {
                out.line(format_args!("</g>"));
            }
            out.clip(within);
            clip = Some(within);
        }
        out.shape(shape);
    }
    if clip.is_some() {
        out.line(format_args!("</g>"));
    }
    out.line(format_args!("</svg>"));
    out.text
}

struct Drawing<'a> {
    text: String,
    clips: usize,
    textures: &'a Known,
}

/// A colour as attributes of that name.
fn color(name: &str, color: Color32) -> String {
    if color == Color32::TRANSPARENT {
        return format!("{name}=\"none\"");
    }
    let [r, g, b, a] = color.to_srgba_unmultiplied();
    let opacity = f32::from(a) / 255.0;
    format!("{name}=\"#{r:02x}{g:02x}{b:02x}\" {name}-opacity=\"{opacity:.3}\"")
}

fn fill(of: Color32) -> String {
    color("fill", of)
}

fn stroke(width: f32, of: Color32) -> String {
    if width > 0.0 {
        format!("stroke-width=\"{width:.2}\" {}", color("stroke", of))
    } else {
        "stroke=\"none\"".to_owned()
    }
}

fn points(of: impl Iterator<Item = Pos2>) -> String {
    of.map(|p| format!("{:.2},{:.2}", p.x, p.y)).collect::<Vec<_>>().join(" ")
}

impl Drawing<'_> {
    fn line(&mut self, line: std::fmt::Arguments<'_>) {
        // Writing to a string cannot fail.
        let _ok = writeln!(self.text, "{line}");
    }

    /// Begins a group that is cut at a rectangle.
    fn clip(&mut self, rect: Rect) {
        self.clips += 1;
        let (id, Pos2 { x, y }, size) = (self.clips, rect.min, rect.size());
        self.line(format_args!(
            "<clipPath id=\"c{id}\"><rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{:.1}\" height=\"{:.1}\"/></clipPath><g clip-path=\"url(#c{id})\">",
            size.x, size.y
        ));
    }

    fn shape(&mut self, shape: &Shape) {
        match shape {
            Shape::Noop | Shape::Callback(_) => {}
            Shape::Vec(shapes) => shapes.iter().for_each(|shape| self.shape(shape)),
            Shape::Circle(circle) => {
                let (center, Stroke { width, color }) = (circle.center, circle.stroke);
                self.line(format_args!(
                    "<circle cx=\"{:.2}\" cy=\"{:.2}\" r=\"{:.2}\" {} {}/>",
                    center.x,
                    center.y,
                    circle.radius,
                    fill(circle.fill),
                    stroke(width, color)
                ));
            }
            Shape::Ellipse(ellipse) => {
                let (center, radius, Stroke { width, color }) = (ellipse.center, ellipse.radius, ellipse.stroke);
                self.line(format_args!(
                    "<ellipse cx=\"{:.2}\" cy=\"{:.2}\" rx=\"{:.2}\" ry=\"{:.2}\" {} {}/>",
                    center.x,
                    center.y,
                    radius.x,
                    radius.y,
                    fill(ellipse.fill),
                    stroke(width, color)
                ));
            }
            Shape::LineSegment { points: [a, b], stroke: Stroke { width, color } } => self.line(format_args!(
                "<path d=\"M{:.2} {:.2}L{:.2} {:.2}\" {}/>",
                a.x,
                a.y,
                b.x,
                b.y,
                stroke(*width, *color)
            )),
            Shape::Path(path) => self.path(path.points.iter().copied(), path.closed, path.fill, &path.stroke),
            Shape::Band(band) => {
                let upper = band.points.iter().map(|p| Pos2::new(p.x, p.y.min));
                let lower = band.points.iter().rev().map(|p| Pos2::new(p.x, p.y.max));
                self.path(upper.chain(lower), true, band.fill, &PathStroke::from(band.stroke));
            }
            Shape::Rect(rect) => {
                let (size, Pos2 { x, y }) = (rect.rect.size(), rect.rect.min);
                self.line(format_args!(
                    "<rect x=\"{x:.2}\" y=\"{y:.2}\" width=\"{:.2}\" height=\"{:.2}\" rx=\"{}\" {} {}/>",
                    size.x,
                    size.y,
                    rect.corner_radius.nw,
                    fill(rect.fill),
                    stroke(rect.stroke.width, rect.stroke.color)
                ));
            }
            Shape::Text(text) => self.words(text),
            Shape::Mesh(mesh) if mesh.texture_id != TextureId::default() => self.image(mesh),
            Shape::Mesh(mesh) => {
                for corners in mesh.indices.chunks_exact(3) {
                    let corner = |k: usize| corners.get(k).and_then(|&i| mesh.vertices.get(i as usize));
                    let (Some(a), Some(b), Some(c)) = (corner(0), corner(1), corner(2)) else { continue };
                    let place = points([a.pos, b.pos, c.pos].into_iter());
                    self.line(format_args!("<polygon points=\"{place}\" {}/>", fill(a.color)));
                }
            }
            Shape::QuadraticBezier(curve) => {
                let line = curve.flatten(None);
                self.path(line.into_iter(), curve.closed, curve.fill, &curve.stroke);
            }
            Shape::CubicBezier(curve) => {
                let line = curve.flatten(None);
                self.path(line.into_iter(), curve.closed, curve.fill, &curve.stroke);
            }
        }
    }

    /// An upright image with its pixels, in the tint of its corners.
    fn image(&mut self, mesh: &Mesh) {
        let image = self.textures.get(&mesh.texture_id).and_then(std::sync::Weak::upgrade);
        let (Some(image), Some(corner)) = (image, mesh.vertices.first()) else { return };
        let pixels = image.pixels.iter().map(|pixel| *pixel * corner.color).collect();
        let file = base64(&png::encode(&ColorImage::new(image.size, pixels)));
        let (Pos2 { x, y }, size) = (mesh.calc_bounds().min, mesh.calc_bounds().size());
        self.line(format_args!(
            "<image x=\"{x:.2}\" y=\"{y:.2}\" width=\"{:.2}\" height=\"{:.2}\" preserveAspectRatio=\"none\" href=\"data:image/png;base64,{file}\"/>",
            size.x, size.y
        ));
    }

    fn path(&mut self, line: impl Iterator<Item = Pos2>, closed: bool, inner: Color32, outline: &PathStroke) {
        let element = if closed { "polygon" } else { "polyline" };
        let color = match &outline.color {
            ColorMode::Solid(color) => *color,
            // A colour that changes along the path: none of this program's plots has one.
            ColorMode::UV(_) => Color32::GRAY,
        };
        let (line, inner) = (points(line), if closed { inner } else { Color32::TRANSPARENT });
        self.line(format_args!(
            "<{element} points=\"{line}\" stroke-linejoin=\"round\" {} {}/>",
            fill(inner),
            stroke(outline.width, color)
        ));
    }

    /// Text, each run of one look at its own place on the baseline: subscripts stay below, and nothing depends on the
    /// reader's fonts but the shapes of letters.
    fn words(&mut self, text: &TextShape) {
        let job = &text.galley.job;
        let Pos2 { x, y } = text.pos;
        let turned = text.angle.to_degrees();
        self.line(format_args!("<g transform=\"translate({x:.2} {y:.2}) rotate({turned:.1})\">"));
        let mut byte = 0;
        for placed in &text.galley.rows {
            let mut run: Option<Run> = None;
            for glyph in &placed.row.glyphs {
                let section = job.sections.iter().position(|section| section.byte_range.contains(&byte.into()));
                byte += glyph.chr.len_utf8();
                let end = glyph.pos.x + glyph.advance_width;
                match &mut run {
                    Some(run) if run.section == section => {
                        run.letters.push(glyph.chr);
                        run.end = end;
                    }
                    _ => {
                        self.run(text, placed.pos, run.take());
                        run = Some(Run { section, from: glyph.pos, end, letters: glyph.chr.to_string() });
                    }
                }
            }
            self.run(text, placed.pos, run);
            byte += usize::from(placed.ends_with_newline);
        }
        self.line(format_args!("</g>"));
    }

    fn run(&mut self, text: &TextShape, row: Pos2, run: Option<Run>) {
        let Some(Run { section, from, end, letters }) = run.filter(|run| !run.letters.trim().is_empty()) else {
            return;
        };
        let Some(format) = section.and_then(|k| text.galley.job.sections.get(k)).map(|section| &section.format) else {
            return;
        };
        let own = if format.color == Color32::PLACEHOLDER { text.fallback_color } else { format.color };
        let color = text.override_text_color.unwrap_or(own).gamma_multiply(text.opacity_factor);
        let (x, y, length, size) = (row.x + from.x, row.y + from.y, end - from.x, format.font_id.size);
        if format.background != Color32::TRANSPARENT {
            let behind = Rect::from_min_size(Pos2::new(x, y - 0.95 * size), vec2(length, 1.2 * size));
            self.shape(&Shape::rect_filled(behind, 0.0, format.background));
        }
        let slant = if format.italics { " font-style=\"italic\"" } else { "" };
        self.line(format_args!(
            "<text x=\"{x:.2}\" y=\"{y:.2}\" textLength=\"{length:.2}\" lengthAdjust=\"spacingAndGlyphs\" font-size=\"{size:.1}\"{slant} {}>{}</text>",
            fill(color),
            escaped(&letters)
        ));
    }
}

/// Base64 of RFC 4648.
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for triple in bytes.chunks(3) {
        let word = (0..3).fold(0u32, |word, k| word << 8 | u32::from(triple.get(k).copied().unwrap_or(0)));
        for k in 0..4 {
            let digit = DIGITS[(word >> (18 - 6 * k) & 63) as usize];
            out.push(if k <= triple.len() { char::from(digit) } else { '=' });
        }
    }
    out
}

/// Letters of one look beside each other.
struct Run {
    section: Option<usize>,
    from: Pos2,
    end: f32,
    letters: String,
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::epaint::CircleShape;
    use egui::pos2;
    use std::sync::Arc;

    #[test]
    fn lines_are_broken_between_words_and_lose_none() {
        let text = "M 40.00, L 10.00, R 3.000 mm, w 200000 N/m";
        let lines = wrapped(text, 16);
        assert!(lines.len() > 2 && lines.iter().all(|line| line.chars().count() <= 16), "{lines:?}");
        assert_eq!(lines.join(" "), text);
    }

    #[test]
    fn what_lies_outside_or_behind_is_left_out() {
        let clip_rect = Rect::EVERYTHING;
        let rect = Rect::from_min_max(pos2(10.0, 10.0), pos2(110.0, 60.0));
        let dot = |at: Pos2| Shape::Circle(CircleShape::filled(at, 2.0, Color32::from_rgb(0xD5, 0x5E, 0x00)));
        let panel = Shape::rect_filled(rect.expand(30.0), 0.0, Color32::GRAY);
        let line = Shape::line_segment([pos2(20.0, 20.0), pos2(90.0, 50.0)], (1.5, Color32::BLACK));
        let shapes = [panel, line, dot(pos2(50.0, 30.0)), dot(pos2(300.0, 30.0))]
            .map(|shape| ClippedShape::new(clip_rect, shape));
        let caption = ["P < 1 & more".to_owned(), "M 40".to_owned()];
        let drawing = drawing(shapes.iter(), rect, &caption, Color32::WHITE, &Known::new());
        assert_eq!((drawing.matches("<circle ").count(), drawing.matches("<path ").count()), (1, 1));
        assert!(drawing.contains("fill=\"#d55e00\" fill-opacity=\"1.000\"") && drawing.contains("P &lt; 1 &amp; more"));
        assert_eq!(drawing.matches("<g").count(), drawing.matches("</g>").count());
        // The background and the clip: the panel behind is none of it.
        assert_eq!(drawing.matches("<rect ").count(), 2, "{drawing}");
    }

    #[test]
    fn an_image_leaves_with_its_pixels_in_its_tint() {
        let image = Arc::new(ColorImage::new([2, 1], vec![Color32::WHITE, Color32::BLACK]));
        let id = TextureId::Managed(7);
        let known = Known::from([(id, Arc::downgrade(&image))]);
        let rect = Rect::from_min_max(pos2(0.0, 0.0), pos2(100.0, 50.0));
        let mut mesh = Mesh::with_texture(id);
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        mesh.add_rect_with_uv(rect.shrink(10.0), whole, Color32::from_gray(128));
        let shapes = [ClippedShape::new(rect, Shape::mesh(mesh))];
        let caption = ["Map".to_owned(), String::new()];
        let text = drawing(shapes.iter(), rect, &caption, Color32::WHITE, &known);
        let grey = ColorImage::new([2, 1], vec![Color32::from_gray(128), Color32::BLACK]);
        assert!(text.contains("<image x=\"10.00\" y=\"10.00\" width=\"80.00\" height=\"30.00\""), "{text}");
        assert!(text.contains(&base64(&png::encode(&grey))) && !text.contains("<polygon"));
        // What is not known any more leaves nothing rather than something else.
        drop(image);
        assert!(!drawing(shapes.iter(), rect, &caption, Color32::WHITE, &known).contains("<image"));
    }

    #[test]
    fn base64_is_that_of_the_standard() {
        for (plain, coded) in [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")] {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
    }
}
