//! `groundstate fmt PATH…`: formats models, scenarios, charts and couplings.
//!
//! A file is replaced only as a whole, and only if its tokens and comments stay the same. A file with syntax faults is
//! not touched. A file keeps its line ends.

use std::io::{Read, Write};
use std::path::{Path, PathBuf};

use clap::Args;
use groundstate::has_ending;
use syntax::{FileId, Parse, Severity, SourceFile, Sources};
use wire::Answer;

use crate::check::plural;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::{collect, decode, read_source, rewrite_text};
use crate::shell::Shell;

/// Arguments of `fmt`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Models (.asm), scenarios (.avalla), charts (.chart) and couplings (.refine), or folders of them; `-` reads standard input and writes standard output
    #[arg(required = true, value_name = "PATH")]
    paths: Vec<PathBuf>,
    /// Write nothing: list the files that formatting would change, and exit with 1 if there are any
    #[arg(long)]
    check: bool,
}

/// What to do with a file.
enum Layout {
    /// It has syntax faults, which are shown.
    Faulty,
    /// It is formatted already.
    Kept,
    /// Its formatted text.
    Changed(String),
    /// Formatting would change its tokens or comments, which is a bug of ours.
    Refused,
}

/// How many files had which result.
#[derive(Default)]
struct Counts {
    faulty: usize,
    kept: usize,
    changed: usize,
    refused: usize,
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    if arguments.paths.iter().any(|path| path.as_os_str() == "-") {
        if arguments.paths.len() > 1 {
            return Err(Failure::usage("`-` is standard input and stands alone"));
        }
        return standard_input(shell, arguments.check);
    }
    let mut counts = Counts::default();
    for path in collect(&arguments.paths, &["asm", "avalla", "chart", "refine"])? {
        one(shell, &path, arguments.check, &mut counts)?;
    }
    if shell.talks() && !arguments.check {
        let Counts { faulty, kept, changed, .. } = counts;
        let faulty = if faulty == 0 { String::new() } else { format!(", {faulty} with syntax faults left unchanged") };
        writeln!(shell.out(), "{} formatted, {kept} already formatted{faulty}", plural(changed, "file"))?;
    }
    if counts.refused > 0 {
        return Ok(Exit::World);
    }
    let bad = counts.faulty > 0 || arguments.check && counts.changed > 0;
    Ok(if bad { Exit::Model } else { Exit::Good })
}

fn one(shell: &mut Shell, path: &Path, check: bool, counts: &mut Counts) -> Result<(), Failure> {
    let source = read_source(path, shell.global.limits.max_file_size)?;
    let name = source.name.clone();
    let layout = layout(shell, source)?;
    let changed = match layout {
        Layout::Faulty => {
            counts.faulty += 1;
            return Ok(());
        }
        Layout::Refused => {
            counts.refused += 1;
            return Ok(());
        }
        Layout::Kept => {
            counts.kept += 1;
            false
        }
        Layout::Changed(text) => {
            counts.changed += 1;
            if !check {
                rewrite_text(path, &text)?;
            }
            true
        }
    };
    if shell.json() {
        return shell.object(&Answer::Formatted { file: &name, changed });
    }
    if changed && (check || shell.talks()) {
        writeln!(shell.out(), "{name}")?;
    }
    Ok(())
}

fn standard_input(shell: &mut Shell, check: bool) -> Result<Exit, Failure> {
    let limit = shell.global.limits.max_file_size;
    let mut bytes = Vec::new();
    let wrap = |error| Failure::of_file("read", Path::new("-"), error);
    std::io::stdin().lock().take(limit.saturating_add(1)).read_to_end(&mut bytes).map_err(wrap)?;
    let source = decode(Path::new("<stdin>"), bytes, limit)?;
    let text = source.text.clone();
    match (layout(shell, source)?, check) {
        (Layout::Faulty, _) => Ok(Exit::Model),
        (Layout::Refused, _) => Ok(Exit::World),
        (Layout::Kept, true) => Ok(Exit::Good),
        (Layout::Changed(_), true) => {
            writeln!(shell.out(), "<stdin>")?;
            Ok(Exit::Model)
        }
        (Layout::Kept, false) => Ok(shell.out().write_all(text.as_bytes()).map(|()| Exit::Good)?),
        (Layout::Changed(text), false) => Ok(shell.out().write_all(text.as_bytes()).map(|()| Exit::Good)?),
    }
}

fn layout(shell: &mut Shell, source: SourceFile) -> Result<Layout, Failure> {
    if source.foreign.is_some() {
        let message = format!("{} is not UTF-8; it is not formatted", source.name);
        return Err(Failure::usage_with_help(message, "save it as UTF-8; `groundstate check` shows the first place"));
    }
    let text = source.text.clone();
    if has_ending(Path::new(&source.name), "refine") {
        return coupling(shell, source);
    }
    let grammar = grammar(&source);
    let mut sources = Sources::default();
    let file = sources.add(source);
    let parse = grammar(file, &text);
    let errors: Vec<_> = parse.diagnostics.iter().filter(|fault| fault.severity == Severity::Error).cloned().collect();
    if !errors.is_empty() {
        shell.diagnostics(&sources, &errors)?;
        return Ok(Layout::Faulty);
    }
    let formatted = syntax::format(&parse);
    if !syntax::differ_in_layout_only(&parse, &grammar(file, &formatted)) {
        let name = sources.file(file).name.clone();
        let message =
            format!("{name} stays as it is: formatting would change its meaning, which is a bug of groundstate");
        shell.report_failure(&Failure::usage(message));
        return Ok(Layout::Refused);
    }
    Ok(laid_out(&text, formatted))
}

/// A coupling, which has a layout of its own.
fn coupling(shell: &mut Shell, source: SourceFile) -> Result<Layout, Failure> {
    let text = source.text.clone();
    let mut sources = Sources::default();
    let file = sources.add(source);
    match groundstate::refine::format(file, &text) {
        Ok(formatted) => Ok(laid_out(&text, formatted)),
        Err(fault) => {
            shell.diagnostic(&sources, &fault)?;
            Ok(Layout::Faulty)
        }
    }
}

fn laid_out(text: &str, formatted: String) -> Layout {
    let formatted = if text.contains("\r\n") { with_carriage_returns(&formatted) } else { formatted };
    if *formatted == *text { Layout::Kept } else { Layout::Changed(formatted) }
}

/// The grammar of a file: a scenario begins with that word; otherwise the file's name decides.
fn grammar(source: &SourceFile) -> fn(FileId, &str) -> Parse {
    let named = source.name.ends_with(".avalla");
    if source.name.ends_with(".chart") {
        syntax::parse_chart
    } else if named || (!source.name.ends_with(".asm") && is_scenario(&source.text)) {
        syntax::parse_avalla
    } else {
        syntax::parse_asmetal
    }
}

fn is_scenario(text: &str) -> bool {
    let errors = |parse: Parse| parse.diagnostics.iter().filter(|fault| fault.severity == Severity::Error).count();
    errors(syntax::parse_avalla(FileId(0), text)) < errors(syntax::parse_asmetal(FileId(0), text))
}

fn with_carriage_returns(text: &str) -> String {
    text.replace("\r\n", "\n").replace('\n', "\r\n")
}
