//! Reduced model files (`.rom`): a checked header, then bases, rows, operators, snapshots and the training scene.
//!
//! The header is that of `checked_file`, the payload in postcard's encoding. K V_p is not stored: it is
//! recomputed when a model is read. Bases are stored to an accuracy of the fields they make (`stored_matrix`).

use super::checked_file::{Flaw, Format, Unreadable};
use super::stored_matrix::{StoredBasis, StoredMatrix};
use crate::scene::atomic_file::{self, WriteError};
use crate::solver::discrete::grid::{ContactGrid, ContactGridError, ContactGridSpec};
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::lubricant::{LimitingStress, Lubricant, ShearLaw, Sliding};
use crate::solver::reduced::{
    Calibration, Domain, ReducedModel, RollingCalibration, SampledRows, Sampling, SlidingDomain, Snapshot,
    TractionRule, Window,
};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::sync::Arc;

const VERSION: u32 = 5;
/// Its matrices were kept in other ways, which are still understood.
const OLDEST: u32 = 3;
/// The first version whose bounds count in mean squares of errors; under sliding those of older ones rest on errors that were none.
const MEAN_SQUARES: u32 = 5;
/// Real models have a few MB.
const FORMAT: Format = Format { magic: b"EHLROM\r\n", version: VERSION, oldest: OLDEST, max_payload: 512 << 20 };

/// Relative accuracy of pressures and deformations at every node to which the bases of line and of point contacts are kept.
const ACCURACY: [f64; 2] = [1e-13, 2e-10];

/// The models that are part of the program: of a kind of contact, for a lubricant that thins under shear or not. Each is trained by a scene.
const EMBEDDED: [((ContactKind, bool), &[u8]); 4] = [
    // scenes/training/embedded_model.ron
    ((ContactKind::Line, false), include_bytes!("../../assets/line.rom")),
    // scenes/training/table_3_4_model.ron
    ((ContactKind::Point, false), include_bytes!("../../assets/point.rom")),
    // scenes/training/embedded_shear_model.ron
    ((ContactKind::Line, true), include_bytes!("../../assets/line_shear.rom")),
    // scenes/training/embedded_point_shear_model.ron
    ((ContactKind::Point, true), include_bytes!("../../assets/point_shear.rom")),
];

/// Why a model file is refused. Nothing is lost by it.
#[derive(Debug, thiserror::Error)]
pub enum ModelFileError {
    /// Reading failed.
    #[error("cannot read {}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// Writing failed.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// Not a model file at all.
    #[error("this is not a reduced model file (.rom); train one with `ehl-explorer train SCENE.ron --out FILE.rom`")]
    Foreign,
    /// Written by a newer program.
    #[error(
        "the model file has version {found}, but this program reads versions {OLDEST} to {VERSION}; use a newer program or train it again"
    )]
    Newer {
        /// Its version.
        found: u32,
    },
    /// Written by an older program.
    #[error(
        "the model file has version {found}, but this program reads versions {OLDEST} to {VERSION}; train it again"
    )]
    Older {
        /// Its version.
        found: u32,
    },
    /// Cut off.
    #[error("the model file is cut off: {found} of {wanted} bytes are there; copy it again or train it again")]
    Truncated {
        /// Bytes that are there.
        found: u64,
        /// Bytes that the header announces.
        wanted: u64,
    },
    /// Larger than any model.
    #[error("the model file announces {bytes} bytes, more than any model has; it is damaged")]
    TooLarge {
        /// Bytes announced.
        bytes: u64,
    },
    /// The content does not fit its hash or itself.
    #[error("the model file is damaged ({what}); copy it again or train it again")]
    Damaged {
        /// What does not fit.
        what: &'static str,
    },
    /// Its grid is refused.
    #[error("the model file's grid is refused: {0}")]
    Grid(#[from] ContactGridError),
}

impl From<Flaw> for ModelFileError {
    fn from(flaw: Flaw) -> Self {
        match flaw {
            Flaw::Foreign => Self::Foreign,
            Flaw::Newer { found } => Self::Newer { found },
            Flaw::Older { found } => Self::Older { found },
            Flaw::Truncated { found, wanted } => Self::Truncated { found, wanted },
            Flaw::TooLarge { bytes } => Self::TooLarge { bytes },
            Flaw::Changed => Self::Damaged { what: "its content does not match its hash" },
        }
    }
}

#[derive(Serialize, Deserialize)]
struct StoredModel {
    title: String,
    domain: Domain,
    windows: Vec<StoredWindow>,
    scene: String,
    log: Vec<String>,
}

/// What follows the model where its lubricant thins under shear.
#[derive(Serialize, Deserialize)]
struct StoredShear {
    law: ShearLaw,
    limiting_stress: Option<LimitingStress>,
    domain: SlidingDomain,
    /// Of the snapshots of each window.
    snapshots: Vec<Vec<Sliding>>,
}

/// What follows that where there is any, one of each window.
#[derive(Serialize, Deserialize)]
struct StoredTraction {
    rules: Vec<Option<TractionRule>>,
    calibrations: Vec<Option<Calibration>>,
}

#[derive(Serialize, Deserialize)]
struct StoredWindow {
    m: (f64, f64),
    grid: ContactGridSpec,
    penalty: f64,
    pressure: StoredBasis,
    deformation: StoredBasis,
    sampling: Sampling,
    sampled_rows: Vec<usize>,
    reconstruction: StoredMatrix,
    snapshots: Vec<Snapshot>,
    /// That of a model that knows sliding is kept with its traction.
    calibration: Option<RollingCalibration>,
}

impl StoredModel {
    /// Takes over what a shear-thinning lubricant adds.
    fn thin(&mut self, shear: StoredShear) -> Result<(), ModelFileError> {
        let StoredShear { law, limiting_stress, domain, snapshots } = shear;
        let lubricant = Lubricant { shear: law, limiting_stress, ..self.domain.lubricant };
        let ratios = |s: &Sliding| (s.slide_to_roll_ratio, s.newtonian_plateau_ratio.unwrap_or(0.0));
        let sound = |s: &Sliding| ratios(s).0.is_finite() && (0.0..=1.0).contains(&ratios(s).1);
        let fits = snapshots.len() == self.windows.len()
            && self.windows.iter().zip(&snapshots).all(|(window, sliding)| window.snapshots.len() == sliding.len())
            && snapshots.iter().flatten().all(sound);
        if !fits || law == ShearLaw::Newtonian || lubricant.check().is_err() {
            return Err(ModelFileError::Damaged { what: "shear-thinning" });
        }
        for (window, sliding) in self.windows.iter_mut().zip(snapshots) {
            for (snapshot, sliding) in window.snapshots.iter_mut().zip(sliding) {
                snapshot.point.sliding = sliding;
            }
        }
        self.domain.lubricant = lubricant;
        self.domain.sliding = Some(domain);
        Ok(())
    }
}

impl StoredTraction {
    /// Hands every window its own.
    fn give(self, windows: &mut [Window], version: u32) -> Result<(), ModelFileError> {
        let damaged = Err(ModelFileError::Damaged { what: "traction" });
        if [self.rules.len(), self.calibrations.len()] != [windows.len(); 2] {
            return damaged;
        }
        for ((window, rule), calibration) in windows.iter_mut().zip(self.rules).zip(self.calibrations) {
            let known = |c: &Calibration| c.sound() && c.sliding();
            if !rule.as_ref().is_none_or(|rule| rule.sound(&window.grid)) || !calibration.as_ref().is_none_or(known) {
                return damaged;
            }
            (window.traction, window.calibration) = (rule, calibration.filter(|_| version >= MEAN_SQUARES));
        }
        Ok(())
    }
}

impl StoredWindow {
    fn into_window(self, grid: ContactGrid, version: u32) -> Result<Window, ModelFileError> {
        let nodes = grid.len();
        let damaged = |what| Err(ModelFileError::Damaged { what });
        let (Some(pressure), Some(deformation)) = (self.pressure.into_basis(nodes), self.deformation.into_basis(nodes))
        else {
            return damaged("bases");
        };
        let modes = pressure.modes.ncols();
        if modes == 0 || deformation.modes.ncols() == 0 {
            return damaged("bases");
        }
        let Some(reconstruction) = self.reconstruction.into_mat(modes) else { return damaged("sampled rows") };
        let rows_fit = self.sampled_rows.windows(2).all(|w| w[0] < w[1])
            && self.sampled_rows.last().is_some_and(|&r| r < grid.unknowns())
            && reconstruction.ncols() == self.sampled_rows.len();
        if !rows_fit {
            return damaged("sampled rows");
        }
        let snapshots_fit = self.snapshots.iter().all(|s| {
            s.point.check().is_ok()
                && s.point.kind == grid.kind()
                && s.coefficients.len() == modes
                && s.coefficients.iter().chain([&s.h_0, &s.h_c]).all(|v| v.is_finite())
        });
        if !(self.penalty.is_finite() && self.penalty > 0.0) {
            return damaged("penalty");
        }
        if self.snapshots.is_empty() || !snapshots_fit {
            return damaged("snapshots");
        }
        let mut calibration = self.calibration.map(Calibration::from);
        let sound = |calibration: &Option<Calibration>| calibration.as_ref().is_none_or(Calibration::sound);
        if sound(&calibration) && version < MEAN_SQUARES {
            calibration.iter_mut().for_each(Calibration::measure_again);
        }
        if !sound(&calibration) {
            return damaged("calibration");
        }
        let rows = SampledRows { rows: self.sampled_rows, reconstruction };
        let mut window = Window::new(self.m, grid, pressure, deformation, self.snapshots, self.sampling, rows);
        (window.penalty, window.calibration) = (self.penalty, calibration);
        Ok(window)
    }
}

/// The content of the model in the program for a kind of contact and a lubricant that thins under shear or not.
fn embedded_bytes(contact: ContactKind, thins: bool) -> &'static [u8] {
    EMBEDDED.iter().find(|(of, _)| *of == (contact, thins)).map_or(&[], |(_, bytes)| bytes)
}

/// The model in the program for a kind of contact and a lubricant that thins under shear or not.
///
/// # Errors
/// When the program was built with a damaged asset.
pub fn embedded_model(contact: ContactKind, thins: bool) -> Result<ReducedModel, ModelFileError> {
    from_bytes(embedded_bytes(contact, thins))
}

/// The model of line contacts that is part of the program.
///
/// # Errors
/// When the program was built with a damaged asset.
pub fn embedded() -> Result<Arc<ReducedModel>, ModelFileError> {
    embedded_of(ContactKind::Line)
}

/// The model of one kind of contact that is part of the program.
///
/// # Errors
/// When the program was built with a damaged asset.
pub fn embedded_of(contact: ContactKind) -> Result<Arc<ReducedModel>, ModelFileError> {
    embedded_model(contact, false).map(Arc::new)
}

/// The model of one kind of contact with a shear-thinning lubricant that is part of the program.
///
/// # Errors
/// When the program was built with a damaged asset.
pub fn embedded_shear_of(contact: ContactKind) -> Result<Arc<ReducedModel>, ModelFileError> {
    embedded_model(contact, true).map(Arc::new)
}

/// Reads a model file. Its announced size is checked before anything is allocated.
///
/// # Errors
/// When the file cannot be read, is foreign, newer, cut off or damaged.
pub fn read(path: &Path) -> Result<ReducedModel, ModelFileError> {
    let bytes = FORMAT.read(path).map_err(|reason| match reason {
        Unreadable::Io(source) => ModelFileError::Io { path: path.to_owned(), source },
        Unreadable::Flaw(flaw) => flaw.into(),
    })?;
    from_bytes(&bytes)
}

/// Writes a model file as a whole or not at all.
///
/// # Errors
/// When the file cannot be written.
pub fn write(model: &ReducedModel, path: &Path) -> Result<(), ModelFileError> {
    Ok(atomic_file::replace(path, &to_bytes(model)?)?)
}

/// The content of a model file.
///
/// # Errors
/// When the model cannot be encoded.
pub fn to_bytes(model: &ReducedModel) -> Result<Vec<u8>, ModelFileError> {
    let accuracy = ACCURACY[usize::from(model.contact() == ContactKind::Point)];
    let basis = |basis, grid: &ContactGrid| StoredBasis::new(basis, grid.nodes().1, accuracy);
    let stored = StoredModel {
        title: model.title.clone(),
        domain: model.domain.clone(),
        windows: model
            .windows
            .iter()
            .map(|w| StoredWindow {
                m: w.m,
                grid: w.grid.spec(),
                penalty: w.penalty,
                pressure: basis(&w.pressure, &w.grid),
                deformation: basis(&w.deformation, &w.grid),
                sampling: w.sampling,
                sampled_rows: w.sampled_rows.clone(),
                reconstruction: StoredMatrix::exact(&w.reconstruction),
                snapshots: w.snapshots.clone(),
                calibration: w.calibration.as_ref().and_then(|c| RollingCalibration::try_from(c).ok()),
            })
            .collect(),
        scene: model.scene.clone(),
        log: model.log.clone(),
    };
    let unwritable = |_| ModelFileError::Damaged { what: "encoding" };
    let mut payload = postcard::to_allocvec(&stored).map_err(unwritable)?;
    if let Some(domain) = model.domain.sliding {
        let Lubricant { shear: law, limiting_stress, .. } = model.domain.lubricant;
        let of_window = |w: &Window| w.snapshots.iter().map(|snapshot| snapshot.point.sliding).collect();
        let snapshots = model.windows.iter().map(of_window).collect();
        let shear = StoredShear { law, limiting_stress, domain, snapshots };
        payload = postcard::to_extend(&shear, payload).map_err(unwritable)?;
        let traction = StoredTraction {
            rules: model.windows.iter().map(|w| w.traction.clone()).collect(),
            calibrations: model.windows.iter().map(|w| w.calibration.clone()).collect(),
        };
        if traction.rules.iter().any(Option::is_some) || traction.calibrations.iter().any(Option::is_some) {
            payload = postcard::to_extend(&traction, payload).map_err(unwritable)?;
        }
    }
    Ok(FORMAT.seal(&payload))
}

/// A model from the content of a file.
///
/// # Errors
/// As [`read`].
pub fn from_bytes(bytes: &[u8]) -> Result<ReducedModel, ModelFileError> {
    let payload = FORMAT.open(bytes)?;
    let version = FORMAT.version_of(bytes);
    let undecodable = |_| ModelFileError::Damaged { what: "its content cannot be decoded" };
    let (mut stored, rest): (StoredModel, &[u8]) = postcard::take_from_bytes(payload).map_err(undecodable)?;
    let mut traction = None;
    if !rest.is_empty() {
        let (shear, rest) = postcard::take_from_bytes(rest).map_err(undecodable)?;
        stored.thin(shear)?;
        if !rest.is_empty() {
            traction = Some(postcard::from_bytes::<StoredTraction>(rest).map_err(undecodable)?);
        }
    }
    let grids = grids(&stored.windows)?;
    let mut windows: Vec<Window> = stored
        .windows
        .into_par_iter()
        .zip(grids)
        .map(|(w, grid)| w.into_window(grid, version))
        .collect::<Result<_, _>>()?;
    if windows.is_empty() {
        return Err(ModelFileError::Damaged { what: "no windows" });
    }
    if windows.iter().any(|window| window.grid.kind() != windows[0].grid.kind()) {
        return Err(ModelFileError::Damaged { what: "windows of different contacts" });
    }
    if let Some(traction) = traction {
        traction.give(&mut windows, version)?;
    }
    let StoredModel { title, domain, scene, log, .. } = StoredModel { windows: Vec::new(), ..stored };
    Ok(ReducedModel { title, domain, windows, scene, log })
}

/// The grid of each window. Building one is the costly part of reading a model, so equal ones are built once.
fn grids(windows: &[StoredWindow]) -> Result<Vec<ContactGrid>, ModelFileError> {
    let mut grids: Vec<ContactGrid> = Vec::with_capacity(windows.len());
    for window in windows {
        let grid = match grids.iter().find(|grid| grid.spec() == window.grid) {
            Some(built) => built.clone(),
            None => window.grid.build()?,
        };
        grids.push(grid);
    }
    Ok(grids)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_embedded_models_are_intact_small_and_survive_a_round_trip() {
        for (_, bytes) in EMBEDDED {
            assert!(bytes.len() < 6_000_000, "{} bytes", bytes.len());
            assert!(to_bytes(&from_bytes(bytes).unwrap()).unwrap() == bytes);
        }
    }

    #[test]
    fn damage_is_named_and_never_panics() {
        assert!(matches!(from_bytes(b"PNG something else entirely"), Err(ModelFileError::Foreign)));
        assert!(matches!(from_bytes(&[]), Err(ModelFileError::Foreign)));
        let line = embedded_bytes(ContactKind::Line, false);
        assert!(matches!(from_bytes(&line[..10]), Err(ModelFileError::Truncated { .. })));
        assert!(matches!(from_bytes(&line[..line.len() - 9]), Err(ModelFileError::Truncated { .. })));
        let mut flipped = line.to_vec();
        let middle = flipped.len() / 2;
        flipped[middle] ^= 0x40;
        assert!(matches!(from_bytes(&flipped), Err(ModelFileError::Damaged { .. })));
        let mut huge = line.to_vec();
        huge[12..20].copy_from_slice(&u64::MAX.to_le_bytes());
        assert!(matches!(from_bytes(&huge), Err(ModelFileError::TooLarge { .. })));
        let of_version = |version: u8| {
            let mut bytes = embedded_bytes(ContactKind::Line, true).to_vec();
            bytes[8] = version;
            from_bytes(&bytes)
        };
        assert!(matches!(of_version(99), Err(ModelFileError::Newer { found: 99 })));
        assert!(matches!(of_version(OLDEST as u8 - 1), Err(ModelFileError::Older { found: 2 })));
        let old = of_version(OLDEST as u8).unwrap();
        assert!(old.windows[0].calibration.is_none(), "what older files promise under sliding is not believed");
        // Without sliding the same evidence gives the same bounds, whatever an older file kept of its scatter.
        let mut bytes = line.to_vec();
        bytes[8] = MEAN_SQUARES as u8 - 1;
        let (old, new) = (from_bytes(&bytes).unwrap(), embedded().unwrap());
        assert!(old.windows.iter().zip(&new.windows).all(|(old, new)| old.calibration == new.calibration));
    }

    #[test]
    fn a_payload_that_lies_about_its_shapes_is_refused_even_with_a_right_hash() {
        let model = embedded().unwrap();
        let mut wrong = (*model).clone();
        wrong.windows[0].sampled_rows[0] = 1_000_000;
        wrong.windows[0].sampled_rows.sort_unstable();
        assert!(matches!(from_bytes(&to_bytes(&wrong).unwrap()), Err(ModelFileError::Damaged { .. })));
        let mut wrong = (*model).clone();
        wrong.windows[1].snapshots[0].h_c = f64::NAN;
        assert!(from_bytes(&to_bytes(&wrong).unwrap()).is_err());
    }

    #[test]
    fn an_unwritable_target_is_one_sentence() {
        let model = embedded().unwrap();
        let error = write(&model, Path::new("/nonexistent-folder/model.rom")).unwrap_err().to_string();
        assert!(error.contains("/nonexistent-folder/model.rom"), "{error}");
    }
}
