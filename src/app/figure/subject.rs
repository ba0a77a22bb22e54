//! What a plot is of.

/// What a plot is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// The contact of the sliders.
    Sliders,
    /// The same in the light of the contact map.
    Map,
    /// The sweep of the traction curve.
    Sweep,
    /// The contact in time that was run.
    InTime,
}
