//! Dependence of the operators on the shape of an ellipse: deformation of the modes at the support, distances across
//! in rows and gradients, and undeformed gap.

use super::case::{Case, Start};
use super::part::{Centre, Kind, Part};
use super::sampled_system::SampledSystem;
use super::support::{Place, StateRows};
use crate::solver::discrete::reynolds::RowGeometry;
use crate::solver::physics::contact::Ellipse;
use crate::solver::reduced::model::Window;
use crate::solver::reduced::shapes::Shapes;

/// Part of the operators of a local model of elliptical contacts.
pub(super) const KIND: Kind = Kind {
    nodes: |_, _, _| {},
    make: |setting, system| {
        let SampledSystem { modes, support, geometry, basis, .. } = system;
        let shaped = Shaped::of(setting.window, (&support.nodes(), *modes), (geometry, &support.places, basis))?;
        Some(Box::new(shaped))
    },
};

/// Data for all shapes, and the current shape.
pub(super) struct Shaped {
    ellipse: Option<Ellipse>,
    /// Interpolation weights of the current shape.
    weights: Vec<f64>,
    /// K(κ) V on the support, row-major, one matrix after the other.
    flexed: Vec<Vec<f64>>,
    /// Rows of a circular contact.
    geometry: Vec<RowGeometry>,
    /// Y²/2 of the support.
    across: Vec<f64>,
    /// Gradients across for a circular contact; empty for Newtonian models.
    gradients: Vec<f64>,
}

impl Shaped {
    /// Creates the part for a local model on a support, from the rows, places and modes of a circular contact. `None`
    /// if the local model covers circular or line contacts only.
    pub fn of(
        window: &Window,
        (support, modes): (&[usize], usize),
        (geometry, places, state): (&[RowGeometry], &[Place], &StateRows),
    ) -> Option<Self> {
        let shapes = window.shapes.as_ref()?;
        let rows = |matrix: &faer::Mat<f32>| -> Vec<f64> {
            support.iter().flat_map(|&node| (0..modes).map(move |k| f64::from(matrix[(node, k)]))).collect()
        };
        Some(Self {
            ellipse: None,
            weights: vec![0.0; shapes.count()],
            flexed: shapes.flexed(&window.pressure.basis().modes).iter().map(rows).collect(),
            geometry: geometry.to_vec(),
            across: places.iter().map(|place| place.across).collect(),
            gradients: state.gradients.get(support.len() * modes..).unwrap_or_default().to_vec(),
        })
    }

    /// Sets the shape of the operators, if it differs from the current one.
    pub fn turn_to(
        &mut self,
        shapes: &Shapes,
        ellipse: &Ellipse,
        state: &mut StateRows,
        geometry: &mut [RowGeometry],
        support: &mut [Place],
    ) {
        if self.ellipse.as_ref() == Some(ellipse) {
            return;
        }
        self.ellipse = Some(*ellipse);
        self.weights = shapes.weights(ellipse);
        let size = support.len() * state.modes;
        state.deformations.fill(0.0);
        for (weight, rows) in self.weights.iter().zip(&self.flexed) {
            for (sum, value) in state.deformations.iter_mut().zip(rows) {
                *sum += weight * value;
            }
        }
        for (own, circle) in geometry.iter_mut().zip(&self.geometry) {
            *own = circle.across_by(ellipse.kappa);
        }
        for (place, across) in support.iter_mut().zip(&self.across) {
            place.across = ellipse.gap_curvature() * across;
        }
        for (own, circle) in state.gradients.iter_mut().skip(size).zip(&self.gradients) {
            *own = circle / ellipse.kappa;
        }
    }

    /// Returns the deformation by mode k at weighted nodes, for the current shape.
    fn at(&self, flexed: &[faer::Mat<f32>], nodes: &[(usize, f64)], k: usize) -> f64 {
        let of = |matrix: &faer::Mat<f32>| nodes.iter().map(|(node, w)| w * f64::from(matrix[(*node, k)])).sum::<f64>();
        self.weights.iter().zip(flexed).map(|(weight, matrix)| weight * of(matrix)).sum()
    }
}

impl Part for Shaped {
    fn begin(&mut self, system: &mut SampledSystem, case: &Case<'_>, start: &Start<'_>) {
        let SampledSystem { basis, geometry, support, .. } = system;
        if let Some(shapes) = &start.window.shapes {
            self.turn_to(shapes, &case.problem.point.ellipse(), basis, geometry, &mut support.places);
        }
    }

    fn aim(&mut self, system: &mut SampledSystem, at: Centre<'_>) {
        if let Some(shapes) = &at.window.shapes {
            let flexed = shapes.flexed(&at.window.pressure.basis().modes);
            system.lift.iter_mut().enumerate().for_each(|(k, lift)| *lift = self.at(flexed, at.nodes, k));
        }
    }
}
