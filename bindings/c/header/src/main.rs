//! Writes the header `include/ehl_contact.h` of the C library from its Rust source. With `--check`, it only checks that
//! the header is up to date.

use std::error::Error;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let package = Path::new(env!("CARGO_MANIFEST_DIR")).parent().ok_or("the package lies in no folder")?;
    let config = cbindgen::Config::from_file(package.join("cbindgen.toml"))?;
    let source = package.join("src/contact.rs");
    let mut text = Vec::new();
    cbindgen::Builder::new().with_config(config).with_src(source).generate()?.write(&mut text);
    let header = package.join("include/ehl_contact.h");
    if std::env::args().any(|word| word == "--check") {
        if std::fs::read(&header)? != text {
            let run = "cargo run --manifest-path bindings/c/header/Cargo.toml";
            return Err(format!("{} is not that of the library; write it again with `{run}`", header.display()).into());
        }
        return Ok(());
    }
    Ok(std::fs::write(header, text)?)
}
