//! Stress field in the plane Y = 0 below a load on uniform nodes.

use super::mode::Mode;
use super::stress::Stress;
use crate::host::pool;
use crate::solver::discrete::elasticity::{Convolution, KernelError};
use realfft::num_complex::Complex64;
use std::f64::consts::PI;

/// Product of wave number and depth beyond which a component has decayed.
const DECAYED: f64 = 36.0;

/// Pressure and shear traction on uniform nodes of the surface, in any unit of stress. Lengths are in any one unit.
///
/// Node (i, j) has the index j·n_x + i and lies at X = `first` + i·`spacing[0]`, Y = −j·`spacing[1]`. The load is even
/// in Y. A line contact has one line of nodes, j = 0.
#[derive(Clone, Debug)]
pub struct SurfaceLoad {
    /// Number of nodes along X, n_x.
    pub columns: usize,
    /// Spacings along X and across.
    pub spacing: [f64; 2],
    /// Pressure p.
    pub pressure: Vec<f64>,
    /// Shear traction q in the direction +X on the half-space; empty without traction.
    pub traction: Vec<f64>,
    /// Lengths of the periodic surface along X and across, at least those of the nodes.
    pub period: [f64; 2],
}

/// Spectrum of a load: rows over k_y ≥ 0 for every k_x ≥ 0.
struct Spectrum {
    pressure: Vec<Complex64>,
    traction: Vec<Complex64>,
}

/// Transforms along X and, of a plane, across.
struct Transforms {
    along: Convolution,
    across: Option<Convolution>,
}

impl Transforms {
    /// Number of wave numbers k_y ≥ 0.
    fn rows(&self) -> usize {
        self.across.as_ref().map_or(1, Convolution::frequencies)
    }

    /// Returns the spectrum of nodes that are even in Y.
    fn spectrum(&self, load: &SurfaceLoad, nodes: &[f64]) -> Result<Vec<Complex64>, KernelError> {
        let Self { along, across } = self;
        let (columns, waves) = (load.columns, along.frequencies());
        let mut work = vec![Complex64::default(); along.work()];
        let mut lines = Vec::new();
        for line in nodes.chunks(columns) {
            let mut signal = line.to_vec();
            signal.resize(along.len(), 0.0);
            let mut spectrum = vec![Complex64::default(); waves];
            along.forward(&mut signal, &mut spectrum, &mut work);
            lines.push(spectrum);
        }
        let Some(across) = across else { return Ok(lines.into_iter().flatten().collect()) };
        let mut out = Vec::with_capacity(waves * across.frequencies());
        for wave in 0..waves {
            // Real and imaginary part are even in Y, so that each has a real spectrum.
            let transformed = |part: fn(&Complex64) -> f64| {
                let mut signal = vec![0.0; across.len()];
                for (j, line) in lines.iter().enumerate() {
                    let value = line.get(wave).map_or(0.0, part);
                    let mirrored = (across.len() - j) % across.len();
                    for place in [j, mirrored] {
                        if let Some(at) = signal.get_mut(place) {
                            *at = value;
                        }
                    }
                }
                across.kernel(&mut signal)
            };
            let (real, imaginary) = (transformed(|value| value.re)?, transformed(|value| value.im)?);
            // `kernel` divides by the length, as the sum over k_y does.
            out.extend(real.into_iter().zip(imaginary).map(|(re, im)| Complex64::new(re, im)));
        }
        Ok(out)
    }
}

/// Returns the stresses at all abscissae of the load, one list for each depth z ≥ 0, in the unit of the pressure.
/// `poisson` is Poisson's ratio.
///
/// # Errors
/// [`KernelError`] if a transform fails.
pub fn stress_below(load: &SurfaceLoad, depths: &[f64], poisson: f64) -> Result<Vec<Vec<Stress>>, KernelError> {
    let lines = load.pressure.len() / load.columns.max(1);
    let nodes = |axis: usize, least: usize| ((load.period[axis] / load.spacing[axis]).ceil() as usize).max(least);
    let transforms = Transforms {
        along: Convolution::new(nodes(0, load.columns)),
        across: (lines > 1).then(|| Convolution::new(nodes(1, 2 * lines))),
    };
    let spectrum = |values: &[f64]| match values {
        [] => Ok(Vec::new()),
        values => transforms.spectrum(load, values),
    };
    let spectrum = Spectrum { pressure: spectrum(&load.pressure)?, traction: spectrum(&load.traction)? };
    let mut rows: Vec<Vec<Stress>> = vec![Vec::new(); depths.len()];
    pool::each(&mut rows, 1, |row, stresses| {
        if let Some(depth) = depths.get(row) {
            *stresses = at_depth(load, &transforms, &spectrum, *depth, poisson);
        }
    });
    Ok(rows)
}

/// Returns the stresses at one depth.
fn at_depth(load: &SurfaceLoad, transforms: &Transforms, spectrum: &Spectrum, depth: f64, poisson: f64) -> Vec<Stress> {
    let (along, rows) = (&transforms.along, transforms.rows());
    let wave_number = |length: usize, spacing: f64| 2.0 * PI / (length as f64 * spacing);
    let unit_x = wave_number(along.len(), load.spacing[0]);
    let unit_y = transforms.across.as_ref().map_or(0.0, |across| wave_number(across.len(), load.spacing[1]));
    let mut parts = [(); 4].map(|()| vec![Complex64::default(); along.frequencies()]);
    let [x, y, z, xz] = &mut parts;
    for wave in 0..along.frequencies() {
        let k_x = unit_x * wave as f64;
        if k_x * depth > DECAYED {
            break;
        }
        for row in 0..rows {
            let k_y = unit_y * row as f64;
            let reach = k_x.hypot(k_y) * depth;
            if reach > DECAYED {
                break;
            }
            // Wave numbers ±k_y, except for 0 and the highest one.
            let twice = if row == 0 || row + 1 == rows { 1.0 } else { 2.0 };
            let decay = twice * (-reach).exp();
            let at = wave * rows + row;
            let pressure = spectrum.pressure.get(at).copied().unwrap_or_default() * decay;
            let traction = spectrum.traction.get(at).copied().unwrap_or_default() * decay;
            let turned = Complex64::new(-traction.im, traction.re);
            let mode = match (wave, row) {
                (0, 0) => Mode::uniform(transforms.across.is_none(), poisson),
                _ => Mode::new([k_x, k_y], depth, poisson),
            };
            let Mode { of_pressure: p, of_traction: q } = mode;
            x[wave] += pressure * p.x + turned * q.x;
            y[wave] += pressure * p.y + turned * q.y;
            z[wave] += pressure * p.z + turned * q.z;
            xz[wave] += Complex64::new(-pressure.im, pressure.re) * p.xz + traction * q.xz;
        }
    }
    let mut work = vec![Complex64::default(); along.work()];
    let scale = 1.0 / along.len() as f64;
    let [x, y, z, xz] = parts.map(|mut part| {
        let mut signal = vec![0.0; along.len()];
        along.inverse(&mut part, &mut signal, &mut work);
        signal.truncate(load.columns);
        signal.iter_mut().for_each(|value| *value *= scale);
        signal
    });
    let stress = |((x, y), (z, xz))| Stress { x, y, z, xz };
    x.into_iter().zip(y).zip(z.into_iter().zip(xz)).map(stress).collect()
}
