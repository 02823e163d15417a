//! The answers of `ide` in the protocol's types.
//!
//! In: a [`Project`] and what the editor can do. Out: positions, places, edits, items as the protocol has them. It computes
//! nothing that `ide` does not say.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::Arc;

use ide::{Called, Coloured, Edit, Entry, EntryKind, Item, ItemKind, Lines, Modifier, Place, Project, TokenKind};
use lsp_types::*;
use syntax::Stop;

use crate::disk::{Disk, Folder};
use crate::location::{path_of, uri_of};
use crate::settings::Settings;

/// LIMIT: texts whose lines are kept.
const KEPT: usize = 64;

/// See the module.
#[derive(Debug)]
pub struct Answers {
    /// The texts and what is known of them.
    pub project: Project<Disk>,
    /// What the editor can do.
    pub settings: Arc<Settings>,
    /// The versions of the texts that are being edited.
    pub versions: BTreeMap<String, i32>,
    lines: BTreeMap<String, Lines>,
    /// Those of `lines` that are known to be present; see [`Answers::begin`].
    present: BTreeSet<String>,
}

impl Answers {
    /// A project of files on the disk, whose work can be stopped.
    pub fn new(settings: Arc<Settings>, stop: Stop) -> Answers {
        let mut project = Project::new(Disk::new(settings.within.clone()));
        project.set_stop(stop);
        Answers { project, settings, versions: BTreeMap::new(), lines: BTreeMap::new(), present: BTreeSet::new() }
    }

    /// Something else is to be done: texts may have changed since.
    pub fn begin(&mut self) {
        self.present.clear();
    }

    /// The lines of the text at a path; those of an empty one if there is none.
    fn lines(&mut self, path: &str) -> &Lines {
        if self.present.contains(path) {
            return &self.lines[path];
        }
        let text = self.project.text(path).map(|source| source.text).unwrap_or_default();
        if self.lines.len() > KEPT {
            self.lines.clear();
            self.present.clear();
        }
        let stale = self.lines.get(path).is_none_or(|lines| !Arc::ptr_eq(lines.text(), &text));
        if stale {
            self.lines.insert(path.to_string(), Lines::new(text));
        }
        self.present.insert(path.to_string());
        &self.lines[path]
    }

    /// The byte at a position.
    pub fn offset(&mut self, path: &str, position: Position) -> u32 {
        let encoding = self.settings.encoding;
        let position = ide::Position { line: position.line, column: position.character };
        self.lines(path).offset(position, encoding) as u32
    }

    /// The position of a byte.
    pub fn position(&mut self, path: &str, offset: u32) -> Position {
        let encoding = self.settings.encoding;
        let position = self.lines(path).position(offset as usize, encoding);
        Position::new(position.line, position.column)
    }

    /// The range of bytes.
    pub fn range(&mut self, path: &str, (start, end): (u32, u32)) -> Range {
        Range::new(self.position(path, start), self.position(path, end))
    }

    /// A place; none if nothing can show it.
    pub fn location(&mut self, place: &Place) -> Option<Location> {
        Some(Location { uri: uri_of(&place.path)?, range: self.range(&place.path, place.range) })
    }

    /// Places, each once.
    pub fn locations(&mut self, places: impl IntoIterator<Item = Place>) -> Vec<Location> {
        places.into_iter().filter_map(|place| self.location(&place)).collect()
    }

    /// The path and the byte of a position in a file.
    pub fn at(&mut self, position: &TextDocumentPositionParams) -> Option<(String, u32)> {
        let path = path_of(&position.text_document.uri)?;
        let offset = self.offset(&path, position.position);
        Some((path, offset))
    }

    /// Edits of one file.
    pub fn text_edits(&mut self, path: &str, edits: &[Edit]) -> Vec<TextEdit> {
        edits.iter().map(|edit| TextEdit::new(self.range(path, edit.range), edit.text.clone())).collect()
    }

    /// Edits of several files, for the versions that they were made of.
    #[allow(clippy::mutable_key_type, reason = "the protocol's own type")]
    pub fn workspace_edit(&mut self, edits: &BTreeMap<String, Vec<Edit>>) -> WorkspaceEdit {
        let mut changes = HashMap::new();
        let mut versioned = Vec::new();
        for (path, edits) in edits {
            let Some(uri) = uri_of(path) else { continue };
            let edits = self.text_edits(path, edits);
            if self.settings.versioned_edits {
                let version = self.versions.get(path).copied();
                versioned.push(TextDocumentEdit {
                    text_document: OptionalVersionedTextDocumentIdentifier { uri, version },
                    edits: edits.into_iter().map(OneOf::Left).collect(),
                });
            } else {
                changes.insert(uri, edits);
            }
        }
        match self.settings.versioned_edits {
            true => {
                WorkspaceEdit { document_changes: Some(DocumentChanges::Edits(versioned)), ..WorkspaceEdit::default() }
            }
            false => WorkspaceEdit { changes: Some(changes), ..WorkspaceEdit::default() },
        }
    }

    /// A completion.
    pub fn item(&self, range: Range, index: usize, item: &Item) -> CompletionItem {
        let kind = match item.kind {
            ItemKind::Function => CompletionItemKind::FUNCTION,
            ItemKind::Rule => CompletionItemKind::METHOD,
            ItemKind::Domain => CompletionItemKind::CLASS,
            ItemKind::Literal => CompletionItemKind::ENUM_MEMBER,
            ItemKind::Variable => CompletionItemKind::VARIABLE,
            ItemKind::Keyword => CompletionItemKind::KEYWORD,
            ItemKind::Snippet => CompletionItemKind::SNIPPET,
            ItemKind::File => CompletionItemKind::MODULE,
        };
        let fills = item.is_snippet && self.settings.snippets;
        let text = if item.is_snippet && !fills { without_holes(&item.insert) } else { item.insert.clone() };
        CompletionItem {
            label: item.label.clone(),
            kind: Some(kind),
            detail: (!item.detail.is_empty()).then(|| item.detail.clone()),
            sort_text: Some(format!("{:02}{index:05}", item.rank)),
            insert_text_format: fills.then_some(InsertTextFormat::SNIPPET),
            text_edit: Some(CompletionTextEdit::Edit(TextEdit::new(range, text))),
            ..CompletionItem::default()
        }
    }

    /// An entry of an outline with what is in it.
    #[allow(deprecated, reason = "a field of the protocol's type")]
    pub fn symbol(&mut self, path: &str, entry: &Entry) -> DocumentSymbol {
        let inner: Vec<DocumentSymbol> = entry.inner.iter().map(|inner| self.symbol(path, inner)).collect();
        DocumentSymbol {
            name: entry.name.clone(),
            detail: (!entry.detail.is_empty()).then(|| entry.detail.clone()),
            kind: symbol_kind(entry.kind),
            tags: None,
            deprecated: None,
            range: self.range(path, entry.range),
            selection_range: self.range(path, entry.name_range),
            children: (!inner.is_empty()).then_some(inner),
        }
    }

    /// An entry of an outline by itself.
    #[allow(deprecated, reason = "a field of the protocol's type")]
    pub fn flat_symbol(&mut self, entry: &Entry, place: &Place) -> Option<SymbolInformation> {
        Some(SymbolInformation {
            name: entry.name.clone(),
            kind: symbol_kind(entry.kind),
            tags: None,
            deprecated: None,
            location: self.location(place)?,
            container_name: None,
        })
    }

    /// Tokens as differences, a token for each line of those that go over several.
    pub fn tokens(&mut self, path: &str, tokens: &[Coloured]) -> Vec<SemanticToken> {
        let mut found = Vec::new();
        let mut last = Position::new(0, 0);
        let text = self.lines(path).text().clone();
        for token in tokens {
            let (kind, modifiers) = numbers(token);
            let mut at = token.range.0;
            let part = text.get(token.range.0 as usize..token.range.1 as usize).unwrap_or_default();
            for line in part.split_inclusive('\n') {
                let written = line.trim_end_matches(['\r', '\n']);
                let start = self.position(path, at);
                let end = self.position(path, at + written.len() as u32);
                at += line.len() as u32;
                if written.is_empty() {
                    continue;
                }
                let delta_line = start.line - last.line;
                let delta_start = if delta_line == 0 { start.character - last.character } else { start.character };
                let length = end.character - start.character;
                let token_modifiers_bitset = modifiers;
                found.push(SemanticToken { delta_line, delta_start, length, token_type: kind, token_modifiers_bitset });
                last = start;
            }
        }
        found
    }

    /// A rule in a hierarchy of calls.
    pub fn hierarchy_item(&mut self, called: &Called) -> Option<CallHierarchyItem> {
        let range = self.range(&called.place.path, called.place.range);
        Some(CallHierarchyItem {
            name: called.name.clone(),
            kind: SymbolKind::METHOD,
            tags: None,
            detail: None,
            uri: uri_of(&called.place.path)?,
            range,
            selection_range: range,
            data: None,
        })
    }

    /// Looks at the disk again.
    pub fn look_again(&mut self, folders: &[Folder]) {
        self.project.set_files(crate::disk::project_files(folders));
    }
}

fn symbol_kind(kind: EntryKind) -> SymbolKind {
    match kind {
        EntryKind::Machine => SymbolKind::MODULE,
        EntryKind::Domain => SymbolKind::CLASS,
        EntryKind::Enum => SymbolKind::ENUM,
        EntryKind::Literal => SymbolKind::ENUM_MEMBER,
        EntryKind::Function => SymbolKind::FUNCTION,
        EntryKind::Rule => SymbolKind::METHOD,
        EntryKind::Property => SymbolKind::BOOLEAN,
        EntryKind::Init => SymbolKind::CONSTRUCTOR,
        EntryKind::Block => SymbolKind::EVENT,
        EntryKind::Shape => SymbolKind::OBJECT,
    }
}

/// The number of a token's kind, and the bits of what else it is; see [`crate::capabilities`].
fn numbers(token: &Coloured) -> (u32, u32) {
    let kind = match token.kind {
        TokenKind::Comment => 0,
        TokenKind::Keyword => 1,
        TokenKind::Operator => 2,
        TokenKind::Number => 3,
        TokenKind::String => 4,
        TokenKind::Domain => 5,
        TokenKind::Enum => 6,
        TokenKind::Literal => 7,
        TokenKind::Function => 8,
        TokenKind::Rule => 9,
        TokenKind::TurboRule => 10,
        TokenKind::Variable => 11,
        TokenKind::Label => 12,
    };
    let bit = |modifier: &Modifier| -> u32 {
        use groundstate::model::FunctionKind;
        match modifier {
            Modifier::Declaration => 0,
            Modifier::Modification => 1,
            Modifier::Library => 2,
            Modifier::Kind(FunctionKind::Static) => 3,
            Modifier::Kind(FunctionKind::Derived) => 4,
            Modifier::Kind(FunctionKind::Monitored) => 5,
            Modifier::Kind(FunctionKind::Controlled) => 6,
            Modifier::Kind(FunctionKind::Shared) => 7,
            Modifier::Kind(FunctionKind::Out) => 8,
            Modifier::Kind(FunctionKind::Local) => 9,
        }
    };
    (kind, token.modifiers.iter().fold(0, |bits, modifier| bits | 1 << bit(modifier)))
}

/// A snippet as plain text: `${1:x}` is `x`, `$0` nothing.
fn without_holes(snippet: &str) -> String {
    let mut text = String::new();
    let mut letters = snippet.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '\\' => text.extend(letters.next()),
            '$' if letters.peek() == Some(&'{') => {
                let inner: String = letters.by_ref().skip(1).take_while(|letter| *letter != '}').collect();
                text.push_str(&inner.split_once(':').map_or(String::new(), |(_, word)| word.replace('\\', "")));
            }
            '$' => while letters.next_if(char::is_ascii_digit).is_some() {},
            other => text.push(other),
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_snippet_is_text_where_nothing_can_be_filled_in() {
        assert_eq!(without_holes("forall \\$${1:x} in ${2:D} do\n\t${0:skip}"), "forall $x in D do\n\tskip");
        assert_eq!(without_holes("f(${1}, ${2})$0"), "f(, )");
    }
}
