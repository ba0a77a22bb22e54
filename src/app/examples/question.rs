//! Question of a scene in one sentence.

use crate::scene::{Scene, Study};
use crate::solver::physics::contact::ContactKind;

/// Returns the question of a scene.
pub fn question(scene: &Scene) -> String {
    let reduced = scene.study.methods().iter().any(|method| method.model().is_some());
    let by = if reduced { "in full and reduced" } else { "in full" };
    match &scene.study {
        Study::Point(_) => {
            let body = if scene.contact == ContactKind::Line { "roller" } else { "ball" };
            format!("What are pressure and film of this {body}, {by}?")
        }
        Study::Sweep(sweep) => {
            let varied: Vec<&str> = sweep.over.iter().map(|axis| axis.vary.label()).collect();
            format!("How do film and friction change with {}, {by}?", varied.join(" and "))
        }
        Study::Trajectory(_) => "How do film and errors change along a path through the whole range?".to_owned(),
        Study::RandomTest(test) => {
            let who = if test.method.model().is_some() { "the reduced model" } else { "the full solver" };
            format!("How often does {who} fail on {} random contacts, and how far is it off?", test.tests)
        }
        Study::ErrorSplit(_) => "Where does the reduced model’s error come from?".to_owned(),
        Study::GridStudy(_) => "How fast does the film settle on finer grids?".to_owned(),
        Study::Dimensions(_) => "How many modes do these solutions need?".to_owned(),
        Study::ModelSizes(_) => "How do error and time depend on the numbers of modes and rows?".to_owned(),
        Study::Training(_) => "What reduced model does this plan of training give?".to_owned(),
        Study::ErrorMeasures(_) => "Which quick measure tells the true error best?".to_owned(),
        Study::DistanceMeasure(_) => "How far apart are two contacts, as their solutions see it?".to_owned(),
        Study::PlanComparison(_) => "Which plan of training gives the best model?".to_owned(),
        Study::ToleranceStudy(_) => "What does a stricter tolerance of the training buy?".to_owned(),
        Study::SamplingComparison(_) => "Which rows of the equations should a model look at?".to_owned(),
        Study::Transient(study) => {
            let modelled = study.reduced.is_some() || study.linearised.is_some();
            let by = if modelled { ", in full and by models" } else { "" };
            format!("How does the film answer while the contact changes in time{by}?")
        }
        Study::LoadCases(_) => "What are film and friction of each contact of a table?".to_owned(),
        Study::FormulaComparison(_) => "How far is a published film formula from full solutions?".to_owned(),
        Study::MeasuredFilm(_) => "How close is the film to those that others measured and computed?".to_owned(),
        Study::Starvation(_) => "How thin is the film of a contact that is supplied with little oil?".to_owned(),
        Study::Transition(_) => "How does a rigid, barely loaded contact become the dry contact?".to_owned(),
        Study::InformationLoss(_) => "How many modes do the pressures in time need, in which frame?".to_owned(),
        Study::SchemesInTime(_) => "By which scheme should a reduced model take its steps in time?".to_owned(),
        Study::FlowCurve(_) => "How does the oil thin under shear?".to_owned(),
    }
}
