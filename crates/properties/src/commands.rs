//! The commands of the tool on any text: each one ends, in a verdict or in faults.
//!
//! In: bytes, as the file that a command is given. Out: how many stages they passed, or a panic. What the shells add
//! (files, options, output) is not tested: these are the functions that they call, with everything reported about
//! faults.

use std::sync::Arc;

use chart::system::System;
use chart::{Chart, Known};
use draw::{Notation, export};
use groundstate::test_generation::{Method, Subject, generate_tests};
use groundstate::verify::review::{Meta, review};
use groundstate::{Loaded, verify};
use machine::{Closed, Machine};
use simulate::{Bounds, Choices, Inputs, RandomSource, Run};
use syntax::{Diagnostic, FileId, SourceFile, Sources};

use crate::run::scenario_never_panics;
use crate::world::{self, Models};

/// A kind of text, with every command that reads one.
#[derive(Debug, Clone, Copy)]
pub struct Commands {
    /// The ending of such files, without the dot.
    pub ending: &'static str,
    /// Runs them all; gives the number of stages that the bytes passed.
    pub run: fn(&[u8]) -> usize,
}

/// All kinds.
pub const COMMANDS: &[Commands] = &[
    Commands { ending: "asm", run: of_model },
    Commands { ending: "avalla", run: of_scenario },
    Commands { ending: "chart", run: of_chart },
    Commands { ending: "scxml", run: of_scxml },
];

/// LIMIT: a search ends after this many states, a walk after this many steps.
const STATES: u64 = 60;

struct NoSolver;

impl solve::Solver for NoSolver {
    fn solve(&mut self, _: &str) -> Result<String, String> {
        Err("there is no solver".to_string())
    }
}

/// Every reported fault lies in a text.
fn told(sources: &Sources, faults: &[Diagnostic]) {
    for fault in faults {
        for label in std::iter::once(&fault.primary).chain(&fault.secondary) {
            sources.position(label.span);
        }
    }
}

fn formatted(bytes: &[u8]) {
    syntax::assert_invariants(&bytes[..bytes.len().min(world::MAX_BYTES)]);
}

fn of_scenario(bytes: &[u8]) -> usize {
    formatted(bytes);
    1 + usize::from(scenario_never_panics(bytes))
}

/// `check`, `fmt`, `run`, `verify`, `review`, `generate-tests`, `generate cpp`, `chart extract`, `dump`.
fn of_model(bytes: &[u8]) -> usize {
    formatted(bytes);
    let source = world::source(&world::text(bytes));
    let checked = groundstate::check(source.clone(), &mut Models::default());
    told(&checked.sources, &checked.diagnostics);
    let loaded = match groundstate::load(source.clone(), &mut Models::default()) {
        Ok(loaded) => loaded,
        Err(faulty) => {
            told(&faulty.sources, &faulty.diagnostics);
            return 1;
        }
    };
    let mut stages = 2;
    program::dump(&loaded.program);
    charts_of(&loaded, &source);
    let program = Arc::clone(&loaded.program);
    let mut started = Machine::new(Arc::clone(&program), world::limits());
    let _ = started.start(&mut Closed);
    match generate::model::generate(&program, &loaded.sources, &mut started, &generate::model::Options::default()) {
        Ok(_) => stages += 1,
        Err(refused) => told(&loaded.sources, &refused),
    }
    if program.main.is_none() {
        return stages;
    }
    runs(&loaded, bytes.len() as u64);
    stages + explored(&loaded, &program)
}

fn runs(loaded: &Loaded, seed: u64) {
    let inputs = Inputs::new().with(RandomSource::new(seed, Bounds::default())).choosing(Choices::random(seed));
    let options = simulate::Options { steps: Some(10), ..Default::default() };
    let program = Arc::clone(&loaded.program);
    let mut run = Run::new(Arc::clone(&program), world::limits(), inputs, options);
    while let Some(record) = run.advance() {
        if let simulate::Record::End(simulate::End::Fault(fault)) = record {
            told(&loaded.sources, &[groundstate::diagnose_fault(&fault, &program)]);
        }
    }
}

fn explored(loaded: &Loaded, program: &Arc<program::Program>) -> usize {
    let engine = |engine| verify::Options {
        limits: world::limits(),
        max_states: STATES,
        max_depth: STATES,
        max_bytes: 64 << 20,
        engine,
        ..verify::Options::default()
    };
    let mut stages = 0;
    // LIMIT: one state may have very many successors; a search that made this much progress is ended.
    let mut steps = 0;
    let mut watch = |_: &verify::Progress| {
        steps += 1;
        steps < 10_000
    };
    let options = engine(verify::EngineKind::Explicit);
    stages += usize::from(verify::verify(program, &options, &mut watch).is_ok());
    let own = |file: FileId| file == loaded.model.root;
    if let Ok(review) = review(&loaded.model, program, &options, &Meta::ALL, &own, &mut watch) {
        stages += 1;
        for finding in &review.findings {
            told(&loaded.sources, &[groundstate::diagnose_finding(finding, &review, program)]);
        }
    }
    let subject = Subject { model: &loaded.model, program, turns: &[], path: "Model.asm" };
    for method in [Method::Search, Method::Random(2, 5, 1)] {
        stages += usize::from(generate_tests(subject, &options, method, &own, &mut watch).is_ok());
    }
    stages
}

/// The charts of a model's rules, written down, read again, and held to the model.
fn charts_of(loaded: &Loaded, source: &SourceFile) {
    let mut found = chart::extract(&loaded.model, None, None);
    if found.chart.machines.is_empty() {
        return;
    }
    extracted(&found.chart, source);
    chart::nest(&loaded.model, &mut found);
    extracted(&found.chart, source);
}

fn extracted(found: &Chart, source: &SourceFile) {
    let text = chart::write(found);
    let parse = syntax::parse_chart(FileId(0), &text);
    let (chart, faults) = chart::read(FileId(0), &parse);
    assert!(!groundstate::has_errors(&faults), "the chart that is extracted is at fault: {text}");
    let probed = chart::probed(&chart, &source.text).expect("the model has no faults");
    let checked = groundstate::check(SourceFile::new(source.name.clone(), probed.text.clone()), &mut Models::default());
    let faults = chart::check(&chart, &probed, &checked, &mut NoSolver);
    let errors: Vec<&Diagnostic> = faults.iter().filter(|fault| fault.severity == syntax::Severity::Error).collect();
    assert!(errors.is_empty(), "the chart that is extracted does not agree with its model: {errors:#?}\n{text}");
    drawn(found);
}

/// All of `chart`, and `generate cpp` of systems.
fn of_chart(bytes: &[u8]) -> usize {
    formatted(bytes);
    let text = world::text(bytes);
    let loaded = chart::load(SourceFile::new("Model.chart", text.as_str()), &mut Models::default());
    told(&loaded.sources, &loaded.diagnostics);
    chart::dump(&loaded.chart);
    if groundstate::has_errors(&loaded.diagnostics) {
        return 1;
    }
    let chart = &loaded.chart;
    chart::write(chart);
    for machine in &chart.machines {
        chart::transitions(chart, machine);
    }
    let mut stages = 2 + drawn(chart);
    let parse = syntax::parse_chart(FileId(0), &text);
    let _ = draw::place(chart, &parse, &text, |_| true);
    if let Some(system) = &chart.system {
        stages += generated(system, &loaded.sources);
    }
    let known = match Known::imported(chart, "Imports.asm", &mut Models::default()) {
        Ok(known) => known,
        Err(unknown) => {
            told(&loaded.sources, &unknown.imports);
            told(&unknown.checked.sources, &unknown.modules);
            return stages;
        }
    };
    let unbuilt = chart::unbuilt(chart, &known);
    told(&loaded.sources, &unbuilt);
    if !unbuilt.is_empty() {
        return stages;
    }
    let Ok(built) = chart::build(chart, &known, None) else { return stages };
    stages += 1;
    if let Ok(probed) = chart::probed(chart, &built.text) {
        let source = SourceFile::new("Model.asm", probed.text.clone());
        let checked = groundstate::check(source, &mut Models::default());
        told(&checked.sources, &checked.diagnostics);
        chart::check(chart, &probed, &checked, &mut NoSolver);
        stages += 1;
    }
    stages
}

fn drawn(chart: &Chart) -> usize {
    let mut stages = 0;
    for drawing in draw::drawings(chart) {
        stages += usize::from(drawing.svg(draw::Theme::Light).is_ok());
        for notation in [Notation::Mermaid, Notation::Dot, Notation::Scxml] {
            if let Some(text) = export(&drawing, notation)
                && let Notation::Scxml = notation
            {
                chart::import::scxml(FileId(0), &text, "Back");
            }
        }
    }
    stages
}

fn generated(system: &System, sources: &Sources) -> usize {
    let faults = generate::system::ungenerated(system);
    told(sources, &faults);
    if !faults.is_empty() {
        return 0;
    }
    for wait_free in [false, true] {
        let form = generate::system::Form { wait_free, ..Default::default() };
        generate::system::generate(system, "Model.chart", &form);
    }
    1
}

fn of_scxml(bytes: &[u8]) -> usize {
    let text = world::text(bytes);
    let imported = chart::import::scxml(FileId(0), &text, "Imported");
    let mut sources = Sources::default();
    sources.add(SourceFile::new("Model.scxml", text));
    told(&sources, &imported.diagnostics);
    match imported.text {
        Some(text) => 1 + of_chart(text.as_bytes()),
        None => 0,
    }
}
