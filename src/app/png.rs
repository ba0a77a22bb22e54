//! Pictures as PNG files: true colour, stored without compression, so that nothing but this page is needed to write them.

use egui::ColorImage;

/// The eight bytes every PNG file begins with.
const SIGNATURE: [u8; 8] = [0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1A, b'\n'];
/// Largest stored block of a deflate stream.
const BLOCK: usize = 0xFFFF;

/// The file of an opaque image.
pub fn encode(image: &ColorImage) -> Vec<u8> {
    let [width, height] = image.size;
    let mut rows = Vec::with_capacity(height * (3 * width + 1));
    for row in image.pixels.chunks_exact(width.max(1)) {
        // No filter.
        rows.push(0);
        rows.extend(row.iter().flat_map(|pixel| [pixel.r(), pixel.g(), pixel.b()]));
    }
    let mut header = Vec::with_capacity(13);
    header.extend((width as u32).to_be_bytes());
    header.extend((height as u32).to_be_bytes());
    // Eight bits per channel, true colour, the only compression and filter method there is, not interlaced.
    header.extend([8, 2, 0, 0, 0]);
    let mut file = SIGNATURE.to_vec();
    chunk(&mut file, *b"IHDR", &header);
    chunk(&mut file, *b"IDAT", &stored(&rows));
    chunk(&mut file, *b"IEND", &[]);
    file
}

/// A zlib stream (RFC 1950) of stored deflate blocks (RFC 1951).
fn stored(data: &[u8]) -> Vec<u8> {
    let mut out = vec![0x78, 0x01];
    let blocks = data.len().div_ceil(BLOCK).max(1);
    for k in 0..blocks {
        let block = &data[k * BLOCK..data.len().min((k + 1) * BLOCK)];
        let length = block.len() as u16;
        out.push(u8::from(k + 1 == blocks));
        out.extend(length.to_le_bytes());
        out.extend((!length).to_le_bytes());
        out.extend_from_slice(block);
    }
    out.extend(adler(data).to_be_bytes());
    out
}

fn chunk(file: &mut Vec<u8>, kind: [u8; 4], data: &[u8]) {
    file.extend((data.len() as u32).to_be_bytes());
    let start = file.len();
    file.extend(kind);
    file.extend_from_slice(data);
    let check = crc(&file[start..]);
    file.extend(check.to_be_bytes());
}

fn adler(data: &[u8]) -> u32 {
    let (mut a, mut b) = (1u32, 0u32);
    for &byte in data {
        a = (a + u32::from(byte)) % 65_521;
        b = (b + a) % 65_521;
    }
    b << 16 | a
}

fn crc(data: &[u8]) -> u32 {
    let table: [u32; 256] =
        std::array::from_fn(|n| (0..8).fold(n as u32, |c, _| if c & 1 == 1 { 0xEDB8_8320 ^ (c >> 1) } else { c >> 1 }));
    !data.iter().fold(!0u32, |c, &byte| table[((c ^ u32::from(byte)) & 0xFF) as usize] ^ (c >> 8))
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::Color32;

    #[test]
    fn checks_are_those_of_the_standards() {
        assert_eq!(crc(b"IEND"), 0xAE42_6082);
        assert_eq!(adler(b"Wikipedia"), 0x11E6_0398);
    }

    #[test]
    fn a_picture_is_wrapped_chunk_by_chunk() {
        let image = ColorImage::new([300, 100], vec![Color32::from_rgb(1, 2, 3); 30_000]);
        let file = encode(&image);
        assert_eq!(file[..8], SIGNATURE);
        assert_eq!(&file[12..16], b"IHDR");
        assert_eq!(file[16..24], [0, 0, 1, 44, 0, 0, 0, 100]);
        // Signature, header, data with two stored blocks, end.
        assert_eq!(file.len(), 8 + 25 + (12 + 2 + 100 * 901 + 2 * 5 + 4) + 12);
        assert_eq!(&file[file.len() - 8..file.len() - 4], b"IEND");
    }
}
