//! One machine: its control variable, shapes, arrows and sequences.

use syntax::ast::{self, AstNode, MachineChart, PathStop};
use syntax::{Span, SyntaxToken};

use super::link::{flat, link, names_function};
use super::{Reader, structure};
use crate::build::{answer_name, function_name};
use crate::chart::{
    Arrow, Composite, Control, End, History, Machine, Parameter, Pattern, Refinement, Shape, ShapeId, ShapeKind,
};
use crate::fault;
use crate::link::Link;

impl Reader {
    pub(super) fn machine(&mut self, node: &MachineChart) -> Option<Machine> {
        let name = node.name()?;
        let parameters = node.parameters().into_iter().filter_map(|parameter| {
            let domain = parameter.domain()?;
            Some(Parameter { variable: parameter.variable()?.text().to_string(), domain: flat(domain.syntax()) })
        });
        let mut machine = Machine {
            name: name.text().to_string(),
            is_pattern: node.is_pattern(),
            parameters: parameters.collect(),
            text: node.text().unwrap_or_else(|| spoken(name.text())),
            rule: self.link(node.link()),
            control: None,
            shapes: Vec::new(),
            arrows: Vec::new(),
            sequences: Vec::new(),
            aborts: Vec::new(),
            steps: false,
            flattened: None,
            span: self.span(&name),
        };
        self.control(node, &mut machine);
        for shape in node.shapes() {
            self.shape(&shape, &mut machine);
        }
        self.misplaced(node);
        let before = self.faults.len();
        for path in node.paths() {
            let stops: Vec<PathStop> = path.stops().collect();
            for pair in stops.windows(2) {
                self.arrow(&pair[0], &pair[1], &mut machine);
            }
        }
        for sequence in node.sequences() {
            let names: Vec<SyntaxToken> = sequence.names().collect();
            let shapes = names.iter().filter_map(|name| self.named(name, &machine)).collect();
            machine.sequences.push(shapes);
        }
        self.made(&machine);
        // Faults that follow from unknown names are not reported.
        let sound = self.faults.len() == before;
        self.faults.extend(structure::faults(&machine, sound));
        Some(machine)
    }

    /// Names from which functions are derived.
    fn made(&mut self, machine: &Machine) {
        if let Some(Control::Made { name, span }) = &machine.control {
            self.function_name(name, *span);
        }
        let guards = machine.shapes.iter().filter(|shape| shape.kind == ShapeKind::Guard && shape.link.is_none());
        for guard in guards {
            self.function_name(&function_name(&guard.name), guard.span);
        }
        if machine.answers() {
            self.function_name(&answer_name(machine), machine.span);
        }
    }

    pub(super) fn function_name(&mut self, name: &str, span: Span) {
        if !names_function(name) {
            self.faults.push(fault::made_name(span, name));
        }
    }

    pub(super) fn span(&self, token: &SyntaxToken) -> Span {
        Span::new(self.file, token.text_range())
    }

    fn link(&self, node: Option<ast::Link>) -> Option<Link> {
        node.and_then(|node| link(self.file, &node))
    }

    fn control(&mut self, node: &MachineChart, machine: &mut Machine) {
        let mut first: Option<Span> = None;
        for control in node.controls() {
            let span = Span::new(self.file, control.range());
            if let Some(first) = first {
                self.faults.push(fault::second_control(span, first));
                continue;
            }
            first = Some(span);
            machine.control = match (self.link(control.link()), control.name()) {
                (Some(link), _) => Some(Control::Linked(link)),
                (None, Some(name)) => Some(Control::Made { name: name.text().to_string(), span: self.span(&name) }),
                (None, None) => None,
            };
        }
    }

    /// What composite states cannot hold, and `history` outside of them.
    fn misplaced(&mut self, node: &MachineChart) {
        for composite in node.composites() {
            for control in composite.controls() {
                self.faults.push(fault::control_in_composite(Span::new(self.file, control.range())));
            }
            for second in composite.histories().skip(1) {
                self.faults.push(fault::second_history(Span::new(self.file, second.range())));
            }
        }
        for history in node.histories() {
            self.faults.push(fault::outside_composite(Span::new(self.file, history.range())));
        }
    }

    fn shape(&mut self, node: &ast::Shape, machine: &mut Machine) {
        let Some(name) = node.name() else { return };
        let span = self.span(&name);
        let named = |name: &SyntaxToken| machine.shapes.iter().position(|shape| shape.name == name.text()).map(ShapeId);
        let inside = node.around().and_then(|around| named(&ast::Shape::Composite(around).name()?));
        if let Some(first) = machine.shapes.iter().find(|shape| shape.name == name.text()) {
            self.faults.push(fault::duplicate(span, "shape", name.text(), first.span));
            return;
        }
        let kind = match node {
            ast::Shape::State(state) => ShapeKind::State { initial: state.is_initial() },
            ast::Shape::Composite(state) => {
                let mut histories = state.histories();
                let history = histories.next().map(|history| match self.link(history.link()) {
                    Some(link) => History::Linked(link),
                    None => History::Made,
                });
                ShapeKind::Composite(Composite { initial: state.is_initial(), history, ..Composite::default() })
            }
            ast::Shape::Guard(_) => ShapeKind::Guard,
            ast::Shape::Action(_) | ast::Shape::Entry(_) | ast::Shape::Exit(_) | ast::Shape::Abort(_) => {
                ShapeKind::Action
            }
            ast::Shape::Instance(instance) => ShapeKind::Instance(Pattern {
                name: instance.pattern().map(|name| name.text().to_string()).unwrap_or_default(),
                arguments: instance.arguments().iter().map(|argument| flat(argument.syntax())).collect(),
            }),
        };
        let id = ShapeId(machine.shapes.len());
        let around = inside.and_then(|around| match &mut machine.shapes[around.0].kind {
            ShapeKind::Composite(composite) => Some(composite),
            _ => None,
        });
        match (node, around) {
            (ast::Shape::Entry(_), Some(composite)) => composite.entry.push(id),
            (ast::Shape::Exit(_), Some(composite)) => composite.exit.push(id),
            (ast::Shape::Entry(_) | ast::Shape::Exit(_), None) => {
                self.faults.push(fault::outside_composite(span));
                return;
            }
            (ast::Shape::Abort(_), None) if machine.is_pattern => machine.aborts.push(id),
            (ast::Shape::Abort(_), _) => {
                self.faults.push(fault::outside_pattern(span));
                return;
            }
            _ => {}
        }
        let refinement = node.refinement().map(|node| Refinement { by: node.by().map(|name| name.text().to_string()) });
        machine.shapes.push(Shape {
            text: node.text().unwrap_or_else(|| spoken(name.text())),
            name: name.text().to_string(),
            kind,
            link: self.link(node.link()),
            refinement,
            inside,
            span,
        });
    }

    fn named(&mut self, name: &SyntaxToken, machine: &Machine) -> Option<ShapeId> {
        let found = machine.shapes.iter().position(|shape| shape.name == name.text());
        if found.is_none() {
            let names: Vec<&str> = machine.shapes.iter().map(|shape| shape.name.as_str()).collect();
            self.faults.push(fault::unknown(self.span(name), "shape", name.text(), &names));
        }
        found.map(ShapeId)
    }

    fn end(&mut self, stop: &PathStop, machine: &Machine) -> Option<End> {
        if stop.is_enter() {
            return Some(End::Enter);
        }
        if stop.is_exit() {
            return Some(End::Exit);
        }
        Some(End::Shape(self.named(&stop.name()?, machine)?))
    }

    fn arrow(&mut self, from: &PathStop, to: &PathStop, machine: &mut Machine) {
        let span = |stop: &PathStop| Span::new(self.file, stop.range());
        let (start, end) = (span(from), span(to));
        let target = self.end(to, machine);
        let Some(source) = self.end(from, machine) else { return };
        let (guard, is_instance) = match source {
            End::Shape(id) => {
                let kind = &machine.shape(id).kind;
                (*kind == ShapeKind::Guard, matches!(kind, ShapeKind::Instance(_)))
            }
            _ => (false, source == End::Exit),
        };
        let name = from.name().map(|name| name.text().to_string()).unwrap_or_default();
        match (guard, from.branch()) {
            (true, None) => self.faults.push(fault::bare_guard(start, &name)),
            // Which patterns answer is not known yet.
            (false, Some(_)) if !is_instance => self.faults.push(fault::needless_exit(start, &name)),
            _ => {}
        }
        if source == End::Exit {
            self.faults.push(fault::misplaced_exit(start, "exit", "nothing comes after the exit"));
        } else if target == Some(End::Enter) {
            self.faults.push(fault::misplaced_exit(end, "enter", "a pattern is entered from outside"));
        } else if let Some(target) = target {
            let (branch, answer) = (from.branch(), to.branch().filter(|_| target == End::Exit));
            let known =
                |arrow: &&Arrow| (arrow.from, arrow.branch, arrow.to, arrow.answer) == (source, branch, target, answer);
            // Two paths may both contain an arrow that they share.
            if machine.arrows.iter().find(known).is_none() {
                machine.arrows.push(Arrow { from: source, branch, to: target, answer, span: end });
            }
        }
    }
}

/// `timeElapsed` and `time_elapsed` as `Time elapsed`.
pub(crate) fn spoken(name: &str) -> String {
    let mut text = String::new();
    let mut before = ' ';
    for letter in name.chars() {
        if letter == '_' {
            text.push(' ');
        } else if letter.is_uppercase() && before.is_lowercase() {
            text.push(' ');
            text.extend(letter.to_lowercase());
        } else if text.is_empty() {
            text.extend(letter.to_uppercase());
        } else {
            text.push(letter);
        }
        before = letter;
    }
    text
}

#[cfg(test)]
mod tests {
    use super::spoken;

    #[test]
    fn names_are_spoken() {
        assert_eq!(spoken("timeElapsed"), "Time elapsed");
        assert_eq!(spoken("Waiting_for_trigger"), "Waiting for trigger");
        assert_eq!(spoken("SB"), "SB");
    }
}
