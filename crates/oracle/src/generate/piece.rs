//! A generated text as a tree of pieces, each of a sort; the reducer cuts at these pieces.
//!
//! INVARIANT: a piece may stand wherever another of its sort does, as far as the grammar is concerned. So a text can be
//! made smaller without knowing the language: a piece is replaced by a part of itself, or by the least text of its
//! sort.

use std::fmt;

use super::signature::Type;

/// Which pieces may replace each other.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Sort {
    /// Nothing else: the whole text, a binder.
    Fixed,
    /// Something that may be left out: a declaration, an element of a list.
    Item,
    /// A rule.
    Rule,
    /// A term of a type.
    Term(Type),
}

/// A piece of text.
#[derive(Debug, Clone)]
pub struct Piece {
    /// What may stand in its place.
    pub sort: Sort,
    parts: Vec<Part>,
}

#[derive(Debug, Clone)]
enum Part {
    Text(String),
    Piece(Piece),
}

impl fmt::Display for Piece {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.parts.iter().try_for_each(|part| match part {
            Part::Text(text) => f.write_str(text),
            Part::Piece(piece) => piece.fmt(f),
        })
    }
}

/// Where a piece is in its tree: the number of the part at each level.
pub type Path = Vec<usize>;

impl Piece {
    /// The template with a child in the place of each `§`.
    pub fn new(sort: Sort, template: &str, children: Vec<Piece>) -> Piece {
        let mut parts = Vec::new();
        let mut children = children.into_iter();
        for (index, text) in template.split('§').enumerate() {
            if index > 0 {
                parts.push(Part::Piece(children.next().expect("a child for each place")));
            }
            parts.push(Part::Text(text.to_string()));
        }
        assert!(children.next().is_none(), "a place for each child: {template}");
        Piece { sort, parts }
    }

    /// Pieces one after the other.
    pub fn list(sort: Sort, between: &str, children: Vec<Piece>) -> Piece {
        let template = vec!["§"; children.len()].join(between);
        Piece::new(sort, &template, children)
    }

    /// Text without parts.
    pub fn text(sort: Sort, text: impl Into<String>) -> Piece {
        Piece { sort, parts: vec![Part::Text(text.into())] }
    }

    /// The paths of all pieces below, from the top.
    pub fn paths(&self) -> Vec<Path> {
        let mut paths = Vec::new();
        for (index, part) in self.parts.iter().enumerate() {
            if let Part::Piece(piece) = part {
                paths.push(vec![index]);
                paths.extend(piece.paths().into_iter().map(|path| [vec![index], path].concat()));
            }
        }
        paths
    }

    /// The piece at a path.
    pub fn at(&self, path: &[usize]) -> &Piece {
        match path.split_first() {
            None => self,
            Some((index, rest)) => match &self.parts[*index] {
                Part::Piece(piece) => piece.at(rest),
                Part::Text(_) => panic!("a path leads to pieces"),
            },
        }
    }

    /// The same with another piece at a path.
    pub fn with(&self, path: &[usize], new: Piece) -> Piece {
        let Some((index, rest)) = path.split_first() else { return new };
        let mut changed = self.clone();
        if let Part::Piece(piece) = &mut changed.parts[*index] {
            *piece = piece.with(rest, new);
        }
        changed
    }

    /// The smaller pieces that may stand in its place, the smallest first.
    pub fn smaller(&self) -> Vec<Piece> {
        let least = match &self.sort {
            Sort::Fixed => None,
            Sort::Item => Some(String::new()),
            Sort::Rule => Some("skip".to_string()),
            Sort::Term(kind) => kind.least(),
        };
        let text = self.to_string();
        let least = least.filter(|least| least.len() < text.len()).map(|least| Piece::text(self.sort.clone(), least));
        let inner =
            self.paths().into_iter().map(|path| self.at(&path)).filter(|piece| piece.sort == self.sort).cloned();
        let mut inner: Vec<Piece> = inner.collect();
        inner.sort_by_key(|piece| piece.to_string().len());
        inner.dedup_by_key(|piece| piece.to_string());
        least.into_iter().chain(inner).collect()
    }
}
