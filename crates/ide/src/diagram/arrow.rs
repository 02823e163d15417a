//! Arrows: paths of a machine that are begun, continued and split; connections of a system.

use syntax::SyntaxKind::*;
use syntax::ast::{AstNode, Channel, ChartPath, MachineChart, PathStop, PhaseKind, Shape};
use syntax::{SyntaxNode, SyntaxToken};

use super::{Section, Work};

/// An arrow, by its ends; `enter` and `exit` are ends of patterns, `exit yes` and `exit no` those of patterns that answer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Joint {
    /// Where it starts.
    pub from: String,
    /// The exit that it leaves, of a guard or of the block of a pattern that answers.
    pub branch: Option<bool>,
    /// Where it ends.
    pub to: String,
}

impl Joint {
    fn told(&self) -> String {
        let branch = self.branch.map_or("", |yes| if yes { " yes" } else { " no" });
        format!("{}{branch}", self.from)
    }
}

/// An arrow in the text: a path, and the number of the stop that it leaves.
struct Found {
    path: ChartPath,
    at: usize,
}

impl Work {
    /// See [`super::Operation::Connect`].
    pub(super) fn connect(&mut self, joint: &Joint) -> Result<(), String> {
        let machine = match self.section()? {
            Section::System(_) => return self.connect_parts(&joint.from, &joint.to),
            Section::Machine(machine) => machine,
        };
        let (joint, forks) = legal(&machine, joint)?;
        if find(&machine, |other| *other == joint).is_some() {
            return Ok(());
        }
        if !forks && let Some(found) = find(&machine, |other| other.from == joint.from && other.branch == joint.branch)
        {
            self.retarget(&found, &joint.to);
            return Ok(());
        }
        // A path that ends there goes on; a control state begins a path of its own.
        let Section::Machine(machine) = self.section()? else { return Ok(()) };
        let goes_on = machine.paths().filter(|_| !forks && joint.from != "enter").find(|path| {
            let last = path.stops().last();
            last.is_some_and(|stop| named(&stop).as_deref() == Some(&joint.from) && stop.branch().is_none())
        });
        match goes_on.and_then(|path| path.syntax().last_token()) {
            Some(end) => {
                let at = usize::from(end.text_range().end());
                let branch = joint.told().split_off(joint.from.len());
                self.replace(at..at, &format!("{branch} -> {}", joint.to));
            }
            None => self.add_line(|node| node.kind() == CHART_PATH, &format!("{} -> {}", joint.told(), joint.to))?,
        }
        Ok(())
    }

    /// See [`super::Operation::Redirect`].
    pub(super) fn redirect(&mut self, joint: &Joint, new: &Joint) -> Result<(), String> {
        if let Some((channel, old, writes)) = self.end_of(&joint.from, &joint.to) {
            let (kept, new) = if writes { (&new.to, &new.from) } else { (&new.from, &new.to) };
            if *kept != channel {
                return Err(format!("this arrow is an end of the channel `{channel}`: its other end stays there"));
            }
            return self.set_end(&channel, &old, new, writes);
        }
        if let Section::Machine(machine) = self.section()?
            && (&joint.from, joint.branch) == (&new.from, new.branch)
        {
            let (new, _) = legal(&machine, new)?;
            let found = find(&machine, |other| other == joint).ok_or_else(|| no_arrow(joint))?;
            if find(&machine, |other| *other == new).is_none() {
                self.retarget(&found, &new.to);
            } else if joint.to != new.to {
                self.split(&found);
            }
            return Ok(());
        }
        self.disconnect(joint)?;
        self.connect(new)
    }

    /// See [`super::Operation::Disconnect`].
    pub(super) fn disconnect(&mut self, joint: &Joint) -> Result<(), String> {
        match self.section()? {
            Section::System(system) => {
                let of = |token: Option<SyntaxToken>| token.map(|token| token.text().to_string());
                let channel = system.channels().find(|channel| of(channel.name()).as_deref() == Some(&joint.from));
                if let Some(channel) = channel
                    && channel.readers().any(|reader| reader.text() == joint.to)
                {
                    return self.remove_reader(&channel, joint);
                }
                let found = system.connections().find(|connection| {
                    of(connection.from()).as_deref() == Some(&joint.from)
                        && of(connection.to()).as_deref() == Some(&joint.to)
                });
                let found = found.ok_or_else(|| no_arrow(joint))?;
                self.remove(found.syntax());
            }
            Section::Machine(machine) => {
                let found = find(&machine, |other| other == joint).ok_or_else(|| no_arrow(joint))?;
                self.split(&found);
            }
        }
        Ok(())
    }

    /// Takes one of several readers of a channel away, with the phase in which it reads.
    fn remove_reader(&mut self, channel: &Channel, joint: &Joint) -> Result<(), String> {
        if channel.readers().count() < 2 {
            return Err(format!("`{}` has one reader: delete the channel instead", joint.from));
        }
        self.leave_readers(channel, &joint.to);
        while let Section::System(system) = self.section()?
            && let Some(component) =
                system.components().find(|part| part.name().is_some_and(|name| name.text() == joint.to))
            && let Some(phase) = component.phases().find(|phase| {
                phase.kind() == Some(PhaseKind::Read)
                    && phase.subject().is_some_and(|subject| subject.text() == joint.from)
            })
        {
            self.remove(phase.syntax());
        }
        Ok(())
    }

    /// Takes all arrows away that a shape has.
    pub(super) fn disconnect_all(&mut self, name: &str) -> Result<(), String> {
        while let Section::Machine(machine) = self.section()?
            && let Some(found) = find(&machine, |joint| joint.from == name || joint.to == name)
        {
            self.split(&found);
        }
        Ok(())
    }

    /// Takes an arrow out of its path: what is before it and what is behind it are paths of their own, if they have arrows.
    fn split(&mut self, found: &Found) {
        let stops: Vec<PathStop> = found.path.stops().collect();
        let start = |stop: &PathStop| first(stop.syntax()).map_or(0, |token| usize::from(token.text_range().start()));
        let named_end = |stop: &PathStop| {
            let word = words(stop.syntax()).into_iter().find(|token| !matches!(token.kind(), YES_KW | NO_KW));
            word.map_or(0, |token| usize::from(token.text_range().end()))
        };
        let (before, behind) = (found.at > 0, found.at + 2 < stops.len());
        let (from, to) = (&stops[found.at], &stops[found.at + 1]);
        match (before, behind) {
            (false, false) => self.remove(found.path.syntax()),
            (true, false) => {
                let end = words(found.path.syntax()).last().map_or(0, |token| usize::from(token.text_range().end()));
                self.cut(named_end(from)..end, "");
            }
            (false, true) => self.cut(start(from)..start(to), ""),
            (true, true) => {
                let indent = self.indent_of(found.path.syntax());
                self.cut(named_end(from)..start(to), &format!("\n{indent}"));
            }
        }
    }

    /// Leads an arrow elsewhere; what was behind its end is a path of its own.
    fn retarget(&mut self, found: &Found, to: &str) {
        let stops: Vec<PathStop> = found.path.stops().collect();
        let bounds = |stop: &PathStop| {
            let words = words(stop.syntax());
            let start = words.first().map_or(0, |token| usize::from(token.text_range().start()));
            start..words.last().map_or(start, |token| usize::from(token.text_range().end()))
        };
        let end = bounds(&stops[found.at + 1]);
        match found.at + 2 < stops.len() {
            false => self.replace(end, to),
            true => {
                let indent = self.indent_of(found.path.syntax());
                self.replace(end.start..end.start, &format!("{to}\n{indent}"));
            }
        }
    }

    /// Takes bytes away, but no comments that stand there.
    fn cut(&mut self, range: std::ops::Range<usize>, between: &str) {
        let inner = &self.text[range.clone()];
        let comments: Vec<&str> = if inner.contains("//") || inner.contains("/*") {
            inner.lines().map(str::trim).filter(|line| line.starts_with("//") || line.starts_with("/*")).collect()
        } else {
            Vec::new()
        };
        let kept: String = comments.iter().map(|comment| format!(" {comment}\n\t")).collect();
        let text = if kept.is_empty() { between.to_string() } else { kept };
        self.replace(range, &text);
    }
}

fn no_arrow(joint: &Joint) -> String {
    format!("there is no arrow from `{}` to `{}`", joint.told(), joint.to)
}

/// The arrow as the text would have it, and whether several may leave there.
fn legal(machine: &MachineChart, joint: &Joint) -> Result<(Joint, bool), String> {
    let shape = |name: &str| machine.shapes().find(|shape| shape.name().is_some_and(|own| own.text() == name));
    let mut joint = joint.clone();
    if joint.to == "enter" || joint.from == "exit" {
        return Err("an arrow leads from `enter` to `exit`, not back".to_string());
    }
    if !machine.is_pattern() && (joint.from == "enter" || is_exit(&joint.to)) {
        return Err("only a pattern is entered and left; this is a machine".to_string());
    }
    if !is_exit(&joint.to) && shape(&joint.to).is_none() {
        return Err(format!("there is no shape `{}`", joint.to));
    }
    if let Some(Shape::Entry(_) | Shape::Exit(_) | Shape::Abort(_)) = shape(&joint.to) {
        return Err(format!("`{}` is done by itself, and stands on no path", joint.to));
    }
    let forks = match (joint.from.as_str(), shape(&joint.from)) {
        ("enter", _) => true,
        (_, Some(Shape::State(_) | Shape::Composite(_))) => true,
        (_, Some(Shape::Guard(_))) => {
            let Some(_) = joint.branch else {
                return Err(format!("say which exit of `{}` it is: yes or no", joint.from));
            };
            return Ok((joint, false));
        }
        // Whether its pattern answers, the check tells: it may come from another file.
        (_, Some(Shape::Instance(_))) => return Ok((joint, false)),
        (_, Some(Shape::Action(_))) => false,
        (_, Some(Shape::Entry(_) | Shape::Exit(_) | Shape::Abort(_))) => {
            return Err(format!("`{}` is done by itself, and stands on no path", joint.from));
        }
        (_, None) => return Err(format!("there is no shape `{}`", joint.from)),
    };
    joint.branch = None;
    Ok((joint, forks))
}

/// Whether an arrow that ends there leaves the pattern, with or without an answer.
fn is_exit(name: &str) -> bool {
    ["exit", "exit yes", "exit no"].contains(&name)
}

/// What a stop names.
fn named(stop: &PathStop) -> Option<String> {
    match (stop.is_enter(), stop.is_exit()) {
        (true, _) => Some("enter".to_string()),
        (_, true) => Some(match stop.branch() {
            Some(true) => "exit yes".to_string(),
            Some(false) => "exit no".to_string(),
            None => "exit".to_string(),
        }),
        _ => Some(stop.name()?.text().to_string()),
    }
}

/// The first arrow that is wanted.
fn find(machine: &MachineChart, wanted: impl Fn(&Joint) -> bool) -> Option<Found> {
    machine.paths().find_map(|path| {
        let stops: Vec<PathStop> = path.stops().collect();
        let at = stops.windows(2).position(|ends| {
            let (Some(from), Some(to)) = (named(&ends[0]), named(&ends[1])) else { return false };
            wanted(&Joint { from, branch: ends[0].branch(), to })
        })?;
        Some(Found { path, at })
    })
}

/// The tokens of a node that mean something.
pub(super) fn words(node: &SyntaxNode) -> Vec<SyntaxToken> {
    let tokens = node.descendants_with_tokens().filter_map(|element| element.into_token());
    tokens.filter(|token| !token.kind().is_trivia()).collect()
}

fn first(node: &SyntaxNode) -> Option<SyntaxToken> {
    words(node).into_iter().next()
}
