//! A model that is saved is the one that was read.


use ehl_explorer::engine::model_file::to_bytes;
use rayon::prelude::*;

#[test]
fn models_of_the_program_are_saved_as_they_were_read() {
    Embedded::ALL.par_iter().for_each(|which| {
        let (model, read) = (which.model().unwrap(), which.bytes());
        let saved = to_bytes(&model).unwrap();
        assert!(saved == read, "{which:?}: {} bytes were read, {} are saved", read.len(), saved.len());
    });
}
