//! Content of a model description, which both versions of the standard write in their own way.

use super::identity::{first_inputs, identity};
use super::variables::{REALS, Role, TRUTHS};
use crate::engine::SavedModel;
use crate::engine::coupled::{CoupledError, InTime, Pressed};
use std::fmt::{Display, Formatter, Result as Written};

/// Units of the variables, in base units.
pub(super) const UNITS: [(&str, &str); 7] = [
    ("m", "m=\"1\""),
    ("m/s", "m=\"1\" s=\"-1\""),
    ("N/m", "kg=\"1\" s=\"-2\""),
    ("N", "kg=\"1\" m=\"1\" s=\"-2\""),
    ("Pa", "kg=\"1\" m=\"-1\" s=\"-2\""),
    ("Pa.s", "kg=\"1\" m=\"-1\" s=\"-1\""),
    ("1/Pa", "kg=\"-1\" m=\"1\" s=\"2\""),
];

/// Content of a model description.
pub(super) struct Description {
    pub title: String,
    pub identity: String,
    pub about: String,
    /// Default duration and communication step \[s\].
    pub experiment: (f64, f64),
    /// True if outputs have derivatives.
    pub differentiable: bool,
    pub reals: Vec<RealVariable>,
    pub truths: Vec<Variable>,
}

/// Variable of a unit.
pub(super) struct Variable {
    pub name: &'static str,
    pub about: String,
    /// Value reference in FMI 2.
    pub reference: usize,
}

/// Real variable of a unit.
pub(super) struct RealVariable {
    pub own: Variable,
    pub role: Role,
    /// Unit; empty without unit.
    pub unit: String,
    /// Start value; `None` for outputs.
    pub start: Option<f64>,
}

impl Description {
    /// Returns the description of a model with the content of its file.
    pub fn of(model: &SavedModel, content: &[u8], pressed: Pressed) -> Result<Self, CoupledError> {
        let inputs = first_inputs(model, pressed)?;
        let (kind, about, experiment) = match model {
            SavedModel::Stationary(model) => {
                let kind = model.contact();
                (kind, format!("Lubricated {} contact by a reduced model", kind.name()), (1.0, 0.01))
            }
            SavedModel::InTime(model) => {
                let kind = model.window.grid.kind();
                let seconds = model.starts.first().map_or(1.0, |start| InTime::seconds_per_time(&start.point));
                let step = model.domain.step * seconds;
                let about = format!(
                    "Transient lubricated {} contact by a reduced model: its state advances with the communication \
                     step, which is divided evenly into steps of {step:.3e} s at most",
                    kind.name()
                );
                let duration = model.starts.first().map_or(1.0, |start| start.duration) * seconds;
                (kind, about, (duration, step))
            }
        };
        let real = |(reference, real): (usize, &super::Real)| {
            let role = real.role(model, pressed)?;
            let start = if role == Role::Output { None } else { real.value(role, &inputs, None) };
            let own = Variable { name: real.name, about: escaped(real.about), reference };
            Some(RealVariable { own, role, unit: real.unit_in(kind), start })
        };
        let truth =
            |(reference, (name, about, _)): (usize, &super::Truth)| Variable { name, about: escaped(about), reference };
        Ok(Self {
            title: escaped(model.title()),
            identity: identity(content, pressed),
            about,
            experiment,
            differentiable: matches!(model, SavedModel::Stationary(_)),
            reals: REALS.iter().enumerate().filter_map(real).collect(),
            truths: TRUTHS.iter().enumerate().map(truth).collect(),
        })
    }
}

/// Generating tool, as in both versions.
pub(super) const TOOL: &str = concat!("EHL Explorer ", env!("CARGO_PKG_VERSION"));

impl Role {
    /// Returns causality, variability and initial value of real variables.
    pub(super) fn attributes(self) -> &'static str {
        match self {
            Self::Input => "causality=\"input\" variability=\"continuous\"",
            Self::Parameter => "causality=\"parameter\" variability=\"tunable\" initial=\"exact\"",
            Self::Output => "causality=\"output\" variability=\"continuous\" initial=\"calculated\"",
        }
    }
}

/// Causality, variability and initial value of boolean variables, which are outputs.
pub(super) const TRUTH_ATTRIBUTES: &str = "causality=\"output\" variability=\"discrete\" initial=\"calculated\"";

impl RealVariable {
    /// Returns unit and start value.
    pub fn facts(&self) -> String {
        let unit = if self.unit.is_empty() { String::new() } else { format!(" unit=\"{}\"", self.unit) };
        let start = self.start.map_or(String::new(), |start| format!(" start=\"{start:e}\""));
        unit + &start
    }
}

/// Units, log categories and default experiment, which have the same form in both versions.
impl Display for Description {
    fn fmt(&self, to: &mut Formatter<'_>) -> Written {
        writeln!(to, "  <UnitDefinitions>")?;
        for (name, base) in UNITS {
            writeln!(to, "    <Unit name=\"{name}\"><BaseUnit {base}/></Unit>")?;
        }
        let (stop, step) = self.experiment;
        writeln!(
            to,
            "  </UnitDefinitions>\n  <LogCategories>\n\
             \x20   <Category name=\"logStatusWarning\" description=\"warnings\"/>\n\
             \x20   <Category name=\"logStatusError\" description=\"refused requests\"/>\n\
             \x20 </LogCategories>\n  <DefaultExperiment startTime=\"0\" stopTime=\"{stop}\" stepSize=\"{step}\"/>"
        )
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
