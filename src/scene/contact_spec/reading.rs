//! A contact of texts: flags, cells of a table, keywords.

use super::fields::{ContactSpec, Field};
use super::refusal::{Refusal, refuse};
use crate::solver::physics::engineering::parse;

impl ContactSpec {
    /// States a field by a text; a number may have a unit, and one without is in `unit`, or in the field's own where that
    /// is empty.
    ///
    /// # Errors
    /// When the text is no value of the field.
    pub fn read(&mut self, field: Field, text: &str, unit: &str) -> Result<(), Refusal> {
        let facts = field.facts();
        if field.is_number() {
            let dimension = facts.dimension_in(self.kind());
            let unit = if unit.is_empty() { facts.bare.unwrap_or_else(|| dimension.si_unit()) } else { unit };
            return match parse(text, dimension, unit) {
                Ok(value) => {
                    self.set(field, value);
                    Ok(())
                }
                Err(error) => refuse(field, format!("<{}>: {error}", facts.name)),
            };
        }
        let refused = |why| Refusal::new(field, format!("<{}>: “{}” is none; {why}", facts.name, text.trim()));
        self.read_plain(field, text.trim()).map_err(refused)
    }

    /// States a field by a text in SI units, as the command line has it.
    ///
    /// # Errors
    /// When the text is no value of the field.
    pub fn read_si(&mut self, field: Field, text: &str) -> Result<(), Refusal> {
        self.read_plain(field, text).map_err(|why| Refusal::new(field, format!("<{}>: {why}", field.facts().name)))
    }

    /// Reads fields over another contact: texts with or without a unit, each with the unit of numbers that have none.
    ///
    /// # Errors
    /// With the first field whose text is no value of it.
    pub fn read_over<'a>(
        base: &Self,
        texts: impl IntoIterator<Item = (Field, &'a str, &'a str)>,
    ) -> Result<Self, Refusal> {
        let mut texts: Vec<_> = texts.into_iter().collect();
        // The unit of a load depends on the kind of contact, which is the first field.
        texts.sort_by_key(|(field, ..)| *field);
        let mut own = Self { contact: base.contact, ..Self::default() };
        texts.into_iter().try_for_each(|(field, text, unit)| own.read(field, text, unit))?;
        Ok(own.over(base.clone()))
    }
}
