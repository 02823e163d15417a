//! `groundstate chart extract MODEL`: writes the chart of a model's rules in control-state form.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::write_text;
use crate::load::load;
use crate::shell::Shell;

/// Arguments of `chart extract`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// A model
    model: PathBuf,
    /// Extract only this rule, which may stand in an imported module. Default: all rules of the file
    #[arg(long, value_name = "NAME")]
    rule: Option<String>,
    /// The function that holds the control state. Default: the one that all actions of a rule depend on
    #[arg(long, value_name = "NAME")]
    control: Option<String>,
    /// Draw no composite states
    #[arg(long)]
    flat: bool,
    /// The chart to write. Default: stdout
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let loaded = match load(shell, &arguments.model)? {
        Ok(loaded) => loaded,
        Err(exit) => return Ok(exit),
    };
    if let Some(rule) = &arguments.rule
        && !loaded.model.rules.iter().any(|known| known.name == *rule)
    {
        return Err(Failure::usage(format!("the model has no rule `{rule}`")));
    }
    let mut found = chart::extract(&loaded.model, arguments.rule.as_deref(), arguments.control.as_deref());
    if !arguments.flat {
        chart::nest(&loaded.model, &mut found);
    }
    let imports = arguments.model.file_name().map(|name| name.to_string_lossy().into_owned());
    found.chart.imports.extend(imports);
    for (rule, reason) in &found.others {
        shell.note(&format!("{rule} is not a machine: {reason}"))?;
    }
    for (rule, location) in &found.further {
        shell.note(&format!("{rule} is drawn over another location; `--control` draws it over {location}"))?;
    }
    if found.chart.machines.is_empty() {
        shell.note("no rule is in control-state form")?;
        return Ok(Exit::Model);
    }
    let text = chart::write(&found.chart);
    match &arguments.output {
        None => shell.out().write_all(text.as_bytes())?,
        Some(path) => {
            write_text(path, &text)?;
            if shell.talks() {
                writeln!(shell.out(), "{}", path.display())?;
            }
        }
    }
    Ok(Exit::Good)
}
