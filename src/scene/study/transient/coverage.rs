//! Which contacts transient runs cover, in the words of scenes and of interfaces that state a contact.

use crate::scene::answer::Request;
use crate::scene::check::{Checked, refuse};
use crate::scene::contact_spec::{Field, Refusal};
use crate::scene::experiment::Experiment;
use crate::scene::grid::Grid;
use crate::solver::full::transient::Unsupported;
use crate::solver::limits::Refused;

/// Said of grids that belong to a steady model.
const OF_A_MODEL: &str = "a full transient run has a grid of its own";

/// Refuses a scene by the field that transient runs do not cover.
fn refused(why: Unsupported) -> Refused {
    let (field, wanted) = match why {
        Unsupported::PointContact => ("contact", "must be Line"),
        Unsupported::ShearThinning => ("lubricant.shear", "must be Newtonian"),
        Unsupported::Heat => ("heat", "must be left out"),
        Unsupported::MassConservingModel => ("cavitation", "must be Penalty or Complementarity"),
    };
    refuse(field, format!("{wanted}: {why}"))
}

/// Refuses a contact that transient models do not cover, naming the field of the scene.
pub(super) fn check_models(experiment: &Experiment) -> Checked {
    Unsupported::check_model(&experiment.lubricant).map_err(refused)
}

/// Refuses a contact that full transient runs do not cover, naming the field of the scene.
pub(in crate::scene::study) fn check(experiment: &Experiment) -> Checked {
    Unsupported::check(experiment.contact, &experiment.lubricant).map_err(refused)?;
    if experiment.grid == Grid::Model {
        return Err(refuse("grid", format!("must be Uniform, Graded or GradedNodes: {OF_A_MODEL}")));
    }
    Ok(())
}

/// Refuses a stated contact that transient runs do not cover: full ones, or those by a reduced model.
///
/// # Errors
/// With the field and what it must be.
pub fn check_request(request: &Request) -> Result<(), Refusal> {
    let by_model = request.method.model().is_some();
    let of_model = || if by_model { Unsupported::check_model(&request.lubricant) } else { Ok(()) };
    Unsupported::check(request.point.kind, &request.lubricant).and_then(|()| of_model()).map_err(|why| {
        let (field, wanted) = match why {
            Unsupported::PointContact => (Field::Contact, "<contact> must be line"),
            Unsupported::ShearThinning => (Field::Shear, "<shear> must be newtonian"),
            Unsupported::Heat => (Field::Heat, "<heat> must be left out"),
            Unsupported::MassConservingModel => (Field::Cavitation, "<cavitation> must be penalty or complementarity"),
        };
        Refusal::new(field, format!("{wanted}: {why}"))
    })?;
    if request.grid == Grid::Model && !by_model {
        return Err(Refusal::new(Field::Grid, format!("<grid> must be uniform or graded: {OF_A_MODEL}")));
    }
    Ok(())
}
