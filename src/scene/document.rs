//! Scene document: its fields, and reading and writing as RON.

use super::at::At;
use super::error::{SceneError, SceneFileError, VERSION};
use super::expectation::Expectation;
use super::experiment::Experiment;
use super::grid::Grid;
use super::method::Method;
use super::ron_message::message;
use super::study::{Study, point};
use super::view::View;
use super::written::is_default;
use super::{atomic_file, examples};
use crate::host::files;
use crate::solver::physics::contact::{ContactError, ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::{Cavitation, Heat, Lubricant, Sliding};
use crate::solver::physics::surfaces::Roughness;
use crate::solver::training::TrainingSpec;
use ron::Options;
use ron::extensions::Extensions;
use ron::ser::PrettyConfig;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Largest accepted size of a scene file \[bytes\].
pub const MAX_BYTES: u64 = 4 << 20;

/// Relative difference up to which a scene's α counts as a rounded form of the α* that the viscosity law determines.
const ROUNDED_ALPHA: f64 = 1e-3;

/// Use of the model that a scene trains.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum TrainedModel {
    /// Separate model file.
    #[default]
    Separate,
    /// Model that is embedded in the program.
    Embedded,
}

/// An experiment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Version of the format, [`VERSION`].
    pub version: u32,
    /// Title shown to users.
    pub title: String,
    /// Origin of the experiment: a table, a figure, a paper.
    #[serde(default, skip_serializing_if = "is_default")]
    pub source: String,
    /// Line or point contact.
    #[serde(default)]
    pub contact: ContactKind,
    /// Laws of the lubricant; its constants are part of [`Scene::at`].
    #[serde(default)]
    pub lubricant: Lubricant,
    /// Cavitation model of full solutions, and of models trained from them.
    #[serde(default, skip_serializing_if = "is_default")]
    pub cavitation: Cavitation,
    /// Thermal constants of the lubricant and of both bodies. Without them the contact is isothermal at the inlet
    /// temperature.
    #[serde(default, skip_serializing_if = "is_default")]
    pub heat: Option<Heat>,
    /// Roughness of both surfaces. Without it they are smooth.
    #[serde(default, skip_serializing_if = "is_default")]
    pub roughness: Option<Roughness>,
    /// Operating point. Not used by studies that bring their own points (trajectory, random validation, training).
    #[serde(default)]
    pub at: At,
    /// Length of a line contact \[m\]. With it the results contain forces and the power loss of the whole contact.
    #[serde(default, skip_serializing_if = "is_default")]
    pub length: Option<f64>,
    /// Slide-to-roll ratio SRR.
    #[serde(default, skip_serializing_if = "is_default")]
    pub srr: f64,
    /// Newtonian plateau ratio NPR of a shear-thinning lubricant. Replaces the lubricant's own value.
    #[serde(default, skip_serializing_if = "is_default")]
    pub npr: Option<f64>,
    /// Grid of full solutions. A reduced model always uses its own grid.
    #[serde(default)]
    pub grid: Grid,
    /// The study to run.
    pub study: Study,
    /// Expected values of the results.
    #[serde(default, skip_serializing_if = "is_default")]
    pub expect: Vec<Expectation>,
    /// True if the scene takes less than ten seconds of one processor. `run --all --quick` and the tests run these
    /// scenes.
    #[serde(default, skip_serializing_if = "is_default")]
    pub quick: bool,
    /// True if some of the solves are meant to fail. Without it, a failed solve counts against the scene, unless an
    /// expectation admits failures.
    #[serde(default, skip_serializing_if = "is_default")]
    pub failures_expected: bool,
    /// Use of the model that the scene trains. If it is embedded, `run --all` skips the scene unless it is named.
    #[serde(default, skip_serializing_if = "is_default")]
    pub training: TrainedModel,
    /// Settings that the explorer stores with the scene. Results do not depend on them.
    #[serde(default, skip_serializing_if = "is_default")]
    pub view: Option<View>,
}

impl Scene {
    /// Returns a scene that solves one contact in its default realisation, in full and with the embedded model.
    pub fn at_moes(m: f64, l: f64) -> Self {
        Self {
            version: VERSION,
            title: format!("Line contact at M = {m}, L = {l}"),
            source: String::new(),
            contact: ContactKind::Line,
            lubricant: Lubricant::default(),
            cavitation: Cavitation::default(),
            heat: None,
            roughness: None,
            at: At::moes(m, l),
            length: None,
            srr: 0.0,
            npr: None,
            grid: Grid::Graded,
            study: Study::Point(point::Point { methods: vec![Method::Full, Method::EMBEDDED] }),
            expect: Vec::new(),
            quick: false,
            failures_expected: false,
            training: TrainedModel::Separate,
            view: None,
        }
    }

    /// Returns the operating point in SI units.
    ///
    /// # Errors
    /// If a quantity is out of range, or if more quantities are fixed than M and L leave free.
    pub fn point(&self) -> Result<OperatingPoint, ContactError> {
        self.at.with_alpha_of(&self.lubricant).point(self.contact)
    }

    /// Returns a message if the scene's α has no effect because the viscosity law determines a different one.
    pub fn unused_alpha(&self) -> Option<String> {
        let own = self.lubricant.own_coefficient()?;
        let given = match self.at {
            At::Si { alpha, .. } => alpha,
            At::Moes { alpha, .. } => alpha?,
        };
        let contradicts = (given / own - 1.0).abs() > ROUNDED_ALPHA;
        contradicts.then(|| {
            format!(
                "the alpha of `at`, {given:.4e} 1/Pa, has no effect: the lubricant's viscosity law has {own:.4e} 1/Pa"
            )
        })
    }

    /// Returns the contact and solver settings that the study runs on.
    pub fn experiment(&self) -> Experiment {
        Experiment {
            contact: self.contact,
            lubricant: self.laws(),
            at: self.at,
            sliding: self.sliding(),
            grid: self.grid,
            grid_model: self.study.grid_model(),
            length_m: self.length,
            expected: self.expect.iter().map(|expectation| expectation.name.clone()).collect(),
        }
    }

    /// Returns the training that the scene describes, with its cavitation model, heat and surfaces; `None` if its study is not a
    /// training.
    pub fn training(&self) -> Option<TrainingSpec> {
        match &self.study {
            Study::Training(spec) => {
                Some(spec.clone().under(self.cavitation).heated(self.heat).on_surfaces(self.roughness))
            }
            _ => None,
        }
    }

    /// Returns the laws of the lubricant, including cavitation model, heat and roughness. Rough surfaces replace the
    /// penalty, which is the default cavitation model, by complementarity.
    pub fn laws(&self) -> Lubricant {
        Lubricant { cavitation: self.cavitation, heat: self.heat, ..self.lubricant }.on_rough_surfaces(self.roughness)
    }

    /// Sets the laws of the lubricant, including cavitation model, heat and roughness.
    pub fn set_laws(&mut self, laws: Lubricant) {
        (self.cavitation, self.heat, self.roughness) = (laws.cavitation, laws.heat, laws.roughness);
        self.lubricant = Lubricant { cavitation: Cavitation::default(), heat: None, roughness: None, ..laws };
    }

    /// Returns the sliding and the plateau ratio.
    pub fn sliding(&self) -> Sliding {
        Sliding { slide_to_roll_ratio: self.srr, newtonian_plateau_ratio: self.npr }
    }
}

/// Returns how RON is read and written here.
pub(super) fn options() -> Options {
    Options::default().with_default_extension(Extensions::IMPLICIT_SOME | Extensions::UNWRAP_VARIANT_NEWTYPES)
}

/// Reads only the version and ignores all other fields.
#[derive(Deserialize)]
#[serde(rename = "Scene")]
struct Probe {
    version: u32,
}

impl Scene {
    /// Reads and checks a scene.
    ///
    /// # Errors
    /// If the text is not valid (with line and column), or if a field has an invalid value.
    pub fn from_ron(text: &str) -> Result<Self, SceneError> {
        let parsed = options().from_str::<Self>(text);
        let version = match &parsed {
            Ok(scene) => Some(scene.version),
            Err(_) => options().from_str::<Probe>(text).ok().map(|probe| probe.version),
        };
        match version {
            Some(version) if version > VERSION => return Err(SceneError::Newer { version }),
            Some(0) => return Err(SceneError::NoVersion),
            _ => {}
        }
        let scene = parsed.map_err(|error| SceneError::Syntax {
            line: error.span.start.line,
            column: error.span.start.col,
            message: message(&error.code),
        })?;
        scene.check()?;
        Ok(scene)
    }

    /// Writes the scene as text that [`Scene::from_ron`] reads back unchanged.
    ///
    /// # Errors
    /// Does not fail for a scene that passes [`Scene::check`].
    pub fn to_ron(&self) -> Result<String, SceneError> {
        let config = PrettyConfig::new().struct_names(true).compact_arrays(true).depth_limit(3);
        // As a trait object it shares its code with that of other formats.
        let scene: &dyn erased_serde::Serialize = self;
        let written = options().to_string_pretty(scene, config);
        let mut text = written.map_err(|error| SceneError::Unwritable(error.to_string()))?;
        text.push('\n');
        Ok(text)
    }

    /// Reads a scene file, or one of the embedded [`examples`].
    ///
    /// # Errors
    /// If the file cannot be read or is not a valid scene. The message names the file.
    pub fn read(path: &Path) -> Result<Self, SceneFileError> {
        let refused = |reason| SceneFileError::Scene { path: path.to_owned(), reason };
        if let Some(text) = examples::text_of(path) {
            return Self::from_ron(text).map_err(refused);
        }
        let unreadable = |reason: String| SceneFileError::Read { path: path.to_owned(), reason };
        if path.is_dir() {
            return Err(unreadable("it is a folder".to_owned()));
        }
        let bytes = files::read_at_most(path, MAX_BYTES + 1).map_err(|error| unreadable(atomic_file::said(&error)))?;
        if bytes.len() as u64 > MAX_BYTES {
            return Err(unreadable(format!("it is larger than the limit of {MAX_BYTES} bytes")));
        }
        let text = String::from_utf8(bytes).map_err(|_| unreadable("it is not UTF-8 text".to_owned()))?;
        Self::from_ron(&text).map_err(refused)
    }

    /// Writes a scene file, as a whole or not at all.
    ///
    /// # Errors
    /// If the file cannot be written. The message names it.
    pub fn write(&self, path: &Path) -> Result<(), SceneFileError> {
        let text = self.to_ron().map_err(|reason| SceneFileError::Scene { path: path.to_owned(), reason })?;
        Ok(atomic_file::replace(path, text.as_bytes())?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FIRST: &str = "Scene(\n    version: 1,\n    title: \"t\",\n    study: Point(methods: [Full]),\n)";

    #[test]
    fn a_short_scene_takes_the_defaults_and_survives_writing() {
        let scene = Scene::from_ron(FIRST).unwrap();
        assert_eq!(scene.at, super::super::At::moes(40.0, 10.0));
        assert_eq!(Scene::from_ron(&scene.to_ron().unwrap()).unwrap(), scene);
    }

    #[test]
    fn unknown_fields_are_errors_with_line_and_column() {
        let text = FIRST.replace("title", "titel");
        let SceneError::Syntax { line, column, message } = Scene::from_ron(&text).unwrap_err() else { panic!() };
        assert_eq!(line, 3);
        assert!(column > 1 && message.contains("titel"), "{column} {message}");
    }

    #[test]
    fn a_newer_scene_is_refused_with_its_version_whatever_it_holds() {
        let text = "Scene(version: 7, title: \"t\", hologram: Wide(depth: 3, of: [1, 2]), study: Dream(\"x\"))";
        assert_eq!(Scene::from_ron(text).unwrap_err(), SceneError::Newer { version: 7 });
        let same = FIRST.replace("version: 1", "version: 2");
        assert_eq!(Scene::from_ron(&same).unwrap_err(), SceneError::Newer { version: 2 });
        assert_eq!(Scene::from_ron(&FIRST.replace("version: 1", "version: 0")).unwrap_err(), SceneError::NoVersion);
    }

    #[test]
    fn text_that_is_no_scene_is_refused() {
        for text in ["", "Scene(", "{}", "Scene()", "\u{0}\u{1}", "Scene(version: 1, title: \"t\", study: Point())"] {
            assert!(Scene::from_ron(text).is_err(), "{text}");
        }
        let deep = format!("Scene(version: 1, title: {}", "(".repeat(100_000));
        assert!(Scene::from_ron(&deep).is_err());
    }
}
