//! Stopping on request: by the terminal (SIGINT) or by the system (SIGTERM).
//!
//! The first signal asks the work to stop; if it cannot in time (for example while a model of
//! gigabytes is being read), the process ends anyway, and a second signal ends it at once. Finished
//! frames stay, and no file is incomplete ([`write_atomically`](crate::store::write_atomically)).

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Whether work is to stop: asked by a signal to this process ([`Stop::listen`]), or by a call
/// ([`Stop::ask`]). Clones are one.
#[derive(Debug, Clone, Default)]
pub struct Stop {
    asked: Arc<AtomicBool>,
    status: Arc<AtomicUsize>,
}

impl Stop {
    /// Begins to listen. Signals that the process was started to ignore (`nohup`, the background of
    /// a script) stay ignored. If the work has not stopped in time, `late` is called with the exit
    /// status before the process ends with it.
    ///
    /// # Errors
    /// If the system refuses.
    pub fn listen(late: impl Fn(u8) + Send + 'static) -> std::io::Result<Self> {
        let stop = Self::default();
        system::listen(stop.clone(), late)?;
        Ok(stop)
    }

    /// Asks the work to stop.
    pub fn ask(&self) {
        self.asked.store(true, Ordering::Relaxed);
    }

    /// True once it was asked to stop.
    pub(crate) fn asked(&self) -> &AtomicBool {
        &self.asked
    }

    /// Whether a stop was requested.
    pub fn is_asked(&self) -> bool {
        self.asked.load(Ordering::Relaxed)
    }

    /// Exit status of a process that was asked to stop: 130 if interrupted, 143 if terminated.
    pub fn status(&self) -> Option<u8> {
        let status = self.status.load(Ordering::SeqCst);
        u8::try_from(status).ok().filter(|status| *status > 0)
    }
}

#[cfg(unix)]
mod system {
    use super::Stop;
    use signal_hook::consts::{SIGINT, SIGTERM, SIGXFSZ};
    use signal_hook::iterator::Signals;
    use std::sync::Arc;
    use std::sync::atomic::{AtomicBool, Ordering};
    use std::time::Duration;

    /// Time for the work to stop, and time for then reporting it (a pipe that nobody reads would
    /// block forever): two seconds are promised.
    const PATIENCE: Duration = Duration::from_millis(1700);
    const LAST_WORDS: Duration = Duration::from_millis(100);

    pub(super) fn listen(stop: Stop, late: impl Fn(u8) + Send + 'static) -> std::io::Result<()> {
        // With a handler, even one that only sets an unused flag, a file that grows beyond the
        // limit is an error of its writer and does not end the process.
        signal_hook::flag::register(SIGXFSZ, Arc::new(AtomicBool::new(false)))?;
        let ignored = ignored();
        let heard = [SIGINT, SIGTERM].into_iter();
        let mut signals = Signals::new(heard.filter(|signal| ignored >> (signal - 1) & 1 == 0))?;
        let mut late = Some(late);
        std::thread::spawn(move || {
            for signal in signals.forever() {
                let status = if signal == SIGTERM { 143 } else { 130 };
                let Some(late) = late.take() else {
                    std::process::exit(status.into());
                };
                stop.status.store(status.into(), Ordering::SeqCst);
                stop.asked.store(true, Ordering::SeqCst);
                std::thread::spawn(move || {
                    std::thread::sleep(PATIENCE);
                    std::thread::spawn(move || late(status));
                    std::thread::sleep(LAST_WORDS);
                    std::process::exit(status.into());
                });
            }
        });
        Ok(())
    }

    /// A bit for each ignored signal, if the system states them.
    fn ignored() -> u64 {
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok())
            .unwrap_or_default()
    }
}

#[cfg(not(unix))]
mod system {
    use super::Stop;
    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::flag;
    use std::sync::Arc;

    pub(super) fn listen(stop: Stop, _late: impl Fn(u8) + Send + 'static) -> std::io::Result<()> {
        for (signal, status) in [(SIGINT, 130_u8), (SIGTERM, 143)] {
            // In this order: the first signal finds no request yet.
            flag::register_conditional_shutdown(signal, status.into(), Arc::clone(&stop.asked))?;
            flag::register_usize(signal, Arc::clone(&stop.status), status.into())?;
            flag::register(signal, Arc::clone(&stop.asked))?;
        }
        Ok(())
    }
}
