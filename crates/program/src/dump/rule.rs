//! Rules: a line for each, with its parts below it.

use std::fmt::Write;

use model::FunctionId;

use crate::dump::{Dump, Written};
use crate::ir::{BinderList, ProcedureId, Rule, RuleId, RuleList, TermId, TermList};

impl Dump<'_> {
    pub(super) fn rule(&mut self, id: RuleId, depth: usize) -> Written {
        stacker::maybe_grow(64 * 1024, 1024 * 1024, || self.rule_here(id, depth))
    }

    fn rule_here(&mut self, id: RuleId, depth: usize) -> Written {
        let program = self.program;
        match program.rule(id) {
            Rule::Skip => self.line(depth, "skip"),
            Rule::Update { function, arguments, value } => {
                self.start(depth, "");
                self.location(*function, *arguments)?;
                self.text.push_str(" := ");
                self.end(*value)
            }
            Rule::Call { procedure, arguments } => {
                self.start(depth, "call ");
                self.call(*procedure, *arguments)
            }
            Rule::TurboCall { procedure, arguments } => {
                self.start(depth, "turbo ");
                self.call(*procedure, *arguments)
            }
            Rule::Return { function, target, procedure, arguments } => {
                self.start(depth, "");
                self.location(*function, *target)?;
                self.text.push_str(" <- ");
                self.call(*procedure, *arguments)
            }
            Rule::RunValue { rule, arguments } => {
                self.start(depth, "run ");
                self.term(*rule)?;
                self.enclosed("(", *arguments, ")\n")
            }
            Rule::RunAgent { agent } => {
                self.start(depth, "agent ");
                self.end(*agent)
            }
            Rule::Par(rules) => self.block(depth, "par", *rules),
            Rule::Seq(rules) => self.block(depth, "seq", *rules),
            Rule::If { guards, rules } => {
                for (index, guard) in program.term_list(*guards).iter().enumerate() {
                    self.start(depth, if index == 0 { "if " } else { "elseif " });
                    self.end(*guard)?;
                    self.rule(program.rule_list(*rules)[index], depth + 1)?;
                }
                self.last(depth, "else", *rules, *guards)
            }
            Rule::Switch { subject, values, rules } => {
                self.start(depth, "switch ");
                self.end(*subject)?;
                for (index, value) in program.term_list(*values).iter().enumerate() {
                    self.start(depth, "case ");
                    self.end(*value)?;
                    self.rule(program.rule_list(*rules)[index], depth + 1)?;
                }
                self.last(depth, "otherwise", *rules, *values)
            }
            Rule::Let { slot, value, body } => {
                self.start(depth, "let ");
                self.slot(*slot)?;
                self.text.push_str(" = ");
                self.end(*value)?;
                self.rule(*body, depth + 1)
            }
            Rule::Choose { binders, condition, body, if_none } => {
                self.start(depth, "choose ");
                self.binding(*binders, *condition)?;
                self.rule(*body, depth + 1)?;
                let Some(rule) = if_none else { return Ok(()) };
                self.line(depth, "ifnone")?;
                self.rule(*rule, depth + 1)
            }
            Rule::Forall { binders, condition, body } => {
                self.start(depth, "forall ");
                self.binding(*binders, *condition)?;
                self.rule(*body, depth + 1)
            }
            Rule::Extend { domain, first, count, body } => {
                self.start(depth, "extend ");
                write!(self.text, "{} with", program.domain(*domain).name)?;
                for index in 0..*count {
                    self.text.push_str(if index == 0 { " " } else { ", " });
                    self.slot(crate::ir::Slot(first.0 + index))?;
                }
                self.text.push('\n');
                self.rule(*body, depth + 1)
            }
            Rule::Iterate(body) => {
                self.line(depth, "iterate")?;
                self.rule(*body, depth + 1)
            }
            Rule::While { condition, body } => {
                self.start(depth, "while ");
                self.end(*condition)?;
                self.rule(*body, depth + 1)
            }
            Rule::RecursiveWhile { condition, body } => {
                self.start(depth, "whilerec ");
                self.end(*condition)?;
                self.rule(*body, depth + 1)
            }
            Rule::Local { start, len, initialisations, body } => {
                let functions = &program.function_lists[*start as usize..][..*len as usize];
                for (function, rule) in functions.iter().zip(program.rule_list(*initialisations)) {
                    self.start(depth, "local ");
                    writeln!(self.text, "{}", program.function(*function).name)?;
                    self.rule(*rule, depth + 1)?;
                }
                self.line(depth, "in")?;
                self.rule(*body, depth + 1)
            }
        }
    }

    fn start(&mut self, depth: usize, word: &str) {
        (0..depth).for_each(|_| self.text.push_str("  "));
        self.text.push_str(word);
    }

    fn line(&mut self, depth: usize, text: &str) -> Written {
        self.start(depth, text);
        self.text.push('\n');
        Ok(())
    }

    fn end(&mut self, term: TermId) -> Written {
        self.term(term)?;
        self.text.push('\n');
        Ok(())
    }

    fn location(&mut self, function: FunctionId, arguments: TermList) -> Written {
        self.text.push_str(&self.program.function(function).name);
        if arguments.len > 0 { self.enclosed("(", arguments, ")") } else { Ok(()) }
    }

    fn call(&mut self, procedure: ProcedureId, arguments: TermList) -> Written {
        self.procedure_name(procedure)?;
        self.enclosed("(", arguments, ")\n")
    }

    fn block(&mut self, depth: usize, word: &str, rules: RuleList) -> Written {
        self.line(depth, word)?;
        self.program.rule_list(rules).iter().try_for_each(|rule| self.rule(*rule, depth + 1))
    }

    fn binding(&mut self, binders: BinderList, condition: Option<TermId>) -> Written {
        self.binders(binders)?;
        if let Some(condition) = condition {
            self.text.push_str(" with ");
            self.term(condition)?;
        }
        self.text.push('\n');
        Ok(())
    }

    /// The rule after those of the branches, if there is one.
    fn last(&mut self, depth: usize, word: &str, rules: RuleList, branches: TermList) -> Written {
        let Some(rule) = self.program.rule_list(rules).get(branches.len as usize) else { return Ok(()) };
        self.line(depth, word)?;
        self.rule(*rule, depth + 1)
    }
}
