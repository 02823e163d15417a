//! A program as text: for people, and for golden tests.
//!
//! The tables come in order, one entry on each line; rules are indented by their nesting. Operations of the machine have
//! their names in [`crate::Builtin`], so that `IntAdd(x, 1)` and `RealAdd(x, 1.0)` differ. What the model did not
//! declare is left out. INVARIANT: the same program gives the same text.

mod rule;
mod term;

use std::fmt::Write;

use model::{Domains, FunctionKind, PropertyKind};

use crate::ir::{DomainKind, Expression, ProcedureId, Program, Slot};

/// The program as text.
pub fn dump(program: &Program) -> String {
    let mut dump = Dump { program, names: &[], text: String::new() };
    let _ = dump.program();
    dump.text
}

/// The text so far, and the names of the slots of the body being written.
struct Dump<'p> {
    program: &'p Program,
    names: &'p [String],
    text: String,
}

type Written = std::fmt::Result;

impl<'p> Dump<'p> {
    fn program(&mut self) -> Written {
        let program = self.program;
        writeln!(self.text, "{}asm {}", if program.asynchronous { "asyncr " } else { "" }, program.name)?;
        self.domains()?;
        self.functions()?;
        for (index, procedure) in program.procedures.iter().enumerate() {
            let id = ProcedureId(index as u32);
            self.names = &procedure.names;
            let kind = if procedure.turbo { "turbo" } else { "rule" };
            write!(self.text, "{kind} ")?;
            self.procedure_name(id)?;
            self.parameters(procedure.parameters.len())?;
            writeln!(self.text, "{}", if program.main == Some(id) { " main" } else { "" })?;
            self.rule(procedure.body, 1)?;
        }
        self.initial_state()?;
        self.properties()
    }

    fn domains(&mut self) -> Written {
        let program = self.program;
        for (index, domain) in program.domains.iter().enumerate() {
            match &domain.kind {
                DomainKind::Enum { literals } => {
                    writeln!(self.text, "enum {} = {}", domain.name, literals.join(" | "))?
                }
                DomainKind::Abstract { elements, dynamic } => {
                    let predefined = index <= Domains::ANY.0 as usize;
                    if !predefined || !elements.is_empty() {
                        let dynamic = if *dynamic { "dynamic " } else { "" };
                        writeln!(self.text, "{dynamic}abstract {} {{{}}}", domain.name, elements.join(", "))?;
                    }
                }
                DomainKind::Concrete { base, dynamic, elements, contents } => {
                    let dynamic = if *dynamic { "dynamic " } else { "" };
                    let base = program.domain(*base);
                    write!(self.text, "{dynamic}domain {} subsetof {}", domain.name, base.name)?;
                    if let DomainKind::Abstract { elements: names, .. } = &base.kind {
                        let names: Vec<&str> = elements.iter().map(|index| names[*index as usize].as_str()).collect();
                        write!(self.text, " {{{}}}", names.join(", "))?;
                    }
                    self.optional_expression(contents.as_ref())?;
                }
                _ => {}
            }
        }
        Ok(())
    }

    fn functions(&mut self) -> Written {
        let program = self.program;
        for function in &program.functions {
            if function.library && function.definition.is_none() && function.kind != FunctionKind::Monitored {
                continue;
            }
            let kind = format!("{:?}", function.kind).to_lowercase();
            let names: Vec<&str> =
                function.parameters.iter().map(|domain| program.domain(*domain).name.as_str()).collect();
            let arrow = if names.is_empty() { "" } else { " -> " };
            let codomain = &program.domain(function.codomain).name;
            write!(self.text, "{kind} {}: {}{arrow}{codomain}", function.name, names.join(", "))?;
            if let Some(element) = function.element {
                write!(self.text, " element {element}")?;
            }
            self.optional_expression(function.definition.as_ref())?;
        }
        Ok(())
    }

    fn initial_state(&mut self) -> Written {
        let program = self.program;
        for initial in &program.initials {
            write!(self.text, "initial {}", program.function(initial.function).name)?;
            self.optional_expression(Some(&initial.value))?;
        }
        for agent in &program.agents {
            write!(self.text, "agent {}: ", program.domain(agent.domain).name)?;
            self.procedure_name(agent.procedure)?;
            self.text.push('\n');
        }
        Ok(())
    }

    fn properties(&mut self) -> Written {
        for property in &self.program.properties {
            let kind = match property.kind {
                PropertyKind::Invariant => "invariant",
                PropertyKind::Invar => "invar",
                PropertyKind::Ctl => "ctl",
                PropertyKind::Ltl => "ltl",
                PropertyKind::Justice => "justice",
                PropertyKind::Compassion => "compassion",
            };
            let monitored = if property.reads_monitored { " monitored" } else { "" };
            write!(self.text, "{kind} {}{monitored}", property.name)?;
            self.optional_expression(Some(&property.formula))?;
            if property.conclusion.is_some() {
                self.text.push_str("  then");
                self.optional_expression(property.conclusion.as_ref())?;
            }
        }
        Ok(())
    }

    /// ` ($x, $y) = term` and the end of the line.
    fn optional_expression(&mut self, expression: Option<&'p Expression>) -> Written {
        if let Some(expression) = expression {
            self.names = &expression.names;
            if !expression.parameters.is_empty() {
                self.text.push(' ');
            }
            self.parameters(expression.parameters.len())?;
            self.text.push_str(" = ");
            self.term(expression.body)?;
        }
        self.text.push('\n');
        Ok(())
    }

    fn parameters(&mut self, count: usize) -> Written {
        for index in 0..count {
            self.text.push_str(if index == 0 { "(" } else { ", " });
            self.slot(Slot(index as u32))?;
        }
        if count > 0 {
            self.text.push(')');
        }
        Ok(())
    }

    /// `r_x#3`: the number tells the specialisations of a rule apart.
    fn procedure_name(&mut self, id: ProcedureId) -> Written {
        write!(self.text, "{}#{}", self.program.procedure(id).name, id.0)
    }

    /// The name of a slot, with its number if another slot has the same name.
    fn slot(&mut self, slot: Slot) -> Written {
        let name = &self.names[slot.0 as usize];
        self.text.push_str(name);
        if self.names.iter().filter(|other| *other == name).count() > 1 {
            write!(self.text, "@{}", slot.0)?;
        }
        Ok(())
    }
}
