//! Stresses below Hertzian pressures against closed forms and point-load solutions.

use super::*;
use std::f64::consts::PI;

/// Half widths drawn on each side, and depths.
const SIDE: f64 = 2.0;

fn depths() -> Vec<f64> {
    (0..=80).map(|k| 0.025 * f64::from(k)).collect()
}

/// Hertzian pressure and traction μ p on an elliptical contact with the semi-axes 1 and κ, or on a line.
fn hertz(kappa: Option<f64>, friction: f64, spacing: f64) -> SurfaceLoad {
    let columns = (2.0 * SIDE / spacing).round() as usize + 1;
    let (lines, across) = kappa.map_or((1, 1.0), |kappa| ((1.2 / 0.04) as usize, 0.04 * kappa));
    let at = |k: usize| {
        let x = spacing * (k % columns) as f64 - SIDE;
        let y = across * (k / columns) as f64 / kappa.unwrap_or(1.0);
        (1.0 - x * x - y * y).max(0.0).sqrt()
    };
    let pressure: Vec<f64> = (0..columns * lines).map(at).collect();
    let traction = pressure.iter().map(|p| friction * p).collect();
    let kappa = kappa.unwrap_or(1.0);
    let period = if lines == 1 { [64.0, 1.0] } else { [24.0 * kappa.clamp(1.0, 2.5), 24.0 * kappa.max(1.0)] };
    SurfaceLoad { columns, spacing: [spacing, across], pressure, traction, period }
}

/// McEwen's stresses below a Hertzian line with friction μ: Johnson, Contact Mechanics, (4.49) and (7.8).
fn mc_ewen(x: f64, z: f64, friction: f64, poisson: f64) -> Stress {
    let part = 1.0 - x * x + z * z;
    let root = part.hypot(2.0 * x * z);
    let (m, n) = ((0.5 * (root + part)).max(0.0).sqrt(), (0.5 * (root - part)).max(0.0).sqrt().copysign(x));
    let square = m * m + n * n;
    let normal = Stress {
        x: -(m * (1.0 + (z * z + n * n) / square) - 2.0 * z),
        z: -m * (1.0 - (z * z + n * n) / square),
        xz: -n * (m * m - z * z) / square,
        y: 0.0,
    };
    let sliding = Stress { x: n * (2.0 - (z * z - m * m) / square) - 2.0 * x, z: normal.xz, xz: normal.x, y: 0.0 };
    let [x, z, xz] =
        [normal.x + friction * sliding.x, normal.z + friction * sliding.z, normal.xz + friction * sliding.xz];
    Stress { x, y: poisson * (x + z), z, xz }
}

/// Stress below a Hertzian pressure with friction on a circle, by integrating the solutions of Boussinesq and Cerruti
/// for a point load: Johnson, (3.20) and (3.76).
fn by_point_loads(x: f64, z: f64, friction: f64, poisson: f64) -> Stress {
    let (rings, turns) = (400, 400);
    let mut sum = Stress::default();
    let free = 1.0 - 2.0 * poisson;
    for ring in 0..rings {
        // r = sin φ makes the integrand smooth at the edge.
        let angle = 0.5 * PI * (f64::from(ring) + 0.5) / f64::from(rings);
        let (r, p) = (angle.sin(), angle.cos());
        let area = r * p * 0.5 * PI / f64::from(rings) * 2.0 * PI / f64::from(turns);
        for turn in 0..turns {
            let direction = 2.0 * PI * (f64::from(turn) + 0.5) / f64::from(turns);
            let (x, y) = (x - r * direction.cos(), -r * direction.sin());
            let rho = (x * x + y * y + z * z).sqrt();
            let (across, load) = (x * x + y * y, p * area / (2.0 * PI));
            let q = friction * load;
            let bent = free / across;
            let away = (x * x - y * y) / across;
            let (near, deep) = (1.0 - z / rho, z / rho.powi(3));
            sum.x += load * (bent * (near * away + deep * y * y) - 3.0 * z * x * x / rho.powi(5));
            sum.y += load * (bent * (-near * away + deep * x * x) - 3.0 * z * y * y / rho.powi(5));
            sum.z -= load * 3.0 * z.powi(3) / rho.powi(5);
            sum.xz -= load * 3.0 * x * z * z / rho.powi(5);
            let s = rho + z;
            let cerruti = |own: f64, factor: f64| {
                -3.0 * x * own / rho.powi(5)
                    + free
                        * (x / rho.powi(3) - factor * x / (rho * s * s)
                            + x * own / (rho.powi(3) * s * s)
                            + 2.0 * x * own / (rho * rho * s.powi(3)))
            };
            sum.x += q * cerruti(x * x, 3.0);
            sum.y += q * cerruti(y * y, 1.0);
            sum.z -= q * 3.0 * x * z * z / rho.powi(5);
            sum.xz -= q * 3.0 * x * x * z / rho.powi(5);
        }
    }
    sum
}

fn largest(field: &[Vec<Stress>], measure: StressMeasure) -> (f64, usize, usize) {
    let mut best = (0.0, 0, 0);
    for (row, stresses) in field.iter().enumerate() {
        for (column, stress) in stresses.iter().enumerate() {
            let value = stress.measure(measure).abs();
            if value > best.0 {
                best = (value, row, column);
            }
        }
    }
    best
}

fn off(own: Stress, other: Stress) -> f64 {
    [own.x - other.x, own.y - other.y, own.z - other.z, own.xz - other.xz].into_iter().fold(0.0, |m, d| d.abs().max(m))
}

#[test]
fn stress_below_a_hertzian_line_has_the_closed_form() {
    for friction in [0.0, 0.1, 0.3, -0.3] {
        let load = hertz(None, friction, 0.01);
        let field = stress_below(&load, &depths(), 0.3).unwrap();
        for (row, depth) in depths().into_iter().enumerate().skip(2) {
            for column in (0..load.columns).step_by(7) {
                let x = load.spacing[0] * column as f64 - SIDE;
                let exact = mc_ewen(x, depth, friction, 0.3);
                let error = off(field[row][column], exact);
                assert!(error < 4e-3, "μ {friction}, X {x}, Z {depth}: {:?} {exact:?}", field[row][column]);
            }
        }
    }
    let field = stress_below(&hertz(None, 0.0, 0.01), &depths(), 0.3).unwrap();
    // Johnson, section 4.2: τ_max = 0.300 p_H at 0.786 a; τ_xz = 0.250 p_H at 0.5 a, X = ±0.866. McEwen: von Mises
    // 0.558 p_H at 0.704 a for ν = 0.3.
    for (measure, value, depth) in [
        (StressMeasure::MaximumShear, 0.300, 0.786),
        (StressMeasure::OrthogonalShear, 0.250, 0.5),
        (StressMeasure::VonMises, 0.558, 0.704),
    ] {
        let (own, row, _) = largest(&field, measure);
        assert!((own / value - 1.0).abs() < 5e-3, "{measure:?}: {own}");
        assert!((depths()[row] - depth).abs() < 0.02, "{measure:?}: {}", depths()[row]);
    }
}

#[test]
fn halving_the_spacing_halves_the_error_of_a_line_at_least() {
    let error = |spacing: f64| {
        let load = hertz(None, 0.2, spacing);
        let field = stress_below(&load, &[0.3], 0.3).unwrap();
        let exact = |k: usize| mc_ewen(spacing * k as f64 - SIDE, 0.3, 0.2, 0.3);
        // The images of the period are the same on all grids and are left out.
        let fine = stress_below(&hertz(None, 0.2, 0.005), &[0.3], 0.3).unwrap();
        let every = (spacing / 0.005).round() as usize;
        let compared = |k: usize| (off(field[0][k], fine[0][every * k]), off(field[0][k], exact(k)));
        (0..load.columns).map(compared).fold((0.0, 0.0), |m: (f64, f64), e| (m.0.max(e.0), m.1.max(e.1)))
    };
    // The edges X = ±1 are nodes of all grids.
    let [coarse, middle, fine] = [0.1, 0.05, 0.025].map(error);
    assert!(middle.0 < 0.5 * coarse.0 && fine.0 < 0.5 * middle.0, "{coarse:?} {middle:?} {fine:?}");
    assert!(fine.1 < 3e-3, "{fine:?}");
}

#[test]
fn stress_below_a_circle_has_published_values() {
    let poisson = 0.3;
    let load = hertz(Some(1.0), 0.0, 0.02);
    let field = stress_below(&load, &depths(), poisson).unwrap();
    let middle = load.columns / 2;
    for (row, z) in depths().into_iter().enumerate().skip(2) {
        // Johnson, (3.45).
        let axial = -1.0 / (1.0 + z * z);
        let radial = -(1.0 + poisson) * (1.0 - z * (1.0 / z).atan()) - 0.5 * axial;
        let exact = Stress { x: radial, y: radial, z: axial, xz: 0.0 };
        assert!(off(field[row][middle], exact) < 4e-3, "Z {z}: {:?} {exact:?}", field[row][middle]);
    }
    for friction in [0.0, 0.25] {
        let load = hertz(Some(1.0), friction, 0.02);
        let field = stress_below(&load, &depths(), poisson).unwrap();
        for (row, column) in [(8, 40), (12, 120), (20, 100), (20, 60), (40, 150), (4, 100)] {
            let (x, z) = (0.02 * column as f64 - SIDE, depths()[row]);
            let exact = by_point_loads(x, z, friction, poisson);
            assert!(off(field[row][column], exact) < 5e-3, "X {x}, Z {z}: {:?} {exact:?}", field[row][column]);
        }
        let (own, row, column) = largest(&field[1..], StressMeasure::VonMises);
        let (x, z) = (0.02 * column as f64 - SIDE, depths()[row + 1]);
        let exact = by_point_loads(x, z, friction, poisson).von_mises();
        assert!((own / exact - 1.0).abs() < 0.01, "μ {friction} at {x}, {z}: {own} {exact}");
    }
    // Below a sliding circle, on the axis: τ_xz = −q₀ (1 − 3/2 Z atan(1/Z) + ½ Z²/(1 + Z²)), Hamilton and Goodman 1966.
    let sliding = SurfaceLoad { pressure: vec![0.0; load.pressure.len()], traction: load.pressure.clone(), ..load };
    let field = stress_below(&sliding, &depths(), poisson).unwrap();
    for (row, z) in depths().into_iter().enumerate().skip(2) {
        let exact = -(1.0 - 1.5 * z * (1.0 / z).atan() + 0.5 * z * z / (1.0 + z * z));
        assert!((field[row][middle].xz - exact).abs() < 4e-3, "Z {z}");
    }
}

#[test]
fn below_ellipses_shear_and_depth_are_those_of_the_tables() {
    // Johnson, table 4.1: semi-axes ratio, τ_max/p_H, depth over the smaller semi-axis, ν = 0.3.
    for (ratio, shear, depth) in [(0.8, 0.317, 0.530), (0.4, 0.325, 0.665), (0.2, 0.322, 0.745)] {
        for kappa in [1.0 / ratio, ratio] {
            let load = hertz(Some(kappa), 0.0, 0.02);
            let depths: Vec<f64> = (0..=80).map(|k| 0.02 * kappa.min(1.0) * f64::from(k)).collect();
            let field = stress_below(&load, &depths, 0.3).unwrap();
            let (own, row, _) = largest(&field[4..], StressMeasure::MaximumShear);
            assert!((own / shear - 1.0).abs() < 0.01, "κ {kappa}: {own}");
            let at = depths[row + 4] / kappa.min(1.0);
            assert!((at - depth).abs() < 0.03, "κ {kappa}: {at}");
        }
    }
}
