//! Shards: part K of N of the work, the same on every machine.

use std::collections::HashMap;
use std::hash::Hash;
use std::str::FromStr;

/// One of N parts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// K, from 1.
    k: u32,
    /// N.
    n: u32,
}

/// A shard that cannot be read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0:?} is no shard; write K/N, such as 2/5 for the second of five, K from 1 to N")]
pub struct ShardError(String);

impl Shard {
    /// K and N.
    pub fn numbers(self) -> [u32; 2] {
        [self.k, self.n]
    }

    /// This shard's frames, of a list given by their traces. Traces are dealt out in the order of
    /// their first frames, so that frames with the same trace stay together and shards take about
    /// equally long.
    pub fn choose<T: Hash + Eq>(self, traces: impl Iterator<Item = T>) -> Vec<bool> {
        let mut numbers: HashMap<T, usize> = HashMap::new();
        let number = |trace| {
            let next = numbers.len();
            *numbers.entry(trace).or_insert(next)
        };
        traces
            .map(number)
            .map(|number| number % self.n as usize == (self.k - 1) as usize)
            .collect()
    }
}

impl FromStr for Shard {
    type Err = ShardError;

    fn from_str(text: &str) -> Result<Self, ShardError> {
        let error = || ShardError(text.to_owned());
        let (k, n) = text.split_once('/').ok_or_else(error)?;
        let number = |text: &str| text.trim().parse::<u32>().map_err(|_| error());
        let (k, n) = (number(k)?, number(n)?);
        if (1..=n).contains(&k) {
            Ok(Self { k, n })
        } else {
            Err(error())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_frame_is_in_one_shard_and_frames_of_one_trace_in_the_same() {
        let traces = ["a", "b", "b", "c", "a", "d", "e", "b"];
        for n in 1..=7 {
            let mut times = [0; 8];
            for k in 1..=n {
                let chosen = Shard { k, n }.choose(traces.into_iter());
                for (i, times) in times.iter_mut().enumerate() {
                    *times += u32::from(chosen[i]);
                    let together = traces.iter().position(|t| *t == traces[i]);
                    assert_eq!(Some(chosen[i]), together.map(|first| chosen[first]));
                }
            }
            assert_eq!(times, [1; 8], "{n}");
        }
    }

    #[test]
    fn shards_of_single_frames_differ_by_one_frame_at_most() {
        let traces: Vec<String> = (0..11).map(|i| i.to_string()).collect();
        let counts = (1..=4).map(|k| {
            let chosen = Shard { k, n: 4 }.choose(traces.iter().map(String::as_str));
            chosen.into_iter().filter(|chosen| *chosen).count()
        });
        assert_eq!(counts.collect::<Vec<_>>(), [3, 3, 3, 2]);
    }

    #[test]
    fn what_is_no_shard_is_refused_and_shown() {
        assert_eq!("2/5".parse(), Ok(Shard { k: 2, n: 5 }));
        for text in [
            "",
            "2",
            "0/5",
            "6/5",
            "1/0",
            "-1/5",
            "1/2/3",
            "a/b",
            "1/4294967296",
        ] {
            let error = text.parse::<Shard>().expect_err("no shard").to_string();
            assert!(error.contains(&format!("{text:?}")), "{error}");
        }
    }
}
