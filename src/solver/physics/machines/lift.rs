//! Lift of a cam follower over the cam angle: analytic laws, and a table joined by a periodic cubic spline.

use super::error::{MachineError, check};
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};

/// Lift of the follower over the cam angle θ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Lift {
    /// Lift L (1 − (θ/β)²)³ between −β and β, otherwise zero.
    Polynomial {
        /// Largest lift L \[m\].
        lift_m: f64,
        /// Half of the event β \[°\].
        half_event_deg: f64,
    },
    /// Circular eccentric: e (1 + cos θ).
    Eccentric {
        /// Distance e of the centre from the axis \[m\].
        eccentricity_m: f64,
    },
    /// Cam angles \[°\], rising over at most one revolution, with the lift \[m\] at each.
    Table(Vec<(f64, f64)>),
}

/// Lift that can be evaluated.
#[derive(Clone, Debug, PartialEq)]
pub enum LiftCurve {
    /// L \[m\] and β \[rad\].
    Polynomial(f64, f64),
    /// e \[m\].
    Eccentric(f64),
    /// Angles \[rad\], lifts \[m\] and second derivatives \[m\] of the knots of one revolution.
    Spline(Vec<f64>, Vec<f64>, Vec<f64>),
}

impl Lift {
    /// Returns the lift in a form that can be evaluated.
    ///
    /// # Errors
    /// A sentence if a value is out of range, or with the line of the table.
    pub fn curve(&self) -> Result<LiftCurve, MachineError> {
        let mm = (" mm", 1e-3);
        match self {
            Self::Polynomial { lift_m, half_event_deg } => {
                check("lift", *lift_m, mm, (1e-3, 1e3))?;
                check("half of the event", *half_event_deg, ("°", 1.0), (5.0, 180.0))?;
                Ok(LiftCurve::Polynomial(*lift_m, half_event_deg.to_radians()))
            }
            Self::Eccentric { eccentricity_m } => {
                check("eccentricity", *eccentricity_m, mm, (1e-3, 1e3))?;
                Ok(LiftCurve::Eccentric(*eccentricity_m))
            }
            Self::Table(points) => spline(points),
        }
    }

    /// Returns the angles \[rad\] between which the follower moves.
    pub(super) fn event(&self) -> (f64, f64) {
        match self {
            Self::Polynomial { half_event_deg, .. } => {
                let half = half_event_deg.to_radians();
                (-half, half)
            }
            Self::Eccentric { .. } => (-PI, PI),
            Self::Table(points) => {
                let angle = |point: Option<&(f64, f64)>| point.map_or(0.0, |(angle, _)| angle.to_radians());
                (angle(points.first()), angle(points.last()))
            }
        }
    }
}

impl LiftCurve {
    /// Returns s, ds/dθ and d²s/dθ² \[m\] at a cam angle \[rad\].
    pub fn at(&self, angle: f64) -> [f64; 3] {
        match self {
            Self::Polynomial(lift, half) => {
                let x = (angle + PI).rem_euclid(TAU) - PI;
                let rest = 1.0 - (x / half).powi(2);
                if rest <= 0.0 {
                    return [0.0; 3];
                }
                let square = half * half;
                let slope = -6.0 * lift * x * rest * rest / square;
                let second = -6.0 * lift * rest * (rest - 4.0 * x * x / square) / square;
                [lift * rest.powi(3), slope, second]
            }
            Self::Eccentric(e) => [e * (1.0 + angle.cos()), -e * angle.sin(), -e * angle.cos()],
            Self::Spline(angles, lifts, seconds) => spline_at(angles, lifts, seconds, angle),
        }
    }

    /// Returns the knots of a table \[rad\]; empty for a law.
    pub(super) fn knots(&self) -> &[f64] {
        if let Self::Spline(angles, ..) = self { angles } else { &[] }
    }
}

fn spline_at(angles: &[f64], lifts: &[f64], seconds: &[f64], angle: f64) -> [f64; 3] {
    let count = angles.len();
    let first = angles.first().copied().unwrap_or(0.0);
    let angle = first + (angle - first).rem_euclid(TAU);
    let k = angles.partition_point(|knot| *knot <= angle).clamp(1, count) - 1;
    let next = (k + 1) % count;
    let end = if next == 0 { first + TAU } else { angles[next] };
    let width = end - angles[k];
    let (b, a) = ((angle - angles[k]) / width, (end - angle) / width);
    let (m, n) = (seconds[k], seconds[next]);
    let (s, t) = (lifts[k], lifts[next]);
    [
        a * s + b * t + ((a.powi(3) - a) * m + (b.powi(3) - b) * n) * width * width / 6.0,
        (t - s) / width + ((1.0 - 3.0 * a * a) * m + (3.0 * b * b - 1.0) * n) * width / 6.0,
        a * m + b * n,
    ]
}

/// Returns the periodic cubic spline through a table. If the table covers a part of the revolution, the follower
/// rests in the other part, and the first and last lifts must be zero.
fn spline(points: &[(f64, f64)]) -> Result<LiftCurve, MachineError> {
    if !(8..=4000).contains(&points.len()) {
        return Err(MachineError::LiftPoints(points.len()));
    }
    let refuse = |line: usize, problem| Err(MachineError::LiftLine { line: line + 1, problem });
    for (line, (angle, lift)) in points.iter().enumerate() {
        if !((-720.0..=720.0).contains(angle) && (0.0..=1.0).contains(lift)) {
            return refuse(line, "an angle must lie between −720° and 720°, and a lift between 0 and 1 m");
        }
        if line > 0 && *angle - points[line - 1].0 < 1e-6 {
            return refuse(line, "the angles must rise from line to line");
        }
    }
    let last = points.len() - 1;
    let (from, to) = (points[0].0, points[last].0);
    if to - from > 360.0 + 1e-9 {
        return refuse(last, "the angles must cover at most one revolution of 360°");
    }
    let mut knots: Vec<(f64, f64)> = points.to_vec();
    if to - from > 360.0 - 1e-6 {
        if (points[0].1 - points[last].1).abs() > 1e-9 {
            return refuse(last, "the lift after 360° must be that of the first line");
        }
        knots.pop();
    } else if points[0].1.max(points[last].1) > 0.0 {
        return refuse(last, "a table of less than 360° must begin and end with a lift of 0");
    } else {
        // The rest of the revolution is the base circle, with knots as dense as those of the table.
        let rest = 360.0 - (to - from);
        let step = (to - from) / last as f64;
        let more = ((rest / step).round() as usize).clamp(3, 4000);
        knots.extend((1..more).map(|k| (to + rest * k as f64 / more as f64, 0.0)));
    }
    let angles: Vec<f64> = knots.iter().map(|(angle, _)| angle.to_radians()).collect();
    let lifts: Vec<f64> = knots.iter().map(|(_, lift)| *lift).collect();
    let seconds = second_derivatives(&angles, &lifts);
    Ok(LiftCurve::Spline(angles, lifts, seconds))
}

/// Returns the second derivatives of the periodic cubic spline at its knots.
fn second_derivatives(angles: &[f64], lifts: &[f64]) -> Vec<f64> {
    let count = angles.len();
    let width = |k: usize| if k + 1 < count { angles[k + 1] - angles[k] } else { angles[0] + TAU - angles[k] };
    let before = |k: usize| (k + count - 1) % count;
    let rise = |k: usize| (lifts[(k + 1) % count] - lifts[k]) / width(k);
    let right: Vec<f64> = (0..count).map(|k| 6.0 * (rise(k) - rise(before(k)))).collect();
    let mut diagonal: Vec<f64> = (0..count).map(|k| 2.0 * (width(before(k)) + width(k))).collect();
    // Sherman and Morrison: the corners of the cyclic matrix are a correction of rank one.
    let (corner, shift) = (width(count - 1), -diagonal[0]);
    diagonal[0] -= shift;
    diagonal[count - 1] -= corner * corner / shift;
    let mut edge = vec![0.0; count];
    edge[0] = shift;
    edge[count - 1] = corner;
    let off: Vec<f64> = (0..count - 1).map(width).collect();
    let solution = tridiagonal(&off, &diagonal, right);
    let other = tridiagonal(&off, &diagonal, edge);
    let along = |x: &[f64]| x[0] + corner / shift * x[count - 1];
    let factor = along(&solution) / (1.0 + along(&other));
    solution.iter().zip(&other).map(|(x, z)| x - factor * z).collect()
}

/// Solves a symmetric tridiagonal system.
fn tridiagonal(off: &[f64], diagonal: &[f64], mut right: Vec<f64>) -> Vec<f64> {
    let count = diagonal.len();
    let mut pivots = diagonal.to_vec();
    for k in 1..count {
        let factor = off[k - 1] / pivots[k - 1];
        pivots[k] -= factor * off[k - 1];
        right[k] -= factor * right[k - 1];
    }
    right[count - 1] /= pivots[count - 1];
    for k in (0..count - 1).rev() {
        right[k] = (right[k] - off[k] * right[k + 1]) / pivots[k];
    }
    right
}

/// Reads a lift table from text: in each line a cam angle \[°\] and a lift \[mm\], separated by a tab, a semicolon,
/// a comma or spaces. A first line of titles is skipped.
///
/// # Errors
/// A sentence with the line.
pub fn lift_table(text: &str) -> Result<Vec<(f64, f64)>, MachineError> {
    let mut points = Vec::new();
    for (k, line) in text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()) {
        // With tabs, semicolons or spaces the decimal sign may be a comma.
        let by_comma = !line.contains([';', '\t']) && line.split_whitespace().count() == 1;
        let cells: Vec<String> = match line {
            _ if line.contains(';') => line.split(';').map(str::to_owned).collect(),
            _ if by_comma => line.split(',').map(str::to_owned).collect(),
            _ if line.contains(", ") => line.split(", ").map(str::to_owned).collect(),
            _ => line.split_whitespace().map(str::to_owned).collect(),
        };
        let number = |cell: Option<&String>| cell?.trim().replace(',', ".").parse::<f64>().ok();
        match (number(cells.first()), number(cells.get(1)), cells.len()) {
            (Some(angle), Some(lift), 2) => points.push((angle, 1e-3 * lift)),
            _ if points.is_empty() && k == 0 => {}
            _ => {
                let problem = "a cam angle in degrees and a lift in mm are needed, as in 10; 0.25";
                return Err(MachineError::LiftLine { line: k + 1, problem });
            }
        }
    }
    spline(&points).map(|_| points)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(lift: &LiftCurve, from: f64, to: f64, steps: usize) -> Vec<(f64, f64)> {
        let angle = |k: usize| from + (to - from) * k as f64 / steps as f64;
        (0..=steps).map(|k| (angle(k), lift.at(angle(k).to_radians())[0].max(0.0))).collect()
    }

    #[test]
    fn derivatives_are_finite_differences() {
        let law = Lift::Polynomial { lift_m: 7e-3, half_event_deg: 75.0 }.curve().unwrap();
        let spline = Lift::Table(table(&law, -75.0, 75.0, 60)).curve().unwrap();
        let eccentric = Lift::Eccentric { eccentricity_m: 2e-3 }.curve().unwrap();
        for curve in [law, spline, eccentric] {
            for k in -40..40 {
                let (angle, h) = (0.0712 * f64::from(k), 1e-5);
                let [below, here, above] = [angle - h, angle, angle + h].map(|angle| curve.at(angle));
                for order in 0..2 {
                    let slope = (above[order] - below[order]) / (2.0 * h);
                    assert!((slope - here[order + 1]).abs() < 2e-7, "{angle}: {slope} {}", here[order + 1]);
                }
            }
        }
    }

    #[test]
    fn a_table_follows_its_law_and_converges() {
        let law = Lift::Polynomial { lift_m: 7e-3, half_event_deg: 75.0 }.curve().unwrap();
        let miss = |steps: usize| {
            let spline = Lift::Table(table(&law, -75.0, 75.0, steps)).curve().unwrap();
            let angles = (-300..300).map(|k| f64::from(k) * 0.004_01);
            angles.map(|angle| (spline.at(angle)[2] - law.at(angle)[2]).abs()).fold(0.0, f64::max)
        };
        // The law has a jump of its third derivative at its ends, so the second derivative converges linearly there.
        assert!(miss(150) < 3e-4 && miss(600) < 0.35 * miss(150), "{} {}", miss(150), miss(600));
        // One revolution of a smooth function: fourth order, second derivative second order.
        let eccentric = Lift::Eccentric { eccentricity_m: 2e-3 }.curve().unwrap();
        let round = Lift::Table(table(&eccentric, 0.0, 360.0, 360)).curve().unwrap();
        for k in 0..700 {
            let angle = 0.01 * f64::from(k) - 1.0;
            let (a, b) = (round.at(angle), eccentric.at(angle));
            assert!((a[0] - b[0]).abs() < 1e-11 && (a[2] - b[2]).abs() < 1e-7, "{angle}: {a:?} {b:?}");
        }
    }

    #[test]
    fn tables_with_holes_are_refused_by_line() {
        let text = "angle; lift\n-40; 0\n-30; 0,1\n-20; 0,4\n-10; 0,9\n0; 1,2\n10; 0,9\n20; 0,4\n30; 0,1\n40; 0\n";
        let points = lift_table(text).unwrap();
        assert_eq!((points.len(), points[1]), (9, (-30.0, 1e-4)));
        assert_eq!(lift_table(&text.replace(',', ".").replace("; ", ",")).unwrap(), points);
        assert_eq!(lift_table(&text.replace("; ", "\t")).unwrap(), points);
        assert_eq!(lift_table(&text.replace(',', ".").replace("; ", ", ")).unwrap(), points);
        let said = |text: &str, words: &str| {
            let error = lift_table(text).unwrap_err().to_string();
            assert!(error.contains(words), "{error}");
        };
        said(&text.replace("-20; 0,4", "-20;"), "line 4: a cam angle");
        said(&text.replace("-20;", "-35;"), "the angles must rise");
        said(&text.replace("40; 0\n", "40; 0,2\n"), "begin and end with a lift of 0");
        said("1; 2\n", "1 points");
        said(&text.replace("1,2", "NaN"), "between 0 and 1 m");
    }
}
