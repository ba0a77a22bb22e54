//! Contacts that transient runs support, with refusals in the words of scenes and of other interfaces.

use crate::scene::answer::Request;
use crate::scene::check::{Checked, refuse};
use crate::scene::contact_spec::{Field, Refusal};
use crate::scene::experiment::Experiment;
use crate::scene::grid::Grid;
use crate::solver::full::transient::Unsupported;
use crate::solver::limits::Refused;
use crate::solver::physics::contact::ContactKind;

/// Reason why a full transient run refuses the grid of a steady model.
const OF_A_MODEL: &str = "a full transient run does not use the grid of a model";

/// Returns the refusal of a scene, with the unsupported field.
pub(super) fn refused(why: Unsupported) -> Refused {
    let (field, wanted) = match why {
        Unsupported::PointContact => ("contact", "must be Line"),
        Unsupported::PointFrame => ("study.frames", "must be [Fixed], with the scheme Default or Bdf2"),
        Unsupported::PointInputs => ("study.inputs", "must have other values"),
        Unsupported::ShearThinning => ("lubricant.shear", "must be Newtonian"),
        Unsupported::Heat => ("heat", "must be left out"),
        Unsupported::RoughModel => ("roughness", "must be left out"),
        Unsupported::MassConservingModel => ("cavitation", "must be Penalty or Complementarity"),
    };
    refuse(field, format!("{wanted}: {why}"))
}

/// Refuses a contact that transient reduced models do not support, and names the field of the scene.
pub(super) fn check_models(experiment: &Experiment) -> Checked {
    Unsupported::check_model(&experiment.lubricant).map_err(refused)
}

/// Refuses a contact that full transient runs do not support, and names the field of the scene.
pub(in crate::scene::study) fn check(experiment: &Experiment) -> Checked {
    Unsupported::check(experiment.contact, &experiment.lubricant).map_err(refused)?;
    if experiment.grid == Grid::Model {
        return Err(refuse("grid", format!("must be Uniform, Graded or GradedNodes: {OF_A_MODEL}")));
    }
    Ok(())
}

/// Refuses a contact that the full solver does not support in time, and names the field of the scene. Point contacts are
/// supported, without the mass balance of a film in a plane.
pub(super) fn check_full(experiment: &Experiment, balances: bool) -> Checked {
    if experiment.contact.is_line() {
        return check(experiment);
    }
    Unsupported::check_lubricant(&experiment.lubricant).map_err(refused)?;
    if balances {
        return Err(refuse("study.mass_between", "must be left out for a point contact"));
    }
    if experiment.grid == Grid::Model {
        return Err(refuse("grid", format!("must be Plane or Graded: {OF_A_MODEL}")));
    }
    Ok(())
}

/// Refuses a request that transient runs do not support, full ones or those by a reduced model. Full runs support point
/// contacts.
///
/// # Errors
/// With the field, and what is accepted.
pub fn check_request(request: &Request) -> Result<(), Refusal> {
    let by_model = request.method.model().is_some();
    let of_model = || if by_model { Unsupported::check_model(&request.lubricant) } else { Ok(()) };
    let kind = if by_model { request.point.kind } else { ContactKind::Line };
    Unsupported::check(kind, &request.lubricant).and_then(|()| of_model()).map_err(|why| {
        let (field, wanted) = match why {
            Unsupported::PointContact | Unsupported::PointFrame | Unsupported::PointInputs => {
                (Field::Contact, "<contact> must be line")
            }
            Unsupported::ShearThinning => (Field::Shear, "<shear> must be newtonian"),
            Unsupported::Heat => (Field::Heat, "<heat> must be left out"),
            Unsupported::RoughModel => (Field::Roughness, "<roughness> must be left out"),
            Unsupported::MassConservingModel => (Field::Cavitation, "<cavitation> must be penalty or complementarity"),
        };
        Refusal::new(field, format!("{wanted}: {why}"))
    })?;
    if request.grid == Grid::Model && !by_model {
        return Err(Refusal::new(Field::Grid, format!("<grid> must be uniform or graded: {OF_A_MODEL}")));
    }
    Ok(())
}
