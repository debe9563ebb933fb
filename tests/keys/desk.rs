//! A folder with a shot and its files, for the tests beside.

use crate::common::desk::Desk;
use restframe::frame::{Digests, Fingerprints, FrameFingerprint, Resolution};
use restframe::shot::{Shot, parse};

/// Two triangles and a slanted third, of two materials.
const MODEL: &str = "mtllib paints.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv 0 0 1\n\
    usemtl wall\nf 1 2 3 4\nusemtl roof\nf 1 2 5\n";
const PAINTS: &str = "newmtl wall\nKd 0.8 0.2 0.1\nnewmtl roof\nKd 0.1 0.7 0.2\nKe 0 0.1 0\n";

/// The folder.
pub(crate) fn house() -> Desk {
    let desk = Desk::new();
    desk.write("house.obj", MODEL);
    desk.write("paints.mtl", PAINTS);
    desk.write("paint.csv", "400,0\n500,0.5\n600,1\n");
    desk.write("stars.csv", "0,0,6000,1\n90,10,9000,2\n");
    desk
}

impl Desk {
    /// A shot of this text in the folder.
    pub(crate) fn shot(&self, text: &str) -> Shot {
        match parse(text, &self.path("shot.toml")) {
            Ok(shot) => shot,
            Err(mistakes) => panic!("{mistakes}\n{text}"),
        }
    }

    /// The keys of its frames at the size that it names.
    pub(crate) fn keys(&self, text: &str) -> Fingerprints {
        let shot = self.shot(text);
        let digests = Digests::read(&shot).unwrap();
        let picture = Resolution {
            size: shot.image.size,
            samples: shot.image.samples,
        };
        Fingerprints::new(shot, digests, picture)
    }

    /// All of a shot's keys.
    pub(crate) fn all(&self, text: &str) -> Vec<FrameFingerprint> {
        let keys = self.keys(text);
        (1..=keys.shot().shot.frames)
            .map(|frame| keys.frame(frame))
            .collect()
    }
}
