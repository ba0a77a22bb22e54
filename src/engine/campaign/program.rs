//! Identifies the program and the processor. Results are bitwise equal if both are the same.

use super::CampaignError;
use std::path::Path;
use std::sync::OnceLock;
use xxhash_rust::xxh3::xxh3_64;

/// Version of this program.
pub const PROGRAM: &str = env!("CARGO_PKG_VERSION");

/// Returns a hash as written in files.
pub fn hash_of(bytes: &[u8]) -> String {
    format!("{:016x}", xxh3_64(bytes))
}

/// Reads a whole file of a campaign.
///
/// # Errors
/// If it cannot be read.
pub fn read(path: &Path) -> Result<Vec<u8>, CampaignError> {
    std::fs::read(path).map_err(|error| CampaignError::Read { path: path.to_owned(), reason: error.to_string() })
}

/// Returns the hash of the running program's file, which distinguishes different builds.
///
/// # Errors
/// If the file cannot be read.
pub fn own_hash() -> Result<&'static str, CampaignError> {
    static HASH: OnceLock<String> = OnceLock::new();
    if let Some(hash) = HASH.get() {
        return Ok(hash);
    }
    let path = std::env::current_exe()
        .map_err(|error| CampaignError::Read { path: "the program's own file".into(), reason: error.to_string() })?;
    let hash = hash_of(&read(&path)?);
    Ok(HASH.get_or_init(|| hash))
}

/// Returns the processor features that affect the rounding of sums (vector instructions).
pub fn processor() -> String {
    #[cfg(target_arch = "x86_64")]
    let features = [
        ("avx2", is_x86_feature_detected!("avx2")),
        ("fma", is_x86_feature_detected!("fma")),
        ("avx512f", is_x86_feature_detected!("avx512f")),
    ];
    #[cfg(not(target_arch = "x86_64"))]
    let features: [(&str, bool); 0] = [];
    let there = features.into_iter().filter(|(_, there)| *there).map(|(name, _)| name);
    std::iter::once(std::env::consts::ARCH).chain(there).collect::<Vec<_>>().join(" ")
}
