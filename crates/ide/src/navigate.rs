//! From a name to what it means, and back to all places that name it.
//!
//! In: a project, a file and an offset. Out: places. Each file is asked about itself alone, so a place is found once. Only files
//! in which the name is written are looked at.

use std::path::Path;
use std::sync::Arc;

use groundstate::Kind;
use groundstate::workspace::Files;
use model::{Referent, Use};
use syntax::ast::{self, AstNode};
use syntax::{Span, SyntaxKind, SyntaxToken};

use crate::analysis::{Analysis, Place, Role, Symbol};
use crate::coupling;
use crate::project::Project;

/// A place that names something, and what is done there.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Reference {
    /// Where.
    pub place: Place,
    /// What is done.
    pub role: Role,
}

/// Where what is named at an offset is declared; for a path in an import, and for the machine of an elaboration, the beginning of the file.
pub fn definition<F: Files>(project: &mut Project<F>, path: &str, offset: u32) -> Vec<Place> {
    let Ok(analysis) = project.analysis(path) else { return Vec::new() };
    if Kind::of(Path::new(path)) == Some(Kind::Coupling) {
        return in_coupling(project, &analysis, offset);
    }
    if let Some((_, target)) = path_at(project, &analysis, offset) {
        return vec![Place { path: target, range: (0, 0) }];
    }
    if let Some(place) = block_at(project, &analysis, offset).or_else(|| drawn_at(&analysis, offset)) {
        return vec![place];
    }
    let names = analysis.names_at(offset).iter();
    let places = names.filter_map(|name| analysis.declaration(name.referent)).map(|span| analysis.place(span));
    // What is asked of a system may have its names from a model that was not built yet.
    let mut there = |place: &Place| project.text(&place.path).is_ok();
    places.collect::<Vec<_>>().into_iter().filter(|place| there(place)).collect()
}

/// The same of a coupling: of what both machines have, both places.
fn in_coupling<F: Files>(project: &mut Project<F>, analysis: &Analysis, offset: u32) -> Vec<Place> {
    let paths = coupling::paths(analysis.text()).into_iter();
    let path = paths.filter(|(_, (start, end), _)| (*start..=*end).contains(&offset)).find_map(|(.., path)| {
        let target = project.target(analysis.source(), &path)?;
        Some(Place { path: target, range: (0, 0) })
    });
    if let Some(place) = path {
        return vec![place];
    }
    let named = coupling::named(project, analysis, offset);
    let places = named.into_iter().flat_map(|named| named.meant).filter_map(|(model, referent)| {
        let span = model.declaration(referent)?;
        Some(model.place(span))
    });
    let mut places: Vec<Place> = places.collect();
    places.dedup();
    places
}

/// Where what is named at an offset gets its meaning: the definition of a function, the body of a rule, the initial value.
pub fn implementations<F: Files>(project: &mut Project<F>, path: &str, offset: u32) -> Vec<Place> {
    let found = references(project, path, offset);
    let defines = found.iter().filter(|reference| reference.role == Role::Definition);
    let defined: Vec<Place> = defines.map(|reference| reference.place.clone()).collect();
    if defined.is_empty() { definition(project, path, offset) } else { defined }
}

/// All places that name what is named at an offset, in order.
pub fn references<F: Files>(project: &mut Project<F>, path: &str, offset: u32) -> Vec<Reference> {
    let Some(Asked { meant, symbols, written }) = asked(project, path, offset) else { return Vec::new() };
    let mut files: Vec<String> =
        meant.iter().flat_map(|(analysis, referent)| places_to_look(project, analysis, *referent)).collect();
    files.sort();
    files.dedup();
    let mut found = Vec::new();
    for file in files {
        found.extend(references_in(project, &file, &symbols, &written));
    }
    found.sort();
    found.dedup();
    found
}

/// A name that is asked about: what it means, by whom it is known, and how it is written.
struct Asked {
    meant: Vec<(Arc<Analysis>, Referent)>,
    symbols: Vec<Symbol>,
    written: String,
}

fn asked<F: Files>(project: &mut Project<F>, path: &str, offset: u32) -> Option<Asked> {
    let analysis = project.analysis(path).ok()?;
    if Kind::of(Path::new(path)) == Some(Kind::Coupling) {
        let named = coupling::named(project, &analysis, offset)?;
        let written = analysis.text()[named.range.0 as usize..named.range.1 as usize].to_string();
        return Some(Asked { symbols: named.symbols(), meant: named.meant, written });
    }
    let names = analysis.names_at(offset);
    let first = names.first()?;
    let written = analysis.text()[first.span.range()].to_string();
    let symbols = symbols(&analysis, names);
    Some(Asked { meant: vec![(Arc::clone(&analysis), first.referent)], symbols, written })
}

/// The places of one file that name one of the symbols.
pub(crate) fn references_in<F: Files>(
    project: &mut Project<F>,
    file: &str,
    symbols: &[Symbol],
    written: &str,
) -> Vec<Reference> {
    let Ok(source) = project.text(file) else { return Vec::new() };
    if !source.text.contains(written) {
        return Vec::new();
    }
    let Ok(analysis) = project.analysis(file) else { return Vec::new() };
    if Kind::of(Path::new(file)) == Some(Kind::Coupling) {
        let mut named = coupling::all_named(project, &analysis, written);
        named.retain(|named| named.symbols().iter().any(|symbol| symbols.contains(symbol)));
        let place = |range| Place { path: file.to_string(), range };
        return named.iter().map(|named| Reference { place: place(named.range), role: Role::Read }).collect();
    }
    // An operator is no place that names its function.
    let is_written = |name: &&Use| analysis.text()[name.span.range()] == *written;
    let named = analysis.names.iter().filter(is_written);
    let meant = named.filter(|name| symbols.contains(&analysis.symbol(name.referent)));
    meant.map(|name| Reference { place: analysis.place(name.span), role: analysis.role(name) }).collect()
}

/// LIMIT: so many other files are looked at for what they name.
pub(crate) const OTHERS: usize = 32;

/// What is known of the other files that write one of some words; and whether there are more of them.
pub(crate) fn others_that_write<F: Files>(
    project: &mut Project<F>,
    own: &Analysis,
    words: &[&str],
) -> (Vec<Arc<Analysis>>, bool) {
    let mut found = Vec::new();
    for file in project.all_files() {
        if file == own.source().name {
            continue;
        }
        let Ok(source) = project.text(&file) else { continue };
        if !words.iter().any(|word| source.text.contains(word)) {
            continue;
        }
        if found.len() == OTHERS {
            return (found, true);
        }
        found.extend(project.analysis(&file));
    }
    (found, false)
}

/// What names mean, each once.
pub(crate) fn symbols(analysis: &Analysis, names: &[Use]) -> Vec<Symbol> {
    let mut symbols: Vec<Symbol> = names.iter().map(|name| analysis.symbol(name.referent)).collect();
    symbols.sort();
    symbols.dedup();
    symbols
}

/// The files that can name something: for a variable its own and those that pick it, else all of the project.
pub(crate) fn places_to_look<F: Files>(
    project: &mut Project<F>,
    analysis: &Analysis,
    referent: Referent,
) -> Vec<String> {
    let mut files = project.all_files();
    files.extend([analysis.source().name.clone()]);
    if let Some(span) = analysis.declaration(referent) {
        files.push(analysis.sources.file(span.file).name.clone());
    }
    files.sort();
    files.dedup();
    files
}

/// The places of the file itself that name what is named at an offset.
pub fn highlights<F: Files>(project: &mut Project<F>, path: &str, offset: u32) -> Vec<Reference> {
    let Some(Asked { symbols, written, .. }) = asked(project, path, offset) else { return Vec::new() };
    references_in(project, path, &symbols, &written)
}

/// A path that is written in a file, and the file that it leads to.
pub fn links<F: Files>(project: &mut Project<F>, path: &str) -> Vec<(Place, String)> {
    let Ok(analysis) = project.analysis(path) else { return Vec::new() };
    let mut found = Vec::new();
    if Kind::of(Path::new(path)) == Some(Kind::Coupling) {
        for (_, range, written) in coupling::paths(analysis.text()) {
            let target = project.target(analysis.source(), &written);
            found.extend(target.map(|target| (Place { path: path.to_string(), range }, target)));
        }
    }
    for (token, written) in paths(&analysis) {
        if let Some(target) = project.target(analysis.source(), &written) {
            found.push((analysis.place(Span::new(analysis.file, token.text_range())), target));
        }
    }
    found
}

/// The words that lead to files, and the paths of these.
fn paths(analysis: &Analysis) -> Vec<(SyntaxToken, String)> {
    let Some(tree) = analysis.tree() else { return Vec::new() };
    let scenario = ast::ScenarioFile::cast(tree.clone()).and_then(|file| file.model_token());
    let imports = tree.children().filter_map(ast::Import::cast).filter_map(|import| import.path_token());
    let mut paths: Vec<(SyntaxToken, String)> = scenario
        .into_iter()
        .chain(imports)
        .map(|token| (token.clone(), token.text().trim_matches('"').to_string()))
        .collect();
    // The machine of an elaboration is imported, or lies beside the chart.
    let imported: Vec<String> = paths.iter().map(|(_, path)| path.clone()).collect();
    for machine in tree.descendants().filter_map(ast::Phase::cast).filter_map(|phase| phase.machine()) {
        let import = imported.iter().find(|import| stem(import) == machine.text());
        paths.push((machine.clone(), import.cloned().unwrap_or_else(|| machine.text().to_string())));
    }
    paths
}

/// The last part of a path, without its ending.
pub(crate) fn stem(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path).trim_end_matches(".asm")
}

fn path_at<F: Files>(project: &mut Project<F>, analysis: &Analysis, offset: u32) -> Option<(SyntaxToken, String)> {
    let (token, written) = paths(analysis).into_iter().find(|(token, _)| covers(token, offset))?;
    let target = project.target(analysis.source(), &written)?;
    Some((token, target))
}

fn covers(token: &SyntaxToken, offset: u32) -> bool {
    let range = token.text_range();
    u32::from(range.start()) <= offset && offset <= u32::from(range.end())
}

/// The machine of the same chart by which the shape at an offset is to be refined.
fn drawn_at(analysis: &Analysis, offset: u32) -> Option<Place> {
    let chart = ast::ChartFile::cast(analysis.tree()?)?;
    let named = chart.syntax().descendants().filter_map(ast::Refinement::cast).filter_map(|node| node.by());
    let named = named.into_iter().find(|name| covers(name, offset))?;
    let drawn = chart.machines().filter_map(|machine| machine.name()).find(|name| name.text() == named.text())?;
    Some(analysis.place(Span::new(analysis.file, drawn.text_range())))
}

/// The block of a scenario that is called at an offset.
fn block_at<F: Files>(project: &mut Project<F>, analysis: &Analysis, offset: u32) -> Option<Place> {
    let token = analysis.token_at(offset).filter(|token| token.kind() == SyntaxKind::GENERIC_ID)?;
    let call = token.parent().and_then(ast::ExecBlockCommand::cast)?;
    let name = call.block()?;
    let file = match call.file() {
        Some(file) => project.target(analysis.source(), &format!("{}.avalla", file.text()))?,
        None => analysis.source().name.clone(),
    };
    let other = project.analysis(&file).ok()?;
    let blocks = other.tree()?.descendants().filter_map(ast::Block::cast).collect::<Vec<_>>();
    let found = blocks.iter().filter_map(|block| block.name()).find(|found| found.text() == name.text())?;
    Some(other.place(Span::new(other.file, found.text_range())))
}
