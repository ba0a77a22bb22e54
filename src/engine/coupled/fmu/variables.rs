//! Variables of units.

use crate::engine::SavedModel;
use crate::engine::coupled::{CoupledError, Input, Inputs, Outputs, Pressed};
use crate::scene::{Field, names};
use crate::solver::physics::contact::ContactKind;

/// Reads an output.
pub type Output = fn(&Outputs) -> f64;

/// Causality of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Input: may change at every step.
    Input,
    /// Parameter: set once, or changed occasionally.
    Parameter,
    /// Output.
    Output,
}

/// Real variable. Its index in [`REALS`] is its value reference, see [`TIME`].
pub struct Real {
    /// Its name.
    pub name: &'static str,
    /// Contact field that it represents.
    field: Option<Field>,
    /// Unit for line and for point contacts, if it is not a contact field; empty without unit.
    unit: [&'static str; 2],
    /// Description.
    pub about: &'static str,
    role: Role,
    /// Corresponding input.
    input: Option<Input>,
    output: Option<Output>,
}

/// Returns the variable for a contact field.
const fn given(field: Field, role: Role, input: Input) -> Real {
    let facts = field.facts();
    Real {
        name: facts.variable,
        field: Some(field),
        unit: [""; 2],
        about: facts.about,
        role,
        input: Some(input),
        output: None,
    }
}

const fn follows(name: &'static str, unit: [&'static str; 2], output: Output, about: &'static str) -> Real {
    Real { name, field: None, unit, about, role: Role::Output, input: None, output: Some(output) }
}

/// Name of the reference distance for the approach of a line contact.
const APPROACH_REFERENCE: &str = "approach_reference";

/// Name of the roughness.
const ROUGHNESS: &str = Field::Roughness.facts().variable;

/// All real variables.
pub const REALS: [Real; 22] = [
    given(Field::Radius, Role::Input, |i| &mut i.radius_m),
    given(Field::Speed, Role::Input, |i| &mut i.speed_m_per_s),
    given(Field::Srr, Role::Input, |i| &mut i.slide_to_roll_ratio),
    Real { output: Some(|o| o.load), ..given(Field::Load, Role::Input, |i| &mut i.load) },
    Real {
        role: Role::Input,
        input: Some(|i| &mut i.approach_m),
        ..follows(
            "approach",
            ["m"; 2],
            |o| o.approach_m,
            "approach of the bodies, measured far from the contact; for a line contact at the distance approach_reference",
        )
    },
    given(Field::Modulus, Role::Parameter, |i| &mut i.modulus_pa),
    given(Field::Viscosity, Role::Parameter, |i| &mut i.viscosity_pa_s),
    given(Field::Alpha, Role::Parameter, |i| &mut i.alpha_per_pa),
    Real {
        field: None,
        about: "ratio of radii R_y/R; 1 for a circular or line contact",
        ..given(Field::RadiusY, Role::Parameter, |i| &mut i.radius_ratio)
    },
    follows(names::H_C_M, ["m"; 2], |o| o.h_c_m, "central film thickness"),
    follows(names::H_MIN_M, ["m"; 2], |o| o.h_min_m, "minimum film thickness"),
    follows(names::TRACTION, [""; 2], |o| o.friction_coefficient, "traction coefficient: friction over load"),
    follows("friction_force", ["N/m", "N"], |o| o.friction_force, "friction force; per length for a line contact"),
    follows(names::HERTZ_PRESSURE, ["Pa"; 2], |o| o.hertz_pressure_pa, "maximum Hertzian pressure"),
    follows(
        names::H_C_BOUND,
        [""; 2],
        |o| o.error_bounds[0],
        "99 % empirical bound of the relative error of h_c_m; NaN if not available",
    ),
    follows(
        names::H_MIN_BOUND,
        [""; 2],
        |o| o.error_bounds[1],
        "99 % empirical bound of the relative error of h_min_m; NaN if not available",
    ),
    follows(
        names::TRACTION_BOUND,
        [""; 2],
        |o| o.error_bounds[2],
        "99 % empirical bound of the relative error of traction; NaN if not available",
    ),
    follows(names::HALF_WIDTH, ["m"; 2], |o| o.half_width_m, "half width of the Hertzian contact"),
    follows(
        APPROACH_REFERENCE,
        ["m"; 2],
        |o| o.approach_reference_m,
        "distance from a line contact at which approach is measured: its radius",
    ),
    given(Field::Roughness, Role::Parameter, |i| &mut i.roughness_m),
    follows(
        names::MIXED_FILM_RATIO_MIN,
        [""; 2],
        |o| o.film_ratio_min,
        "film ratio: minimum film thickness over roughness; may be negative",
    ),
    follows(names::MIXED_LOAD_SHARE, [""; 2], |o| o.asperity_load_share, "share of the load that asperities carry"),
];

/// Boolean output: name, description, and getter.
pub type Truth = (&'static str, &'static str, fn(&Outputs) -> bool);

/// All boolean outputs. The index is the value reference in FMI 2, see [`FIRST_TRUTH`].
pub const TRUTHS: [Truth; 2] = [
    (names::TRAINED, "true if the contact is inside the trained range", |outputs| outputs.trained),
    ("full", "true if the full solver replaced the model, which has no solution", |outputs| outputs.full),
];

/// Value references in FMI 3, where they are unique over all types: those of real variables are the same as in FMI 2,
/// boolean variables follow, and the time is last.
pub const FIRST_TRUTH: usize = REALS.len();
/// Value reference of the time in FMI 3.
pub const TIME: usize = FIRST_TRUTH + TRUTHS.len();

impl Real {
    /// Returns the unit for a contact kind.
    pub(super) fn unit_in(&self, kind: ContactKind) -> String {
        let [line, point] = self.field.map_or(self.unit, |field| field.facts().units());
        let unit = if kind.is_line() { line } else { point };
        unit.replace('·', ".")
    }

    /// Returns the causality in the unit of a model; `None` if the unit does not have the variable.
    pub fn role(&self, model: &SavedModel, pressed: Pressed) -> Option<Role> {
        let rough = matches!(model, SavedModel::Stationary(model) if model.domain.is_rough());
        match (self.name, model) {
            (ROUGHNESS | names::MIXED_FILM_RATIO_MIN | names::MIXED_LOAD_SHARE, _) if !rough => None,
            (APPROACH_REFERENCE, SavedModel::InTime(model)) if model.window.grid.kind().is_point() => None,
            // A transient model is of one contact. Its inputs are those that vary in its trainings.
            ("load" | names::SRR, SavedModel::InTime(_)) => Some(Role::Input),
            ("speed", SavedModel::InTime(model)) => model.domain.speed.varies().then_some(Role::Input),
            ("radius", SavedModel::InTime(model)) => model.domain.radius.varies().then_some(Role::Input),
            ("approach", SavedModel::InTime(_)) => Some(Role::Output),
            (_, SavedModel::InTime(_)) => (self.role == Role::Output).then_some(Role::Output),
            (APPROACH_REFERENCE, SavedModel::Stationary(model)) if model.contact().is_point() => None,
            ("load", _) if pressed == Pressed::Approach => Some(Role::Output),
            ("approach", _) if pressed == Pressed::Load => Some(Role::Output),
            _ => Some(self.role),
        }
    }

    /// Returns the value, as input or output.
    pub fn value(&self, role: Role, inputs: &Inputs, outputs: Option<&Outputs>) -> Option<f64> {
        match (role, self.input, self.output) {
            (Role::Output, _, Some(output)) => outputs.map(output),
            (_, Some(input), _) => Some(*input(&mut inputs.clone())),
            _ => None,
        }
    }

    /// Returns how the variable is read in outputs; `None` if it is no output.
    pub fn output(&self, role: Role) -> Option<Output> {
        self.output.filter(|_| role == Role::Output)
    }

    /// Returns how the variable is set; `None` if it is an output.
    pub fn input(&self, role: Role) -> Option<Input> {
        self.input.filter(|_| role != Role::Output)
    }

    /// Sets a value. It is checked when the contact is solved.
    ///
    /// # Errors
    /// If the value is not finite, or if the variable cannot be set.
    pub fn set(&self, role: Role, inputs: &mut Inputs, value: f64) -> Result<(), CoupledError> {
        let input = self.input(role).ok_or(CoupledError::Output(self.name))?;
        if !value.is_finite() {
            return Err(CoupledError::NoNumber { name: self.name, value });
        }
        *input(inputs) = value;
        Ok(())
    }
}
