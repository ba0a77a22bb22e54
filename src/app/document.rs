//! What the user edits and what a file holds: the operating point, what follows when M or L moves, the lubricant, the truncation.
//! Undo and redo are snapshots of it.

use super::transient;
use crate::scene::{At, Grid, LoadFollower, LubricantFollower, Method, Scene, Study, TransientStudy, View};
use crate::solver::contact::{ContactKind, Moes, MoesRequest, OperatingPoint, si_from_moes};
use crate::solver::full::Problem;
use crate::solver::grid::PointGridSpec;
use crate::solver::lubricant::{Lubricant, ShearLaw};
use crate::solver::training::TrainingSpec;

/// One of the six SI quantities, in the order of [`OperatingPoint::quantities`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Quantity {
    /// Reduced radius R.
    Radius,
    /// Mean entrainment speed u_m.
    Speed,
    /// Load w, per unit length for a line contact.
    Load,
    /// Reduced modulus E′.
    Modulus,
    /// Ambient viscosity η₀.
    Viscosity,
    /// Pressure–viscosity coefficient α.
    Alpha,
}

impl Quantity {
    fn of(self, point: &mut OperatingPoint) -> &mut f64 {
        match self {
            Self::Radius => &mut point.radius_m,
            Self::Speed => &mut point.speed_m_per_s,
            Self::Load => &mut point.load,
            Self::Modulus => &mut point.modulus_pa,
            Self::Viscosity => &mut point.viscosity_pa_s,
            Self::Alpha => &mut point.alpha_per_pa,
        }
    }

    /// Its value in SI units.
    pub fn get(self, point: &OperatingPoint) -> f64 {
        *self.of(&mut point.clone())
    }
}

/// The experiment on the screen. Its point is always a valid one: edits that are refused leave it as it was.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    /// Title for people.
    pub title: String,
    /// The operating point.
    pub point: OperatingPoint,
    /// Laws of the lubricant.
    pub lubricant: Lubricant,
    /// Grid of full solutions; only a point contact's is edited here.
    pub grid: Grid,
    /// What follows when M or L moves, the truncation, SRR and NPR.
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
            lubricant: Lubricant::default(),
            grid: Grid::Graded,
            view: View::default(),
            training: None,
            transient: None,
            scene: None,
        }
    }
}

impl Document {
    /// Moves to M and L; the chosen quantities follow, all others keep their value.
    ///
    /// # Errors
    /// A sentence when the point would be refused; the document is unchanged then.
    pub fn set_moes(&mut self, wanted: Moes) -> Result<(), String> {
        let here = self.point;
        let mut request = MoesRequest {
            modulus_pa: Some(here.modulus_pa),
            viscosity_pa_s: Some(here.viscosity_pa_s),
            ..MoesRequest::new(here.kind, wanted.m, wanted.l)
        };
        let (radius, speed, load, alpha) = match (self.view.when_m_moves, self.view.when_l_moves) {
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
        let point = si_from_moes(&request).map_err(|e| e.to_string())?;
        self.accept(point)
    }

    /// Changes between line and point contact. M, L and the lubricant stay, E′ too; radius, speed and load are those of the other kind's
    /// default realisation.
    ///
    /// # Errors
    /// A sentence when the point would be refused; the document is unchanged then.
    pub fn set_kind(&mut self, kind: ContactKind) -> Result<(), String> {
        let here = self.point;
        if here.kind == kind {
            return Ok(());
        }
        let moes = here.moes();
        let request = MoesRequest {
            modulus_pa: Some(here.modulus_pa),
            viscosity_pa_s: Some(here.viscosity_pa_s),
            alpha_per_pa: Some(here.alpha_per_pa),
            ..MoesRequest::new(kind, moes.m, moes.l)
        };
        self.accept(si_from_moes(&request).map_err(|e| e.to_string())?)?;
        self.grid = Grid::Graded;
        if self.title == default_title(here.kind) {
            default_title(kind).clone_into(&mut self.title);
        }
        Ok(())
    }

    /// The grid of a point contact's full solutions; the explorer's own where the scene names none.
    pub fn plane(&self) -> PointGridSpec {
        self.grid.point_spec().unwrap_or(PointGridSpec::EXPLORER)
    }

    /// Chooses the grid of a point contact's full solutions.
    pub fn set_plane(&mut self, PointGridSpec { dx, dy, domain, refinement }: PointGridSpec) {
        self.grid = Grid::Plane { dx, dy, domain, refinement };
    }

    /// Sets one SI quantity; M and L follow.
    ///
    /// # Errors
    /// A sentence when the value is refused; the document is unchanged then.
    pub fn set_quantity(&mut self, quantity: Quantity, value: f64) -> Result<(), String> {
        let mut point = self.point;
        *quantity.of(&mut point) = value;
        self.accept(point)
    }

    /// Goes to another contact of another fluid.
    ///
    /// # Errors
    /// A sentence when it would be refused; the document is unchanged then.
    pub fn set_contact(&mut self, point: OperatingPoint, lubricant: Lubricant) -> Result<(), String> {
        Problem::new(&point, lubricant).map_err(|e| e.to_string())?;
        (self.point, self.lubricant) = (point, lubricant);
        Ok(())
    }

    /// Changes the laws.
    ///
    /// # Errors
    /// A sentence when a law is not defined here; the document is unchanged then.
    pub fn set_lubricant(&mut self, lubricant: Lubricant) -> Result<(), String> {
        Problem::new(&self.point, lubricant).map_err(|e| e.to_string())?;
        self.lubricant = lubricant;
        Ok(())
    }

    /// Changes the training it describes.
    ///
    /// # Errors
    /// A sentence when the training makes no sense; the document is unchanged then.
    pub fn set_training(&mut self, spec: TrainingSpec) -> Result<(), String> {
        spec.check().map_err(|e| e.to_string())?;
        let study = Study::Training(spec.clone());
        let scene = Scene { contact: spec.contact(), study, ..Scene::at_moes(HOME.m, HOME.l) };
        scene.check().map_err(|e| e.to_string())?;
        self.training = Some(spec);
        Ok(())
    }

    /// Whether its file holds the training: a scene that asks another question keeps that, a contact of the other kind asks its own, and a new
    /// one has room for one question.
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

    fn accept(&mut self, point: OperatingPoint) -> Result<(), String> {
        Problem::new(&point, self.lubricant).map_err(|e| e.to_string())?;
        self.point = point;
        Ok(())
    }

    /// The document of a scene; everything the explorer does not edit stays with it.
    ///
    /// # Errors
    /// A sentence that names what the explorer cannot solve.
    pub fn of_scene(scene: Scene) -> Result<Self, String> {
        let point = scene.point().map_err(|e| e.to_string())?;
        Problem::new(&point, scene.lubricant).map_err(|e| e.to_string())?;
        if scene.lubricant.shear != ShearLaw::Newtonian || scene.srr != 0.0 {
            return Err(
                "the explorer shows no sliding of shear-thinning lubricants in this version; use `ehl-explorer run`"
                    .to_owned(),
            );
        }
        Ok(Self {
            title: scene.title.clone(),
            point,
            lubricant: scene.lubricant,
            grid: scene.grid,
            view: scene.view.unwrap_or_default(),
            training: match &scene.study {
                Study::Training(spec) => Some(spec.clone()),
                _ => None,
            },
            transient: transient::of_scene(&scene),
            scene: Some(scene),
        })
    }

    /// The document as a scene. What was opened and not changed is written as it was.
    pub fn to_scene(&self) -> Scene {
        let moes = self.point.moes();
        let mut scene = self.scene.clone().unwrap_or_else(|| Scene::at_moes(moes.m, moes.l));
        scene.title.clone_from(&self.title);
        scene.lubricant = self.lubricant;
        if scene.contact != self.point.kind {
            // Its question and what it expects belonged to the other kind of contact.
            scene.contact = self.point.kind;
            scene.study = Study::Point { methods: methods_of(self.point.kind) };
            scene.expect.clear();
            scene.source.clear();
        }
        scene.grid = self.grid;
        if let Some(spec) = self.training.as_ref().filter(|_| self.saves_training()) {
            scene.study = Study::Training(spec.clone());
        }
        if let Some(study) = self.transient.as_ref().filter(|_| self.saves_transient()) {
            scene.grid = self.transient_grid();
            scene.study = Study::Transient(study.clone());
        }
        if scene.point() != Ok(self.point) {
            scene.at = At::from(self.point);
        }
        if scene.view.unwrap_or_default() != self.view {
            scene.view = Some(self.view);
        }
        scene
    }

    /// Reads a document from the text of a scene.
    ///
    /// # Errors
    /// A sentence with line and column, or what was refused.
    pub fn from_ron(text: &str) -> Result<Self, String> {
        Self::of_scene(Scene::from_ron(text).map_err(|e| e.to_string())?)
    }

    /// Writes the document as the text of a scene.
    ///
    /// # Errors
    /// A sentence; in practice never.
    pub fn to_ron(&self) -> Result<String, String> {
        self.to_scene().to_ron().map_err(|e| e.to_string())
    }
}

/// How a contact is solved headless when nothing else is asked: by all that is in the program.
fn methods_of(kind: ContactKind) -> Vec<Method> {
    match kind {
        ContactKind::Line => vec![Method::Full, Method::EMBEDDED],
        ContactKind::Point => vec![Method::Full],
    }
}

/// Undo and redo as snapshots. An edit is a whole gesture: it is recorded when the pointer is released.
#[derive(Debug, Default)]
pub struct History {
    undo: Vec<Document>,
    redo: Vec<Document>,
    committed: Option<Document>,
}

/// Snapshots kept.
const HISTORY_LIMIT: usize = 200;

impl History {
    /// Starts anew from a document.
    pub fn restart(&mut self, document: &Document) {
        *self = Self { committed: Some(document.clone()), ..Self::default() };
    }

    /// Records the document when it differs from the last recorded one, and tells whether it did.
    pub fn commit(&mut self, document: &Document) -> bool {
        match &self.committed {
            Some(last) if last == document => return false,
            Some(last) => {
                self.undo.push(last.clone());
                if self.undo.len() > HISTORY_LIMIT {
                    self.undo.remove(0);
                }
                self.redo.clear();
                self.committed = Some(document.clone());
            }
            None => self.committed = Some(document.clone()),
        }
        true
    }

    /// The document before the last edit.
    pub fn undo(&mut self, document: &mut Document) {
        self.commit(document);
        if let Some(former) = self.undo.pop() {
            self.redo.push(std::mem::replace(document, former));
            self.committed = Some(document.clone());
        }
    }

    /// The document before the last undo.
    pub fn redo(&mut self, document: &mut Document) {
        if let Some(next) = self.redo.pop() {
            self.undo.push(std::mem::replace(document, next));
            self.committed = Some(document.clone());
        }
    }

    /// Whether there is something to undo.
    pub fn can_undo(&self, document: &Document) -> bool {
        !self.undo.is_empty() || self.committed.as_ref().is_some_and(|c| c != document)
    }

    /// Whether there is something to redo.
    pub fn can_redo(&self) -> bool {
        !self.redo.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::training::Windows;

    #[test]
    fn every_pair_of_followers_reaches_the_wanted_numbers_and_keeps_the_rest() {
        for m_follower in LoadFollower::ALL {
            for &l_follower in m_follower.partners() {
                let view = View { when_m_moves: m_follower, when_l_moves: l_follower, ..View::default() };
                let mut document = Document { view, ..Document::default() };
                document.set_moes(Moes { m: 55.0, l: 8.0 }).unwrap();
                let moes = document.point.moes();
                assert!((moes.m / 55.0 - 1.0).abs() < 1e-9 && (moes.l / 8.0 - 1.0).abs() < 1e-9);
                assert_eq!(document.point.modulus_pa, Document::default().point.modulus_pa);
            }
        }
    }

    #[test]
    fn saving_and_opening_again_loses_nothing() {
        let view = View { pressure_loss: Some(1e-6), slide_to_roll_ratio: 0.2, ..View::default() };
        let mut document = Document { title: "a".into(), view, ..Document::default() };
        document.set_load_follower(LoadFollower::Speed);
        document.set_quantity(Quantity::Radius, 0.0123).unwrap();
        let text = document.to_ron().unwrap();
        let again = Document::from_ron(&text).unwrap();
        assert_eq!((&again.title, again.point, again.view), (&document.title, document.point, document.view));
        assert_eq!(again.to_ron().unwrap(), text);
        assert!(Document::from_ron(&text.replace("title", "titel")).unwrap_err().contains("titel"));
        assert!(Document::from_ron(&text.replace("pressure_loss: ", "pressure_loss: -")).is_err(), "{text}");
    }

    #[test]
    fn a_scene_keeps_what_the_explorer_does_not_edit() {
        let before = Scene::from_ron(include_str!("../../scenes/table_2_1.ron")).unwrap();
        assert_eq!(before.view, None);
        let mut document = Document::of_scene(before.clone()).unwrap();
        assert_eq!(document.to_scene(), before);
        document.set_moes(Moes { m: 55.0, l: 8.0 }).unwrap();
        let after = document.to_scene();
        assert_eq!((&after.study, &after.expect, after.view), (&before.study, &before.expect, None));
        assert_eq!(Document::of_scene(after).unwrap().point, document.point);
        document.view.projected_deformation = true;
        assert_eq!(document.to_scene().view, Some(document.view));
        document.view.projected_deformation = false;
        assert_eq!(document.to_scene().view, None);
    }

    #[test]
    fn a_training_is_edited_saved_and_refused_like_the_rest() {
        let scene = Scene::from_ron(include_str!("../../scenes/embedded_model.ron")).unwrap();
        let mut document = Document::of_scene(scene.clone()).unwrap();
        assert_eq!(document.to_scene(), scene);
        let mut spec = document.training.clone().unwrap();
        spec.seed = 7;
        document.set_training(spec.clone()).unwrap();
        assert_eq!(Document::from_ron(&document.to_ron().unwrap()).unwrap().training, Some(spec.clone()));
        spec.windows = Windows::Given(Vec::new());
        assert!(document.set_training(spec.clone()).unwrap_err().contains("window"));
        assert_eq!(document.training.as_ref().unwrap().seed, 7);
        // A scene with another question keeps it; a fresh document takes the training along.
        let other = Scene::from_ron(include_str!("../../scenes/table_2_1.ron")).unwrap();
        let training = document.training.clone();
        let document = Document { training: training.clone(), ..Document::of_scene(other.clone()).unwrap() };
        assert_eq!(document.to_scene().study, other.study);
        let fresh = Document { training: training.clone(), ..Document::default() };
        assert_eq!(Document::of_scene(fresh.to_scene()).unwrap().training, training);
        // A training of point contacts belongs to a point contact, and is not saved with a line.
        let mut point = Document::default();
        point.set_kind(ContactKind::Point).unwrap();
        let scene = Scene::from_ron(include_str!("../../scenes/table_3_4_model.ron")).unwrap();
        let Study::Training(spec) = scene.study else { panic!() };
        point.set_training(spec.clone()).unwrap();
        let saved = point.to_scene();
        saved.check().unwrap();
        assert_eq!(Document::of_scene(saved).unwrap().training, Some(spec));
        point.set_kind(ContactKind::Line).unwrap();
        assert!(!point.saves_training() && point.to_scene().check().is_ok());
    }

    #[test]
    fn a_contact_in_time_is_saved_with_its_grid_and_checked_like_the_rest() {
        let mut document = Document::default();
        let study = document.transient_study();
        document.set_transient(study.clone()).unwrap();
        let again = Document::of_scene(document.to_scene()).unwrap();
        assert_eq!((again.transient.as_ref(), again.transient_grid()), (Some(&study), document.transient_grid()));
        assert_eq!(again.to_scene(), document.to_scene());
        let backwards = TransientStudy { duration: -1.0, ..study.clone() };
        assert!(document.set_transient(backwards).unwrap_err().contains("duration"));
        assert_eq!(document.transient, Some(study));
        // A new scene has room for one question, a scene of another keeps its own.
        assert!(!document.saves_training());
        let other = Scene::from_ron(include_str!("../../scenes/table_2_1.ron")).unwrap();
        let kept = Document { transient: document.transient.clone(), ..Document::of_scene(other.clone()).unwrap() };
        assert_eq!(kept.to_scene().study, other.study);
        document.set_kind(ContactKind::Point).unwrap();
        assert!(document.to_scene().check().is_ok());
    }

    #[test]
    fn the_other_kind_of_contact_keeps_the_numbers_and_the_lubricant() {
        let mut document = Document::default();
        let line = document.point;
        document.set_kind(ContactKind::Point).unwrap();
        let (before, after) = (line.moes(), document.point.moes());
        assert!((after.m / before.m - 1.0).abs() < 1e-9 && (after.l / before.l - 1.0).abs() < 1e-9);
        let kept = |p: &OperatingPoint| [p.modulus_pa, p.viscosity_pa_s, p.alpha_per_pa];
        assert_eq!((document.point.kind, kept(&document.point)), (ContactKind::Point, kept(&line)));
        assert_eq!((document.title.as_str(), document.plane()), ("Point contact", PointGridSpec::EXPLORER));
        document.set_plane(PointGridSpec::DISSERTATION);
        let again = Document::from_ron(&document.to_ron().unwrap()).unwrap();
        assert_eq!((again.point, again.plane()), (document.point, PointGridSpec::DISSERTATION));
        document.set_kind(ContactKind::Line).unwrap();
        let [back, there] = [document.point, line].map(|p| p.quantities());
        assert!(back.iter().zip(there).all(|(a, b)| (a / b - 1.0).abs() < 1e-9), "{back:?} {there:?}");
    }

    #[test]
    fn a_scene_of_a_point_contact_opens_and_keeps_its_question_until_the_kind_changes() {
        let scene = Scene::from_ron(include_str!("../../scenes/table_2_3.ron")).unwrap();
        let mut document = Document::of_scene(scene.clone()).unwrap();
        assert_eq!((document.point.kind, document.to_scene()), (ContactKind::Point, scene));
        document.set_kind(ContactKind::Line).unwrap();
        let scene = document.to_scene();
        assert!(scene.expect.is_empty() && scene.check().is_ok());
        assert_eq!(Document::of_scene(scene).unwrap().point, document.point);
    }

    #[test]
    fn refused_values_leave_the_document_as_it_was() {
        let mut document = Document::default();
        let before = document.clone();
        for bad in [f64::NAN, 0.0, -1.0, 1e300] {
            assert!(document.set_quantity(Quantity::Radius, bad).is_err());
            assert!(document.set_moes(Moes { m: bad, l: 10.0 }).is_err());
        }
        assert_eq!(document, before);
    }

    #[test]
    fn history_goes_back_and_forth() {
        let mut document = Document::default();
        let first = document.clone();
        let mut history = History::default();
        history.restart(&document);
        document.set_moes(Moes { m: 80.0, l: 10.0 }).unwrap();
        let second = document.clone();
        history.commit(&document);
        history.undo(&mut document);
        assert_eq!(document, first);
        history.redo(&mut document);
        assert_eq!(document, second);
        assert!(!history.can_redo() && history.can_undo(&document));
    }
}
