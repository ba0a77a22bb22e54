//! Model description of FMI 2.0.

use super::archive::IDENTIFIER;
use super::description::{Description, RealVariable, TOOL, TRUTH_ATTRIBUTES, Variable};
use super::variables::Role;
use std::fmt::Write;

/// Returns `modelDescription.xml` of FMI 2.0.
pub(super) fn written(unit: &Description) -> String {
    let mut text = String::new();
    let Description { title, identity, about, differentiable, .. } = unit;
    // Writing to a string cannot fail.
    let _ = write!(
        text,
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <fmiModelDescription fmiVersion=\"2.0\" modelName=\"{title}\" guid=\"{identity}\" description=\"{about}\" \
         generationTool=\"{TOOL}\" variableNamingConvention=\"structured\">\n\
         \x20 <CoSimulation modelIdentifier=\"{IDENTIFIER}\" canHandleVariableCommunicationStepSize=\"true\" \
         canGetAndSetFMUstate=\"true\" canSerializeFMUstate=\"true\" \
         providesDirectionalDerivative=\"{differentiable}\"/>\n{unit}\
         \x20 <ModelVariables>\n"
    );
    let mut variable = |own: &Variable, how: &str, kind: &str| {
        let Variable { name, about, reference } = own;
        let _ = writeln!(
            text,
            "    <ScalarVariable name=\"{name}\" valueReference=\"{reference}\" description=\"{about}\" {how}>\
             <{kind}/></ScalarVariable>"
        );
    };
    // The index of a variable is its place in the list, from one.
    let mut outputs = Vec::new();
    for (k, real) in unit.reals.iter().enumerate() {
        let RealVariable { own, role, .. } = real;
        variable(own, role.attributes(), &format!("Real{}", real.facts()));
        if *role == Role::Output {
            outputs.push(k + 1);
        }
    }
    for (k, own) in unit.truths.iter().enumerate() {
        variable(own, TRUTH_ATTRIBUTES, "Boolean");
        outputs.push(unit.reals.len() + k + 1);
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
    text
}
