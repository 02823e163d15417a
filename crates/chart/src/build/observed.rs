//! The parts of a ground model that run around each tick: they count what a chart bounds beside the ages of data, deadlines that a task
//! misses and the time until a reader gets something new; and they say when a cycle is released, where that varies.
//!
//! In: a system without errors. Out: elements, configuration, initial values and invariants for `patterns/MissedDeadlines` and
//! `patterns/FreshReadings`, and the rules of these and of `patterns/ReleaseJitter`. INVARIANT: a system with nothing of this is built as if
//! this were not here.

use crate::system::{Action, ChannelKind, Component, FreshBound, Phase, System, Tolerance};

use super::module::Item;
use super::table::by_case;

/// A module whose rules run around each tick.
pub(super) struct Observer {
    /// In the pattern library.
    pub(super) module: &'static str,
    /// In the verification library: what makes its states finite.
    pub(super) in_ticks: Option<&'static str>,
    /// Called before the tick.
    before: &'static str,
    /// Called after the tick.
    after: &'static str,
    /// Called at last, where states are to be finite.
    forget: &'static str,
}

const MISSED: Observer = Observer {
    module: "MissedDeadlines",
    in_ticks: Some("MissedInTicks"),
    before: "r_beforeCycles[]\n",
    after: "r_countMissed[]\n",
    forget: "r_forgetMissed[]\n",
};

const FRESH: Observer = Observer {
    module: "FreshReadings",
    in_ticks: Some("FreshInTicks"),
    before: "r_beforeReadings[]\n",
    after: "r_countReadings[]\n",
    forget: "r_forgetReadings[]\n",
};

/// It keeps nothing from one tick to the next.
const RELEASES: Observer = Observer {
    module: "ReleaseJitter",
    in_ticks: None,
    before: "r_release[]\n",
    after: "r_forgetReleases[]\n",
    forget: "",
};

/// What has to observe a system.
pub(super) fn observers(system: &System) -> Vec<&'static Observer> {
    let missed = system.components.iter().any(|component| component.tolerance.is_some()).then_some(&MISSED);
    let fresh = readings(system).next().is_some().then_some(&FRESH);
    missed.into_iter().chain(fresh).chain(system.has_jitter().then_some(&RELEASES)).collect()
}

/// A tick with what observes it, as one rule: `after` comes first of what follows the tick.
pub(super) fn observed(system: &System, tick: &str, after: &str, forgets: bool) -> String {
    let all = observers(system);
    if all.is_empty() && after.is_empty() {
        return tick.to_string();
    }
    let each = |part: fn(&Observer) -> &'static str| all.iter().map(|one| part(one)).collect::<String>();
    let forget = if forgets { each(|one| one.forget) } else { String::new() };
    format!("seq\n{}{tick}{after}{}{forget}endseq\n", each(|one| one.before), each(|one| one.after))
}

/// The phases that have to read something new now and then.
pub(super) fn readings(system: &System) -> impl Iterator<Item = (&Phase, &FreshBound)> {
    let phases = system.components.iter().flat_map(|component| &component.phases);
    phases.filter_map(|phase| Some((phase, phase.fresh.as_ref()?)))
}

/// The element that stands for what a phase reads.
pub(super) fn reading(phase: &Phase) -> String {
    format!("{}_fresh", phase.name)
}

/// The elements, with their domains.
pub(super) fn elements(system: &System) -> Vec<(String, &'static str)> {
    readings(system).map(|(phase, _)| (reading(phase), "FreshReading")).collect()
}

/// The invariants of the bounds.
pub(super) fn invariants(system: &System) -> Vec<Item> {
    let item =
        |name: String, body: String| Item { text: format!("invariant {name} over {body}\n"), name, decided: true };
    let missed = weakly_hard(system).map(|(component, _)| {
        let name = format!("inv_misses_{}", component.name);
        item(name, format!("task_tooManyMissed: task_tooManyMissed({}_task) = 0", component.name))
    });
    let fresh = readings(system).map(|(phase, _)| {
        let name = format!("inv_fresh_{}", phase.name);
        item(name, format!("reading_starved: reading_starved({}) = 0", reading(phase)))
    });
    missed.chain(fresh).collect()
}

/// Whether the text of an invariant was made of such a bound.
pub(super) fn is_made(name: &str, text: &str) -> bool {
    (name.starts_with("inv_misses_") && text.contains("task_tooManyMissed("))
        || (name.starts_with("inv_fresh_") && text.contains("reading_starved("))
}

/// That no task misses a deadline that may not miss some.
pub(super) fn deadlines(system: &System) -> Item {
    let weakly = weakly_hard(system).next().is_some();
    let kept = if weakly { "isWeaklyHard($t) or " } else { "" };
    let text = format!(
        "invariant inv_deadlines over task_deadlinesMissed: (forall $t in Task with {kept}task_deadlinesMissed($t) = 0)\n"
    );
    Item { name: "inv_deadlines".to_string(), text, decided: weakly }
}

/// Whether the invariant of the deadlines speaks of a module that is no longer needed.
pub(super) fn is_outdated(text: &str, wanted: &str) -> bool {
    text.contains("inv_deadlines") && text.contains("isWeaklyHard") && !wanted.contains("isWeaklyHard")
}

/// The components that may miss some deadlines.
pub(super) fn weakly_hard(system: &System) -> impl Iterator<Item = (&Component, &Tolerance)> {
    system.components.iter().filter_map(|component| Some((component, component.tolerance.as_ref()?)))
}

/// Configuration and initial values.
pub(super) fn define(system: &System, define: &mut impl FnMut(&str, &str)) {
    if weakly_hard(system).next().is_some() {
        let each = |value: &dyn Fn(&Tolerance) -> String| {
            let row = |component: &Component| {
                let value = component.tolerance.as_ref().map_or("undef".to_string(), value);
                (format!("{}_task", component.name), value)
            };
            by_case("$t", &system.components.iter().map(row).collect::<Vec<_>>())
        };
        define("mayBeLate($t in Task)", &each(&|_| "true".to_string()));
        define("task_window($t in Task)", &each(&|one| one.cycles.to_string()));
        define("task_mayMiss($t in Task)", &each(&|one| one.missed.to_string()));
        define("task_lateCycles($t in Task)", "{}");
        for name in ["mostMissed", "tooManyMissed"] {
            define(&format!("task_{name}($t in Task)"), "0");
        }
    }
    if readings(system).next().is_none() {
        return;
    }
    let each = |value: &dyn Fn(&Phase, &FreshBound) -> String| {
        by_case("$r", &readings(system).map(|(phase, one)| (reading(phase), value(phase, one))).collect::<Vec<_>>())
    };
    let channel = |is: fn(ChannelKind) -> bool| {
        each(&|phase, _| match phase.action {
            Action::Read(channel) if is(system.channels[channel].kind) => system.channels[channel].name.clone(),
            _ => "undef".to_string(),
        })
    };
    define("reading_buffer($r in FreshReading)", &channel(|kind| matches!(kind, ChannelKind::Buffer { .. })));
    define("reading_queue($r in FreshReading)", &channel(|kind| matches!(kind, ChannelKind::Queue { .. })));
    define("reading_value($r in FreshReading)", &channel(|kind| kind == ChannelKind::Shared));
    define("reading_limit($r in FreshReading)", &each(&|_, one| one.limit.to_string()));
    for name in ["longest", "starved"] {
        define(&format!("reading_{name}($r in FreshReading)"), "0");
    }
}

/// Bounds that say nothing where elaborations take any time.
pub(super) fn without_fresh(system: &mut System) {
    for phase in system.components.iter_mut().flat_map(|component| &mut component.phases) {
        phase.fresh = None;
    }
}
