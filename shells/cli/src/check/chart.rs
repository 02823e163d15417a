//! Checks a chart: its own faults, and those of the model that would be built from it. Whether it agrees with the
//! present model is the question of `groundstate chart check`.

use std::path::Path;

use groundstate::BuiltChart;
use syntax::SourceFile;

use super::{Seen, plural};
use crate::failure::Failure;
use crate::files::{Disk, present_text};

/// Checks a chart as `chart build` would.
pub fn look(path: &Path, root: SourceFile, disk: &mut Disk) -> Result<Seen, Failure> {
    let model = path.with_extension("asm");
    let existing = present_text(&model, disk.limit)?;
    let BuiltChart { chart, faults, .. } =
        groundstate::build_chart(root, &model.display().to_string(), existing.as_deref(), disk);
    let machines = chart.machines.len();
    let size = match &chart.system {
        None => format!(" ({})", plural(machines, "machine")),
        Some(system) => {
            let (components, channels) = (system.components.len(), system.drawn_channels().count());
            format!(" ({}, {})", plural(components, "component"), plural(channels, "channel"))
        }
    };
    Ok(Seen { faults, size, open: None })
}
