//! The three inputs of a contact in time, and taking them from a table.

use crate::app::document::Document;
use crate::app::refusal::Refusal;
use crate::scene::{TransientStudy, sampled};
use crate::solver::full::transient::{Inputs, Signal};
use std::path::Path;

/// Most rows of a table that a document keeps; undo keeps them many times over.
const MOST_ROWS: usize = 20_000;

/// One of the inputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Input {
    /// w̄(T).
    Load,
    /// ū(T).
    Speed,
    /// R̄(T).
    Radius,
}

impl Input {
    /// All of them, the one most often varied first.
    pub const ALL: [Self; 3] = [Self::Load, Self::Speed, Self::Radius];

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Load => "Load",
            Self::Speed => "Speed",
            Self::Radius => "Radius",
        }
    }

    /// Its function of time.
    pub fn of(self, inputs: &Inputs) -> &Signal {
        match self {
            Self::Load => &inputs.load,
            Self::Speed => &inputs.speed,
            Self::Radius => &inputs.radius,
        }
    }

    /// Its function of time, to be changed.
    pub fn of_mut(self, inputs: &mut Inputs) -> &mut Signal {
        match self {
            Self::Load => &mut inputs.load,
            Self::Speed => &mut inputs.speed,
            Self::Radius => &mut inputs.radius,
        }
    }
}

impl Document {
    /// Takes the inputs that a table has columns of from there; the document keeps their values.
    ///
    /// # Errors
    /// A sentence with the line that makes no sense, or why an input is refused; nothing is changed then.
    pub fn read_inputs(&mut self, path: &Path) -> Result<(), Refusal> {
        let mut study = TransientStudy { sampled: None, ..self.transient_study() };
        sampled::read_into(&mut study.inputs, path)?;
        let rows = |input: Input| match input.of(&study.inputs) {
            Signal::Sampled { times, .. } => times.len(),
            _ => 0,
        };
        if let Some(rows) = Input::ALL.map(rows).into_iter().max().filter(|rows| *rows > MOST_ROWS) {
            return Err(Refusal::new(format!(
                "the table has {rows} rows, but a scene that is edited here keeps at most {MOST_ROWS}; thin it out, or name the file \
                 in the scene as `sampled`"
            )));
        }
        self.set_transient(study)
    }
}
