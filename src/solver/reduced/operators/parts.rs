//! List of all parts of reduced operators.

use super::part::{Flow, Kind, Part, Setting};
use super::sampled_system::SampledSystem;
use super::support::Needed;
use super::{asperities, front, heat, shaped, traction};
use crate::solver::reduced::model::Window;

/// All kinds of parts. In each phase of an iteration the parts act in this order.
static KINDS: [Kind; 5] = [shaped::KIND, front::KIND, asperities::KIND, heat::KIND, traction::KIND];

/// Returns the nodes that the parts use in addition to those of the sampled equations.
pub(super) fn needed(window: &Window, flow: Flow<'_>) -> Needed {
    let mut nodes = Needed::default();
    KINDS.iter().for_each(|kind| (kind.nodes)(window, flow, &mut nodes));
    nodes
}

/// Creates the parts of the operators of a local model over their rows.
pub(super) fn parts_of(setting: Setting<'_>, system: &mut SampledSystem) -> Vec<Box<dyn Part>> {
    KINDS.iter().filter_map(|kind| (kind.make)(setting, system)).collect()
}
