//! Memory of images: films that are rendered together, and images being encoded.

use crate::render::{Options, film_bytes};
use crate::store::free_memory_mib;

/// Memory for the films of a batch at most, bytes. A film of 1280 x 720 is 11 MiB: forty and more
/// share a trace, so that each takes a fortieth of its time; more would gain little, and a killed
/// run would lose all of it.
const FILMS: u64 = 512 << 20;

/// Memory for images that are developed and encoded at once at most, bytes. One of 3840 x 2160
/// takes 245 MiB, so that four threads work on such images, and all threads on smaller ones.
const DEVELOPED: u64 = 1 << 30;

/// Number of frames with the same trace in work at once: at least one, and as many as fit into 512
/// MiB.
pub fn most_together(options: &Options) -> usize {
    let most = FILMS / film_bytes(options).max(1);
    usize::try_from(most).unwrap_or(usize::MAX).max(1)
}

/// An image that does not fit into the free memory of this machine.
#[derive(Debug, thiserror::Error)]
#[error(
    "{width} x {height} pixels need about {needed} MiB of memory and {free} MiB are free; render with a smaller --scale"
)]
pub struct TooLarge {
    /// Width in pixels.
    width: u32,
    /// Height in pixels.
    height: u32,
    /// MiB needed.
    needed: u64,
    /// MiB free.
    free: u64,
}

/// Number of films that are developed and encoded at once on this many threads, at least one.
pub(super) fn most_developed(options: &Options, threads: usize) -> usize {
    let most = DEVELOPED / developed_bytes(options).max(1);
    let most = usize::try_from(most).unwrap_or(usize::MAX);
    most.min(threads).max(1)
}

/// Bytes of this many films that share a trace, with those that are developed and encoded at once.
pub(super) fn image_bytes(options: &Options, films: usize, threads: usize) -> u64 {
    let developed = most_developed(options, threads).min(films) as u64;
    let films = film_bytes(options).saturating_mul(films as u64);
    films.saturating_add(developed_bytes(options).saturating_mul(developed))
}

/// Refuses an image that this machine surely cannot hold, before the system kills the process
/// half-way.
///
/// # Errors
/// The memory needed and the memory free.
pub(super) fn check_memory(options: &Options) -> Result<(), TooLarge> {
    let needed = image_bytes(options, 1, 1) >> 20;
    match free_memory_mib() {
        Some(free) if needed > free => Err(TooLarge {
            width: options.width,
            height: options.height,
            needed,
            free,
        }),
        _ => Ok(()),
    }
}

/// Bytes that an image takes besides its film: developed values, bytes of an image, the encoder's
/// copy of them.
fn developed_bytes(options: &Options) -> u64 {
    let pixel = 12 + 3 + 16 + 4 * options.layers.len() as u64;
    u64::from(options.width) * u64::from(options.height) * pixel
}

#[cfg(test)]
mod tests {
    use super::*;

    fn options(width: u32, height: u32) -> Options {
        Options {
            width,
            height,
            samples: 1,
            layers: Vec::new(),
        }
    }

    #[test]
    fn all_threads_develop_small_images_and_few_develop_large_ones() {
        assert_eq!(most_developed(&options(1280, 720), 16), 16);
        assert_eq!(most_developed(&options(3840, 2160), 16), 4);
        assert_eq!(most_developed(&options(65536, 65536), 16), 1);
    }

    /// Six frames of 2400 x 1350 took 312 MiB on one thread and 698 MiB on six (resident memory of
    /// the whole process): each further thread 77 MiB.
    #[test]
    fn each_thread_is_counted_as_was_measured() {
        const MEASURED_MIB: f64 = (698.0 - 312.0) / 5.0;
        let options = options(2400, 1350);
        let mib = |threads| image_bytes(&options, 6, threads) as f64 / f64::from(1 << 20);
        let thread = (mib(6) - mib(1)) / 5.0;
        // An estimate that errs, errs on the high side, by a third at most.
        assert!(
            (1.0..1.33).contains(&(thread / MEASURED_MIB)),
            "{thread} MiB"
        );
        // Threads without a film take none.
        assert_eq!(mib(6), mib(60));
    }
}
