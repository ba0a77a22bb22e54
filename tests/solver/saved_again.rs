//! A model that is saved is the one that was read.
//!
//! `EHL_WRITE_MODELS=FOLDER cargo test --release --test solver saved_again` writes the models as this program saves them:
//! after a change of the format, with a reader of the previous one.

use ehl_explorer::engine::{SavedModel, catalogue, embedded, line_in_time};
use rayon::prelude::*;
use std::path::PathBuf;

#[test]
fn models_of_the_program_are_saved_as_they_were_read() {
    let folder = std::env::var_os("EHL_WRITE_MODELS").map(PathBuf::from);
    let names: Vec<&str> = catalogue().iter().map(|entry| entry.name).chain(["line_in_time"]).collect();
    names.par_iter().for_each(|name| {
        let model = match *name {
            "line_in_time" => SavedModel::InTime(line_in_time().unwrap()),
            steady => SavedModel::Stationary(embedded(steady).unwrap()),
        };
        let saved = model.to_bytes().unwrap();
        if let Some(folder) = &folder {
            std::fs::write(folder.join(format!("{name}.rom")), &saved).unwrap();
            return;
        }
        let read = std::fs::read(format!("{}/assets/{name}.rom", env!("CARGO_MANIFEST_DIR"))).unwrap();
        assert!(saved == read, "{name}: {} bytes were read, {} are saved", read.len(), saved.len());
    });
}
