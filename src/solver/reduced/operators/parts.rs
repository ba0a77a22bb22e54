//! The list of all parts that reduced operators are composed of.

use super::part::{Flow, Kind, Part, Setting};
use super::sampled_system::SampledSystem;
use super::support::Needed;
use super::{front, heat, shaped, traction};
use crate::solver::reduced::model::Window;

/// Every part that operators can have. In each phase of an iteration parts act in this order.
static KINDS: [Kind; 4] = [shaped::KIND, front::KIND, heat::KIND, traction::KIND];

/// The nodes that the parts of a window's operators read in addition to those of the sampled rows.
pub(super) fn needed(window: &Window, flow: Flow<'_>) -> Needed {
    let mut nodes = Needed::default();
    KINDS.iter().for_each(|kind| (kind.nodes)(window, flow, &mut nodes));
    nodes
}

/// Makes the parts of the operators of a window over their rows.
pub(super) fn parts_of(setting: Setting<'_>, system: &mut SampledSystem) -> Vec<Box<dyn Part>> {
    KINDS.iter().filter_map(|kind| (kind.make)(setting, system)).collect()
}
