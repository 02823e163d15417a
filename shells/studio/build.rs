//! The front end is embedded: what `make studio` makes of it anew makes the program anew.

#![allow(clippy::disallowed_macros, reason = "this is how a build script speaks to cargo")]
#![allow(clippy::disallowed_methods, reason = "the folder is that of the front end")]

use std::fs::{self, File};
use std::path::Path;
use std::time::SystemTime;

fn main() {
    let folder = Path::new("../../web/dist");
    // Cargo takes what is missing for changed, so without the folder each build would compile the program again, and replace it while it
    // runs. A folder that is new is as old as can be, or it would count as changed once more. Where this cannot be done, builds are slower.
    if !folder.exists() && fs::create_dir_all(folder).is_ok() {
        _ = File::open(folder).and_then(|made| made.set_modified(SystemTime::UNIX_EPOCH));
    }
    println!("cargo::rerun-if-changed={}", folder.display());
}
