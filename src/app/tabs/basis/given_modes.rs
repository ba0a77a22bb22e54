//! Modes of a local model whose model is an outline: a worker reads them and sends them as they are drawn.

use crate::app::answers::live::LiveSolve;
use crate::app::wake::wake;
use crate::engine::Store;
use crate::engine::job::{Background, Ending, Given, Job, JobError, Reporter, Task};
use crate::solver::reduced::{PodBasis, PressureModes, ReducedModel, Window};
use egui::Ui;
use faer::Mat;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Reads the modes of a local model.
#[derive(Serialize, Deserialize)]
pub struct ModesTask {
    model: Given,
    window: usize,
}

/// Modes of a local model, one after the other over the node array. Single precision suffices for drawing.
#[derive(Serialize, Deserialize)]
pub struct Modes {
    pressure: Vec<f32>,
    deformation: Vec<f32>,
}

impl Task for ModesTask {
    const KIND: &'static str = "modes";
    // Its worker has already read the model.
    const LANE: usize = LiveSolve::LANE;
    type Message = Modes;

    fn run(self, store: &Store, reporter: &Reporter<Modes>) -> Ending {
        let model = self.model.model(store)?;
        let window = model.windows.get(self.window).ok_or_else(|| JobError::failed("there is no such local model"))?;
        reporter.send(Modes::of(window));
        Ok(())
    }
}

impl Modes {
    /// Returns the modes of a local model.
    fn of(window: &Window) -> Self {
        let flat = |basis: &PodBasis| basis.modes.col_iter().flat_map(|mode| mode.iter().map(|v| *v as f32)).collect();
        Self { pressure: flat(window.pressure.basis()), deformation: flat(&window.deformation) }
    }
}

/// Modes of the local model on the screen.
#[derive(Default)]
pub struct GivenModes {
    of: Option<(Arc<ReducedModel>, usize)>,
    work: Background<Modes>,
    window: Option<Window>,
}

impl GivenModes {
    /// Returns the local model of an outline with its modes, once they have arrived. Draws a sentence until then.
    pub fn of(&mut self, ui: &mut Ui, store: &Store, model: &Arc<ReducedModel>, at: usize) -> Option<&Window> {
        let same = self.of.as_ref().is_some_and(|(own, window)| Arc::ptr_eq(own, model) && *window == at);
        if !same {
            let task = ModesTask { model: Given::of(model), window: at };
            (self.of, self.window) = (Some((Arc::clone(model), at)), None);
            self.work.run(Job::of("Reading modes", wake(ui.ctx()), store, task));
        }
        if self.window.is_none() {
            ui.weak(self.work.message.as_deref().unwrap_or("The modes are being read"));
        }
        self.window.as_ref()
    }

    /// Receives the modes.
    pub fn receive(&mut self) {
        let Some((model, at)) = &self.of else { return };
        let mut given = None;
        self.work.receive(|modes| given = Some(modes));
        if let (Some(modes), Some(outline)) = (given, model.windows.get(*at)) {
            self.window = Some(with_modes(outline, &modes));
        }
    }
}

/// Returns a local model of an outline with its modes.
fn with_modes(outline: &Window, modes: &Modes) -> Window {
    let nodes = outline.grid.len();
    let basis = |values: &[f32], basis: &PodBasis| PodBasis {
        modes: Mat::from_fn(nodes, basis.modes.ncols(), |node, k| {
            values.get(k * nodes + node).copied().map_or(0.0, f64::from)
        }),
        singular_values: basis.singular_values.clone(),
    };
    let pressure = basis(&modes.pressure, outline.pressure.basis());
    let deformation = basis(&modes.deformation, &outline.deformation);
    Window {
        pressure: PressureModes::own(pressure, &outline.grid),
        deformation: Arc::new(deformation),
        ..outline.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::embedded;

    #[test]
    fn modes_reach_the_local_model_of_an_outline() {
        let whole = embedded("line").unwrap();
        let window = &whole.windows[0];
        let given = with_modes(window, &Modes::of(window));
        for (own, given) in
            [(window.pressure.basis(), given.pressure.basis()), (&*window.deformation, &*given.deformation)]
        {
            let off = own.modes.col_iter().zip(given.modes.col_iter()).map(|(a, b)| (a - b).norm_l2() / a.norm_l2());
            assert!(own.modes.shape() == given.modes.shape() && off.fold(0.0, f64::max) < 1e-7);
        }
    }
}
