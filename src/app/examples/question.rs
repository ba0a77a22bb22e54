//! Question that a scene answers, as one sentence. It is shown in the window of example scenes and above an opened one.

use crate::scene::{Scene, Study};

/// Returns the question of a scene. It depends on the study and its methods.
pub fn question(scene: &Scene) -> String {
    let reduced = scene.study.methods().iter().any(|method| method.model().is_some());
    let by = if reduced { "in full and reduced" } else { "in full" };
    match &scene.study {
        Study::Point(_) => {
            format!("What are pressure and film thickness of this {} contact, {by}?", scene.contact.name())
        }
        Study::Sweep(sweep) => {
            let varied: Vec<&str> = sweep.over.iter().map(|axis| axis.vary.label()).collect();
            format!("How do film thickness and friction change with {}, {by}?", varied.join(" and "))
        }
        Study::Trajectory(_) => "How do film thickness and errors change along a path through the range?".to_owned(),
        Study::RandomTest(test) => {
            let who = if test.method.model().is_some() { "the reduced model" } else { "the full solver" };
            format!("How often does {who} fail on {} random contacts, and how large are its errors?", test.tests)
        }
        Study::ErrorSplit(_) => "Where does the reduced model’s error come from?".to_owned(),
        Study::GridStudy(_) => "How fast does the film thickness converge on finer grids?".to_owned(),
        Study::Dimensions(_) => "How many modes do these solutions need?".to_owned(),
        Study::ModelSizes(_) => "How do error and time depend on the numbers of modes and equations?".to_owned(),
        Study::Training(_) => "Which reduced model results from this training plan?".to_owned(),
        Study::ErrorMeasures(_) => "Which fast measure predicts the true error best?".to_owned(),
        Study::DistanceMeasure(_) => "Which distance of two contacts predicts how their solutions differ?".to_owned(),
        Study::PlanComparison(_) => "Which training plan gives the best model?".to_owned(),
        Study::ToleranceStudy(_) => "How does a stricter tolerance of the training improve the model?".to_owned(),
        Study::SamplingComparison(_) => "Which sampled equations should a model use?".to_owned(),
        Study::Transient(study) => {
            let modelled = study.reduced.is_some() || study.linearised.is_some();
            let by = if modelled { ", in full and by models" } else { "" };
            format!("How does the film thickness respond to transient inputs{by}?")
        }
        Study::LoadCases(_) => "What are film thickness and friction of each contact of a table?".to_owned(),
        Study::FormulaComparison(_) => "How large are the errors of a published film formula?".to_owned(),
        Study::MeasuredFilm(_) => "How close is the film thickness to published values?".to_owned(),
        Study::Fit(_) => "Which constants of the lubricant explain measured film and friction?".to_owned(),
        Study::Starvation(_) => "How thin is the film of a starved contact?".to_owned(),
        Study::StationaryProfile(_) => "How do pressure and film thickness follow a measured surface?".to_owned(),
        Study::Transition(_) => "How does a rigid, lightly loaded contact approach the dry contact?".to_owned(),
        Study::InformationLoss(_) => "How many modes do transient pressures need, and in which frame?".to_owned(),
        Study::SchemesInTime(_) => "Which scheme should a reduced model use for its time steps?".to_owned(),
        Study::Amplitude(_) => "How much of a wavy surface remains in the film?".to_owned(),
        Study::Vibration(_) => "How stiff is the film, and how much does it damp vibrations?".to_owned(),
        Study::FlowCurve(_) => "How does the viscosity of a shear-thinning oil decrease?".to_owned(),
    }
}
