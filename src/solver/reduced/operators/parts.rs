//! List of all kinds of parts of reduced operators. A part is one piece of the physics or of the numerics, such as the
//! cavitation boundary, asperities or heat. It adds its terms to the sampled equations of a local model.

use super::part::{Flow, Kind, Part, Setting};
use super::sampled_system::SampledSystem;
use super::support::Needed;
use super::{asperities, front, heat, shaped, traction};
use crate::solver::reduced::model::Window;

/// All kinds of parts. In each phase of an iteration the parts are called in this order.
static KINDS: [Kind; 5] = [shaped::KIND, front::KIND, asperities::KIND, heat::KIND, traction::KIND];

/// Returns the nodes that the parts of a local model use in addition to those of the sampled equations.
pub(super) fn needed(window: &Window, flow: Flow<'_>) -> Needed {
    let mut nodes = Needed::default();
    KINDS.iter().for_each(|kind| (kind.nodes)(window, flow, &mut nodes));
    nodes
}

/// Creates the parts that a local model needs. A part may add rows and nodes to the system.
pub(super) fn parts_of(setting: Setting<'_>, system: &mut SampledSystem) -> Vec<Box<dyn Part>> {
    KINDS.iter().filter_map(|kind| (kind.make)(setting, system)).collect()
}
