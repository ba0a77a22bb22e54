//! Tasks that another instance of the program may send.

use crate::app::animations::AnimationTask;
use crate::app::answers::jobs::FullSolve;
use crate::app::answers::live::LiveSolve;
use crate::app::figure::ToImage;
use crate::app::reports::Solves;
use crate::app::tabs::basis::ModesTask;
use crate::app::tabs::profiles::StressTask;
use crate::app::tabs::training::TrainingTask;
use crate::app::tabs::transient::{NumberTask, OtherRuleTask};
use crate::engine::Store;
use crate::engine::job::{Asked, Performer, Replayed, Task, perform as done};

/// Performs a task of a kind. Does nothing if the kind does not exist.
pub fn perform(kind: &str, task: &[u8], store: &Store, performer: Performer) {
    macro_rules! of {
        ($($task:ty),*) => {
            match kind {
                $(<$task>::KIND => done::<$task>(task, store, performer),)*
                _ => {}
            }
        };
    }
    of!(
        LiveSolve,
        ModesTask,
        FullSolve,
        Asked,
        Replayed,
        TrainingTask,
        NumberTask,
        OtherRuleTask,
        ToImage,
        Solves,
        StressTask,
        AnimationTask
    );
}
