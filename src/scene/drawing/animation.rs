//! Writes animated PNG files. All frames have the same size, and only the rectangle that changes is stored of each.

use super::Pixels;
use png::{BitDepth, BlendOp, ColorType, Compression, DisposeOp, Encoder, EncodingError};

/// Largest number of frames.
pub const MOST_FRAMES: usize = 1000;
/// Frames per second of animations.
pub const FRAMES_PER_SECOND: u16 = 20;

/// Reason why there is no animation.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AnimationError {
    /// There are too few or too many frames.
    #[error("an animation of {0} frames cannot be made; accepted are 1 to {MOST_FRAMES}")]
    Frames(usize),
    /// The frame with this number has another size than the first one.
    #[error("frame {0} has another size than the first one")]
    Size(usize),
    /// Reason why a frame cannot be drawn or encoded, as a sentence.
    #[error("{0}")]
    Drawing(String),
}

impl From<EncodingError> for AnimationError {
    fn from(error: EncodingError) -> Self {
        Self::Drawing(error.to_string())
    }
}

/// Returns an animated PNG of `count` frames that repeats for ever. `frame` draws the frame with a given number.
///
/// # Errors
/// [`AnimationError`] if the number of frames or a frame is refused.
pub fn animated(
    count: usize,
    mut frame: impl FnMut(usize) -> Result<Pixels, AnimationError>,
) -> Result<Vec<u8>, AnimationError> {
    if !(1..=MOST_FRAMES).contains(&count) {
        return Err(AnimationError::Frames(count));
    }
    let first = frame(0)?;
    let size = [first.width, first.height()];
    let [width, height] = size.map(|length| u32::try_from(length).unwrap_or(u32::MAX));
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, width, height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Balanced);
    encoder.set_animated(count as u32, 0)?;
    encoder.set_frame_delay(1, FRAMES_PER_SECOND)?;
    encoder.set_blend_op(BlendOp::Source)?;
    encoder.set_dispose_op(DisposeOp::None)?;
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&first.rgb)?;
    let mut previous = first;
    for k in 1..count {
        let next = frame(k)?;
        if [next.width, next.height()] != size {
            return Err(AnimationError::Size(k));
        }
        let [left, top, right, bottom] = changed(&previous, &next);
        writer.reset_frame_position()?;
        writer.set_frame_dimension((right - left) as u32, (bottom - top) as u32)?;
        writer.set_frame_position(left as u32, top as u32)?;
        let rows = next.rgb.chunks_exact(3 * next.width).skip(top).take(bottom - top);
        let part: Vec<u8> = rows.flat_map(|row| row.get(3 * left..3 * right).unwrap_or_default()).copied().collect();
        writer.write_image_data(&part)?;
        previous = next;
    }
    writer.finish()?;
    Ok(file)
}

/// Returns the smallest rectangle with all pixels that differ: left, top, right, bottom. Right and bottom are outside.
/// One pixel if none differs.
fn changed(previous: &Pixels, next: &Pixels) -> [usize; 4] {
    let length = 3 * next.width.max(1);
    let mut rect: Option<[usize; 4]> = None;
    let rows = previous.rgb.chunks_exact(length).zip(next.rgb.chunks_exact(length)).enumerate();
    for (row, (before, after)) in rows {
        let differs = |(a, b): (&u8, &u8)| a != b;
        let Some(first) = before.iter().zip(after).position(differs) else { continue };
        let last = before.iter().zip(after).rposition(differs).unwrap_or(first);
        let [left, right] = [first / 3, last / 3 + 1];
        rect = Some(rect.map_or([left, row, right, row + 1], |[l, t, r, _]| [l.min(left), t, r.max(right), row + 1]));
    }
    rect.unwrap_or([0, 0, 1, 1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Cursor;

    /// Returns frame `k` of a dot that moves over a plain background.
    fn dot(k: usize) -> Pixels {
        let (width, height) = (40, 20);
        let mut rgb = vec![200; 3 * width * height];
        let at = 3 * (width * (5 + k) + 2 * k);
        rgb[at..at + 3].copy_from_slice(&[250, 10, k as u8]);
        Pixels { width, rgb }
    }

    #[test]
    fn frames_are_read_back_as_they_were_drawn() {
        let count = 8;
        let file = animated(count, |k| Ok(dot(k.min(5)))).unwrap();
        let mut reader = png::Decoder::new(Cursor::new(&file)).read_info().unwrap();
        let control = reader.info().animation_control().unwrap();
        assert_eq!((control.num_frames, control.num_plays), (count as u32, 0));
        let mut screen = vec![0; 3 * 40 * 20];
        for k in 0..count {
            let mut part = vec![0; reader.output_buffer_size().unwrap()];
            reader.next_frame(&mut part).unwrap();
            let at = reader.info().frame_control().unwrap();
            let (x, y, width, height) =
                (at.x_offset as usize, at.y_offset as usize, at.width as usize, at.height as usize);
            assert_eq!((at.delay_num, at.delay_den), (1, FRAMES_PER_SECOND));
            for row in 0..height {
                let to = 3 * (40 * (y + row) + x);
                screen[to..to + 3 * width].copy_from_slice(&part[3 * width * row..3 * width * (row + 1)]);
            }
            assert_eq!(screen, dot(k.min(5)).rgb, "frame {k}");
            assert!(k == 0 || width * height < 200, "only the changed part is stored");
        }
    }

    #[test]
    fn other_sizes_and_numbers_are_refused() {
        assert_eq!(animated(0, |k| Ok(dot(k))), Err(AnimationError::Frames(0)));
        let other = |k: usize| Ok(if k == 2 { Pixels { width: 20, rgb: vec![0; 300] } } else { dot(k) });
        assert_eq!(animated(4, other), Err(AnimationError::Size(2)));
    }
}
