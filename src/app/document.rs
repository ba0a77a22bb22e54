//! What the user edits and what a file holds: the operating point, what follows when M or L moves, the lubricant, the truncation.
//! Undo and redo are snapshots of it.

use crate::scene::{At, Scene};
use crate::solver::contact::{ContactKind, Moes, MoesRequest, OperatingPoint, si_from_moes};
use crate::solver::full::Problem;
use crate::solver::lubricant::Lubricant;
use serde::{Deserialize, Serialize};

/// The quantity that follows when M moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Default)]
pub enum LoadFollower {
    /// Load w.
    #[default]
    Load,
    /// Radius R.
    Radius,
    /// Speed u_m (α then follows L).
    Speed,
}

/// The quantity that follows when L moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Default)]
pub enum LubricantFollower {
    /// α = 5/GPa · L^0.463 and the speed: the default realisation, along which the embedded model is trained.
    #[default]
    Realisation,
    /// Speed u_m at constant α.
    Speed,
    /// α at constant speed.
    Alpha,
    /// Radius R at constant speed and α.
    Radius,
}

impl LoadFollower {
    /// All choices.
    pub const ALL: [Self; 3] = [Self::Load, Self::Radius, Self::Speed];

    /// For people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Load => "load w",
            Self::Radius => "radius R",
            Self::Speed => "speed u_m",
        }
    }

    /// The choices for L that leave exactly M and L to follow.
    pub fn partners(self) -> &'static [LubricantFollower] {
        match self {
            Self::Load => &[
                LubricantFollower::Realisation,
                LubricantFollower::Speed,
                LubricantFollower::Alpha,
                LubricantFollower::Radius,
            ],
            Self::Radius => &[LubricantFollower::Realisation, LubricantFollower::Speed, LubricantFollower::Alpha],
            Self::Speed => &[LubricantFollower::Alpha],
        }
    }
}

impl LubricantFollower {
    /// For people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Realisation => "α and speed together",
            Self::Speed => "speed u_m",
            Self::Alpha => "coefficient α",
            Self::Radius => "radius R",
        }
    }
}

/// One of the six SI quantities, in the order of [`OperatingPoint::quantities`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Quantity {
    /// Reduced radius R.
    Radius,
    /// Mean entrainment speed u_m.
    Speed,
    /// Load w per unit length.
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
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Document {
    /// Title for people.
    pub title: String,
    /// The operating point.
    pub point: OperatingPoint,
    /// What follows when M moves.
    pub when_m_moves: LoadFollower,
    /// What follows when L moves.
    pub when_l_moves: LubricantFollower,
    /// Laws of the lubricant.
    pub lubricant: Lubricant,
    /// Loss of information the pressure basis may neglect; `None` keeps every mode.
    pub pressure_loss: Option<f64>,
    /// Loss of information the deformation basis may neglect; `None` keeps every mode.
    pub deformation_loss: Option<f64>,
    /// Deformation of the reduced model through V_δ (the dissertation's) instead of exactly.
    pub projected_deformation: bool,
    /// Slide-to-roll ratio SRR.
    pub slide_to_roll_ratio: f64,
    /// Newtonian plateau ratio NPR.
    pub newtonian_plateau_ratio: f64,
    /// The scene it was opened from: its study and expectations are kept for saving.
    pub scene: Option<Scene>,
}

/// M and L that a new document and a double click on a slider go to.
pub const HOME: Moes = Moes { m: 40.0, l: 10.0 };

impl Default for Document {
    fn default() -> Self {
        let request = MoesRequest::new(ContactKind::Line, HOME.m, HOME.l);
        Self {
            title: "Line contact".to_owned(),
            point: si_from_moes(&request).unwrap_or(OperatingPoint::TABLE_2_1),
            when_m_moves: LoadFollower::default(),
            when_l_moves: LubricantFollower::default(),
            lubricant: Lubricant::default(),
            pressure_loss: None,
            deformation_loss: None,
            projected_deformation: false,
            slide_to_roll_ratio: 0.0,
            newtonian_plateau_ratio: 1.0,
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
        let (radius, speed, load, alpha) = match (self.when_m_moves, self.when_l_moves) {
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

    /// Sets one SI quantity; M and L follow.
    ///
    /// # Errors
    /// A sentence when the value is refused; the document is unchanged then.
    pub fn set_quantity(&mut self, quantity: Quantity, value: f64) -> Result<(), String> {
        let mut point = self.point;
        *quantity.of(&mut point) = value;
        self.accept(point)
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

    /// Chooses what follows M; what follows L changes along where both cannot be had together.
    pub fn set_load_follower(&mut self, follower: LoadFollower) {
        self.when_m_moves = follower;
        if let Some(first) = follower.partners().first()
            && !follower.partners().contains(&self.when_l_moves)
        {
            self.when_l_moves = *first;
        }
    }

    fn accept(&mut self, point: OperatingPoint) -> Result<(), String> {
        Problem::new(&point, self.lubricant).map_err(|e| e.to_string())?;
        self.point = point;
        Ok(())
    }

    /// Refuses a document whose values make no sense, as files may hold them.
    fn check(&self) -> Result<(), String> {
        Problem::new(&self.point, self.lubricant).map_err(|e| e.to_string())?;
        for (name, loss) in [("pressure_loss", self.pressure_loss), ("deformation_loss", self.deformation_loss)] {
            if loss.is_some_and(|v| !(v > 0.0 && v < 1.0)) {
                return Err(format!("{name} must lie between 0 and 1"));
            }
        }
        for (name, value) in [
            ("slide_to_roll_ratio", self.slide_to_roll_ratio),
            ("newtonian_plateau_ratio", self.newtonian_plateau_ratio),
        ] {
            if !value.is_finite() {
                return Err(format!("{name} must be a finite number"));
            }
        }
        if !self.when_m_moves.partners().contains(&self.when_l_moves) {
            return Err("when_m_moves and when_l_moves cannot be combined like this".to_owned());
        }
        Ok(())
    }
}

/// The document of a scene; everything the explorer does not edit stays with it.
///
/// # Errors
/// A sentence with line and column, or what was refused.
pub fn document_from_scene(text: &str) -> Result<Document, String> {
    let scene = Scene::from_ron(text).map_err(|e| e.to_string())?;
    let point = scene.point().map_err(|e| e.to_string())?;
    let document = Document {
        title: scene.title.clone(),
        point,
        lubricant: scene.lubricant,
        scene: Some(scene),
        ..Document::default()
    };
    document.check()?;
    Ok(document)
}

/// A document as a scene. What was opened and not changed is written as it was.
///
/// # Errors
/// A sentence; in practice never.
pub fn document_to_scene(document: &Document) -> Result<String, String> {
    let moes = document.point.moes();
    let mut scene = document.scene.clone().unwrap_or_else(|| Scene::at_moes(moes.m, moes.l));
    scene.title.clone_from(&document.title);
    scene.lubricant = document.lubricant;
    if scene.point() != Ok(document.point) {
        let [radius, speed, load, modulus, viscosity, alpha] = document.point.quantities();
        scene.at = At::Si { radius, speed, load, modulus, viscosity, alpha };
    }
    scene.to_ron().map_err(|e| e.to_string())
}

/// Reads a document, as sessions hold it.
///
/// # Errors
/// A sentence with line and column, or what was refused.
pub fn document_from_text(text: &str) -> Result<Document, String> {
    let document: Document = ron::from_str(text).map_err(|e| format!("this is no scene: {e}"))?;
    document.check()?;
    Ok(document)
}

/// Writes a document with everything a session keeps.
///
/// # Errors
/// A sentence; in practice never.
pub fn document_to_text(document: &Document) -> Result<String, String> {
    ron::ser::to_string_pretty(document, ron::ser::PrettyConfig::default()).map_err(|e| e.to_string())
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

    #[test]
    fn every_pair_of_followers_reaches_the_wanted_numbers_and_keeps_the_rest() {
        for m_follower in LoadFollower::ALL {
            for &l_follower in m_follower.partners() {
                let mut document =
                    Document { when_m_moves: m_follower, when_l_moves: l_follower, ..Document::default() };
                document.set_moes(Moes { m: 55.0, l: 8.0 }).unwrap();
                let moes = document.point.moes();
                assert!((moes.m / 55.0 - 1.0).abs() < 1e-9 && (moes.l / 8.0 - 1.0).abs() < 1e-9);
                assert_eq!(document.point.modulus_pa, Document::default().point.modulus_pa);
            }
        }
    }

    #[test]
    fn text_returns_the_same_document_and_refuses_what_it_does_not_know() {
        let document = Document { title: "a".into(), pressure_loss: Some(1e-6), ..Document::default() };
        assert_eq!(document_from_text(&document_to_text(&document).unwrap()).unwrap(), document);
        assert!(document_from_text("(titel: \"x\")").unwrap_err().contains("titel"));
        assert!(document_from_text("(pressure_loss: Some(2.0))").is_err());
    }

    #[test]
    fn a_scene_keeps_what_the_explorer_does_not_edit() {
        let text = include_str!("../../scenes/table_2_1.ron");
        let mut document = document_from_scene(text).unwrap();
        let before = Scene::from_ron(text).unwrap();
        assert_eq!(Scene::from_ron(&document_to_scene(&document).unwrap()).unwrap(), before);
        document.set_moes(Moes { m: 55.0, l: 8.0 }).unwrap();
        let after = Scene::from_ron(&document_to_scene(&document).unwrap()).unwrap();
        assert_eq!((after.study, after.expect), (before.study, before.expect));
        assert_eq!(after.at, document_from_scene(&document_to_scene(&document).unwrap()).unwrap().scene.unwrap().at);
        let session = document_from_text(&document_to_text(&document).unwrap()).unwrap();
        assert_eq!(session, document);
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
