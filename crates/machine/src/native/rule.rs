//! Rules: the counterpart of [`crate::perform`].

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{InstBuilder, types};
use model::Basic;
use program::{
    Binder, BinderList, DomainKind, Expression, FunctionId, ProcedureId, Rule, RuleId, Slot, Term, TermId, TermList,
};

use crate::native::context::Offset;
use crate::native::helper;
use crate::native::nesting::UnitKey;
use crate::native::shape::{Bound, Kind, Operand, Scalar};
use crate::native::translate::{Frame, MARKS, Translator};
use crate::value::Value;

impl Translator<'_, '_> {
    /// Translates a rule.
    pub fn rule(&mut self, id: RuleId) {
        self.weight += 1;
        if let Some(mark) = self.plan.mark_of(id) {
            let (place, ran) = (self.address(mark), self.byte(1));
            self.builder.ins().store(MARKS, ran, place, 0);
        }
        self.scoped(|this| this.plain_rule(id));
    }

    fn plain_rule(&mut self, id: RuleId) {
        let program = self.program;
        match program.rule(id) {
            Rule::Skip => {}
            Rule::Update { function, arguments, value } => self.statement(|this| {
                let value = this.term(*value);
                let alone = this.is_alone(*function, program.term_list(*arguments), id);
                let arguments = this.terms(*arguments);
                this.update(*function, &arguments, value, (id, alone));
            }),
            Rule::Call { procedure, arguments } => self.statement(|this| {
                let operands = this.terms(*arguments);
                this.procedure(*procedure, &operands);
            }),
            Rule::TurboCall { procedure, arguments } => self.statement(|this| {
                let outer = this.foralls.take();
                this.in_unit(false, |this| {
                    this.call(helper::OPEN, [this.context]);
                    let operands = this.terms(*arguments);
                    this.procedure(*procedure, &operands);
                    this.call_or_bail(helper::JOIN, [this.context]);
                });
                this.foralls = outer;
            }),
            Rule::Par(rules) => {
                let rules = program.rule_list(*rules);
                let (sole, is_part) = (self.sole, self.is_part);
                self.sole &= rules.len() < 2;
                self.is_part &= rules.len() < 2;
                for rule in rules {
                    self.rule(*rule);
                }
                (self.sole, self.is_part) = (sole, is_part);
            }
            // A sequence that is the whole of a part goes on with the sequence around it: their composition is associative.
            Rule::Seq(rules) if self.is_part => {
                for (index, rule) in program.rule_list(*rules).iter().enumerate() {
                    if index > 0 {
                        self.call(helper::APPLY_UNIT, [self.context]);
                        self.call(helper::OPEN, [self.context]);
                    }
                    self.rule(*rule);
                }
            }
            Rule::Seq(rules) => {
                let (outer, sole) = (self.foralls.take(), self.sole);
                self.in_unit(sole, |this| {
                    this.call(helper::BEGIN_SEQUENCE, [this.context]);
                    for rule in program.rule_list(*rules) {
                        this.part(*rule, true);
                    }
                    let end = if sole { helper::END_LAST_SEQUENCE } else { helper::END_SEQUENCE };
                    this.call_or_bail(end, [this.context]);
                });
                self.foralls = outer;
            }
            Rule::If { guards, rules } => {
                let (guards, rules) = (program.term_list(*guards), program.rule_list(*rules));
                let done = self.block();
                for (guard, rule) in guards.iter().zip(rules) {
                    let (then, next) = (self.block(), self.block());
                    self.guard_statement(*guard, then, next);
                    self.switch(then);
                    self.rule(*rule);
                    self.jump(done);
                    self.switch(next);
                }
                if let Some(rule) = rules.get(guards.len()) {
                    self.rule(*rule);
                }
                self.jump(done);
                self.switch(done);
            }
            Rule::Switch { subject, values, rules } => self.statement(|this| {
                let (values, rules) = (program.term_list(*values), program.rule_list(*rules));
                let subject = this.term(*subject);
                let done = this.block();
                match this.known_cases(subject, values) {
                    Some((scalar, cases)) => {
                        let (arms, none) = this.select_case(scalar, &cases);
                        for (arm, case) in arms.into_iter().zip(&cases) {
                            this.switch(arm);
                            this.rule(rules[case.place]);
                            this.jump(done);
                        }
                        this.switch(none);
                    }
                    None => {
                        let subject = this.bound(subject).into();
                        for (value, rule) in values.iter().zip(rules) {
                            let value = this.term(*value);
                            let equal = this.equal(subject, value);
                            let (then, next) = (this.block(), this.block());
                            this.branch(equal, then, next);
                            this.switch(then);
                            this.rule(*rule);
                            this.jump(done);
                            this.switch(next);
                        }
                    }
                }
                if let Some(rule) = rules.get(values.len()) {
                    this.rule(*rule);
                }
                this.jump(done);
                this.switch(done);
            }),
            Rule::Let { slot, value, body } => self.statement(|this| {
                let value = this.term(*value);
                let bound = this.bound(value);
                this.bind(*slot, bound);
                this.rule(*body);
            }),
            Rule::Forall { binders, condition, body } => self.statement(|this| {
                let sole = std::mem::replace(&mut this.sole, false);
                let is_part = std::mem::replace(&mut this.is_part, false);
                let outer = this.foralls.clone();
                let ranges = program.binder_list(*binders);
                if ranges.iter().any(|binder| !matches!(program.term(binder.range), Term::Domain(_))) {
                    this.foralls = None;
                } else if let Some(foralls) = &mut this.foralls {
                    foralls.extend(ranges.iter().map(|binder| binder.slot));
                }
                this.each_run(program.binder_list(*binders), &mut |this| match condition {
                    None => this.rule(*body),
                    Some(condition) => {
                        let (then, next) = (this.block(), this.block());
                        this.guard(*condition, then, next);
                        this.switch(then);
                        this.rule(*body);
                        this.jump(next);
                        this.switch(next);
                    }
                });
                this.foralls = outer;
                (this.sole, this.is_part) = (sole, is_part);
            }),
            Rule::Choose { binders, condition, body, if_none } => {
                self.choose(id, *binders, *condition, *body, *if_none);
            }
            Rule::Extend { domain, first, count, body } => {
                let is_part = std::mem::replace(&mut self.is_part, false);
                let base = program.base_domain(*domain);
                for offset in 0..*count {
                    let domain = self.word(i64::from(domain.0));
                    let number = self.call_for_number(helper::CREATE, [self.context, domain]);
                    let element = Scalar::defined(Kind::Element(base), number);
                    self.bind(Slot(first.0 + offset), Bound::Scalar(element));
                }
                self.rule(*body);
                self.is_part = is_part;
            }
            Rule::Iterate(body) => self.repeat(None, *body, true),
            Rule::While { condition, body } => self.repeat(Some(*condition), *body, true),
            Rule::RecursiveWhile { condition, body } => self.repeat(Some(*condition), *body, false),
            Rule::RunAgent { agent } => self.run_agent(*agent),
            Rule::RunValue { rule, arguments } => self.run_value(*rule, *arguments),
            Rule::Return { .. } | Rule::Local { .. } => self.interpreted_rule(id),
        }
    }

    /// A guard as a statement of its own: what it kept is forgotten on both ways.
    fn guard_statement(
        &mut self,
        guard: TermId,
        then: cranelift_codegen::ir::Block,
        next: cranelift_codegen::ir::Block,
    ) {
        let before = std::mem::replace(&mut self.keeps, false);
        let mark = self.field(Offset::temporary);
        let (items, gatherers) = (self.field(Offset::item), self.gatherers);
        let (yes, no) = (self.block(), self.block());
        self.guard(guard, yes, no);
        let keeps = std::mem::replace(&mut self.keeps, before);
        for (from, to) in [(yes, then), (no, next)] {
            self.switch(from);
            if keeps {
                self.release(mark);
            }
            self.give_back(items, gatherers);
            self.jump(to);
        }
    }

    /// Translates a rule that is a unit of its own, or several. Updates that change nothing may be left out of it where
    /// `no others` join it to what the step has done: a clash with them would not be found, nor that it made some.
    fn in_unit(&mut self, no_others: bool, body: impl FnOnce(&mut Self)) {
        let sole = std::mem::replace(&mut self.sole, false);
        let is_part = std::mem::replace(&mut self.is_part, false);
        if no_others || !self.plan.is_terse() {
            body(self);
        } else {
            let before = self.field(Offset::terse);
            let never = self.word(0);
            self.set_field(Offset::terse, never);
            body(self);
            self.set_field(Offset::terse, before);
        }
        (self.sole, self.is_part) = (sole, is_part);
    }

    /// One part of a sequence, or a round of a loop; gives whether it made updates. What `may_go_on` may be several parts instead.
    fn part(&mut self, rule: RuleId, may_go_on: bool) -> cranelift_codegen::ir::Value {
        let is_part = std::mem::replace(&mut self.is_part, may_go_on);
        self.call(helper::OPEN, [self.context]);
        self.rule(rule);
        self.is_part = is_part;
        self.call(helper::APPLY_UNIT, [self.context])
    }

    fn repeat(&mut self, condition: Option<TermId>, body: RuleId, while_updates: bool) {
        let outer = self.foralls.take();
        self.in_unit(false, |this| this.rounds(condition, body, while_updates));
        self.foralls = outer;
    }

    fn rounds(&mut self, condition: Option<TermId>, body: RuleId, while_updates: bool) {
        self.call(helper::BEGIN_SEQUENCE, [self.context]);
        let (head, inner, done) = (self.block(), self.block(), self.block());
        self.jump(head);
        self.switch(head);
        match condition {
            Some(condition) => self.guard_statement(condition, inner, done),
            None => self.jump(inner),
        }
        self.switch(inner);
        let any = self.part(body, false);
        if while_updates {
            let next = self.block();
            self.branch(any, next, done);
            self.switch(next);
        }
        self.call_or_bail(helper::ITERATION, [self.context]);
        self.jump(head);
        self.switch(done);
        self.call_or_bail(helper::END_SEQUENCE, [self.context]);
    }

    /// Whether no other update of the step can be of the same location: the rule is the only one that updates the
    /// function, stands under `forall` rules alone, and their variables are its arguments.
    fn is_alone(&self, function: FunctionId, arguments: &[TermId], id: RuleId) -> bool {
        let Some(foralls) = &self.foralls else { return false };
        let program = self.program;
        let varies = |slot: &Slot| {
            arguments.iter().any(|term| matches!(program.term(*term), Term::Slot(argument) if argument == slot))
        };
        self.frames.len() == 1 && foralls.iter().all(varies) && self.plan.is_only_update(program, function, id)
    }

    /// A rule that the interpreter runs.
    fn interpreted_rule(&mut self, id: RuleId) {
        let program = self.program;
        let mut slots = Vec::new();
        self.plan.slots_of_rule(program, id, &mut slots);
        let (spill, values) = self.spill(slots);
        let rule = self.word(i64::from(id.0));
        self.call_or_bail(helper::PERFORM, [self.context, rule, spill, values]);
    }

    /// The whole of an entry: the procedure that makes the step.
    pub fn main(&mut self, main: ProcedureId) {
        self.foralls = Some(Vec::new());
        self.sole = true;
        self.frames.push(Frame {
            unit: Some(UnitKey::Procedure(main)),
            size: self.program.procedure(main).frame,
            slots: Vec::new(),
        });
        self.rule(self.program.procedure(main).body);
        self.frames.pop();
        self.end_entry();
    }

    /// The whole of an entry: whether a condition is true.
    pub fn condition(&mut self, condition: &Expression) {
        self.frames.push(Frame { unit: None, size: condition.frame, slots: Vec::new() });
        let (holds, unknown) = (self.block(), self.bail);
        self.guard_statement(condition.body, holds, unknown);
        self.switch(holds);
        self.frames.pop();
        self.end_entry();
    }

    /// Returns from an entry: 0 here, and 1 where the step is given up.
    fn end_entry(&mut self) {
        let good = self.word(0);
        self.builder.ins().return_(&[good]);
        self.switch(self.bail);
        let bad = self.word(1);
        self.builder.ins().return_(&[bad]);
    }

    // ---- calls

    /// Runs a procedure on operands.
    fn procedure(&mut self, procedure: ProcedureId, operands: &[Operand]) {
        let key = UnitKey::Procedure(procedure);
        if !self.inlines(key) {
            return self.call_procedure(procedure, operands);
        }
        let declared = self.program.procedure(procedure);
        let slots: Vec<Bound> = operands.iter().map(|operand| self.bound(*operand)).collect();
        self.frames.push(Frame { unit: Some(key), size: declared.frame, slots });
        self.rule(declared.body);
        self.frames.pop();
    }

    /// Runs the one of some procedures whose number this is.
    fn dispatch(
        &mut self,
        number: cranelift_codegen::ir::Value,
        candidates: &[ProcedureId],
        run: &mut dyn FnMut(&mut Self, ProcedureId),
    ) {
        let done = self.block();
        for candidate in candidates {
            let (then, next) = (self.block(), self.block());
            let is = self.builder.ins().icmp_imm(IntCC::Equal, number, i64::from(candidate.0));
            self.branch(is, then, next);
            self.switch(then);
            run(self, *candidate);
            self.jump(done);
            self.switch(next);
        }
        self.jump(self.bail);
        self.switch(done);
    }

    fn run_value(&mut self, rule: TermId, arguments: TermList) {
        self.statement(|this| {
            let value = this.term(rule);
            let value = this.scalar(value, Kind::Rule);
            let value = this.defined(value);
            let operands: Vec<Operand> = this.terms(arguments);
            let operands: Vec<Operand> = operands.into_iter().map(|operand| this.bound(operand).into()).collect();
            let mut candidates = this.plan.rule_values(this.program, operands.len());
            if let Some((low, high)) = value.range {
                candidates.retain(|procedure| (low..=high).contains(&i64::from(procedure.0)));
            }
            this.dispatch(value.value, &candidates, &mut |this, procedure| {
                if !this.program.procedure(procedure).turbo {
                    return this.procedure(procedure, &operands);
                }
                this.in_unit(false, |this| {
                    this.call(helper::OPEN, [this.context]);
                    this.procedure(procedure, &operands);
                    this.call_or_bail(helper::JOIN, [this.context]);
                });
            });
        });
    }

    /// Runs the program of an agent, which `self` is within it.
    fn run_agent(&mut self, agent: TermId) {
        let program = self.program;
        self.statement(|this| {
            let operand = this.term(agent);
            let mut candidates: Vec<ProcedureId> = program.agents.iter().map(|entry| entry.procedure).collect();
            candidates.sort_unstable();
            candidates.dedup();
            let operand = match this.kind_of(agent) {
                Some(kind) => {
                    let scalar = this.scalar(operand, kind);
                    Operand::Scalar(this.defined(scalar))
                }
                None => operand,
            };
            let number = match (&candidates[..], operand) {
                // Every agent that can be meant has the one program.
                ([only], Operand::Scalar(scalar)) if this.plan.all_have_program(program, scalar) => {
                    this.word(i64::from(only.0))
                }
                _ => {
                    let pointer = this.boxed(operand);
                    this.call_for_number(helper::AGENT_PROGRAM, [this.context, pointer])
                }
            };
            let Some(index) = this.plan.self_location(program) else {
                return this.dispatch(number, &candidates, &mut |this, procedure| this.procedure(procedure, &[]));
            };
            let (Operand::Scalar(scalar), Some(_)) = (operand, this.kind_of(agent)) else { return this.give_up() };
            let index = this.word(i64::from(index));
            let place = this.stored(index);
            let former = (this.load(types::I64, place, 0), this.load(types::I64, place, 8));
            let (tag, payload) = this.words(scalar);
            this.store(tag, place, 0);
            this.store(payload, place, 8);
            let outer = this.agent.replace(scalar);
            this.dispatch(number, &candidates, &mut |this, procedure| this.procedure(procedure, &[]));
            this.agent = outer;
            let place = this.stored(index);
            this.store(former.0, place, 0);
            this.store(former.1, place, 8);
        });
    }

    // ---- choice

    fn choose(
        &mut self,
        id: RuleId,
        binders: BinderList,
        condition: Option<TermId>,
        body: RuleId,
        if_none: Option<RuleId>,
    ) {
        let binders: &[Binder] = self.program.binder_list(binders);
        let variables = binders.len() as i64;
        let infinite = |binder: &Binder| match self.program.term(binder.range) {
            Term::Domain(domain) => {
                matches!(self.program.domain(*domain).kind, DomainKind::Basic(basic) if basic != Basic::Boolean)
            }
            _ => false,
        };
        if binders.iter().any(infinite) {
            return self.interpreted_rule(id);
        }
        if self.choose_of_all(id, binders, condition, body) {
            return;
        }
        self.statement(|this| {
            this.each_binding(binders, &mut |this| {
                let (fits, next) = (this.block(), this.block());
                match condition {
                    Some(condition) => this.guard(condition, fits, next),
                    None => this.jump(fits),
                }
                this.switch(fits);
                this.candidate(binders);
                this.jump(next);
                this.switch(next);
            });
            let count = this.field(Offset::candidate);
            let (some, none, done) = (this.block(), this.block(), this.block());
            this.branch(count, some, none);

            this.switch(some);
            let (rule, width) = (this.word(i64::from(id.0)), this.word(variables));
            let chosen = this.call_for_number(helper::CHOOSE, [this.context, rule, width]);
            let candidates = this.field(Offset::candidates);
            let mut compound = false;
            for (offset, binder) in binders.iter().enumerate() {
                let first = this.builder.ins().imul_imm(chosen, variables);
                let index = this.builder.ins().iadd_imm(first, offset as i64);
                let place = this.element(candidates, index, 4);
                let bound = match this.slot(binder.slot) {
                    Bound::Scalar(scalar) => {
                        let value = this.payload(place, scalar.kind);
                        let flag = scalar.flag.map(|_| {
                            let tag = this.load(types::I64, place, 0);
                            this.builder.ins().icmp_imm(IntCC::NotEqual, tag, 0)
                        });
                        Bound::Scalar(Scalar { value, flag, ..scalar })
                    }
                    _ => {
                        compound = true;
                        Bound::Boxed(this.call_for_value(helper::KEEP, [this.context, place]))
                    }
                };
                this.bind(binder.slot, bound);
            }
            if compound {
                this.call(helper::DROP_CANDIDATES, [this.context]);
            } else {
                let zero = this.word(0);
                this.set_field(Offset::candidate, zero);
            }
            this.rule(body);
            this.jump(done);

            this.switch(none);
            if let Some(rule) = if_none {
                this.rule(rule);
            }
            this.jump(done);
            this.switch(done);
        });
    }

    /// A choice without a guard among all elements of domains that never change: the candidates are always the same.
    /// False, and nothing translated, where it is another.
    fn choose_of_all(&mut self, id: RuleId, binders: &[Binder], condition: Option<TermId>, body: RuleId) -> bool {
        /// LIMIT: values of so many candidates are listed beforehand.
        const LISTED: usize = 1 << 12;
        let program = self.program;
        let always = condition.is_none_or(|condition| match program.term(condition) {
            Term::Constant(index) => self.plan.constants[*index as usize] == Value::Boolean(true),
            _ => false,
        });
        let columns: Option<Vec<(Kind, i64, i64)>> =
            binders.iter().map(|binder| self.numbers_of(binder.range)).collect();
        let (true, Some(columns)) = (always, columns) else { return false };
        let count = columns
            .iter()
            .fold(1usize, |count, (_, low, high)| count.saturating_mul(usize::try_from(high - low + 1).unwrap_or(0)));
        if count == 0 || count.saturating_mul(columns.len()) > LISTED {
            return false;
        }
        let mut values = Vec::with_capacity(count * columns.len());
        for candidate in 0..count as i64 {
            let mut rest = candidate;
            let mut row: Vec<Value> = Vec::new();
            for (kind, low, high) in columns.iter().rev() {
                row.push(kind.value(low + rest % (high - low + 1)));
                rest /= high - low + 1;
            }
            values.extend(row.into_iter().rev());
        }
        let values = std::sync::Arc::new(crate::weighed::Items::new(values));
        let start = self.address(values.as_ptr());
        self.plan.pin(values);
        let (rule, width, count) =
            (self.word(i64::from(id.0)), self.word(columns.len() as i64), self.word(count as i64));
        let chosen = self.call_for_number(helper::CHOOSE_OF, [self.context, rule, start, count, width]);
        let mut rest = chosen;
        for (index, (binder, (kind, low, high))) in binders.iter().zip(&columns).enumerate().rev() {
            let size = high - low + 1;
            let column = if index == 0 { rest } else { self.builder.ins().urem_imm(rest, size) };
            if index > 0 {
                rest = self.builder.ins().udiv_imm(rest, size);
            }
            let number = self.builder.ins().iadd_imm(column, *low);
            let value = if *kind == Kind::Boolean { self.builder.ins().ireduce(types::I8, number) } else { number };
            self.bind(binder.slot, Bound::Scalar(Scalar::defined(*kind, value).within(*low, *high)));
        }
        self.rule(body);
        true
    }

    /// Writes the variables of a choice as one more candidate.
    fn candidate(&mut self, binders: &[Binder]) {
        let count = self.field(Offset::candidate);
        let after = self.builder.ins().iadd_imm(count, binders.len() as i64);
        let capacity = self.field(Offset::candidate_capacity);
        let full = self.builder.ins().icmp(IntCC::UnsignedGreaterThan, after, capacity);
        let (room, write) = (self.block(), self.block());
        self.builder.set_cold_block(room);
        self.branch(full, room, write);
        self.switch(room);
        self.call_or_bail(helper::MORE_CANDIDATES, [self.context]);
        self.jump(write);
        self.switch(write);
        let candidates = self.field(Offset::candidates);
        for (offset, binder) in binders.iter().enumerate() {
            let first = self.element(candidates, count, 4);
            let place = self.builder.ins().iadd_imm(first, 16 * offset as i64);
            match self.slot(binder.slot) {
                Bound::Scalar(scalar) => {
                    let (tag, payload) = self.words(scalar);
                    self.store(tag, place, 0);
                    self.store(payload, place, 8);
                }
                other => {
                    let pointer = self.boxed(other.into());
                    self.call(helper::COPY, [self.context, pointer, place]);
                }
            }
        }
        self.set_field(Offset::candidate, after);
    }
}
