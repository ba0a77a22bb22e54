//! States of an instance that can be saved and serialised.

use crate::border::Refused;
use ehl_explorer::engine::coupled::{InTimeState, Inputs, Outputs};

/// Changing data of an instance, except for the transient contact.
#[derive(Clone)]
pub struct State {
    pub time: f64,
    pub inputs: Inputs,
    /// Outputs for the inputs; `None` if the inputs have changed since. For a transient contact, the outputs at the end
    /// of the last step, also if inputs have been set since.
    pub outputs: Option<Outputs>,
    /// True after the initialisation. A transient contact then changes only by steps.
    pub stepping: bool,
}

impl State {
    /// Returns the state before the initialisation.
    pub fn first(inputs: Inputs) -> Self {
        Self { time: 0.0, inputs, outputs: None, stepping: false }
    }
}

/// Saved state of an instance.
pub struct Kept {
    pub state: State,
    /// State of a transient contact that has started.
    pub contact: Option<InTimeState>,
}

/// Format identifiers at the beginning of a serialised state, for steady and transient contacts.
const FORMS: [&[u8; 8]; 2] = [b"EHLFMU03", b"EHLFMU04"];
/// Number of numbers in a serialised state: time and inputs. Outputs are computed from them. For a transient contact,
/// they are followed by the end-of-initialisation flag and the state of the contact, if it has started.
const NUMBERS: usize = 1 + Inputs::COUNT;

impl Kept {
    pub fn written(&self, in_time: bool) -> Result<Vec<u8>, Refused> {
        let numbers = std::iter::once(self.state.time).chain(self.state.inputs.numbers());
        let form = FORMS[usize::from(in_time)];
        let mut written: Vec<u8> = form.iter().copied().chain(numbers.flat_map(f64::to_le_bytes)).collect();
        if in_time {
            written.push(u8::from(self.state.stepping));
            if let Some(contact) = &self.contact {
                written.extend(contact.to_bytes()?);
            }
        }
        Ok(written)
    }

    pub fn read(bytes: &[u8], in_time: bool) -> Result<Self, Refused> {
        let none = "this is not a state of this unit";
        let (body, rest) = bytes
            .strip_prefix(FORMS[usize::from(in_time)])
            .and_then(|body| body.split_at_checked(8 * NUMBERS))
            .ok_or(none)?;
        let (stepping, contact) = match (rest.split_first(), in_time) {
            (None, false) => (true, None),
            (Some((stepping, [])), true) => (*stepping != 0, None),
            (Some((stepping, contact)), true) => (*stepping != 0, Some(InTimeState::from_bytes(contact)?)),
            _ => return Err(none.into()),
        };
        let mut numbers = [0.0; NUMBERS];
        for (number, bytes) in numbers.iter_mut().zip(body.as_chunks().0) {
            *number = f64::from_le_bytes(*bytes);
        }
        if !numbers.iter().all(|number| number.is_finite()) {
            return Err("the state holds a number that is not finite".into());
        }
        let [time, inputs @ ..] = numbers;
        let inputs = Inputs::from_numbers(inputs);
        Ok(Self { state: State { time, inputs, outputs: None, stepping }, contact })
    }
}
