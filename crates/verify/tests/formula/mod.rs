//! From AsmetaL text to formulas over propositions.

mod faults;
mod reading;
mod show;

use std::sync::Arc;

use program::Program;
use syntax::SourceFile;
use testkit::NoFiles;

fn lowered(text: &str) -> Arc<Program> {
    let checked = model::check(SourceFile::new("example.asm", text), &mut NoFiles);
    let faults: Vec<_> = checked.diagnostics.iter().filter(|fault| fault.severity == syntax::Severity::Error).collect();
    assert!(faults.is_empty(), "{faults:#?}\n{text}");
    Arc::new(program::lower(&checked.model).expect("no limit is passed"))
}

/// A model with these declarations and properties.
fn model(signature: &str, definitions: &str) -> String {
    format!(
        "asm example\nimport StandardLibrary\nimport CTLLibrary\nimport LTLLibrary\nsignature:\n{signature}\n\
         definitions:\n{definitions}\nmain rule r_Main = skip\n"
    )
}
