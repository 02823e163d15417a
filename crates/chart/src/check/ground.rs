//! The model of a system as tables: its elements, the value of each function for each element, and the few rules and
//! invariants that every such model has.
//!
//! In: the text of a model. Out: a [`Ground`]. Texts with the same meaning have equal tables: layout, comments,
//! parentheses around values, names of variables, the order of cases and the choice of the `otherwise` value do not
//! matter. A function that is defined neither by a value nor by a `switch` over its parameter is kept as text.

use std::collections::BTreeMap;

use syntax::ast::{self, AstNode, Term};
use syntax::{FileId, Span, SyntaxKind, SyntaxNode};

use crate::build::OWNED;
use crate::component::updated;

/// A text without its layout, and its place.
pub(super) type Placed = (String, Span);

/// The tables of a model.
#[derive(Debug, Default)]
pub(super) struct Ground {
    /// The elements of the patterns' domains, with their domains.
    pub(super) elements: BTreeMap<String, Placed>,
    /// Initial values.
    pub(super) given: BTreeMap<String, Given>,
    /// Rules and invariants by name; the main rule and agents as `main rule` and `agent D`.
    pub(super) texts: BTreeMap<String, Placed>,
    /// What rules update: the rule, and the function.
    pub(super) updates: Vec<(String, Placed)>,
    /// Paths of imports.
    pub(super) imports: Vec<String>,
    /// The model's name.
    pub(super) name: Option<Span>,
}

/// The initial values of a function.
#[derive(Debug)]
pub(super) struct Given {
    /// The domains of its parameters.
    pub(super) domains: Vec<String>,
    /// Its values for single elements.
    cases: BTreeMap<String, Placed>,
    /// Its value for all other elements; `None` for undef.
    pub(super) otherwise: Option<Placed>,
    /// Whether it is a value, or a `switch` of values over its parameter.
    pub(super) is_table: bool,
    /// The place of its definition.
    pub(super) span: Span,
}

impl Given {
    /// The value for an element, and its place.
    pub(super) fn at(&self, element: &str) -> (&str, Span) {
        let found = self.cases.get(element).or(self.otherwise.as_ref());
        found.map_or(("undef", self.span), |(text, span)| (text, *span))
    }
}

impl Ground {
    /// Reads the tables of a text.
    pub(super) fn read(file: FileId, text: &str) -> Ground {
        let mut ground = Ground::default();
        let Some(tree) = ast::SourceFile::cast(syntax::parse_asmetal(file, text).syntax()) else { return ground };
        let reader = Reader { file };
        ground.name = tree.machine_name().and_then(|name| name.name()).map(|name| Span::new(file, name.text_range()));
        ground.imports = tree.imports().filter_map(|import| Some(plain(&import.path()?))).collect();
        let declarations = tree.signature().into_iter().flat_map(|signature| signature.functions());
        for function in declarations.filter(|function| function.domain().is_none()) {
            let (Some(name), Some(domain)) = (function.name(), function.codomain()) else { continue };
            let domain = normal(domain.syntax());
            if function.kind() == Some(SyntaxKind::STATIC_KW) && OWNED.contains(&domain.as_str()) {
                let span = Span::new(file, name.text_range());
                ground.elements.insert(name.text().to_string(), (domain, span));
            }
        }
        let definitions = tree.definitions();
        for rule in definitions.iter().flat_map(|definitions| definitions.rules()) {
            let name = rule.name().map(|name| name.text().to_string());
            let all = rule.syntax().descendants().filter(|node| node.kind() == SyntaxKind::UPDATE_RULE);
            let updated = all.filter_map(|update| Some((updated(&update)?, reader.span(&update))));
            ground.updates.extend(updated.map(|update| (name.clone().unwrap_or_default(), update)));
            reader.text(name, rule.syntax(), &mut ground);
        }
        for property in definitions.iter().flat_map(|definitions| definitions.properties()) {
            if let ast::Property::Invariant(invariant) = property {
                reader.text(name_of(invariant.syntax()), invariant.syntax(), &mut ground);
            }
        }
        if let Some(main) = tree.main_rule() {
            reader.text(Some("main rule".to_string()), main.syntax(), &mut ground);
        }
        for init in tree.inits().filter(ast::Init::is_default) {
            for agent in init.agents() {
                let domain = agent.domain().map(|domain| format!("agent {}", domain.text()));
                reader.text(domain, agent.syntax(), &mut ground);
            }
            for function in init.function_defs() {
                let Some(name) = function.name() else { continue };
                ground.given.insert(name.text().to_string(), reader.given(&function));
            }
        }
        ground
    }
}

struct Reader {
    file: FileId,
}

impl Reader {
    fn span(&self, node: &SyntaxNode) -> Span {
        Span::new(self.file, ast::trimmed_range(node))
    }

    fn text(&self, name: Option<String>, node: &SyntaxNode, ground: &mut Ground) {
        if let Some(name) = name {
            ground.texts.insert(name, (normal(node), self.span(node)));
        }
    }

    fn given(&self, function: &ast::FunctionDef) -> Given {
        let parameters: Vec<ast::Parameter> =
            function.parameters().into_iter().flat_map(|list| list.parameters()).collect();
        let domains = parameters.iter().filter_map(|one| one.domain()).map(|domain| normal(domain.syntax())).collect();
        let mut given = Given {
            domains,
            cases: BTreeMap::new(),
            otherwise: None,
            is_table: true,
            span: self.span(function.syntax()),
        };
        let Some(body) = function.body().map(unwrapped) else { return given };
        let variable = match &parameters[..] {
            [one] => one.variable(),
            _ => None,
        };
        match &body {
            Term::Switch(switch)
                if switch
                    .subject()
                    .zip(variable)
                    .is_some_and(|(subject, variable)| normal_text(subject.syntax()) == variable.text()) =>
            {
                for case in switch.cases() {
                    let (Some(element), Some(value)) = (case.value(), case.term()) else { continue };
                    let value = unwrapped(value);
                    given.is_table &= is_value(&value);
                    // The first matching case counts.
                    let place = (normal(value.syntax()), self.span(value.syntax()));
                    given.cases.entry(normal_text(element.syntax())).or_insert(place);
                }
                given.otherwise = switch.otherwise().map(|value| {
                    let value = unwrapped(value);
                    given.is_table &= is_value(&value);
                    (normal(value.syntax()), self.span(value.syntax()))
                });
            }
            value => {
                given.is_table = is_value(value);
                given.otherwise = Some((normal(value.syntax()), self.span(value.syntax())));
            }
        }
        given
    }
}

/// Whether a term does not depend on the parameter.
fn is_value(term: &Term) -> bool {
    !matches!(term, Term::Switch(_) | Term::If(_) | Term::Let(_))
        && !term
            .syntax()
            .descendants_with_tokens()
            .filter_map(|element| element.into_token())
            .any(|token| token.kind() == SyntaxKind::VARIABLE)
}

fn unwrapped(mut term: Term) -> Term {
    while let Term::Paren(paren) = &term {
        match paren.syntax().children().find_map(Term::cast) {
            Some(inner) => term = inner,
            None => break,
        }
    }
    term
}

/// The name of an invariant.
fn name_of(node: &SyntaxNode) -> Option<String> {
    let mut tokens = node.descendants_with_tokens().filter_map(|element| element.into_token());
    tokens.find(|token| token.kind() == SyntaxKind::INVARIANT_ID).map(|token| token.text().to_string())
}

/// An import's path without its optional parts.
pub(super) fn plain(path: &str) -> String {
    path.replace('\\', "/").trim_start_matches("./").trim_end_matches(".asm").to_string()
}

/// The text of a node without its layout.
fn normal_text(node: &SyntaxNode) -> String {
    let tokens = node.descendants_with_tokens().filter_map(|element| element.into_token());
    let words: Vec<String> =
        tokens.filter(|token| !token.kind().is_trivia()).map(|token| token.text().to_string()).collect();
    words.join(" ")
}

/// The text of a node without its layout, with variables numbered in order of appearance.
pub(super) fn normal(node: &SyntaxNode) -> String {
    let mut variables: Vec<String> = Vec::new();
    let mut words = Vec::new();
    for token in node.descendants_with_tokens().filter_map(|element| element.into_token()) {
        if token.kind() == SyntaxKind::VARIABLE {
            let known = variables.iter().position(|known| known == token.text());
            let number = known.unwrap_or_else(|| {
                variables.push(token.text().to_string());
                variables.len() - 1
            });
            words.push(format!("${number}"));
        } else if !token.kind().is_trivia() {
            words.push(token.text().to_string());
        }
    }
    words.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn given(text: &str) -> Vec<String> {
        let text = format!("asm A signature: static a: Task static b: Task definitions: default init s: {text}");
        let ground = Ground::read(FileId(0), &text);
        let values = |given: &Given| ["a", "b"].map(|element| given.at(element).0.to_string()).join(" | ");
        ground.given.iter().map(|(name, given)| format!("{name}: {}, {}", values(given), given.is_table)).collect()
    }

    #[test]
    fn one_meaning_is_one_table() {
        let table = ["task_period: 10 | 5, true"];
        assert_eq!(given("function task_period($t in Task) = switch $t case a: 10 otherwise 5 endswitch"), table);
        assert_eq!(given("function task_period($x in Task)=switch $x case b:(5) otherwise 10 endswitch"), table);
        assert_eq!(
            given("function task_period($x in Task) = switch $x case a: 10 case a: 9 case b: 5 endswitch"),
            table
        );
        assert_eq!(given("function f($t in Task) = if $t = a then 1 endif")[0].rsplit(' ').next(), Some("false"));
        assert_eq!(given("function f($t in Task) = - 3"), ["f: - 3 | - 3, true"]);
    }
}
