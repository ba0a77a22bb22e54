//! Model description of FMI 3.0.

use super::archive::IDENTIFIER;
use super::description::{Description, RealVariable, TOOL, TRUTH_ATTRIBUTES, Variable};
use super::variables::{FIRST_TRUTH, Role, TIME};
use std::fmt::Write;

/// Returns `modelDescription.xml` of FMI 3.0.
pub(super) fn written(unit: &Description) -> String {
    let mut text = String::new();
    let Description { title, identity, about, differentiable, .. } = unit;
    // Writing to a string cannot fail.
    let _ = write!(
        text,
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <fmiModelDescription fmiVersion=\"3.0\" modelName=\"{title}\" instantiationToken=\"{identity}\" \
         description=\"{about}\" generationTool=\"{TOOL}\" variableNamingConvention=\"structured\">\n\
         \x20 <CoSimulation modelIdentifier=\"{IDENTIFIER}\" canGetAndSetFMUState=\"true\" \
         canSerializeFMUState=\"true\" providesDirectionalDerivatives=\"{differentiable}\" \
         providesAdjointDerivatives=\"{differentiable}\" canHandleVariableCommunicationStepSize=\"true\"/>\n{unit}\
         \x20 <ModelVariables>\n\
         \x20   <Float64 name=\"time\" valueReference=\"{TIME}\" description=\"time\" causality=\"independent\" \
         variability=\"continuous\"/>\n"
    );
    let mut variable = |kind: &str, own: &Variable, reference: usize, rest: &str| {
        let Variable { name, about, .. } = own;
        let _ = writeln!(
            text,
            "    <{kind} name=\"{name}\" valueReference=\"{reference}\" description=\"{about}\" {rest}/>"
        );
    };
    let mut outputs = Vec::new();
    for real in &unit.reals {
        let RealVariable { own, role, .. } = real;
        variable("Float64", own, own.reference, &format!("{}{}", role.attributes(), real.facts()));
        if *role == Role::Output {
            outputs.push(own.reference);
        }
    }
    for own in &unit.truths {
        let reference = FIRST_TRUTH + own.reference;
        variable("Boolean", own, reference, TRUTH_ATTRIBUTES);
        outputs.push(reference);
    }
    text.push_str("  </ModelVariables>\n  <ModelStructure>\n");
    for kind in ["Output", "InitialUnknown"] {
        for reference in &outputs {
            let _ = writeln!(text, "    <{kind} valueReference=\"{reference}\"/>");
        }
    }
    text.push_str("  </ModelStructure>\n</fmiModelDescription>\n");
    text
}
