//! Formatting of numbers for the screen (four significant digits, a thin space before the unit) and parsing of
//! typed numbers.

use crate::app::refusal::Refusal;
use crate::engine::job::Standing;
use crate::scene::table::is_whole;
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::{ContactKind, Moes, OperatingPoint};
use crate::solver::physics::engineering::{Digits, QuantityKind, Unit, UnitSystem};

/// Thin space between a number and its unit.
pub const THIN: char = '\u{2009}';

/// Returns four significant digits. Uses a power of ten only for very large or small numbers.
pub fn significant(value: f64) -> String {
    digits(value, 4)
}

/// Returns whole numbers without decimals, others as [`significant`].
pub fn counted(value: f64) -> String {
    // Adding zero removes the sign from −0.
    if is_whole(value) { format!("{:.0}", value + 0.0).replace('-', "−") } else { significant(value) }
}

/// Returns a number with `count` significant digits.
pub fn digits(value: f64, count: usize) -> String {
    if !value.is_finite() {
        return "–".to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    let count = count.max(1);
    // Use the exponent after rounding: 9.99999 becomes 10.00, not 10.000.
    let scientific = format!("{value:.*e}", count - 1);
    let exponent = scientific.rsplit('e').next().and_then(|e| e.parse::<i32>().ok()).unwrap_or(0);
    let text = if (-4..=5).contains(&exponent) {
        let decimals = (count as i32 - 1 - exponent).max(0) as usize;
        format!("{value:.decimals$}")
    } else {
        scientific
    };
    text.replace('-', "−")
}

/// Returns the value rounded to `count` significant digits.
pub fn rounded(value: f64, count: usize) -> f64 {
    format!("{value:.*e}", count.max(1) - 1).parse().unwrap_or(value)
}

/// Returns a number with its unit.
pub fn quantity(value: f64, unit: &str) -> String {
    if unit.is_empty() { significant(value) } else { format!("{}{THIN}{unit}", significant(value)) }
}

/// Returns a value in SI units as text, in the largest unit of the system that fits.
pub fn shown(kind: QuantityKind, si: f64, system: UnitSystem) -> String {
    in_unit(kind, si, kind.unit_of(system, si))
}

/// Returns a value in SI units as text, in the unit that fields of its kind have.
pub fn in_field_unit(kind: QuantityKind, si: f64, system: UnitSystem) -> String {
    in_unit(kind, si, kind.unit(system))
}

fn in_unit(kind: QuantityKind, si: f64, unit: Unit) -> String {
    let number = unit.number(si);
    let text = match kind.digits() {
        Digits::Significant(count) => digits(number, count),
        Digits::Decimals(count) if number.is_finite() => format!("{number:.count$}").replace('-', "−"),
        Digits::Decimals(_) => "–".to_owned(),
    };
    if unit.name.is_empty() { text } else { format!("{text}{THIN}{}", unit.name) }
}

/// Returns a pressure in Pa as text.
pub fn pressure(pascal: f64, system: UnitSystem) -> String {
    shown(QuantityKind::Pressure, pascal, system)
}

/// Returns a length in m as text.
pub fn length(metre: f64, system: UnitSystem) -> String {
    shown(QuantityKind::Length, metre, system)
}

/// Returns the load of a line or a point contact as text.
pub fn load(si: f64, kind: ContactKind, system: UnitSystem) -> String {
    in_field_unit(Quantity::Load.kind(kind), si, system)
}

/// Returns a slide-to-roll ratio as text in percent.
pub fn slide_to_roll(ratio: f64) -> String {
    shown(QuantityKind::Percent, ratio, UnitSystem::default())
}

/// Returns a time in s as text in µs, ms or s.
pub fn duration(second: f64) -> String {
    let short = |value: f64, unit: &str| format!("{}{THIN}{unit}", digits(value, 3));
    if second >= 1.0 {
        short(second, "s")
    } else if second >= 1e-3 {
        short(second * 1e3, "ms")
    } else {
        short(second * 1e6, "µs")
    }
}

/// Returns the progress of a job and its remaining time.
pub fn standing(standing: &Standing) -> String {
    let amount = if standing.total > 0 { format!("{} of {}", standing.done, standing.total) } else { String::new() };
    match standing.left_s {
        Some(left) if standing.total > 0 && left >= 1.0 => format!("{amount}, {} left", remaining(left)),
        Some(_) if standing.total > 0 => format!("{amount}, less than a second left"),
        _ if standing.total > 0 => format!("{amount}, {} so far", duration(standing.since_s)),
        _ => duration(standing.since_s),
    }
}

/// Returns a remaining time, rounded to its accuracy.
pub fn remaining(seconds: f64) -> String {
    if seconds < 90.0 { format!("{seconds:.0}{THIN}s") } else { format!("{:.0}{THIN}min", seconds / 60.0) }
}

/// Returns a relative deviation with its sign in percent.
pub fn percent(relative: f64) -> String {
    let text = format!("{}{THIN}%", digits(100.0 * relative, 3));
    if relative > 0.0 { format!("+{text}") } else { text }
}

/// Returns a share in whole percent.
pub fn share(of: f64) -> String {
    format!("{:.0}{THIN}%", 100.0 * of)
}

/// Returns the magnitude of a relative error in percent: two digits, at most four decimals, never a power of ten.
pub fn error_percent(relative: f64) -> String {
    let percent = 100.0 * relative.abs();
    if !percent.is_finite() {
        return "–".to_owned();
    }
    if percent < 1e-4 {
        return format!("<{THIN}0.0001{THIN}%");
    }
    let decimals = (1.0 - percent.log10().floor()).clamp(0.0, 4.0) as usize;
    format!("{percent:.decimals$}{THIN}%")
}

/// Returns the magnitude of a small deviation or residual: two digits, or one if a power of ten is needed.
pub fn small(value: f64) -> String {
    digits(value.abs(), if value.abs() < 1e-4 { 1 } else { 2 })
}

/// Returns M and L of a contact.
pub fn moes(Moes { m, l }: Moes) -> String {
    format!("M {}, L {}", significant(m), significant(l))
}

/// Returns M and L of a contact, and R_y/R of an elliptical one.
pub fn contact(point: &OperatingPoint) -> String {
    let moes = moes(point.moes());
    match point.stated_ratio() {
        Some(ratio) => format!("{moes}, R_y/R {}", significant(ratio)),
        None => moes,
    }
}

/// Parses a typed number with decimal point or comma, any minus sign, and exponents.
///
/// # Errors
/// A sentence that repeats the typed text.
pub fn parse(text: &str) -> Result<f64, Refusal> {
    let plain: String = text
        .trim()
        .chars()
        .filter(|c| !c.is_whitespace())
        .map(|c| match c {
            ',' => '.',
            '−' | '–' => '-',
            other => other,
        })
        .collect();
    if plain.is_empty() {
        return Err(Refusal::new("a number is needed here"));
    }
    match plain.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(Refusal::new(format!("“{}” is no number; write it like 12.5 or 2.2e3", text.trim()))),
    }
}

/// Returns the smallest value of a short list of round numbers (1, 1.2, 1.5, 2, …) that is not below `value`. Axes
/// therefore stay fixed while values change slightly.
pub fn round_up(value: f64) -> f64 {
    if !(value.is_finite() && value > 0.0) {
        return 1.0;
    }
    let decade = 10f64.powf(value.log10().floor());
    let mantissa = value / decade;
    let step = [1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0].into_iter().find(|s| *s >= mantissa - 1e-9);
    decade * step.unwrap_or(10.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_significant_digits_everywhere() {
        for (value, text) in [
            (0.039972, "0.03997"),
            (12.3456, "12.35"),
            (9.999_99, "10.00"),
            (-1.0, "−1.000"),
            (123456.0, "123456"),
            (1.5e-7, "1.500e−7"),
            (0.0, "0"),
            (f64::NAN, "–"),
        ] {
            assert_eq!(significant(value), text);
        }
        for (value, text) in
            [(10.0, "10"), (-0.0, "0"), (-3.0, "−3"), (10.5, "10.50"), (2e6, "2.000e6"), (f64::NAN, "–")]
        {
            assert_eq!(counted(value), text);
        }
        assert_eq!([rounded(0.123_45, 3), rounded(-98_765.0, 2), rounded(0.0, 3)], [0.123, -99_000.0, 0.0]);
        for (system, p, h, t) in [
            (UnitSystem::Engineering, "1.147 GPa", "0.2280 µm", "80.0 °C"),
            (UnitSystem::Imperial, "166.3 ksi", "8.976 µin", "176.0 °F"),
            (UnitSystem::Si, "1.147e9 Pa", "2.280e−7 m", "353.1 K"),
        ] {
            let texts = [
                pressure(1.1469e9, system),
                length(2.28e-7, system),
                shown(QuantityKind::Temperature, 353.149, system),
            ];
            assert_eq!(texts, [p, h, t].map(|text| text.replace(' ', &THIN.to_string())));
        }
        assert_eq!(slide_to_roll(0.1), "10.0\u{2009}%");
    }

    #[test]
    fn what_runs_says_how_much_is_done_and_how_long_the_rest_takes() {
        let of = |done, total, left_s| Standing { stage: String::new(), done, total, left_s, since_s: 3.0 };
        for (is, text) in [
            (of(3, 12, Some(27.4)), "3 of 12, 27\u{2009}s left"),
            (of(3, 12, Some(600.0)), "3 of 12, 10\u{2009}min left"),
            (of(11, 12, Some(0.3)), "11 of 12, less than a second left"),
            (of(0, 12, None), "0 of 12, 3.00\u{2009}s so far"),
            (of(0, 0, None), "3.00\u{2009}s"),
        ] {
            assert_eq!(standing(&is), text);
        }
    }

    #[test]
    fn errors_are_said_in_digits_that_mean_something() {
        for (relative, text) in [
            (-7.31e-6, "0.0007 %"),
            (3.13e-9, "< 0.0001 %"),
            (0.0, "< 0.0001 %"),
            (0.0123, "1.2 %"),
            (-0.251, "25 %"),
            (4.7e-4, "0.047 %"),
            (f64::NAN, "–"),
        ] {
            assert_eq!(error_percent(relative), text.replace(' ', &THIN.to_string()));
        }
        assert_eq!((small(4.8e-6), small(-0.0123)), ("5e−6".to_owned(), "0.012".to_owned()));
    }

    #[test]
    fn typed_numbers_forgive_commas_and_dashes_but_not_words() {
        assert_eq!(parse(" 12,5 "), Ok(12.5));
        assert_eq!(parse("−2.2e3"), Ok(-2200.0));
        for bad in ["", "abc", "nan", "inf", "1 2 x"] {
            assert!(parse(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn axis_ends_are_round_and_never_below() {
        for value in [0.013, 0.9, 1.0, 1.21, 7.9, 9.5] {
            let end = round_up(value);
            assert!(end >= value && end <= 1.7 * value, "{value} {end}");
        }
        assert_eq!(round_up(f64::NAN), 1.0);
    }
}
