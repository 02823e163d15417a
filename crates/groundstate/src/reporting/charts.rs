//! The charts of a report specification: reads them, draws them, and finds what lights up when.
//!
//! In: the file names, and the elements that their machines work for. Out: pictures, and terms in the specification.
//! The charts themselves define what is lit when.

use std::path::Path;

use chart::{Lights, NotDrawn, Pictures, subjects};
use model::Loader;
use report::{ChartSpec, LightsSpec, PartSpec, Specification, TermPlace, Wanted, specification_fault};
use syntax::{Diagnostic, Sources};

use crate::has_errors;
use crate::workspace::Files;

/// The CSS class of the pictures in the page.
const CLASS: &str = "chart";

/// Adds the named charts to the specification, which lies at `path`, and returns their faults. `page` tells their pictures from others on
/// the same page.
pub fn add<F: Files + Loader>(
    files: &mut F,
    sources: &mut Sources,
    specification: &mut Specification,
    (path, page): (&str, &str),
    pictures: &dyn Pictures,
) -> Result<Vec<Diagnostic>, NotDrawn> {
    let mut faults = Vec::new();
    for wanted in std::mem::take(&mut specification.charts) {
        let file = Path::new(path).parent().unwrap_or(Path::new("")).join(&wanted.file);
        let file = file.to_string_lossy();
        let source = match files.read(&file) {
            Ok(source) => source,
            Err(absent) => {
                faults.push(specification_fault(wanted.span, absent.told(&file)));
                continue;
            }
        };
        let loaded = chart::load_beside(std::mem::take(sources), source, files);
        *sources = loaded.sources;
        let chart = loaded.chart;
        let whole = !has_errors(&loaded.diagnostics);
        faults.extend(loaded.diagnostics);
        if whole {
            show(specification, (&chart, page), &wanted, pictures, &mut faults)?;
        }
    }
    specification.spec.chart_style = pictures.style(CLASS);
    Ok(faults)
}

fn show(
    specification: &mut Specification,
    (chart, page): (&chart::Chart, &str),
    wanted: &Wanted,
    pictures: &dyn Pictures,
    faults: &mut Vec<Diagnostic>,
) -> Result<(), NotDrawn> {
    let names: Vec<&str> = subjects(chart).map(|subject| subject.name()).collect();
    for machine in wanted.machines.iter().filter(|machine| !names.contains(&machine.name.as_str())) {
        let unknown = specification_fault(machine.span, format!("{} has no machine `{}`", wanted.file, machine.name));
        faults.push(unknown.with_help(format!("it has: {}", names.join(", "))));
    }
    let elements: Vec<String> = wanted.each.iter().map(|(id, _)| id.clone()).collect();
    for subject in subjects(chart) {
        let own = wanted.machines.iter().find(|machine| machine.name == subject.name());
        if own.is_none() && !wanted.machines.is_empty() {
            continue;
        }
        let prefix = format!("{page}chart-{}-", specification.spec.charts.len());
        let picture = pictures.part(subject, &prefix, CLASS)?;
        let parametric = subject.machine().is_some_and(|machine| !machine.parameters.is_empty());
        let lights = subject.lights(&elements);
        let lights = lights.into_iter().enumerate().map(|(index, lights)| {
            let element = parametric.then(|| &wanted.each[index]);
            let when = own.and_then(|machine| machine.when.as_ref());
            let when = when.map(|(term, span)| (term.replace("{}", element.map_or("", |(id, _)| id)), *span));
            specification.places.entry(lights.term.clone()).or_insert(TermPlace::whole(wanted.span));
            if let Some((term, span)) = &when {
                specification.places.entry(term.clone()).or_insert(TermPlace::whole(*span));
            }
            of(lights, element.map(|(_, name)| name.clone()), when.map(|(term, _)| term))
        });
        let lights = lights.collect();
        specification.spec.charts.push(ChartSpec { title: subject.title(), picture, lights, named: parametric });
    }
    Ok(())
}

fn of(lights: Lights, name: Option<String>, when: Option<String>) -> LightsSpec {
    let parts = lights.shapes.into_iter();
    let parts = parts.map(|light| PartSpec { value: light.value, part: light.shape, label: light.label });
    LightsSpec { name: name.unwrap_or(lights.name), term: lights.term, when, parts: parts.collect() }
}
