//! Animation of a transient run, drawn in the background.

use crate::app::wake::wake;
use crate::engine::Store;
use crate::engine::job::{Background, Ending, Job, Reporter, Standing, Task};
use crate::scene::animation::of_march;
use crate::solver::full::transient::Trajectory;
use egui::Context;
use serde::{Deserialize, Serialize};

/// Animation that is being drawn, or that waits for its file name.
#[derive(Default)]
pub struct Animation {
    work: Background<Vec<u8>>,
    made: Option<Vec<u8>>,
}

/// Run to be drawn.
#[derive(Serialize, Deserialize)]
pub struct AnimationTask {
    march: Trajectory,
    dark: bool,
}

impl Task for AnimationTask {
    const KIND: &'static str = "animation";
    const LANE: usize = 1;
    type Message = Vec<u8>;

    fn run(self, _store: &Store, reporter: &Reporter<Vec<u8>>) -> Ending {
        reporter.send(of_march(&self.march, self.dark, reporter).map_err(|why| why.to_string())?);
        Ok(())
    }
}

impl Animation {
    /// Starts to draw a run in the theme of the window.
    pub fn start(&mut self, ctx: &Context, store: &Store, march: Trajectory) {
        let dark = ctx.theme() == egui::Theme::Dark;
        self.work.run(Job::of("Drawing the animation", wake(ctx), store, AnimationTask { march, dark }));
    }

    /// Receives the file since the last frame.
    pub fn receive(&mut self) {
        let made = &mut self.made;
        self.work.receive(|file| *made = Some(file));
    }

    /// Returns the file when it is complete, once.
    pub fn take(&mut self) -> Option<Vec<u8>> {
        self.made.take()
    }

    /// Returns the progress.
    pub fn standing(&self) -> Option<Standing> {
        self.work.standing()
    }

    /// Returns why the last animation failed.
    pub fn message(&self) -> Option<&str> {
        self.work.message.as_deref()
    }

    /// Stops drawing.
    pub fn stop(&self) {
        self.work.stop();
    }
}
