//! The tree of a scenario → a [`Script`]: fragments checked against the model and lowered into its program.
//!
//! In: a scenario's tree, the model and the program of the model it loads, both grown by the fragments. Out: the
//! script, or all faults.

use model::{Model, RuleId, RuleKind, RuleNode, Target, Variable, VariableId};
use program::{Expression, Program};
use syntax::ast::{self, AstNode, Command, PickCommand, ScenarioFile};
use syntax::{Diagnostic, FileId, Severity, Sources, Span, SyntaxToken};

use crate::expand::{Blocks, Expansion};
use crate::script::{Action, Expectation, Group, GroupParts, Invariant, Pick, Script, Set, StepKind};

/// A scenario's text, parsed.
#[derive(Debug, Clone)]
pub struct Parsed {
    /// The tree.
    pub tree: Option<ScenarioFile>,
    /// The file.
    pub file: FileId,
    /// The path after `load`, and its place.
    pub model: Option<(String, Span)>,
    /// Faults of the text.
    pub diagnostics: Vec<Diagnostic>,
}

/// Parses a scenario that is already among the sources.
pub fn parse(sources: &Sources, file: FileId) -> Parsed {
    let parsed = syntax::parse_avalla(file, &sources.file(file).text);
    let foreign = sources.file(file).foreign.map(|foreign| foreign.warning(file));
    let diagnostics = foreign.into_iter().chain(parsed.diagnostics.iter().cloned()).collect();
    let tree = ScenarioFile::cast(parsed.syntax());
    let path = tree.as_ref().and_then(|tree| Some((tree.model_path()?, tree.model_token()?)));
    let model = path.map(|(path, token)| (path, Span::new(file, token.text_range())));
    Parsed { tree, file, model, diagnostics }
}

fn has_errors(diagnostics: &[Diagnostic]) -> bool {
    diagnostics.iter().any(|diagnostic| diagnostic.severity == Severity::Error)
}

/// Resolves a parsed scenario against the model it loads.
///
/// # Errors
/// The faults found, at least one of them an error. If there are only warnings, they come with the script.
pub fn resolve(
    parsed: &Parsed,
    model: &mut Model,
    program: &mut Program,
    sources: &mut Sources,
    blocks: &mut dyn Blocks,
) -> Result<(Script, Vec<Diagnostic>), Vec<Diagnostic>> {
    let mut faults = parsed.diagnostics.clone();
    let Some(tree) = &parsed.tree else { return Err(faults) };
    let (commands, expansion_faults) = Expansion::new(sources, blocks).expand(tree, parsed.file);
    faults.extend(expansion_faults);
    let mut resolver = Resolver { model, program, faults, groups: Vec::new(), open: GroupParts::default() };
    let invariants = tree.invariants().filter_map(|invariant| resolver.invariant(&invariant, parsed.file)).collect();
    for (command, file) in &commands {
        resolver.command(command, *file);
    }
    resolver.close(StepKind::End);
    let expectation = tree.expectation().map(|expect| Expectation {
        expected: expect.expected(),
        invariant: expect.invariant().map(|name| name.text().to_string()),
        span: Span::new(parsed.file, expect.range()),
    });
    let place =
        tree.name().map_or(Span { file: parsed.file, start: 0, end: 0 }, |n| Span::new(parsed.file, n.text_range()));
    let name = tree.name().map(|name| name.text().to_string()).unwrap_or_default();
    let Resolver { faults, groups, .. } = resolver;
    if has_errors(&faults) {
        return Err(faults);
    }
    Ok((Script { name, span: place, expectation, invariants, groups }, faults))
}

struct Resolver<'a> {
    model: &'a mut Model,
    program: &'a mut Program,
    faults: Vec<Diagnostic>,
    groups: Vec<Group>,
    open: GroupParts,
}

impl Resolver<'_> {
    fn close(&mut self, step: StepKind) {
        let parts = std::mem::take(&mut self.open);
        self.groups.push(Group { parts, step });
    }

    fn command(&mut self, command: &Command, file: FileId) {
        match command {
            Command::Check(check) => {
                let span = place(check, file);
                if let Some(formula) = self.condition(check.term(), file, "the condition of `check`") {
                    self.open.actions.push(Action::Check { strict: check.is_strict(), formula, span });
                }
            }
            Command::Set(set) => {
                let span = place(set, file);
                if let Some(set) = self.set(set.target(), set.value(), file, span) {
                    self.open.sets.push(set);
                }
            }
            Command::Exec(exec) => {
                let span = place(exec, file);
                if let Some(procedure) = exec.rule().and_then(|rule| self.rule(&rule, file)) {
                    self.open.actions.push(Action::Exec { procedure, span });
                }
            }
            Command::Pick(pick) => {
                if let Some(pick) = self.pick(pick, file) {
                    self.open.picks.push(pick);
                }
            }
            Command::Step(step) => {
                let span = place(step, file);
                let count = step.count().and_then(|count| self.number(&count, file)).unwrap_or(1);
                self.close(StepKind::Steps { count, span });
            }
            Command::StepUntil(until) => {
                let span = place(until, file);
                let bound = until.bound().and_then(|bound| self.number(&bound, file));
                if let Some(condition) = self.condition(until.term(), file, "the condition of `step until`") {
                    self.close(StepKind::Until { condition, bound, span });
                }
            }
            Command::ExpectStep(expect) => {
                self.close(StepKind::Trouble { expected: expect.expected(), span: place(expect, file) });
            }
            // Expanded before.
            Command::Block(_) | Command::ExecBlock(_) => {}
        }
    }

    fn number(&mut self, token: &SyntaxToken, file: FileId) -> Option<u64> {
        match token.text().parse() {
            Ok(number) => Some(number),
            Err(_) => {
                let span = Span::new(file, token.text_range());
                self.faults.push(Diagnostic::error("number-too-large", span, "this number does not fit 64 bits"));
                None
            }
        }
    }

    fn invariant(&mut self, invariant: &ast::ScenarioInvariant, file: FileId) -> Option<Invariant> {
        let name = invariant.name().map(|name| name.text().to_string()).unwrap_or_default();
        let formula = self.condition(invariant.term(), file, "an invariant")?;
        let reads_monitored = self.program.reads_monitored(&formula);
        Some(Invariant { name, formula, reads_monitored, span: place(invariant, file) })
    }

    fn condition(&mut self, term: Option<ast::Term>, file: FileId, what: &str) -> Option<Expression> {
        let fragment = self.model.check_condition(file, &term?, what);
        self.lower(&fragment.item, &fragment.variables, fragment.diagnostics)
    }

    fn lower(&mut self, term: &model::Term, variables: &[Variable], faults: Vec<Diagnostic>) -> Option<Expression> {
        let bad = has_errors(&faults);
        self.faults.extend(faults);
        if bad {
            return None;
        }
        match program::lower_term(self.program, self.model, term, variables) {
            Ok(expression) => Some(expression),
            Err(faults) => {
                self.faults.extend(faults);
                None
            }
        }
    }

    fn set(&mut self, target: Option<ast::Term>, value: Option<ast::Term>, file: FileId, span: Span) -> Option<Set> {
        let fragment = self.model.check_set(file, &target?, &value?);
        let bad = has_errors(&fragment.diagnostics);
        self.faults.extend(fragment.diagnostics);
        let (Target::Location { function, arguments, .. }, value) = fragment.item? else { return None };
        if bad {
            return None;
        }
        let variables = &fragment.variables;
        let arguments =
            arguments.iter().map(|argument| self.lower(argument, variables, Vec::new())).collect::<Option<_>>()?;
        let value = self.lower(&value, variables, Vec::new())?;
        Some(Set { function, arguments, value, span })
    }

    fn rule(&mut self, rule: &ast::Rule, file: FileId) -> Option<program::ProcedureId> {
        let mut fragment = self.model.check_rule(file, rule);
        let faults = std::mem::take(&mut fragment.diagnostics);
        let bad = has_errors(&faults);
        self.faults.extend(faults);
        if bad {
            return None;
        }
        match program::lower_rule(self.program, self.model, &fragment.into_rule()) {
            Ok(procedure) => Some(procedure),
            Err(faults) => {
                self.faults.extend(faults);
                None
            }
        }
    }

    fn pick(&mut self, pick: &PickCommand, file: FileId) -> Option<Pick> {
        let variable = pick.variable()?;
        let name = variable.text().to_string();
        let rule = pick.rule().map(|rule| rule.text().to_string());
        let domains: Vec<String> = pick.domains().map(|domain| domain.syntax().text().to_string()).collect();
        let found = choices_binding(self.model, &name, rule.as_deref(), &domains);
        let place = place(pick, file);
        let Some((_, _, domain)) = found.first() else {
            let whose =
                rule.map_or("no choose rule of the model".to_string(), |rule| format!("no choose rule in {rule}"));
            let span = Span::new(file, variable.text_range());
            self.faults.push(Diagnostic::error("unknown-pick", span, format!("{whose} binds {name}")));
            return None;
        };
        if rule.is_none() && found.iter().any(|(span, ..)| *span != found[0].0) {
            let mut fault = Diagnostic::error("ambiguous-pick", place, format!("several choose rules bind {name}"))
                .with_help(format!("say which rule is meant: `pick {name} in r_… := …`"));
            for (span, ..) in &found {
                fault = fault.with_label(*span, "this one binds it");
            }
            self.faults.push(fault);
            return None;
        }
        let fragment = self.model.check_value(file, &pick.value()?, *domain, &name);
        let value = self.lower(&fragment.item, &fragment.variables, fragment.diagnostics)?;
        let choices = found.into_iter().map(|(span, place, _)| (span, place)).collect();
        Some(Pick { variable: name, choices, value, span: place })
    }
}

fn place(node: &impl AstNode, file: FileId) -> Span {
    Span::new(file, node.range())
}

/// The choose rules that bind a variable: place, which of the variables bound it is, and its domain.
fn choices_binding(
    model: &Model,
    name: &str,
    rule: Option<&str>,
    domains: &[String],
) -> Vec<(Span, usize, model::DomainId)> {
    let mut found = Vec::new();
    // Without domains, the rule without parameters is meant, if there is one.
    let plain =
        model.rules.iter().any(|declared| Some(declared.name.as_str()) == rule && declared.parameters.is_empty());
    for (index, declared) in model.rules.iter().enumerate() {
        let fits = rule.is_none_or(|rule| declared.name == rule)
            && ((domains.is_empty() && !plain) || parameter_domains(model, RuleId(index as u32)) == domains)
            || (rule.is_none() && domains.is_empty());
        if fits {
            each_choose(&declared.body, &mut |node, binders| {
                let place = binders.iter().position(|id| declared.variables[id.0 as usize].name == name);
                if let Some(place) = place {
                    let variable = &declared.variables[binders[place].0 as usize];
                    found.push((node.span, place, variable.domain));
                }
            });
        }
    }
    found
}

fn parameter_domains(model: &Model, rule: RuleId) -> Vec<String> {
    let rule = model.rule(rule);
    let domain = |id: &VariableId| model.domains.display(rule.variables[id.0 as usize].domain);
    rule.parameters.iter().map(domain).collect()
}

/// Visits every choose rule of a body.
fn each_choose(body: &RuleNode, visit: &mut dyn FnMut(&RuleNode, &[VariableId])) {
    body.walk(&mut |node| {
        if let RuleKind::Choose { binders, .. } = &node.kind {
            let variables: Vec<VariableId> = binders.iter().map(|binder| binder.variable).collect();
            visit(node, &variables);
        }
    });
}
