//! Common axes of the plots along one quantity: positions of samples, and the ranges that are shown.

use super::sweeps::{Choices, SlideView};
use crate::app::document::Key;
use crate::app::numbers;
use crate::app::tabs::traction::{Against, Sample, Sweep};
use crate::solver::full::PLAUSIBLE_TRACTION;
use crate::solver::physics::engineering::{Unit, UnitSystem};

/// Number of axis heights above the axis up to which curves are drawn.
const HEIGHTS: f64 = 20.0;
/// Lower end of a logarithmic axis of SRR in percent.
const LEAST_SRR: f64 = 0.1;
/// Upper end of the view of small SRR in percent.
pub const NEAR_SRR: f64 = 10.0;

/// Points in the units of the axes.
pub(super) type Points2 = Vec<[f64; 2]>;

/// Quantity of a sample. `None` if it is not available.
pub(super) type Quantity = fn(&Sample) -> Option<f64>;

/// Positions of samples on the axes, including logarithms.
#[derive(Clone, Copy)]
pub(super) struct Axes<'a> {
    pub against: Against,
    pub sweep: &'a Sweep,
    pub logarithmic: (bool, bool),
    /// Range of the displayed axis along the quantity.
    pub ends: (f64, f64),
    /// Unit of the horizontal axis.
    pub unit: Unit,
}

impl<'a> Axes<'a> {
    pub fn new(choices: &Choices, sweep: &'a Sweep, system: UnitSystem) -> Self {
        let (against, lubricant) = (choices.against, sweep.base.lubricant);
        let logarithmic = (choices.logarithmic_along(), choices.logarithmic.1);
        let unit = against.unit(system);
        let of = |value: f64| against.of(&Key { point: sweep.varied.at(&sweep.base.point, value), lubricant });
        let at = |value: f64| unit.number(of(value));
        let (first, last) = (at(sweep.ends.0), at(sweep.ends.1));
        let (from, to) = match (against, choices.slide) {
            (Against::SlideToRoll, SlideView::Near) => (first, last.min(NEAR_SRR)),
            (Against::SlideToRoll, SlideView::Logarithmic) => (first.max(LEAST_SRR), last),
            _ => (first.min(last), first.max(last)),
        };
        let ends = if logarithmic.0 { (from.log10(), to.log10()) } else { (from, to) };
        Self { against, sweep, logarithmic, ends, unit }
    }

    /// Returns the position on the axis as drawn. `None` if the value has no logarithm.
    pub fn along(&self, value: f64) -> Option<f64> {
        drawn(self.unit.number(value), self.logarithmic.0)
    }

    /// Returns the value at a position on the axis.
    pub fn value(&self, place: f64) -> f64 {
        self.unit.si(if self.logarithmic.0 { 10f64.powf(place) } else { place })
    }

    pub fn shows(&self, place: f64) -> bool {
        let slack = 1e-9 * (self.ends.1 - self.ends.0);
        (self.ends.0 - slack..=self.ends.1 + slack).contains(&place)
    }

    pub fn place(&self, sample: &Sample) -> Option<f64> {
        self.along(self.against.of(&Key { point: sample.point, lubricant: self.sweep.base.lubricant }))
    }

    /// Returns the points of a quantity of samples in a unit.
    pub fn points<'s>(&self, samples: impl IntoIterator<Item = &'s Sample>, (of, unit): (Quantity, Unit)) -> Points2 {
        let up = |sample| drawn(unit.number(of(sample)?), self.logarithmic.1);
        samples.into_iter().filter_map(|sample| Some([self.place(sample)?, up(sample)?])).collect()
    }

    /// Returns the ends of the vertical axis for the displayed values: from zero, or from the smallest value if the
    /// axis is logarithmic.
    pub fn up(&self, values: impl Iterator<Item = f64>) -> (f64, f64) {
        let (least, most) = values
            .filter(|value| value.is_finite() && (*value > 0.0 || !self.logarithmic.1))
            .fold((f64::INFINITY, 0.0f64), |(least, most), value| (least.min(value), most.max(value)));
        match self.logarithmic.1 {
            true if most <= 0.0 => (-3.0, 0.0),
            true => ((0.8 * least).log10(), (1.25 * most).log10()),
            false if most <= 0.0 => (0.0, PLAUSIBLE_TRACTION),
            false => (0.0, numbers::round_up(1.08 * most)),
        }
    }
}

/// Returns the parts of a curve below a level of several axis heights, cut where the curve crosses it. An
/// unphysical curve can exceed the plot by a factor of millions, and dashes along all of it would take too long to
/// draw.
pub(super) fn near(points: Points2, up: (f64, f64)) -> Points2 {
    let level = up.1 + HEIGHTS * (up.1 - up.0);
    let mut kept = Points2::with_capacity(points.len());
    let mut former: Option<[f64; 2]> = None;
    for [x, y] in points {
        if let Some([x_0, y_0]) = former
            && (y_0 > level) != (y > level)
        {
            kept.push([x_0 + (level - y_0) / (y - y_0) * (x - x_0), level]);
        }
        if y <= level {
            kept.push([x, y]);
        }
        former = Some([x, y]);
    }
    kept
}

pub(super) fn drawn(value: f64, logarithmic: bool) -> Option<f64> {
    if !logarithmic { Some(value) } else { (value > 0.0).then(|| value.log10()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_are_clipped_at_the_frame() {
        let steep = vec![[0.0, 0.0], [1.0, 0.02], [2.0, 4.22], [3.0, 8e5], [4.0, 0.01]];
        let kept = near(steep, (0.0, 0.1));
        assert_eq!((kept.len(), kept[0], kept[1], kept[4]), (5, [0.0, 0.0], [1.0, 0.02], [4.0, 0.01]));
        let crossing = 1.0 + (2.1 - 0.02) / 4.2;
        assert!((kept[2][0] - crossing).abs() < 1e-12 && (kept[2][1] - 2.1).abs() < 1e-12, "{kept:?}");
        assert!((kept[3][0] - 4.0).abs() < 1e-4 && (kept[3][1] - 2.1).abs() < 1e-12, "{kept:?}");
        assert_eq!(near(vec![[0.0, 0.3], [1.0, 0.2]], (0.0, 0.1)).len(), 2);
    }
}
