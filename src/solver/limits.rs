//! What numbers from outside may be: finite and sane, and named where they are not.

/// A value that is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("`{field}` {problem}")]
pub struct Refused {
    /// The field, with dots between levels.
    pub field: String,
    /// What is wrong and what would be accepted.
    pub problem: String,
}

impl Refused {
    /// Refuses a field.
    pub fn new(field: impl Into<String>, problem: impl Into<String>) -> Self {
        Self { field: field.into(), problem: problem.into() }
    }

    /// The same seen from outside: the field belongs to another one.
    pub fn within(self, outer: &str) -> Self {
        Self { field: format!("{outer}.{}", self.field), ..self }
    }
}

/// A number in its shortest exact form, with an exponent where it is very small or large.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number(pub f64);

impl std::fmt::Display for Number {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let size = self.0.abs();
        if size != 0.0 && !(1e-4..1e15).contains(&size) { write!(f, "{:e}", self.0) } else { write!(f, "{}", self.0) }
    }
}

/// Refuses a number that is not finite or lies outside an interval.
///
/// # Errors
/// Naming the field.
pub fn number(field: &str, value: f64, low: f64, high: f64) -> Result<(), Refused> {
    if (low..=high).contains(&value) {
        return Ok(());
    }
    Err(Refused::new(field, format!("is {}, but must be a finite number between {low:e} and {high:e}", Number(value))))
}

/// Refuses a text for people that would move a terminal's cursor or colour its letters.
///
/// # Errors
/// Naming the field.
pub fn plain(field: &str, text: &str) -> Result<(), Refused> {
    if text.chars().any(char::is_control) {
        return Err(Refused::new(field, "has control characters; write plain text"));
    }
    Ok(())
}

/// Refuses a count outside an interval.
///
/// # Errors
/// Naming the field.
pub fn count(field: &str, value: usize, low: usize, high: usize) -> Result<(), Refused> {
    if (low..=high).contains(&value) {
        return Ok(());
    }
    Err(Refused::new(field, format!("is {value}, but must lie between {low} and {high}")))
}

/// Refuses an interval that is inverted or reaches beyond another one.
///
/// # Errors
/// Naming the field, and its end where one is wrong.
pub fn interval(field: &str, (from, to): (f64, f64), low: f64, high: f64) -> Result<(), Refused> {
    number(&format!("{field}.0"), from, low, high)?;
    number(&format!("{field}.1"), to, low, high)?;
    if from > to {
        let (from, to) = (Number(from), Number(to));
        return Err(Refused::new(field, format!("runs from {from} down to {to}; write the smaller value first")));
    }
    Ok(())
}

/// Four significant digits without trailing zeros.
pub fn digits(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let decimals = (3 - value.abs().log10().floor() as i32).clamp(0, 12) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}
