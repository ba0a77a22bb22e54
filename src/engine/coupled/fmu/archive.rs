//! Archive of a unit.

use super::description::Description;
use super::{version_2, version_3};
use crate::engine::SavedModel;
use crate::engine::archive::zip;
use crate::engine::coupled::{CoupledError, Pressed};
use std::env::consts::{ARCH, DLL_PREFIX, DLL_SUFFIX, OS};
use std::str::FromStr;

/// Model identifier and file name of the library.
pub const IDENTIFIER: &str = "ehl_contact";
/// Path of the model in the archive.
pub const MODEL: &str = "resources/model.rom";

/// Version of the standard.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FmiVersion {
    /// FMI 2.0.
    #[default]
    Two,
    /// FMI 3.0.
    Three,
}

/// A version that units are not made for.
#[derive(Debug, thiserror::Error)]
#[error("accepted are 2 and 3")]
pub struct UnknownVersion;

impl FromStr for FmiVersion {
    type Err = UnknownVersion;

    fn from_str(text: &str) -> Result<Self, UnknownVersion> {
        match text {
            "2" | "2.0" => Ok(Self::Two),
            "3" | "3.0" => Ok(Self::Three),
            _ => Err(UnknownVersion),
        }
    }
}

/// Returns the path of this system's library in the archive.
pub fn library_place(version: FmiVersion) -> String {
    let platform = match version {
        FmiVersion::Two => {
            let system = match OS {
                "windows" => "win",
                "macos" => "darwin",
                _ => "linux",
            };
            format!("{system}{}", usize::BITS)
        }
        FmiVersion::Three => platform_tuple(ARCH, OS),
    };
    // The library has no prefix in an archive.
    format!("binaries/{platform}/{IDENTIFIER}{DLL_SUFFIX}")
}

/// Returns the platform tuple of FMI 3.0: architecture and system.
pub(super) fn platform_tuple(architecture: &str, system: &str) -> String {
    let architecture = match architecture {
        "arm" => "aarch32",
        "powerpc" => "ppc32",
        "powerpc64" => "ppc64",
        own => own,
    };
    let system = if system == "macos" { "darwin" } else { system };
    format!("{architecture}-{system}")
}

/// Returns the file name of the library in cargo's output folder.
pub fn library_file() -> String {
    format!("{DLL_PREFIX}{IDENTIFIER}{DLL_SUFFIX}")
}

/// Returns the archive of a model, its file content, and the library.
///
/// # Errors
/// If the model solves no contact to start from, or if the input mode is not possible.
pub fn archive(
    model: &SavedModel,
    content: Vec<u8>,
    pressed: Pressed,
    version: FmiVersion,
    library: Vec<u8>,
) -> Result<Vec<u8>, CoupledError> {
    let description = Description::of(model, &content, pressed)?;
    let text = match version {
        FmiVersion::Two => version_2::written(&description),
        FmiVersion::Three => version_3::written(&description),
    };
    let files = [
        ("modelDescription.xml".to_owned(), text.into_bytes()),
        (MODEL.to_owned(), content),
        (library_place(version), library),
    ];
    Ok(zip(files))
}
