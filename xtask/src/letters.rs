//! The letter cases of the C++ runtime, written anew as the standard library of this Rust has them.
//!
//! In: `char::to_uppercase`, `char::to_lowercase`, and how a final sigma is told. Out: the tables of
//! `letter_case_tables.hpp`; the rest of that file stays. To be called when Rust takes up a new version of Unicode.

use std::fmt::Write;
use std::fs;

use crate::{Failure, Outcome, repository};

const TABLES: &str = "cpp/include/groundstate/machine/letter_case_tables.hpp";
/// Columns of a line of C++.
const WIDTH: usize = 118;

/// Writes the tables.
pub fn run(words: &[String]) -> Result<Outcome, Failure> {
    if !words.is_empty() {
        return Err("it takes no arguments".into());
    }
    let path = repository::root().join(TABLES);
    let text = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let (Some(start), Some(end)) = (text.find("inline constexpr"), text.find("}  // namespace")) else {
        return Err(format!("{}: no tables are found to replace", path.display()));
    };
    let anew = format!("{}{}{}", &text[..start], tables(), &text[end..]);
    fs::write(&path, anew).map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(Outcome::Good)
}

fn tables() -> String {
    let mut out = String::new();
    let (upper, lower) = (mapping(|c| c.to_uppercase().collect()), mapping(|c| c.to_lowercase().collect()));
    for (name, (runs, _)) in [("to_upper_runs", &upper), ("to_lower_runs", &lower)] {
        let run = |r: &Run| format!("{{0x{:x}, 0x{:x}, {}, {}}}", r.first, r.last, r.step, r.distance);
        table(&mut out, "CaseRun", name, runs.iter().map(run));
    }
    for (name, (_, expansions)) in [("to_upper_expansions", &upper), ("to_lower_expansions", &lower)] {
        let letters = |to: &[char]| to.iter().map(|c| format!("0x{:x}", u32::from(*c))).collect::<Vec<_>>().join(", ");
        let expansion = |(from, to): &(char, Vec<char>)| format!("{{0x{:x}, {{{}}}}}", u32::from(*from), letters(to));
        table(&mut out, "CaseExpansion", name, expansions.iter().map(expansion));
    }
    // A sigma is final behind a cased letter, those that are ignored between them left out.
    let behind = |c: char| format!("{c}Σ").to_lowercase().ends_with('ς');
    let behind_a = |c: char| format!("A{c}Σ").to_lowercase().ends_with('ς');
    let range = |(first, last): (u32, u32)| format!("{{0x{first:x}, 0x{last:x}}}");
    table(&mut out, "ScalarRange", "cased", ranges(behind).into_iter().map(range));
    table(&mut out, "ScalarRange", "case_ignorable", ranges(|c| behind_a(c) && !behind(c)).into_iter().map(range));
    out
}

/// The letters `first`, `first + step` … `last`, as far from their other case each.
struct Run {
    first: u32,
    last: u32,
    step: u32,
    distance: i64,
}

fn scalars() -> impl Iterator<Item = char> {
    '\0'..=char::MAX
}

/// The letters with one letter as their other case, in runs, and those with several.
fn mapping(other_case: impl Fn(char) -> Vec<char>) -> (Vec<Run>, Vec<(char, Vec<char>)>) {
    let (mut runs, mut expansions): (Vec<Run>, _) = (Vec::new(), Vec::new());
    for letter in scalars() {
        let to = other_case(letter);
        let [other] = to[..] else {
            expansions.push((letter, to));
            continue;
        };
        if other == letter {
            continue;
        }
        let from = u32::from(letter);
        let distance = i64::from(u32::from(other)) - i64::from(from);
        match runs.last_mut() {
            Some(run)
                if run.distance == distance
                    && (from - run.last == run.step || (run.first == run.last && from - run.last == 2)) =>
            {
                run.step = from - run.last;
                run.last = from;
            }
            _ => runs.push(Run { first: from, last: from, step: 1, distance }),
        }
    }
    (runs, expansions)
}

/// The scalar values that have a property, as ranges.
fn ranges(has: impl Fn(char) -> bool) -> Vec<(u32, u32)> {
    let mut ranges: Vec<(u32, u32)> = Vec::new();
    for scalar in scalars().filter(|c| has(*c)).map(u32::from) {
        match ranges.last_mut() {
            Some(range) if range.1 + 1 == scalar => range.1 = scalar,
            _ => ranges.push((scalar, scalar)),
        }
    }
    ranges
}

fn table(out: &mut String, kind: &str, name: &str, items: impl Iterator<Item = String>) {
    let mut lines = vec![String::from("   ")];
    for item in items {
        if lines.last().is_some_and(|line| line.len() + item.len() + 2 > WIDTH) {
            lines.push(String::from("   "));
        }
        if let Some(line) = lines.last_mut() {
            let _ = write!(line, " {item},");
        }
    }
    let _ = write!(out, "inline constexpr {kind} {name}[] = {{\n{}\n}};\n\n", lines.join("\n"));
}
