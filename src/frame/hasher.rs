//! A hash of typed values: each has a fixed length or begins with it, so that no two lists of values
//! make the same bytes.

/// BLAKE3 of values.
#[derive(Default)]
pub(super) struct Hasher(blake3::Hasher);

impl Hasher {
    /// Which of several kinds follows.
    pub(super) fn kind(&mut self, kind: u8) -> &mut Self {
        self.0.update(&[kind]);
        self
    }

    /// Whether something is so.
    pub(super) fn flag(&mut self, flag: bool) -> &mut Self {
        self.kind(u8::from(flag))
    }

    /// How many of something follow.
    pub(super) fn count(&mut self, count: usize) -> &mut Self {
        self.0.update(&(count as u64).to_le_bytes());
        self
    }

    /// A whole number.
    pub(super) fn whole(&mut self, value: u32) -> &mut Self {
        self.0.update(&value.to_le_bytes());
        self
    }

    /// A number, to its last bit.
    pub(super) fn number(&mut self, value: f64) -> &mut Self {
        self.0.update(&value.to_bits().to_le_bytes());
        self
    }

    /// A number that may be missing.
    pub(super) fn given(&mut self, value: Option<f64>) -> &mut Self {
        match value {
            None => self.kind(0),
            Some(value) => self.kind(1).number(value),
        }
    }

    /// Three numbers.
    pub(super) fn vector(&mut self, vector: impl Into<[f64; 3]>) -> &mut Self {
        let [x, y, z] = vector.into();
        self.number(x).number(y).number(z)
    }

    /// Text.
    pub(super) fn text(&mut self, text: &str) -> &mut Self {
        self.count(text.len()).0.update(text.as_bytes());
        self
    }

    /// A list of texts.
    pub(super) fn texts(&mut self, texts: &[&str]) -> &mut Self {
        texts.iter().fold(self.count(texts.len()), |s, t| s.text(t))
    }

    /// The hash.
    pub(super) fn finish(&self) -> blake3::Hash {
        self.0.finalize()
    }
}
