//! A child process, killed on drop or when the run is stopped.

use crate::queue::Stop;
use std::io::{self, Read, Write};
use std::process::{Child, ChildStdout, Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// Number of lines of a program's last output that a message quotes.
const QUOTED: usize = 4;

/// Time between two checks whether a program has ended or has to.
const PAUSE: Duration = Duration::from_millis(10);

/// A running program.
pub(super) struct ChildProcess {
    shared: Arc<Shared>,
    pipe: Option<std::process::ChildStdin>,
    said: Option<JoinHandle<String>>,
}

struct Shared {
    child: Mutex<Child>,
    over: AtomicBool,
}

impl ChildProcess {
    /// Starts a program with pipes as its standard streams.
    pub(super) fn start(command: &mut Command, stop: &Stop) -> io::Result<Self> {
        let mut child = command
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()?;
        let said = child.stderr.take().map(|mut pipe| {
            thread::spawn(move || {
                let mut bytes = Vec::new();
                let _unheard = pipe.read_to_end(&mut bytes);
                String::from_utf8_lossy(&bytes).into_owned()
            })
        });
        let pipe = child.stdin.take();
        let shared = Arc::new(Shared {
            child: Mutex::new(child),
            over: AtomicBool::new(false),
        });
        let (watched, stop) = (Arc::clone(&shared), stop.clone());
        // Writing to the program, or waiting for its end, may block this thread.
        thread::spawn(move || {
            while !watched.over.load(Ordering::Relaxed) {
                if stop.asked().load(Ordering::Relaxed) {
                    return watched.kill();
                }
                thread::sleep(PAUSE);
            }
        });
        Ok(Self { shared, pipe, said })
    }

    /// Writes to its standard input.
    pub(super) fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        match &mut self.pipe {
            Some(pipe) => pipe.write_all(bytes),
            None => Err(io::ErrorKind::BrokenPipe.into()),
        }
    }

    /// Its standard output. Can be taken once.
    pub(super) fn stdout(&self) -> Option<ChildStdout> {
        self.shared.child().stdout.take()
    }

    /// Closes its standard input and waits for its end.
    ///
    /// # Errors
    /// How it ended, with the last lines that it printed, unless it succeeded.
    pub(super) fn end(&mut self) -> Result<(), String> {
        drop(self.pipe.take());
        let status = loop {
            let ended = self.shared.child().try_wait();
            match ended.map_err(|error| error.to_string())? {
                Some(status) => break status,
                None => thread::sleep(PAUSE),
            }
        };
        self.shared.over.store(true, Ordering::Relaxed);
        let said = self.said.take().and_then(|said| said.join().ok());
        if status.success() {
            return Ok(());
        }
        let said = said.unwrap_or_default();
        let lines = said.lines().filter(|line| !line.trim().is_empty());
        let lines: Vec<&str> = lines.collect();
        let last = lines[lines.len().saturating_sub(QUOTED)..].join("; ");
        let words = if last.is_empty() { "nothing" } else { &last };
        Err(format!("({status}) and said: {words}"))
    }
}

impl Shared {
    fn child(&self) -> std::sync::MutexGuard<'_, Child> {
        self.child.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn kill(&self) {
        // If it has ended already, this fails, which does not matter.
        let _ended = self.child().kill();
    }
}

impl Drop for ChildProcess {
    fn drop(&mut self) {
        self.shared.over.store(true, Ordering::Relaxed);
        self.shared.kill();
        let _status = self.shared.child().wait();
    }
}
