//! Requests by their method: parameters in, the protocol's answer out.
//!
//! In: a method and parameters as JSON. Out: the answer as JSON, or an error with its code. Nothing here waits or sends.

use std::path::Path;

use groundstate::Kind;
use ide::{Action, FoldKind, RefactoringKind, Role};
use lsp_server::ErrorCode;
use lsp_types::request::{self as method, Request};
use lsp_types::*;
use serde_json::Value;

use crate::answer::Answers;
use crate::capabilities::REFACTORINGS;
use crate::location::{path_of, uri_of};
use crate::publish::diagnostic;

/// What is said instead of an answer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refused {
    /// One of the protocol.
    pub code: i32,
    /// A sentence for the user.
    pub message: String,
}

impl Refused {
    /// Something is missing in the parameters, or is of another kind.
    pub fn wrong(message: impl Into<String>) -> Refused {
        Refused::new(ErrorCode::InvalidParams, message)
    }

    /// It cannot be done; a sentence for the user.
    pub fn failed(message: impl Into<String>) -> Refused {
        Refused::new(ErrorCode::RequestFailed, message)
    }

    /// An error with a code of the protocol.
    pub fn new(code: ErrorCode, message: impl Into<String>) -> Refused {
        Refused { code: code as i32, message: message.into() }
    }
}

/// Answers a request of this type by a function of its parameters.
fn by<R: Request>(
    answers: &mut Answers,
    params: Value,
    answer: impl FnOnce(&mut Answers, R::Params) -> Result<R::Result, Refused>,
) -> Result<Value, Refused> {
    let params = serde_json::from_value(params)
        .map_err(|error| Refused::new(ErrorCode::InvalidParams, format!("{}: {error}", R::METHOD)))?;
    let result = answer(answers, params)?;
    serde_json::to_value(result).map_err(|error| Refused::new(ErrorCode::InternalError, error.to_string()))
}

/// The same where nothing can be refused.
fn with<R: Request>(
    answers: &mut Answers,
    params: Value,
    answer: impl FnOnce(&mut Answers, R::Params) -> Option<R::Result>,
) -> Result<Value, Refused>
where
    R::Result: Default,
{
    by::<R>(answers, params, |answers, params| Ok(answer(answers, params).unwrap_or_default()))
}

/// The path of the file that a request is about, whatever its method.
pub fn subject(params: &Value) -> Option<String> {
    let uri = params.pointer("/textDocument/uri").or_else(|| params.pointer("/item/uri"))?.as_str()?;
    path_of(&uri.parse().ok()?)
}

/// Whether the answer has places of files other than the one that was asked about.
pub fn is_about_all(name: &str) -> bool {
    matches!(
        name,
        "textDocument/rename"
            | "textDocument/hover"
            | "textDocument/codeLens"
            | "textDocument/references"
            | "textDocument/definition"
            | "textDocument/declaration"
            | "textDocument/implementation"
            | "workspace/symbol"
            | "callHierarchy/incomingCalls"
            | "callHierarchy/outgoingCalls"
    )
}

/// The answer to a request.
///
/// # Errors
/// The method is not known, its parameters are wrong, or what it asks cannot be done.
pub fn answer(answers: &mut Answers, name: &str, params: Value) -> Result<Value, Refused> {
    match name {
        method::HoverRequest::METHOD => with::<method::HoverRequest>(answers, params, hover),
        method::Completion::METHOD => with::<method::Completion>(answers, params, completion),
        method::SignatureHelpRequest::METHOD => with::<method::SignatureHelpRequest>(answers, params, signatures),
        method::GotoDefinition::METHOD => with::<method::GotoDefinition>(answers, params, definition),
        method::GotoDeclaration::METHOD => with::<method::GotoDeclaration>(answers, params, definition),
        method::GotoImplementation::METHOD => with::<method::GotoImplementation>(answers, params, implementation),
        method::References::METHOD => with::<method::References>(answers, params, references),
        method::DocumentHighlightRequest::METHOD => {
            with::<method::DocumentHighlightRequest>(answers, params, highlights)
        }
        method::DocumentSymbolRequest::METHOD => with::<method::DocumentSymbolRequest>(answers, params, outline),
        method::WorkspaceSymbolRequest::METHOD => with::<method::WorkspaceSymbolRequest>(answers, params, search),
        method::CodeActionRequest::METHOD => with::<method::CodeActionRequest>(answers, params, actions),
        method::CodeLensRequest::METHOD => with::<method::CodeLensRequest>(answers, params, lenses),
        method::DocumentLinkRequest::METHOD => with::<method::DocumentLinkRequest>(answers, params, links),
        method::PrepareRenameRequest::METHOD => by::<method::PrepareRenameRequest>(answers, params, prepare_rename),
        method::Rename::METHOD => by::<method::Rename>(answers, params, rename),
        method::FoldingRangeRequest::METHOD => with::<method::FoldingRangeRequest>(answers, params, folding),
        method::SelectionRangeRequest::METHOD => with::<method::SelectionRangeRequest>(answers, params, selections),
        method::SemanticTokensFullRequest::METHOD => with::<method::SemanticTokensFullRequest>(answers, params, tokens),
        method::InlayHintRequest::METHOD => with::<method::InlayHintRequest>(answers, params, hints),
        method::CallHierarchyPrepare::METHOD => with::<method::CallHierarchyPrepare>(answers, params, hierarchy),
        method::CallHierarchyIncomingCalls::METHOD => {
            with::<method::CallHierarchyIncomingCalls>(answers, params, callers)
        }
        method::CallHierarchyOutgoingCalls::METHOD => {
            with::<method::CallHierarchyOutgoingCalls>(answers, params, callees)
        }
        "groundstate/panic" if answers.settings.may_panic => panic!("asked to"),
        _ => Err(Refused::new(ErrorCode::MethodNotFound, format!("{name} is not known"))),
    }
}

fn hover(answers: &mut Answers, params: HoverParams) -> Option<Option<Hover>> {
    let (path, at) = answers.at(&params.text_document_position_params)?;
    let found = ide::hover(&mut answers.project, &path, at)?;
    let contents = HoverContents::Markup(MarkupContent { kind: MarkupKind::Markdown, value: found.text });
    Some(Some(Hover { contents, range: Some(answers.range(&path, found.place.range)) }))
}

fn completion(answers: &mut Answers, params: CompletionParams) -> Option<Option<CompletionResponse>> {
    let (path, at) = answers.at(&params.text_document_position)?;
    // In a coupling a dot stands behind a machine; elsewhere it is part of a number, or behind an agent.
    let typed = params.context.as_ref().and_then(|context| context.trigger_character.as_deref());
    if typed == Some(".") && Kind::of(Path::new(&path)) != Some(Kind::Coupling) {
        return Some(None);
    }
    let found = ide::completion(&mut answers.project, &path, at);
    let range = answers.range(&path, found.range);
    let items = found.items.iter().enumerate().map(|(index, item)| answers.item(range, index, item)).collect();
    Some(Some(CompletionResponse::Array(items)))
}

fn signatures(answers: &mut Answers, params: SignatureHelpParams) -> Option<Option<SignatureHelp>> {
    let (path, at) = answers.at(&params.text_document_position_params)?;
    let found = ide::signatures(&mut answers.project, &path, at)?;
    let active_parameter = Some(found.parameter as u32);
    let of = |signature: &ide::Signature| SignatureInformation {
        label: signature.label.clone(),
        documentation: None,
        parameters: Some(
            signature
                .parameters
                .iter()
                .map(|(start, end)| ParameterInformation {
                    // Names of AsmetaL are ASCII, so bytes are code units.
                    label: ParameterLabel::LabelOffsets([*start, *end]),
                    documentation: None,
                })
                .collect(),
        ),
        active_parameter,
    };
    let signatures = found.signatures.iter().map(of).collect();
    Some(Some(SignatureHelp { signatures, active_signature: Some(found.active as u32), active_parameter }))
}

fn definition(answers: &mut Answers, params: GotoDefinitionParams) -> Option<Option<GotoDefinitionResponse>> {
    let (path, at) = answers.at(&params.text_document_position_params)?;
    let places = ide::definition(&mut answers.project, &path, at);
    Some(Some(GotoDefinitionResponse::Array(answers.locations(places))))
}

fn implementation(answers: &mut Answers, params: GotoDefinitionParams) -> Option<Option<GotoDefinitionResponse>> {
    let (path, at) = answers.at(&params.text_document_position_params)?;
    let places = ide::implementations(&mut answers.project, &path, at);
    Some(Some(GotoDefinitionResponse::Array(answers.locations(places))))
}

fn references(answers: &mut Answers, params: ReferenceParams) -> Option<Option<Vec<Location>>> {
    let (path, at) = answers.at(&params.text_document_position)?;
    let declared = params.context.include_declaration;
    let found = ide::references(&mut answers.project, &path, at);
    let wanted = found.into_iter().filter(|reference| declared || reference.role != Role::Declaration);
    Some(Some(answers.locations(wanted.map(|reference| reference.place))))
}

fn highlights(answers: &mut Answers, params: DocumentHighlightParams) -> Option<Option<Vec<DocumentHighlight>>> {
    let (path, at) = answers.at(&params.text_document_position_params)?;
    let found = ide::highlights(&mut answers.project, &path, at);
    let of = |reference: ide::Reference| {
        let kind = match reference.role {
            Role::Declaration | Role::Definition | Role::Write => DocumentHighlightKind::WRITE,
            Role::Call | Role::Read => DocumentHighlightKind::READ,
        };
        DocumentHighlight { range: answers.range(&path, reference.place.range), kind: Some(kind) }
    };
    Some(Some(found.into_iter().map(of).collect()))
}

fn outline(answers: &mut Answers, params: DocumentSymbolParams) -> Option<Option<DocumentSymbolResponse>> {
    let path = path_of(&params.text_document.uri)?;
    let found = ide::outline(&mut answers.project, &path);
    if answers.settings.nested_outline {
        let nested = found.iter().map(|entry| answers.symbol(&path, entry)).collect();
        return Some(Some(DocumentSymbolResponse::Nested(nested)));
    }
    let mut flat = Vec::new();
    let mut open = found;
    open.reverse();
    while let Some(mut entry) = open.pop() {
        let place = ide::Place { path: path.clone(), range: entry.range };
        flat.extend(answers.flat_symbol(&entry, &place));
        entry.inner.reverse();
        open.append(&mut entry.inner);
    }
    Some(Some(DocumentSymbolResponse::Flat(flat)))
}

fn search(answers: &mut Answers, params: WorkspaceSymbolParams) -> Option<Option<WorkspaceSymbolResponse>> {
    let found = ide::search(&mut answers.project, &params.query);
    let symbols = found.iter().filter_map(|(entry, place)| answers.flat_symbol(entry, place)).collect();
    Some(Some(WorkspaceSymbolResponse::Flat(symbols)))
}

fn actions(answers: &mut Answers, params: CodeActionParams) -> Option<Option<CodeActionResponse>> {
    let path = path_of(&params.text_document.uri)?;
    let range = (answers.offset(&path, params.range.start), answers.offset(&path, params.range.end));
    // A kind stands for those that begin with its words, too: `refactor` for `refactor.extract`.
    let asked = |kind: &CodeActionKind| {
        params.context.only.as_ref().is_none_or(|kinds| {
            kinds.iter().any(|asked| {
                let rest = kind.as_str().strip_prefix(asked.as_str());
                asked.as_str().is_empty() || rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
            })
        })
    };
    let mut found = Vec::new();
    if asked(&CodeActionKind::QUICKFIX) {
        for fix in ide::fixes(&mut answers.project, &path, range) {
            let edit = answers.workspace_edit(&[(path.clone(), fix.edits)].into());
            let mended = diagnostic(answers, &path, &fix.fault);
            found.push(CodeActionOrCommand::CodeAction(CodeAction {
                title: fix.title,
                kind: Some(CodeActionKind::QUICKFIX),
                diagnostics: Some(vec![mended]),
                edit: Some(edit),
                ..CodeAction::default()
            }));
        }
    }
    if REFACTORINGS.iter().any(asked) {
        for refactoring in ide::refactorings(&mut answers.project, &path, range) {
            let kind = match refactoring.kind {
                RefactoringKind::Extract => CodeActionKind::REFACTOR_EXTRACT,
                RefactoringKind::Inline => CodeActionKind::REFACTOR_INLINE,
                RefactoringKind::Rewrite => CodeActionKind::REFACTOR_REWRITE,
            };
            if !asked(&kind) {
                continue;
            }
            let edit = answers.workspace_edit(&[(path.clone(), refactoring.edits)].into());
            let (title, kind, edit) = (refactoring.title, Some(kind), Some(edit));
            found.push(CodeActionOrCommand::CodeAction(CodeAction { title, kind, edit, ..CodeAction::default() }));
        }
    }
    Some(Some(found))
}

fn lenses(answers: &mut Answers, params: CodeLensParams) -> Option<Option<Vec<CodeLens>>> {
    let path = path_of(&params.text_document.uri)?;
    let found = ide::lenses(&mut answers.project, &path);
    let mut lenses = Vec::new();
    for lens in found {
        let command = match &lens.action {
            Action::Run => "groundstate.run",
            Action::Verify => "groundstate.verify",
            Action::Test => "groundstate.test",
            Action::Draw => "groundstate.draw",
            // It tells how many there are; editors have a command of their own to list them.
            Action::References(_) => "",
        };
        if !command.is_empty() && !answers.settings.commands {
            continue;
        }
        let uri = params.text_document.uri.to_string();
        let arguments = (!command.is_empty()).then(|| vec![Value::String(uri)]);
        let command = Command { title: lens.title, command: command.to_string(), arguments };
        lenses.push(CodeLens { range: answers.range(&path, lens.range), command: Some(command), data: None });
    }
    Some(Some(lenses))
}

fn links(answers: &mut Answers, params: DocumentLinkParams) -> Option<Option<Vec<DocumentLink>>> {
    let path = path_of(&params.text_document.uri)?;
    let found = ide::links(&mut answers.project, &path);
    let of = |(place, target): (ide::Place, String)| DocumentLink {
        range: answers.range(&path, place.range),
        target: uri_of(&target),
        tooltip: Some(target),
        data: None,
    };
    Some(Some(found.into_iter().map(of).collect()))
}

fn prepare_rename(
    answers: &mut Answers,
    params: TextDocumentPositionParams,
) -> Result<Option<PrepareRenameResponse>, Refused> {
    let Some((path, at)) = answers.at(&params) else { return Ok(None) };
    let place = ide::prepare(&mut answers.project, &path, at).map_err(refused)?;
    Ok(Some(PrepareRenameResponse::Range(answers.range(&path, place.range))))
}

fn rename(answers: &mut Answers, params: RenameParams) -> Result<Option<WorkspaceEdit>, Refused> {
    let Some((path, at)) = answers.at(&params.text_document_position) else { return Ok(None) };
    let edits = ide::rename(&mut answers.project, &path, at, &params.new_name).map_err(refused)?;
    Ok(Some(answers.workspace_edit(&edits)))
}

fn refused(reason: String) -> Refused {
    Refused::new(ErrorCode::RequestFailed, reason)
}

fn folding(answers: &mut Answers, params: FoldingRangeParams) -> Option<Option<Vec<FoldingRange>>> {
    let path = path_of(&params.text_document.uri)?;
    let found = ide::folding(&mut answers.project, &path);
    let of = |(range, kind): ((u32, u32), FoldKind)| {
        let range = answers.range(&path, range);
        let kind = match kind {
            FoldKind::Comment => FoldingRangeKind::Comment,
            FoldKind::Imports => FoldingRangeKind::Imports,
            FoldKind::Region => FoldingRangeKind::Region,
        };
        FoldingRange {
            start_line: range.start.line,
            end_line: range.end.line,
            kind: Some(kind),
            ..FoldingRange::default()
        }
    };
    Some(Some(found.into_iter().map(of).collect()))
}

fn selections(answers: &mut Answers, params: SelectionRangeParams) -> Option<Option<Vec<SelectionRange>>> {
    let path = path_of(&params.text_document.uri)?;
    let mut found = Vec::new();
    for position in params.positions {
        let at = answers.offset(&path, position);
        let ranges = ide::selections(&mut answers.project, &path, at);
        let mut parent: Option<Box<SelectionRange>> = None;
        for range in ranges.into_iter().rev() {
            parent = Some(Box::new(SelectionRange { range: answers.range(&path, range), parent }));
        }
        let here = SelectionRange { range: Range::new(position, position), parent: None };
        found.push(parent.map_or(here, |range| *range));
    }
    Some(Some(found))
}

fn tokens(answers: &mut Answers, params: SemanticTokensParams) -> Option<Option<SemanticTokensResult>> {
    let path = path_of(&params.text_document.uri)?;
    let found = ide::tokens(&mut answers.project, &path);
    let data = answers.tokens(&path, &found);
    Some(Some(SemanticTokensResult::Tokens(SemanticTokens { result_id: None, data })))
}

fn hints(answers: &mut Answers, params: InlayHintParams) -> Option<Option<Vec<InlayHint>>> {
    let path = path_of(&params.text_document.uri)?;
    let range = (answers.offset(&path, params.range.start), answers.offset(&path, params.range.end));
    let found = ide::hints(&mut answers.project, &path);
    let shown = found.into_iter().filter(|hint| range.0 <= hint.at && hint.at <= range.1);
    let of = |hint: ide::Hint| InlayHint {
        position: answers.position(&path, hint.at),
        label: InlayHintLabel::String(hint.text),
        kind: Some(InlayHintKind::TYPE),
        text_edits: None,
        tooltip: None,
        padding_left: None,
        padding_right: None,
        data: None,
    };
    Some(Some(shown.map(of).collect()))
}

fn hierarchy(answers: &mut Answers, params: CallHierarchyPrepareParams) -> Option<Option<Vec<CallHierarchyItem>>> {
    let (path, at) = answers.at(&params.text_document_position_params)?;
    let mut found = Vec::new();
    for place in ide::definition(&mut answers.project, &path, at) {
        let name = answers.project.text(&place.path).ok()?.text;
        let name = name.get(place.range.0 as usize..place.range.1 as usize)?.to_string();
        if name.starts_with("r_") {
            found.extend(answers.hierarchy_item(&ide::Called { name, place, calls: Vec::new() }));
        }
    }
    Some(Some(found))
}

fn item_at(answers: &mut Answers, item: &CallHierarchyItem) -> Option<(String, u32)> {
    let path = path_of(&item.uri)?;
    let at = answers.offset(&path, item.selection_range.start);
    Some((path, at))
}

fn callers(
    answers: &mut Answers,
    params: CallHierarchyIncomingCallsParams,
) -> Option<Option<Vec<CallHierarchyIncomingCall>>> {
    let (path, at) = item_at(answers, &params.item)?;
    let mut found = Vec::new();
    for caller in ide::callers(&mut answers.project, &path, at) {
        let from_ranges = caller.calls.iter().map(|range| answers.range(&caller.place.path, *range)).collect();
        found.extend(answers.hierarchy_item(&caller).map(|from| CallHierarchyIncomingCall { from, from_ranges }));
    }
    Some(Some(found))
}

fn callees(
    answers: &mut Answers,
    params: CallHierarchyOutgoingCallsParams,
) -> Option<Option<Vec<CallHierarchyOutgoingCall>>> {
    let (path, at) = item_at(answers, &params.item)?;
    let mut found = Vec::new();
    for called in ide::callees(&mut answers.project, &path, at) {
        let from_ranges = called.calls.iter().map(|range| answers.range(&path, *range)).collect();
        found.extend(answers.hierarchy_item(&called).map(|to| CallHierarchyOutgoingCall { to, from_ranges }));
    }
    Some(Some(found))
}
