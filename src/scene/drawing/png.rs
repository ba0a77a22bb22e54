//! Writes drawings and pixels as PNG.

use super::words::{LOWERED, SLANT, font};
use super::{Drawing, Lettering, Mark, PT_PER_MM, Pen, Pixels, Rgb, TextAnchor};
use png::{BitDepth, ColorType, Compression, Encoder, EncodingError, PixelDimensions, Unit};
use skrifa::MetadataProvider as _;
use skrifa::instance::{LocationRef, Size};
use skrifa::outline::{DrawSettings, OutlinePen};
use std::sync::Arc;
use vello_cpu::color::PremulRgba8;
use vello_cpu::kurbo::{Affine, BezPath, Circle, Point, Rect, Shape as _, Stroke};
use vello_cpu::peniko::{Color, ImageQuality, ImageSampler};
use vello_cpu::{Image, ImageSource, Pixmap, RenderContext, Resources};

/// Range of accepted resolutions \[dots per inch\].
pub const DPI: (f64, f64) = (50.0, 1200.0);
/// Largest number of pixels of an image.
const MOST_PIXELS: f64 = 60e6;

/// Reason why an image cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PngError {
    /// The resolution is out of range.
    #[error("a resolution of {0} dpi is not within {least} to {most}", least = DPI.0, most = DPI.1)]
    Dpi(f64),
    /// The image has too many pixels.
    #[error("an image of {0:.0} by {1:.0} pixels is too large; a smaller one, or fewer dots per inch, can be made")]
    Large(f64, f64),
}

/// Encodes an image in true colour; returns nothing for an empty image. With a resolution \[dpi\], the file contains
/// its size on paper.
pub fn encode(pixels: &Pixels, dpi: Option<f64>) -> Vec<u8> {
    // Writing to memory does not fail: only an image without pixels is refused.
    written(pixels, dpi).unwrap_or_default()
}

fn written(pixels: &Pixels, dpi: Option<f64>) -> Result<Vec<u8>, EncodingError> {
    let [width, height] = [pixels.width, pixels.height()].map(|count| u32::try_from(count).unwrap_or(u32::MAX));
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, width, height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Fast);
    if let Some(dpi) = dpi {
        let per_metre = (dpi / 0.0254).round() as u32;
        encoder.set_pixel_dims(Some(PixelDimensions { xppu: per_metre, yppu: per_metre, unit: Unit::Meter }));
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&pixels.rgb)?;
    writer.finish()?;
    Ok(file)
}

impl Drawing {
    /// Returns the drawing as a PNG file with a resolution \[dpi\]. `drawn` is called after drawing, before encoding.
    ///
    /// # Errors
    ///
    /// If the resolution is outside [`DPI`], or if there are too many pixels.
    pub fn to_png(&self, dpi: f64, drawn: impl FnOnce()) -> Result<Vec<u8>, PngError> {
        if !(DPI.0..=DPI.1).contains(&dpi) {
            return Err(PngError::Dpi(dpi));
        }
        let pixels = self.to_pixels(dpi)?;
        drawn();
        Ok(encode(&pixels, Some(dpi)))
    }

    /// Returns the drawing as pixels, with any resolution.
    ///
    /// # Errors
    ///
    /// If there are too many pixels.
    pub fn to_pixels(&self, dpi: f64) -> Result<Pixels, PngError> {
        let scale = dpi / 72.0;
        let [width, height] = self.size_mm.map(|mm| (mm * PT_PER_MM * scale).round().max(1.0));
        let most = f64::from(u16::MAX);
        if !(width * height <= MOST_PIXELS && width <= most && height <= most) {
            return Err(PngError::Large(width, height));
        }
        let mut canvas = Canvas { context: RenderContext::new(width as u16, height as u16), clipped: false };
        canvas.context.set_paint(color(self.ground, 1.0));
        canvas.context.fill_rect(&Rect::new(0.0, 0.0, width, height));
        canvas.context.set_transform(Affine::scale(scale));
        self.marks.iter().for_each(|mark| canvas.mark(mark, scale));
        canvas.clip(None);
        let mut pixmap = Pixmap::new(width as u16, height as u16);
        canvas.context.flush();
        canvas.context.render(&mut pixmap, &mut Resources::new());
        let rgb = pixmap.data().iter().flat_map(|pixel| [pixel.r, pixel.g, pixel.b]).collect();
        Ok(Pixels { width: width as usize, rgb })
    }
}

struct Canvas {
    context: RenderContext,
    clipped: bool,
}

fn color([red, green, blue]: Rgb, opacity: f64) -> Color {
    Color::from_rgba8(red, green, blue, (255.0 * opacity.clamp(0.0, 1.0)).round() as u8)
}

fn rect([x, y, width, height]: [f64; 4]) -> Rect {
    Rect::new(x, y, x + width, y + height)
}

/// Returns the path through points.
fn through(points: &[[f64; 2]]) -> BezPath {
    let mut path = BezPath::new();
    for (k, [x, y]) in points.iter().enumerate() {
        if k == 0 { path.move_to((*x, *y)) } else { path.line_to((*x, *y)) }
    }
    path
}

impl Canvas {
    fn mark(&mut self, mark: &Mark, scale: f64) {
        match mark {
            Mark::Line(points, pen) => {
                if points.len() > 1 {
                    self.stroke(&through(points), pen);
                }
            }
            Mark::Polygon(corners, fill, opacity) => {
                if corners.len() > 2 {
                    let mut path = through(corners);
                    path.close_path();
                    self.context.set_paint(color(*fill, *opacity));
                    self.context.fill_path(&path);
                }
            }
            Mark::Area(area, fill, opacity) => {
                self.context.set_paint(color(*fill, *opacity));
                self.context.fill_rect(&rect(*area));
            }
            Mark::Frame(area, pen) => self.stroke(&rect(*area).to_path(0.05), pen),
            Mark::Dot([x, y], radius, fill) => {
                self.context.set_paint(color(*fill, 1.0));
                self.context.fill_path(&Circle::new((*x, *y), *radius).to_path(0.01));
            }
            Mark::Ring([x, y], radius, pen) => self.stroke(&Circle::new((*x, *y), *radius).to_path(0.01), pen),
            Mark::Image(area, pixels) => self.image(*area, pixels),
            Mark::Words(words) => self.words(words, scale),
            Mark::Within(area) => self.clip(*area),
        }
    }

    fn clip(&mut self, area: Option<[f64; 4]>) {
        if self.clipped {
            self.context.pop_clip_path();
        }
        self.clipped = area.is_some();
        if let Some(area) = area {
            self.context.push_clip_path(&rect(area).to_path(0.05));
        }
    }

    fn stroke(&mut self, path: &BezPath, pen: &Pen) {
        self.context.set_paint(color(pen.color, pen.opacity));
        self.context.set_stroke(Stroke::new(pen.width).with_dashes(0.0, pen.dashes.iter().copied()));
        self.context.stroke_path(path);
    }

    fn image(&mut self, area: [f64; 4], pixels: &Pixels) {
        let size = [pixels.width, pixels.height()].map(u16::try_from);
        let [Ok(width), Ok(height)] = size else { return };
        if width == 0 || height == 0 {
            return;
        }
        let pixel = |rgb: &[u8]| match rgb {
            [r, g, b] => Some(PremulRgba8 { r: *r, g: *g, b: *b, a: 255 }),
            _ => None,
        };
        let data: Vec<PremulRgba8> = pixels.rgb.chunks_exact(3).filter_map(pixel).collect();
        if data.len() != usize::from(width) * usize::from(height) {
            return;
        }
        let image = ImageSource::Pixmap(Arc::new(Pixmap::from_parts(data, width, height)));
        let sampler = ImageSampler { quality: ImageQuality::Medium, ..ImageSampler::default() };
        self.context.set_paint(Image { image, sampler });
        let [x, y, wide, high] = area;
        let fit =
            Affine::translate((x, y)) * Affine::scale_non_uniform(wide / f64::from(width), high / f64::from(height));
        self.context.set_paint_transform(fit);
        self.context.fill_rect(&rect(area));
        self.context.reset_paint_transform();
    }

    /// Fills the outlines of letters. For bold text, the outlines are also stroked.
    fn words(&mut self, lettering: &Lettering, scale: f64) {
        let Lettering { words, at: [x, y], beside, upwards, size, bold, color: ink, .. } = lettering;
        let Some(font) = font() else { return };
        let (letters, outlines) = (font.charmap(), font.outline_glyphs());
        let length = words.length(*size);
        let mut pen = match beside {
            TextAnchor::Right => 0.0,
            TextAnchor::Middle => -0.5 * length,
            TextAnchor::Left => -length,
        };
        let turned = if *upwards { Affine::rotate(-std::f64::consts::FRAC_PI_2) } else { Affine::IDENTITY };
        let place = Affine::scale(scale) * Affine::translate((*x, *y)) * turned;
        self.context.set_paint(color(*ink, 1.0));
        for piece in words.pieces() {
            let own = piece.size(*size);
            let widths = font.glyph_metrics(Size::new(own as f32), LocationRef::default());
            let below = if piece.subscript { LOWERED * size } else { 0.0 };
            for letter in piece.text.chars() {
                let glyph = letters.map(letter).unwrap_or_default();
                let mut outline = Outline(BezPath::new());
                let settings = DrawSettings::unhinted(Size::new(own as f32), LocationRef::default());
                let drawn = outlines.get(glyph).map(|glyph| glyph.draw(settings, &mut outline));
                if matches!(drawn, Some(Ok(_))) {
                    let slant = if piece.italic { SLANT } else { 0.0 };
                    let upright = Affine::new([1.0, 0.0, slant, -1.0, 0.0, 0.0]);
                    self.context.set_transform(place * Affine::translate((pen, below)) * upright);
                    self.context.fill_path(&outline.0);
                    if *bold {
                        self.context.set_stroke(Stroke::new(0.045 * own));
                        self.context.stroke_path(&outline.0);
                    }
                }
                pen += widths.advance_width(glyph).map_or(0.0, f64::from);
            }
        }
        self.context.set_transform(Affine::scale(scale));
    }
}

/// Path of a letter, with y upwards.
struct Outline(BezPath);

fn point(x: f32, y: f32) -> Point {
    Point::new(f64::from(x), f64::from(y))
}

impl OutlinePen for Outline {
    fn move_to(&mut self, x: f32, y: f32) {
        self.0.move_to(point(x, y));
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.0.line_to(point(x, y));
    }

    fn quad_to(&mut self, cx: f32, cy: f32, x: f32, y: f32) {
        self.0.quad_to(point(cx, cy), point(x, y));
    }

    fn curve_to(&mut self, cx0: f32, cy0: f32, cx1: f32, cy1: f32, x: f32, y: f32) {
        self.0.curve_to(point(cx0, cy0), point(cx1, cy1), point(x, y));
    }

    fn close(&mut self) {
        self.0.close_path();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::drawing::Words;

    /// Returns width, height, pixels and pixels per metre of a PNG file.
    fn read(file: &[u8]) -> (u32, u32, Vec<u8>, Option<u32>) {
        let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        assert_eq!(info.color_type, ColorType::Rgb);
        (info.width, info.height, pixels, reader.info().pixel_dims.map(|dims| dims.xppu))
    }

    #[test]
    fn a_picture_reads_back_as_it_was() {
        let image = Pixels { width: 300, rgb: [1, 2, 3].repeat(30_000) };
        let (width, height, pixels, _) = read(&encode(&image, None));
        assert_eq!((width, height), (300, 100));
        assert_eq!(pixels, image.rgb);
        assert!(encode(&Pixels { width: 0, rgb: Vec::new() }, None).is_empty());
    }

    #[test]
    fn marks_stand_where_they_were_put() {
        let pen = Pen { color: [255, 0, 0], opacity: 1.0, width: 2.0, dashes: Vec::new() };
        let words = Lettering {
            words: Words::marked("{H_c}"),
            at: [5.0, 60.0],
            beside: TextAnchor::Right,
            upwards: false,
            size: 20.0,
            bold: false,
            color: [0, 0, 255],
            class: "".into(),
        };
        let drawing = Drawing {
            size_mm: [25.4, 25.4],
            title: String::new(),
            ground: [255; 3],
            marks: vec![
                Mark::Image([36.0, 36.0, 36.0, 36.0], Pixels { width: 1, rgb: vec![0, 128, 0] }),
                Mark::Line(vec![[0.0, 10.0], [72.0, 10.0]], pen),
                Mark::Words(words),
            ],
        };
        let (width, height, pixels, per_metre) = read(&drawing.to_png(144.0, || ()).unwrap());
        assert_eq!((width, height, per_metre), (144, 144, Some(5669)));
        let at = |x: usize, y: usize| <[u8; 3]>::try_from(&pixels[3 * (144 * y + x)..][..3]).unwrap();
        assert_eq!([at(70, 20), at(70, 60), at(100, 100)], [[255, 0, 0], [255; 3], [0, 128, 0]]);
        let blue = pixels.chunks(3).filter(|pixel| pixel[2] > pixel[0].saturating_add(100)).count();
        assert!((50..1500).contains(&blue), "{blue} pixels of letters");
        assert_eq!(drawing.to_png(f64::NAN, || ()).map_err(|e| e.to_string().len() > 20), Err(true));
        let large = Drawing { size_mm: [400.0, 400.0], ..drawing };
        assert!(matches!(large.to_png(1200.0, || ()), Err(PngError::Large(..))));
    }
}
