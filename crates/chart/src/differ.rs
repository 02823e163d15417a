//! Decides whether two rules do the same in a control state. The conditions of each effect are compared exactly, as
//! propositional formulas over the tests.

use std::collections::BTreeMap;

use syntax::Span;

use crate::symbolic::{Effect, Guarded, Path, joined};

/// LIMIT: how many cases of one effect are distinguished; beyond that it counts as a difference.
const CASES: usize = 100_000;

/// The paths that lead to each effect, and its place.
pub(crate) type ByEffect = BTreeMap<String, (Vec<Path>, Option<Span>)>;

/// Groups effects with the paths that lead to them. Staying in the control state counts as no effect where nothing else becomes of the
/// control variable; elsewhere the two are inconsistent.
pub(crate) fn by_effect(effects: &[Guarded], control: &str, origin: &str) -> ByEffect {
    let mut found = ByEffect::new();
    let is_control = |effect: &Effect, stays: bool| match effect {
        Effect::Update { location, value, .. } => location == control && (value == origin) == stays,
        Effect::Rule(_) => false,
    };
    for guarded in effects {
        let paths = if is_control(&guarded.effect, true) {
            let leaving = effects.iter().filter(|other| is_control(&other.effect, false));
            leaving.filter_map(|other| joined(&guarded.path, &other.path)).collect()
        } else {
            vec![guarded.path.clone()]
        };
        if paths.is_empty() {
            continue;
        }
        let key = match &guarded.effect {
            Effect::Update { location, value, .. } => format!("{location} := {value}"),
            Effect::Rule(text) => text.clone(),
        };
        let entry = found.entry(key).or_default();
        entry.0.extend(paths);
        entry.1.get_or_insert(guarded.span);
    }
    found
}

/// Whether two rules do the same in one control state.
pub(crate) fn same(one: &[Guarded], other: &[Guarded], control: &str, origin: &str) -> bool {
    let (one, other) = (by_effect(one, control, origin), by_effect(other, control, origin));
    let paths = |side: &ByEffect, key: &str| side.get(key).map_or(Vec::new(), |(paths, _)| paths.clone());
    one.keys().chain(other.keys()).all(|key| difference(&paths(&one, key), &paths(&other, key)).is_none())
}

/// A case in which only one side has an effect, and whether that is the chart. Both sides are formulas in disjunctive
/// normal form, which are expanded test by test until they differ.
pub(crate) fn difference(chart: &[Path], rule: &[Path]) -> Option<(Path, bool)> {
    let mut budget = CASES;
    let mut case = Vec::new();
    let chart_does = parted(chart.to_vec(), rule.to_vec(), &mut case, &mut budget)?;
    Some((case, chart_does))
}

fn parted(chart: Vec<Path>, rule: Vec<Path>, case: &mut Path, budget: &mut usize) -> Option<bool> {
    let always = |paths: &[Path]| paths.iter().any(Vec::is_empty);
    let (chart_always, rule_always) = (always(&chart), always(&rule));
    if chart_always && rule_always || chart.is_empty() && rule.is_empty() {
        return None;
    }
    // An open test of a side that is not decided yet.
    let open = |paths: &[Path], decided: bool| {
        paths.iter().filter(|_| !decided).find_map(|path| path.first().map(|(atom, _)| atom.clone()))
    };
    let test = open(&chart, chart_always).or_else(|| open(&rule, rule_always)).filter(|_| *budget > 0);
    let Some(atom) = test else { return Some(chart_always || !rule_always && !chart.is_empty()) };
    *budget -= 1;
    for value in [true, false] {
        let under = |paths: &[Path]| -> Vec<Path> {
            let fits = paths.iter().filter(|path| !path.contains(&(atom.clone(), !value)));
            fits.map(|path| path.iter().filter(|(known, _)| *known != atom).cloned().collect()).collect()
        };
        case.push((atom.clone(), value));
        if let Some(chart_does) = parted(under(&chart), under(&rule), case, budget) {
            return Some(chart_does);
        }
        case.pop();
    }
    None
}
