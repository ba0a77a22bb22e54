//! Whole numbers packed by how often each of them comes, and bytes by what comes again, so that what is read takes no more
//! memory than its bytes may ask for.

use miniz_oxide::deflate::compress_to_vec;
use miniz_oxide::inflate::TINFLStatus;
use miniz_oxide::inflate::core::inflate_flags::TINFL_FLAG_USING_NON_WRAPPING_OUTPUT_BUF;
use miniz_oxide::inflate::core::{DecompressorOxide, decompress};
use pco::ChunkConfig;
use pco::data_types::Number;
use pco::standalone::{simple_compress, simple_decompress_into};
use serde::{Deserialize, Serialize};

/// Small whole numbers on their way to or from a file.
#[derive(Serialize, Deserialize)]
pub(super) enum Small {
    Packed(Vec<u8>),
    /// So few, or so alike, that packed ones could ask for much memory.
    Plain(Vec<i16>),
}

impl Small {
    /// These numbers, of which no more than `most` take a byte.
    pub fn of(numbers: Vec<i16>, most: usize) -> Self {
        packed(&numbers, &ChunkConfig::default(), most).map_or(Self::Plain(numbers), Self::Packed)
    }

    /// So many numbers; `None` where there are not as many, or more than `most` of them take a byte.
    pub fn into_numbers(self, count: usize, most: usize) -> Option<Vec<i16>> {
        match self {
            Self::Packed(packed) => unpacked(count, &packed, most),
            Self::Plain(numbers) => Some(numbers).filter(|numbers| numbers.len() == count),
        }
    }
}

/// Numbers in fewer bytes; none where these are so alike that more than `most` of them would take a byte.
pub(super) fn packed<T: Number>(numbers: &[T], settings: &ChunkConfig, most: usize) -> Option<Vec<u8>> {
    simple_compress(numbers, settings).ok().filter(|packed| numbers.len() <= most.saturating_mul(packed.len()))
}

/// So many numbers; `None` where there are not as many, or more than `most` of them take a byte.
pub(super) fn unpacked<T: Number + Default>(count: usize, packed: &[u8], most: usize) -> Option<Vec<T>> {
    if count > most.saturating_mul(packed.len()) {
        return None;
    }
    let mut numbers = vec![T::default(); count];
    let read = simple_decompress_into(packed, &mut numbers).ok()?;
    (read.finished && read.n_processed == count).then_some(numbers)
}

/// How hard repetitions are looked for, of at most ten.
const EFFORT: u8 = 10;

/// These bytes with what comes again written once, after how many they are; none where these are so alike that more than
/// `most` of them would take a byte.
pub(super) fn deflated(bytes: &[u8], most: usize) -> Option<Vec<u8>> {
    let stream = compress_to_vec(bytes, EFFORT);
    let length = u32::try_from(bytes.len()).ok().filter(|_| bytes.len() <= most.saturating_mul(stream.len()))?;
    Some([&length.to_le_bytes(), stream.as_slice()].concat())
}

/// What was deflated; `None` where it is not that, or more than `most` bytes take one.
pub(super) fn inflated(deflated: &[u8], most: usize) -> Option<Vec<u8>> {
    let (length, stream) = deflated.split_first_chunk()?;
    let length = u32::from_le_bytes(*length) as usize;
    if length > most.saturating_mul(stream.len()) {
        return None;
    }
    let mut bytes = vec![0; length];
    let mut state = Box::<DecompressorOxide>::default();
    let read = decompress(&mut state, stream, &mut bytes, 0, TINFL_FLAG_USING_NON_WRAPPING_OUTPUT_BUF);
    (read == (TINFLStatus::Done, stream.len(), length)).then_some(bytes)
}
