//! Reads a contact specification from texts: flags, table cells, keywords. Numbers may have a unit.

use super::fields::{ContactSpec, Field};
use super::given::ValueError;
use super::refusal::Refusal;
use crate::solver::physics::engineering::{Dimension, UnitError, parse};

impl ContactSpec {
    /// Sets a field from a text. A number without a unit has the unit `unit`, or the field's default unit if `unit` is
    /// empty.
    ///
    /// # Errors
    /// If the text is not a valid value of the field.
    pub fn read(&mut self, field: Field, text: &str, unit: &str) -> Result<(), Refusal> {
        let facts = field.facts();
        if field.is_number() {
            let refused = |error| Refusal::new(field, format!("<{}>: {error}", facts.name));
            return self.read_number(field, text, unit).map_err(refused);
        }
        let refused = |why| Refusal::new(field, format!("<{}>: “{}” is not valid; {why}", facts.name, text.trim()));
        self.read_plain(field, text.trim()).map_err(refused)
    }

    /// Sets a field from the text of a flag.
    ///
    /// # Errors
    /// If the text is not a valid value of the field.
    pub fn read_flag(&mut self, field: Field, text: &str) -> Result<(), Refusal> {
        self.read_typed(field, text).map_err(|why| Refusal::new(field, format!("<{}>: {why}", field.facts().name)))
    }

    /// Sets a field from the text of a flag. Numbers that are not finite are read: the refusal of the contact names the
    /// accepted range.
    pub(super) fn read_typed(&mut self, field: Field, text: &str) -> Result<(), ValueError> {
        match text.parse::<f64>() {
            _ if !field.is_number() => self.read_plain(field, text),
            Ok(number) if !number.is_finite() => {
                self.set(field, number);
                Ok(())
            }
            _ => Ok(self.read_number(field, text, "")?),
        }
    }

    /// Sets a number from a text. The unit of numbers without one is `unit`, or if that is empty that of
    /// [`Facts::units`](super::facts::Facts::units).
    pub(super) fn read_number(&mut self, field: Field, text: &str, unit: &str) -> Result<(), UnitError> {
        let facts = field.facts();
        let dimension = match field {
            Field::U1 => Dimension::Speed { radius_m: self.radius1.map(f64::abs) },
            Field::U2 => Dimension::Speed { radius_m: self.radius2.map(f64::abs) },
            _ => facts.dimension_in(self.kind()),
        };
        let unit = if unit.is_empty() { facts.bare.unwrap_or_else(|| dimension.si_unit()) } else { unit };
        let parsed = parse(text, dimension, unit);
        // A force is the load of a line contact over its whole length.
        if field == Field::Load
            && self.kind().is_line()
            && parsed.is_err()
            && let Ok(total) = parse(text, Dimension::Force, unit)
        {
            self.total_load = Some(total);
            return Ok(());
        }
        self.set(field, parsed?);
        Ok(())
    }

    /// Sets a number in the unit of numbers that are written without one: that of SI, but °C for the temperature of an
    /// oil.
    pub fn set_as_typed(&mut self, field: Field, value: f64) {
        let facts = field.facts();
        let in_si = |unit| parse(&value.to_string(), facts.dimension_in(self.kind()), unit).unwrap_or(f64::NAN);
        self.set(field, facts.bare.map_or(value, in_si));
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
        texts.sort_by_key(|(field, ..)| field.reading_order());
        // The kind determines the unit of a load, the radii convert revolutions per minute.
        let mut own = Self { contact: base.contact, radius1: base.radius1, radius2: base.radius2, ..Self::default() };
        texts.iter().try_for_each(|(field, text, unit)| own.read(*field, text, unit))?;
        for field in [Field::Radius1, Field::Radius2] {
            if !texts.iter().any(|(own, ..)| *own == field) {
                own.forget(field);
            }
        }
        Ok(own.over(base.clone()))
    }
}
