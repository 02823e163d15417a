//! Lowering: the checked model → the IR.
//!
//! In: a complete model. Out: a [`Program`] that [`crate::verify()`] accepts, or the limits that were passed. A fault
//! left in an incomplete model becomes undef or skip; nothing here panics on it.
//!
//! Bodies are lowered one at a time, each in its own frame. Definitions and formulas are lowered at once, rules from
//! a queue ([`call`]), so chains of calls cost no stack. Macro rules are called by name (Börger & Stärk
//! 2003, section 2.4.4): [`argument`] says what that means for a frame of slots.

mod arena;
mod argument;
mod builtin;
mod call;
mod constant;
mod domains;
mod environment;
mod fragment;
mod functions;
mod initial;
mod meaning;
mod number;
mod property;
mod result;
mod rule;
mod term;

use std::collections::{BTreeMap, VecDeque};
use std::rc::Rc;

use model::{FunctionId, Model, Term};
use syntax::{Diagnostic, Span};

use crate::ir::{ArgumentId, Expression, MAX_DEPTH, Program, RuleId, TermId};

pub use fragment::{lower_location, lower_rule, lower_term};

use argument::Argument;
use constant::ConstantKey;
use environment::{Environment, Frame};
use meaning::Meaning;

/// The ids of the faults that lowering may report; each has a page `spec/faults/<id>.md`.
pub const IDS: &[&str] = &["model-too-large", "not-a-location"];

/// LIMIT: the number of procedures, each a rule specialised on its arguments.
const MAX_PROCEDURES: usize = 100_000;
/// LIMIT: the number of terms and rules.
const MAX_NODES: usize = 2_000_000;
/// LIMIT: the depth to which lowering nests. An application can add a coercion, so this is half of what the IR allows.
const MAX_NESTING: u32 = MAX_DEPTH / 2;
/// The stack that one level needs, and how much is added when less is free.
const RED_ZONE: usize = 64 * 1024;
const STACK_PIECE: usize = 1024 * 1024;

/// Lowers a checked model.
///
/// ```
/// # struct NoFiles;
/// # impl model::Loader for NoFiles {
/// #     fn load(&mut self, _: &syntax::SourceFile, path: &str) -> Result<syntax::SourceFile, String> {
/// #         Err(path.to_string())
/// #     }
/// # }
/// let text = "asm counter
///     import StandardLibrary
///     signature: controlled n: Integer
///     definitions: main rule r_Main = n := n + 1
///     default init s: function n = 0";
/// let checked = model::check(syntax::SourceFile::new("counter.asm", text), &mut NoFiles);
/// let program = program::lower(&checked.model).unwrap();
/// assert!(program::dump(&program).contains("n := IntAdd(n, 1)"));
/// ```
///
/// # Errors
/// `model-too-large` if the calls by name need more procedures or terms than the limits allow; `not-a-location` if a
/// rule that assigns its parameter is run with a value for it.
pub fn lower(model: &Model) -> Result<Program, Vec<Diagnostic>> {
    let mut program = Program { name: model.name.clone(), asynchronous: model.asynchronous, ..Program::default() };
    let mut lowering = Lowering::new(model, &mut program);
    lowering.lower_signature();
    lowering.lower_main();
    lowering.lower_static_contents(0);
    lowering.lower_function_definitions(0);
    lowering.lower_initial_state();
    lowering.lower_properties();
    lowering.finish()?;
    Ok(program)
}

/// The state of a lowering: the tables being filled, and the body being lowered.
struct Lowering<'m, 'p> {
    model: &'m Model,
    program: &'p mut Program,
    /// The index of each literal in the pool.
    constants: BTreeMap<ConstantKey, u32>,
    /// The meaning of an application of each function, as far as it was needed.
    meanings: BTreeMap<FunctionId, Meaning>,
    /// The by-name arguments found so far.
    arguments: BTreeMap<ArgumentId, Rc<Argument<'m>>>,
    /// Procedures whose bodies are still to be lowered.
    pending: VecDeque<call::Pending<'m>>,
    diagnostics: Vec<Diagnostic>,
    /// Set once a limit is passed; it then replaces every term and rule.
    stopped: Option<(TermId, RuleId)>,
    /// The meaning of the variables of the term or rule being lowered.
    environment: Environment<'m>,
    /// The slots of the body being lowered.
    frame: Frame,
    /// The depth within the body.
    depth: u32,
    /// What replaces `result` in the body.
    place: Option<result::Place>,
    /// What rules do, as far as it was needed.
    reaches: BTreeMap<model::RuleId, Rc<result::Reach>>,
}

impl<'m, 'p> Lowering<'m, 'p> {
    fn new(model: &'m Model, program: &'p mut Program) -> Self {
        let keys = program.constants.iter().map(ConstantKey::of);
        let constants = keys.zip(0..).collect();
        Lowering {
            model,
            program,
            constants,
            meanings: BTreeMap::new(),
            arguments: BTreeMap::new(),
            pending: VecDeque::new(),
            diagnostics: Vec::new(),
            stopped: None,
            environment: Environment::default(),
            frame: Frame::default(),
            depth: 0,
            place: None,
            reaches: BTreeMap::new(),
        }
    }

    /// Adds the domains and functions that the program does not have yet, without their defining terms.
    fn lower_signature(&mut self) {
        self.lower_domains();
        self.lower_functions();
    }

    /// Adds the main rule, which is then the first procedure.
    fn lower_main(&mut self) {
        self.program.main = self.model.main.map(|rule| self.procedure_by_value(rule));
    }

    /// Lowers the bodies that are still pending; returns the faults, if any.
    fn finish(mut self) -> Result<(), Vec<Diagnostic>> {
        while let Some(pending) = self.pending.pop_front() {
            self.lower_pending(pending);
        }
        if self.diagnostics.is_empty() {
            debug_assert_eq!(crate::verify(self.program), Ok(()), "the lowered program is well formed");
            return Ok(());
        }
        Err(self.diagnostics)
    }

    /// Lowers a term in a frame of its own; the parameters are its first slots.
    fn lower_expression(
        &mut self,
        variables: &'m [model::Variable],
        parameters: &[model::VariableId],
        body: &'m Term,
    ) -> Expression {
        self.enter(variables);
        for parameter in parameters {
            self.bind(*parameter, body.domain);
        }
        let parameters = self.frame.domains.clone();
        let body = self.lower_term(body);
        let names = std::mem::take(&mut self.frame).names;
        Expression { parameters, frame: names.len() as u32, names, body }
    }

    /// Starts a body with an empty frame.
    fn enter(&mut self, variables: &'m [model::Variable]) {
        self.environment = Environment { variables, bindings: BTreeMap::new() };
        self.frame = Frame::default();
        self.depth = 0;
        self.place = None;
    }

    /// Lowers something one level deeper.
    fn nested<T>(&mut self, span: Span, lower: impl FnOnce(&mut Self) -> T) -> T {
        self.depth += 1;
        if self.depth > MAX_NESTING {
            self.stop(span, format!("terms or rules nest more than {MAX_NESTING} deep here"));
        }
        let result = stacker::maybe_grow(RED_ZONE, STACK_PIECE, || lower(self));
        self.depth -= 1;
        result
    }

    /// Reports once that a limit is passed; from then on nothing is lowered.
    fn stop(&mut self, span: Span, message: String) {
        if self.stopped.is_some() {
            return;
        }
        let help = "arguments of macro rules are substituted in the rule's body; \
                    bind large ones by `let` before the call";
        self.diagnostics
            .push(Diagnostic::error("model-too-large", span, message).here("the limit is passed here").with_help(help));
        self.stopped = Some(self.sentinels(span));
    }
}
