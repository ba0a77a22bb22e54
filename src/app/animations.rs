//! Animation of a transient run or of a slider, drawn in the background.

use super::answers::Answers;
use super::document::Document;
use super::in_use::question;
use super::purpose::{Purpose, Written};
use super::wake::wake;
use crate::app::refusal::Refusal;
use crate::engine::job::{Background, Ending, Job, Reporter, Standing, Task};
use crate::engine::{Store, Workbench};
use crate::scene::animation::{of_march, of_sweep};
use crate::scene::study::sweep::Sweep;
use crate::scene::{Axis, Grid, Method, Scene, Steps, Study};
use crate::solver::full::transient::Trajectory;
use crate::solver::parameters::Quantity;
use egui::Context;
use serde::{Deserialize, Serialize};

/// Number of contacts of an animated slider, and the range of its load relative to the present one.
const CONTACTS: usize = 61;
const LOADS: (f64, f64) = (0.2, 5.0);

/// Animation that is being drawn.
#[derive(Default)]
pub struct Animations {
    work: Background<Vec<u8>>,
}

/// Content of an animation.
#[derive(Serialize, Deserialize)]
enum Content {
    /// Full march with its fields.
    March(Box<Trajectory>),
    /// Sweep over one quantity.
    Sweep(Box<Scene>),
}

/// Animation to be drawn.
#[derive(Serialize, Deserialize)]
pub struct AnimationTask {
    content: Content,
    dark: bool,
}

impl Task for AnimationTask {
    const KIND: &'static str = "animation";
    const LANE: usize = 1;
    type Message = Vec<u8>;

    fn run(self, store: &Store, reporter: &Reporter<Vec<u8>>) -> Ending {
        let file = match &self.content {
            Content::March(march) => of_march(march, self.dark, reporter).map_err(|why| why.to_string()),
            Content::Sweep(scene) => {
                let drawn = of_sweep(scene, &mut Workbench::on(store, ""), self.dark, reporter);
                drawn.map_err(|why| why.to_string())
            }
        };
        match file {
            Ok(file) => reporter.send(file),
            Err(_) if reporter.cancelled() => {}
            Err(why) => return Err(why.into()),
        }
        Ok(())
    }
}

/// Returns the loads of a document's contact that the built-in model covers, as a study. `None` if it covers none.
pub fn loads(document: &Document, answers: &Answers) -> Option<Scene> {
    let range = answers.in_use(document)?.model.domain.m();
    let (load, m) = (document.point.load, document.point.moes().m);
    let (from, to) = (load * LOADS.0.max(range.0 / m), load * LOADS.1.min(range.1 / m));
    let values = Steps::Log { from, to, n: CONTACTS };
    let over = vec![Axis { vary: Quantity::Load, values }];
    let study = Sweep { over, methods: vec![Method::EMBEDDED], cold: false, compare_on_model_grid: false };
    (from < to).then(|| question("Load", &document.key(), Grid::Graded, Study::Sweep(study)))
}

impl Animations {
    /// Draws a full march in the theme of the window.
    pub fn march(&mut self, ctx: &Context, store: &Store, march: Trajectory) {
        self.begin(ctx, store, Content::March(Box::new(march)));
    }

    /// Draws a sweep in the theme of the window.
    pub fn sweep(&mut self, ctx: &Context, store: &Store, scene: Scene) {
        self.begin(ctx, store, Content::Sweep(Box::new(scene)));
    }

    fn begin(&mut self, ctx: &Context, store: &Store, content: Content) {
        let task = AnimationTask { content, dark: ctx.theme() == egui::Theme::Dark };
        self.work.run(Job::of("Animation", wake(ctx), store, task));
    }

    /// Returns the file when it is complete, or the reason why there is none.
    pub fn receive(&mut self) -> Option<Result<Purpose, Refusal>> {
        let mut made = None;
        self.work.receive(|file| made = Some(file));
        let made = made.map(|file| Ok(Purpose::Write(Written::Png, file.into())));
        made.or_else(|| self.work.message.take().map(|why| Err(Refusal::new(why))))
    }

    /// Returns the progress.
    pub fn standing(&self) -> Option<Standing> {
        self.work.standing()
    }

    /// Stops drawing.
    pub fn stop(&self) {
        self.work.stop();
    }
}
