//! The three inputs of a transient contact, and reading them from a table.

use crate::app::document::Document;
use crate::app::refusal::Refusal;
use crate::scene::TransientStudy;
use crate::scene::sampled::{self, Reference};
use crate::solver::full::transient::{Inputs, Signal};
use std::path::Path;

/// Maximum number of rows of a table in a document. The limit exists because undo stores many copies.
const MOST_ROWS: usize = 20_000;

/// Input of a transient contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Input {
    /// w̄(T), relative load.
    Load,
    /// ū(T), relative speed.
    Speed,
    /// R̄(T), relative radius.
    Radius,
}

impl Input {
    /// All inputs, the most frequently varied first.
    pub const ALL: [Self; 3] = [Self::Load, Self::Speed, Self::Radius];

    /// Returns the name on the screen.
    pub fn name(self) -> &'static str {
        match self {
            Self::Load => "Load",
            Self::Speed => "Speed",
            Self::Radius => "Radius",
        }
    }

    /// Returns the function of time of this input.
    pub fn of(self, inputs: &Inputs) -> &Signal {
        match self {
            Self::Load => &inputs.load,
            Self::Speed => &inputs.speed,
            Self::Radius => &inputs.radius,
        }
    }

    /// Returns the function of time of this input, to be changed.
    pub fn of_mut(self, inputs: &mut Inputs) -> &mut Signal {
        match self {
            Self::Load => &mut inputs.load,
            Self::Speed => &mut inputs.speed,
            Self::Radius => &mut inputs.radius,
        }
    }
}

impl Document {
    /// Reads the inputs for which a table has columns. The document stores their values, and the run ends with them.
    ///
    /// # Errors
    /// A sentence with the invalid line, or the reason why an input is refused. The document is then
    /// unchanged.
    pub fn read_inputs(&mut self, path: &Path) -> Result<(), Refusal> {
        let mut study = TransientStudy { sampled: None, ..self.transient_study() };
        let contact = self.view.machine.as_ref().filter(|_| self.machine_counts());
        let contact = contact.and_then(|machine| machine.contact(self.point.modulus_pa).ok());
        let length_m = contact.and_then(|contact| contact.length_m);
        study.duration = sampled::read_into(&mut study.inputs, path, &Reference { point: self.point, length_m })?;
        let rows = |input: Input| match input.of(&study.inputs) {
            Signal::Sampled { times, .. } => times.len(),
            _ => 0,
        };
        if let Some(rows) = Input::ALL.map(rows).into_iter().max().filter(|rows| *rows > MOST_ROWS) {
            return Err(Refusal::new(format!(
                "the table has {rows} rows, but a scene edited here stores at most {MOST_ROWS}; reduce the table, or \
                 name the file in the scene as `sampled`"
            )));
        }
        self.set_transient(study)
    }
}
