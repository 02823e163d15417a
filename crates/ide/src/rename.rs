//! A name replaced by another wherever it means the same thing.
//!
//! In: a project, a file, an offset and the new name. Out: edits of all files that name it, or why not. INVARIANT: after the edits
//! every name of every file that was looked at means what it meant before: the edits are made to a copy of the project, and all
//! names are looked up again. A file that writes the name and cannot be understood there refuses the whole.

mod coupled;

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use groundstate::Kind;
use groundstate::workspace::Files;
use model::Referent;

use syntax::{FileId, Severity, SyntaxKind, SyntaxNode};

use crate::analysis::{Analysis, Place, Symbol, is_word};
use crate::coupling;
use crate::navigate::{places_to_look, symbols};
use crate::position::{Edit, edited};
use crate::project::{Overlaid, Project, library_text};

/// Edits by the file's path.
pub type Edits = BTreeMap<String, Vec<Edit>>;

/// What can be renamed at an offset: the place of the name.
///
/// # Errors
/// Why nothing can, as a sentence.
pub fn prepare<F: Files>(project: &mut Project<F>, path: &str, offset: u32) -> Result<Place, String> {
    Ok(target(project, path, offset)?.place)
}

/// Renames what is named at an offset.
///
/// # Errors
/// Why it cannot be done, as a sentence.
pub fn rename<F: Files>(project: &mut Project<F>, path: &str, offset: u32, to: &str) -> Result<Edits, String> {
    let Target { known: (analysis, referent), written: from, symbol, .. } = target(project, path, offset)?;
    has_the_shape(referent, &from, to)?;
    if from == to {
        return Ok(Edits::new());
    }
    let mut edits = Edits::new();
    let mut looked_at = Vec::new();
    for file in places_to_look(project, &analysis, referent) {
        let Ok(source) = project.text(&file) else { continue };
        match Kind::of(Path::new(&file)) {
            Some(Kind::Chart) => no_shape_stands_for(project, &file, &from, &symbol)?,
            Some(Kind::Coupling) => coupled::no_literal_is_of_both(project, &file, referent, &from, &symbol)?,
            _ => {}
        }
        if !names_word(&source.text, &from) {
            // It may still see the new name, and then mean something else by it.
            if names_word(&source.text, to) && Kind::of(Path::new(&file)).is_some() {
                looked_at.push(file);
            }
            continue;
        }
        if Kind::of(Path::new(&file)).is_none() {
            continue;
        }
        let found = match Kind::of(Path::new(&file)) {
            Some(Kind::Coupling) if matches!(referent, Referent::Variable(..)) => continue,
            Some(Kind::Coupling) => coupled::edits(project, &file, &from, to, &symbol)?,
            _ => in_file(project, &file, &from, to, &symbol)?,
        };
        if !found.is_empty() {
            edits.insert(file.clone(), found);
        }
        looked_at.push(file);
    }
    proved(project, &looked_at, &edits, &from, to)?;
    Ok(edits)
}

/// A name that is to change.
struct Target {
    place: Place,
    written: String,
    /// What it means, and a file that knows it.
    known: (Arc<Analysis>, Referent),
    symbol: Symbol,
}

/// The name at an offset, and the one thing that it means.
fn target<F: Files>(project: &mut Project<F>, path: &str, offset: u32) -> Result<Target, String> {
    let analysis = project.analysis(path).map_err(|absent| absent.told(path))?;
    let unknown = || "there is no name that is known here".to_string();
    let (place, known, symbols) = if Kind::of(Path::new(path)) == Some(Kind::Coupling) {
        let named = coupling::named(project, &analysis, offset).ok_or_else(unknown)?;
        let symbols = named.symbols();
        let known = named.meant.into_iter().next().ok_or_else(unknown)?;
        (Place { path: path.to_string(), range: named.range }, known, symbols)
    } else {
        let names = analysis.names_at(offset);
        let first = names.first().ok_or_else(unknown)?;
        (analysis.place(first.span), (Arc::clone(&analysis), first.referent), symbols(&analysis, names))
    };
    let [symbol] = symbols.try_into().map_err(|_| {
        "this name stands for several functions or rules: rename one where it is declared or used".to_string()
    })?;
    match &symbol {
        Symbol::BuiltIn(_) => return Err("what is built in has one name for all".to_string()),
        Symbol::At(file, _) if library_text(file).is_some() => {
            return Err(format!("it is declared in {file}, which is built in"));
        }
        Symbol::At(..) => {}
    }
    let written = analysis.text()[place.range.0 as usize..place.range.1 as usize].to_string();
    if !written.starts_with(|c: char| c.is_ascii_alphabetic() || c == '$') {
        return Err("an operator has one name for all".to_string());
    }
    Ok(Target { place, written, known, symbol })
}

/// A name says by its shape what it names.
fn has_the_shape(referent: Referent, from: &str, to: &str) -> Result<(), String> {
    let kind_of = |text: &str| {
        let tree = syntax::parse_term(FileId(0), text).syntax();
        let mut tokens = tree.descendants_with_tokens().filter_map(|element| element.into_token());
        tokens.next().filter(|token| token.text() == text).map(|token| token.kind())
    };
    let (old, new) = (kind_of(from), kind_of(to));
    let same = match referent {
        Referent::Domain(_) => new == Some(SyntaxKind::DOMAIN_ID),
        _ => new.is_some() && old == new,
    };
    if same {
        return Ok(());
    }
    let shape = match referent {
        Referent::Variable(..) => "a variable is `$` and then a letter or `_`, letters, digits and `_`",
        Referent::Rule(_) => "a rule's name begins with `r_`",
        Referent::Literal(..) => "an enum literal begins with two capitals and has only capitals, digits and `_`",
        Referent::Domain(_) => "a domain's name begins with a capital and has a small letter",
        Referent::Function(_) => "a function's name begins with a small letter, and is no keyword",
    };
    Err(format!("`{to}` cannot take the place of `{from}`: {shape}"))
}

/// Whether a text has a word in it.
fn names_word(text: &str, word: &str) -> bool {
    let part_of_word = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_');
    text.match_indices(word).any(|(at, _)| {
        let before = text[..at].chars().next_back();
        let after = text[at + word.len()..].chars().next();
        let begins = word.starts_with('$') || !(part_of_word(before) || before == Some('$'));
        begins && !part_of_word(after)
    })
}

/// The edits of one file.
fn in_file<F: Files>(
    project: &mut Project<F>,
    file: &str,
    from: &str,
    to: &str,
    symbol: &Symbol,
) -> Result<Vec<Edit>, String> {
    let analysis = project.analysis(file).map_err(|absent| absent.told(file))?;
    let Some(tree) = analysis.tree() else {
        // A specification: what of it is text for people is not known to be a name.
        let named = analysis.names.iter().filter(|name| analysis.text()[name.span.range()] == *from);
        let mut meant: Vec<model::Use> =
            named.filter(|name| analysis.symbol(name.referent) == *symbol).copied().collect();
        meant.dedup_by_key(|name| name.span);
        return Ok(meant.iter().map(|name| Edit::new(name.span.start..name.span.end, to)).collect());
    };
    let broken = analysis.parse().is_some_and(|parse| parse.diagnostics.iter().any(|f| f.severity == Severity::Error));
    if broken {
        return Err(format!("{file} writes `{from}`, and it cannot be read as it is: mend it first"));
    }
    let mut edits = Vec::new();
    let tokens = tree.descendants_with_tokens().filter_map(|element| element.into_token());
    for token in tokens.filter(|token| token.text() == from && is_word(token)) {
        if is_label(token.kind()) {
            continue;
        }
        let at = u32::from(token.text_range().start());
        let meant = symbols(&analysis, analysis.names_at(at));
        match meant.as_slice() {
            [] => {
                let line = analysis.source().line_column(at).line;
                return Err(format!("{file}:{line} writes `{from}`, and what it means there is not known"));
            }
            [one] if one == symbol => edits.push(Edit::new(at..at + from.len() as u32, to)),
            several if several.contains(symbol) => {
                let line = analysis.source().line_column(at).line;
                return Err(format!("{file}:{line} names several things by `{from}` at once"));
            }
            _ => {}
        }
    }
    Ok(edits)
}

/// A shape of a chart that has no link stands for the part of the model that has its name, in the spelling of that part: the
/// action `count` for the rule `r_count`, the state `off` for the literal `OFF`. That name is no word of the chart.
fn no_shape_stands_for<F: Files>(
    project: &mut Project<F>,
    file: &str,
    from: &str,
    symbol: &Symbol,
) -> Result<(), String> {
    let analysis = project.analysis(file).map_err(|absent| absent.told(file))?;
    let Symbol::At(declared, _) = symbol else { return Ok(()) };
    if !analysis.sources.iter().any(|(_, source)| source.name == *declared) {
        return Ok(());
    }
    let spelled = |name: &str| name.strip_prefix("r_").unwrap_or(name).replace('_', "").to_lowercase();
    let Some(tree) = analysis.tree() else { return Ok(()) };
    let tokens = tree.descendants_with_tokens().filter_map(|element| element.into_token());
    for token in tokens.filter(|token| token.kind() == SyntaxKind::GENERIC_ID && spelled(token.text()) == spelled(from))
    {
        let linked = |node: SyntaxNode| node.children().any(|child| child.kind() == SyntaxKind::LINK);
        let in_path = |node: &SyntaxNode| matches!(node.kind(), SyntaxKind::PATH_STOP | SyntaxKind::PLACEMENT);
        if token.parent().is_some_and(|node| !in_path(&node) && !linked(node)) {
            let line = analysis.source().line_column(token.text_range().start().into()).line;
            let shape = token.text();
            return Err(format!(
                "{file}:{line}: `{shape}` has no link, and may stand for `{from}` by its name: give it one first"
            ));
        }
    }
    Ok(())
}

/// Names of other kinds: of files, machines, shapes, blocks.
fn is_label(kind: SyntaxKind) -> bool {
    matches!(kind, SyntaxKind::GENERIC_ID | SyntaxKind::MODULE_REF | SyntaxKind::STRING)
}

/// Makes the edits to a copy, and finds that every name means what it meant.
fn proved<F: Files>(
    project: &mut Project<F>,
    files: &[String],
    edits: &Edits,
    from: &str,
    to: &str,
) -> Result<(), String> {
    let coupled = coupled_over(project, edits);
    let said: Vec<_> = coupled.iter().map(|file| coupled::says(project, file, from, to)).collect();
    let built = built_over(project, edits);
    let mut faults = BTreeMap::new();
    for file in built {
        let count = project.findings(&file).map_err(|absent| absent.told(&file))?.diagnostics().count();
        faults.insert(file, count);
    }
    let mut before = BTreeMap::new();
    for file in files {
        let analysis = project.analysis(file).map_err(|absent| absent.told(file))?;
        before.insert(file.clone(), meanings(&analysis, edits));
    }
    let mut texts = BTreeMap::new();
    for (file, edits) in edits {
        let source = project.text(file).map_err(|absent| absent.told(file))?;
        texts.insert(file.clone(), edited(&source.text, edits));
    }
    let mut after = Project::new(Overlaid { project });
    for (file, text) in texts {
        _ = after.set_text(&file, 0, text);
    }
    for (file, before) in faults {
        let count = after.findings(&file).map_err(|absent| absent.told(&file))?.diagnostics().count();
        if count > before {
            return Err(match Kind::of(Path::new(&file)) {
                Some(Kind::Chart) => {
                    format!("{file} relies on the name `{from}`: what is built of it would have faults")
                }
                _ => format!("{file} relies on the name `{from}`, and would have faults: rename by hand"),
            });
        }
    }
    for (file, before) in coupled.into_iter().zip(said) {
        if before.is_some() && coupled::says(&mut after, &file, from, to) != before {
            return Err(format!("{file} compares two machines, and relies on the name `{from}` there: rename by hand"));
        }
    }
    for (file, before) in before {
        let analysis = after.analysis(&file).map_err(|absent| absent.told(&file))?;
        if meanings(&analysis, &Edits::new()) != before {
            return Err(format!("`{to}` has a meaning already that `{from}` would clash with in {file}"));
        }
    }
    Ok(())
}

/// The couplings of models that read a file that is edited.
fn coupled_over<F: Files>(project: &mut Project<F>, edits: &Edits) -> Vec<String> {
    let mut files = project.all_files();
    files.retain(|file| Kind::of(Path::new(file)) == Some(Kind::Coupling));
    files.retain(|file| {
        let Ok(own) = project.analysis(file) else { return false };
        let models = coupling::models(project, &own).into_iter().flatten();
        edits.contains_key(file)
            || models
                .flat_map(|model| model.sources.iter().map(|(_, source)| source.name.clone()).collect::<Vec<_>>())
                .any(|name| edits.contains_key(&name))
    });
    files
}

/// The charts and specifications whose models read a file that is edited, and those beside it: it may be the machine of a component. What is
/// built of a chart names what its imports declare, a machine's functions have the names of channels, properties of a system put the names of
/// components and functions together, as a pattern of a report does. So they may rely on a name that they do not write.
fn built_over<F: Files>(project: &mut Project<F>, edits: &Edits) -> Vec<String> {
    let mut built = project.all_files();
    built.retain(|file| matches!(Kind::of(Path::new(file)), Some(Kind::Chart | Kind::Report | Kind::Verification)));
    let folder = |file: &str| Path::new(file).parent().map(Path::to_path_buf);
    let edited: Vec<_> = edits.keys().map(|file| folder(file)).collect();
    built.retain(|file| {
        let is_beside = edited.contains(&folder(file));
        let sources = project.analysis(file).map(|analysis| analysis.sources.clone()).unwrap_or_default();
        is_beside || sources.iter().any(|(_, source)| edits.contains_key(&source.name))
    });
    built
}

/// Where the names of a file stand, and what they mean, as they would after edits; and how many faults there are.
fn meanings(analysis: &Analysis, edits: &Edits) -> (Vec<(u32, Symbol)>, usize) {
    let shifted = |file: &str, at: u32| {
        let before = edits.get(file).into_iter().flatten().filter(|edit| edit.range.0 < at);
        before.fold(i64::from(at), |at, edit| at + edit.text.len() as i64 - i64::from(edit.range.1 - edit.range.0))
            as u32
    };
    let own = analysis.source().name.as_str();
    let meaning = |name: &model::Use| {
        let symbol = match analysis.symbol(name.referent) {
            Symbol::At(file, at) => {
                let at = shifted(&file, at);
                Symbol::At(file, at)
            }
            built_in => built_in,
        };
        (shifted(own, name.span.start), symbol)
    };
    let faults = analysis.findings.diagnostics().filter(|fault| fault.severity == Severity::Error).count();
    (analysis.names.iter().map(meaning).collect(), faults)
}
