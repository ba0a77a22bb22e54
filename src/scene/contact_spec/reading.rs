//! Reads a contact specification from texts: flags, table cells, keywords.

use super::fields::{ContactSpec, Field};
use super::refusal::{Refusal, refuse};
use crate::solver::physics::engineering::{Dimension, parse};

impl ContactSpec {
    /// Sets a field from a text. A number without a unit has the unit `unit`, or the field's default unit if `unit` is
    /// empty.
    ///
    /// # Errors
    /// If the text is not a valid value of the field.
    pub fn read(&mut self, field: Field, text: &str, unit: &str) -> Result<(), Refusal> {
        let facts = field.facts();
        if field.is_number() {
            let dimension = facts.dimension_in(self.kind());
            let unit = if unit.is_empty() { facts.bare.unwrap_or_else(|| dimension.si_unit()) } else { unit };
            // A force is the load of a line contact over its whole length.
            if field == Field::Load
                && self.kind().is_line()
                && parse(text, dimension, unit).is_err()
                && let Ok(total) = parse(text, Dimension::Force, unit)
            {
                self.total_load = Some(total);
                return Ok(());
            }
            return match parse(text, dimension, unit) {
                Ok(value) => {
                    self.set(field, value);
                    Ok(())
                }
                Err(error) => refuse(field, format!("<{}>: {error}", facts.name)),
            };
        }
        let refused = |why| Refusal::new(field, format!("<{}>: “{}” is not valid; {why}", facts.name, text.trim()));
        self.read_plain(field, text.trim()).map_err(refused)
    }

    /// Sets a field from a text in SI units, as on the command line.
    ///
    /// # Errors
    /// If the text is not a valid value of the field.
    pub fn read_si(&mut self, field: Field, text: &str) -> Result<(), Refusal> {
        self.read_plain(field, text).map_err(|why| Refusal::new(field, format!("<{}>: {why}", field.facts().name)))
    }

    /// Reads fields and fills the others from `base`. Each text may have a unit and is followed by the unit for numbers
    /// without one.
    ///
    /// # Errors
    /// With the first field whose text is not a valid value.
    pub fn read_over<'a>(
        base: &Self,
        texts: impl IntoIterator<Item = (Field, &'a str, &'a str)>,
    ) -> Result<Self, Refusal> {
        let mut texts: Vec<_> = texts.into_iter().collect();
        // The contact kind is the first field and must be read first, because the unit of a load depends on it.
        texts.sort_by_key(|(field, ..)| *field);
        let mut own = Self { contact: base.contact, ..Self::default() };
        texts.into_iter().try_for_each(|(field, text, unit)| own.read(field, text, unit))?;
        Ok(own.over(base.clone()))
    }
}
