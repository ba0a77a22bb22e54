//! Content that the user edits and that a file stores: the operating point, the quantities that follow M and L, the
//! lubricant, the truncation. Undo and redo use snapshots of it.

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

/// Experiment on the screen. Its operating point is always valid: a refused edit leaves it unchanged.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    /// Title shown on the screen.
    pub title: String,
    /// Operating point with its sliding. Its α is the effective one.
    pub point: OperatingPoint,
    /// Laws of the lubricant.
    pub lubricant: Lubricant,
    /// Grid of full solutions. Only the grid of a point contact can be edited here.
    pub grid: Grid,
    /// Length of a line contact \[m\], for its forces and its power loss. A point contact keeps it, without effect.
    pub length_m: Option<f64>,
    /// Quantities that follow M and L, and the truncation.
    pub view: View,
    /// Training. `None` until one is opened or edited.
    pub training: Option<TrainingSpec>,
    /// Transient contact. `None` until one is opened or edited.
    pub transient: Option<TransientStudy>,
    /// Scene that the document was opened from. Its study and expectations are kept for saving.
    pub scene: Option<Scene>,
}

/// M and L of a new document. A double click on a slider also sets them.
pub const HOME: Moes = Moes { m: 40.0, l: 10.0 };

/// Returns the title of a document without a title by the user.
fn default_title(kind: ContactKind) -> &'static str {
    if kind.is_line() { "Line contact" } else { "Point contact" }
}

impl Default for Document {
    fn default() -> Self {
        let request = MoesRequest::new(ContactKind::Line, HOME.m, HOME.l);
        Self {
            title: default_title(ContactKind::Line).to_owned(),
            point: si_from_moes(&request).unwrap_or(OperatingPoint::TABLE_2_1),
            lubricant: MINERAL_OIL,
            grid: Grid::Graded,
            length_m: None,
            view: View::default(),
            training: None,
            transient: None,
            scene: None,
        }
    }
}

impl Document {
    /// Returns the contact and its fluid, the key of results.
    pub fn key(&self) -> Key {
        Key { point: self.point, lubricant: self.lubricant }
    }

    /// Returns the chosen grid of a point contact. If none was chosen, returns a graded grid that is sufficient for
    /// the contact. `None` for a line contact.
    pub fn chosen_plane(&self) -> Option<PointGridSpec> {
        let fitted =
            |graded: PointGridSpec| graded.for_contact(&self.lubricant.grid_contact(&self.point)).unwrap_or(graded);
        let own = self.plane();
        self.point.kind.is_point().then(|| if own == PointGridSpec::EXPLORER { fitted(own) } else { own })
    }

    /// Sets M and L. The chosen quantities follow, and all others keep their values.
    ///
    /// # Errors
    /// A sentence if the point is refused. The document is then unchanged.
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
        // An elliptical contact keeps its radius ratio unless its radius across is held.
        let across = match (here.radius_y_m, self.holds(Quantity::RadiusY)) {
            (Some(radius_y), false) if point.radius_m != here.radius_m => {
                Some(radius_y * point.radius_m / here.radius_m)
            }
            (radius_y, _) => radius_y,
        };
        // Held quantities keep their values bitwise, without rounding errors.
        let held = Quantity::SI.into_iter().filter(|quantity| self.holds(*quantity));
        let point = held.fold(point, |point, q| q.of(&here).map_or(point, |value| q.at(&point, value)));
        self.accept(OperatingPoint { sliding: here.sliding, radius_y_m: across, ..point })
    }

    /// Returns the quantities that follow M and L. These are the chosen ones, unless the lubricant determines α,
    /// which then cannot follow.
    pub fn followers(&self) -> (LoadFollower, LubricantFollower) {
        let chosen = (self.view.when_m_moves, self.view.when_l_moves);
        match chosen {
            _ if self.lubricant.own_coefficient().is_none() => chosen,
            (LoadFollower::Load, LubricantFollower::Radius) => chosen,
            (LoadFollower::Load | LoadFollower::Speed, _) => (LoadFollower::Load, LubricantFollower::Speed),
            (LoadFollower::Radius, _) => (LoadFollower::Radius, LubricantFollower::Speed),
        }
    }

    /// Returns the quantities that may follow M, and those that may then follow L.
    pub fn possible_followers(&self) -> (&'static [LoadFollower], &'static [LubricantFollower]) {
        let load = self.followers().0;
        match (self.lubricant.own_coefficient().is_some(), load) {
            (false, _) => (&LoadFollower::ALL, load.partners()),
            (true, LoadFollower::Load) => (&FIXED_ALPHA, &[LubricantFollower::Speed, LubricantFollower::Radius]),
            (true, _) => (&FIXED_ALPHA, &[LubricantFollower::Speed]),
        }
    }

    /// Returns the effective Newtonian plateau ratio (NPR).
    pub fn plateau_ratio(&self) -> f64 {
        self.point.sliding.newtonian_plateau_ratio.unwrap_or(self.lubricant.shear.plateau())
    }

    /// Returns the grid of full solutions of a point contact: the one of the scene, or the explorer's default.
    pub fn plane(&self) -> PointGridSpec {
        self.grid.point_spec().unwrap_or(PointGridSpec::EXPLORER)
    }

    /// Sets the grid of full solutions of a point contact.
    pub fn set_plane(&mut self, plane: PointGridSpec) {
        self.grid = Grid::Plane(plane);
    }

    /// Sets one quantity. If it is M or L, the chosen quantities follow. For all other quantities M and L follow.
    /// If the plateau ratio equals that of the lubricant, the contact uses the value of the lubricant, also after a
    /// change of lubricant.
    ///
    /// # Errors
    /// A sentence if the value is refused. The document is then unchanged.
    pub fn set_quantity(&mut self, quantity: Quantity, value: f64) -> Result<(), Refusal> {
        let moes = self.point.moes();
        match quantity {
            Quantity::M => self.set_moes(Moes { m: value, ..moes }),
            Quantity::L => self.set_moes(Moes { l: value, ..moes }),
            Quantity::NewtonianPlateauRatio if value == self.lubricant.shear.plateau() => {
                let sliding = Sliding { newtonian_plateau_ratio: None, ..self.point.sliding };
                self.accept(OperatingPoint { sliding, ..self.point })
            }
            quantity if quantity.is_relative_to_radius() && self.holds(Quantity::RadiusY) => {
                Err(Refusal::new("R_y is held, so R_y/R cannot change; release R_y with its lock"))
            }
            _ => self.accept(quantity.at(&self.point, value)),
        }
    }

    /// Sets contact and lubricant.
    ///
    /// # Errors
    /// A sentence if they are refused. The document is then unchanged.
    pub fn set_contact(&mut self, point: OperatingPoint, lubricant: Lubricant) -> Result<(), Refusal> {
        let problem = Problem::new(&point, lubricant)?;
        let former = self.point.kind;
        self.point = OperatingPoint { alpha_per_pa: problem.point.alpha_per_pa, ..point };
        self.lubricant = lubricant;
        if point.radius_y_m.is_none() {
            self.view.held.set(Quantity::RadiusY, false);
        }
        if former != point.kind {
            // The load has another unit now, and a grid belongs to one kind of contact.
            self.view.held.set(Quantity::Load, false);
            self.grid = Grid::Graded;
            if self.title == default_title(former) {
                default_title(point.kind).clone_into(&mut self.title);
            }
        }
        Ok(())
    }

    /// Sets the laws of the lubricant. Without shear constants the fluid is Newtonian, and a plateau ratio is
    /// removed.
    ///
    /// # Errors
    /// A sentence if a law is not defined for the contact. The document is then unchanged.
    pub fn set_lubricant(&mut self, lubricant: Lubricant) -> Result<(), Refusal> {
        let mut point = self.point;
        let mut lubricant = lubricant;
        if lubricant.shear == ShearLaw::Newtonian {
            point.sliding.newtonian_plateau_ratio = None;
        } else if let Some(limit) = &mut lubricant.limiting_stress {
            // A shear-thinning lubricant limits its traction by its own law.
            limit.eyring = None;
        }
        self.set_contact(point, lubricant)
    }

    /// Selects a named lubricant: its laws, and its η₀ and α if it defines them. The contact of its source is set
    /// by another edit.
    ///
    /// # Errors
    /// A sentence if a law is not defined for the contact. The document is then unchanged.
    pub fn pick_lubricant(&mut self, named: &NamedLubricant) -> Result<(), Refusal> {
        let viscosity_pa_s = named.viscosity_pa_s.unwrap_or(self.point.viscosity_pa_s);
        let alpha_per_pa = named.alpha_per_pa.unwrap_or(self.point.alpha_per_pa);
        let sliding = Sliding { newtonian_plateau_ratio: None, ..self.point.sliding };
        let point = OperatingPoint { sliding, viscosity_pa_s, alpha_per_pa, ..self.point };
        let Lubricant { cavitation, roughness, .. } = self.lubricant;
        let heat = self.lubricant.heat.map(|heat| Heat { oil: named.heat, ..heat });
        self.set_contact(point, Lubricant { cavitation, roughness, heat, ..named.laws })?;
        if named.viscosity_pa_s.is_some() {
            self.view.held.set(Quantity::Viscosity, false);
            self.view.held.set(Quantity::Alpha, false);
        }
        Ok(())
    }

    /// Sets the training.
    ///
    /// # Errors
    /// A sentence if the training is invalid. The document is then unchanged.
    pub fn set_training(&mut self, spec: TrainingSpec) -> Result<(), Refusal> {
        spec.check()?;
        let study = Study::Training(spec.clone());
        let scene = Scene { contact: spec.contact(), study, ..Scene::at_moes(HOME.m, HOME.l) };
        scene.check()?;
        self.training = Some(spec);
        Ok(())
    }

    /// Returns true if the file contains the training. A scene with another study keeps that study. A contact of
    /// the other kind keeps its own, and a new document stores only one study.
    pub fn saves_training(&self) -> bool {
        let kind = self.point.kind;
        self.training.as_ref().is_none_or(|spec| spec.contact() == kind)
            && match &self.scene {
                Some(scene) => scene.contact == kind && matches!(scene.study, Study::Training(_)),
                None => self.transient.is_none(),
            }
    }

    /// Sets the quantity that follows M. Also changes the quantity that follows L if the two are incompatible.
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

    /// Creates the document of a scene. Parts that the explorer does not edit are kept.
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
            length_m: scene.length,
            view: scene.view.clone().unwrap_or_default(),
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

    /// Returns why the study of the opened scene does not apply to the present contact. `None` if it applies.
    pub fn lost_question(&self) -> Option<&'static str> {
        let scene = self.scene.as_ref()?;
        let in_time = matches!(scene.study, Study::Transient(_));
        let unsupported = self.unsupported_in_time().filter(|_| in_time);
        if scene.contact != self.point.kind {
            Some("it applies to the other kind of contact")
        } else if unsupported == Some(Unsupported::ShearThinning) {
            Some("it supports Newtonian lubricants only")
        } else if unsupported == Some(Unsupported::MassConservingModel) {
            Some("its models support cavitation by penalty or complementarity only, not mass-conserving cavitation")
        } else if self.lubricant.is_rough() && !self.keeps(scene) {
            Some("it supports smooth surfaces only")
        } else if unsupported.is_some() || !self.keeps(scene) {
            Some("it supports isothermal contacts only")
        } else {
            None
        }
    }

    /// Returns true if the study of a scene is also possible with the heat and the roughness of the present contact.
    fn keeps(&self, scene: &Scene) -> bool {
        let warm = self.lubricant.heat.is_some() && scene.heat.is_none();
        let rough = self.lubricant.is_rough();
        if !warm && (!rough || scene.roughness.is_some()) {
            return true;
        }
        let Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio: npr } = self.point.sliding;
        let mut present = Scene { at: At::from(self.point), srr, npr, ..scene.clone() };
        present.set_laws(self.lubricant);
        present.check().is_ok()
    }

    /// Returns the document as a scene. An opened and unchanged document is written as it was. A study that no
    /// longer applies to the contact is replaced by the contact alone.
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
        scene.length = self.extent().length_m;
        if let Some(spec) = self.training.as_ref().filter(|_| self.saves_training()) {
            scene.study = Study::Training(spec.clone());
        }
        if self.transient.is_some() && self.saves_transient() {
            scene.grid = self.transient_grid();
            scene.study = Study::Transient(self.transient_study());
        }
        if scene.point() != Ok(OperatingPoint { sliding: Sliding::NONE, ..self.point }) {
            scene.at = At::from(self.point);
        }
        if scene.view.clone().unwrap_or_default() != self.view {
            scene.view = Some(self.view.clone());
        }
        if scene.check().is_err() {
            // Whatever the reason, a saved scene must be readable.
            self.drop_question(&mut scene);
        }
        scene
    }

    /// Reduces a scene to its contact, without title and source of another study.
    fn drop_question(&self, scene: &mut Scene) {
        if self.scene.is_some() {
            default_title(self.point.kind).clone_into(&mut scene.title);
        }
        scene.contact = self.point.kind;
        scene.study = Study::Point(Point { methods: self.methods() });
        scene.training = TrainedModel::default();
        (scene.quick, scene.failures_expected) = (false, false);
        scene.expect.clear();
        scene.source.clear();
    }

    /// Returns the methods of a scene without a study: all methods in the program for the contact.
    fn methods(&self) -> Vec<Method> {
        let embedded = self.point.kind.is_line() && !self.lubricant.is_rough();
        if embedded { vec![Method::Full, Method::EMBEDDED] } else { vec![Method::Full] }
    }

    /// Reads a document from the text of a scene.
    ///
    /// # Errors
    /// A sentence with line and column, or with the reason of the refusal.
    pub fn from_ron(text: &str) -> Result<Self, Refusal> {
        Self::of_scene(Scene::from_ron(text)?)
    }

    /// Returns the document as the text of a scene.
    ///
    /// # Errors
    /// A sentence. In practice never.
    pub fn to_ron(&self) -> Result<String, Refusal> {
        Ok(self.to_scene().to_ron()?)
    }
}

/// Quantities that may follow M if the lubricant determines α.
const FIXED_ALPHA: [LoadFollower; 2] = [LoadFollower::Load, LoadFollower::Radius];

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
