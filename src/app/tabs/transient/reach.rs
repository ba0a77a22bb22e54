//! Comparison of the inputs of a transient contact with the training inputs of its models.

use crate::app::document::input::Input;
use crate::app::numbers;
use crate::scene::Drive;
use crate::solver::full::transient::{Inputs, Signal};

/// Number of samples of an input over its duration.
const SAMPLES: usize = 2000;
/// Factor by which inputs may be steeper or larger and still count as inside the training.
const ROOM: f64 = 1.05;

/// Returns the maximum slope of an input, and its range.
fn extremes(signal: &Signal, duration: f64) -> (f64, f64, f64) {
    let at = |k: usize| signal.at(duration * k as f64 / SAMPLES as f64);
    let mut found = (0.0f64, at(0), at(0));
    for k in 1..=SAMPLES {
        let (before, now) = (at(k - 1), at(k));
        let slope = (now - before).abs() * SAMPLES as f64 / duration;
        found = (found.0.max(slope), found.1.min(now), found.2.max(now));
    }
    found
}

/// Returns the first part of a sentence if inputs are steeper or vary more than the training inputs, with the
/// factor.
pub fn beyond(inputs: &Inputs, duration: f64, trainings: &[Drive]) -> Option<String> {
    let (mut steeper, mut wider) = (1.0f64, 1.0f64);
    for input in Input::ALL {
        let (slope, least, most) = extremes(input.of(inputs), duration);
        if slope == 0.0 {
            continue;
        }
        let trained = trainings.iter().map(|drive| extremes(input.of(&drive.inputs), drive.duration));
        let (known_slope, low, high) = trained.fold((0.0f64, 1.0f64, 1.0f64), |(slope, low, high), own| {
            (slope.max(own.0), low.min(own.1), high.max(own.2))
        });
        steeper = steeper.max(slope / known_slope);
        wider = wider.max((most - 1.0).max(1.0 - least) / (high - 1.0).max(1.0 - low));
    }
    let said = |times: f64| if times.is_finite() { numbers::digits(times, 2) } else { "infinitely many".to_owned() };
    if steeper > ROOM {
        Some(format!("The inputs are {} × steeper than trained", said(steeper)))
    } else if wider > ROOM {
        Some(format!("The inputs have {} × larger amplitudes than trained", said(wider)))
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steeper_and_wider_inputs_are_told_and_trained_ones_are_not() {
        let drive = |amplitude: f64, period: f64| {
            let inputs = Inputs::load(Signal::Harmonic { amplitude, period });
            Drive { name: String::new(), inputs, duration: 8.0 }
        };
        let trained = [drive(0.1, 4.0)];
        let said = |amplitude, period| beyond(&drive(amplitude, period).inputs, 8.0, &trained);
        assert_eq!(said(0.1, 4.0), None);
        assert_eq!(said(0.05, 4.0), None);
        assert!(said(0.14, 4.0).unwrap().contains("1.4 × steeper"));
        assert!(said(0.1, 2.0).unwrap().contains("2.0 × steeper"));
        assert!(said(0.2, 8.0).unwrap().contains("2.0 × larger amplitudes"));
    }
}
