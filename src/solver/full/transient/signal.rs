//! Inputs of a transient contact: R̄(T), ū(T) and w̄(T) of (2.18) to (2.20).

use crate::solver::limits::Number;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Dimensionless function of the time T. Before T = 0 it is constant.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Signal {
    /// 1 throughout.
    #[default]
    Constant,
    /// 1 + A sin(2π T/T_ex), (2.49), (4.12).
    Harmonic {
        /// Amplitude A.
        amplitude: f64,
        /// Period T_ex.
        period: f64,
    },
    /// 1 + A₁ sin(2π T/T₁) + A₂ sin(2π T/T₂), (4.33).
    TwoScale {
        /// Amplitudes A₁ and A₂.
        amplitudes: (f64, f64),
        /// Periods T₁ and T₂.
        periods: (f64, f64),
    },
    /// A cos(2π T/T_ex): a speed that falls to zero and reverses.
    Reversing {
        /// Amplitude A.
        amplitude: f64,
        /// Period T_ex.
        period: f64,
    },
    /// Wave between a triangle (s = 0) and a square (s = 1) around 1, Fig. 4.16: a triangle 1/(1 − s) times as high,
    /// cut at ±A.
    TriangleToSquare {
        /// Amplitude A.
        amplitude: f64,
        /// Period T_ex.
        period: f64,
        /// Steepness s, 0 ≤ s < 1.
        s: f64,
    },
    /// Given values, interpolated linearly; constant after the last one.
    Sampled {
        /// Times T, increasing.
        times: Vec<f64>,
        /// Value at each time.
        values: Vec<f64>,
    },
}

/// The three inputs as functions of time, relative to the reference contact.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Inputs {
    /// Radius R̄(T).
    #[serde(default)]
    pub radius: Signal,
    /// Entrainment speed ū(T).
    #[serde(default)]
    pub speed: Signal,
    /// Load w̄(T).
    #[serde(default)]
    pub load: Signal,
}

/// The three inputs at one time, relative to the reference contact.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Input {
    /// Radius R̄.
    pub radius: f64,
    /// Entrainment speed ū.
    pub speed: f64,
    /// Load w̄.
    pub load: f64,
}

/// Refusal of inputs: a sentence that names the input and, where applicable, the time.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct InputError(String);

/// Number of samples at which inputs are checked for a sign change, in addition to their own knots.
const WATCHED: usize = 20_000;

impl Signal {
    /// Returns the value at T.
    pub fn at(&self, time: f64) -> f64 {
        let time = time.max(0.0);
        match self {
            Self::Constant => 1.0,
            Self::Harmonic { amplitude, period } => 1.0 + amplitude * (TAU * time / period).sin(),
            Self::TwoScale { amplitudes, periods } => {
                1.0 + amplitudes.0 * (TAU * time / periods.0).sin() + amplitudes.1 * (TAU * time / periods.1).sin()
            }
            Self::Reversing { amplitude, period } => amplitude * (TAU * time / period).cos(),
            Self::TriangleToSquare { amplitude, period, s } => {
                // Triangle of height 1 that starts upwards at zero.
                let phase = (time / period + 0.25).fract();
                let triangle = 1.0 - 4.0 * (phase - 0.5).abs();
                1.0 + amplitude * (triangle / (1.0 - s)).clamp(-1.0, 1.0)
            }
            Self::Sampled { times, values } => {
                let next = times.partition_point(|&t| t <= time);
                match (next.checked_sub(1), values.get(next)) {
                    (None, Some(&first)) => first,
                    (Some(k), Some(&value)) => {
                        let share = (time - times[k]) / (times[k + 1] - times[k]);
                        values[k] + share * (value - values[k])
                    }
                    (_, None) => values.last().copied().unwrap_or(1.0),
                }
            }
        }
    }

    /// Returns a lower bound that follows from the constants; not finite if a constant is not.
    fn floor(&self) -> f64 {
        match self {
            Self::Constant => 1.0,
            Self::Harmonic { amplitude, .. } | Self::TriangleToSquare { amplitude, .. } => 1.0 - amplitude.abs(),
            Self::TwoScale { amplitudes: (one, other), .. } => 1.0 - one.abs() - other.abs(),
            Self::Reversing { amplitude, .. } => -amplitude.abs(),
            Self::Sampled { values, .. } if values.iter().all(|value| value.is_finite()) => {
                values.iter().copied().fold(f64::INFINITY, f64::min)
            }
            Self::Sampled { .. } => f64::NAN,
        }
    }

    /// Refuses constants out of range, and values that are not finite.
    pub(super) fn check(&self, name: &'static str, duration: f64) -> Result<(), InputError> {
        self.check_constants(name)?;
        let mut times = (0..=WATCHED).map(|k| duration * k as f64 / WATCHED as f64);
        match times.find(|time| !self.at(*time).is_finite()) {
            None => Ok(()),
            Some(time) => Err(InputError(format!("the {name} at T = {time:.4} must be a finite number"))),
        }
    }

    fn check_constants(&self, input: &'static str) -> Result<(), InputError> {
        let refuse = |constant: &str, value: f64, accepted: &str| {
            let value = Number(value);
            Err(InputError(format!("the {input} has the {constant} {value}, but it must be {accepted}")))
        };
        let positive = |constant, value: f64| {
            let fine = value.is_finite() && value > 0.0;
            if fine { Ok(()) } else { refuse(constant, value, "a finite number above zero") }
        };
        match self {
            Self::Constant => Ok(()),
            Self::Harmonic { period, .. } | Self::Reversing { period, .. } => positive("period", *period),
            Self::TwoScale { periods, .. } => {
                positive("first period", periods.0).and_then(|()| positive("second period", periods.1))
            }
            Self::TriangleToSquare { period, s, .. } => {
                positive("period", *period)?;
                if (0.0..1.0).contains(s) {
                    return Ok(());
                }
                refuse("steepness s", *s, "at least 0 (a triangle) and below 1 (a square)")
            }
            Self::Sampled { times, values } => {
                if times.len() != values.len() || times.is_empty() {
                    let (times, values) = (times.len(), values.len());
                    return Err(InputError(format!(
                        "the {input} has {times} times but {values} values; both are needed, as many of each"
                    )));
                }
                for (entry, &time) in times.iter().enumerate() {
                    let before = if entry == 0 { f64::NEG_INFINITY } else { times[entry - 1] };
                    if !time.is_finite() || time <= before {
                        let entry = entry + 1;
                        return Err(InputError(format!(
                            "the times of the {input} must rise, but {time} (entry {entry}) does not lie after {before}"
                        )));
                    }
                }
                Ok(())
            }
        }
    }
}

impl Input {
    /// Inputs of the reference contact.
    pub const REFERENCE: Self = Self { radius: 1.0, speed: 1.0, load: 1.0 };

    /// Interpolates linearly to other inputs; `share` is the part of the way.
    pub fn towards(self, other: Self, share: f64) -> Self {
        let between = |own: f64, other: f64| if share < 1.0 { own + share * (other - own) } else { other };
        Self {
            radius: between(self.radius, other.radius),
            speed: between(self.speed, other.speed),
            load: between(self.load, other.load),
        }
    }
}

impl Inputs {
    /// Returns inputs of which only the load varies.
    pub fn load(load: Signal) -> Self {
        Self { load, ..Self::default() }
    }

    /// Returns inputs that all follow the same function, (4.34).
    pub fn all(signal: Signal) -> Self {
        Self { radius: signal.clone(), speed: signal.clone(), load: signal }
    }

    /// Returns the inputs at T.
    pub fn at(&self, time: f64) -> Input {
        Input { radius: self.radius.at(time), speed: self.speed.at(time), load: self.load.at(time) }
    }

    /// Checks the functions, and that radius and load stay positive over 0 ≤ T ≤ `duration`. The speed may change its
    /// sign.
    ///
    /// # Errors
    /// [`InputError`] with the input and the first time at which it is not accepted.
    pub fn check(&self, duration: f64) -> Result<(), InputError> {
        for (input, signal) in [("radius", &self.radius), ("speed", &self.speed), ("load", &self.load)] {
            signal.check_constants(input)?;
            let floor = signal.floor();
            if floor.is_finite() && (floor > 0.0 || input == "speed") {
                continue;
            }
            let mut times: Vec<f64> = (0..=WATCHED).map(|k| duration * k as f64 / WATCHED as f64).collect();
            if let Signal::Sampled { times: knots, .. } = signal {
                times.extend(knots.iter().filter(|knot| (0.0..=duration).contains(*knot)));
                times.sort_by(f64::total_cmp);
            }
            for time in times {
                let value = signal.at(time);
                if !value.is_finite() {
                    return Err(InputError(format!(
                        "the {input} is {value} at T = {time:.4}, but must be a finite number"
                    )));
                }
                if input != "speed" && value <= 0.0 {
                    return Err(InputError(format!(
                        "the {input} falls to {value:.4} times its reference at T = {time:.4}, but must stay above zero"
                    )));
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signals_have_the_printed_values() {
        let harmonic = Signal::Harmonic { amplitude: 0.1, period: 4.0 };
        assert!((harmonic.at(1.0) - 1.1).abs() < 1e-15 && harmonic.at(-3.0) == 1.0);
        // (4.33) at T = 2 and T = 1/8.
        let load = Signal::TwoScale { amplitudes: (0.8, 0.1), periods: (8.0, 0.5) };
        assert!((load.at(2.0) - 1.8).abs() < 1e-14);
        assert!((load.at(0.125) - (1.1 + 0.8 * (TAU / 64.0).sin())).abs() < 1e-14);
    }

    #[test]
    fn the_triangle_becomes_a_square() {
        let wave = |s| Signal::TriangleToSquare { amplitude: 0.1, period: 1.0, s };
        for (s, eighth) in [(0.0, 1.05), (0.5, 1.1), (0.9, 1.1)] {
            let wave = wave(s);
            for (time, want) in [(0.0, 1.0), (0.125, eighth), (0.25, 1.1), (0.5, 1.0), (0.75, 0.9), (1.0, 1.0)] {
                assert!((wave.at(time) - want).abs() < 1e-12, "s = {s} at {time}: {}", wave.at(time));
            }
        }
    }

    #[test]
    fn samples_are_joined_by_straight_lines_and_rest_at_both_ends() {
        let sampled = Signal::Sampled { times: vec![1.0, 2.0, 4.0], values: vec![1.0, 3.0, 2.0] };
        for (time, want) in [(0.0, 1.0), (1.5, 2.0), (3.0, 2.5), (4.0, 2.0), (9.0, 2.0)] {
            assert!((sampled.at(time) - want).abs() < 1e-14, "at {time}");
        }
    }

    #[test]
    fn signals_reach_but_never_pass_their_lower_bound() {
        let sampled = Signal::Sampled { times: vec![0.2, 0.7, 1.9], values: vec![1.0, 0.3, 2.0] };
        for signal in [
            Signal::Constant,
            Signal::Harmonic { amplitude: -0.7, period: 0.3 },
            Signal::TriangleToSquare { amplitude: 0.4, period: 0.9, s: 0.5 },
            Signal::Reversing { amplitude: 1.5, period: 0.8 },
            Signal::TwoScale { amplitudes: (0.5, -0.3), periods: (1.7, 0.11) },
            sampled,
        ] {
            let least = (0..=40_000).map(|k| signal.at(k as f64 * 1e-4)).fold(f64::INFINITY, f64::min);
            let floor = signal.floor();
            assert!(least >= floor && least < floor + 0.02, "{signal:?}: {least}, not {floor}");
        }
    }

    #[test]
    fn inputs_without_sense_are_refused_with_the_time() {
        let message = |inputs: Inputs| inputs.check(2.0).unwrap_err().to_string();
        let deep = Signal::Harmonic { amplitude: 1.2, period: 1.0 };
        assert!(message(Inputs::load(deep.clone())).starts_with("the load falls to -0.0"));
        assert!(message(Inputs::load(deep.clone())).contains("T = 0.65"));
        assert!(Inputs { speed: deep.clone(), ..Inputs::default() }.check(2.0).is_ok());
        assert!(Inputs::load(deep).check(0.5).is_ok());
        let reversing = Signal::Reversing { amplitude: 1.0, period: 1.0 };
        assert!(message(Inputs::load(reversing.clone())).starts_with("the load falls to"));
        assert!(Inputs { speed: reversing, ..Inputs::default() }.check(2.0).is_ok());
        let dip = Signal::Sampled { times: vec![0.0, 1.000_000_1, 1.1], values: vec![1.0, -0.5, 1.0] };
        assert!(message(Inputs { radius: dip, ..Inputs::default() }).contains("radius"));
        let order = Signal::Sampled { times: vec![0.0, 1.0, 1.0], values: vec![1.0; 3] };
        assert!(message(Inputs::load(order)).contains("entry 3"));
        let short = Signal::Sampled { times: vec![0.0, 1.0], values: vec![1.0; 3] };
        assert!(message(Inputs::load(short)).contains("2 times but 3 values"));
        let gap = Signal::Sampled { times: vec![0.0, 1.0], values: vec![1.0, f64::NAN] };
        assert!(message(Inputs::load(gap)).contains("finite"));
        for amplitude in [f64::NAN, f64::INFINITY] {
            let speed = Signal::Harmonic { amplitude, period: 1.0 };
            assert!(message(Inputs { speed, ..Inputs::default() }).contains("must be a finite number"), "{amplitude}");
        }
        let square = Signal::TriangleToSquare { amplitude: 0.1, period: 1.0, s: 1.0 };
        assert!(message(Inputs::load(square)).contains("steepness"));
        assert!(message(Inputs::load(Signal::Harmonic { amplitude: 0.1, period: 0.0 })).contains("period"));
    }
}
