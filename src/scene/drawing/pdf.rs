//! Writes drawings as PDF pages with vector text. The letters that occur are embedded.

use super::words::{LOWERED, SLANT, font};
use super::{Drawing, Lettering, Mark, Pen, Pixels, Rgb, TextAnchor};
use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::types::{
    CidFontType, FontFlags, LineCapStyle, LineJoinStyle, SystemInfo, TextRenderingMode, UnicodeCmap,
};
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, Str, TextStr};
use skrifa::MetadataProvider as _;
use skrifa::instance::{LocationRef, Size};
use std::collections::BTreeMap;
use subsetter::{GlyphRemapper, subset};

/// Level of compression.
const LEVEL: u8 = 6;
/// Control points of a quarter of a circle.
const QUARTER: f32 = 0.552_284_8;
/// Name of the embedded font, with the tag of a subset.
const FONT: Name<'static> = Name(b"EHLEXP+Ubuntu-Light");
/// Encoding of the glyphs by their numbers.
const IDENTITY: SystemInfo<'static> = SystemInfo { registry: Str(b"Adobe"), ordering: Str(b"Identity"), supplement: 0 };

/// Content of the page, and what it uses.
struct Page {
    content: Content,
    glyphs: GlyphRemapper,
    /// Characters and widths \[1/1000 em\] of the glyphs, by their new numbers.
    letters: BTreeMap<u16, (char, f32)>,
    images: Vec<Pixels>,
    /// Opacities in per mille.
    opacities: Vec<u16>,
    clipped: bool,
}

impl Drawing {
    /// Returns the drawing as a PDF file of one page.
    pub fn to_pdf(&self) -> Vec<u8> {
        let [width, height] = self.size().map(|pt| pt as f32);
        let mut page = Page {
            content: Content::new(),
            glyphs: GlyphRemapper::new(),
            letters: BTreeMap::new(),
            images: Vec::new(),
            opacities: Vec::new(),
            clipped: false,
        };
        // Drawings count downwards, pages upwards.
        page.content.transform([1.0, 0.0, 0.0, -1.0, 0.0, height]);
        page.fill(self.ground);
        page.content.rect(0.0, 0.0, width, height).fill_nonzero();
        self.marks.iter().for_each(|mark| page.mark(mark));
        page.clip(None);
        page.file(&self.title, Rect::new(0.0, 0.0, width, height))
    }
}

fn parts(color: Rgb) -> [f32; 3] {
    color.map(|part| f32::from(part) / 255.0)
}

impl Page {
    fn fill(&mut self, color: Rgb) {
        let [red, green, blue] = parts(color);
        self.content.set_fill_rgb(red, green, blue);
    }

    fn opacity(&mut self, opacity: f64) {
        let mille = (1000.0 * opacity.clamp(0.0, 1.0)).round() as u16;
        let at = self.opacities.iter().position(|known| *known == mille).unwrap_or_else(|| {
            self.opacities.push(mille);
            self.opacities.len() - 1
        });
        self.content.set_parameters(Name(format!("G{at}").as_bytes()));
    }

    fn pen(&mut self, pen: &Pen) {
        self.opacity(pen.opacity);
        let [red, green, blue] = parts(pen.color);
        self.content.set_stroke_rgb(red, green, blue).set_line_width(pen.width as f32);
        self.content.set_line_cap(LineCapStyle::ButtCap).set_line_join(LineJoinStyle::RoundJoin);
        self.content.set_dash_pattern(pen.dashes.iter().map(|length| *length as f32), 0.0);
    }

    fn mark(&mut self, mark: &Mark) {
        match mark {
            Mark::Line(points, pen) if points.len() > 1 => {
                self.pen(pen);
                self.through(points);
                self.content.stroke();
            }
            Mark::Line(..) => {}
            Mark::Area(area, color, opacity) => {
                self.opacity(*opacity);
                self.fill(*color);
                let [x, y, width, height] = area.map(|at| at as f32);
                self.content.rect(x, y, width, height).fill_nonzero();
            }
            Mark::Polygon(corners, color, opacity) => {
                self.opacity(*opacity);
                self.fill(*color);
                self.through(corners);
                self.content.close_path().fill_nonzero();
            }
            Mark::Frame(area, pen) => {
                self.pen(pen);
                let [x, y, width, height] = area.map(|at| at as f32);
                self.content.rect(x, y, width, height).stroke();
            }
            Mark::Dot(at, radius, color) => {
                self.opacity(1.0);
                self.fill(*color);
                self.circle(*at, *radius);
                self.content.fill_nonzero();
            }
            Mark::Ring(at, radius, pen) => {
                self.pen(pen);
                self.circle(*at, *radius);
                self.content.close_and_stroke();
            }
            Mark::Image(area, pixels) => {
                self.opacity(1.0);
                let [x, y, width, height] = area.map(|at| at as f32);
                let name = format!("I{}", self.images.len());
                self.content.save_state().transform([width, 0.0, 0.0, -height, x, y + height]);
                self.content.x_object(Name(name.as_bytes())).restore_state();
                self.images.push(pixels.clone());
            }
            Mark::Words(lettering) => self.words(lettering),
            Mark::Within(area) => self.clip(*area),
        }
    }

    fn through(&mut self, points: &[[f64; 2]]) {
        for (k, [x, y]) in points.iter().map(|point| point.map(|at| at as f32)).enumerate() {
            if k == 0 {
                self.content.move_to(x, y)
            } else {
                self.content.line_to(x, y)
            };
        }
    }

    fn circle(&mut self, [x, y]: [f64; 2], radius: f64) {
        let (x, y, r) = (x as f32, y as f32, radius as f32);
        let k = QUARTER * r;
        self.content.move_to(x + r, y);
        self.content.cubic_to(x + r, y + k, x + k, y + r, x, y + r);
        self.content.cubic_to(x - k, y + r, x - r, y + k, x - r, y);
        self.content.cubic_to(x - r, y - k, x - k, y - r, x, y - r);
        self.content.cubic_to(x + k, y - r, x + r, y - k, x + r, y);
    }

    fn clip(&mut self, area: Option<[f64; 4]>) {
        if self.clipped {
            self.content.restore_state();
        }
        self.clipped = area.is_some();
        if let Some(area) = area {
            let [x, y, width, height] = area.map(|at| at as f32);
            self.content.save_state().rect(x, y, width, height).clip_nonzero().end_path();
        }
    }

    /// Writes text by glyphs. Bold text is also stroked, italic text slanted.
    fn words(&mut self, lettering: &Lettering) {
        let Lettering { words, at, beside, upwards, size, bold, color, .. } = lettering;
        let Some(font) = font() else { return };
        let [x, y] = at.map(|at| at as f32);
        let length = words.length(*size) as f32;
        let mut pen = match beside {
            TextAnchor::Right => 0.0,
            TextAnchor::Middle => -0.5 * length,
            TextAnchor::Left => -length,
        };
        self.opacity(1.0);
        self.fill(*color);
        let [red, green, blue] = parts(*color);
        self.content.set_stroke_rgb(red, green, blue).set_line_width(0.045 * *size as f32).set_dash_pattern([], 0.0);
        self.content.begin_text();
        let mode = if *bold { TextRenderingMode::FillStroke } else { TextRenderingMode::Fill };
        self.content.set_text_rendering_mode(mode);
        let (charmap, widths) = (font.charmap(), font.glyph_metrics(Size::new(1000.0), LocationRef::default()));
        for piece in words.pieces() {
            let own = piece.size(*size) as f32;
            let below = if piece.subscript { (LOWERED * size) as f32 } else { 0.0 };
            let slant = if piece.italic { SLANT as f32 } else { 0.0 };
            let matrix = match upwards {
                true => [0.0, -1.0, -1.0, -slant, x + below, y - pen],
                false => [1.0, 0.0, slant, -1.0, x + pen, y + below],
            };
            let mut text = Vec::new();
            for letter in piece.text.chars() {
                let glyph = charmap.map(letter).unwrap_or_default();
                let width = widths.advance_width(glyph).unwrap_or(0.0);
                let new = self.glyphs.remap(glyph.to_u32() as u16);
                self.letters.insert(new, (letter, width));
                text.extend(new.to_be_bytes());
                pen += width * own / 1000.0;
            }
            self.content.set_font(Name(b"F"), own).set_text_matrix(matrix).show(Str(&text));
        }
        self.content.end_text();
    }

    /// Writes the file.
    fn file(self, title: &str, area: Rect) -> Vec<u8> {
        let mut last = 0;
        let mut next = || {
            last += 1;
            Ref::new(last)
        };
        let [catalog, pages, page, content, info] = [(); 5].map(|()| next());
        let fonts = [(); 5].map(|()| next());
        let images: Vec<Ref> = self.images.iter().map(|_| next()).collect();
        let states: Vec<Ref> = self.opacities.iter().map(|_| next()).collect();
        let mut pdf = Pdf::new();
        pdf.catalog(catalog).pages(pages);
        pdf.pages(pages).kids([page]).count(1);
        pdf.document_info(info).title(TextStr(title)).producer(TextStr(env!("CARGO_PKG_NAME")));
        let mut sheet = pdf.page(page);
        sheet.parent(pages).media_box(area).contents(content);
        let mut resources = sheet.resources();
        resources.fonts().pair(Name(b"F"), fonts[0]);
        let mut objects = resources.x_objects();
        for (k, image) in images.iter().enumerate() {
            objects.pair(Name(format!("I{k}").as_bytes()), image);
        }
        objects.finish();
        let mut parameters = resources.ext_g_states();
        for (k, state) in states.iter().enumerate() {
            parameters.pair(Name(format!("G{k}").as_bytes()), state);
        }
        parameters.finish();
        resources.finish();
        sheet.finish();
        for (state, mille) in states.iter().zip(&self.opacities) {
            let opacity = f32::from(*mille) / 1000.0;
            pdf.ext_graphics(*state).non_stroking_alpha(opacity).stroking_alpha(opacity);
        }
        for (image, pixels) in images.iter().zip(&self.images) {
            let data = compress_to_vec_zlib(&pixels.rgb, LEVEL);
            let mut object = pdf.image_xobject(*image, &data);
            object.filter(Filter::FlateDecode);
            object.width(pixels.width as i32).height(pixels.height() as i32);
            object.color_space().device_rgb();
            object.bits_per_component(8).interpolate(true);
        }
        write_font(&mut pdf, fonts, &self.glyphs, &self.letters);
        let data = compress_to_vec_zlib(&self.content.finish(), LEVEL);
        pdf.stream(content, &data).filter(Filter::FlateDecode);
        pdf.finish()
    }
}

/// Writes the font with the glyphs that occur, their widths and their characters.
fn write_font(
    pdf: &mut Pdf,
    [font_ref, cid, descriptor, cmap, file]: [Ref; 5],
    glyphs: &GlyphRemapper,
    letters: &BTreeMap<u16, (char, f32)>,
) {
    let Some(font) = font() else { return };
    pdf.type0_font(font_ref)
        .base_font(FONT)
        .encoding_predefined(Name(b"Identity-H"))
        .descendant_font(cid)
        .to_unicode(cmap);
    let mut cid_font = pdf.cid_font(cid);
    cid_font.subtype(CidFontType::Type2).base_font(FONT).system_info(IDENTITY).font_descriptor(descriptor);
    cid_font.default_width(0.0).cid_to_gid_map_predefined(Name(b"Identity"));
    let width = |glyph: u16| letters.get(&glyph).map_or(0.0, |(_, width)| *width);
    cid_font.widths().consecutive(0, (0..glyphs.num_gids()).map(width));
    cid_font.finish();
    let metrics = font.metrics(Size::new(1000.0), LocationRef::default());
    let bounds = metrics.bounds.map_or([0.0, -200.0, 1000.0, 900.0], |b| [b.x_min, b.y_min, b.x_max, b.y_max]);
    pdf.font_descriptor(descriptor)
        .name(FONT)
        .flags(FontFlags::SYMBOLIC)
        .bbox(Rect::new(bounds[0], bounds[1], bounds[2], bounds[3]))
        .italic_angle(0.0)
        .ascent(metrics.ascent)
        .descent(metrics.descent)
        .cap_height(metrics.cap_height.unwrap_or(metrics.ascent))
        .stem_v(60.0)
        .font_file2(file);
    let mut characters = UnicodeCmap::new(Name(b"Custom"), IDENTITY);
    letters.iter().for_each(|(glyph, (letter, _))| characters.pair(*glyph, *letter));
    pdf.cmap(cmap, &characters.finish());
    // The font is that of the program, so that it can be reduced.
    let reduced = subset(epaint_default_fonts::UBUNTU_LIGHT, 0, glyphs).unwrap_or_default();
    let data = compress_to_vec_zlib(&reduced, LEVEL);
    let mut stream = pdf.stream(file, &data);
    stream.filter(Filter::FlateDecode);
    stream.pair(Name(b"Length1"), reduced.len() as i32);
}
