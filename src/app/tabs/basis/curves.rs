//! Curves of one local model, computed once, and the settings of their display.

use super::field::Field;
use super::plane;
use crate::solver::reduced::{PodBasis, ReducedModel, Window};
use egui_plot::PlotPoint;
use std::sync::Arc;

/// Settings of the display.
#[derive(Default)]
pub struct Shown {
    /// Field whose modes are drawn.
    pub field: Field,
    /// First drawn mode, from 0.
    pub first_mode: usize,
    /// Tolerance that is being dragged.
    pub dragging: Option<Field>,
    pub curves: Option<Curves>,
}

/// Curves of a local model.
pub struct Curves {
    pub(super) window: usize,
    /// Model of a contact; `None` for a basis of a transient model.
    pub(super) model: Option<Arc<ReducedModel>>,
    pub(super) singular: [Vec<PlotPoint>; 2],
    pub(super) loss: [Vec<PlotPoint>; 2],
    pub(super) modes: Vec<(Field, usize, Vec<PlotPoint>)>,
    pub(super) plane: plane::ModeMap,
    pub(super) rows: Vec<PlotPoint>,
}

impl Curves {
    /// Returns true if they are those of a local model.
    pub(super) fn is_of(&self, model: &Arc<ReducedModel>, window: usize) -> bool {
        self.window == window && self.model.as_ref().is_some_and(|own| Arc::ptr_eq(own, model))
    }

    pub(super) fn new(model: Option<&Arc<ReducedModel>>, at: usize, window: &Window) -> Self {
        let log = |values: &mut dyn Iterator<Item = f64>, from: usize| -> Vec<PlotPoint> {
            values
                .enumerate()
                .filter(|(_, v)| *v > 1e-17)
                .map(|(k, v)| PlotPoint::new((k + from) as f64, v.log10()))
                .collect()
        };
        let singular = |basis: &PodBasis| {
            let first = basis.singular_values.first().copied().unwrap_or(1.0);
            log(&mut basis.singular_values.iter().map(|s| s / first), 1)
        };
        let loss = |basis: &PodBasis| log(&mut (1..=basis.singular_values.len()).map(|k| basis.loss(k)), 1);
        let rows = window.sampled_rows.iter().map(|row| window.grid.place(window.grid.node(*row)));
        Self {
            window: at,
            model: model.cloned(),
            singular: [singular(window.pressure.basis()), singular(&window.deformation)],
            loss: [loss(window.pressure.basis()), loss(&window.deformation)],
            modes: Vec::new(),
            plane: plane::ModeMap::default(),
            rows: rows.flat_map(mirrored).collect(),
        }
    }
}

/// Returns a place and, if it is not on the axis, its mirror image.
fn mirrored((xi, y): (f64, f64)) -> impl Iterator<Item = PlotPoint> {
    let image = (y != 0.0).then(|| PlotPoint::new(xi, -y));
    std::iter::once(PlotPoint::new(xi, y)).chain(image)
}
