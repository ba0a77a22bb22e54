//! What a document has of contacts in time: its own, or one to begin with.

use crate::app::document::Document;
use crate::app::in_use::question;
use crate::app::refusal::Refusal;
use crate::scene::{Grid, LinearisedTransient, ReducedTransient, Study, TransientStudy};
use crate::solver::full::transient::{Frame, Inputs, Signal, TimeStep, Unsupported};

/// The grid to begin with: fine enough to be believed, coarse enough to be there at once.
const GRID: Grid = Grid::Uniform { dx: 0.0075, domain: (-4.0, 2.0) };

impl Document {
    /// The contact in time that the tab shows: the document's, or one to begin with.
    pub fn transient_study(&self) -> TransientStudy {
        self.transient.clone().unwrap_or_else(breathing)
    }

    /// Changes the contact in time it describes.
    ///
    /// # Errors
    /// A sentence when it makes no sense; the document is unchanged then.
    pub fn set_transient(&mut self, study: TransientStudy) -> Result<(), Refusal> {
        study.own_march(self.point, self.lubricant, Frame::Fixed).problem()?;
        let asked = question("Contact in time", &self.key(), self.transient_grid(), Study::Transient(study.clone()));
        asked.check()?;
        self.transient = Some(study);
        Ok(())
    }

    /// Why there are no contacts in time of this kind; `None` where there are.
    pub fn no_transient(&self) -> Option<&'static str> {
        Unsupported::check(self.point.kind, &self.lubricant).err().and_then(|why| match why {
            Unsupported::PointContact => Some("Transient runs cover line contacts only; choose a line contact"),
            Unsupported::ShearThinning => Some(
                "Transient runs cover Newtonian lubricants only, not shear-thinning ones; choose one without shear constants",
            ),
            Unsupported::Heat => Some("Transient runs cover isothermal contacts only; switch heat off"),
            Unsupported::MassConservingModel => None,
        })
    }

    /// Why its contact cannot be taken through time as its study asks; `None` if it can.
    pub fn unsupported_in_time(&self) -> Option<Unsupported> {
        let by_model = |study: &TransientStudy| study.reduced.is_some() || study.linearised.is_some();
        let of_model = |()| match self.transient.as_ref().is_some_and(by_model) {
            true => Unsupported::check_model(&self.lubricant),
            false => Ok(()),
        };
        Unsupported::check(self.point.kind, &self.lubricant).and_then(of_model).err()
    }

    /// Whether its file holds the contact in time: a scene that asks another question keeps that; a contact that cannot be
    /// taken through time has none.
    pub fn saves_transient(&self) -> bool {
        let asked = self.scene.as_ref().is_none_or(|scene| matches!(scene.study, Study::Transient(_)));
        asked && self.unsupported_in_time().is_none()
    }

    /// The grid of contacts in time: that of a scene of one, else one that answers quickly.
    pub fn transient_grid(&self) -> Grid {
        let scene = self.scene.as_ref().filter(|scene| matches!(scene.study, Study::Transient(_)));
        scene.map_or(GRID, |scene| scene.grid)
    }
}

/// What the tab begins with: a load that breathes by a tenth, as in Fig. 2.6 (right), twice as long and in coarser
/// steps, by all three methods, the reduced model being that of the program.
fn breathing() -> TransientStudy {
    TransientStudy {
        inputs: Inputs::load(Signal::Harmonic { amplitude: 0.1, period: 4.0 }),
        sampled: None,
        duration: 8.0,
        further: Vec::new(),
        time_step: TimeStep::Fixed(0.05),
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
