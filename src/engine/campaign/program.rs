//! Which program computes, and on what: results are equal to the last bit where both are.

use super::CampaignError;
use std::path::Path;
use std::sync::OnceLock;
use xxhash_rust::xxh3::xxh3_64;

/// Version of this program.
pub const PROGRAM: &str = env!("CARGO_PKG_VERSION");

/// A hash as files write it.
pub fn hash_of(bytes: &[u8]) -> String {
    format!("{:016x}", xxh3_64(bytes))
}

/// Reads a whole file of a campaign.
///
/// # Errors
/// When it cannot be read.
pub fn read(path: &Path) -> Result<Vec<u8>, CampaignError> {
    std::fs::read(path).map_err(|error| CampaignError::Read { path: path.to_owned(), reason: error.to_string() })
}

/// The hash of the program that runs: of its file, so that no two builds are taken for one.
///
/// # Errors
/// When its file cannot be read.
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

/// What sums may depend on in their last bits: the processor's way of adding several numbers at once.
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
