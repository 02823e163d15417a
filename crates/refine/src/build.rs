//! Makes a [`Coupling`] from the statements of a file.
//!
//! In: what the file says, the joint model. Out: the coupling and the faults of the file. Terms are checked in the joint model
//! ([`crate::joint`]) as if the file were blank around them, so that faults stand at their places.

mod counterpart;
mod environment;
mod reader;

use std::collections::BTreeSet;
use std::sync::Arc;

use machine::{Limits, Machine};
use model::nearest;
use program::{DomainId, DomainKind, Expression, FunctionId, FunctionKind, Program, Term};
use syntax::ast::{AstNode, TermFile};
use syntax::{Diagnostic, FileId, Severity, SourceFile, Sources, Span};

use crate::coupling::{Conjunct, Coupling, Faulty, Incomparable, LeftOut, start};
use crate::diagram::Diagrams;
use crate::fault::{bad_coupling, vacuous};
use crate::joint::{Joint, described, growing, join, joint_name};
use crate::written::{Part, Written, read};
use crate::{ABSTRACT, CONCRETE, SIDES};

/// LIMIT: so much of a domain is told in a message.
const WORDS: usize = 200;

/// What stands for a file if there is none.
const DEFAULT: &str = "// no coupling file: functions of equal names and domains are equal\n";

impl Coupling {
    /// The coupling that a text says, or the default one if there is none.
    ///
    /// # Errors
    /// The faults of the text.
    pub fn new(
        programs: [&Arc<Program>; 2],
        text: Option<SourceFile>,
        limits: &Limits,
    ) -> Result<Coupling, Box<Faulty>> {
        let source = text.unwrap_or_else(|| SourceFile::new("<default coupling>", DEFAULT));
        let alone = |fault: Diagnostic| {
            let mut sources = Sources::default();
            let file = sources.add(source.clone());
            let mut fault = fault;
            fault.primary.span.file = file;
            Box::new(Faulty { sources, faults: vec![fault] })
        };
        let written = read(FileId(0), &source.text).map_err(|fault| alone(*fault))?;
        let joint = join([&**programs[0], &**programs[1]], limits);
        let joint = joint.map_err(|message| alone(*bad_coupling(start(FileId(0)), message)))?;
        let mut builder = Builder::new(programs, joint, source, limits);
        builder.read(&written);
        let Builder { coupling, faults, .. } = builder;
        match faults.is_empty() {
            true => Ok(coupling),
            false => Err(Box::new(Faulty { sources: coupling.joint.sources, faults })),
        }
    }
}

/// Reads the statements.
struct Builder {
    coupling: Coupling,
    source: SourceFile,
    limits: Limits,
    faults: Vec<Diagnostic>,
}

impl Builder {
    /// For a file that says nothing yet.
    fn new(programs: [&Arc<Program>; 2], mut joint: Joint, source: SourceFile, limits: &Limits) -> Builder {
        let file = joint.sources.add(source.clone());
        let coupling = Coupling {
            programs: programs.map(Arc::clone),
            joint,
            conjuncts: Vec::new(),
            segment: None,
            diagrams: Diagrams::usual(false),
            shared: Default::default(),
            given: Vec::new(),
            computed: Vec::new(),
            readers: Default::default(),
            waiting: false,
            overflow: false,
            fair: Vec::new(),
            variant: None,
            same: Vec::new(),
            left_out: Vec::new(),
            free: Vec::new(),
            inputs: Vec::new(),
            file,
        };
        Builder { coupling, source, limits: limits.clone(), faults: Vec::new() }
    }

    fn fault(&mut self, fault: impl Into<Box<Diagnostic>>) {
        self.faults.push(*fault.into());
    }

    fn place(&self, part: &Part) -> Span {
        Span { file: self.coupling.file, ..part.span }
    }

    /// Reads all statements.
    fn read(&mut self, written: &Written) {
        let usual = Diagrams::usual(written.segment.is_some());
        self.coupling.diagrams = written.diagrams.clone().unwrap_or(usual);
        self.coupling.waiting = written.waiting;
        self.coupling.overflow = written.overflow;
        if written.same.is_empty() && written.couples.is_empty() {
            self.same_by_default();
        }
        for (place, part) in written.same.iter().enumerate() {
            if written.same[..place].iter().any(|other| other.text == part.text) {
                let place = self.place(part);
                self.fault(bad_coupling(place, format!("`{}` is the same twice", part.text)));
                continue;
            }
            self.same(part);
        }
        let mut looked_at = [!self.coupling.same.is_empty(); 2];
        for part in &written.couples {
            let Some(formula) = self.condition(part) else { continue };
            for (side, looked) in looked_at.iter_mut().enumerate() {
                *looked |= !self.functions_of(&formula, side).is_empty();
            }
            self.coupling.conjuncts.push(Conjunct::Term { text: part.text.clone(), formula });
        }
        if let Some(part) = &written.segment
            && let Some(formula) = self.condition(part)
        {
            self.concrete_only(&formula, "a segment ends", "the concrete machine's state alone");
            self.coupling.segment = Some(formula);
        }
        if let Some(part) = &written.variant {
            self.variant(part, written.waiting);
        }
        self.fairness(written);
        self.inputs(written);
        if !self.faults.is_empty() {
            return;
        }
        if let Some(side) = looked_at.iter().position(|looked| !looked) {
            let message =
                format!("nothing is observed: the coupling looks at no function of the {} machine", SIDES[side]);
            let place = written.couples.first().map_or(start(self.coupling.file), |part| self.place(part));
            let help = "no function has the same name and the same domains in both: say with `couple` what corresponds";
            let fault = vacuous(place, message);
            self.faults.push(if written.couples.is_empty() { fault.with_help(help) } else { fault });
        }
    }

    /// Couples all functions of equal names and domains.
    fn same_by_default(&mut self) {
        let one = Arc::clone(&self.coupling.programs[ABSTRACT]);
        let mut pairs = BTreeSet::new();
        for (here, function) in (0..).map(FunctionId).zip(&one.functions).filter(|(_, function)| is_state(function)) {
            let there = match self.counterpart(here, is_state) {
                Ok(Some(there)) => there,
                Ok(None) => {
                    let why = self.incomparable(here);
                    self.coupling.left_out.extend(why.map(|why| LeftOut { name: function.name.clone(), why }));
                    continue;
                }
                Err(fault) => {
                    self.fault(fault);
                    continue;
                }
            };
            let made =
                [(ABSTRACT, here), (CONCRETE, there)].into_iter().find_map(|(side, f)| self.grows(side, f, false));
            match made {
                Some(domain) => {
                    let why = Incomparable::Made(domain);
                    self.coupling.left_out.push(LeftOut { name: function.name.clone(), why });
                }
                None => _ = pairs.insert((function.name.clone(), [here, there])),
            }
        }
        for (name, functions) in pairs {
            self.add_same(name, functions);
        }
    }

    /// The domains of a function's parameters and values, in words.
    fn domains(&self, side: usize, function: FunctionId) -> Vec<String> {
        let program = &self.coupling.programs[side];
        let function = program.function(function);
        let all = function.parameters.iter().chain([&function.codomain]);
        all.map(|domain| described(program, &self.limits, *domain)).collect()
    }

    /// The first domain of a function that is another one in the other machine, in words; none if all are the same.
    fn other_domain(&self, here: FunctionId, there: FunctionId) -> Option<[String; 2]> {
        let pairs = self.domains(ABSTRACT, here).into_iter().zip(self.domains(CONCRETE, there));
        let differing = pairs.map(|(one, other)| [one, other]).find(|[one, other]| one != other);
        differing.map(|both| both.map(|words| if words.len() > WORDS { shortened(&words) } else { words }))
    }

    fn same(&mut self, part: &Part) {
        let place = self.place(part);
        let [one, other] = self.coupling.programs.clone();
        let of = |program: &Program| -> Vec<FunctionId> {
            let all = (0..).map(FunctionId).zip(&program.functions);
            all.filter(|(_, function)| function.name == part.text && !function.library).map(|(id, _)| id).collect()
        };
        let (here, there) = (of(&one), of(&other));
        for (found, side) in [(&here, ABSTRACT), (&there, CONCRETE)] {
            if found.is_empty() {
                let message = format!("the {} machine has no function `{}`", SIDES[side], part.text);
                let fault = bad_coupling(place, message);
                let close = nearest(&part.text, names(&self.coupling.programs[side]));
                return match close.map(|close| format!("did you mean `{close}`?")) {
                    Some(help) => self.fault(fault.with_help(help)),
                    None => self.fault(fault),
                };
            }
        }
        let arity = |program: &Program, id: FunctionId| program.function(id).parameters.len();
        let mut pairs = Vec::new();
        for here in here {
            // Of several with a name and as many arguments those with the same domains are meant.
            match self.counterpart(here, |function| !function.library) {
                Ok(Some(there)) => pairs.push([here, there]),
                Ok(None) => {
                    let fits = |there: &&FunctionId| arity(&one, here) == arity(&other, **there);
                    pairs.extend(there.iter().filter(fits).map(|there| [here, *there]));
                }
                Err(fault) => return self.fault(fault),
            }
        }
        if pairs.is_empty() {
            let message = format!("`{}` has different numbers of arguments in the two machines", part.text);
            return self.fault(bad_coupling(place, message));
        }
        for [here, there] in pairs {
            for (side, id) in [(ABSTRACT, here), (CONCRETE, there)] {
                if let Some(domain) = self.grows(side, id, false) {
                    let message = format!(
                        "`{}` has arguments in {domain}, of which the {} machine makes elements: they cannot be compared",
                        part.text, SIDES[side]
                    );
                    let help = "say with `couple` what corresponds, by functions without such arguments";
                    return self.faults.push(bad_coupling(place, message).with_help(help));
                }
                let reader = self.reader(side, id);
                if self.coupling.programs[side].reads_monitored(&reader) {
                    let message = format!("`{}` is an input, or depends on one; a coupling relates states", part.text);
                    return self.fault(bad_coupling(place, message));
                }
            }
            self.add_same(part.text.clone(), [here, there]);
        }
    }

    fn add_same(&mut self, name: String, functions: [FunctionId; 2]) {
        for (side, function) in functions.into_iter().enumerate() {
            self.reader(side, function);
        }
        let arity = self.coupling.programs[ABSTRACT].function(functions[ABSTRACT]).parameters.len();
        let joint = self.coupling.joint.with_domains_of[ABSTRACT].get(&functions[ABSTRACT]);
        let arguments = joint.and_then(|joint| self.arguments(*joint));
        let arguments = arguments.or_else(|| (arity == 0).then(|| vec![Vec::new()]));
        if arguments.is_none() {
            let of_state = |side: usize| is_state(self.coupling.programs[side].function(functions[side]));
            let begun = |side: usize| {
                self.coupling.programs[side].initials.iter().any(|initial| initial.function == functions[side])
            };
            if (0..2).any(|side| !of_state(side) || begun(side)) {
                let message =
                    format!("`{name}` has values at infinitely many arguments: say with `couple` which are compared");
                return self.fault(bad_coupling(start(self.coupling.file), message));
            }
        }
        self.coupling.same.push(name.clone());
        self.coupling.conjuncts.push(Conjunct::Same { name, functions, arguments });
    }

    /// All arguments of a function of the joint model, if they can be listed.
    fn arguments(&self, function: FunctionId) -> Option<Vec<Vec<machine::Value>>> {
        let program = &self.coupling.joint.program;
        let function = program.function(function);
        let mut machine = Machine::new(Arc::new(program.clone()), self.limits.clone());
        let mut all = vec![Vec::new()];
        for domain in &function.parameters {
            let mut fixed = *domain;
            while let DomainKind::Concrete { base, contents: None, .. } = program.domain(fixed).kind {
                fixed = base;
            }
            let elements = machine.elements(fixed).ok()?;
            all = all
                .iter()
                .flat_map(|arguments: &Vec<machine::Value>| {
                    elements.iter().map(|element| [&arguments[..], std::slice::from_ref(element)].concat())
                })
                .collect();
            if all.len() > 1 << 16 {
                return None;
            }
        }
        Some(all)
    }

    /// A part of the file as a text in which all else is blank, and names of functions are those of the joint model.
    fn masked(&self, part: &Part) -> String {
        let blank = |text: &str| -> String {
            text.chars().map(|c| if c == '\n' { "\n".to_string() } else { " ".repeat(c.len_utf8()) }).collect()
        };
        let (start, end) = (part.span.start as usize, part.span.end as usize);
        let (before, term, after) =
            (&self.source.text[..start], &self.source.text[start..end], &self.source.text[end..]);
        let mut own = String::with_capacity(term.len());
        let mut rest = term;
        while let Some(next) = rest.chars().next() {
            let inside = own.ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == '$');
            let side = SIDES.iter().find(|side| !inside && rest.starts_with(&format!("{side}.")));
            let taken = match side {
                Some(side) => {
                    own.push_str(&joint_name(usize::from(**side == *SIDES[CONCRETE]), ""));
                    side.len() + 1
                }
                None => {
                    own.push(next);
                    next.len_utf8()
                }
            };
            rest = &rest[taken..];
        }
        format!("{}{own}{}", blank(before), blank(after))
    }

    /// The faults of a term, with names as the file has them.
    fn told(&mut self, faults: Vec<Diagnostic>) {
        let plain = |text: &mut String| {
            for (side, word) in SIDES.iter().enumerate() {
                *text = text.replace(&joint_name(side, ""), &format!("{word}."));
            }
        };
        for mut fault in faults {
            plain(&mut fault.message);
            plain(&mut fault.primary.text);
            fault.help.iter_mut().for_each(plain);
            if fault.id == "unknown-function" {
                let Span { start, end, .. } = fault.primary.span;
                let name = self.source.text.get(start as usize..end as usize).unwrap_or_default();
                fault.help = Some(self.meant(name));
            }
            // The joint model is nowhere that a user could look.
            let file = self.coupling.file;
            fault.secondary.retain(|label| label.span.file == file);
            fault.secondary.iter_mut().for_each(|label| plain(&mut label.text));
            self.faults.push(fault);
        }
    }

    fn term(&mut self, part: &Part, wanted: Option<(model::DomainId, &str)>) -> Option<Expression> {
        let file = self.coupling.file;
        let parsed = syntax::parse_term(file, &self.masked(part));
        if parsed.diagnostics.iter().any(|fault| fault.severity == Severity::Error) {
            let mut faults = parsed.diagnostics;
            // Before the term all is blank: what a term has to begin with is said at its beginning.
            let begins = ["forall", "exist", "exists"]
                .iter()
                .any(|word| part.text.strip_prefix(word).is_some_and(|rest| rest.starts_with(char::is_whitespace)));
            // Behind the term all is blank, too.
            for fault in &mut faults {
                fault.message = fault.message.replace("the end of the file", "the end of the statement");
            }
            for fault in faults.iter_mut().filter(|fault| fault.primary.span.start < part.span.start) {
                fault.primary.span = self.place(part);
                if begins {
                    fault.help = Some("a quantifier stands in parentheses: `(forall $x in D with …)`".to_string());
                }
            }
            self.told(faults);
            return None;
        }
        let Some(term) = TermFile::cast(parsed.syntax()).and_then(|file| file.term()) else {
            let place = self.place(part);
            self.fault(bad_coupling(place, "a term is expected"));
            return None;
        };
        let joint = &mut self.coupling.joint;
        let fragment = match wanted {
            None => joint.model.check_condition(file, &term, "a coupling"),
            Some((domain, what)) => joint.model.check_value(file, &term, domain, what),
        };
        if fragment.diagnostics.iter().any(|fault| fault.severity == Severity::Error) {
            self.told(fragment.diagnostics);
            return None;
        }
        match program::lower_term(&mut joint.program, &joint.model, &fragment.item, &fragment.variables) {
            Ok(formula) => self.ranges_over_fixed(&formula).then_some(formula),
            Err(faults) => {
                self.told(faults);
                None
            }
        }
    }

    /// Whether a term goes through the elements of no domain that grows: those that a machine makes are not in the joint model.
    fn ranges_over_fixed(&mut self, formula: &Expression) -> bool {
        let program = &self.coupling.joint.program;
        let mut open = vec![formula.body];
        while let Some(id) = open.pop() {
            if let Term::Domain(domain) = program.term(id)
                && let Some(name) = self.coupling.joint.growing(*domain)
            {
                let message = format!("a machine makes elements of {name}, and a coupling does not see them");
                let fault = bad_coupling(program.term_span(id), message);
                self.faults.push(fault.with_help(
                    "let a derived function of the model go through the elements, and name that function here",
                ));
                return false;
            }
            program.each_child_of_term(id, &mut |child| open.push(child));
        }
        true
    }

    /// The domain of which a machine makes elements, if a function has arguments in such a domain, or with `values` also values.
    fn grows(&self, side: usize, function: FunctionId, values: bool) -> Option<String> {
        let program = &self.coupling.programs[side];
        let function = program.function(function);
        let domains = function.parameters.iter().chain(values.then_some(&function.codomain));
        domains.into_iter().find_map(|domain| growing(program, *domain)).map(str::to_string)
    }

    /// What a name that is no function may mean.
    fn meant(&self, written: &str) -> String {
        let programs = &self.coupling.programs;
        for (side, word) in SIDES.iter().enumerate() {
            let Some(name) = written.strip_prefix(word).and_then(|rest| rest.strip_prefix('.')) else { continue };
            return match nearest(name, names(&programs[side])) {
                Some(close) => format!("did you mean `{word}.{close}`?"),
                None => format!("write `{word}.NAME`, with the name of a function of that machine"),
            };
        }
        let having: Vec<String> = SIDES
            .iter()
            .enumerate()
            .filter(|(side, _)| names(&programs[*side]).any(|name| name == written))
            .map(|(_, word)| format!("`{word}.{written}`"))
            .collect();
        match having[..] {
            [] => "write `abstract.NAME` or `concrete.NAME`, with the name of a function of that machine".to_string(),
            _ => format!("say of which machine: {}", having.join(" or ")),
        }
    }

    /// A condition over states.
    fn condition(&mut self, part: &Part) -> Option<Expression> {
        let formula = self.term(part, None)?;
        self.over_states(&formula, part).then_some(formula)
    }

    /// `variant TERM;`
    fn variant(&mut self, part: &Part, waiting: bool) {
        let place = self.place(part);
        if waiting {
            let message = "`allow waiting` takes for granted what a variant proves: one of them is enough";
            return self.fault(bad_coupling(place, message));
        }
        let program = &self.coupling.joint.program;
        let integer = program.domains.iter().position(|domain| domain.kind == DomainKind::Basic(model::Basic::Integer));
        let Some(integer) = integer else { return };
        let Some(formula) = self.term(part, Some((DomainId(integer as u32), "the variant"))) else { return };
        if self.over_states(&formula, part) {
            self.coupling.variant = Some((part.text.clone(), formula));
        }
    }

    /// Whether a term reads no input of either machine; it can be evaluated then.
    fn over_states(&mut self, formula: &Expression, part: &Part) -> bool {
        for side in [ABSTRACT, CONCRETE] {
            for function in self.functions_of(formula, side) {
                let reader = self.reader(side, function);
                let program = &self.coupling.programs[side];
                if program.reads_monitored(&reader) {
                    let name = program.function(function).name.clone();
                    let message =
                        format!("{}.{name} is an input, or depends on one; a coupling relates states", SIDES[side]);
                    let place = self.read_at(formula, side, function).unwrap_or_else(|| self.place(part));
                    self.fault(bad_coupling(place, message));
                    return false;
                }
            }
        }
        true
    }

    fn concrete_only(&mut self, formula: &Expression, what: &str, by: &str) {
        if let Some((.., place)) = self.reads(formula).into_iter().find(|(side, ..)| *side == ABSTRACT) {
            self.fault(bad_coupling(place, format!("{what} by {by}")));
        }
    }

    /// The functions of a side that a term of the joint model reads.
    fn functions_of(&self, formula: &Expression, side: usize) -> BTreeSet<FunctionId> {
        self.reads(formula).into_iter().filter(|(there, ..)| *there == side).map(|(_, function, _)| function).collect()
    }

    /// Where a term of the joint model reads a function of a side.
    fn read_at(&self, formula: &Expression, side: usize, function: FunctionId) -> Option<Span> {
        let mut reads = self.reads(formula).into_iter();
        reads.find(|(there, read, _)| (*there, *read) == (side, function)).map(|(.., place)| place)
    }

    /// What a term of the joint model reads of each side, and where.
    fn reads(&self, formula: &Expression) -> Vec<(usize, FunctionId, Span)> {
        let Joint { program, of, .. } = &self.coupling.joint;
        let mut open = vec![formula.body];
        let mut found = Vec::new();
        while let Some(id) = open.pop() {
            if let Term::Read { function, .. } = program.term(id)
                && let Some((side, function)) = of.get(function)
            {
                found.push((*side, *function, program.term_span(id)));
            }
            program.each_child_of_term(id, &mut |child| open.push(child));
        }
        found
    }
}

/// The beginning of a text that is too long for a message.
fn shortened(words: &str) -> String {
    words.chars().take(WORDS).chain(['…']).collect()
}

/// The names of a machine's own functions.
fn names(program: &Program) -> impl Iterator<Item = &str> {
    program.functions.iter().filter(|function| !function.library).map(|function| &*function.name)
}

/// Whether a function is part of the state between steps.
fn is_state(function: &program::Function) -> bool {
    use FunctionKind::{Controlled, Out, Shared};
    !function.library && matches!(function.kind, Controlled | Out | Shared)
}
