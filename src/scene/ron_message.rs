//! Sentences for errors in RON text.

use ron::Error;

/// Returns the sentence for an error: what is wrong, and for unknown names what is accepted.
pub(crate) fn message(error: &Error) -> String {
    let place = |outer: &Option<String>| outer.as_ref().map_or_else(|| "it".to_owned(), |outer| format!("`{outer}`"));
    match error {
        Error::MissingStructField { field, outer } => format!("{} needs the field `{field}`", place(outer)),
        Error::DuplicateStructField { field, outer } => format!("{} has the field `{field}` twice", place(outer)),
        Error::NoSuchStructField { expected, found, outer } => {
            format!("{} has no field `{found}`; accepted are {}", place(outer), listed(expected))
        }
        Error::NoSuchEnumVariant { expected, found, outer } => {
            let kind = outer.as_ref().map_or_else(String::new, |outer| format!(" of `{outer}`"));
            format!("`{found}` is no value{kind}; accepted are {}", listed(expected))
        }
        other => other.to_string().replace('\n', " "),
    }
}

fn listed(names: &[&str]) -> String {
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Deserialize;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Roller {
        #[expect(dead_code, reason = "only read")]
        radius: f64,
        #[expect(dead_code, reason = "only read")]
        kind: Kind,
    }

    #[derive(Debug, Deserialize)]
    enum Kind {
        Steel,
        Ceramic,
    }

    #[test]
    fn sentences_name_the_place_and_what_is_accepted() {
        let said = |text: &str| message(&ron::from_str::<Roller>(text).unwrap_err().code);
        assert_eq!(said("(kind: Steel)"), "`Roller` needs the field `radius`");
        assert_eq!(said("(radius: 1.0, radius: 2.0)"), "`Roller` has the field `radius` twice");
        assert_eq!(said("(width: 1.0)"), "`Roller` has no field `width`; accepted are radius, kind");
        assert_eq!(said("(radius: 1.0, kind: Glass)"), "`Glass` is no value of `Kind`; accepted are Steel, Ceramic");
        assert!(!said("(radius: ").contains('\n'));
        assert!(ron::from_str::<Roller>("(radius: 1.0, kind: Ceramic)").is_ok());
    }
}
