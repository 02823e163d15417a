//! Executes a rule symbolically for one value of its control variable: what it does under which conditions.
//!
//! In: a checked model, a rule, a control location and a value for it. Out: [`Guarded`] effects: each is an update or
//! another rule, with the tests on its path. Macro calls and definitions are expanded where it matters, by name, as in
//! the machine; differently nested `if`, `switch` and `let` give the same result. Tests of the control location are
//! decided; all others are atoms, distinguished by their text.
//!
//! Conditions stay terms of the model and are not passed to `solve`. Differences are reported in the words of the chart
//! and of the rule, which the IR no longer has; and charts and rules that should agree use the same words. Only the
//! encoder's connectives would help here: its subject (numbers, undef, faults) lies inside of atoms.
//!
//! LIMIT: a rule inside `seq`, `forall`, `choose` and the like is one effect as a whole; if it sets the control
//! location, that is [`Reason::Hidden`]. Calls are followed up to [`MAX_DEPTH`], and at most [`MAX_EFFECTS`] effects
//! are kept.

mod condition;
mod print;

use std::cell::Cell;
use std::rc::Rc;

use model::{
    Call, FunctionId, FunctionKind, Literal, Model, RuleId, RuleKind, RuleNode, Target, Term, TermKind, Variable,
};
use syntax::Span;

pub(crate) use condition::{Path, consistent, joined};

/// How deeply calls are followed.
const MAX_DEPTH: usize = 64;
/// How many effects of one rule are kept.
const MAX_EFFECTS: usize = 4096;

/// The variables of a declaration, and their arguments.
pub(crate) struct Frame<'m> {
    variables: &'m [Variable],
    bound: Vec<Option<Bound<'m>>>,
}

/// The argument of a variable.
#[derive(Clone)]
struct Bound<'m> {
    text: String,
    term: Option<(&'m Term, Rc<Frame<'m>>)>,
}

/// What a rule does.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Effect {
    /// An update.
    Update {
        /// The location.
        location: String,
        /// The new value.
        value: String,
        /// Whether the new value is a literal or undef.
        constant: bool,
    },
    /// Another rule.
    Rule(String),
}

/// An effect with the tests on its path.
#[derive(Debug, Clone)]
pub(crate) struct Guarded {
    /// The tests, in the order in which they are made.
    pub(crate) path: Path,
    /// What is done.
    pub(crate) effect: Effect,
    /// Its place.
    pub(crate) span: Span,
}

/// Why a rule is not in control-state form.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Reason {
    /// It sets the control location inside `seq`, `forall`, `choose` or the like.
    Hidden(Span),
    /// It sets the control location to something other than a literal or undef.
    Computed(Span),
    /// It is too large.
    Large,
}

/// Which macro calls are expanded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Depth {
    /// Those that read or set the control location.
    Control,
    /// All of them.
    Full,
}

/// Symbolic execution with one value of one control location.
pub(crate) struct Explorer<'m> {
    pub(crate) model: &'m Model,
    /// The function of the control location.
    pub(crate) function: FunctionId,
    /// The control location, as [`Explorer::print`] writes it.
    pub(crate) control: String,
    /// Its value, which may be `undef`.
    pub(crate) origin: String,
    pub(crate) depth: Depth,
    /// How often the control location has been read.
    reads: Cell<usize>,
}

impl<'m> Explorer<'m> {
    pub(crate) fn new(model: &'m Model, function: FunctionId, control: String, origin: String, depth: Depth) -> Self {
        Explorer { model, function, control, origin, depth, reads: Cell::new(0) }
    }

    /// What a rule does, with these names for its parameters, if it has any.
    ///
    /// # Errors
    /// It is not in control-state form.
    pub(crate) fn rule(&self, rule: RuleId, names: &[String]) -> Result<Vec<Guarded>, Reason> {
        let declared = self.model.rule(rule);
        let mut bound: Vec<Option<Bound<'m>>> = vec![None; declared.variables.len()];
        for (parameter, name) in declared.parameters.iter().zip(names) {
            bound[parameter.0 as usize] = Some(Bound { text: name.clone(), term: None });
        }
        let frame = Rc::new(Frame { variables: &declared.variables, bound });
        let mut effects = Vec::new();
        self.effects(&declared.body, &frame, &Vec::new(), 0, &mut effects)?;
        Ok(effects)
    }

    /// How often the control location has been read.
    pub(crate) fn reads(&self) -> usize {
        self.reads.get()
    }

    fn effects(
        &self,
        rule: &'m RuleNode,
        frame: &Rc<Frame<'m>>,
        path: &Path,
        depth: usize,
        out: &mut Vec<Guarded>,
    ) -> Result<(), Reason> {
        if depth > MAX_DEPTH || out.len() > MAX_EFFECTS {
            return Err(Reason::Large);
        }
        stacker::maybe_grow(128 << 10, 2 << 20, || self.effects_here(rule, frame, path, depth, out))
    }

    fn effects_here(
        &self,
        rule: &'m RuleNode,
        frame: &Rc<Frame<'m>>,
        path: &Path,
        depth: usize,
        out: &mut Vec<Guarded>,
    ) -> Result<(), Reason> {
        match &rule.kind {
            RuleKind::Skip => Ok(()),
            RuleKind::Par(rules) => rules.iter().try_for_each(|rule| self.effects(rule, frame, path, depth + 1, out)),
            RuleKind::Seq(rules) if rules.len() == 1 => self.effects(&rules[0], frame, path, depth + 1, out),
            RuleKind::Update { target: Target::Location { function, arguments, .. }, value } => {
                let location = self.applied(*function, arguments, frame);
                let constant = self.constant(value, frame);
                if location == self.control && constant.is_none() {
                    return Err(Reason::Computed(value.span));
                }
                let value = constant.clone().unwrap_or_else(|| self.print(value, frame));
                let effect = Effect::Update { location, value, constant: constant.is_some() };
                out.push(Guarded { path: path.clone(), effect, span: rule.span });
                Ok(())
            }
            RuleKind::MacroCall(call) => self.call(rule, call, frame, path, depth, out),
            RuleKind::Let { bindings, body } => {
                let mut frame = Rc::new(Frame { variables: frame.variables, bound: frame.bound.clone() });
                for (variable, term) in bindings {
                    let mut bound = frame.bound.clone();
                    bound[variable.0 as usize] =
                        Some(Bound { text: self.print(term, &frame), term: Some((term, Rc::clone(&frame))) });
                    frame = Rc::new(Frame { variables: frame.variables, bound });
                }
                self.effects(body, &frame, path, depth + 1, out)
            }
            RuleKind::If { .. } | RuleKind::Switch { .. } => {
                let (before, mut inner) = (self.reads.get(), Vec::new());
                self.branches(rule, frame, path, depth, &mut inner)?;
                let matters = self.reads.get() > before || inner.iter().any(|guarded| self.sets_control(guarded));
                // A test that earlier tests decide does not count as a test.
                let decided = inner.iter().all(|guarded| guarded.path == *path);
                if matters || decided || self.depth == Depth::Full {
                    out.extend(inner);
                    Ok(())
                } else {
                    self.whole(rule, frame, path, out)
                }
            }
            _ => self.whole(rule, frame, path, out),
        }
    }

    fn sets_control(&self, guarded: &Guarded) -> bool {
        matches!(&guarded.effect, Effect::Update { location, .. } if *location == self.control)
    }

    /// A rule as one effect.
    fn whole(
        &self,
        rule: &'m RuleNode,
        frame: &Rc<Frame<'m>>,
        path: &Path,
        out: &mut Vec<Guarded>,
    ) -> Result<(), Reason> {
        let compound = !matches!(rule.kind, RuleKind::If { .. } | RuleKind::Switch { .. });
        let mut hidden = None;
        if compound {
            self.find_update(rule, 0, &mut hidden);
        }
        match hidden {
            Some(span) => Err(Reason::Hidden(span)),
            None => {
                let effect = Effect::Rule(self.print_rule(rule, frame));
                out.push(Guarded { path: path.clone(), effect, span: rule.span });
                Ok(())
            }
        }
    }

    /// Finds an update of the control function in a rule, including calls.
    fn find_update(&self, rule: &'m RuleNode, depth: usize, found: &mut Option<Span>) {
        rule.walk(&mut |rule| match &rule.kind {
            RuleKind::Update { target: Target::Location { function, .. }, .. } if *function == self.function => {
                *found = Some(rule.span);
            }
            RuleKind::MacroCall(Call { rule, .. }) | RuleKind::TurboCall(Call { rule, .. }) if depth < 8 => {
                self.find_update(&self.model.rule(*rule).body, depth + 1, found);
            }
            _ => {}
        });
    }

    fn call(
        &self,
        rule: &'m RuleNode,
        call: &'m Call,
        frame: &Rc<Frame<'m>>,
        path: &Path,
        depth: usize,
        out: &mut Vec<Guarded>,
    ) -> Result<(), Reason> {
        let declared = self.model.rule(call.rule);
        let mut bound: Vec<Option<Bound<'m>>> = vec![None; declared.variables.len()];
        for (parameter, argument) in declared.parameters.iter().zip(&call.arguments) {
            bound[parameter.0 as usize] =
                Some(Bound { text: self.print(argument, frame), term: Some((argument, Rc::clone(frame))) });
        }
        let inside = Rc::new(Frame { variables: &declared.variables, bound });
        let before = self.reads.get();
        let mut inner = Vec::new();
        self.effects(&declared.body, &inside, path, depth + 1, &mut inner)?;
        let matters = self.reads.get() > before || inner.iter().any(|guarded| self.sets_control(guarded));
        if matters || self.depth == Depth::Full {
            out.extend(inner);
        } else {
            let effect = Effect::Rule(self.print_rule(rule, frame));
            out.push(Guarded { path: path.clone(), effect, span: rule.span });
        }
        Ok(())
    }

    fn branches(
        &self,
        rule: &'m RuleNode,
        frame: &Rc<Frame<'m>>,
        path: &Path,
        depth: usize,
        out: &mut Vec<Guarded>,
    ) -> Result<(), Reason> {
        // The paths on which no branch was taken so far.
        let mut open: Vec<Path> = vec![path.clone()];
        let otherwise = match &rule.kind {
            RuleKind::If { branches, otherwise } => {
                for (guard, body) in branches {
                    self.branch(self.condition(guard, frame, 0), body, frame, depth, &mut open, out)?;
                }
                otherwise
            }
            RuleKind::Switch { subject, cases, otherwise } => {
                for (value, body) in cases {
                    self.branch(self.equality(subject, value, frame), body, frame, depth, &mut open, out)?;
                }
                otherwise
            }
            _ => return Ok(()),
        };
        match otherwise {
            Some(rule) => open.iter().try_for_each(|path| self.effects(rule, frame, path, depth + 1, out)),
            None => Ok(()),
        }
    }

    fn branch(
        &self,
        ways: Vec<(Path, bool)>,
        body: &'m RuleNode,
        frame: &Rc<Frame<'m>>,
        depth: usize,
        open: &mut Vec<Path>,
        out: &mut Vec<Guarded>,
    ) -> Result<(), Reason> {
        let mut rest = Vec::new();
        for path in std::mem::take(open) {
            for (way, holds) in &ways {
                let Some(joined) = condition::joined(&path, way) else { continue };
                if *holds {
                    self.effects(body, frame, &joined, depth + 1, out)?;
                } else {
                    rest.push(joined);
                }
            }
        }
        if rest.len() > MAX_EFFECTS {
            return Err(Reason::Large);
        }
        *open = rest;
        Ok(())
    }

    /// The constant value of a term, where the control location counts as one.
    fn constant(&self, term: &'m Term, frame: &Rc<Frame<'m>>) -> Option<String> {
        match &term.kind {
            TermKind::Literal(Literal::Undef | Literal::Enum(..) | Literal::Boolean(_) | Literal::Integer(_)) => {
                Some(self.print(term, frame))
            }
            TermKind::Variable(id) => {
                let (term, frame) = frame.bound[id.0 as usize].as_ref()?.term.as_ref()?;
                self.constant(term, frame)
            }
            TermKind::Apply { function, arguments } if *function == self.function => {
                let location = self.applied(*function, arguments, frame);
                (location == self.control).then(|| {
                    self.reads.set(self.reads.get() + 1);
                    self.origin.clone()
                })
            }
            _ => None,
        }
    }

    /// Whether the definition of a function reads the control function.
    fn reads_control(&self, function: FunctionId, depth: usize) -> bool {
        let declared = self.model.function(function);
        let Some(definition) = declared.definition.as_ref().filter(|_| depth < 16) else { return false };
        if !matches!(declared.kind, FunctionKind::Derived | FunctionKind::Static) {
            return false;
        }
        let mut reads = false;
        definition.body.walk(&mut |term| {
            if let TermKind::Apply { function, .. } = &term.kind {
                reads |= *function == self.function || !reads && self.reads_control(*function, depth + 1);
            }
        });
        reads
    }
}
