//! Tasks that another instance of the program may send.

use crate::app::answers::jobs::FullSolve;
use crate::engine::Store;
use crate::engine::job::{Asked, Performer, Task, perform as done};

/// Does a task of a kind; nothing where there is no such kind.
pub fn perform(kind: &str, task: &[u8], store: &Store, performer: Performer) {
    match kind {
        FullSolve::KIND => done::<FullSolve>(task, store, performer),
        Asked::KIND => done::<Asked>(task, store, performer),
        _ => {}
    }
}
