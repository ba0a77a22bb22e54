//! Writing the session on a thread of its own: a change is on disk soon, whether or not another frame is drawn.

use super::state::{FILE, Session};
use crate::app::explorer::Explorer;
use crate::app::refusal::Refusal;
use crate::host::clock::Stopwatch;
use crate::host::{files, worker};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

/// From a change to its being written: a gesture of many changes is written now and then only.
const DELAY: Duration = Duration::from_secs(2);

/// Keeps the session of a window on disk.
pub struct Keeper {
    given: Option<Session>,
    sessions: Option<Sender<Session>>,
    refusals: Receiver<Refusal>,
    writer: Writer,
}

/// Who writes.
enum Writer {
    Thread(Option<JoinHandle<()>>),
    /// The window itself where there are no threads: what waits, where it goes, and when the last was written.
    Window {
        waiting: Receiver<Session>,
        path: PathBuf,
        says: Sender<Refusal>,
        last: Option<Stopwatch>,
    },
}

impl Keeper {
    /// A keeper that writes to a folder, which is made where it does not exist.
    ///
    /// # Errors
    /// A sentence when there is no such folder or no thread.
    pub fn new(folder: &Path) -> Result<Self, Refusal> {
        let cannot =
            |error: std::io::Error| Refusal::new(format!("No session can be kept in {}: {error}", folder.display()));
        files::make_folder(folder).map_err(cannot)?;
        let path = folder.join(FILE);
        let (sessions, waiting) = channel::<Session>();
        let (says, refusals) = channel();
        let writer = if worker::THREADS {
            let write = move || {
                while let Ok(mut session) = waiting.recv() {
                    let first = Stopwatch::start();
                    // The last one counts; when no more can come, it is written at once.
                    while let Ok(later) = worker::receive(&waiting, DELAY.saturating_sub(first.elapsed())) {
                        session = later;
                    }
                    write(&session, &path, &says);
                }
            };
            Writer::Thread(Some(worker::spawn("session", write).map_err(cannot)?))
        } else {
            Writer::Window { waiting, path, says, last: None }
        };
        Ok(Self { given: None, sessions: Some(sessions), refusals, writer })
    }

    /// Hands over what has changed since the last call, and tells why former changes could not be written.
    pub fn follow(&mut self, explorer: &Explorer) -> Option<Refusal> {
        if !self.given.as_ref().is_some_and(|given| given.is_of(explorer)) {
            let session = Session::of(explorer);
            if let Some(sessions) = &self.sessions {
                // The writer ends with its keeper.
                let _ = sessions.send(session.clone());
            }
            self.given = Some(session);
        }
        self.writer.write_due(DELAY);
        self.refusals.try_iter().last()
    }
}

impl Writer {
    /// Writes what waits where the window does so, unless the last time was less than `delay` ago.
    fn write_due(&mut self, delay: Duration) {
        let Self::Window { waiting, path, says, last } = self else { return };
        if last.is_none_or(|last| last.elapsed() >= delay)
            && let Some(session) = waiting.try_iter().last()
        {
            *last = Some(Stopwatch::start());
            write(&session, path, says);
        }
    }
}

fn write(session: &Session, path: &Path, says: &Sender<Refusal>) {
    if let Err(sentence) = session.write(path) {
        // A window that has closed hears nothing.
        let _ = says.send(sentence);
    }
}

impl Drop for Keeper {
    /// Waits until the last change is written.
    fn drop(&mut self) {
        drop(self.sessions.take());
        self.writer.write_due(Duration::ZERO);
        if let Writer::Thread(writer) = &mut self.writer
            && let Some(writer) = writer.take()
        {
            let _ = writer.join();
        }
    }
}
