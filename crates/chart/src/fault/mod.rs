//! The faults of charts: one constructor each, so that all texts can be read together.
//!
//! In: the place, and what is there. Out: a diagnostic whose id is one of [`IDS`] and has a page `spec/faults/<id>.md`.

pub(crate) mod answer;
pub(crate) mod beginning;
pub(crate) mod component;
pub(crate) mod foreign;
pub(crate) mod import;
pub(crate) mod times;

use syntax::{Diagnostic, Span};

/// The ids of all faults this crate reports, in alphabetical order.
pub const IDS: &[&str] = &[
    "age-bound",
    "broken-link",
    "channel-ends",
    "channel-master",
    "chart-differs",
    "chart-import",
    "circular-path",
    "circular-wait",
    "component-machine",
    "composite-state",
    "control-variable",
    "dead-end",
    "duplicate-shape",
    "empty-chart",
    "foreign-notation",
    "forked-path",
    "fresh-bound",
    "guard-exit",
    "initial-state",
    "instance-arguments",
    "late-response",
    "long-cycle",
    "machine-state",
    "made-name",
    "message-domain",
    "misplaced-exit",
    "missed-deadlines",
    "not-built",
    "not-control-state",
    "not-verified",
    "overlapping-paths",
    "overloaded",
    "pattern-answer",
    "system-differs",
    "time-unit",
    "to-refine",
    "uncovered-case",
    "undecided-paths",
    "unfed-function",
    "unfit-refinement",
    "unknown-shape",
    "unreachable-shape",
    "untaken-function",
    "unwritten-channel",
];

/// A path over guards and actions that returns to itself.
pub(crate) fn circular_path(span: Span, name: &str) -> Diagnostic {
    Diagnostic::error("circular-path", span, format!("the path comes back to `{name}` without a control state"))
        .here("all guards and actions of a path fire in one step, so this step would never end")
        .with_help("put a control state on the way")
}

/// A machine with an instance of itself.
pub(crate) fn contains_itself(span: Span, over: &[String]) -> Diagnostic {
    Diagnostic::error("circular-path", span, format!("the pattern contains itself: {}", over.join(" → ")))
        .here("entering it would never end")
        .with_help("lead a path back to a control state instead")
}

/// No control variable.
pub(crate) fn no_control(span: Span, machine: &str) -> Diagnostic {
    Diagnostic::error("control-variable", span, format!("`{machine}` has control states and no control variable"))
        .here("the control states are the values of a variable")
        .with_help("write `control NAME` to have one made, or `control {f($x)}` for a location of the specification")
}

/// A second control variable.
pub(crate) fn second_control(span: Span, first: Span) -> Diagnostic {
    Diagnostic::error("control-variable", span, "a second control variable")
        .here("a machine has one")
        .with_label(first, "the first one")
        .with_help("remove one, or split the machine in two")
}

/// A shape from which no path leads on.
pub(crate) fn dead_end(span: Span, kind: &str, name: &str) -> Diagnostic {
    Diagnostic::error("dead-end", span, format!("no arrow leads on from the {kind} `{name}`"))
        .here("a path ends at a control state or, in a pattern, at `exit`")
        .with_help(format!("write a path `{name} -> …` on to a control state"))
}

/// Something of the whole system that is stated twice.
pub(crate) fn stated_twice(span: Span, word: &str, first: Span) -> Diagnostic {
    Diagnostic::error("duplicate-shape", span, format!("a second `{word}`"))
        .here("a system states it once")
        .with_label(first, "the first one")
        .with_help("remove one of them")
}

/// Two things with the same name.
pub(crate) fn duplicate(span: Span, what: &str, name: &str, first: Span) -> Diagnostic {
    Diagnostic::error("duplicate-shape", span, format!("a second {what} `{name}`"))
        .here("paths and layouts could not tell the two apart")
        .with_label(first, "the first one")
        .with_help("rename one of them")
}

/// Two arrows that leave an action.
pub(crate) fn forked_path(span: Span, kind: &str, name: &str, first: Span) -> Diagnostic {
    Diagnostic::error("forked-path", span, format!("a second arrow out of the {kind} `{name}`"))
        .here("a path goes on in one way; only control states start several")
        .with_label(first, "the first arrow leads here")
        .with_help("test a guard to choose between the two, or start both paths at the control state")
}

/// An arrow out of a guard that says neither yes nor no.
pub(crate) fn bare_guard(span: Span, name: &str) -> Diagnostic {
    Diagnostic::error("guard-exit", span, format!("the arrow out of the guard `{name}` says neither yes nor no"))
        .here("a guard has two exits")
        .with_help(format!("write `{name} yes -> …` or `{name} no -> …`"))
}

/// `yes` or `no` after something that is not a guard.
pub(crate) fn needless_exit(span: Span, name: &str) -> Diagnostic {
    Diagnostic::error("guard-exit", span, format!("`{name}` is not a guard"))
        .here("only guards have the exits yes and no")
        .with_help("remove `yes` or `no`, or declare the shape as a guard")
}

/// No initial state.
pub(crate) fn no_initial(span: Span, machine: &str) -> Diagnostic {
    Diagnostic::error("initial-state", span, format!("`{machine}` has no initial state"))
        .here("a machine starts in one of its control states")
        .with_help("write `initial state NAME` for one of them")
}

/// A second initial state, or one in a pattern.
pub(crate) fn needless_initial(span: Span, first: Option<Span>) -> Diagnostic {
    match first {
        Some(first) => Diagnostic::error("initial-state", span, "a second initial state")
            .here("a machine starts in one of its control states")
            .with_label(first, "the first one")
            .with_help("remove `initial` from one of them"),
        None => Diagnostic::error("initial-state", span, "a pattern has no initial state")
            .here("a pattern is entered by its arrow, when its control variable is undef")
            .with_help("remove `initial`, and write a path `enter -> …`"),
    }
}

/// A composite state that is entered and does not say where it begins.
pub(crate) fn no_initial_inside(span: Span, name: &str) -> Diagnostic {
    Diagnostic::error("initial-state", span, format!("`{name}` does not say where it begins"))
        .here("a path leads to this composite state, or the machine begins in it")
        .with_help("write `initial` before one of the states in it, or lead the path to one of them")
}

/// What belongs into a composite state.
pub(crate) fn outside_composite(span: Span) -> Diagnostic {
    Diagnostic::error("composite-state", span, "this stands in no composite state")
        .here("a composite state is entered and left, and may remember where it was left")
        .with_help("move it between `composite state` and `endstate`")
}

/// `abort` anywhere but in a pattern.
pub(crate) fn outside_pattern(span: Span) -> Diagnostic {
    Diagnostic::error("composite-state", span, "this is not directly in a pattern")
        .here("only a pattern is aborted, by a path out of a composite state around an instance of it")
        .with_help("write `exit` for what is done whenever a composite state is left")
}

/// `history` without a location, beside a control variable of the specification.
pub(crate) fn unlinked_history(span: Span, name: &str) -> Diagnostic {
    Diagnostic::error(
        "composite-state",
        span,
        format!("`{name}` does not say where it remembers in which state it was left"),
    )
    .here("the control variable is a location of the specification, so this must be one, too")
    .with_help("write `history {f($x)}`, with a function of the same domain")
}

/// A machine whose composite states multiply its paths.
pub(crate) fn too_nested(span: Span, name: &str) -> Diagnostic {
    Diagnostic::error("composite-state", span, format!("`{name}` is too large"))
        .here("each state in a composite state has the paths of those around it, and these are too many or too long")
        .with_help("split the machine, or make the paths out of composite states shorter")
}

/// `history` twice.
pub(crate) fn second_history(span: Span) -> Diagnostic {
    Diagnostic::error("composite-state", span, "a second `history`").here("one is enough").with_help("remove it")
}

/// A control variable within a composite state.
pub(crate) fn control_in_composite(span: Span) -> Diagnostic {
    Diagnostic::error("control-variable", span, "a control variable in a composite state")
        .here("the states in it are values of the machine's control variable")
        .with_help("remove it")
}

/// An instance beside the paths, in a composite state.
pub(crate) fn beside_in_composite(span: Span, name: &str) -> Diagnostic {
    Diagnostic::error("composite-state", span, format!("no path leads to `{name}`"))
        .here("an instance beside the paths runs in every step, whatever state the machine is in")
        .with_help("move it out of the composite state, or lead a path to it")
}

/// An action that is done when a composite state is entered or left, or a pattern aborted, on a path.
pub(crate) fn apart_on_path(span: Span, name: &str) -> Diagnostic {
    Diagnostic::error("composite-state", span, format!("`{name}` stands on no path"))
        .here("it is done by itself whenever its state is entered or left, or its pattern is aborted")
        .with_help("declare another action for the path")
}

/// Arguments that do not fit the pattern.
pub(crate) fn arguments(span: Span, pattern: &str, wanted: usize, given: usize, declared: Span) -> Diagnostic {
    let count = if wanted == 1 { "1 argument".to_string() } else { format!("{wanted} arguments") };
    Diagnostic::error("instance-arguments", span, format!("`{pattern}` takes {count}, {given} given"))
        .here("an instance gives each parameter of its pattern a term")
        .with_label(declared, "the pattern")
        .with_help(format!("give {count}"))
}

/// A second control state with the same value.
pub(crate) fn same_value(span: Span, value: &str, first: Span) -> Diagnostic {
    Diagnostic::error("machine-state", span, format!("a second control state with the value `{value}`"))
        .here("the machine could not tell the two apart")
        .with_label(first, "the first one")
        .with_help("link each control state to a value of its own")
}

/// `enter` or `exit` in a wrong position.
pub(crate) fn misplaced_exit(span: Span, word: &str, reason: &str) -> Diagnostic {
    Diagnostic::error("misplaced-exit", span, format!("`{word}` cannot stand here"))
        .here(reason)
        .with_help("only patterns are entered and left: a path starts at `enter` and ends at `exit`")
}

/// A name that nothing declares.
pub(crate) fn unknown(span: Span, what: &str, name: &str, known: &[&str]) -> Diagnostic {
    let help = match model::nearest(name, known.iter().copied()) {
        Some(close) => format!("did you mean `{close}`?"),
        None if known.is_empty() => "declare it".to_string(),
        None => format!("declare it, or use one of: {}", known.join(", ")),
    };
    Diagnostic::error("unknown-shape", span, format!("there is no {what} `{name}`"))
        .here("nothing with this name is declared here")
        .with_help(help)
}

/// A shape to which no path leads.
pub(crate) fn unreachable(span: Span, kind: &str, name: &str) -> Diagnostic {
    Diagnostic::warning("unreachable-shape", span, format!("no path leads to the {kind} `{name}`"))
        .here("nothing ever leads here")
        .with_help("lead a path to it, or remove it")
}

/// A link that leads nowhere, or to something of the wrong kind.
pub(crate) fn broken_link(span: Span, message: &str, help: Option<&str>) -> Diagnostic {
    let fault = Diagnostic::error("broken-link", span, format!("a link is broken: {message}"))
        .here("the specification must contain this");
    fault.with_help(help.unwrap_or("correct the link, or add what it names to the specification"))
}

/// The places of both sides of a difference.
pub(crate) struct Sides {
    /// The control state in the chart.
    pub(crate) state: Span,
    /// The end of the chart's transition in this case.
    pub(crate) transition: Option<Span>,
    /// The place in the rule, and what it is.
    pub(crate) rule: (Span, &'static str),
}

/// A case in which the chart and the rule differ.
pub(crate) fn chart_differs(
    sides: Sides,
    origin: &str,
    effect: &str,
    case: &[(String, bool)],
    chart_does: bool,
) -> Diagnostic {
    let tests: Vec<String> =
        case.iter().map(|(atom, holds)| if *holds { atom.clone() } else { format!("not ({atom})") }).collect();
    let where_ = if tests.is_empty() { String::new() } else { format!(" where {}", tests.join(" and ")) };
    let state = match origin {
        "" => String::new(),
        "undef" => "on entering, ".to_string(),
        origin => format!("in {origin}, "),
    };
    let (who, other) = if chart_does { ("the chart", "the rule") } else { ("the rule", "the chart") };
    let message = format!("{state}{who} does `{effect}`{where_}, {other} does not");
    let mut fault = Diagnostic::error("chart-differs", sides.state, message).here("the chart's control state");
    if let Some(transition) = sides.transition {
        fault = fault.with_label(transition, "the chart's transition of this case ends here");
    }
    fault
        .with_label(sides.rule.0, sides.rule.1)
        .with_help("change the chart or the rule; `groundstate chart build` writes the rule as the chart says")
}

/// A difference between a system and its model: the place in the chart, the message, the place in the model.
pub(crate) fn system_differs(place: Span, message: String, model: Option<(Span, &str)>) -> Diagnostic {
    let fault = Diagnostic::error("system-differs", place, message).here("the chart's");
    let fault = match model {
        Some((span, label)) => fault.with_label(span, label),
        None => fault,
    };
    fault.with_help("change the chart or the model; `groundstate chart build` writes the model as the chart says")
}

/// A chart from which nothing can be built.
pub(crate) fn empty_chart(span: Span) -> Diagnostic {
    Diagnostic::error("empty-chart", span, "the chart has no machine and no system: there is nothing to build")
        .here("a model is built from these")
        .with_help("write a `machine`, a `pattern` or a `system`")
}

/// A machine or a pattern that would have a control variable without values.
pub(crate) fn empty_machine(span: Span, is_pattern: bool, name: &str) -> Diagnostic {
    let (what, help) = match is_pattern {
        true => ("pattern", "write the states that it is in while it is at work; what is done at once is an action"),
        false => ("machine", "write its states: `initial state idle` is the first one"),
    };
    Diagnostic::error(
        "empty-chart",
        span,
        format!("the {what} `{name}` has no control state: there is nothing to build"),
    )
    .here("its control variable would have no value")
    .with_help(help)
}

/// A system whose imports lack the patterns that it is built from.
pub(crate) fn no_patterns(span: Span, missing: &str) -> Diagnostic {
    Diagnostic::error(
        "chart-import",
        span,
        format!("no import of the chart provides the patterns: `{missing}` is declared nowhere"),
    )
    .here("a system is built from the pattern library")
    .with_help("import it: `import …/library/patterns/ControlTask`, as a path from the chart's folder")
}

/// Two parts of a chart that would create the same name.
pub(crate) fn made_twice(span: Span, what: &str, name: &str, first: Span) -> Diagnostic {
    Diagnostic::error("made-name", span, format!("a second {what} `{name}` would be made"))
        .here("from this name")
        .with_label(first, "the first one is made from this")
        .with_help(format!("rename one of them, or link it to what it stands for: `{{…}}` instead of `{name}`"))
}

/// A channel to one of several readers that has the name of another channel.
pub(crate) fn second_channel(span: Span, name: &str, first: Span) -> Diagnostic {
    Diagnostic::error("made-name", span, format!("a second channel `{name}` would be made"))
        .here("a channel to several readers is one for each: `CHANNEL_READER`")
        .with_label(first, "the first one is made from this")
        .with_help("rename one of the two")
}

/// A cycle that takes too long, with its parts.
pub(crate) fn long_cycle(span: Span, name: &str, always: bool, sum: &str, until: &str) -> Diagnostic {
    let message = match always {
        true => format!("every cycle of `{name}` misses {until}: it takes {sum}"),
        false => format!("a long cycle of `{name}` misses {until}: it takes up to {sum}"),
    };
    Diagnostic::warning("long-cycle", span, message)
        .here("the phases take longer than the available time")
        .with_help("shorten its phases, or give it more time")
}

/// A rule that cannot be compared.
pub(crate) fn not_control_state(span: Span, name: &str, place: Option<Span>) -> Diagnostic {
    let fault = Diagnostic::error("not-control-state", span, format!("the rule `{name}` is not in control-state form"))
        .here("its control variable must be set to literals or undef, in parallel rules, `if`, `switch` and `let`");
    let fault = match place {
        Some(place) => fault.with_label(place, "here it is set in another way"),
        None => fault,
    };
    fault.with_help("rewrite it in this form, or draw what it does as one action of another machine")
}

/// Something that is to be refined.
pub(crate) fn to_refine(span: Span, name: &str, by: Option<&str>) -> Diagnostic {
    let what = by.map_or_else(String::new, |by| format!(" by `{by}`"));
    let fault = Diagnostic::error("to-refine", span, format!("`{name}` is still to be refined{what}"));
    Diagnostic { severity: syntax::Severity::Note, ..fault }.here("drawn dashed")
}

/// A channel that is not used as its ends require.
pub(crate) fn channel_ends(span: Span, name: &str, reason: &str) -> Diagnostic {
    Diagnostic::error("channel-ends", span, format!("the channel `{name}` does not fit: {reason}"))
        .here("its sender writes it once a cycle, its receiver reads it once")
        .with_help("correct the channel, or the phases of its two ends")
}

/// A channel with too few or too many places.
pub(crate) fn channel_size(span: Span, name: &str, reason: &str, smallest: &str) -> Diagnostic {
    Diagnostic::error("channel-ends", span, format!("the channel `{name}` does not fit: {reason}"))
        .here("as many places as it has")
        .with_help(format!("write `{smallest}`, or more"))
}

/// Components that start each other, and nothing else does.
pub(crate) fn circular_wait(span: Span, circle: &[&str]) -> Diagnostic {
    let (name, ways) = (circle.first().copied().unwrap_or_default(), circle.join("` awaits `"));
    Diagnostic::error("circular-wait", span, format!("`{name}` never starts: `{ways}`"))
        .here("what it awaits is written after it has started")
        .with_help("let one of them await something else too (`awaits any …`), or give it a period")
}

/// A channel that a component awaits twice.
pub(crate) fn awaited_twice(span: Span, name: &str) -> Diagnostic {
    Diagnostic::error("channel-ends", span, format!("the channel `{name}` is awaited twice"))
        .here("named before")
        .with_help("name each channel once")
}

/// Several awaited channels, and it is not said whether all must have data.
pub(crate) fn awaited_unclear(span: Span) -> Diagnostic {
    Diagnostic::error(
        "channel-ends",
        span,
        "several channels are awaited, and it is not said whether all or any of them",
    )
    .here("a cycle begins when something new has come")
    .with_help("write `awaits all …` for something new on each of them, `awaits any …` for something new on one")
}

/// A buffer whose master cannot be determined; of a channel with several readers that to one of them.
pub(crate) fn channel_master(span: Span, name: &str, reader: Option<&str>) -> Diagnostic {
    let to = reader.map_or(String::new(), |reader| format!(" to `{reader}`"));
    Diagnostic::error("channel-master", span, format!("the master of the buffer `{name}`{to} must be named"))
        .here("it is the slower of two synchronous components, or the asynchronous one of a mixed pair")
        .with_help("write `master NAME` after the number of arrays; NAME is one of its two ends")
}

/// A time that is no whole number of ticks.
pub(crate) fn no_whole_ticks(span: Span) -> Diagnostic {
    Diagnostic::error("time-unit", span, "this is not a whole number of ticks")
        .here("the model advances by one tick per step")
        .with_help("write another time, or a shorter `tick`")
}

/// Ticks without a length.
pub(crate) fn no_tick(span: Span) -> Diagnostic {
    Diagnostic::error("time-unit", span, "a tick takes at least a nanosecond")
        .here("each step of the model takes one tick")
        .with_help("write a longer time; without `tick` it is 1 ms")
}

/// A time longer than a day.
pub(crate) fn long_time(span: Span) -> Diagnostic {
    Diagnostic::error("time-unit", span, "this is longer than a day")
        .here("times are counted in nanoseconds, up to 86400 s")
        .with_help("write a shorter time")
}

/// A time with a part of a nanosecond.
pub(crate) fn fine_time(span: Span) -> Diagnostic {
    Diagnostic::error("time-unit", span, "this is not a whole number of nanoseconds")
        .here("no time is finer than a nanosecond")
        .with_help("write a longer time, or another unit")
}

/// A chart that has nothing to verify, or whose patterns cannot be told.
pub(crate) fn not_verified(span: Span, message: &str, here: &str, help: &str) -> Diagnostic {
    Diagnostic::error("not-verified", span, message).here(here).with_help(help)
}

/// An interval without a value.
pub(crate) fn empty_interval(span: Span) -> Diagnostic {
    Diagnostic::error("time-unit", span, "the shortest time is greater than the longest")
        .here("an elaboration takes `LEAST..MOST`")
        .with_help("exchange the two numbers")
}

/// An access to a channel whose time varies.
pub(crate) fn fixed_access(span: Span) -> Diagnostic {
    Diagnostic::error("time-unit", span, "only the time of an elaboration varies")
        .here("copying a datum takes the same time in each cycle; what varies is the waiting for the lock")
        .with_help("write the longest time")
}

/// A part of a system that cannot be built.
pub(crate) fn not_built(span: Span, what: &str) -> Diagnostic {
    Diagnostic::error("not-built", span, format!("{what} cannot be built"))
        .here("the next cycle begins at the end of the period, and would have to wait")
        .with_help("let the deadline be the period, or make the period longer")
}

/// A name in the chart from which no function name can be derived.
pub(crate) fn made_name(span: Span, name: &str) -> Diagnostic {
    Diagnostic::error("made-name", span, format!("`{name}` cannot be the name of a function"))
        .here("a function of this name is made in the specification")
        .with_help("choose a name that starts with a lower-case letter and is not a keyword, or link it")
}

/// A control variable to be created that an import already declares.
pub(crate) fn made_already(span: Span, name: &str) -> Diagnostic {
    Diagnostic::error("made-name", span, format!("an import declares `{name}` already"))
        .here("a control variable of this name is made in the specification")
        .with_help(format!("choose another name, or link it: `control {{{name}}}`"))
}

/// Two paths from one control state that hold together but lead to different places.
pub(crate) fn overlapping_paths(first: (Span, &str), second: (Span, &str), from: &str, state: &[String]) -> Diagnostic {
    let (first, one) = first;
    let (second, other) = second;
    let message = format!("from `{from}`, paths lead to `{one}` and to `{other}` in one step: {}", listed(state));
    Diagnostic::warning("overlapping-paths", second, message)
        .here("the second path")
        .with_label(first, "the first path")
        .with_help("lead the second path through the `no` of the first one's guard, or make sure that both never hold")
}

/// A state in which no path of a machine can be taken, although it has several guards.
pub(crate) fn uncovered_case(span: Span, from: &str, state: &[String]) -> Diagnostic {
    let message = format!("from `{from}`, no path is open: {}", listed(state));
    note(Diagnostic::error("uncovered-case", span, message).here("the machine waits here"))
}

/// A question about paths that cannot be decided.
pub(crate) fn undecided_paths(span: Span, from: &str, what: &str, reason: &str) -> Diagnostic {
    let message = format!("from `{from}`, it is not known whether the paths {what}: {reason}");
    note(Diagnostic::error("undecided-paths", span, message).here("the paths from here"))
}

fn note(fault: Diagnostic) -> Diagnostic {
    Diagnostic { severity: syntax::Severity::Note, ..fault }
}

/// The locations of a state.
fn listed(state: &[String]) -> String {
    if state.is_empty() { "always".to_string() } else { format!("where {}", state.join(", ")) }
}
