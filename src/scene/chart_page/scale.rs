//! Axis scales: ends, tick marks and numbers.

use crate::scene::chart::{ChartAxis, ColorScale};
use crate::scene::table::significant;

/// Scale of an axis: ends in the coordinate that is linear on paper (log₁₀ for logarithmic axes), and ticks.
pub struct Scale {
    log: bool,
    /// Lower end.
    pub from: f64,
    /// Upper end.
    pub to: f64,
    /// Tick values with their numbers or names.
    pub ticks: Vec<(f64, String)>,
}

impl Scale {
    /// Returns the scale with about `marks` ticks, or with the axis' names.
    pub fn of(axis: &ChartAxis, values: impl Iterator<Item = f64>, marks: f64) -> Self {
        let scale = Self::counted(axis, values, marks);
        if axis.names.is_empty() { scale } else { Self { ticks: axis.names.clone(), ..scale } }
    }

    fn counted(axis: &ChartAxis, values: impl Iterator<Item = f64>, marks: f64) -> Self {
        let place = |value: f64| if axis.log { value.log10() } else { value };
        if let Some((from, to)) = axis.ends.map(|(from, to)| (place(from), place(to)))
            && from < to
            && from.is_finite()
            && to.is_finite()
        {
            return Self::between(axis.log, from, to, marks);
        }
        let (mut from, mut to) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values.map(place) {
            (from, to) = (from.min(value), to.max(value));
        }
        if from > to {
            (from, to) = (0.0, 1.0);
        }
        if to - from <= 1e-12 * from.abs().max(to.abs()) {
            let half = if from == 0.0 { 1.0 } else { 0.5 * from.abs() };
            (from, to) = (from - half, to + half);
        }
        let margin = 0.03 * (to - from);
        Self::between(axis.log, from - margin, to + margin, marks)
    }

    fn between(log: bool, from: f64, to: f64, marks: f64) -> Self {
        Self { log, from, to, ticks: if log { decades(from, to) } else { steps(from, to, marks) } }
    }

    /// Returns the position of a value between the ends, 0 to 1.
    pub fn share(&self, value: f64) -> f64 {
        ((if self.log { value.log10() } else { value }) - self.from) / (self.to - self.from)
    }
}

/// Replaces hyphens by minus signs for print.
fn printed(number: String) -> String {
    number.replace('-', "−")
}

/// Returns ticks at multiples of 1, 2 or 5.
fn steps(from: f64, to: f64, marks: f64) -> Vec<(f64, String)> {
    let rough = (to - from) / marks;
    let power = 10f64.powf(rough.log10().floor());
    let step = power * [1.0, 2.0, 5.0, 10.0].into_iter().find(|times| times * power >= rough).unwrap_or(10.0);
    let (first, last) = ((from / step).ceil() as i64, (to / step).floor() as i64);
    let decimals = (-step.log10().floor()).max(0.0) as usize;
    let far = from.abs().max(to.abs());
    let text = |value: f64| match value {
        0.0 => "0".to_owned(),
        _ if (1e-3..1e5).contains(&far) => printed(format!("{value:.decimals$}")),
        _ => printed(significant(value, 2)),
    };
    (first..=last).map(|k| k as f64 * step).map(|value| (value, text(value))).collect()
}

/// Returns ticks at powers of ten, and at 2 and 5 times these on short axes.
fn decades(from: f64, to: f64) -> Vec<(f64, String)> {
    let (first, last) = (from.floor() as i32, to.ceil() as i32);
    let times: &[f64] = if to - from < 2.0 { &[1.0, 2.0, 5.0] } else { &[1.0] };
    let sparse = ((last - first) / 6).max(1);
    let all = (first..=last).filter(|k| (k - first) % sparse == 0);
    all.flat_map(|k| times.iter().map(move |times| times * 10f64.powi(k)))
        .filter(|value| (from..=to).contains(&value.log10()))
        .map(|value| (value, printed(significant(value, 1))))
        .collect()
}

/// Returns the numbers of a colour bar.
pub fn scale_ticks(scale: &ColorScale) -> Vec<(f64, String)> {
    if scale.ends.1 > scale.ends.0 { steps(scale.ends.0, scale.ends.1, 5.0) } else { Vec::new() }
}
