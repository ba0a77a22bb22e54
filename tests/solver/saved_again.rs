//! A model that is saved is the one that was read.

use ehl_explorer::engine::model_file::{from_bytes, to_bytes};
use ehl_explorer::engine::{catalogue, embedded};
use rayon::prelude::*;

#[test]
fn models_of_the_program_are_saved_as_they_were_read() {
    catalogue().par_iter().for_each(|entry| {
        let name = &entry.name;
        // As the present version keeps it: the file may be of a former one.
        let read = to_bytes(&embedded(name).unwrap()).unwrap();
        let saved = to_bytes(&from_bytes(&read).unwrap()).unwrap();
        assert!(saved == read, "{name}: {} bytes were read, {} are saved", read.len(), saved.len());
    });
}
