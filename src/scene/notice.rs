//! Warnings and remarks of an outcome, as data.

use crate::solver::warning::{Repeated, Warning};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::fmt;

/// Warning or remark of an outcome. Its `Display` text is the complete sentence.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Notice {
    /// Warning about a part of the study, such as a method or a march, or about the whole study if `part` is empty.
    Warning {
        /// Name of the part.
        part: String,
        /// The warning.
        warning: Warning,
    },
    /// Warning of one kind that applies to several results of a part.
    Repeated {
        /// Name of the part.
        part: String,
        /// Number of results, and the last warning of this kind.
        repeated: Repeated,
    },
    /// Remark about the study.
    Sentence(String),
}

impl Notice {
    /// Returns the warning; the last one if there are several.
    pub fn warning(&self) -> Option<&Warning> {
        match self {
            Self::Warning { warning, .. } => Some(warning),
            Self::Repeated { repeated, .. } => Some(&repeated.last),
            Self::Sentence(_) => None,
        }
    }

    fn part(&self) -> &str {
        match self {
            Self::Warning { part, .. } | Self::Repeated { part, .. } => part,
            Self::Sentence(_) => "",
        }
    }

    /// Returns part, kind, values and sentence as one JSON object: `{"part": …, "kind": …, values…, "text": …}`. A
    /// remark has the kind `note`.
    pub fn to_json(&self) -> Value {
        let mut object = self.warning().map_or_else(|| json!({"kind": "note"}), Warning::to_json);
        if let Value::Object(fields) = &mut object {
            if let Self::Repeated { repeated, .. } = self {
                fields.insert("contacts".to_owned(), json!(repeated.count));
            }
            if !self.part().is_empty() {
                fields.insert("part".to_owned(), json!(self.part()));
            }
            fields.insert("text".to_owned(), json!(self.to_string()));
        }
        object
    }
}

impl From<String> for Notice {
    fn from(sentence: String) -> Self {
        Self::Sentence(sentence)
    }
}

impl fmt::Display for Notice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.part().is_empty() {
            write!(f, "{}: ", self.part())?;
        }
        match self {
            Self::Warning { warning, .. } => warning.fmt(f),
            Self::Repeated { repeated, .. } => repeated.fmt(f),
            Self::Sentence(sentence) => f.write_str(sentence),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_notice_has_part_kind_values_and_sentence() {
        let warning = Warning::of_hertz_pressure(5e9).unwrap();
        let part = "reduced".to_owned();
        let sentence = format!("reduced: {warning}");
        let of = Notice::Warning { part: part.clone(), warning: warning.clone() };
        let wanted = json!({"part": "reduced", "kind": "hertz_pressure", "pressure_pa": 5e9, "text": sentence});
        assert_eq!((of.to_json(), of.to_string()), (wanted, sentence));
        let several = Notice::Repeated { part, repeated: Repeated { count: 3, all: 4, last: warning } };
        assert_eq!(several.to_json()["contacts"], 3);
        assert!(several.to_string().starts_with("reduced: 3 of 4 contacts, the last of them: p_H"), "{several}");
        assert_eq!(Notice::from("said".to_owned()).to_json(), json!({"kind": "note", "text": "said"}));
    }
}
