//! Interfaces and how they spell the fields of a contact.

/// Interface, by its spelling of fields.
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
    /// Variables of a Functional Mock-up Unit: `inlet_temperature`, between backticks.
    Variables,
}
