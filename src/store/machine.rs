//! Facts of the machine and of this process, as Linux tells them (proc(5)).

use std::fs;

/// The machine's name; empty where it has none.
pub(crate) fn host() -> String {
    let named = fs::read_to_string("/proc/sys/kernel/hostname").ok();
    let variable = |name| std::env::var(name).ok();
    named
        .or_else(|| variable("HOSTNAME"))
        .or_else(|| variable("COMPUTERNAME"))
        .map_or_else(String::new, |name| name.trim().to_owned())
}

/// Greatest resident memory of this process, MiB: so far, or since [`forget_peak`].
pub(crate) fn peak_memory_mib() -> Option<f64> {
    kib("/proc/self/status", "VmHWM:").map(|kib| kib as f64 / 1024.0)
}

/// Forgets the greatest memory so far. Answers whether the system could.
pub(crate) fn forget_peak() -> bool {
    const PEAK: &str = "5";
    fs::write("/proc/self/clear_refs", PEAK).is_ok()
}

/// Memory that can be had, MiB, where the system says.
pub(crate) fn free_memory_mib() -> Option<u64> {
    kib("/proc/meminfo", "MemAvailable:").map(|kib| kib >> 10)
}

/// The time, UTC, as RFC 3339 has it: to the millisecond, so that texts compare as times do.
pub(crate) fn now() -> String {
    format!("{:.3}", jiff::Timestamp::now())
}

/// The number of KiB on the line of a file that begins with `name`.
fn kib(file: &str, name: &str) -> Option<u64> {
    let text = fs::read_to_string(file).ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    line.split_whitespace().next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_three_digits_of_a_second_and_end_in_z() {
        let time = now();
        assert_eq!(time.len(), "2026-11-22T12:00:00.000Z".len(), "{time}");
        assert_eq!((&time[19..20], &time[23..]), (".", "Z"), "{time}");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn memory_that_was_touched_shows_in_the_peak() {
        assert!(forget_peak());
        let before = peak_memory_mib().expect("Linux tells");
        let touched = vec![1u8; 64 << 20];
        let after = peak_memory_mib().expect("Linux tells");
        // Other tests of this process may give memory back meanwhile.
        assert!(after - before > 32.0, "{before} {after} {}", touched[1000]);
    }
}
