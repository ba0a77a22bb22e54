//! A model that is saved is the one that was read.
//!
//! `EHL_WRITE_MODELS=FOLDER cargo test --release --test solver saved_again` writes the models as this program saves them:
//! after a change of the format, with a reader of the previous one.

use ehl_explorer::engine::{Embedded, SavedModel, line_in_time};
use rayon::prelude::*;
use std::path::PathBuf;

const FILES: [&str; 12] = [
    "line",
    "line_shear",
    "point",
    "point_light",
    "point_shear",
    "ellipse",
    "line_heat",
    "point_heat",
    "line_sliding",
    "point_sliding",
    "point_light_sliding",
    "line_in_time",
];

#[test]
fn models_of_the_program_are_saved_as_they_were_read() {
    let folder = std::env::var_os("EHL_WRITE_MODELS").map(PathBuf::from);
    let steady = Embedded::ALL.par_iter().map(|which| SavedModel::Stationary(which.model().unwrap()));
    let transient = rayon::iter::once(()).map(|()| SavedModel::InTime(line_in_time().unwrap()));
    steady.chain(transient).zip(FILES).for_each(|(model, name)| {
        let saved = model.to_bytes().unwrap();
        if let Some(folder) = &folder {
            std::fs::write(folder.join(format!("{name}.rom")), &saved).unwrap();
            return;
        }
        let read = std::fs::read(format!("{}/assets/{name}.rom", env!("CARGO_MANIFEST_DIR"))).unwrap();
        assert!(saved == read, "{name}: {} bytes were read, {} are saved", read.len(), saved.len());
    });
}
