//! Scalar results of a transient reduced state, such as the central and the minimum film thickness and the maximum
//! pressure. They are computed at every time step, and only from the nodes in the contact.

use crate::solver::discrete::grid::dot;
use crate::solver::discrete::space::Grid;
use crate::solver::full::transient::Conditions;
use crate::solver::full::{Scalars, under_contact};
use faer::linalg::matmul::matmul;
use faer::{Accum, ColMut, ColRef, Mat, MatRef, Par};

/// Rows of the modes at the nodes in the contact, and data to compute the scalars from them.
///
/// The positions of the minimum film thickness and of the maximum pressure are searched in single precision, which
/// halves the memory read per step. The values there and at X = 0 are computed in double precision.
pub(crate) struct ContactRows {
    /// Number of pressure modes.
    modes: usize,
    /// Nodes in the contact, in ascending order.
    nodes: Vec<usize>,
    /// X of these nodes.
    x: Vec<f64>,
    /// Contribution Y²/2 of Y to the undeformed gap.
    across: Vec<f64>,
    /// Y of the nodes.
    y: Vec<f64>,
    /// Pressure modes V at the nodes, followed by their deformations K V with the flexibility matrix K: (2 · nodes) ×
    /// modes, in single precision.
    coarse: Mat<f32>,
    /// The same in double precision, row-major.
    rows: Vec<f64>,
    /// Indices among these nodes around X = 0, with their interpolation weights.
    centre: Vec<(usize, f64)>,
    /// Work space: pressure coefficients in single precision.
    coefficients: Vec<f32>,
    /// Work space: pressures, then deformations, at the nodes.
    values: Vec<f32>,
}

impl ContactRows {
    /// Selects the rows of the nodes in the contact from `pressure` (V) and `deformation` (K V), both nodes of the grid
    /// × modes.
    pub fn new(grid: &impl Grid, pressure: MatRef<'_, f64>, deformation: MatRef<'_, f64>) -> Self {
        let (abscissae, ordinates) = grid.abscissae();
        let place = |node: &usize| (abscissae[node / ordinates.len()], ordinates[node % ordinates.len()]);
        let centre = grid.at_zero();
        // The maximum pressure lies in the region that is searched for the minimum film thickness. The nodes are the
        // unknowns in this region and those that the interpolation at X = 0 uses.
        let unknowns = (0..grid.unknowns()).map(|k| grid.node(k)).filter(|node| under_contact(place(node).0));
        let mut chosen: Vec<usize> = unknowns.chain(centre.iter().map(|(node, _)| *node)).collect();
        chosen.sort_unstable();
        chosen.dedup();
        let index = |node: usize| chosen.partition_point(|other| *other < node);
        let (nodes, modes) = (chosen.len(), pressure.ncols());
        let at = |row: usize, k: usize| match row < nodes {
            true => pressure[(chosen[row], k)],
            false => deformation[(chosen[row - nodes], k)],
        };
        Self {
            modes,
            x: chosen.iter().map(|node| place(node).0).collect(),
            y: chosen.iter().map(|node| place(node).1).collect(),
            across: chosen.iter().map(|node| 0.5 * place(node).1.powi(2)).collect(),
            coarse: Mat::from_fn(2 * nodes, modes, |row, k| at(row, k) as f32),
            rows: (0..2 * nodes).flat_map(|row| (0..modes).map(move |k| at(row, k))).collect(),
            centre: centre.iter().map(|&(node, w)| (index(node), w)).collect(),
            coefficients: vec![0.0; modes],
            values: vec![0.0; 2 * nodes],
            nodes: chosen,
        }
    }

    /// Computes the scalars from the pressure coefficients p̃ and the rigid-body separation H₀. `bend` returns a
    /// further contribution to the film thickness at a node of the grid, in addition to K V p̃. The search for the
    /// minimum film thickness neglects it.
    pub fn scalars(&mut self, at: &Conditions, coefficients: &[f64], h_0: f64, bend: impl Fn(usize) -> f64) -> Scalars {
        self.coefficients.iter_mut().zip(coefficients).for_each(|(single, c)| *single = *c as f32);
        let values = ColMut::from_slice_mut(&mut self.values);
        let single = ColRef::from_slice(&self.coefficients);
        matmul(values.as_mat_mut(), Accum::Replace, self.coarse.as_ref(), single.as_mat(), 1.0, Par::Seq);
        let nodes = self.x.len();
        let (pressures, deformations) = self.values.split_at(nodes);
        let shape = |k: usize| 0.5 * at.curvature * self.x[k] * self.x[k] + self.across[k];
        let (mut highest, mut thinnest) = ((0, f64::NEG_INFINITY), (0, f64::INFINITY));
        for (k, (&p, &d)) in pressures.iter().zip(deformations).enumerate() {
            let film = shape(k) + f64::from(d);
            if f64::from(p) > highest.1 {
                highest = (k, f64::from(p));
            }
            if film < thinnest.1 && under_contact(self.x[k]) {
                thinnest = (k, film);
            }
        }
        let (highest, thinnest) = (highest.0, thinnest.0);
        let row = |k: usize| dot(&self.rows[k * self.modes..(k + 1) * self.modes], coefficients);
        let film = |k: usize| h_0 + shape(k) + row(nodes + k) + bend(self.nodes[k]);
        Scalars {
            h_c: self.centre.iter().map(|&(k, w)| w * film(k)).sum(),
            p_c: self.centre.iter().map(|&(k, w)| w * row(k)).sum(),
            h_min: film(thinnest),
            x_h_min: self.x[thinnest],
            y_h_min: self.y[thinnest],
            p_max: row(highest),
            x_p_max: self.x[highest],
            h_0,
            ..Scalars::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::discrete::grid::{FIRST_UNKNOWN, GridSpec};
    use crate::solver::full::transient::{Frame, Input, Inputs};
    use crate::solver::full::{Problem, scalars_of};
    use crate::solver::physics::contact::OperatingPoint;
    use crate::solver::physics::lubricant::Lubricant;

    #[test]
    fn they_give_the_scalars_of_the_fields() {
        let problem = Problem::new(&OperatingPoint::TABLE_4_2, Lubricant::default()).unwrap();
        let at = Frame::Fixed.conditions(&problem, 0.0, Input { radius: 0.8, ..Inputs::default().at(0.0) }).unwrap();
        // The third grid has no node at X = 0.
        for (dx, domain) in [(0.005, (-4.0, 2.0)), (0.02, (-3.0, 1.6)), (0.017, (-3.0, 1.57))] {
            let grid = GridSpec::Uniform { dx, domain }.line().unwrap().scaled(1.0);
            let mut random = fastrand::Rng::with_seed(3);
            let modes = 7;
            let inner = FIRST_UNKNOWN..grid.len() - 1;
            let waves: Vec<f64> = (0..2 * modes).map(|_| 9.0 * random.f64()).collect();
            let hill = |x: f64| (1.0 - x * x).max(0.0).sqrt();
            let pressure = Mat::from_fn(grid.len(), modes, |i, k| {
                if inner.contains(&i) { hill(grid.x[i]) * (waves[k] * grid.x[i] + k as f64).cos() } else { 0.0 }
            });
            let bent = Mat::from_fn(grid.len(), modes, |i, k| (waves[modes + k] * grid.x[i]).sin() - grid.x[i].abs());
            let mut rows = ContactRows::new(&grid, pressure.as_ref(), bent.as_ref());
            for _ in 0..20 {
                let coefficients: Vec<f64> = (0..modes).map(|_| random.f64() - 0.3).collect();
                let h_0 = random.f64();
                let fields = |matrix: &Mat<f64>| -> Vec<f64> {
                    (0..grid.len()).map(|i| (0..modes).map(|k| matrix[(i, k)] * coefficients[k]).sum()).collect()
                };
                let p = fields(&pressure);
                let shape = |x: f64| h_0 + 0.5 * at.curvature * x * x;
                let h: Vec<f64> = fields(&bent).iter().zip(&grid.x).map(|(d, &x)| d + shape(x)).collect();
                let (own, want) =
                    (rows.scalars(&at, &coefficients, h_0, |_| 0.0), scalars_of(&grid, &at.problem, &p, &h, h_0));
                let values = |s: &Scalars| [s.h_c, s.p_c, s.h_min, s.p_max, s.x_h_min, s.x_p_max, s.h_0];
                for (own, want) in values(&own).into_iter().zip(values(&want)) {
                    assert!((own - want).abs() < 1e-12, "{own} against {want} on {} nodes", grid.len());
                }
            }
        }
    }
}
