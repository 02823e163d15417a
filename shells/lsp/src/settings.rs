//! What the editor can do, as it says when it starts.
//!
//! In: the parameters of `initialize`. Out: [`Settings`]. What an editor does not mention it cannot do.

use std::path::PathBuf;

use ide::Encoding;
use lsp_types::{InitializeParams, PositionEncodingKind};

use crate::location::path_of;

/// See the module.
#[derive(Debug, Clone, Default)]
pub struct Settings {
    /// What columns count.
    pub encoding: Encoding,
    /// Completions may have places to fill in.
    pub snippets: bool,
    /// Outlines may be nested.
    pub nested_outline: bool,
    /// Edits may name the version of the text that they are for.
    pub versioned_edits: bool,
    /// Files may be watched on request.
    pub watches: bool,
    /// The editor has the commands `groundstate.run` and its like.
    pub commands: bool,
    /// The files of the folders are checked though they are not open.
    pub checks_folders: bool,
    /// For a test: the request `groundstate/panic` panics.
    pub may_panic: bool,
    /// The folders that are open.
    pub folders: Vec<String>,
    /// Only files of this folder are read, whatever the editor says.
    pub within: Option<PathBuf>,
}

impl Settings {
    /// What an editor says of itself.
    #[allow(deprecated, reason = "`rootUri` is what older editors send")]
    pub fn of(params: &InitializeParams) -> Settings {
        let client = &params.capabilities;
        let general = client.general.as_ref();
        let offered = general.and_then(|general| general.position_encodings.clone()).unwrap_or_default();
        let encoding = match offered.iter().find(|kind| **kind != PositionEncodingKind::UTF16) {
            Some(kind) if *kind == PositionEncodingKind::UTF8 => Encoding::Utf8,
            Some(kind) if *kind == PositionEncodingKind::UTF32 => Encoding::Utf32,
            _ => Encoding::Utf16,
        };
        let document = client.text_document.as_ref();
        let item = document.and_then(|document| document.completion.as_ref()?.completion_item.as_ref());
        let workspace = client.workspace.as_ref();
        let options = params.initialization_options.as_ref();
        let option = |name: &str| options.and_then(|options| options.get(name)).and_then(|value| value.as_bool());
        let folders = match &params.workspace_folders {
            Some(folders) => folders.iter().filter_map(|folder| path_of(&folder.uri)).collect(),
            None => params.root_uri.as_ref().and_then(path_of).into_iter().collect(),
        };
        Settings {
            encoding,
            snippets: item.and_then(|item| item.snippet_support).unwrap_or(false),
            nested_outline: document
                .and_then(|document| document.document_symbol.as_ref()?.hierarchical_document_symbol_support)
                .unwrap_or(false),
            versioned_edits: workspace
                .and_then(|workspace| workspace.workspace_edit.as_ref()?.document_changes)
                .unwrap_or(false),
            watches: workspace
                .and_then(|workspace| workspace.did_change_watched_files.as_ref()?.dynamic_registration)
                .unwrap_or(false),
            commands: option("commands").unwrap_or(false),
            checks_folders: option("checkFolders").unwrap_or(true),
            may_panic: option("mayPanic").unwrap_or(false),
            folders,
            within: None,
        }
    }

    /// Whether the editor may see the files of a folder.
    pub fn shows(&self, folder: &str) -> bool {
        self.within
            .as_ref()
            .is_none_or(|within| std::fs::canonicalize(folder).is_ok_and(|path| path.starts_with(within)))
    }
}
