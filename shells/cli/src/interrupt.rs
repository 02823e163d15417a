//! Ctrl-C and SIGTERM, and the memory of the process: what asks a piece of work to stop where it is.
//!
//! The request is looked at within long pieces of work, between steps and within them. The first signal raises it, one that comes
//! later ends the program. INVARIANT: signals that come together are one: `timeout` sends its signal to the program and to its
//! process group, so that it comes twice.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{LazyLock, Once, OnceLock};
use std::time::{Duration, Instant};

use machine::{Cause, Interrupt};

static REQUEST: LazyLock<Interrupt> = LazyLock::new(Interrupt::new);

/// Signals within this time of the first are the same one.
const TOGETHER: Duration = Duration::from_secs(1);

/// Listens from now on. Where that is not possible, Ctrl-C keeps its usual meaning.
pub fn listen() {
    static FIRST: OnceLock<Instant> = OnceLock::new();
    let _ = ctrlc::set_handler(|| {
        if FIRST.get_or_init(Instant::now).elapsed() >= TOGETHER {
            std::process::exit(3);
        }
        REQUEST.raise(Cause::Asked);
    });
}

/// Whether to stop.
pub fn asked() -> bool {
    REQUEST.cause() == Some(Cause::Asked)
}

/// The request, for whoever looks at it within a long piece of work.
pub fn request() -> &'static Interrupt {
    &REQUEST
}

/// Between two looks at the memory: the program takes some hundred megabytes in this time at most.
const BETWEEN_LOOKS: Duration = Duration::from_millis(20);

/// Asks what runs to stop while the process takes more memory than so many MiB; the last bound counts. Where the system does not
/// tell how much it takes, nothing is looked at.
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

/// How much memory the process takes, where the system tells.
pub fn resident_bytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    let kib: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kib << 10)
}
