//! What the user edits and what a file holds: the operating point, what follows when M or L moves, the lubricant, the
//! truncation. Undo and redo are snapshots of it.

use super::key::Key;
use crate::app::refusal::Refusal;
use crate::scene::named_lubricant::{MINERAL_OIL, NamedLubricant};
use crate::scene::study::point::Point;
use crate::scene::{
    At, Grid, LoadFollower, LubricantFollower, Method, Scene, Study, TrainedModel, TransientStudy, View,
};
use crate::solver::discrete::grid::PointGridSpec;
use crate::solver::full::Problem;
use crate::solver::full::transient::Unsupported;
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::{ContactKind, Moes, MoesRequest, OperatingPoint, Sliding, si_from_moes};
use crate::solver::physics::lubricant::{Heat, Lubricant, ShearLaw};
use crate::solver::training::TrainingSpec;

/// The experiment on the screen. Its point is always a valid one: edits that are refused leave it as it was.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    /// Title for people.
    pub title: String,
    /// The operating point with its sliding; its α is the one that counts.
    pub point: OperatingPoint,
    /// Laws of the lubricant.
    pub lubricant: Lubricant,
    /// Grid of full solutions; only a point contact's is edited here.
    pub grid: Grid,
    /// What follows when M or L moves, and the truncation.
    pub view: View,
    /// The training it describes; `None` until one is opened or edited.
    pub training: Option<TrainingSpec>,
    /// The contact in time it describes; `None` until one is opened or edited.
    pub transient: Option<TransientStudy>,
    /// The scene it was opened from: its study and expectations are kept for saving.
    pub scene: Option<Scene>,
}

/// M and L that a new document and a double click on a slider go to.
pub const HOME: Moes = Moes { m: 40.0, l: 10.0 };

/// Title of a document that nobody has named.
fn default_title(kind: ContactKind) -> &'static str {
    match kind {
        ContactKind::Line => "Line contact",
        ContactKind::Point => "Point contact",
    }
}

impl Default for Document {
    fn default() -> Self {
        let request = MoesRequest::new(ContactKind::Line, HOME.m, HOME.l);
        Self {
            title: default_title(ContactKind::Line).to_owned(),
            point: si_from_moes(&request).unwrap_or(OperatingPoint::TABLE_2_1),
            lubricant: MINERAL_OIL,
            grid: Grid::Graded,
            view: View::default(),
            training: None,
            transient: None,
            scene: None,
        }
    }
}

impl Document {
    /// The contact and its fluid, by which results are known.
    pub fn key(&self) -> Key {
        Key { point: self.point, lubricant: self.lubricant }
    }

    /// The grid that was chosen for a point contact; where none was, the graded one that does for it. None for a line
    /// contact.
    pub fn chosen_plane(&self) -> Option<PointGridSpec> {
        let fitted = |graded: PointGridSpec| graded.for_contact(&self.point).unwrap_or(graded);
        let own = self.plane();
        (self.point.kind == ContactKind::Point).then(|| if own == PointGridSpec::EXPLORER { fitted(own) } else { own })
    }

    /// Moves to M and L; the chosen quantities follow, all others keep their value.
    ///
    /// # Errors
    /// A sentence when the point would be refused; the document is unchanged then.
    pub fn set_moes(&mut self, wanted: Moes) -> Result<(), Refusal> {
        let here = self.point;
        let followers = self.followers_to(wanted)?;
        let moes = here.moes();
        match followers {
            (LoadFollower::Load, _) if wanted.l == moes.l => return self.accept(Quantity::M.at(&here, wanted.m)),
            (LoadFollower::Load, LubricantFollower::Alpha) if wanted.m == moes.m => {
                return self.accept(Quantity::L.at(&here, wanted.l));
            }
            _ => {}
        }
        let mut request = MoesRequest {
            modulus_pa: Some(here.modulus_pa),
            viscosity_pa_s: Some(here.viscosity_pa_s),
            ..MoesRequest::new(here.kind, wanted.m, wanted.l)
        };
        let (radius, speed, load, alpha) = match followers {
            (LoadFollower::Load, LubricantFollower::Realisation) => (true, false, false, false),
            (LoadFollower::Load, LubricantFollower::Speed) => (true, false, false, true),
            (LoadFollower::Load, LubricantFollower::Alpha) => (true, true, false, false),
            (LoadFollower::Load, LubricantFollower::Radius) => (false, true, false, true),
            (LoadFollower::Radius, LubricantFollower::Realisation) => (false, false, true, false),
            (LoadFollower::Radius, LubricantFollower::Speed | LubricantFollower::Radius) => (false, false, true, true),
            (LoadFollower::Radius, LubricantFollower::Alpha) => (false, true, true, false),
            (LoadFollower::Speed, _) => (true, false, true, false),
        };
        request.radius_m = radius.then_some(here.radius_m);
        request.speed_m_per_s = speed.then_some(here.speed_m_per_s);
        request.load = load.then_some(here.load);
        request.alpha_per_pa = alpha.then_some(here.alpha_per_pa);
        let point = si_from_moes(&request)?;
        // An ellipse keeps its shape, unless its radius across is held.
        let across = match (here.radius_y_m, self.holds(Quantity::RadiusY)) {
            (Some(radius_y), false) if point.radius_m != here.radius_m => {
                Some(radius_y * point.radius_m / here.radius_m)
            }
            (radius_y, _) => radius_y,
        };
        // To the last bit, rounding left aside.
        let held = Quantity::SI.into_iter().filter(|quantity| self.holds(*quantity));
        let point = held.fold(point, |point, q| q.of(&here).map_or(point, |value| q.at(&point, value)));
        self.accept(OperatingPoint { sliding: here.sliding, radius_y_m: across, ..point })
    }

    /// What follows when M moves and when L moves: what was chosen, unless the lubricant determines α, which then
    /// cannot follow.
    pub fn followers(&self) -> (LoadFollower, LubricantFollower) {
        let chosen = (self.view.when_m_moves, self.view.when_l_moves);
        match chosen {
            _ if self.lubricant.own_coefficient().is_none() => chosen,
            (LoadFollower::Load, LubricantFollower::Radius) => chosen,
            (LoadFollower::Load | LoadFollower::Speed, _) => (LoadFollower::Load, LubricantFollower::Speed),
            (LoadFollower::Radius, _) => (LoadFollower::Radius, LubricantFollower::Speed),
        }
    }

    /// What may follow when M moves, and when L moves then.
    pub fn possible_followers(&self) -> (&'static [LoadFollower], &'static [LubricantFollower]) {
        let load = self.followers().0;
        match (self.lubricant.own_coefficient().is_some(), load) {
            (false, _) => (&LoadFollower::ALL, load.partners()),
            (true, LoadFollower::Load) => (&FIXED_ALPHA, &[LubricantFollower::Speed, LubricantFollower::Radius]),
            (true, _) => (&FIXED_ALPHA, &[LubricantFollower::Speed]),
        }
    }

    /// The NPR that counts.
    pub fn plateau_ratio(&self) -> f64 {
        self.point.sliding.newtonian_plateau_ratio.unwrap_or(self.lubricant.shear.plateau())
    }

    /// The grid of a point contact's full solutions; the explorer's own where the scene names none.
    pub fn plane(&self) -> PointGridSpec {
        self.grid.point_spec().unwrap_or(PointGridSpec::EXPLORER)
    }

    /// Chooses the grid of a point contact's full solutions.
    pub fn set_plane(&mut self, plane: PointGridSpec) {
        self.grid = Grid::Plane(plane);
    }

    /// Sets one quantity. What follows M and L was chosen; of the others M and L follow. A plateau ratio that is the
    /// lubricant's own stays that of another lubricant too.
    ///
    /// # Errors
    /// A sentence when the value is refused; the document is unchanged then.
    pub fn set_quantity(&mut self, quantity: Quantity, value: f64) -> Result<(), Refusal> {
        let moes = self.point.moes();
        match quantity {
            Quantity::M => self.set_moes(Moes { m: value, ..moes }),
            Quantity::L => self.set_moes(Moes { l: value, ..moes }),
            Quantity::NewtonianPlateauRatio if value == self.lubricant.shear.plateau() => {
                let sliding = Sliding { newtonian_plateau_ratio: None, ..self.point.sliding };
                self.accept(OperatingPoint { sliding, ..self.point })
            }
            Quantity::RadiusRatio if self.holds(Quantity::RadiusY) => {
                Err(Refusal::new("R_y is held, so that R_y/R cannot move; free it by its lock"))
            }
            _ => self.accept(quantity.at(&self.point, value)),
        }
    }

    /// Goes to another contact of another fluid.
    ///
    /// # Errors
    /// A sentence when it would be refused; the document is unchanged then.
    pub fn set_contact(&mut self, point: OperatingPoint, lubricant: Lubricant) -> Result<(), Refusal> {
        let problem = Problem::new(&point, lubricant)?;
        let former = self.point.kind;
        self.point = OperatingPoint { alpha_per_pa: problem.point.alpha_per_pa, ..point };
        self.lubricant = lubricant;
        if point.radius_y_m.is_none() {
            self.view.held.set(Quantity::RadiusY, false);
        }
        if former != point.kind {
            // The load is another quantity now, and a grid is of one kind of contact.
            self.view.held.set(Quantity::Load, false);
            self.grid = Grid::Graded;
            if self.title == default_title(former) {
                default_title(point.kind).clone_into(&mut self.title);
            }
        }
        Ok(())
    }

    /// Changes the laws. Without shear constants the fluid is Newtonian, and a plateau ratio has no sense.
    ///
    /// # Errors
    /// A sentence when a law is not defined here; the document is unchanged then.
    pub fn set_lubricant(&mut self, lubricant: Lubricant) -> Result<(), Refusal> {
        let mut point = self.point;
        let mut lubricant = lubricant;
        if lubricant.shear == ShearLaw::Newtonian {
            point.sliding.newtonian_plateau_ratio = None;
        } else if let Some(limit) = &mut lubricant.limiting_stress {
            // A film that thins bends its own traction.
            limit.eyring = None;
        }
        self.set_contact(point, lubricant)
    }

    /// Takes a named lubricant, and with it only what belongs to the lubricant: its laws, and η₀ and α where it has its
    /// own. The contact in which its source studies it is another edit.
    ///
    /// # Errors
    /// A sentence when a law is not defined here; the document is unchanged then.
    pub fn pick_lubricant(&mut self, named: &NamedLubricant) -> Result<(), Refusal> {
        let own = named.viscosity_pa_s.unwrap_or(self.point.viscosity_pa_s);
        let sliding = Sliding { newtonian_plateau_ratio: None, ..self.point.sliding };
        let point = OperatingPoint { sliding, viscosity_pa_s: own, ..self.point };
        let heat = self.lubricant.heat.map(|heat| Heat { oil: named.heat, ..heat });
        self.set_contact(point, Lubricant { cavitation: self.lubricant.cavitation, heat, ..named.laws })?;
        if named.viscosity_pa_s.is_some() {
            self.view.held.set(Quantity::Viscosity, false);
            self.view.held.set(Quantity::Alpha, false);
        }
        Ok(())
    }

    /// Changes the training it describes.
    ///
    /// # Errors
    /// A sentence when the training makes no sense; the document is unchanged then.
    pub fn set_training(&mut self, spec: TrainingSpec) -> Result<(), Refusal> {
        spec.check()?;
        let study = Study::Training(spec.clone());
        let scene = Scene { contact: spec.contact(), study, ..Scene::at_moes(HOME.m, HOME.l) };
        scene.check()?;
        self.training = Some(spec);
        Ok(())
    }

    /// Whether its file holds the training: a scene that asks another question keeps that, a contact of the other kind
    /// asks its own, and a new one has room for one question.
    pub fn saves_training(&self) -> bool {
        let kind = self.point.kind;
        self.training.as_ref().is_none_or(|spec| spec.contact() == kind)
            && match &self.scene {
                Some(scene) => scene.contact == kind && matches!(scene.study, Study::Training(_)),
                None => self.transient.is_none(),
            }
    }

    /// Chooses what follows M; what follows L changes along where both cannot be had together.
    pub fn set_load_follower(&mut self, follower: LoadFollower) {
        self.view.when_m_moves = follower;
        if let Some(first) = follower.partners().first()
            && !follower.partners().contains(&self.view.when_l_moves)
        {
            self.view.when_l_moves = *first;
        }
    }

    pub(super) fn accept(&mut self, point: OperatingPoint) -> Result<(), Refusal> {
        self.set_contact(point, self.lubricant)
    }

    /// The document of a scene; everything the explorer does not edit stays with it.
    ///
    /// # Errors
    /// A sentence that names what the explorer cannot solve.
    pub fn of_scene(scene: Scene) -> Result<Self, Refusal> {
        let point = OperatingPoint { sliding: scene.sliding(), ..scene.point()? };
        Problem::new(&point, scene.laws())?;
        Ok(Self {
            title: scene.title.clone(),
            point,
            lubricant: scene.laws(),
            grid: scene.grid,
            view: scene.view.unwrap_or_default(),
            training: match &scene.study {
                Study::Training(spec) => Some(spec.clone()),
                _ => None,
            },
            transient: match &scene.study {
                Study::Transient(study) => Some(study.clone()),
                _ => None,
            },
            scene: Some(scene),
        })
    }

    /// Returns why the question of the opened scene cannot be asked of the present contact; `None` if it can.
    pub fn lost_question(&self) -> Option<&'static str> {
        let scene = self.scene.as_ref()?;
        let in_time = matches!(scene.study, Study::Transient(_));
        let unsupported = self.unsupported_in_time().filter(|_| in_time);
        if scene.contact != self.point.kind {
            Some("it is about the other kind of contact")
        } else if unsupported == Some(Unsupported::ShearThinning) {
            Some("it is answered with Newtonian lubricants only")
        } else if unsupported == Some(Unsupported::MassConservingModel) {
            Some(
                "its models are answered with the penalty or complementarity only, not with mass-conserving cavitation",
            )
        } else if unsupported.is_some() || !self.keeps_with_heat(scene) {
            Some("it is answered without heat only")
        } else {
            None
        }
    }

    /// Whether the question of a scene without heat can be asked with that of the present contact, if it has any.
    fn keeps_with_heat(&self, scene: &Scene) -> bool {
        if self.lubricant.heat.is_none() || scene.heat.is_some() {
            return true;
        }
        let Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio: npr } = self.point.sliding;
        let mut warm = Scene { at: At::from(self.point), srr, npr, ..scene.clone() };
        warm.set_laws(self.lubricant);
        warm.check().is_ok()
    }

    /// The document as a scene. What was opened and not changed is written as it was. A question that the present contact
    /// has lost gives way to the contact itself.
    pub fn to_scene(&self) -> Scene {
        let moes = self.point.moes();
        let mut scene = self.scene.clone().unwrap_or_else(|| Scene::at_moes(moes.m, moes.l));
        scene.title.clone_from(&self.title);
        scene.set_laws(self.lubricant);
        let Sliding { slide_to_roll_ratio, newtonian_plateau_ratio } = self.point.sliding;
        (scene.srr, scene.npr) = (slide_to_roll_ratio, newtonian_plateau_ratio);
        if self.lost_question().is_some() || scene.contact != self.point.kind {
            self.drop_question(&mut scene);
        }
        scene.grid = self.grid;
        if let Some(spec) = self.training.as_ref().filter(|_| self.saves_training()) {
            scene.study = Study::Training(spec.clone());
        }
        if let Some(study) = self.transient.as_ref().filter(|_| self.saves_transient()) {
            scene.grid = self.transient_grid();
            scene.study = Study::Transient(study.clone());
        }
        if scene.point() != Ok(OperatingPoint { sliding: Sliding::NONE, ..self.point }) {
            scene.at = At::from(self.point);
        }
        if scene.view.unwrap_or_default() != self.view {
            scene.view = Some(self.view);
        }
        if scene.check().is_err() {
            // Whatever the reason is: what is saved can be opened.
            self.drop_question(&mut scene);
        }
        scene
    }

    /// Leaves the contact alone in a scene, with neither title nor source of another question.
    fn drop_question(&self, scene: &mut Scene) {
        if self.scene.is_some() {
            default_title(self.point.kind).clone_into(&mut scene.title);
        }
        scene.contact = self.point.kind;
        scene.study = Study::Point(Point { methods: methods_of(self.point.kind) });
        scene.training = TrainedModel::default();
        (scene.quick, scene.failures_expected) = (false, false);
        scene.expect.clear();
        scene.source.clear();
    }

    /// Reads a document from the text of a scene.
    ///
    /// # Errors
    /// A sentence with line and column, or what was refused.
    pub fn from_ron(text: &str) -> Result<Self, Refusal> {
        Self::of_scene(Scene::from_ron(text)?)
    }

    /// Writes the document as the text of a scene.
    ///
    /// # Errors
    /// A sentence; in practice never.
    pub fn to_ron(&self) -> Result<String, Refusal> {
        Ok(self.to_scene().to_ron()?)
    }
}

/// What may follow M where the lubricant determines α.
const FIXED_ALPHA: [LoadFollower; 2] = [LoadFollower::Load, LoadFollower::Radius];

/// How a contact is solved headless when nothing else is asked: by all that is in the program.
fn methods_of(kind: ContactKind) -> Vec<Method> {
    match kind {
        ContactKind::Line => vec![Method::Full, Method::EMBEDDED],
        ContactKind::Point => vec![Method::Full],
    }
}

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
