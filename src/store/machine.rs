//! Facts about the machine and this process, from Linux (proc(5)).

use std::fs;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

/// The machine's name; empty if it has none.
pub(crate) fn host() -> String {
    let named = fs::read_to_string("/proc/sys/kernel/hostname").ok();
    let variable = |name| std::env::var(name).ok();
    named
        .or_else(|| variable("HOSTNAME"))
        .or_else(|| variable("COMPUTERNAME"))
        .map_or_else(String::new, |name| name.trim().to_owned())
}

/// Largest resident memory of this process, MiB: so far, or since [`forget_peak`].
pub(crate) fn peak_memory_mib() -> Option<f64> {
    kib("/proc/self/status", "VmHWM:").map(|kib| kib as f64 / 1024.0)
}

/// Resets the peak. Returns whether the system allows it.
pub(crate) fn forget_peak() -> bool {
    const PEAK: &str = "5";
    fs::write("/proc/self/clear_refs", PEAK).is_ok()
}

/// Available memory, MiB, if the system states it.
pub(crate) fn free_memory_mib() -> Option<u64> {
    kib("/proc/meminfo", "MemAvailable:").map(|kib| kib >> 10)
}

/// The time, UTC, in the format of RFC 3339 to the millisecond, so that texts sort as times do.
pub(crate) fn now() -> String {
    let since_1970 = SystemTime::now().duration_since(UNIX_EPOCH);
    rfc_3339(since_1970.unwrap_or_default())
}

fn rfc_3339(since_1970: Duration) -> String {
    let seconds = since_1970.as_secs();
    let [year, month, day] = date(seconds / 86_400);
    let [hour, minute, second] = [seconds / 3600 % 24, seconds / 60 % 60, seconds % 60];
    let millis = since_1970.subsec_millis();
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}.{millis:03}Z")
}

/// Year, month and day, this many days after 1970-01-01: `civil_from_days` of H. Hinnant,
/// "chrono-Compatible Low-Level Date Algorithms" (2013). Its years begin in March, so that a leap
/// day is their last, and repeat after 400, which have 146 097 days.
fn date(days_since_1970: u64) -> [u64; 3] {
    let days = days_since_1970 + 719_468;
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let from_march = (5 * day + 2) / 153;
    let day = day - (153 * from_march + 2) / 5 + 1;
    let month = if from_march < 10 {
        from_march + 3
    } else {
        from_march - 9
    };
    [400 * era + year + u64::from(month <= 2), month, day]
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

    /// By `date --utc --iso-8601=seconds --date @…` of GNU coreutils.
    #[test]
    fn times_are_those_of_the_calendar() {
        for (seconds, time) in [
            (0, "1970-01-01T00:00:00.250Z"),
            (951_782_399, "2000-02-28T23:59:59.250Z"),
            (951_782_400, "2000-02-29T00:00:00.250Z"),
            (951_868_800, "2000-03-01T00:00:00.250Z"),
            (1_767_225_599, "2025-12-31T23:59:59.250Z"),
            (4_107_542_400, "2100-03-01T00:00:00.250Z"),
            (13_574_563_199, "2400-02-28T23:59:59.250Z"),
        ] {
            assert_eq!(rfc_3339(Duration::from_millis(1000 * seconds + 250)), time);
        }
    }
}
