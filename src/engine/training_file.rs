//! Unfinished trainings on disk (`.training`), so that a crash or a cancel loses no finished full solution.
//!
//! The header is that of `checked_file`. The payload contains the program's version and a [`TrainingState`] with the
//! cavitation model and heat of its lubricant, encoded with postcard. Another version of the program may compute and
//! select differently and therefore refuses the file. A separate thread writes the file at most once a second, so that
//! the training does not wait for the disk.

use super::EngineError;
use super::checked_file::{Flaw, Format, Unreadable};
use crate::host::clock::Stopwatch;
use crate::host::worker;
use crate::scene::atomic_file::{self, WriteError};
use crate::solver::physics::lubricant::{Cavitation, Heat, Lubricant};
use crate::solver::physics::surfaces::Roughness;
use crate::solver::training::{TrainingSpec, TrainingState, Windows};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::collections::HashSet;
use std::ffi::OsString;
use std::fs::{File, TryLockError};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{SyncSender, TrySendError, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

const VERSION: u32 = 14;
/// File format. The size limit corresponds to 5000 full solutions in each of several local models, on the finest grids.
const FORMAT: Format = Format { magic: b"EHLTRN\r\n", version: VERSION, max_payload: 2 << 30 };
/// Version of this program.
const PROGRAM: &str = env!("CARGO_PKG_VERSION");

/// Longest text of another version that is shown.
const LONGEST_VERSION: usize = 40;

/// Free disk space required before a training starts \[bytes\]: two copies of 200 full solutions of point contacts.
const ROOM: usize = 32 << 20;

/// Shortest time between two writes.
const INTERVAL: Duration = Duration::from_secs(1);

/// Reason why an unfinished training cannot be stored or continued.
#[derive(Debug, thiserror::Error)]
pub enum TrainingFileError {
    /// Reading or deleting failed.
    #[error("cannot use the unfinished training {}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
    /// Writing failed.
    #[error("the unfinished training cannot be stored: {0}")]
    Write(#[from] WriteError),
    /// The content is not valid.
    #[error("{} is not an unfinished training that can be continued ({what}); delete it to train from the beginning", path.display())]
    Refused {
        /// The file.
        path: PathBuf,
        /// Reason.
        what: String,
    },
    /// Another training is writing the file.
    #[error("{} is being written by another training; wait for its end or choose another --out", path.display())]
    InUse {
        /// The file.
        path: PathBuf,
    },
    /// The file belongs to another specification.
    #[error(
        "{} contains {solutions} full solutions of another training, “{title}”; finish that one with its own scene, delete the file, or choose another --out",
        path.display()
    )]
    Another {
        /// The file.
        path: PathBuf,
        /// Title of the training in the file.
        title: String,
        /// Number of full solutions in the file.
        solutions: usize,
    },
}

/// Returns the file in which the training of a model file is stored until it is finished: `FILE.rom.training`.
pub fn beside(model: &Path) -> PathBuf {
    with_suffix(model, ".training")
}

fn with_suffix(path: &Path, suffix: &str) -> PathBuf {
    let mut name = OsString::from(path);
    name.push(suffix);
    name.into()
}

/// State with the parts of the lubricant that are not serialised with it: cavitation model, heat and roughness. The
/// latter two are stored as JSON, since their serialised forms leave fields out.
#[derive(Serialize, Deserialize)]
struct Whole<'a>(Cow<'a, TrainingState>, Cavitation, String);

impl<'a> Whole<'a> {
    fn of(state: &'a TrainingState) -> Self {
        let Lubricant { cavitation, heat, roughness, .. } = state.spec.lubricant;
        Self(Cow::Borrowed(state), cavitation, serde_json::to_string(&(heat, roughness)).unwrap_or_default())
    }
}

impl TryFrom<Whole<'_>> for TrainingState {
    type Error = serde_json::Error;

    fn try_from(Whole(state, cavitation, further): Whole<'_>) -> Result<Self, Self::Error> {
        let (heat, roughness): (Option<Heat>, Option<Roughness>) = serde_json::from_str(&further)?;
        let mut state: Self = state.into_owned();
        state.spec = state.spec.under(cavitation).heated(heat).on_surfaces(roughness);
        Ok(state)
    }
}

/// Module for `#[serde(with = "training_file::whole")]`: serialises a state with the cavitation model, heat and
/// roughness of its lubricant.
pub mod whole {
    use super::{TrainingState, Whole};
    use serde::de::Error as _;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    /// Serialises a state.
    ///
    /// # Errors
    /// Those of the serialiser.
    pub fn serialize<S: Serializer>(state: &TrainingState, serializer: S) -> Result<S::Ok, S::Error> {
        Whole::of(state).serialize(serializer)
    }

    /// Reads a state.
    ///
    /// # Errors
    /// Those of the deserialiser.
    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<TrainingState, D::Error> {
        Whole::deserialize(deserializer)?.try_into().map_err(D::Error::custom)
    }
}

/// Reads an unfinished training.
///
/// # Errors
/// If the file cannot be read or is not valid.
pub fn read(path: &Path) -> Result<TrainingState, TrainingFileError> {
    let refused = |what: String| TrainingFileError::Refused { path: path.to_owned(), what };
    let flawed = |flaw| {
        refused(match flaw {
            Flaw::Foreign => "it is another kind of file".to_owned(),
            Flaw::OtherVersion { found } => {
                format!("its format has version {found}, this program reads version {VERSION}")
            }
            Flaw::Truncated { found, wanted } => format!("it is cut off: {found} of {wanted} bytes are there"),
            Flaw::TooLarge { bytes } => format!("it announces {bytes} bytes, more than any training has"),
            Flaw::Changed => "its content does not match its hash".to_owned(),
        })
    };
    let bytes = FORMAT.read(path).map_err(|reason| match reason {
        Unreadable::Io(source) => TrainingFileError::Io { path: path.to_owned(), source },
        Unreadable::Flaw(flaw) => flawed(flaw),
    })?;
    let payload = FORMAT.open(&bytes).map_err(flawed)?;
    let undecoded = |_| refused("its content cannot be decoded".to_owned());
    let (program, payload) = postcard::take_from_bytes::<&str>(payload).map_err(undecoded)?;
    if program != PROGRAM {
        let program: String = program.chars().filter(|c| !c.is_control()).take(LONGEST_VERSION).collect();
        return Err(refused(format!(
            "it was begun by version {program} of the program, and this is version {PROGRAM}, whose solutions and choices may differ"
        )));
    }
    let whole: Whole = postcard::from_bytes(payload).map_err(undecoded)?;
    let state = TrainingState::try_from(whole).map_err(|_| refused("its content cannot be decoded".to_owned()))?;
    if is_sound(&state) { Ok(state) } else { Err(refused("its content contradicts itself".to_owned())) }
}

/// Returns true if a training can be continued from the state. A correct hash does not guarantee this.
fn is_sound(state: &TrainingState) -> bool {
    let windows_fit = match &state.spec.windows {
        Windows::Given(given) => state.windows.is_empty() || state.windows.iter().map(|w| &w.window).eq(given),
        Windows::Automatic { .. } | Windows::Anchored { .. } => true,
    };
    windows_fit
        && !state.spec.title.chars().any(char::is_control)
        && state.windows.iter().chain(&state.trials).all(|window| {
            let places = window.solved.iter().map(|s| s.place).chain(window.pending.iter().map(|p| p.0));
            let points = window.solved.iter().map(|s| &s.point).chain(window.pending.iter().map(|p| &p.1));
            let numbers = window.solved.iter().flat_map(|s| s.pressure.iter().chain([&s.h_0, &s.h_c]));
            let count = window.solved.len() + window.pending.len();
            let places: HashSet<usize> = places.filter(|place| *place < count).collect();
            places.len() == count
                && points.into_iter().all(|point| point.check().is_ok())
                && numbers.into_iter().all(|number| number.is_finite())
        })
}

/// Returns the stored state of a training, if there is one.
///
/// # Errors
/// If the file cannot be read, or belongs to another training. Such a file is not overwritten.
pub fn unfinished(path: &Path, spec: &TrainingSpec) -> Result<Option<TrainingState>, TrainingFileError> {
    if !path.exists() {
        return Ok(None);
    }
    let state = read(path)?;
    if state.spec == *spec {
        return Ok(Some(state));
    }
    let (title, solutions) = (state.spec.title.clone(), state.solutions());
    Err(TrainingFileError::Another { path: path.to_owned(), title, solutions })
}

/// Writes an unfinished training as a whole or not at all.
///
/// # Errors
/// If the file cannot be written.
pub fn write(state: &TrainingState, path: &Path) -> Result<(), TrainingFileError> {
    write_as(PROGRAM, state, path)
}

fn write_as(program: &str, state: &TrainingState, path: &Path) -> Result<(), TrainingFileError> {
    let refused = || TrainingFileError::Refused { path: path.to_owned(), what: "it cannot be encoded".to_owned() };
    let encoded = postcard::to_allocvec(&(program, Whole::of(state))).map_err(|_| refused())?;
    Ok(atomic_file::replace(path, &FORMAT.seal(&encoded))?)
}

/// Exclusive right to write an unfinished training: `FILE.rom.training.lock`, deleted when it is released.
struct Lock {
    path: PathBuf,
    // The system releases the lock when the program ends, also after a crash.
    _file: File,
}

impl Lock {
    /// Takes the lock. This also shows that the folder is writable.
    fn take(path: &Path) -> Result<Self, TrainingFileError> {
        let refused = |reason| WriteError { path: path.to_owned(), reason };
        let lock = with_suffix(path, ".lock");
        let file = File::options().write(true).create(true).truncate(false).open(&lock).map_err(refused)?;
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => Err(TrainingFileError::InUse { path: path.to_owned() }),
            // On systems without file locks, two trainings cannot be kept apart.
            Ok(()) | Err(TryLockError::Error(_)) => Ok(Self { path: lock, _file: file }),
        }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // A remaining lock file is reused by the next training.
        let _ = std::fs::remove_file(&self.path);
    }
}

/// Refuses a folder without enough free space for a training.
fn try_room(path: &Path) -> Result<(), WriteError> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let fill = || {
        let mut file = tempfile::tempfile_in(folder)?;
        let block = vec![0xa5; 1 << 20];
        (0..ROOM).step_by(block.len()).try_for_each(|_| file.write_all(&block))
    };
    fill().map_err(|reason| WriteError { path: path.to_owned(), reason })
}

/// Writes the state of a training to disk while it runs.
pub struct TrainingKeeper {
    path: PathBuf,
    states: SyncSender<TrainingState>,
    handed_over: Mutex<Option<Stopwatch>>,
    refusal: Arc<Mutex<Option<TrainingFileError>>>,
    writer: Option<JoinHandle<()>>,
    _lock: Lock,
}

impl TrainingKeeper {
    /// Returns a keeper that writes to `path`. Nothing is written before the first full solutions are available.
    ///
    /// # Errors
    /// If another training uses the file, or if the folder is not writable or has no free space.
    pub fn new(path: PathBuf) -> Result<Self, TrainingFileError> {
        let lock = Lock::take(&path)?;
        try_room(&path)?;
        let (states, waiting) = sync_channel::<TrainingState>(1);
        let (target, refusal) = (path.clone(), Arc::<Mutex<Option<TrainingFileError>>>::default());
        let said = Arc::clone(&refusal);
        let write_all = move || {
            let mut failing = false;
            for state in waiting {
                let written = write(&state, &target);
                // The same error is not reported again every second.
                let first = !std::mem::replace(&mut failing, written.is_err());
                if let (true, Err(error)) = (first, written) {
                    *said.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
                }
            }
        };
        // Without a thread, only the final state is written.
        let writer = worker::spawn("training file", write_all).ok();
        Ok(Self { path, states, handed_over: Mutex::new(None), refusal, writer, _lock: lock })
    }

    /// Returns the path of the file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Ends with an unfinished training: writes its state to disk.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn keep(self, state: &TrainingState) -> Result<(), TrainingFileError> {
        let path = self.path.clone();
        let _lock = self.settle();
        write(state, &path)
    }

    /// Ends with a finished training: deletes the file.
    ///
    /// # Errors
    /// If the file cannot be deleted.
    pub fn discard(self) -> Result<(), TrainingFileError> {
        let path = self.path.clone();
        let _lock = self.settle();
        remove(&path)
    }

    /// Waits until the writer thread has finished.
    fn settle(self) -> Lock {
        let Self { states, writer, _lock: lock, .. } = self;
        drop(states);
        // If the writer has panicked, the caller writes the final state.
        let _ = writer.map(JoinHandle::join);
        lock
    }

    /// Passes a state to the writer thread, at most once a second.
    ///
    /// # Errors
    /// If a previous state could not be written. Later ones are still attempted.
    pub fn checkpoint(&self, state: &TrainingState) -> Result<(), TrainingFileError> {
        let mut handed_over = self.handed_over.lock().unwrap_or_else(PoisonError::into_inner);
        let due = state.solutions() > 0 && handed_over.is_none_or(|at| at.elapsed() >= INTERVAL);
        // If the writer is still busy, it receives the next state instead.
        if due && !matches!(self.states.try_send(state.clone()), Err(TrySendError::Full(_))) {
            *handed_over = Some(Stopwatch::start());
        }
        self.refusal.lock().unwrap_or_else(PoisonError::into_inner).take().map_or(Ok(()), Err)
    }
}

impl From<TrainingFileError> for EngineError {
    fn from(error: TrainingFileError) -> Self {
        Self::TrainingFile(error.into())
    }
}

/// Deletes an unfinished training, if there is one.
///
/// # Errors
/// If the file cannot be deleted.
pub fn remove(path: &Path) -> Result<(), TrainingFileError> {
    match std::fs::remove_file(path) {
        Err(source) if source.kind() != io::ErrorKind::NotFound => {
            Err(TrainingFileError::Io { path: path.to_owned(), source })
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::discrete::grid::GridSpec;
    use crate::solver::physics::contact::OperatingPoint;
    use crate::solver::training::small::moes;
    use crate::solver::training::{Plan, Search, Solved, WindowSpec, WindowState};

    fn state(folder: &str) -> (TrainingState, PathBuf) {
        let range = moes((10.0, 20.0), (2.0, 3.0), 3e9);
        let (grid, plan) = (GridSpec::EXPLORER, Plan::FarthestPoint { snapshots: 8 });
        let spec = TrainingSpec { title: "kept".to_owned(), ..TrainingSpec::new(range, (10.0, 20.0), grid, plan) };
        let point = OperatingPoint::TABLE_2_1;
        let solved = Solved {
            place: 0,
            point,
            pressure: vec![0.5; 633],
            h_0: -0.1,
            h_c: 0.04,
            grid_cost: None,
            fronts: Vec::new(),
        };
        let window = WindowState {
            window: WindowSpec::new((10.0, 20.0), GridSpec::EXPLORER),
            seed: 1,
            inherited: 0,
            solved: vec![solved],
            pending: vec![(1, point)],
            planned: true,
            search: Search::default(),
        };
        let folder = std::env::temp_dir().join(format!("ehl-training-file-{folder}-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        (TrainingState { windows: vec![window], solves: 1, ..TrainingState::new(spec) }, folder.join("a.rom.training"))
    }

    #[test]
    fn what_is_kept_comes_back_only_for_its_own_training() {
        let (state, path) = state("own");
        assert!(unfinished(&path, &state.spec).unwrap().is_none());
        write(&state, &path).unwrap();
        assert_eq!(unfinished(&path, &state.spec).unwrap().as_ref(), Some(&state));
        let mut ruptured = state.clone();
        ruptured.spec = ruptured.spec.under(Cavitation::Complementarity);
        write(&ruptured, &path).unwrap();
        assert_eq!(read(&path).unwrap(), ruptured);
        write(&state, &path).unwrap();
        assert!(unfinished(&path, &state.spec.clone().under(Cavitation::Complementarity)).is_err(), "another law");
        let other = TrainingSpec { seed: 2, ..state.spec.clone() };
        let sentence = unfinished(&path, &other).unwrap_err().to_string();
        assert!(sentence.contains("another training, “kept”") && sentence.contains("1 full"), "{sentence}");
        std::fs::remove_dir_all(path.parent().unwrap()).unwrap();
    }

    #[test]
    fn trainings_of_other_versions_are_refused_and_kept() {
        let (state, path) = state("version");
        write_as("0.0.1-\u{7}former", &state, &path).unwrap();
        let before = std::fs::read(&path).unwrap();
        let sentence = unfinished(&path, &state.spec).unwrap_err().to_string();
        for part in ["begun by version 0.0.1-former of the program", PROGRAM, "delete it to train from the beginning"] {
            assert!(sentence.contains(part), "{sentence}");
        }
        assert_eq!(std::fs::read(&path).unwrap(), before);
        std::fs::remove_dir_all(path.parent().unwrap()).unwrap();
    }

    #[test]
    fn damage_and_contradictions_are_refused() {
        let (good, path) = state("damage");
        let refused = |bytes: &[u8]| {
            std::fs::write(&path, bytes).unwrap();
            assert!(matches!(read(&path), Err(TrainingFileError::Refused { .. })));
        };
        write(&good, &path).unwrap();
        let bytes = std::fs::read(&path).unwrap();
        refused(b"");
        refused(&bytes[..bytes.len() - 3]);
        let mut flipped = bytes.clone();
        flipped[100] ^= 1;
        refused(&flipped);
        for spoil in [
            (|s: &mut TrainingState| s.windows[0].pending[0].0 = 7) as fn(&mut TrainingState),
            |s| s.windows[0].solved[0].pressure[9] = f64::NAN,
            |s| s.windows[0].window.m.1 = 30.0,
            |s| s.windows[0].solved[0].point.radius_m = -1.0,
        ] {
            let mut bad = good.clone();
            spoil(&mut bad);
            write(&bad, &path).unwrap();
            assert!(read(&path).unwrap_err().to_string().contains("contradicts itself"));
        }
        std::fs::remove_dir_all(path.parent().unwrap()).unwrap();
    }

    #[test]
    fn a_keeper_writes_the_first_and_the_last_state_and_cleans_up() {
        let (state, path) = state("keeper");
        let keeper = TrainingKeeper::new(path.clone()).unwrap();
        keeper.checkpoint(&TrainingState::new(state.spec.clone())).unwrap();
        keeper.checkpoint(&state).unwrap();
        let second = TrainingKeeper::new(path.clone()).err().unwrap();
        assert!(matches!(second, TrainingFileError::InUse { .. }), "{second}");
        let mut later = state.clone();
        later.windows[0].search.judged = 3;
        keeper.keep(&later).unwrap();
        assert_eq!(read(&path).unwrap(), later);
        let keeper = TrainingKeeper::new(path.clone()).unwrap();
        let folder = path.parent().unwrap().to_owned();
        #[cfg(unix)]
        {
            // A folder that no longer exists, so that nothing can be written.
            let away = folder.with_extension("away");
            std::fs::rename(&folder, &away).unwrap();
            let patience = Stopwatch::start();
            let said = loop {
                if let Err(error) = keeper.checkpoint(&state) {
                    break error.to_string();
                }
                assert!(patience.elapsed() < Duration::from_secs(60), "the failure is not told");
                std::thread::sleep(Duration::from_millis(10));
            };
            assert!(said.contains("a.rom.training"), "{said}");
            std::fs::rename(&away, &folder).unwrap();
        }
        keeper.discard().unwrap();
        assert!(!path.exists());
        assert!(TrainingKeeper::new(folder.join("no/such.training")).is_err());
        assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 0);
        std::fs::remove_dir_all(folder).unwrap();
    }
}
