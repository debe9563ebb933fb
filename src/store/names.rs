//! Names of a shot's files: frames, manifests, and assembled outputs.

use crate::shot::Shot;

/// The claim under which a sequence is assembled.
pub const SEQUENCE: &str = "sequence";

/// Ends of the names of assembled files.
pub const ASSEMBLED: [&str; 5] = ["sheet.png", "gif", "apng", "mp4", "av1.mp4"];

/// Name of the overview of a shot's frames.
pub const PAGE: &str = "index.html";

/// What the mark of a temporary file begins with, between the target's name and six random letters
/// and digits: no file of a user's is called so.
pub(super) const MARK: &str = "restframe-";

/// The names of one shot's files, all in one folder.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Names {
    /// Beginning of all names: the stem of the shot file.
    pub stem: String,
    digits: usize,
}

impl Names {
    /// The names of a shot's files. Frame numbers have at least four digits, and as many in all.
    pub fn new(shot: &Shot) -> Self {
        let stem = shot.path.file_stem().unwrap_or_default();
        Self {
            stem: stem.to_string_lossy().into_owned(),
            digits: shot.shot.frames.to_string().len().max(4),
        }
    }

    /// The names in a folder with the name of its shot's stem; the number of frames is not known.
    pub(crate) fn of_stem(stem: String) -> Self {
        Self { stem, digits: 4 }
    }

    /// STEM.0012.png
    pub fn frame(&self, frame: u32, extension: &str) -> String {
        format!("{}.{}.{extension}", self.stem, self.number(frame))
    }

    /// The frame's number and extension, if a file name is one of a frame, of any shot length.
    pub fn frame_of<'a>(&self, name: &'a str) -> Option<(u32, &'a str)> {
        let rest = name.strip_prefix(&self.stem)?.strip_prefix('.')?;
        let (number, extension) = rest.split_once('.')?;
        let known = matches!(extension, "png" | "exr");
        (is_number(number) && known).then_some((number.parse().ok()?, extension))
    }

    /// A frame number as in the names of its files: 0012.
    pub fn number(&self, frame: u32) -> String {
        let digits = self.digits;
        format!("{frame:0digits$}")
    }

    /// .STEM.locks, the folder of the claims.
    pub fn locks(&self) -> String {
        format!(".{}.locks", self.stem)
    }

    /// The claim under which a temporary file ([`AtomicFile`](super::AtomicFile)) is written, from
    /// its name. None if it is not a temporary file of this shot.
    pub fn claim_of_temporary(&self, name: &str) -> Option<String> {
        let (target, mark) = name.strip_suffix(".tmp")?.rsplit_once('.')?;
        let is_own = mark.strip_prefix(MARK).is_some_and(is_random);
        let suffix = target.strip_prefix(&self.stem);
        let suffix = suffix.and_then(|suffix| suffix.strip_prefix('.'));
        if self.frame_of(target).is_some() {
            let number = suffix?.split('.').next()?;
            let ours = is_own || is_process_and_serial(mark);
            return ours.then(|| number.to_owned());
        }
        let ours = match target == PAGE {
            true => is_own || is_process_and_serial(mark),
            false => {
                let is_assembled = suffix.is_some_and(|suffix| ASSEMBLED.contains(&suffix));
                is_assembled && (is_own || is_random(mark))
            }
        };
        ours.then(|| SEQUENCE.to_owned())
    }

    /// STEM.manifest.jsonl, or STEM.manifest.K-N.jsonl of a shard.
    pub fn manifest(&self, shard: Option<[u32; 2]>) -> String {
        match shard {
            None => format!("{}.manifest.jsonl", self.stem),
            Some([k, n]) => format!("{}.manifest.{k}-{n}.jsonl", self.stem),
        }
    }

    /// Whether a file name is that of a manifest of this shot.
    pub fn is_manifest(&self, name: &str) -> bool {
        let rest = name.strip_prefix(&self.stem);
        rest.and_then(|rest| rest.strip_prefix(".manifest."))
            .is_some_and(|rest| rest == "jsonl" || rest.ends_with(".jsonl"))
    }

    /// STEM.SUFFIX, the name of an assembled file; the suffix is one of [`ASSEMBLED`].
    pub fn assembled(&self, suffix: &str) -> String {
        format!("{}.{suffix}", self.stem)
    }
}

/// Whether a part of a mark is random: six letters and digits. Alone they were the mark of assembled
/// files before [`MARK`].
fn is_random(mark: &str) -> bool {
    mark.len() == 6 && mark.bytes().all(|byte| byte.is_ascii_alphanumeric())
}

/// Whether a temporary file has the mark of frames and pages of before [`MARK`]: PID-SERIAL.
fn is_process_and_serial(mark: &str) -> bool {
    let digits = |part: &str| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
    mark.split_once('-')
        .is_some_and(|(process, serial)| digits(process) && digits(serial))
}

/// Whether a name, or a part of it, is a frame's number.
pub(super) fn is_number(name: &str) -> bool {
    name.len() >= 4 && name.bytes().all(|byte| byte.is_ascii_digit())
}
