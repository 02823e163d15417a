//! What is known of one file: its tree, its names and what they mean, its faults.
//!
//! In: a checked model, or the text of a scenario or chart over one. Out: an [`Analysis`]. A scenario's and a chart's terms and
//! rules are checked as if they stood in the model; a faulty model is as good as a sound one here. INVARIANT: `names` are in the
//! order of their places, and lie in the file itself.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use groundstate::Kind;
use groundstate::workspace::Findings;
use model::{Checked, Model, Referent, RuleKind, Use};
use syntax::ast::{self, AstNode};
use syntax::{FileId, Parse, SourceFile, Sources, Span, SyntaxKind, SyntaxNode, SyntaxToken};

use crate::specification;

/// See the module.
#[derive(Debug)]
pub struct Analysis {
    /// All texts read.
    pub sources: Sources,
    /// The model, with all that could be understood of it.
    pub model: Arc<Model>,
    /// The file.
    pub file: FileId,
    /// Its names.
    pub names: Vec<Use>,
    /// What is wrong with it, if it is a model. Of all else [`crate::Project::findings`] tells.
    pub findings: Arc<Findings>,
    parse: Option<Parse>,
    declarations: BTreeMap<Referent, Span>,
}

/// What a scenario or a chart is about.
#[derive(Debug)]
pub(crate) struct Base {
    /// The texts of the model.
    pub sources: Sources,
    /// The model.
    pub model: Model,
}

/// What a name means, the same from whatever file it is looked at.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub enum Symbol {
    /// Declared there: the file's name and the first byte of the name.
    At(String, u32),
    /// Declared nowhere.
    BuiltIn(String),
}

/// A range of bytes in a file.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// The file's path, or the name of a built-in library: `<std>/…`, `<patterns>/…`.
    pub path: String,
    /// First byte and the one after the last.
    pub range: (u32, u32),
}

/// What is done to something where it is named.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Role {
    /// It is declared or bound.
    Declaration,
    /// It gets its definition or its initial value.
    Definition,
    /// It is updated or set.
    Write,
    /// A rule is called.
    Call,
    /// All else.
    Read,
}

impl Analysis {
    pub(crate) fn of_model(checked: Checked, parse: Option<Parse>) -> Analysis {
        let Checked { sources, model, diagnostics } = checked;
        let file = FileId(0);
        let names = model.uses.in_file(file);
        let findings = Findings { faults: vec![(sources.clone(), diagnostics)], open: None };
        let declarations = declarations(&model);
        Analysis { sources, model: Arc::new(model), file, names, findings: Arc::new(findings), parse, declarations }
    }

    /// A file in which nothing has a name.
    pub(crate) fn of_text(source: SourceFile) -> Analysis {
        let mut sources = Sources::default();
        let file = sources.add(source);
        let checked = Checked { sources, model: Model::empty(file), diagnostics: Vec::new() };
        Analysis::of_model(checked, None)
    }

    /// A scenario, a chart or a specification over a model.
    pub(crate) fn over(source: SourceFile, base: Base) -> Analysis {
        let Base { mut sources, mut model } = base;
        let file = sources.add(source.clone());
        if let Some(kind @ (Kind::Report | Kind::Verification)) = Kind::of(Path::new(&source.name)) {
            let names = specification::names(&mut model, file, &source, kind);
            let declarations = declarations(&model);
            let (findings, model) = (Arc::default(), Arc::new(model));
            return Analysis { sources, model, file, names, findings, parse: None, declarations };
        }
        let parse = match Kind::of(Path::new(&source.name)) {
            Some(Kind::Chart) => syntax::parse_chart(file, &source.text),
            _ => syntax::parse_avalla(file, &source.text),
        };
        let mut walk = Fragments { model: &mut model, file, names: Vec::new() };
        walk.node(&parse.syntax());
        let mut names = walk.names;
        names.extend(model.uses.in_file(file));
        names.sort_by_key(|name| (name.span, name.referent));
        names.dedup_by_key(|name| (name.span, name.referent));
        let declarations = declarations(&model);
        let findings = Arc::default();
        Analysis { sources, model: Arc::new(model), file, names, findings, parse: Some(parse), declarations }
    }

    /// The file with its text.
    pub fn source(&self) -> &SourceFile {
        self.sources.file(self.file)
    }

    /// The text.
    pub fn text(&self) -> &str {
        &self.source().text
    }

    /// The tree; none of a file that is not one of a model, a scenario or a chart.
    pub fn tree(&self) -> Option<SyntaxNode> {
        self.parse.as_ref().map(Parse::syntax)
    }

    /// The parse, for who formats it.
    pub fn parse(&self) -> Option<&Parse> {
        self.parse.as_ref()
    }

    /// The file as a model.
    pub fn machine(&self) -> Option<ast::SourceFile> {
        ast::SourceFile::cast(self.tree()?)
    }

    /// What the name at an offset, or just before it, means; several things for a name in a list of imports or exports.
    pub fn names_at(&self, offset: u32) -> &[Use] {
        let upto = self.names.partition_point(|name| name.span.start <= offset);
        let here = self.group_before(upto);
        let Some(first) = here.first() else { return &[] };
        let is_word = |name: &Use| self.text()[name.span.range()].starts_with(|c: char| c.is_alphabetic() || c == '$');
        if first.span.start == offset && !is_word(first) {
            // `a|+b`: the word before is meant, not the operator.
            let before = self.group_before(upto - here.len());
            if before.first().is_some_and(|name| name.span.end == offset && is_word(name)) {
                return before;
            }
        }
        if offset <= first.span.end { here } else { &[] }
    }

    /// The names at the place of the last of the first `upto`.
    fn group_before(&self, upto: usize) -> &[Use] {
        let Some(last) = self.names[..upto].last() else { return &[] };
        let from = self.names[..upto].partition_point(|name| name.span.start < last.span.start);
        &self.names[from..upto]
    }

    /// Where something is declared; none for what is built in.
    pub fn declaration(&self, referent: Referent) -> Option<Span> {
        let known = match referent {
            Referent::Function(id) => Some(self.model.function(id).span),
            Referent::Rule(id) => Some(self.model.rule(id).span),
            Referent::Variable(span, _) => Some(span),
            Referent::Domain(_) | Referent::Literal(..) => None,
        };
        known.or_else(|| self.declarations.get(&referent).copied())
    }

    /// What a referent is, whoever asks.
    pub fn symbol(&self, referent: Referent) -> Symbol {
        match (self.declaration(referent), referent) {
            (Some(span), _) => Symbol::At(self.sources.file(span.file).name.clone(), span.start),
            (None, Referent::Domain(id) | Referent::Literal(id, _)) => Symbol::BuiltIn(self.model.domains.display(id)),
            (None, _) => Symbol::BuiltIn(String::new()),
        }
    }

    /// A span as a place.
    pub fn place(&self, span: Span) -> Place {
        Place { path: self.sources.file(span.file).name.clone(), range: (span.start, span.end) }
    }

    /// The token at an offset; of two, the one that is a word.
    pub fn token_at(&self, offset: u32) -> Option<SyntaxToken> {
        let tree = self.tree()?;
        let offset = offset.min(tree.text_range().end().into());
        let at = tree.token_at_offset(offset.into());
        let (left, right) = (at.clone().left_biased(), at.right_biased());
        let worth = |token: &SyntaxToken| !token.kind().is_trivia() && is_word(token);
        right.filter(worth).or_else(|| left.clone().filter(worth)).or(left)
    }

    /// What is done to a name at its place.
    pub fn role(&self, name: &Use) -> Role {
        if name.declares {
            return Role::Declaration;
        }
        let Some(token) = self.token_at(name.span.start) else { return Role::Read };
        let Some(parent) = token.parent() else { return Role::Read };
        match parent.kind() {
            SyntaxKind::FUNCTION_DEF | SyntaxKind::DOMAIN_DEF => Role::Definition,
            SyntaxKind::MACRO_CALL_RULE | SyntaxKind::TURBO_CALL_RULE | SyntaxKind::RULE_TERM | SyntaxKind::LINK => {
                Role::Call
            }
            SyntaxKind::FUNCTION_TERM | SyntaxKind::VARIABLE_TERM if is_target(&parent, &token) => Role::Write,
            _ => Role::Read,
        }
    }

    /// The name of the rule that a place is in.
    pub fn enclosing_rule(&self, span: Span) -> Option<SyntaxToken> {
        let token = self.token_at(span.start)?;
        token.parent_ancestors().find_map(ast::RuleDecl::cast)?.name()
    }
}

/// Whether a token is a name, a keyword or a literal.
pub(crate) fn is_word(token: &SyntaxToken) -> bool {
    token.text().starts_with(|first: char| first.is_alphanumeric() || first == '$' || first == '_' || first == '"')
}

/// The token before, without white space and comments.
pub(crate) fn previous(token: &SyntaxToken) -> Option<SyntaxToken> {
    std::iter::successors(token.prev_token(), SyntaxToken::prev_token).find(|token| !token.kind().is_trivia())
}

fn is_target(term: &SyntaxNode, token: &SyntaxToken) -> bool {
    let Some(parent) = term.parent() else { return false };
    let updates = matches!(parent.kind(), SyntaxKind::UPDATE_RULE | SyntaxKind::RETURN_RULE | SyntaxKind::SET_COMMAND);
    let is_name = ast::FunctionTerm::cast(term.clone()).is_none_or(|term| term.name().as_ref() == Some(token));
    updates && is_name && parent.children().next().as_ref() == Some(term)
}

fn declarations(model: &Model) -> BTreeMap<Referent, Span> {
    let mut found = BTreeMap::new();
    for name in model.uses.iter().filter(|name| name.declares) {
        found.entry(name.referent).or_insert(name.span);
    }
    found
}

/// Looks up the terms and rules of a scenario or chart.
struct Fragments<'m> {
    model: &'m mut Model,
    file: FileId,
    names: Vec<Use>,
}

impl Fragments<'_> {
    fn node(&mut self, node: &SyntaxNode) {
        if let Some(set) = ast::SetCommand::cast(node.clone()) {
            if let (Some(target), Some(value)) = (set.target(), set.value()) {
                self.model.check_set(self.file, &target, &value);
            }
            return;
        }
        if let Some(pick) = ast::PickCommand::cast(node.clone()) {
            self.pick(&pick);
        }
        if let Some(link) = ast::Link::cast(node.clone())
            && let Some(name) = link.rule_name()
        {
            self.rule_name(&name);
        }
        for child in node.children() {
            if let Some(rule) = ast::Rule::cast(child.clone()) {
                self.model.check_rule(self.file, &rule);
            } else if let Some(term) = ast::Term::cast(child.clone()) {
                self.model.check_term(self.file, &term);
            } else {
                self.node(&child);
            }
        }
    }

    fn rule_name(&mut self, name: &SyntaxToken) -> Option<model::RuleId> {
        let [only] = self.model.names.rules(name.text()) else { return None };
        let span = Span::new(self.file, name.text_range());
        self.names.push(Use { span, referent: Referent::Rule(*only), declares: false });
        Some(*only)
    }

    fn pick(&mut self, pick: &ast::PickCommand) {
        let rule = pick.rule().and_then(|name| self.rule_name(&name));
        let Some(token) = pick.variable() else { return };
        let mut found: Vec<Referent> = Vec::new();
        for (index, declared) in self.model.rules.iter().enumerate() {
            if rule.is_some_and(|rule| rule.0 as usize != index) || (rule.is_none() && pick.rule().is_some()) {
                continue;
            }
            declared.body.walk(&mut |node| {
                let RuleKind::Choose { binders, .. } = &node.kind else { return };
                let variables = binders.iter().map(|binder| &declared.variables[binder.variable.0 as usize]);
                let named = variables.filter(|variable| variable.name == token.text());
                found.extend(named.map(|variable| Referent::Variable(variable.span, variable.domain)));
            });
        }
        let span = Span::new(self.file, token.text_range());
        self.names.extend(found.into_iter().map(|referent| Use { span, referent, declares: false }));
    }
}
