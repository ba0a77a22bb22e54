//! Contact as a Functional Mock-up Unit for co-simulation (FMI 2.0): variables, model description, archive.
//!
//! The archive contains `modelDescription.xml`, the model, and a library that is the same for all models. The library
//! identifies model and input mode by the GUID in the model description.

use super::{Coupled, CoupledError, InTime, Inputs, Outputs, Pressed};
use crate::engine::SavedModel;
use crate::engine::archive::zip;
use crate::scene::{Field, names};
use crate::solver::physics::contact::ContactKind;
use std::fmt::Write;
use std::sync::Arc;
use xxhash_rust::xxh3::xxh3_64;

/// Model identifier and file name of the library.
pub const IDENTIFIER: &str = "ehl_contact";
/// Path of the model in the archive.
pub const MODEL: &str = "resources/model.rom";

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

/// Real variable. Its index in [`REALS`] is its value reference.
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
    input: Option<fn(&mut Inputs) -> &mut f64>,
    output: Option<fn(&Outputs) -> f64>,
}

/// Returns the variable for a contact field.
const fn given(field: Field, role: Role, input: fn(&mut Inputs) -> &mut f64) -> Real {
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

const fn follows(
    name: &'static str,
    unit: [&'static str; 2],
    output: fn(&Outputs) -> f64,
    about: &'static str,
) -> Real {
    Real { name, field: None, unit, about, role: Role::Output, input: None, output: Some(output) }
}

/// Name of the reference distance for the approach of a line contact.
const APPROACH_REFERENCE: &str = "approach_reference";

/// All real variables.
pub const REALS: [Real; 19] = [
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
];

/// Boolean output: name, description, and getter.
pub type Truth = (&'static str, &'static str, fn(&Outputs) -> bool);

/// All boolean outputs. The index is the value reference.
pub const TRUTHS: [Truth; 2] = [
    (names::TRAINED, "true if the contact is inside the trained range", |outputs| outputs.trained),
    ("full", "true if the full solver replaced the model, which has no solution", |outputs| outputs.full),
];

impl Real {
    /// Returns the unit for a contact kind.
    fn unit_in(&self, kind: ContactKind) -> String {
        let [line, point] = self.field.map_or(self.unit, |field| field.facts().units());
        let unit = if kind == ContactKind::Line { line } else { point };
        unit.replace('·', ".")
    }

    /// Returns the causality in the unit of a model; `None` if the unit does not have the variable.
    pub fn role(&self, model: &SavedModel, pressed: Pressed) -> Option<Role> {
        match (self.name, model) {
            (APPROACH_REFERENCE, SavedModel::InTime(model)) if model.window.grid.kind() == ContactKind::Point => None,
            // A transient model is of one contact. Its inputs are those that vary in its trainings.
            ("load" | names::SRR, SavedModel::InTime(_)) => Some(Role::Input),
            ("speed", SavedModel::InTime(model)) => model.domain.speed.varies().then_some(Role::Input),
            ("radius", SavedModel::InTime(model)) => model.domain.radius.varies().then_some(Role::Input),
            ("approach", SavedModel::InTime(_)) => Some(Role::Output),
            (_, SavedModel::InTime(_)) => (self.role == Role::Output).then_some(Role::Output),
            (APPROACH_REFERENCE, SavedModel::Stationary(model)) if model.contact() == ContactKind::Point => None,
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

    /// Sets a value. It is checked when the contact is solved.
    ///
    /// # Errors
    /// If the value is not finite, or if the variable cannot be set.
    pub fn set(&self, role: Role, inputs: &mut Inputs, value: f64) -> Result<(), CoupledError> {
        let (Some(input), true) = (self.input, role != Role::Output) else {
            return Err(CoupledError::Output(self.name));
        };
        if !value.is_finite() {
            return Err(CoupledError::NoNumber { name: self.name, value });
        }
        *input(inputs) = value;
        Ok(())
    }
}

/// Returns the GUID for a model's content and input mode. It shows that a library's model and a model description
/// belong together.
pub fn identity(model: &[u8], pressed: Pressed) -> String {
    let word = match pressed {
        Pressed::Load => "load",
        Pressed::Approach => "approach",
    };
    format!("{word}-{:016x}", xxh3_64(model))
}

/// Returns the input mode of a GUID, if it belongs to the model.
pub fn pressed_of(identity_given: &str, model: &[u8]) -> Option<Pressed> {
    [Pressed::Load, Pressed::Approach].into_iter().find(|pressed| identity(model, *pressed) == identity_given)
}

/// Returns the path of this system's library in the archive.
pub fn library_place() -> String {
    let (platform, ending) = match std::env::consts::OS {
        "windows" => ("win", "dll"),
        "macos" => ("darwin", "dylib"),
        _ => ("linux", "so"),
    };
    format!("binaries/{platform}{}/{IDENTIFIER}.{ending}", usize::BITS)
}

/// Returns the file name of the library in cargo's output folder.
pub fn library_file() -> String {
    format!("{}{IDENTIFIER}{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX)
}

/// Returns the archive of a model, its file content, and the library.
///
/// # Errors
/// If the model solves no contact to start from, or if the input mode is not possible.
pub fn archive(
    model: &SavedModel,
    content: Vec<u8>,
    pressed: Pressed,
    library: Vec<u8>,
) -> Result<Vec<u8>, CoupledError> {
    let description = description(model, &content, pressed)?;
    let files = [
        ("modelDescription.xml".to_owned(), description.into_bytes()),
        (MODEL.to_owned(), content),
        (library_place(), library),
    ];
    Ok(zip(files))
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Returns the start values of a model's inputs.
///
/// # Errors
/// If the model solves no contact to start from, or if the input mode is not possible.
pub fn first_inputs(model: &SavedModel, pressed: Pressed) -> Result<Inputs, CoupledError> {
    let none = || CoupledError::NoStart(model.title().to_owned());
    match model {
        SavedModel::Stationary(model) => {
            Coupled::new(Arc::clone(model), pressed)?;
            Coupled::first_inputs(model).ok_or_else(none)
        }
        SavedModel::InTime(_) if pressed == Pressed::Approach => Err(CoupledError::ApproachInTime),
        SavedModel::InTime(model) => InTime::first_inputs(model).ok_or_else(none),
    }
}

/// Returns `modelDescription.xml` for a model and the content of its file.
fn description(model: &SavedModel, content: &[u8], pressed: Pressed) -> Result<String, CoupledError> {
    let inputs = first_inputs(model, pressed)?;
    let mut text = String::new();
    let (title, version) = (escaped(model.title()), env!("CARGO_PKG_VERSION"));
    let guid = identity(content, pressed);
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
                "Transient lubricated {} contact by a reduced model: its state advances with the communication step, \
                 which is divided evenly into steps of {step:.3e} s at most",
                kind.name()
            );
            let duration = model.starts.first().map_or(1.0, |start| start.duration) * seconds;
            (kind, about, (duration, step))
        }
    };
    // Writing to a string cannot fail.
    let _ = write!(
        text,
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <fmiModelDescription fmiVersion=\"2.0\" modelName=\"{title}\" guid=\"{guid}\" description=\"{about}\" \
         generationTool=\"EHL Explorer {version}\" variableNamingConvention=\"structured\">\n\
         \x20 <CoSimulation modelIdentifier=\"{IDENTIFIER}\" canHandleVariableCommunicationStepSize=\"true\" \
         canGetAndSetFMUstate=\"true\" canSerializeFMUstate=\"true\"/>\n\
         \x20 <UnitDefinitions>\n"
    );
    for (name, base) in [
        ("m", "m=\"1\""),
        ("m/s", "m=\"1\" s=\"-1\""),
        ("N/m", "kg=\"1\" s=\"-2\""),
        ("N", "kg=\"1\" m=\"1\" s=\"-2\""),
        ("Pa", "kg=\"1\" m=\"-1\" s=\"-2\""),
        ("Pa.s", "kg=\"1\" m=\"-1\" s=\"-1\""),
        ("1/Pa", "kg=\"-1\" m=\"1\" s=\"2\""),
    ] {
        let _ = writeln!(text, "    <Unit name=\"{name}\"><BaseUnit {base}/></Unit>");
    }
    text.push_str("  </UnitDefinitions>\n  <LogCategories>\n");
    text.push_str("    <Category name=\"logStatusWarning\" description=\"warnings\"/>\n");
    text.push_str("    <Category name=\"logStatusError\" description=\"refused requests\"/>\n");
    let (stop, step) = experiment;
    let _ = writeln!(
        text,
        "  </LogCategories>\n  <DefaultExperiment startTime=\"0\" stopTime=\"{stop}\" stepSize=\"{step}\"/>"
    );
    text.push_str("  <ModelVariables>\n");
    let (mut index, mut outputs) = (0, Vec::new());
    for (reference, real) in REALS.iter().enumerate() {
        let Some(role) = real.role(model, pressed) else { continue };
        index += 1;
        let how = match role {
            Role::Input => "causality=\"input\" variability=\"continuous\"",
            Role::Parameter => "causality=\"parameter\" variability=\"tunable\" initial=\"exact\"",
            Role::Output => "causality=\"output\" variability=\"continuous\" initial=\"calculated\"",
        };
        if role == Role::Output {
            outputs.push(index);
        }
        let start = match role {
            Role::Output => String::new(),
            _ => real.value(role, &inputs, None).map_or(String::new(), |value| format!(" start=\"{value:e}\"")),
        };
        let unit = match real.unit_in(kind).as_str() {
            "" => String::new(),
            unit => format!(" unit=\"{unit}\""),
        };
        let (name, about) = (real.name, escaped(real.about));
        let _ = writeln!(
            text,
            "    <ScalarVariable name=\"{name}\" valueReference=\"{reference}\" description=\"{about}\" {how}>\
             <Real{unit}{start}/></ScalarVariable>"
        );
    }
    for (reference, (name, about, _)) in TRUTHS.iter().enumerate() {
        index += 1;
        outputs.push(index);
        let _ = writeln!(
            text,
            "    <ScalarVariable name=\"{name}\" valueReference=\"{reference}\" description=\"{about}\" \
             causality=\"output\" variability=\"discrete\" initial=\"calculated\"><Boolean/></ScalarVariable>"
        );
    }
    text.push_str("  </ModelVariables>\n  <ModelStructure>\n");
    for list in ["Outputs", "InitialUnknowns"] {
        let _ = writeln!(text, "    <{list}>");
        for index in &outputs {
            let _ = writeln!(text, "      <Unknown index=\"{index}\"/>");
        }
        let _ = writeln!(text, "    </{list}>");
    }
    text.push_str("  </ModelStructure>\n</fmiModelDescription>\n");
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::{Workbench, bytes_of, embedded};
    use crate::scene::Bench;
    use crate::solver::parameters::Quantity;
    use crate::solver::physics::contact::OperatingPoint;

    fn first(which: &str) -> (Coupled, Inputs) {
        let model = embedded(which).unwrap();
        let inputs = Coupled::first_inputs(&model).unwrap();
        (Coupled::new(model, Pressed::Load).unwrap(), inputs)
    }

    #[test]
    fn outputs_are_what_solve_answers_to_the_last_bit() {
        for which in ["line", "line_shear", "point"] {
            let (mut coupled, inputs) = first(which);
            let inputs = Inputs { slide_to_roll_ratio: 0.1, ..inputs };
            let own = coupled.solve(&inputs).unwrap();
            let request = coupled.request(&inputs, inputs.load).unwrap();
            let result = Workbench::new("").answer(&request, None, &()).unwrap().result;
            let named = [
                ("h_c_m", own.h_c_m),
                ("h_min_m", own.h_min_m),
                ("traction", own.friction_coefficient),
                ("hertz.p_h_pa", own.hertz_pressure_pa),
                ("reduced.h_c_error_bound", own.error_bounds[0]),
            ];
            for (name, value) in named {
                assert_eq!(result.value(name), Some(value), "{name}");
            }
            assert_eq!((own.trained, own.full, &own.warnings), (!result.untrained(), false, &result.warnings));
        }
    }

    #[test]
    fn an_approach_gives_the_load_that_gives_it() {
        let model = embedded("point").unwrap();
        let inputs = Coupled::first_inputs(&model).unwrap();
        let mut by_approach = Coupled::new(model, Pressed::Approach).unwrap();
        for share in [0.9, 1.0, 1.3] {
            let wanted = Inputs { approach_m: share * inputs.approach_m, load: 0.7 * inputs.load, ..inputs };
            let found = by_approach.solve(&wanted).unwrap();
            assert!((found.approach_m / wanted.approach_m - 1.0).abs() < 1e-11, "{share}: {found:?}");
            assert!((found.load > inputs.load) == (share > 1.0 + 1e-9) || share == 1.0);
        }
        // Separated bodies carry a small load, and less the farther they are apart.
        let apart = [-1e-6, -4e-6].map(|approach_m| by_approach.solve(&Inputs { approach_m, ..inputs }).unwrap().load);
        assert!(apart[0] < inputs.load && 0.0 < apart[1] && apart[1] < apart[0], "{apart:?}");
    }

    #[test]
    fn stiffness_agrees_between_two_units_and_one() {
        for which in ["line", "point"] {
            let (mut one, inputs) = first(which);
            let (mut other, _) = first(which);
            let heavier = Inputs { load: 1.01 * inputs.load, ..inputs };
            let [light, heavy] = [inputs, heavier].map(|inputs| one.solve(&inputs).unwrap());
            assert_eq!(other.solve(&heavier).unwrap().approach_m, heavy.approach_m);
            let stiffness = |from: f64, to: f64| (heavy.load - light.load) / (to - from);
            let own = stiffness(light.approach_m, heavy.approach_m);
            // Stiffness of the dry contact. The film adds a few per cent of compliance.
            let point = one.request(&inputs, inputs.load).unwrap().point;
            let dry = |load: f64| {
                let point = OperatingPoint { load, ..point };
                let hertz = point.hertz();
                let depth = hertz.half_width_m.powi(2) / point.radius_m;
                match point.kind {
                    ContactKind::Line => 0.5 * depth * (0.5 + (2.0 * point.radius_m / hertz.half_width_m).ln()),
                    ContactKind::Point => depth,
                }
            };
            let wanted = stiffness(dry(light.load), dry(heavy.load));
            assert!((own / wanted - 1.0).abs() < 0.1, "{which}: {own:e}, {wanted:e} when dry");
            assert_eq!(light.approach_reference_m.is_nan(), which == "point");
        }
    }

    #[test]
    fn outside_the_training_the_reason_is_that_of_every_interface() {
        let (mut coupled, inputs) = first("line");
        let beyond = coupled.solve(&Inputs { load: 30.0 * inputs.load, ..inputs }).unwrap();
        let request = coupled.request(&inputs, 30.0 * inputs.load).unwrap();
        let result = Workbench::new("").answer(&request, None, &()).unwrap().result;
        let refused = beyond.of_training().unwrap_err().to_string();
        assert!(result.warning().starts_with(&refused), "{refused} against {}", result.warning());
        assert!(coupled.solve(&inputs).unwrap().of_training().is_ok());
    }

    #[test]
    fn what_makes_no_sense_is_refused_and_what_is_unknown_is_told() {
        let (mut coupled, inputs) = first("line");
        for wrong in [
            Inputs { load: -1.0, ..inputs },
            Inputs { radius_m: 0.0, ..inputs },
            Inputs { slide_to_roll_ratio: 11.0, ..inputs },
            Inputs { speed_m_per_s: 1e30, ..inputs },
        ] {
            assert!(coupled.solve(&wrong).is_err(), "{wrong:?}");
        }
        let beyond = coupled.solve(&Inputs { load: 30.0 * inputs.load, ..inputs }).unwrap();
        assert!(!beyond.trained && !beyond.warnings.is_empty(), "{beyond:?}");
        let mut inputs = inputs;
        assert!(REALS[0].set(Role::Input, &mut inputs, f64::NAN).is_err_and(|why| why.to_string().contains("radius")));
        let follows = REALS.iter().find(|real| real.name == names::H_C_M).unwrap();
        assert!(follows.set(Role::Output, &mut inputs, 1.0).is_err());
    }

    #[test]
    fn a_description_names_every_variable_and_its_identity() {
        let bytes = &*bytes_of("point").unwrap();
        let model = SavedModel::from_bytes(bytes).unwrap();
        for pressed in [Pressed::Load, Pressed::Approach] {
            let text = description(&model, bytes, pressed).unwrap();
            // All variables except the reference distance that only line contacts have.
            assert_eq!(text.matches("<ScalarVariable ").count(), REALS.len() - 1 + TRUTHS.len());
            assert_eq!(pressed_of(&identity(bytes, pressed), bytes), Some(pressed));
        }
        assert_eq!(pressed_of("load-0000000000000000", bytes), None);
        let line = SavedModel::from_bytes(&bytes_of("line").unwrap()).unwrap();
        let text = description(&line, &bytes_of("line").unwrap(), Pressed::Approach).unwrap();
        assert_eq!(text.matches("<ScalarVariable ").count(), REALS.len() + TRUTHS.len());
    }

    #[test]
    fn an_ellipse_keeps_its_ratio_of_radii() {
        let (coupled, inputs) = first("ellipse");
        let request = coupled.request(&Inputs { radius_ratio: 2.0, ..inputs }, inputs.load).unwrap();
        let point: OperatingPoint = request.point;
        assert!((Quantity::RadiusRatio.of(&point).unwrap() - 2.0).abs() < 1e-12);
    }
}
