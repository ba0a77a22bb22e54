//! Spells the fields of a contact for messages and help texts as the user of each interface writes them: as flags,
//! Python keywords, table columns, scene fields or variables of a Functional Mock-up Unit.

use super::fields::Field;
use super::words::Words;

impl Words {
    /// Returns the spelling of a field, such as `--radius-y`.
    pub fn of(self, field: Field) -> String {
        let facts = field.facts();
        match self {
            Self::Flags => format!("--{}", facts.name),
            Self::Keywords if field.is_switch() => format!("{}=True", facts.name),
            Self::Keywords => format!("{}=", field.keyword()),
            Self::Columns => facts.column.to_owned(),
            Self::Scene => format!("`{}`", field.keyword()),
            Self::Variables => format!("`{}`", facts.variable),
        }
    }

    /// Returns the spelling of a field with a value, such as `--grid model`.
    pub fn with(self, field: Field, value: &str) -> String {
        match self {
            Self::Keywords => format!("{}\"{value}\"", self.of(field)),
            Self::Flags | Self::Columns | Self::Scene | Self::Variables => format!("{} {value}", self.of(field)),
        }
    }

    /// Replaces marks such as `<radius-y>` or `<grid=model>` in a sentence by the spelling of the field and of its
    /// value, if there is one.
    pub fn spelled(self, sentence: &str) -> String {
        let (mut said, mut rest) = (String::new(), sentence);
        while let Some((before, after)) = rest.split_once('<') {
            said.push_str(before);
            match after.split_once('>').and_then(|(mark, tail)| Some((self.marked(mark)?, tail))) {
                Some((word, tail)) => {
                    said.push_str(&word);
                    rest = tail;
                }
                None => {
                    said.push('<');
                    rest = after;
                }
            }
        }
        said + rest
    }

    /// Returns the spelling for the text between angle brackets; `None` if it names no field.
    fn marked(self, mark: &str) -> Option<String> {
        match mark.split_once('=') {
            None => Field::named(mark).map(|field| self.of(field)),
            Some((name, value)) => Field::named(name).map(|field| self.with(field, value)),
        }
    }

    /// Returns the help text of a field: description, unit and note.
    pub fn help(self, field: Field) -> String {
        let facts = field.facts();
        let unit = match facts.units() {
            ["", _] => String::new(),
            [line, point] if line == point => format!(" in {line}"),
            [line, point] => format!(" in {line} (line) or {point} (point)"),
        };
        format!("{}{unit}{}", facts.about, self.spelled(facts.note))
    }
}
