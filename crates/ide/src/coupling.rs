//! The names in a coupling file (spec/refine.md), which are those of two models.
//!
//! In: the text, an offset, both models as far as the file names them. Out: what stands at the offset, and what it means. A text with faults is
//! as good as a sound one: what stands before the place decides. Models that are named on the command line alone are not known here.

use std::sync::Arc;

use groundstate::refine::{ABSTRACT, CONCRETE, SIDES};
use groundstate::workspace::Files;
use model::{DomainKind, Referent};

use crate::analysis::{Analysis, Symbol};
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

/// A walk through a text that knows where statements, strings and comments begin.
struct Walk<'t> {
    text: &'t str,
    at: usize,
    /// Where the statement begins.
    start: usize,
    quoted: bool,
}

impl<'t> Walk<'t> {
    fn new(text: &'t str) -> Walk<'t> {
        Walk { text, at: 0, start: 0, quoted: false }
    }

    /// Goes past a character or a comment; none where the comment has no end.
    fn go(&mut self) -> Option<()> {
        let rest = &self.text[self.at..];
        let next = rest.chars().next()?;
        let blank = |walk: &Walk<'t>| walk.text[walk.start..walk.at].trim().is_empty();
        if self.quoted {
            self.quoted = next != '"';
        } else if rest.starts_with("//") {
            let begins = blank(self);
            self.at += rest.find('\n')?;
            self.start = if begins { self.at } else { self.start };
            return Some(());
        } else if rest.starts_with("/*") {
            let begins = blank(self);
            self.at += rest.find("*/")? + 2;
            self.start = if begins { self.at } else { self.start };
            return Some(());
        } else {
            self.quoted = next == '"';
            self.start = if next == ';' { self.at + 1 } else { self.start };
        }
        self.at += next.len_utf8();
        Some(())
    }
}

/// The place at an offset; none in a comment.
pub(crate) fn place(text: &str, offset: u32) -> Option<Place<'_>> {
    let before = text.get(..offset as usize)?;
    let mut walk = Walk::new(before);
    while walk.at < before.len() {
        walk.go()?;
    }
    let Walk { start, quoted, .. } = walk;
    let behind = text[offset as usize..].find(|c: char| !is_word(c)).unwrap_or(text.len() - offset as usize);
    let word = before.len() - before.trim_end_matches(is_word).len();
    let quote = before.rfind('"').map_or(before.len(), |quote| quote + 1);
    let from = if quoted { quote } else { before.len() - word };
    Some(Place { statement: before[start..].trim_start(), range: (from as u32, offset + behind as u32), quoted })
}

/// The places of a word, but for the first words of statements, with what of the statement stands before them.
fn places_of<'t>(text: &'t str, word: &str) -> Vec<(&'t str, u32)> {
    let mut walk = Walk::new(text);
    let mut found = Vec::new();
    for (at, _) in text.match_indices(word) {
        while walk.at < at {
            if walk.go().is_none() {
                return found;
            }
        }
        let whole = !text[..at].ends_with(|c| is_word(c) || c == '$') && !text[at + word.len()..].starts_with(is_word);
        // Beyond the place, the walk has gone past a comment.
        if walk.at == at && whole && !walk.quoted {
            let before = text[walk.start..at].trim_start();
            found.extend((!before.is_empty()).then_some((before, at as u32)));
        }
    }
    found
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
    /// Several where it means something of both machines, or overloads; none where it is not known.
    pub meant: Vec<(Arc<Analysis>, Referent)>,
}

impl Named {
    /// What it means, each once.
    pub fn symbols(&self) -> Vec<Symbol> {
        let mut symbols: Vec<Symbol> = self.meant.iter().map(|(model, referent)| model.symbol(*referent)).collect();
        symbols.sort();
        symbols.dedup();
        symbols
    }
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
    let meant = meant(&models(project, own), before, word);
    (!meant.is_empty()).then_some(Named { range: place.range, meant })
}

/// Each place of a word that may be a name.
pub(crate) fn all_named<F: Files>(project: &mut Project<F>, own: &Analysis, word: &str) -> Vec<Named> {
    let places = places_of(own.text(), word);
    if places.is_empty() {
        return Vec::new();
    }
    let models = models(project, own);
    let named =
        |(before, at): (&str, u32)| Named { range: (at, at + word.len() as u32), meant: meant(&models, before, word) };
    places.into_iter().map(named).collect()
}

/// What a word means behind the part of a statement that stands before it.
fn meant(models: &[Option<Arc<Analysis>>; 2], before: &str, word: &str) -> Vec<(Arc<Analysis>, Referent)> {
    let of = |sides: &[usize], in_common: bool| -> Vec<(Arc<Analysis>, Referent)> {
        let known = sides.iter().filter_map(|side| models[*side].clone());
        known.flat_map(|model| meanings(&model, word, in_common)).collect()
    };
    match (side_before(before), before.split_whitespace().next()) {
        (Some(side), _) => of(&[side], false),
        (None, Some("same")) => of(&[ABSTRACT, CONCRETE], false),
        // A literal, a domain or a function of a library is alike in both, or belongs to one.
        (None, _) => of(&[CONCRETE, ABSTRACT], true),
    }
}

/// The literals that a word is in a model.
pub(crate) fn literals(model: &Analysis, word: &str) -> Vec<Referent> {
    let named = model.model.names.all_literals().filter(|(name, _)| *name == word);
    let literals = named.filter_map(|(name, domain)| match model.model.domains.kind(domain) {
        DomainKind::Enum { literals } => {
            let place = literals.iter().position(|literal| literal == name)?;
            Some(Referent::Literal(domain, place as u32))
        }
        _ => None,
    });
    literals.collect()
}

/// What a word means in a model: a function of it, or what both models may have in common.
fn meanings(model: &Arc<Analysis>, word: &str, in_common: bool) -> Vec<(Arc<Analysis>, Referent)> {
    let names = &model.model.names;
    let functions =
        names.all_functions().filter(|(name, id)| *name == word && model.model.function(*id).library == in_common);
    let mut found: Vec<Referent> = functions.map(|(_, id)| Referent::Function(id)).collect();
    if in_common {
        found.extend(names.all_domains().filter(|(name, _)| *name == word).map(|(_, id)| Referent::Domain(id)));
        found.extend(literals(model, word));
    }
    found.into_iter().map(|referent| (Arc::clone(model), referent)).collect()
}
