//! Preset trainings, read from the built-in scenes.

use crate::scene::{Scene, Study};
use crate::solver::physics::contact::ContactKind;
use crate::solver::training::{TrainingSpec, Windows};
use std::sync::LazyLock;

/// Returns the presets for a kind of contact with their names. The tab shows the first one if the document has no
/// training.
pub fn of_kind(kind: ContactKind) -> Vec<(&'static str, &'static TrainingSpec)> {
    let all = if kind.is_line() {
        vec![("Table 3.1’s box", table_3_1()), ("Whole slider range", slider_range())]
    } else {
        vec![("Table 3.4’s box", table_3_4())]
    };
    all.into_iter().filter_map(|(name, spec)| Some((name, spec?))).collect()
}

/// Returns the range of Table 3.4, corrected, for one oil.
fn table_3_4() -> Option<&'static TrainingSpec> {
    static SPEC: LazyLock<Option<TrainingSpec>> =
        LazyLock::new(|| spec_of(include_str!("../../../../scenes/training/table_3_4_model.ron")));
    SPEC.as_ref()
}

/// Returns the range of Table 3.1 with the automatic algorithm.
fn table_3_1() -> Option<&'static TrainingSpec> {
    static SPEC: LazyLock<Option<TrainingSpec>> =
        LazyLock::new(|| spec_of(include_str!("../../../../scenes/plans/table_3_2_adaptive_graded.ron")));
    SPEC.as_ref()
}

/// Returns the range of the sliders, for one oil.
fn slider_range() -> Option<&'static TrainingSpec> {
    static SPEC: LazyLock<Option<TrainingSpec>> =
        LazyLock::new(|| spec_of(include_str!("../../../../scenes/training/slider_range_model.ron")));
    SPEC.as_ref()
}

fn spec_of(scene: &str) -> Option<TrainingSpec> {
    match Scene::from_ron(scene).ok()?.study {
        Study::Training(spec) => Some(spec),
        _ => None,
    }
}

/// Adapts the given local models to a changed range. Those outside the range are removed, and the outer ends move
/// to the ends of the range.
pub fn fit_windows(spec: &mut TrainingSpec) {
    let (low, high) = spec.domain().m();
    if !(low > 0.0 && low < high && high.is_finite()) {
        return;
    }
    let Windows::Given(windows) = &mut spec.windows else { return };
    let first = windows.first().copied();
    windows.retain(|w| w.m.0 < high && w.m.1 > low);
    if windows.is_empty() {
        windows.extend(first);
    }
    if let Some(window) = windows.first_mut() {
        window.m.0 = low;
    }
    if let Some(window) = windows.last_mut() {
        window.m.1 = high;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::discrete::grid::GridSpec;
    use crate::solver::parameters::Quantity;
    use crate::solver::training::WindowSpec;

    #[test]
    fn the_presets_are_trainings_that_can_be_started() {
        for (kind, count) in [(ContactKind::Line, 2), (ContactKind::Point, 1)] {
            let presets = of_kind(kind);
            assert_eq!(presets.len(), count);
            for (_, preset) in presets {
                preset.check().unwrap();
                assert_eq!(preset.contact(), kind);
            }
        }
    }

    #[test]
    fn windows_follow_the_range() {
        let grid = GridSpec::EXPLORER;
        let windows = [(2.0, 9.0), (9.0, 40.0), (40.0, 500.0)].map(|m| WindowSpec::new(m, grid));
        let mut spec = TrainingSpec { windows: Windows::Given(windows.into()), ..slider_range().unwrap().clone() };
        let mut fitted = |range| {
            spec.range.axis_mut(Quantity::M).unwrap().ends = range;
            fit_windows(&mut spec);
            spec.check().unwrap();
            let Windows::Given(windows) = &spec.windows else { panic!() };
            windows.iter().map(|w| w.m).collect::<Vec<_>>()
        };
        assert_eq!(fitted((20.0, 700.0)), [(20.0, 40.0), (40.0, 700.0)]);
        assert_eq!(fitted((1.0, 5.0)), [(1.0, 5.0)]);
    }
}
