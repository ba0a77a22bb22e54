//! Writing the session on a thread of its own: a change is on disk soon, whether or not another frame is drawn.

use super::state::{FILE, Session};
use crate::app::explorer::Explorer;
use crate::app::refusal::Refusal;
use crate::host::clock::Stopwatch;
use crate::host::worker;
use std::path::Path;
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
    writer: Option<JoinHandle<()>>,
}

impl Keeper {
    /// A keeper that writes to a folder, which is made where it does not exist.
    ///
    /// # Errors
    /// A sentence when there is no such folder or no thread.
    pub fn new(folder: &Path) -> Result<Self, Refusal> {
        let cannot =
            |error: std::io::Error| Refusal::new(format!("No session can be kept in {}: {error}", folder.display()));
        std::fs::create_dir_all(folder).map_err(cannot)?;
        let path = folder.join(FILE);
        let (sessions, given) = channel::<Session>();
        let (says, refusals) = channel();
        let write = move || {
            while let Ok(mut session) = given.recv() {
                let first = Stopwatch::start();
                // The last one counts; when no more can come, it is written at once.
                while let Ok(later) = given.recv_timeout(DELAY.saturating_sub(first.elapsed())) {
                    session = later;
                }
                if let Err(sentence) = session.write(&path) {
                    // A window that has closed hears nothing.
                    let _ = says.send(sentence);
                }
            }
        };
        let writer = worker::spawn("session", write).map_err(cannot)?;
        Ok(Self { given: None, sessions: Some(sessions), refusals, writer: Some(writer) })
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
        self.refusals.try_iter().last()
    }
}

impl Drop for Keeper {
    /// Waits until the last change is written.
    fn drop(&mut self) {
        drop(self.sessions.take());
        if let Some(writer) = self.writer.take() {
            let _ = writer.join();
        }
    }
}
