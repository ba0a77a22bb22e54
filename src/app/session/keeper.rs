//! Writing of the session in a separate thread. A change is on disk soon, even if no further frame is drawn.

use super::state::{FILE, Session};
use crate::app::explorer::Explorer;
use crate::app::refusal::Refusal;
use crate::host::clock::Stopwatch;
use crate::host::{files, worker};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

/// Delay between a change and its writing, so that a gesture of many changes is written only once in a while.
const DELAY: Duration = Duration::from_secs(2);

/// Writer of the session of a window.
pub struct Keeper {
    given: Option<Session>,
    sessions: Option<Sender<Session>>,
    refusals: Receiver<Refusal>,
    writer: Writer,
}

/// Place where the session is written.
enum Writer {
    Thread(Option<JoinHandle<()>>),
    /// The window itself, if there are no threads: waiting sessions, their path, and the time of the last write.
    Window {
        waiting: Receiver<Session>,
        path: PathBuf,
        says: Sender<Refusal>,
        last: Option<Stopwatch>,
    },
}

impl Keeper {
    /// Creates a keeper that writes to a folder. Creates the folder if it does not exist.
    ///
    /// # Errors
    /// A sentence if there is no such folder or no thread.
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
                    // Only the last session counts. It is written immediately when the channel is closed.
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

    /// Passes on changes since the last call. Returns why previous changes could not be written.
    pub fn follow(&mut self, explorer: &Explorer) -> Option<Refusal> {
        if !self.given.as_ref().is_some_and(|given| given.is_of(explorer)) {
            let session = Session::of(explorer);
            if let Some(sessions) = &self.sessions {
                // The writer lives as long as its keeper, so sending cannot fail.
                let _ = sessions.send(session.clone());
            }
            self.given = Some(session);
        }
        self.writer.write_due(DELAY);
        self.refusals.try_iter().last()
    }
}

impl Writer {
    /// Writes the waiting session if the window writes itself, at most once per `delay`.
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
        // A closed window receives no message.
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
