//! Transient contact of a document: its own or a default.

use crate::app::document::Document;
use crate::app::in_use::question;
use crate::app::refusal::Refusal;
use crate::scene::{Grid, LinearisedTransient, ReducedTransient, Scene, Study, TransientStudy};
use crate::solver::full::transient::{Frame, Inputs, Scheme, Signal, TimeStep, Unsupported};

/// Default grid, a compromise between accuracy and speed.
const GRID: Grid = Grid::Uniform { dx: 0.0075, domain: (-4.0, 2.0) };

impl Document {
    /// Returns the transient contact that the tab shows: the document's, or a default.
    pub fn transient_study(&self) -> TransientStudy {
        self.transient.clone().unwrap_or_else(breathing)
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
        Unsupported::check(self.point.kind, &self.lubricant).err().and_then(|why| match why {
            Unsupported::PointContact => Some("Transient runs cover line contacts only; choose a line contact"),
            Unsupported::ShearThinning => Some(
                "Transient runs cover Newtonian lubricants only, not shear-thinning ones; choose one without shear constants",
            ),
            Unsupported::Heat => Some("Transient runs cover isothermal contacts only; switch heat off"),
            Unsupported::Roughness => Some("Transient runs cover smooth surfaces only; set the roughness to zero"),
            Unsupported::MassConservingModel | Unsupported::PointFrame | Unsupported::PointInputs => None,
        })
    }

    /// Returns why the transient study does not support the contact. `None` if it does.
    pub fn unsupported_in_time(&self) -> Option<Unsupported> {
        let by_model = |study: &TransientStudy| study.reduced.is_some() || study.linearised.is_some();
        let (lubricant, by_model) = (&self.lubricant, self.transient.as_ref().is_some_and(by_model));
        let of_model = |()| if by_model { Unsupported::check_model(lubricant) } else { Ok(()) };
        // Runs of scenes cover point contacts too; their grid is that of the scene.
        let opened = |scene: &Scene| scene.contact == self.point.kind && matches!(scene.study, Study::Transient(_));
        if self.scene.as_ref().is_some_and(opened) {
            return Unsupported::check_lubricant(lubricant).and_then(of_model).err();
        }
        Unsupported::check(self.point.kind, lubricant).and_then(of_model).err()
    }

    /// Returns true if the file contains the transient contact. A scene with another study keeps that study, and an
    /// unsupported contact has no transient study.
    pub fn saves_transient(&self) -> bool {
        let asked = self.scene.as_ref().is_none_or(|scene| matches!(scene.study, Study::Transient(_)));
        asked && self.unsupported_in_time().is_none()
    }

    /// Returns the grid of transient contacts: that of a transient scene, otherwise the fast default.
    pub fn transient_grid(&self) -> Grid {
        let scene = self.scene.as_ref().filter(|scene| matches!(scene.study, Study::Transient(_)));
        scene.map_or(GRID, |scene| scene.grid)
    }
}

/// Returns the default study: a load with a harmonic variation of 10 %, as in Fig. 2.6 (right), but twice as long
/// and with larger time steps. It uses all three methods with the built-in reduced model.
fn breathing() -> TransientStudy {
    TransientStudy {
        inputs: Inputs::load(Signal::Harmonic { amplitude: 0.1, period: 4.0 }),
        sampled: None,
        duration: 8.0,
        further: Vec::new(),
        time_step: TimeStep::Fixed(0.05),
        separation: None,
        surfaces: Vec::new(),
        scheme: Scheme::Default,
        frames: vec![Frame::Fixed],
        window: None,
        trainings: Vec::new(),
        training_loads: Vec::new(),
        training_contacts: Vec::new(),
        reduced: Some(ReducedTransient::embedded()),
        linearised: Some(LinearisedTransient::default()),
        mass_between: None,
        published: Vec::new(),
    }
}
