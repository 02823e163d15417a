//! Source files, positions and spans.
//!
//! A [`Span`] names a file and a byte range in it; [`Sources`] owns the texts and turns a span into lines and
//! columns. INVARIANT: a span made by a stage lies on character boundaries of its file's text. Texts come in as
//! parameters; nothing here reads a disk.

use std::sync::Arc;

use crate::encoding::{Foreign, NotText, decode};
use crate::span::{FileId, Span};

/// A position for people: both count from 1; the column counts characters (Unicode scalar values).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct LineColumn {
    /// Line, from 1.
    pub line: u32,
    /// Column, from 1.
    pub column: u32,
}

/// One source text and the name it is shown under.
#[derive(Debug, Clone)]
pub struct SourceFile {
    /// The path as the user gave it, or as an import led to it; `<std>/StandardLibrary.asm` for a built-in one.
    pub name: String,
    /// The whole text.
    pub text: Arc<str>,
    /// What shows that its bytes were not UTF-8.
    pub foreign: Option<Foreign>,
    line_starts: Vec<u32>,
}

impl SourceFile {
    /// Indexes the lines of a text.
    pub fn new(name: impl Into<String>, text: impl Into<Arc<str>>) -> Self {
        let text = text.into();
        let line_starts = std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at as u32 + 1)).collect();
        SourceFile { name: name.into(), text, foreign: None, line_starts }
    }

    /// Takes the bytes of a file for text: UTF-8, or otherwise Windows-1252.
    ///
    /// # Errors
    /// They are not text.
    pub fn decode(name: impl Into<String>, bytes: Vec<u8>) -> Result<Self, NotText> {
        let (text, foreign) = decode(bytes)?;
        Ok(SourceFile { foreign, ..SourceFile::new(name, text) })
    }

    /// The position of a byte offset; one past the end is allowed.
    pub fn line_column(&self, offset: u32) -> LineColumn {
        let line = self.line_starts.partition_point(|start| *start <= offset) - 1;
        let start = self.line_starts[line] as usize;
        let upto = self.text.get(start..offset as usize).unwrap_or_default();
        LineColumn { line: line as u32 + 1, column: upto.chars().count() as u32 + 1 }
    }
}

/// All texts of one run, by [`FileId`].
#[derive(Debug, Clone, Default)]
pub struct Sources {
    files: Vec<SourceFile>,
}

impl Sources {
    /// Adds a file and names it.
    pub fn add(&mut self, file: SourceFile) -> FileId {
        self.files.push(file);
        FileId(self.files.len() as u32 - 1)
    }

    /// The file of that name; panics on an id of another `Sources`.
    pub fn file(&self, id: FileId) -> &SourceFile {
        &self.files[id.0 as usize]
    }

    /// All files, in the order they were added.
    pub fn iter(&self) -> impl Iterator<Item = (FileId, &SourceFile)> {
        self.files.iter().enumerate().map(|(i, file)| (FileId(i as u32), file))
    }

    /// `name:line:column` of the start of a span.
    pub fn position(&self, span: Span) -> String {
        let file = self.file(span.file);
        let at = file.line_column(span.start);
        format!("{}:{}:{}", file.name, at.line, at.column)
    }

    /// The text a span covers.
    pub fn text(&self, span: Span) -> &str {
        &self.file(span.file).text[span.range()]
    }
}
