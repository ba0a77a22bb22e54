//! Pictures as PNG files.

use egui::ColorImage;
use png::{BitDepth, ColorType, Compression, Encoder, EncodingError};

/// The file of an opaque image, in true colour; empty where the image is.
pub fn encode(image: &ColorImage) -> Vec<u8> {
    // Memory can always be written: only an image without pixels is refused.
    written(image).unwrap_or_default()
}

fn written(image: &ColorImage) -> Result<Vec<u8>, EncodingError> {
    let [width, height] = image.size.map(|pixels| u32::try_from(pixels).unwrap_or(u32::MAX));
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, width, height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Fast);
    let pixels: Vec<u8> = image.pixels.iter().flat_map(|pixel| [pixel.r(), pixel.g(), pixel.b()]).collect();
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&pixels)?;
    writer.finish()?;
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::Color32;

    #[test]
    fn a_picture_reads_back_as_it_was() {
        let image = ColorImage::new([300, 100], vec![Color32::from_rgb(1, 2, 3); 30_000]);
        let file = encode(&image);
        let mut reader = png::Decoder::new(std::io::Cursor::new(&file)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        assert_eq!((info.width, info.height, info.color_type), (300, 100, ColorType::Rgb));
        assert!(pixels.len() == 90_000 && pixels.chunks(3).all(|pixel| pixel == [1, 2, 3]));
        assert!(encode(&ColorImage::new([0, 0], Vec::new())).is_empty());
    }
}
