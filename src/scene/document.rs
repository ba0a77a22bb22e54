//! The scene as a document: what it holds, read and written as RON.

use super::at::At;
use super::error::{SceneError, SceneFileError, VERSION};
use super::expectation::Expectation;
use super::experiment::Experiment;
use super::grid::Grid;
use super::method::Method;
use super::study::{Study, point};
use super::view::View;
use super::written::is_default;
use super::{atomic_file, examples};
use crate::host::files;
use crate::solver::physics::contact::{ContactError, ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::{Cavitation, Heat, Lubricant, Sliding};
use crate::solver::training::TrainingSpec;
use ron::Options;
use ron::extensions::Extensions;
use ron::ser::PrettyConfig;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Largest scene file that is read \[bytes\].
pub const MAX_BYTES: u64 = 4 << 20;

/// How far the α of a scene may lie from the one that a viscosity law determines and still count as the same, rounded.
const ROUNDED_ALPHA: f64 = 1e-3;

/// Use of the model that a scene trains.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum TrainedModel {
    /// A file of its own.
    #[default]
    Separate,
    /// Part of the program.
    Embedded,
}

/// An experiment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Version of the format, [`VERSION`].
    pub version: u32,
    /// Title for people.
    pub title: String,
    /// Where the experiment comes from: a table, a figure, a paper.
    #[serde(default, skip_serializing_if = "is_default")]
    pub source: String,
    /// Line or point contact.
    #[serde(default)]
    pub contact: ContactKind,
    /// Laws of the lubricant; its constants are part of [`Scene::at`].
    #[serde(default)]
    pub lubricant: Lubricant,
    /// How the film ruptures in full solutions, and in models that are trained from them.
    #[serde(default, skip_serializing_if = "is_default")]
    pub cavitation: Cavitation,
    /// Heat: thermal constants of the oil and of both bodies; without it everything has the inlet's temperature.
    #[serde(default, skip_serializing_if = "is_default")]
    pub heat: Option<Heat>,
    /// The operating point. Studies that bring their own points (trajectory, random test, training) do not use it.
    #[serde(default)]
    pub at: At,
    /// Slide-to-roll ratio SRR.
    #[serde(default, skip_serializing_if = "is_default")]
    pub srr: f64,
    /// Newtonian plateau ratio NPR of a shear-thinning lubricant, in place of its own.
    #[serde(default, skip_serializing_if = "is_default")]
    pub npr: Option<f64>,
    /// Grid of full solutions; a reduced model always uses its own.
    #[serde(default)]
    pub grid: Grid,
    /// The question.
    pub study: Study,
    /// What the answer should be.
    #[serde(default, skip_serializing_if = "is_default")]
    pub expect: Vec<Expectation>,
    /// Whether it takes less than ten seconds of one processor: `run --all --quick` and the tests run those.
    #[serde(default, skip_serializing_if = "is_default")]
    pub quick: bool,
    /// Whether some of its solves are meant to fail. Without this, or an expectation that admits failures, a solve that
    /// fails lets the scene fall short.
    #[serde(default, skip_serializing_if = "is_default")]
    pub failures_expected: bool,
    /// Use of the model that the scene trains. `run --all` runs a scene that trains an embedded model only if it is named.
    #[serde(default, skip_serializing_if = "is_default")]
    pub training: TrainedModel,
    /// What the explorer keeps with it; results do not depend on it.
    #[serde(default, skip_serializing_if = "is_default")]
    pub view: Option<View>,
}

impl Scene {
    /// A scene that solves one contact in its default realisation, in full and by the embedded model.
    pub fn at_moes(m: f64, l: f64) -> Self {
        Self {
            version: VERSION,
            title: format!("Line contact at M = {m}, L = {l}"),
            source: String::new(),
            contact: ContactKind::Line,
            lubricant: Lubricant::default(),
            cavitation: Cavitation::default(),
            heat: None,
            at: At::moes(m, l),
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

    /// The operating point in SI units.
    ///
    /// # Errors
    /// When it is outside any sense, or more is fixed than M and L leave free.
    pub fn point(&self) -> Result<OperatingPoint, ContactError> {
        self.at.with_alpha_of(&self.lubricant).point(self.contact)
    }

    /// A sentence where the scene's own α has no effect: the viscosity law determines another one.
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

    /// What its study is about.
    pub fn experiment(&self) -> Experiment {
        Experiment {
            contact: self.contact,
            lubricant: self.laws(),
            at: self.at,
            sliding: self.sliding(),
            grid: self.grid,
            grid_model: self.study.grid_model(),
            expected: self.expect.iter().map(|expectation| expectation.name.clone()).collect(),
        }
    }

    /// The training that it describes, of films that rupture as the scene says; none where it asks something else.
    pub fn training(&self) -> Option<TrainingSpec> {
        match &self.study {
            Study::Training(spec) => Some(spec.clone().under(self.cavitation).heated(self.heat)),
            _ => None,
        }
    }

    /// The laws of the lubricant, with the way its film ruptures and heat.
    pub fn laws(&self) -> Lubricant {
        Lubricant { cavitation: self.cavitation, heat: self.heat, ..self.lubricant }
    }

    /// Takes over laws, with the way the film ruptures and heat.
    pub fn set_laws(&mut self, laws: Lubricant) {
        (self.cavitation, self.heat) = (laws.cavitation, laws.heat);
        self.lubricant = Lubricant { cavitation: Cavitation::default(), heat: None, ..laws };
    }

    /// The sliding and the plateau ratio.
    pub fn sliding(&self) -> Sliding {
        Sliding { slide_to_roll_ratio: self.srr, newtonian_plateau_ratio: self.npr }
    }
}

fn options() -> Options {
    Options::default().with_default_extension(Extensions::IMPLICIT_SOME | Extensions::UNWRAP_VARIANT_NEWTYPES)
}

/// Only the version, whatever else is there.
#[derive(Deserialize)]
#[serde(rename = "Scene")]
struct Probe {
    version: u32,
}

impl Scene {
    /// Reads and checks a scene.
    ///
    /// # Errors
    /// With line and column where the text is wrong, or the field whose value makes no sense.
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
            message: error.code.to_string().replace('\n', " "),
        })?;
        scene.check()?;
        Ok(scene)
    }

    /// Writes the scene as text that [`Scene::from_ron`] reads back unchanged.
    ///
    /// # Errors
    /// Never for a scene that passes [`Scene::check`].
    pub fn to_ron(&self) -> Result<String, SceneError> {
        let config = PrettyConfig::new().struct_names(true).compact_arrays(true).depth_limit(3);
        let mut text =
            options().to_string_pretty(self, config).map_err(|error| SceneError::Unwritable(error.to_string()))?;
        text.push('\n');
        Ok(text)
    }

    /// Reads a scene file, or one of the program's [`examples`].
    ///
    /// # Errors
    /// When the file cannot be read or is no valid scene; the message names the file.
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
            return Err(unreadable(format!("it is larger than {MAX_BYTES} bytes, which no scene is")));
        }
        let text = String::from_utf8(bytes).map_err(|_| unreadable("it is not UTF-8 text".to_owned()))?;
        Self::from_ron(&text).map_err(refused)
    }

    /// Writes a scene file, as a whole or not at all.
    ///
    /// # Errors
    /// When the file cannot be written; the message names it.
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
