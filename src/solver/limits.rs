//! Checks of values from outside the program: each must be finite and within its range. A refusal names the field.

/// Refusal of a value.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("`{field}` {problem}")]
pub struct Refused {
    /// Name of the field, with dots between the levels.
    pub field: String,
    /// What is wrong, and what is accepted.
    pub problem: String,
}

impl Refused {
    /// Creates a refusal of the given field.
    pub fn new(field: impl Into<String>, problem: impl Into<String>) -> Self {
        Self { field: field.into(), problem: problem.into() }
    }

    /// Returns the same refusal with the name of the enclosing field in front.
    pub fn within(self, outer: &str) -> Self {
        Self { field: format!("{outer}.{}", self.field), ..self }
    }
}

/// Number displayed in its shortest exact form, with an exponent if it is very small or very large.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number(pub f64);

impl std::fmt::Display for Number {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let size = self.0.abs();
        if size != 0.0 && !(1e-4..1e15).contains(&size) { write!(f, "{:e}", self.0) } else { write!(f, "{}", self.0) }
    }
}

/// Checks that a number is finite and lies between `low` and `high`, both included.
///
/// # Errors
/// [`Refused`] with the name of the field if it does not.
pub fn number(field: &str, value: f64, low: f64, high: f64) -> Result<(), Refused> {
    if (low..=high).contains(&value) {
        return Ok(());
    }
    Err(Refused::new(field, format!("is {}, but must be a finite number between {low:e} and {high:e}", Number(value))))
}

/// Checks that a text has no control characters, which could move the cursor or change the colours of a terminal.
///
/// # Errors
/// [`Refused`] with the name of the field if it has any.
pub fn plain(field: &str, text: &str) -> Result<(), Refused> {
    if text.chars().any(char::is_control) {
        return Err(Refused::new(field, "has control characters; write plain text"));
    }
    Ok(())
}

/// Checks that a count lies between `low` and `high`, both included.
///
/// # Errors
/// [`Refused`] with the name of the field if it does not.
pub fn count(field: &str, value: usize, low: usize, high: usize) -> Result<(), Refused> {
    if (low..=high).contains(&value) {
        return Ok(());
    }
    Err(Refused::new(field, format!("is {value}, but must lie between {low} and {high}")))
}

/// Checks that an interval is not inverted and lies between `low` and `high`.
///
/// # Errors
/// [`Refused`] with the name of the field, and with `.0` or `.1` if one end is out of range.
pub fn interval(field: &str, (from, to): (f64, f64), low: f64, high: f64) -> Result<(), Refused> {
    number(&format!("{field}.0"), from, low, high)?;
    number(&format!("{field}.1"), to, low, high)?;
    if from > to {
        let (from, to) = (Number(from), Number(to));
        return Err(Refused::new(field, format!("runs from {from} down to {to}; write the smaller value first")));
    }
    Ok(())
}

/// Formats a number with four significant digits and without trailing zeros.
pub fn digits(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let decimals = (3 - value.abs().log10().floor() as i32).clamp(0, 12) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}
