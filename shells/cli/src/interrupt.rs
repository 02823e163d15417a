//! Stops work on Ctrl-C, on SIGTERM, or when the process takes too much memory.
//!
//! Long work checks the request between and within steps. The first signal raises the request, a later one ends the
//! program. INVARIANT: signals that come together count as one: `timeout` signals the program and its process group, so
//! the signal arrives twice.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{LazyLock, Once, OnceLock};
use std::time::{Duration, Instant};

use machine::{Cause, Interrupt};

static REQUEST: LazyLock<Interrupt> = LazyLock::new(Interrupt::new);

/// Signals within this time of the first count as the same one.
const TOGETHER: Duration = Duration::from_secs(1);

/// Starts to listen. If that is impossible, Ctrl-C keeps its usual meaning.
pub fn listen() {
    static FIRST: OnceLock<Instant> = OnceLock::new();
    let _ = ctrlc::set_handler(|| {
        if FIRST.get_or_init(Instant::now).elapsed() >= TOGETHER {
            std::process::exit(3);
        }
        REQUEST.raise(Cause::Asked);
    });
}

/// Whether work should stop.
pub fn asked() -> bool {
    REQUEST.cause() == Some(Cause::Asked)
}

/// The request, to be checked within long work.
pub fn request() -> &'static Interrupt {
    &REQUEST
}

/// How often the memory is checked. In between, the program takes a few hundred megabytes at most.
const BETWEEN_LOOKS: Duration = Duration::from_millis(20);

/// Asks work to stop while the process takes more than this many MiB; the last bound counts. Where the system does not
/// report the memory, there is no bound.
pub fn bound_memory(mib: u64) {
    static BOUND: AtomicU64 = AtomicU64::new(u64::MAX);
    static WATCHER: Once = Once::new();
    BOUND.store(mib.saturating_mul(1 << 20), Ordering::Relaxed);
    WATCHER.call_once(|| {
        let watcher = std::thread::Builder::new().name("memory".to_string());
        // Without the thread the other limits still hold.
        let _ = watcher.spawn(|| {
            while let Some(bytes) = resident_bytes() {
                if bytes > BOUND.load(Ordering::Relaxed) {
                    REQUEST.raise(Cause::Memory);
                } else {
                    REQUEST.relieve();
                }
                std::thread::sleep(BETWEEN_LOOKS);
            }
        });
    });
}

/// The memory of the process in bytes, if the system reports it.
pub fn resident_bytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    let kib: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kib << 10)
}
