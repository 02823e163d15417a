//! What is built of charts with composite states does what these mean (spec/charts.md, "Composite states"); so does what their SCXML
//! is read back as, and what tools that do not know our own attributes in it make of it.
//!
//! The judge walks over the chart as it is drawn: from the outermost state around the present one inwards, it takes the first that has
//! open paths. It knows nothing of flat machines. All make the same random runs.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::sync::Arc;

use chart::{Chart, Composite, End, Known, Machine as Drawn, ShapeId, ShapeKind};
use machine::{Choice, Environment, FaultClass, Limits, LocationRef, Machine, Show, TimeUnit, Value};
use program::{DomainId, Program};
use syntax::{Diagnostic, FileId, Severity, SourceFile, parse_chart};
use testkit::{Texts, sample};

struct Dice(u64);

impl Dice {
    fn throw(&mut self, below: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 33) as usize % below
    }
}

/// A random chart, and the module of what its actions do: each counts how often it was done.
struct Made {
    dice: Dice,
    shapes: String,
    states: Vec<String>,
    blocks: Vec<String>,
    composites: Vec<String>,
    actions: Vec<String>,
    guards: usize,
}

impl Made {
    fn of(seed: u64) -> (String, String) {
        let mut made = Made {
            dice: Dice(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1),
            shapes: String::new(),
            states: Vec::new(),
            blocks: Vec::new(),
            composites: Vec::new(),
            actions: ["begin", "finish", "giveBack"].map(str::to_string).to_vec(),
            guards: 0,
        };
        made.level(0);
        let places: Vec<String> = [&made.states[..], &made.blocks, &made.composites].concat();
        let mut paths = String::new();
        for from in &places {
            // A pattern is left over one path.
            let count = if made.blocks.contains(from) { 1 } else { made.dice.throw(3) };
            for _ in 0..count {
                made.path(from, &places, &mut paths);
            }
        }
        let mut text =
            format!("chart Nested\nimport Acts\nmachine nested\ncontrol mode\n{}{paths}endmachine\n", made.shapes);
        text.push_str(
            "pattern work control task\nstate half\nstate whole\nguard goes\nguard ends\naction begin {r_begin[]}\n\
             action finish {r_finish[]}\nabort giveBack {r_giveBack[]}\nenter -> begin -> half\n\
             half -> goes yes -> whole\nwhole -> ends yes -> finish -> exit\nendpattern\n",
        );
        let mut acts = "module Acts\nimport StandardLibrary\nexport *\nsignature:\n".to_string();
        for action in &made.actions {
            let _ = writeln!(acts, "controlled {action}Times: Integer");
        }
        acts.push_str("definitions:\n");
        for action in &made.actions {
            let _ = writeln!(
                acts,
                "rule r_{action} = {action}Times := if isUndef({action}Times) then 1 else {action}Times + 1 endif"
            );
        }
        (text, acts)
    }

    fn level(&mut self, depth: usize) {
        for index in 0..1 + self.dice.throw(3) {
            let initial = if index == 0 { "initial " } else { "" };
            match self.dice.throw(10) {
                0..4 if depth < 3 => {
                    let name = format!("around{}", self.composites.len());
                    let _ = writeln!(self.shapes, "{initial}composite state {name}");
                    self.composites.push(name.clone());
                    if self.dice.throw(2) == 0 {
                        self.shapes.push_str("history\n");
                    }
                    for word in ["entry", "exit"] {
                        if self.dice.throw(2) == 0 {
                            self.act(word);
                        }
                    }
                    self.level(depth + 1);
                    self.shapes.push_str("endstate\n");
                }
                4..6 if index > 0 => {
                    let name = format!("block{}", self.blocks.len());
                    let _ = writeln!(self.shapes, "instance {name} of work");
                    self.blocks.push(name);
                }
                _ => {
                    let name = format!("state{}", self.states.len());
                    let _ = writeln!(self.shapes, "{initial}state {name}");
                    self.states.push(name);
                }
            }
        }
    }

    fn act(&mut self, word: &str) -> String {
        let name = format!("act{}", self.actions.len());
        let _ = writeln!(self.shapes, "{word} {name} {{r_{name}[]}}");
        self.actions.push(name.clone());
        name
    }

    fn guard(&mut self) -> String {
        self.guards += 1;
        let name = format!("open{}", self.guards);
        let _ = writeln!(self.shapes, "guard {name}");
        name
    }

    fn end(&mut self, places: &[String]) -> String {
        let act = if self.dice.throw(2) == 0 { self.act("action") + " -> " } else { String::new() };
        format!("{act}{}", places[self.dice.throw(places.len())])
    }

    fn path(&mut self, from: &str, places: &[String], paths: &mut String) {
        let guard = self.guard();
        let exit = if self.dice.throw(4) == 0 { "no" } else { "yes" };
        let more = if self.dice.throw(3) == 0 { self.guard() + " yes -> " } else { String::new() };
        let end = self.end(places);
        let _ = writeln!(paths, "{from} -> {guard} {exit} -> {more}{end}");
        if self.dice.throw(4) == 0 {
            let end = self.end(places);
            let _ = writeln!(paths, "{guard} {} -> {end}", if exit == "no" { "yes" } else { "no" });
        }
    }
}

/// Where the judge is.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Place {
    leaf: ShapeId,
    /// The control state of the pattern.
    task: Option<&'static str>,
    /// By composite state with a history, where it was left.
    left: BTreeMap<ShapeId, ShapeId>,
}

struct Judge<'c> {
    drawn: &'c Drawn,
    place: Place,
    times: BTreeMap<String, i64>,
}

type Open = BTreeMap<String, bool>;

impl Judge<'_> {
    fn composite(&self, id: ShapeId) -> Option<&Composite> {
        match &self.drawn.shape(id).kind {
            ShapeKind::Composite(composite) => Some(composite),
            _ => None,
        }
    }

    fn name(&self, id: ShapeId) -> String {
        self.drawn.shape(id).name.clone()
    }

    fn is_block(&self, id: ShapeId) -> bool {
        matches!(self.drawn.shape(id).kind, ShapeKind::Instance(_))
    }

    /// The open paths from a state: what each does and where it leads.
    fn open_from(&self, from: ShapeId, open: &Open) -> Vec<(BTreeSet<String>, ShapeId)> {
        let mut found = Vec::new();
        for arrow in self.drawn.out_of(End::Shape(from)) {
            let (mut end, mut does) = (Some(arrow.to), BTreeSet::new());
            while let Some(End::Shape(id)) = end {
                match self.drawn.shape(id).kind {
                    ShapeKind::Guard => end = self.drawn.branch(id, open[&self.name(id)]).map(|arrow| arrow.to),
                    ShapeKind::Action => {
                        does.insert(self.name(id));
                        end = self.drawn.out_of(End::Shape(id)).next().map(|arrow| arrow.to);
                    }
                    _ => {
                        found.push((does, id));
                        break;
                    }
                }
            }
        }
        found
    }

    /// What a path does and where it leads, if it starts at the composite state `from`, or at the innermost state.
    fn taken(&self, from: Option<ShapeId>, does: BTreeSet<String>, target: ShapeId) -> (BTreeSet<String>, Place) {
        let (mut does, mut next) = (does, self.place.clone());
        let inside = |id: ShapeId, outer: ShapeId| self.drawn.around(id).contains(&outer);
        let mut kept = BTreeSet::new();
        for outer in self.drawn.around(self.place.leaf) {
            let within_from = from.is_some_and(|from| outer == from || inside(outer, from));
            if inside(target, outer) && !within_from {
                kept.insert(outer);
                continue;
            }
            let Some(composite) = self.composite(outer) else { continue };
            does.extend(composite.exit.iter().map(|id| self.name(*id)));
            if composite.history.is_some() {
                next.left.insert(outer, self.place.leaf);
            }
        }
        if from.is_some() && self.is_block(self.place.leaf) && next.task.take().is_some() {
            does.insert("giveBack".to_string());
        }
        let mut leaf = target;
        while let Some(composite) = self.composite(leaf) {
            let children = || self.drawn.numbered().filter(|(_, one)| one.inside == Some(leaf)).map(|(id, _)| id);
            let holds = |child: &ShapeId| {
                let left = next.left.get(&leaf).filter(|_| composite.history.is_some());
                left.is_some_and(|left| left == child || inside(*left, *child))
            };
            let first = || children().find(|child| self.drawn.shape(*child).is_initial()).expect("it begins somewhere");
            leaf = children().find(holds).unwrap_or_else(first);
        }
        for outer in self.drawn.around(leaf).into_iter().filter(|outer| !kept.contains(outer)) {
            let entry = self.composite(outer).map(|composite| composite.entry.clone()).unwrap_or_default();
            does.extend(entry.iter().map(|id| self.name(*id)));
        }
        next.leaf = leaf;
        if self.is_block(leaf) {
            does.insert("begin".to_string());
            next.task = Some("HALF");
        }
        (does, next)
    }

    /// Makes a step; false if two open paths contradict each other.
    fn step(&mut self, open: &Open) -> bool {
        let leaf = self.place.leaf;
        let outer = self.drawn.around(leaf).into_iter().rev().map(Some);
        for from in outer.chain([None]) {
            if from.is_none() && self.is_block(leaf) && self.place.task.is_some() {
                self.work(open);
                return true;
            }
            let paths = self.open_from(from.unwrap_or(leaf), open);
            let taken: Vec<_> = paths.into_iter().map(|(does, to)| self.taken(from, does, to)).collect();
            let Some((_, first)) = taken.first() else { continue };
            let does: BTreeSet<String> = taken.iter().flat_map(|(does, _)| does.clone()).collect();
            let target = |place: &Place| (place.leaf, place.task);
            if taken.iter().any(|(_, place)| target(place) != target(first)) {
                return false;
            }
            // What is remembered is the present state, whichever path says so.
            let left = taken.iter().flat_map(|(_, place)| place.left.clone()).filter(|(_, at)| *at == leaf);
            self.place.left.extend(left);
            self.place = Place { left: self.place.left.clone(), ..first.clone() };
            self.count(does);
            return true;
        }
        true
    }

    /// How many paths are open in the outermost state that has any.
    fn paths_open(&self, open: &Open) -> usize {
        let outer = self.drawn.around(self.place.leaf).into_iter().rev();
        let all = outer.chain([self.place.leaf]).map(|from| self.open_from(from, open).len());
        all.into_iter().find(|open| *open > 0).unwrap_or_default()
    }

    /// A step of the pattern.
    fn work(&mut self, open: &Open) {
        match self.place.task {
            Some("HALF") if open["goes"] => self.place.task = Some("WHOLE"),
            Some("WHOLE") if open["ends"] => {
                self.place.task = None;
                self.count(["finish".to_string()].into());
            }
            _ => {}
        }
    }

    fn count(&mut self, does: BTreeSet<String>) {
        for action in does {
            *self.times.entry(action).or_default() += 1;
        }
    }
}

struct Given<'o>(&'o Open);

impl Environment for Given<'_> {
    fn monitored(&mut self, program: &Program, location: LocationRef<'_>, _: DomainId) -> Result<Value, String> {
        Ok(Value::Boolean(self.0[&program.function(location.function).name]))
    }

    fn choose(&mut self, _: &Program, _: &Choice<'_>) -> Result<usize, String> {
        Err("nothing is chosen".to_string())
    }

    fn time(&mut self, _: TimeUnit) -> Result<i64, String> {
        Err("there is no clock".to_string())
    }
}

fn read(text: &str) -> Chart {
    let (chart, faults) = chart::read(FileId(0), &parse_chart(FileId(0), text));
    assert!(faults.iter().all(|fault| fault.severity != Severity::Error), "{faults:#?}\n{text}");
    chart
}

/// The chart that SCXML of its machine reads back as, with its patterns.
fn exchanged(chart: &Chart) -> Chart {
    let document = chart::scxml_of(chart, &chart.machines[0]);
    let imported = chart::import::scxml(FileId(0), &document, "Nested");
    assert_eq!(imported.diagnostics, [], "{document}");
    let text = imported.text.expect("there are no errors");
    let patterns = Chart { machines: chart.machines[1..].to_vec(), ..chart.clone() };
    let own = text.lines().skip(1).filter(|line| !line.starts_with("import"));
    read(&(chart::write(&patterns) + &own.collect::<Vec<_>>().join("\n")))
}

/// What SCXML of the chart's machine means to a tool that does not know our own attributes and elements: it is read as a foreign
/// document. `None` for what is not read of these: patterns, and some histories.
fn foreign(chart: &Chart) -> Option<Chart> {
    let machine = &chart.machines[0];
    if machine.shapes.iter().any(|shape| matches!(shape.kind, ShapeKind::Instance(_))) {
        return None;
    }
    let document = chart::scxml_of(chart, machine);
    let lines = document.lines().filter(|line| !line.trim_start().starts_with("<gs:"));
    let plain: Vec<String> = lines
        .map(|line| {
            let mut parts = line.split(" gs:");
            let first = parts.next().unwrap_or_default().to_string();
            // What follows the value of the attribute.
            parts.fold(first, |line, part| line + part.splitn(3, '"').last().unwrap_or_default())
        })
        .collect();
    let imported = chart::import::scxml(FileId(0), &plain.join("\n"), "Nested");
    let is_known = |told: &Diagnostic| told.message.contains("at the start") || told.message.contains("`history`");
    assert!(imported.diagnostics.iter().all(is_known), "{:#?}", imported.diagnostics);
    let text = imported.text?;
    Some(read(&text.replace("control nestedState", "control mode").replacen('\n', "\nimport Acts\n", 1)))
}

/// The built model, and its text.
fn built(chart: &Chart, acts: &str) -> (Arc<Program>, String) {
    let mut loader = Texts::of([("Acts.asm", acts)]);
    let text = "module Imports\nimport Acts\nimport StandardLibrary\nsignature:\ndefinitions:\n";
    let known = model::check(SourceFile::new("Imports.asm", text), &mut loader);
    let text = chart::build(chart, &Known::of(&known.model), None).expect("there is nothing yet").text;
    let loaded = groundstate::load(SourceFile::new("Nested.asm", text.as_str()), &mut loader);
    (loaded.unwrap_or_else(|faulty| panic!("{:#?}\n{text}", faulty.diagnostics)).program, text)
}

/// The state of the machine, in words: functions without arguments that have a value.
fn state(machine: &Machine) -> BTreeMap<String, String> {
    let program = machine.program();
    let all = machine.locations().into_iter().filter(|(_, value)| *value != Value::Undef);
    let controlled = |id| program.function(id).kind == program::FunctionKind::Controlled;
    all.filter(|(location, _)| controlled(location.function))
        .map(|(location, value)| (program.function(location.function).name.clone(), value.show(program).to_string()))
        .collect()
}

impl Judge<'_> {
    fn state(&self) -> BTreeMap<String, String> {
        let literal = |id: ShapeId| self.name(id).to_uppercase();
        let mut state = BTreeMap::from([("mode".to_string(), literal(self.place.leaf))]);
        state.extend(self.place.task.map(|task| ("task".to_string(), task.to_string())));
        state
            .extend(self.place.left.iter().map(|(outer, leaf)| (format!("{}Left", self.name(*outer)), literal(*leaf))));
        state.extend(self.times.iter().map(|(action, times)| (format!("{action}Times"), times.to_string())));
        state
    }
}

/// How many steps of a run are made, and what was seen of all that may happen.
fn runs(seed: u64, seen: &mut BTreeMap<&'static str, usize>) {
    let (text, acts) = Made::of(seed);
    let chart = read(&text);
    let (again, _) = built(&exchanged(&chart), &acts);
    // There, a guard is a text.
    let guards = chart.machines[0].shapes.iter().filter(|shape| shape.kind == ShapeKind::Guard);
    let inputs: String = guards.map(|guard| format!("monitored {}: Boolean\n", guard.name)).collect();
    let with_inputs = acts.replacen("definitions:", &format!("{inputs}definitions:"), 1);
    let foreign = foreign(&chart).map(|foreign| built(&foreign, &with_inputs).0);
    let (program, built) = built(&chart, &acts);
    let drawn = &chart.machines[0];
    let mut dice = Dice(seed | 1 << 40);
    for _ in 0..4 {
        let mut machine = Machine::new(Arc::clone(&program), Limits::default());
        let none = Open::new();
        machine.start(&mut Given(&none)).expect("nothing is asked");
        let mut other = Machine::new(Arc::clone(&again), Limits::default());
        other.start(&mut Given(&none)).expect("nothing is asked");
        let mut foreign = foreign.as_ref().map(|program| Machine::new(Arc::clone(program), Limits::default()));
        if let Some(machine) = &mut foreign {
            machine.start(&mut Given(&none)).expect("nothing is asked");
        }
        let first = drawn.initial().expect("there is an initial state");
        let place = Place { leaf: first, task: None, left: BTreeMap::new() };
        let mut judge = Judge { drawn, place, times: BTreeMap::new() };
        for _ in 0..60 {
            let guards = chart.machines.iter().flat_map(|machine| &machine.shapes);
            let guards = guards.filter(|shape| shape.kind == ShapeKind::Guard);
            let open: Open = guards.map(|guard| (guard.name.clone(), dice.throw(3) == 0)).collect();
            let before = judge.place.clone();
            // Of two open paths, SCXML takes the first.
            foreign = foreign.filter(|_| judge.paths_open(&open) < 2);
            let made = judge.step(&open);
            if let Some(machine) = &mut foreign {
                machine.step(&mut Given(&open)).expect("one path is taken");
                // What is remembered counts when it is gone back to: it is left again before, if it is not left now.
                let seen_of =
                    |mut state: BTreeMap<String, String>| (state.retain(|name, _| !name.ends_with("Left")), state).1;
                let (there, here) = (seen_of(state(machine)), seen_of(judge.state()));
                assert_eq!(there, here, "seed {seed}: elsewhere, from {before:?}, {open:?}\n{text}");
                *seen.entry("memories elsewhere").or_default() += usize::from(judge.place.left != before.left);
                *seen.entry("steps elsewhere").or_default() += usize::from(judge.place.leaf != before.leaf);
            }
            assert_eq!(other.step(&mut Given(&open)).is_ok(), made, "seed {seed}: of SCXML\n{text}");
            match machine.step(&mut Given(&open)) {
                Ok(_) => assert!(made, "seed {seed}: two paths contradict each other\n{text}\n{built}"),
                Err(fault) => {
                    assert_eq!(FaultClass::of(&fault), FaultClass::Inconsistent, "{fault:?}\n{built}");
                    assert!(!made, "seed {seed}: {before:?} {fault:?}\n{text}\n{built}");
                    *seen.entry("contradictions").or_default() += 1;
                    break;
                }
            }
            assert_eq!(state(&machine), judge.state(), "seed {seed}, from {before:?}, {open:?}\n{text}\n{built}");
            assert_eq!(state(&other), judge.state(), "seed {seed}: of SCXML, from {before:?}, {open:?}\n{text}");
            let aborted = before.task.is_some() && judge.place.leaf != before.leaf;
            *seen.entry("aborts").or_default() += usize::from(aborted);
            *seen.entry("memories").or_default() += usize::from(judge.place.left != before.left);
            *seen.entry("moves").or_default() += usize::from(judge.place.leaf != before.leaf);
        }
    }
}

#[test]
fn what_is_built_does_what_is_drawn() {
    let mut seen = BTreeMap::new();
    for seed in sample::seeds(120, 20_000) {
        runs(seed, &mut seen);
    }
    for what in ["moves", "aborts", "memories", "contradictions", "steps elsewhere"] {
        assert!(seen[what] > 20, "{seen:?}");
    }
    assert!(seen["memories elsewhere"] > 5, "{seen:?}");
}

#[test]
fn the_text_of_a_chart_reads_back() {
    for seed in 1..=60 {
        let chart = read(&Made::of(seed).0);
        let text = chart::write(&chart);
        let again = read(&text);
        assert_eq!(chart::dump(&again), chart::dump(&chart), "{text}");
        assert_eq!(chart::write(&again), text);
    }
}
