//! A folder of its own in which the program is called.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// The folder; gone when dropped.
pub(crate) struct Desk(TempDir);

impl Desk {
    /// Nothing in it.
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    /// `sphere.obj` and its library of materials in it.
    pub(crate) fn with_sphere() -> Self {
        let desk = Self::new();
        let assets = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets");
        for name in ["sphere.obj", "sphere.mtl"] {
            fs::copy(assets.join(name), desk.path(name)).unwrap();
        }
        desk
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.path(name), content).unwrap();
    }

    pub(crate) fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    /// The program, to be called with arguments that blanks part.
    pub(crate) fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_restframe"));
        command
            .args(arguments.split_whitespace())
            .current_dir(self.0.path())
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        command
    }

    pub(crate) fn spawn(&self, arguments: &str) -> Child {
        self.command(arguments).spawn().unwrap()
    }

    pub(crate) fn call(&self, arguments: &str) -> Outcome {
        Outcome::of_call(&mut self.command(arguments))
    }

    /// A call that must succeed.
    pub(crate) fn done(&self, arguments: &str) -> Outcome {
        let outcome = self.call(arguments);
        assert_eq!(outcome.status, 0, "{arguments}: {}", outcome.stderr);
        outcome
    }

    /// Runs a line of shell, in which `$restframe` is the program.
    pub(crate) fn shell(&self, line: &str) -> Outcome {
        let mut command = Command::new("bash");
        command
            .args(["-c", line])
            .current_dir(self.0.path())
            .env("restframe", env!("CARGO_BIN_EXE_restframe"));
        Outcome::of_call(&mut command)
    }
}

/// How a call ended, and what it said.
pub(crate) struct Outcome {
    pub(crate) status: i32,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

/// How long a call may take: each takes seconds, and more on a busy machine.
const DEADLINE: Duration = Duration::from_secs(120);

impl Outcome {
    /// Calls a program, and ends it where it hangs.
    pub(crate) fn of_call(command: &mut Command) -> Self {
        command.stdin(Stdio::null());
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        let stdout = read_all(child.stdout.take().unwrap());
        let stderr = read_all(child.stderr.take().unwrap());
        let begun = Instant::now();
        let status = loop {
            if let Some(status) = child.try_wait().unwrap() {
                break status;
            }
            if begun.elapsed() > DEADLINE {
                child.kill().unwrap();
                child.wait().unwrap();
                panic!("{command:?} has not ended after {DEADLINE:?}");
            }
            std::thread::sleep(Duration::from_millis(2));
        };
        Self::of(Output {
            status,
            stdout: stdout.join().unwrap(),
            stderr: stderr.join().unwrap(),
        })
    }

    pub(crate) fn of(output: Output) -> Self {
        let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
        let (stdout, stderr) = (text(output.stdout), text(output.stderr));
        assert!(!stderr.contains("panicked"), "{stderr}");
        let status = output.status.code();
        Self {
            status: status.unwrap_or_else(|| panic!("{:?}: {stderr}", output.status)),
            stdout,
            stderr,
        }
    }
}

/// Reads a pipe to its end, so that its writer does not wait.
fn read_all(mut pipe: impl Read + Send + 'static) -> JoinHandle<Vec<u8>> {
    std::thread::spawn(move || {
        let mut bytes = Vec::new();
        pipe.read_to_end(&mut bytes).unwrap();
        bytes
    })
}
