//! How each interface spells the fields of a contact.

/// An interface, by the way it spells fields.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Words {
    /// Flags of the command line: `--radius-y`.
    Flags,
    /// Keywords of Python: `radius_y=`.
    Keywords,
    /// Columns of a table of load cases: `radius-y`.
    Columns,
    /// Fields of a scene: `radius_y`, between backticks.
    Scene,
    /// Variables of a Functional Mock-up Unit: `radius_ratio`, between backticks.
    Variables,
}
