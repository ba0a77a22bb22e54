//! Elastic deformation Δ = K P of the half-space under a pressure P that is constant on rectangles, and under its
//! mirror image, (2.38).
//!
//! Along X the nodes are equidistant and the flexibility matrix K is Toeplitz. It is applied by zero-padded FFT. Across
//! there are few nodes, so each frequency has a small dense matrix that includes the mirror image at Y = 0. This costs
//! as much as a second FFT over the mirrored domain, halves the number of transforms, and allows any spacing across.

use super::convolution::{Convolution, KernelError};
use crate::host::pool::{self, computed, on_all_cores};
use crate::solver::physics::contact::Ellipse;
use rayon::prelude::*;
use realfft::num_complex::Complex64;
use std::sync::OnceLock;

/// Kernel of a half domain: deformation of every node by the pressure on every cell and on its mirror image.
#[derive(Clone)]
pub struct PointFlexibility {
    nx: usize,
    ny: usize,
    hx: f64,
    /// Kernel factor c_K; (2/π²) for a circular contact.
    factor: f64,
    /// Ordinates of the nodes.
    y: Vec<f64>,
    /// Upper edge of each node's cell; 0 on the axis.
    edges: Vec<f64>,
    /// One matrix per frequency with n_y rows and n_y − 1 columns (cell j + 1), column by column. It is real, since K
    /// is even in X.
    spectrum: OnceLock<Vec<f64>>,
    convolution: Convolution,
    /// [`Self::column_block`] of every distance, stored at the first request.
    blocks: OnceLock<Vec<Vec<f64>>>,
}

impl std::fmt::Debug for PointFlexibility {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "PointFlexibility({}×{})", self.nx, self.ny)
    }
}

/// Buffers of the fast convolution. They grow on first use; later calls allocate nothing.
#[derive(Default, Clone, Debug)]
pub struct PointScratch {
    /// One padded signal along X per ordinate.
    real: Vec<f64>,
    /// One spectrum per ordinate.
    pressure: Vec<Complex64>,
    /// Spectra of the deformation at all ordinates, frequency by frequency.
    deformation: Vec<Complex64>,
    /// Work space of the transforms, one per ordinate.
    work: Vec<Complex64>,
}

/// Returns the deformation at distance (x, y) from the centre of a rectangle of size `hx` × `hy` under unit pressure,
/// (2.40): (2/π²) ∫∫ dX dY / r in closed form.
pub fn rectangle_kernel(x: f64, y: f64, hx: f64, hy: f64) -> f64 {
    let factor = Ellipse::CIRCLE.kernel_factor();
    strip(x, y + 0.5 * hy, hx, factor) - strip(x, y - 0.5 * hy, hx, factor)
}

/// Returns `factor` times the integral of 1/r over a strip: of width `hx` around x, and from 0 to v across. Odd in v.
fn strip(x: f64, v: f64, hx: f64, factor: f64) -> f64 {
    factor * (corner(x + 0.5 * hx, v) - corner(x - 0.5 * hx, v))
}

/// Returns the integral of 1/r from (0, 0) to (u, v), odd in both. The form u asinh(v/|u|) + v asinh(u/|v|) differs
/// from the usual u ln(v + r) + v ln(u + r) by terms that cancel between the corners of a rectangle.
fn corner(u: f64, v: f64) -> f64 {
    let along = if u == 0.0 { 0.0 } else { u * (v / u.abs()).asinh() };
    let across = if v == 0.0 { 0.0 } else { v * (u / v.abs()).asinh() };
    along + across
}

/// All strips that the kernel consists of, each integrated once. Equidistant ordinates use the same strips repeatedly.
struct Strips {
    /// Heights v ≥ 0 of the strips, ascending.
    heights: Vec<f64>,
    /// Number of integrals per height: around x = 0, hx, 2hx …
    columns: usize,
    values: Vec<f64>,
}

impl Strips {
    /// Heights that differ by less than this differ only by rounding.
    const SAME: f64 = 1e-13;

    fn new(PointFlexibility { nx, hx, factor, y, edges, .. }: &PointFlexibility) -> Self {
        let columns = nx - 1;
        let both = |&y: &f64| edges.iter().flat_map(move |edge| [(y - edge).abs(), (y + edge).abs()]);
        let mut heights: Vec<f64> = y.iter().flat_map(both).collect();
        heights.sort_unstable_by(f64::total_cmp);
        heights.dedup_by(|next, kept| *next - *kept <= Self::SAME);
        let mut values = vec![0.0; heights.len() * columns];
        pool::each_chunk(&mut values, columns, 1, |place, values| {
            let v = heights[place];
            // The corner before the first strip is the mirrored corner behind it.
            let mut before = -corner(0.5 * hx, v);
            for (d, value) in values.iter_mut().enumerate() {
                let behind = corner((d as f64 + 0.5) * hx, v);
                *value = factor * (behind - before);
                before = behind;
            }
        });
        Self { heights, columns, values }
    }

    /// Returns the sign of v and the integrals of the strips from 0 to |v|.
    fn up_to(&self, v: f64) -> (f64, &[f64]) {
        let place = self.heights.partition_point(|height| *height < v.abs() - Self::SAME);
        (v.signum(), &self.values[place * self.columns..(place + 1) * self.columns])
    }
}

impl PointFlexibility {
    /// Builds the kernel `factor` ∬ 1/r. Along X there are `nx` nodes with spacing `hx`; both end nodes carry no
    /// pressure. Across, the nodes lie at the ordinates `y`, and `edges` holds the upper edge of each node's cell;
    /// the first node carries no pressure. All lengths are in units of the half-width a.
    ///
    /// # Errors
    /// [`KernelError`] if the kernel cannot be transformed.
    pub fn new(hx: f64, nx: usize, y: &[f64], edges: &[f64], factor: f64) -> Result<Self, KernelError> {
        let kernel = Self::later(hx, nx, y, edges, factor);
        let spectrum = OnceLock::from(kernel.transformed()?);
        Ok(Self { spectrum, ..kernel })
    }

    /// As [`Self::new`], but transforms the kernel when it is first used.
    pub fn later(hx: f64, nx: usize, y: &[f64], edges: &[f64], factor: f64) -> Self {
        let (ny, convolution) = (y.len(), Convolution::new(2 * nx - 3));
        let (y, edges) = (y.to_vec(), edges.to_vec());
        let (spectrum, blocks) = (OnceLock::new(), OnceLock::new());
        Self { nx, ny, hx, factor, y, edges, spectrum, convolution, blocks }
    }

    /// Returns the transformed kernel.
    fn spectrum(&self) -> &[f64] {
        // A transform fails only if a signal has the wrong length.
        let spectrum: &Vec<f64> = computed(&self.spectrum, || {
            let length = self.convolution.frequencies() * self.ny * (self.ny - 1);
            self.transformed().unwrap_or_else(|_| vec![f64::NAN; length])
        });
        spectrum
    }

    fn transformed(&self) -> Result<Vec<f64>, KernelError> {
        let (kernel, nx, ny, m) = (self, self.nx, self.ny, self.ny - 1);
        let (length, frequencies) = (self.convolution.len(), self.convolution.frequencies());
        let strips = Strips::new(kernel);
        // Spectra of the kernels of one ordinate j with respect to all cells, in parallel over j.
        let row = |j: usize| {
            let mut out = vec![0.0; frequencies * m];
            let mut circular = vec![0.0; length * m];
            let at = |v: f64| strips.up_to(v);
            let y = kernel.y[j];
            for (signal, edges) in circular.chunks_exact_mut(length).zip(kernel.edges.windows(2)) {
                let (lower, upper) = (at(y - edges[0]), at(y - edges[1]));
                let (mirror_lower, mirror_upper) = (at(y + edges[0]), at(y + edges[1]));
                for d in 0..nx - 1 {
                    let near = lower.0 * lower.1[d] - upper.0 * upper.1[d];
                    let value = near + (mirror_upper.0 * mirror_upper.1[d] - mirror_lower.0 * mirror_lower.1[d]);
                    (signal[d], signal[(length - d) % length]) = (value, value);
                }
            }
            for (cell, signal) in circular.chunks_exact_mut(length).enumerate() {
                for (k, value) in kernel.convolution.kernel(signal)?.into_iter().enumerate() {
                    out[k * m + cell] = value;
                }
            }
            Ok(out)
        };
        let rows = on_all_cores(|| (0..ny).into_par_iter().map(row).collect::<Result<Vec<Vec<f64>>, KernelError>>())?;
        let mut spectrum = vec![0.0; frequencies * ny * m];
        pool::each_chunk(&mut spectrum, ny * m, 1, |k, matrix| {
            for (cell, column) in matrix.chunks_exact_mut(ny).enumerate() {
                for (value, row) in column.iter_mut().zip(&rows) {
                    *value = row[k * m + cell];
                }
            }
        });
        Ok(spectrum)
    }

    /// Passes to `put` the deformation of a node at ordinate `j` by unit pressure on each cell and its mirror image,
    /// `d` columns away. Cell c belongs to ordinate c + 1.
    fn row_entries(&self, d: usize, j: usize, mut put: impl FnMut(usize, f64)) {
        let (x, y) = (d as f64 * self.hx, self.y[j]);
        let near = |edge: f64| strip(x, y - edge, self.hx, self.factor);
        let mirror = |edge: f64| strip(x, y + edge, self.hx, self.factor);
        let (mut near_lower, mut mirror_lower) = (near(self.edges[0]), mirror(self.edges[0]));
        for (cell, &edge) in self.edges[1..].iter().enumerate() {
            let (near_upper, mirror_upper) = (near(edge), mirror(edge));
            put(cell, (near_lower - near_upper) + (mirror_upper - mirror_lower));
            (near_lower, mirror_lower) = (near_upper, mirror_upper);
        }
    }

    /// Returns the deformations of all ordinates by the cells of all unknowns, `d` columns away. The matrix has n_y
    /// rows and n_y − 1 columns, column by column. The preconditioner uses it for small d.
    pub fn column_block(&self, d: usize) -> Vec<f64> {
        let mut block = vec![0.0; self.ny * (self.ny - 1)];
        for j in 0..self.ny {
            self.row_entries(d, j, |cell, value| block[cell * self.ny + j] = value);
        }
        block
    }

    /// Returns [`Self::column_block`] of every distance. The blocks are computed once, because single calls of
    /// [`Self::entry`] for many entries take longer.
    pub fn column_blocks(&self) -> &[Vec<f64>] {
        if let Some(blocks) = self.blocks.get() {
            return blocks;
        }
        // Computed before it is stored: a waiting thread may enter this function again while it shares work.
        let blocks = on_all_cores(|| (0..self.nx).into_par_iter().map(|d| self.column_block(d)).collect());
        self.blocks.get_or_init(|| blocks)
    }

    /// Returns one entry of K: the deformation of `node` by unit pressure at `other`. Both are indices of node arrays.
    pub fn entry(&self, node: usize, other: usize) -> f64 {
        let (i, j) = (node / self.ny, node % self.ny);
        let (k, l) = (other / self.ny, other % self.ny);
        if l == 0 || k == 0 || k + 1 == self.nx {
            return 0.0;
        }
        let (x, y) = (i.abs_diff(k) as f64 * self.hx, self.y[j]);
        let (lower, upper) = (self.edges[l - 1], self.edges[l]);
        let at = |v: f64| strip(x, v, self.hx, self.factor);
        (at(y - lower) - at(y - upper)) + (at(y + upper) - at(y + lower))
    }

    /// Computes Δ = K P; both slices are node arrays.
    pub fn apply(&self, pressure: &[f64], deformation: &mut [f64], scratch: &mut PointScratch) {
        on_all_cores(|| self.apply_in_pool(pressure, deformation, scratch));
    }

    fn apply_in_pool(&self, pressure: &[f64], deformation: &mut [f64], scratch: &mut PointScratch) {
        let (nx, ny, m) = (self.nx, self.ny, self.ny - 1);
        let (length, frequencies) = (self.convolution.len(), self.convolution.frequencies());
        let needed = self.convolution.work();
        scratch.real.resize(ny * length, 0.0);
        scratch.pressure.resize(ny * frequencies, Complex64::default());
        scratch.deformation.resize(ny * frequencies, Complex64::default());
        scratch.work.resize(ny * needed, Complex64::default());
        let (share, matrices) = (ny.div_ceil(4).max(8), self.spectrum());
        let PointScratch { real, pressure: spectra, deformation: deformed, work } = scratch;
        real.par_chunks_exact_mut(length)
            .zip(spectra.par_chunks_exact_mut(frequencies))
            .zip(work.par_chunks_exact_mut(needed))
            .enumerate()
            .skip(1)
            .with_min_len(share)
            .for_each(|(j, ((signal, spectrum), work))| {
                for (i, value) in signal[1..nx - 1].iter_mut().enumerate() {
                    *value = pressure[(i + 1) * ny + j];
                }
                signal[0] = 0.0;
                signal[nx - 1..].fill(0.0);
                self.convolution.forward(signal, spectrum, work);
            });
        let spectra = &*spectra;
        deformed
            .par_chunks_exact_mut(ny)
            .zip(matrices.par_chunks_exact(ny * m))
            .enumerate()
            .with_min_len(frequencies.div_ceil(4))
            .for_each(|(k, (out, matrix))| {
                out.fill(Complex64::default());
                let value = |cell: usize| spectra[(cell + 1) * frequencies + k];
                // Four cells at once: the sums are read and written a quarter as often.
                let mut cell = 0;
                let mut fours = matrix.chunks_exact(4 * ny);
                for four in fours.by_ref() {
                    let values = [0, 1, 2, 3].map(|next| value(cell + next));
                    let (a, b) = four.split_at(2 * ny);
                    let ((a, b), (c, d)) = (a.split_at(ny), b.split_at(ny));
                    for ((((out, a), b), c), d) in out.iter_mut().zip(a).zip(b).zip(c).zip(d) {
                        let (mut re, mut im) = (out.re, out.im);
                        for (kernel, value) in [a, b, c, d].into_iter().zip(&values) {
                            re += kernel * value.re;
                            im += kernel * value.im;
                        }
                        (out.re, out.im) = (re, im);
                    }
                    cell += 4;
                }
                for (next, column) in fours.remainder().chunks_exact(ny).enumerate() {
                    let value = value(cell + next);
                    for (out, &kernel) in out.iter_mut().zip(column) {
                        out.re += kernel * value.re;
                        out.im += kernel * value.im;
                    }
                }
            });
        let deformed = &*deformed;
        real.par_chunks_exact_mut(length)
            .zip(scratch.pressure.par_chunks_exact_mut(frequencies))
            .zip(work.par_chunks_exact_mut(needed))
            .enumerate()
            .with_min_len(share)
            .for_each(|(j, ((signal, spectrum), work))| {
                for (k, value) in spectrum.iter_mut().enumerate() {
                    *value = deformed[k * ny + j];
                }
                self.convolution.inverse(spectrum, signal, work);
            });
        for (i, column) in deformation.chunks_exact_mut(ny).enumerate() {
            for (j, value) in column.iter_mut().enumerate() {
                *value = real[j * length + i];
            }
        }
    }

    /// Computes Kᵀ V for the node array V. The result is zero at nodes without pressure.
    pub fn apply_transposed(&self, values: &[f64], out: &mut [f64], scratch: &mut PointScratch) {
        let (nx, ny, m) = (self.nx, self.ny, self.ny - 1);
        let (length, frequencies) = (self.convolution.len(), self.convolution.frequencies());
        let PointScratch { real, pressure: spectra, deformation: folded, work } = scratch;
        real.resize(ny * length, 0.0);
        spectra.resize(ny * frequencies, Complex64::default());
        folded.resize(ny * frequencies, Complex64::default());
        work.resize(ny * self.convolution.work(), Complex64::default());
        let work = &mut work[..self.convolution.work()];
        for (j, (signal, spectrum)) in
            real.chunks_exact_mut(length).zip(spectra.chunks_exact_mut(frequencies)).enumerate()
        {
            signal.fill(0.0);
            signal[..nx].iter_mut().enumerate().for_each(|(i, value)| *value = values[i * ny + j]);
            self.convolution.forward(signal, spectrum, work);
        }
        for (k, matrix) in self.spectrum().chunks_exact(ny * m).enumerate() {
            for (cell, column) in matrix.chunks_exact(ny).enumerate() {
                let products = column.iter().enumerate().map(|(j, kernel)| kernel * spectra[j * frequencies + k]);
                folded[cell * frequencies + k] = products.sum();
            }
        }
        out.fill(0.0);
        let signal = &mut real[..length];
        for (cell, spectrum) in folded.chunks_exact_mut(frequencies).take(m).enumerate() {
            self.convolution.inverse(spectrum, signal, work);
            (1..nx - 1).for_each(|i| out[i * ny + cell + 1] = signal[i]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::discrete::grid::PointGridSpec;
    use std::f64::consts::PI;

    /// ∫∫ 1/r over a rectangle by a composite midpoint rule, accurate to 1e-5.
    fn quadrature(x: f64, y: f64, hx: f64, hy: f64) -> f64 {
        let n = 1000;
        let mut sum = 0.0;
        for i in 0..n {
            for j in 0..n {
                let u = x - hx * ((f64::from(i) + 0.5) / f64::from(n) - 0.5);
                let v = y - hy * ((f64::from(j) + 0.5) / f64::from(n) - 0.5);
                sum += 1.0 / u.hypot(v);
            }
        }
        2.0 / (PI * PI) * sum * hx * hy / f64::from(n * n)
    }

    #[test]
    fn the_rectangle_kernel_agrees_with_quadrature() {
        for (x, y) in [(0.0, 0.0), (0.02, 0.0), (0.0, 0.05), (0.06, -0.1), (0.3, 0.2), (4.0, 1.0)] {
            let (got, want) = (rectangle_kernel(x, y, 0.02, 0.05), quadrature(x, y, 0.02, 0.05));
            assert!((got / want - 1.0).abs() < 2e-3 * (-20.0 * f64::hypot(x, y)).exp() + 2e-6, "{x} {y}: {got} {want}");
        }
    }

    #[test]
    fn the_fast_convolution_is_the_direct_sum_with_mirror() {
        for refinement in [1.0, 2.5] {
            direct_sum(PointGridSpec { refinement, ..PointGridSpec::uniform(0.1, 0.2, (-2.0, 1.5, -1.4)) });
        }
    }

    fn direct_sum(spec: PointGridSpec) {
        let grid = spec.build().unwrap();
        let n = grid.len();
        let p: Vec<f64> =
            (0..n).map(|k| if grid.weights[k] > 0.0 { (k * 37 % 19) as f64 / 19.0 } else { 0.0 }).collect();
        let (mut fast, mut scratch) = (vec![0.0; n], PointScratch::default());
        for _ in 0..2 {
            grid.deform(&p, &mut fast, &mut scratch);
        }
        let (ny, block) = (grid.ny(), grid.flexibility.column_block(3));
        for (a, fast) in fast.iter().enumerate() {
            let direct: f64 = (0..n).map(|b| grid.flexibility.entry(a, b) * p[b]).sum();
            assert!((fast - direct).abs() < 1e-12, "{a}: {fast} against {direct}");
        }
        let values: Vec<f64> = (0..n).map(|k| (k * 53 % 23) as f64 / 23.0).collect();
        grid.flexibility.apply_transposed(&values, &mut fast, &mut scratch);
        for (b, fast) in fast.iter().enumerate() {
            let direct: f64 = (0..n).map(|a| grid.flexibility.entry(a, b) * values[a]).sum();
            assert!((fast - direct).abs() < 1e-12, "transposed, {b}: {fast} against {direct}");
        }
        for j in 0..ny {
            for l in 1..ny {
                let entry = grid.flexibility.entry(5 * ny + j, 8 * ny + l);
                assert!((block[(l - 1) * ny + j] - entry).abs() < 1e-15);
                if spec.refinement != 1.0 {
                    continue;
                }
                let mirrored = |y: f64| rectangle_kernel(0.3, grid.y[j] - y, 0.1, 0.2);
                let expected = if l + 1 == ny { mirrored(0.0) } else { mirrored(grid.y[l]) + mirrored(-grid.y[l]) };
                assert!((entry - expected).abs() < 1e-14, "{j} {l}");
            }
        }
    }

    #[test]
    fn hertz_pressure_gives_the_known_gap() {
        let uniform = PointGridSpec::uniform(0.02, 0.025, (-2.5, 2.0, -2.0));
        for refinement in [1.0, 3.0] {
            hertz_gap(PointGridSpec { refinement, ..uniform });
        }
    }

    fn hertz_gap(spec: PointGridSpec) {
        let grid = spec.build().unwrap();
        let ny = grid.ny();
        let at = |node: usize| (grid.x[node / ny], grid.y[node % ny]);
        let p: Vec<f64> = (0..grid.len()).map(|k| (1.0 - at(k).0.powi(2) - at(k).1.powi(2)).max(0.0).sqrt()).collect();
        let mut deformation = vec![0.0; grid.len()];
        grid.deform(&p, &mut deformation, &mut PointScratch::default());
        for (node, got) in deformation.iter().enumerate() {
            let (x, y) = at(node);
            let r = x.hypot(y);
            // Hertz: 1 − r²/2 inside the contact, (1/π)((2 − r²) asin(1/r) + √(r² − 1)) outside.
            let want = if r <= 1.0 {
                1.0 - 0.5 * r * r
            } else {
                ((2.0 - r * r) * (1.0 / r).asin() + (r * r - 1.0).sqrt()) / PI
            };
            assert!((got - want).abs() < 2e-3, "{x} {y}: {got} against {want}");
        }
    }
}
