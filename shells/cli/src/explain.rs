//! `groundstate explain ID`: the page of a kind of fault, as in spec/faults/.

use std::io::Write;

use clap::Args;
use wire::Answer;

use crate::exit::Exit;
use crate::failure::Failure;
use crate::shell::Shell;

/// Arguments of `explain`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The name in brackets of a fault, such as inconsistent-update; without one, all names are listed
    id: Option<String>,
}

include!(concat!(env!("OUT_DIR"), "/fault_pages.rs"));

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let Some(id) = &arguments.id else {
        for (id, page) in PAGES {
            if shell.json() {
                shell.object(&Answer::Page { id, title: title(page), text: None })?;
            } else {
                writeln!(shell.out(), "{id:<28} {}", title(page))?;
            }
        }
        return Ok(Exit::Good);
    };
    let asked = id.trim_matches(['[', ']']);
    match PAGES.binary_search_by_key(&asked, |(id, _)| id) {
        Ok(index) => {
            let (id, page) = PAGES[index];
            if shell.json() {
                shell.object(&Answer::Page { id, title: title(page), text: Some(page) })?;
            } else {
                shell.out().write_all(page.as_bytes())?;
            }
            Ok(Exit::Good)
        }
        Err(_) => {
            let help = match close(asked) {
                Some(id) => format!("did you mean `{id}`? `groundstate explain` lists all"),
                None => "`groundstate explain` lists all".to_string(),
            };
            Err(Failure::usage_with_help(format!("there is no kind of fault called `{asked}`"), help))
        }
    }
}

/// The name that was probably meant: mistyped, or typed in part.
fn close(asked: &str) -> Option<&'static str> {
    let names = || PAGES.iter().map(|(id, _)| *id);
    let part = || names().find(|id| !asked.is_empty() && (id.contains(asked) || asked.contains(id)));
    model::nearest(asked, names()).or_else(part)
}

/// The first heading of a page that says more than its name, or else the first sentence.
fn title(page: &str) -> &str {
    let mut lines = page.lines().map(str::trim).filter(|line| !line.is_empty());
    let first = lines.next().unwrap_or_default();
    let text = if first.starts_with('#') { lines.next().unwrap_or_default() } else { first };
    let text = text.trim_start_matches('#').trim();
    text.split_inclusive(". ").next().unwrap_or(text).trim()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mistyped_name_is_guessed() {
        assert_eq!(close("inconsistant-update"), Some("inconsistent-update"));
        assert_eq!(close("no-main"), Some("no-main-rule"));
        assert_eq!((close("zebra"), close("")), (None, None));
    }
}
