//! Pictures of the manual: PNG files next to its pages.

use super::plots;
use egui::{ColorImage, Context, Image, RichText, TextureHandle, TextureOptions, Ui};
use std::collections::HashMap;

#[cfg(feature = "desktop")]
macro_rules! pictures {
    ($($file:literal),* $(,)?) => {
        &[$(($file, include_bytes!(concat!("../../../assets/manual/pictures/", $file)))),*]
    };
}

/// Folder of the pictures.
const FOLDER: &str = "pictures/";

/// File names and contents. A web page leaves them out, because they would delay its first picture.
#[cfg(feature = "desktop")]
const PICTURES: &[(&str, &[u8])] = pictures![
    "bearing.png",
    "contact_map.png",
    "heat.png",
    "profiles.png",
    "regimes.png",
    "starvation.png",
    "stribeck.png",
    "surfaces.png",
    "traction.png",
    "transient.png",
];
#[cfg(not(feature = "desktop"))]
const PICTURES: &[(&str, &[u8])] = &[];

/// Reference to a picture or a plot in a page, `![caption](pictures/file)` or `![caption](plots/name)`.
pub(super) struct Reference<'a> {
    caption: &'a str,
    place: &'a str,
    /// Text after the reference.
    pub rest: &'a str,
}

/// Reads a reference whose first two characters were removed. `None` if the text is none.
pub(super) fn reference(text: &str) -> Option<Reference<'_>> {
    let (caption, after) = text.split_once("](")?;
    let (place, rest) = after.split_once(')')?;
    (place.starts_with(FOLDER) || place.starts_with(plots::FOLDER)).then_some(Reference { caption, place, rest })
}

/// Textures of the pictures that were shown. `None` for files that cannot be read.
#[derive(Default)]
pub(super) struct Pictures(HashMap<&'static str, Option<TextureHandle>>);

impl Pictures {
    /// Draws a picture with its caption.
    pub(super) fn ui(&mut self, ui: &mut Ui, reference: &Reference<'_>) {
        ui.add_space(6.0);
        let place = reference.place.strip_prefix(FOLDER);
        if let Some((file, content)) = PICTURES.iter().find(|(file, _)| Some(*file) == place) {
            let texture = self.0.entry(file).or_insert_with(|| load(ui.ctx(), file, content));
            if let Some(texture) = texture {
                let image = Image::new(&*texture).max_width(ui.available_width()).shrink_to_fit().corner_radius(3.0);
                ui.add(image.alt_text(reference.caption));
            }
        }
        plots::ui(ui, reference.place);
        ui.label(RichText::new(reference.caption).small().weak());
        ui.add_space(6.0);
    }
}

fn load(ctx: &Context, file: &str, content: &[u8]) -> Option<TextureHandle> {
    Some(ctx.load_texture(file, decoded(content)?, TextureOptions::LINEAR))
}

/// Returns the pixels of a PNG file. `None` if it is not one with 8 bits per channel, or by a palette.
fn decoded(content: &[u8]) -> Option<ColorImage> {
    let mut decoder = png::Decoder::new(std::io::Cursor::new(content));
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().ok()?;
    let mut pixels = vec![0; reader.output_buffer_size()?];
    let info = reader.next_frame(&mut pixels).ok()?;
    let size = [usize::try_from(info.width).ok()?, usize::try_from(info.height).ok()?];
    let pixels = pixels.get(..info.buffer_size())?;
    match info.color_type {
        png::ColorType::Rgb => Some(ColorImage::from_rgb(size, pixels)),
        png::ColorType::Rgba => Some(ColorImage::from_rgba_unmultiplied(size, pixels)),
        png::ColorType::Grayscale => Some(ColorImage::from_gray(size, pixels)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::manual::texts;

    #[test]
    fn every_reference_has_a_picture_and_every_picture_a_reference() {
        let mut files: Vec<&str> =
            texts().flat_map(|text| text.split("\n![").skip(1)).map(|part| reference(part).unwrap().place).collect();
        let plots = files.extract_if(.., |place| place.starts_with(plots::FOLDER)).count();
        assert_eq!(plots, 2);
        files.sort_unstable();
        let known: Vec<String> = PICTURES.iter().map(|(file, _)| format!("{FOLDER}{file}")).collect();
        assert_eq!(files, known);
    }

    #[test]
    fn pictures_are_small_and_readable() {
        for (file, content) in PICTURES {
            let image = decoded(content).unwrap_or_else(|| panic!("{file}"));
            assert!(image.width() >= 300 && image.height() >= 200, "{file}: {:?}", image.size);
            assert!(content.len() <= 80_000, "{file}: {} bytes", content.len());
        }
    }

    #[test]
    fn a_reference_is_split_from_the_text_after_it() {
        let reference = reference("A roller](pictures/a.png)\n\nText").unwrap();
        assert_eq!((reference.caption, reference.place, reference.rest), ("A roller", "pictures/a.png", "\n\nText"));
        assert!(super::reference("no picture").is_none());
    }
}
