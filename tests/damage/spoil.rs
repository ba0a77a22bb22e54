//! Methods of damaging a file.

use fastrand::Rng;
use xxhash_rust::xxh3::xxh3_64;

/// Bytes before the hash, and before the payload, of a file with a checksum.
const BEFORE_HASH: usize = 20;
const HEADER: usize = 28;

/// Extreme numbers.
const NUMBERS: [&str; 12] =
    ["0", "-1", "1e308", "-1e308", "1e-300", "NaN", "inf", "-inf", "18446744073709551615", "9e99", "true", "\"x\""];

/// Returns a random element.
pub fn one<'a, T>(rng: &mut Rng, of: &'a [T]) -> &'a T {
    &of[rng.usize(..of.len())]
}

/// Returns a text with one to four changed places.
pub fn text(rng: &mut Rng, whole: &str) -> String {
    let mut bytes = whole.as_bytes().to_vec();
    for _ in 0..rng.usize(1..=4) {
        if bytes.len() < 4 {
            break;
        }
        let at = rng.usize(..bytes.len());
        let is_number = |byte: &u8| byte.is_ascii_digit() || b".-+e".contains(byte);
        let number = || {
            let from = at + bytes[at..].iter().position(u8::is_ascii_digit)?;
            let length = bytes[from..].iter().position(|byte| !is_number(byte)).unwrap_or(bytes.len() - from);
            Some(from..from + length)
        };
        match (rng.u8(..8), number()) {
            (0..4, Some(place)) => {
                let number = one(rng, &NUMBERS);
                bytes.splice(place, number.bytes());
            }
            (4, _) => bytes.truncate(at),
            (5, _) => bytes[at] = rng.u8(..),
            (6, _) => {
                let to = (at + rng.usize(1..60)).min(bytes.len());
                bytes.drain(at..to);
            }
            _ => {
                let to = (at + rng.usize(1..60)).min(bytes.len());
                let copied = bytes[at..to].to_vec();
                bytes.splice(at..at, copied);
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Returns a file with a checksum with one to three changed places of its payload, and adapted length and hash.
pub fn payload(rng: &mut Rng, whole: &[u8]) -> Vec<u8> {
    let mut bytes = whole.to_vec();
    for _ in 0..rng.usize(1..=3) {
        // Counts are at the beginning, and most of the rest are numbers.
        let end = if rng.bool() { bytes.len().min(HEADER + 600) } else { bytes.len() };
        let at = rng.usize(HEADER..end.max(HEADER + 1)).min(bytes.len() - 1);
        match rng.u8(..6) {
            0 => bytes[at] ^= 1 << rng.u8(..8),
            1 => bytes[at] = rng.u8(..),
            2 => {
                let values = [0.0, -1.0, f64::NAN, f64::INFINITY, 1e300, -1e-300, f64::from_bits(rng.u64(..))];
                let value = one(rng, &values).to_le_bytes();
                let to = (at + 8).min(bytes.len());
                bytes[at..to].copy_from_slice(&value[..to - at]);
            }
            // The largest possible length.
            3 => _ = bytes.splice(at..at + 1, [0xff; 9].into_iter().chain([1])),
            4 => bytes.truncate(at.max(HEADER + 1)),
            _ => _ = bytes.drain(at..(at + rng.usize(1..40)).min(bytes.len())),
        }
        if bytes.len() <= HEADER {
            bytes = whole.to_vec();
        }
    }
    mend(&mut bytes);
    bytes
}

/// Returns a model file with one to four changed places of its directory, with its length, that of the file and hash
/// adapted.
pub fn directory(rng: &mut Rng, whole: &[u8]) -> Vec<u8> {
    let (header, rest) = whole.split_at(HEADER);
    let (length, rest) = rest.split_first_chunk().unwrap();
    let (directory, arrays) = rest.split_at(u64::from_le_bytes(*length) as usize);
    let directory = text(rng, std::str::from_utf8(directory).unwrap());
    let length = (directory.len() as u64).to_le_bytes();
    let mut bytes = [header, &length, directory.as_bytes(), arrays].concat();
    mend(&mut bytes);
    bytes
}

fn mend(bytes: &mut [u8]) {
    let length = (bytes.len() - HEADER) as u64;
    bytes[12..BEFORE_HASH].copy_from_slice(&length.to_le_bytes());
    let all = [&bytes[..BEFORE_HASH], &bytes[HEADER..]].concat();
    bytes[BEFORE_HASH..HEADER].copy_from_slice(&xxh3_64(&all).to_le_bytes());
}
