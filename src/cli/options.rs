//! Command-line options for a contact and its solution, shared by `solve` and `sweep`. Each flag sets one field of a
//! [`ContactSpec`].

use crate::scene::named_lubricant::NAMED;
use crate::scene::{ContactSpec, Field, Words};
use clap::builder::{PossibleValue, PossibleValuesParser, ValueParser};
use clap::error::ErrorKind;
use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, Error, FromArgMatches, value_parser};
use std::path::PathBuf;

/// Contact and solution method. Numbers without a unit are in SI units.
#[derive(Clone, Debug)]
pub struct PointOptions(pub ContactSpec);

/// Returns the parser for a field whose value is one of several words.
pub fn choices(field: Field) -> PossibleValuesParser {
    field.choices().into_iter().map(|(word, about)| PossibleValue::new(word).help(about)).collect::<Vec<_>>().into()
}

/// Returns the command-line flag of a field.
fn flag(field: Field) -> Arg {
    let facts = field.facts();
    let help = Words::Flags.help(field);
    let flag = Arg::new(facts.name).long(facts.name).help(help.clone());
    if field.is_switch() {
        return flag.action(ArgAction::SetTrue);
    }
    let name = facts.placeholder.map_or_else(|| facts.name.to_uppercase().replace('-', "_"), str::to_owned);
    let flag = flag.value_name(name).allow_hyphen_values(field.may_be_negative());
    let flag = match facts.default {
        Some(value) => flag.default_value(value),
        None => flag,
    };
    match field {
        Field::Rom => flag.value_parser(value_parser!(PathBuf)),
        Field::Lubricant => {
            let list = NAMED.map(|named| format!("  {}: {}", named.name, named.about)).join("\n");
            flag.value_parser(checked_text(field)).long_help(format!("{help}:\n{list}"))
        }
        field if field.choices().is_empty() => flag.value_parser(checked_text(field)),
        field => flag.value_parser(choices(field)),
    }
}

/// Returns the parser for a field whose value is checked but passed on as text.
fn checked_text(field: Field) -> ValueParser {
    ValueParser::new(move |text: &str| field.check(text).map(|()| text.to_owned()))
}

impl Args for PointOptions {
    fn augment_args(command: Command) -> Command {
        command.args(Field::of(Words::Flags).map(flag))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for PointOptions {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let mut spec = ContactSpec { rom: matches.get_one(Field::Rom.facts().name).cloned(), ..ContactSpec::default() };
        let mut fields: Vec<Field> = Field::of(Words::Flags).filter(|field| *field != Field::Rom).collect();
        fields.sort_by_key(|field| field.reading_order());
        for field in fields {
            let name = field.facts().name;
            let text = match field.is_switch() {
                true => matches.get_flag(name).then_some("yes"),
                // Defaults are left out: they could contradict other options.
                false if matches.value_source(name) == Some(ValueSource::DefaultValue) => None,
                false => matches.get_one::<String>(name).map(String::as_str),
            };
            let refused =
                |why: crate::scene::Refusal| Error::raw(ErrorKind::ValueValidation, why.in_words(Words::Flags));
            text.map_or(Ok(()), |text| spec.read_flag(field, text)).map_err(refused)?;
        }
        Ok(Self(spec))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}
