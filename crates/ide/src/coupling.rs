//! The names in a coupling file (spec/refine.md), which are those of two models.
//!
//! In: the text, an offset, both models as far as the file names them. Out: what stands at the offset, and what it means. A text with faults is
//! as good as a sound one: what stands before the place decides. Models that are named on the command line alone are not known here.

use std::sync::Arc;

use groundstate::refine::{ABSTRACT, CONCRETE, SIDES};
use groundstate::workspace::Files;
use model::{DomainKind, Referent};

use crate::analysis::Analysis;
use crate::project::Project;

/// A place in a coupling.
pub(crate) struct Place<'t> {
    /// The statement up to the place, from its first word on.
    pub statement: &'t str,
    /// The word at the place.
    pub range: (u32, u32),
    /// It stands in a string.
    pub quoted: bool,
}

pub(crate) fn is_word(letter: char) -> bool {
    letter.is_alphanumeric() || letter == '_'
}

/// The place at an offset; none in a comment.
pub(crate) fn place(text: &str, offset: u32) -> Option<Place<'_>> {
    let before = text.get(..offset as usize)?;
    let (mut start, mut at, mut quoted) = (0, 0, false);
    while at < before.len() {
        let rest = &before[at..];
        let next = rest.chars().next()?;
        if quoted {
            quoted = next != '"';
        } else if rest.starts_with("//") {
            at += rest.find('\n')?;
            start = if before[start..at].trim_start().starts_with("//") { at } else { start };
            continue;
        } else if rest.starts_with("/*") {
            let end = rest.find("*/")? + 2;
            start = if before[start..at].trim().is_empty() { at + end } else { start };
            at += end;
            continue;
        } else {
            quoted = next == '"';
            start = if next == ';' { at + 1 } else { start };
        }
        at += next.len_utf8();
    }
    let behind = text[offset as usize..].find(|c: char| !is_word(c)).unwrap_or(text.len() - offset as usize);
    let word = before.len() - before.trim_end_matches(is_word).len();
    let quote = before.rfind('"').map_or(before.len(), |quote| quote + 1);
    let from = if quoted { quote } else { before.len() - word };
    Some(Place { statement: before[start..].trim_start(), range: (from as u32, offset + behind as u32), quoted })
}

/// The machine whose name and dot a text ends with.
pub(crate) fn side_before(text: &str) -> Option<usize> {
    SIDES.iter().position(|side| {
        let named = text.trim_end().strip_suffix('.').and_then(|rest| rest.strip_suffix(side));
        named.is_some_and(|rest| !rest.ends_with(is_word))
    })
}

/// Both models, as far as the file names them.
pub(crate) fn models<F: Files>(project: &mut Project<F>, own: &Analysis) -> [Option<Arc<Analysis>>; 2] {
    let named = paths(own.text());
    [ABSTRACT, CONCRETE].map(|side| {
        let (.., path) = named.iter().find(|(of, ..)| *of == side)?;
        let target = project.target(own.source(), path)?;
        project.analysis(&target).ok()
    })
}

/// The paths that the file names: the machine, where the path stands between its quotes, and the path.
pub(crate) fn paths(text: &str) -> Vec<(usize, (u32, u32), String)> {
    let mut found = Vec::new();
    for (side, word) in SIDES.iter().enumerate() {
        let named = text.match_indices(word).find_map(|(at, _)| {
            let before = text[..at].trim_end();
            let begins = before.is_empty() || before.ends_with([';', '/']) || text[..at].ends_with('\n');
            let behind = &text[at + word.len()..];
            let path = behind.trim_start().strip_prefix('"')?.split('"').next()?;
            let start = (text.len() - behind.trim_start().len() + 1) as u32;
            begins.then(|| (side, (start, start + path.len() as u32), path.to_string()))
        });
        found.extend(named);
    }
    found
}

/// A name, and what it means: the models that know it.
pub(crate) struct Named {
    pub range: (u32, u32),
    pub meant: Vec<(Arc<Analysis>, Referent)>,
}

/// What is named at an offset.
pub(crate) fn named<F: Files>(project: &mut Project<F>, own: &Analysis, offset: u32) -> Option<Named> {
    let text = own.text();
    let place = place(text, offset).filter(|place| !place.quoted)?;
    let (start, end) = place.range;
    let word = text.get(start as usize..end as usize).filter(|word| !word.is_empty())?;
    let before = &place.statement[..place.statement.len() - (offset - start) as usize];
    if before.trim().is_empty() {
        return None;
    }
    let models = models(project, own);
    let of = |sides: &[usize], library: bool| -> Vec<(Arc<Analysis>, Referent)> {
        let known = sides.iter().filter_map(|side| models[*side].clone());
        known.flat_map(|model| meanings(&model, word, library)).collect()
    };
    let meant = match (side_before(before), before.split_whitespace().next()) {
        (Some(side), _) => of(&[side], false),
        (None, Some("same")) => of(&[ABSTRACT, CONCRETE], false),
        // A literal, a domain or a function of a library is alike in both, or belongs to one.
        (None, _) => {
            let concrete = of(&[CONCRETE], true);
            if concrete.is_empty() { of(&[ABSTRACT], true) } else { concrete }
        }
    };
    (!meant.is_empty()).then_some(Named { range: place.range, meant })
}

/// What a word means in a model: a function of it, or what both models may have in common.
fn meanings(model: &Arc<Analysis>, word: &str, in_common: bool) -> Vec<(Arc<Analysis>, Referent)> {
    let names = &model.model.names;
    let functions =
        names.all_functions().filter(|(name, id)| *name == word && model.model.function(*id).library == in_common);
    let mut found: Vec<Referent> = functions.map(|(_, id)| Referent::Function(id)).collect();
    if in_common {
        found.extend(names.all_domains().filter(|(name, _)| *name == word).map(|(_, id)| Referent::Domain(id)));
        let literals = names.all_literals().filter(|(name, _)| *name == word);
        found.extend(literals.filter_map(|(name, domain)| match model.model.domains.kind(domain) {
            DomainKind::Enum { literals } => {
                let place = literals.iter().position(|literal| literal == name)?;
                Some(Referent::Literal(domain, place as u32))
            }
            _ => None,
        }));
    }
    found.into_iter().map(|referent| (Arc::clone(model), referent)).collect()
}
