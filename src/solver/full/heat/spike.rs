//! Extent of the pressure spike along a line of stations. In it the temperature rises to a needle that is much narrower
//! than the contact.

use std::ops::Range;

/// Smallest height of a spike above the pressure minimum in front of it, relative to the maximum pressure. Smaller waves
/// are discretisation errors.
const LEAST_HEIGHT: f64 = 0.01;

/// Returns the indices of the pressure spike along a line from inlet to outlet. The spike reaches from the pressure
/// minimum in front of its peak to the last place behind the peak with a higher pressure than this minimum. `None`
/// without a spike at X > 0.
pub(super) fn spike(x: &[f64], pressure: &[f64]) -> Option<Range<usize>> {
    let least = LEAST_HEIGHT * pressure.iter().copied().fold(0.0, f64::max);
    let peaks = pressure.windows(3).enumerate().rev().filter(|(_, p)| p[1] > least && p[1] > p[0] && p[1] >= p[2]);
    let of_peak = |k: usize| {
        let (front, peak) = (pressure.get(..k)?, *pressure.get(k)?);
        // The minimum in front of the peak, once the pressure has risen again upstream of it.
        let mut foot = (k, peak);
        let risen = front.iter().enumerate().rev().any(|(i, &p)| {
            if p < foot.1 {
                foot = (i, p);
            }
            p > foot.1 + least
        });
        let behind = pressure.get(k..)?.iter().take_while(|p| **p > foot.1).count();
        (risen && peak > foot.1 + least).then_some(foot.0 + 1..k + behind)
    };
    peaks.map(|(before, _)| before + 1).take_while(|k| x.get(*k).is_some_and(|x| *x > 0.0)).find_map(of_peak)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A Hertzian hump with a spike of a height at a position.
    fn line(at: f64, height: f64) -> (Vec<f64>, Vec<f64>) {
        let x: Vec<f64> = (0..=600).map(|i| -4.0 + 0.01 * f64::from(i)).collect();
        let hump = |x: f64| (1.0 - x * x).max(0.0).sqrt();
        let spike = |x: f64| height * (-((x - at) / 0.03).powi(2)).exp();
        let pressure = x.iter().map(|&x| hump(x) + spike(x)).collect();
        (x, pressure)
    }

    #[test]
    fn a_spike_ends_at_the_pressure_of_its_foot() {
        let (x, p) = line(0.85, 0.6);
        let found = spike(&x, &p).unwrap();
        let [first, last] = [x[found.start], x[found.end - 1]];
        assert!(first > 0.74 && first < 0.82 && last > 0.86 && last < 0.95, "{first} {last}");
        let foot = p[found.start - 1];
        assert!(found.clone().all(|i| p[i] > foot) && p[found.end] <= foot);
    }

    #[test]
    fn humps_shoulders_and_small_waves_are_no_spikes() {
        for (at, height) in [(0.8, 0.0), (0.8, 0.005), (-0.8, 0.6)] {
            let (x, p) = line(at, height);
            assert_eq!(spike(&x, &p), None, "{at} {height}");
        }
        assert_eq!(spike(&[], &[]), None);
        // A small wave behind a spike does not hide it.
        let (x, mut p) = line(0.8, 0.6);
        p[490] += 0.028;
        assert!(p[490] > p[489] && p[490] > p[491]);
        let found = spike(&x, &p).unwrap();
        assert!(found.contains(&480), "{found:?}");
    }
}
