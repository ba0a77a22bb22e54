//! Transient contact of a document: its own or a default.

use crate::app::document::Document;
use crate::app::in_use::question;
use crate::app::refusal::Refusal;
use crate::scene::{Grid, LinearisedTransient, ReducedTransient, Scene, Study, TransientStudy};
use crate::solver::discrete::grid::PointGridSpec;
use crate::solver::full::transient::{Frame, Inputs, Scheme, Signal, TimeStep, Unsupported};
use crate::solver::physics::contact::ContactKind;

/// Default grids of line and point contacts, a compromise between accuracy and speed.
const GRID: Grid = Grid::Uniform { dx: 0.0075, domain: (-4.0, 2.0) };
const PLANE: Grid = Grid::Plane(PointGridSpec::QUICK);

impl Document {
    /// Returns the transient contact that the tab shows: the document's, or a default. Without the parts that this
    /// contact does not have.
    pub fn transient_study(&self) -> TransientStudy {
        let mut study = match (self.point.kind, &self.transient) {
            (ContactKind::Line, Some(study)) => study.clone(),
            (ContactKind::Line, None) => breathing(),
            (ContactKind::Point, Some(study)) => of_a_plane(study.clone()),
            (ContactKind::Point, None) => of_a_plane(breathing_ball()),
        };
        if self.marches_in_full_only().is_some() {
            study.drop_models();
            study.drop_trainings();
        }
        study
    }

    /// Returns a sentence if transient runs of this contact use the full system only.
    pub fn marches_in_full_only(&self) -> Option<&'static str> {
        if self.point.is_elliptic() {
            Some("Elliptical contacts run by the full system, in the fixed frame and with a constant radius.")
        } else {
            self.lubricant.is_rough().then_some("Rough contacts run by the full system.")
        }
    }

    /// Sets the transient contact.
    ///
    /// # Errors
    /// A sentence if it is invalid. The document is then unchanged.
    pub fn set_transient(&mut self, study: TransientStudy) -> Result<(), Refusal> {
        study.own_march(self.point, self.lubricant, Frame::Fixed).problem()?;
        let asked = question("Transient contact", &self.key(), self.transient_grid(), Study::Transient(study.clone()));
        asked.check()?;
        self.transient = Some(study);
        Ok(())
    }

    /// Returns why transient runs do not support this contact. `None` if they do.
    pub fn no_transient(&self) -> Option<&'static str> {
        Unsupported::check_lubricant(&self.lubricant).err().and_then(|why| match why {
            Unsupported::ShearThinning => Some(
                "Transient runs cover Newtonian lubricants only, not shear-thinning ones; choose one without shear constants",
            ),
            Unsupported::Heat => Some("Transient runs cover isothermal contacts only; switch heat off"),
            Unsupported::PointContact
            | Unsupported::RoughModel
            | Unsupported::MassConservingModel
            | Unsupported::PointFrame
            | Unsupported::PointInputs => None,
        })
    }

    /// Returns why linearised transient models do not support this contact. `None` if they do.
    pub fn no_linearised(&self) -> Option<&'static str> {
        let ellipse = "The linearised model (TPWL) covers line and circular contacts only; choose one with equal radii";
        let rough = "The linearised model (TPWL) covers smooth surfaces only; set the roughness to zero";
        let other = [self.point.is_elliptic().then_some(ellipse), self.lubricant.is_rough().then_some(rough)];
        self.no_transient().or(other.into_iter().flatten().next())
    }

    /// Returns why the transient study does not support the contact. `None` if it does.
    pub fn unsupported_in_time(&self) -> Option<Unsupported> {
        let study = self.transient.as_ref().map(|_| self.transient_study());
        let by_model = study.is_some_and(|study| study.reduced.is_some() || study.linearised.is_some());
        let of_model = |()| if by_model { Unsupported::check_model(&self.lubricant) } else { Ok(()) };
        Unsupported::check_lubricant(&self.lubricant).and_then(of_model).err()
    }

    /// Returns true if the file contains the transient contact. A scene with another study keeps that study, and an
    /// unsupported contact has no transient study.
    pub fn saves_transient(&self) -> bool {
        let asked = self.scene.as_ref().is_none_or(|scene| matches!(scene.study, Study::Transient(_)));
        asked && self.unsupported_in_time().is_none()
    }

    /// Returns the grid of transient contacts: that of a transient scene of this kind of contact, otherwise the fast
    /// default.
    pub fn transient_grid(&self) -> Grid {
        let kind = self.point.kind;
        let asked = |scene: &&Scene| scene.contact == kind && matches!(scene.study, Study::Transient(_));
        let default = if kind.is_point() { PLANE } else { GRID };
        self.scene.as_ref().filter(asked).map_or(default, |scene| scene.grid)
    }
}

/// Returns the default study: a load with a harmonic variation of 10 %, as in Fig. 2.6 (right), but twice as long
/// and with larger time steps. It uses all three methods with the built-in reduced model.
fn breathing() -> TransientStudy {
    let inputs = Inputs::load(Signal::Harmonic { amplitude: 0.1, period: 4.0 });
    TransientStudy {
        reduced: Some(ReducedTransient::embedded()),
        linearised: Some(LinearisedTransient::default()),
        ..TransientStudy::new(inputs, 8.0, TimeStep::Fixed(0.05))
    }
}

/// Returns the default study of a point contact, with the built-in models of circular contacts.
fn breathing_ball() -> TransientStudy {
    let inputs = Inputs::load(Signal::Harmonic { amplitude: 0.1, period: 2.0 });
    TransientStudy {
        reduced: Some(ReducedTransient::embedded()),
        linearised: Some(LinearisedTransient::usual(ContactKind::Point)),
        ..TransientStudy::new(inputs, 4.0, TimeStep::Fixed(0.04))
    }
}

/// Returns a study without the frames, inputs, schemes and models that point contacts do not have. A model that marches
/// train is replaced by one that responses train.
fn of_a_plane(mut study: TransientStudy) -> TransientStudy {
    let Inputs { radius, speed, .. } = &mut study.inputs;
    *radius = Signal::Constant;
    if matches!(speed, Signal::Reversing { .. }) {
        *speed = Signal::Constant;
    }
    if study.reduced.as_ref().is_some_and(|reduced| reduced.training().is_some()) {
        study.reduced = Some(ReducedTransient::by_responses());
    }
    // A linearised model shares the basis of a reduced one.
    if study.reduced.is_none() {
        study.drop_models();
    }
    study.mass_between = None;
    (study.frames, study.scheme) = (vec![Frame::Fixed], Scheme::Default);
    study.drop_trainings();
    study
}
