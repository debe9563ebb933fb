//! Peak memory of this process, as Linux counts it (proc(5): `clear_refs`, `VmHWM`).

use std::fs;

/// Resets the peak. Returns whether the system allows it.
pub(super) fn forget_peak() -> bool {
    const PEAK: &str = "5";
    fs::write("/proc/self/clear_refs", PEAK).is_ok()
}

/// Largest resident memory since [`forget_peak`], MiB.
pub(super) fn peak_mib() -> Option<f64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:"))?;
    let kib: f64 = line.split_whitespace().next()?.parse().ok()?;
    Some(kib / 1024.0)
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    #[test]
    fn memory_that_was_touched_shows_in_the_peak() {
        assert!(forget_peak());
        let before = peak_mib().expect("Linux tells");
        let touched = vec![1u8; 64 << 20];
        let after = peak_mib().expect("Linux tells");
        // Other tests of this process may give memory back meanwhile.
        assert!(after - before > 32.0, "{before} {after} {}", touched[1000]);
    }
}
