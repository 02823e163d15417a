//! What a process takes: time on the clock, time of its processors, memory at its peak.
//!
//! In: a command. Out: what it printed and [`Spent`]. Figures are read from /proc while it runs and when it has ended; where
//! there is no /proc they are missing.

use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::Failure;

/// How often the peak is looked at.
const LOOK: Duration = Duration::from_millis(10);
/// Ticks of a second in /proc, the same on all of Linux.
const TICKS: f64 = 100.0;

/// See the module.
#[derive(Debug, Clone, Copy, Default)]
pub struct Spent {
    /// Seconds on the clock.
    pub wall: f64,
    /// Seconds of processors, in the process itself and not in the system.
    pub user: f64,
    /// MiB at the peak.
    pub peak: f64,
}

/// Runs a command to its end, whatever it ends with.
///
/// # Errors
/// It cannot be run.
pub fn run(command: &mut Command) -> Result<(String, Spent), Failure> {
    let name = command.get_program().to_string_lossy().into_owned();
    let wrong = |error: std::io::Error| format!("{name} cannot be run: {error}");
    // A file takes what it prints, so that no pipe is ever full.
    let mut printed = tempfile::tempfile().map_err(wrong)?;
    let before = children_user();
    let began = Instant::now();
    let mut child = command
        .stdin(Stdio::null())
        .stdout(printed.try_clone().map_err(wrong)?)
        .stderr(Stdio::null())
        .spawn()
        .map_err(wrong)?;
    let peak = watch(&mut child).map_err(wrong)?;
    let spent = Spent { wall: began.elapsed().as_secs_f64(), user: children_user() - before, peak };
    let mut text = String::new();
    std::io::Seek::rewind(&mut printed).map_err(wrong)?;
    std::io::Read::read_to_string(&mut printed, &mut text).map_err(wrong)?;
    Ok((text, spent))
}

/// Waits for a process; gives the most memory it held, in MiB.
fn watch(child: &mut Child) -> std::io::Result<f64> {
    let mut peak = 0f64;
    loop {
        let status = std::fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap_or_default();
        let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let kib = line.and_then(|rest| rest.split_whitespace().next()).and_then(|kib| kib.parse::<f64>().ok());
        peak = peak.max(kib.unwrap_or(0.0) / 1024.0);
        if child.try_wait()?.is_some() {
            return Ok(peak);
        }
        std::thread::sleep(LOOK);
    }
}

/// The user time of all children that have ended.
fn children_user() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // The name in parentheses may hold blanks; `cutime` is the 16th field, the 14th behind it.
    let rest = stat.rsplit_once(')').map_or("", |(_, rest)| rest);
    let ticks = rest.split_whitespace().nth(13).and_then(|ticks| ticks.parse::<f64>().ok());
    ticks.unwrap_or(0.0) / TICKS
}
