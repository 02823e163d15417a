//! The reasons why ours and the peer's results differ: one name, one class and one sentence each.
//!
//! Which difference has which reason is decided in [`super::excuse`], [`super::accept`] and [`super::scenario`].

/// What kind of reason it is, from the best to the worst.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// A defect of the peer, or something that it parses and does not run: the language page names it, or the sentence
    /// argues it.
    Defect,
    /// The record does not hold what a comparison needs.
    Record,
    /// The peer refuses or stops where there is a meaning: it is accepted or goes on here.
    Superset,
    /// The peer goes on without a meaning: it is a fault here.
    BetterFault,
    /// Groundstate differs by a decision of its own.
    Decision,
}

impl Class {
    /// All, in order.
    pub const ALL: [Class; 5] = [Class::Defect, Class::Record, Class::Superset, Class::BetterFault, Class::Decision];

    /// Heading of its part of the page.
    pub fn title(self) -> &'static str {
        match self {
            Class::Defect => "Defects of the peer",
            Class::Record => "What the record does not hold",
            Class::Superset => "The peer refuses or stops, Groundstate does not",
            Class::BetterFault => "Groundstate finds a fault, the peer does not",
            Class::Decision => "Groundstate differs by a decision of its own",
        }
    }

    /// The same for the head of a column.
    pub fn column(self) -> &'static str {
        match self {
            Class::Defect => "defect",
            Class::Record => "not recorded",
            Class::Superset => "superset",
            Class::BetterFault => "better fault",
            Class::Decision => "decision",
        }
    }
}

/// One reason.
#[derive(Debug, Clone, Copy)]
pub struct Reason {
    /// Its name.
    pub name: &'static str,
    /// Its class.
    pub class: Class,
    /// What the peer does and what Groundstate does, in a sentence or two; of a defect also where the language page
    /// names it.
    pub sentence: &'static str,
}

macro_rules! reasons {
    ($($constant:ident = $class:ident $name:literal: $sentence:literal;)*) => {
        $(
            #[doc = $sentence]
            pub const $constant: &str = $name;
        )*
        /// All reasons.
        pub const REASONS: &[Reason] = &[$(Reason { name: $name, class: Class::$class, sentence: $sentence }),*];
    };
}

reasons! {
    ASKED_TWICE = Defect "input asked twice in a step":
        "The peer asks again for a monitored location that a `seq` or `while` reads, and may get another value (9.1, 14). Here a location is asked for once a step.";
    BOTH_SIDES = Defect "both sides of a connective":
        "The peer evaluates the right side of `and`, `or` and `implies` where the left one decides, and stops at what is undefined there (9.4, 14); when it asks a user for inputs it does not (9.2). By its own Kleene logic the left side decides, as it does here.";
    CHOICE_ORDER = Defect "hash order in a choice":
        "The peer takes the first candidate in the order of its hash tables (9.5). Here it is the first in canonical order; some choice gives the peer's result.";
    DEPENDENT_RANGE = Defect "range over an earlier variable":
        "The peer's parser takes a range that names a variable bound before it in the same `choose`; its simulator finds that variable unbound. Here it has the value that the variable has.";
    DIFFERENCE = Defect "symmetric difference":
        "`difference` of the peer is the symmetric difference (10.1).";
    GENERATED = Defect "scenario that the peer cannot translate":
        "The peer writes a machine for a scenario of its own language (12), of a model that its parser takes, and its parser refuses that machine. Here the scenario is run.";
    INITIAL_OUTSIDE = Defect "initial value outside the parameters' domains":
        "The peer applies an initial value's term when a location is first read, to any arguments, undef and values outside the declared domains included (8.1, 9.2, 14).";
    LAZY_INITIAL = Defect "lazy initial values":
        "The peer evaluates an initial value when the location is first read, in the state of that time (9.2, 14). Here it is evaluated in the initial state.";
    LENIENT_SCENARIO = Defect "scenario with syntax errors":
        "The peer passes over errors of a scenario's syntax (12) and runs the rest; doing the same here gives its verdict and its number of checks. Here the faults are reported.";
    NEGATIVE_NATURAL = Defect "negative Natural":
        "The peer lets a Natural become negative, by `iton` of a negative number (10.1, 14). Here it is a fault.";
    NEW_ELEMENT = Defect "new element as a value":
        "Where a function has a growing subset as codomain, the peer refuses the very element that the step adds to that subset, as it looks in the state before the step (9.1). In the state that the step leads to the element is in the subset, and of an abstract domain the peer takes it. Here it is taken.";
    NO_END = Defect "step until without end":
        "A scenario passes whose run reaches its end (12). The condition of a `step until` does not come true; the peer ends the run some time, comes to none of the checks behind it and passes. Here the bound is a failure.";
    NOT_IMPLEMENTED = Defect "library function not implemented":
        "The peer declares the library function but has no implementation for these values, and stops (10). Here it is evaluated.";
    NOT_RUN = Defect "construct that is parsed and not run":
        "The peer parses `iterate`, `whilerec` and local state and does not run them (9.1). Here they are run.";
    RANGE = Defect "upper bound of range":
        "`range` of the peer leaves out its upper bound (10.1).";
    RESULT_STAYS = Defect "result of a turbo rule":
        "The peer leaves the location `result` in the state after a turbo call, where two calls beside each other clash (9.1, 14). Here the target of the call stands in its place, as the book has it.";
    SELF_KEPT = Defect "self not restored":
        "After `program(a)` the peer leaves `self` at that agent for the rules beside it (9.1, 14). Here it is bound within the program alone.";
    WRAP = Defect "integers that wrap around":
        "The peer's integers wrap around at 64 bits (14), and the run goes on with a number that is no sum or product. Here an overflow is a fault.";
    CHOICES_UNKNOWN = Record "choices not found":
        "The record does not hold the choices, and the search for those that lead to the recorded states was cut off. Up to there the run agrees.";
    INITIAL_INPUTS = Record "inputs of the initial state":
        "An initial value or an invariant asks for an input before the first step, which the record does not hold.";
    BUILT_IN_LIBRARY = Superset "library found":
        "The peer looks for the file of a standard library where the import says and does not find it. Here the standard libraries are built in.";
    INTERNAL_FAILURE = Superset "internal failure of the peer":
        "The peer ends with a failure of its own program text (a null pointer, a class cast of undef). The model goes on here.";
    LITERAL_OPERAND = Superset "collection as an operand":
        "The peer's grammar takes no set or sequence in brackets for an operand (6.1), so it refuses a check such as `f = [1, 2]`. Here it is a term like any other.";
    MODEL_PATH = Superset "path of the model":
        "The peer does not find the model by a path with backslashes. Here either slash separates.";
    NO_CONTENTS = Superset "domain without contents":
        "The peer stops where it needs the contents of a concrete domain that has no definition. Here what is inside of tuples and collections is not looked at; the check warns.";
    NO_RESULT = Superset "turbo rule without a result":
        "A turbo rule is called for its result and sets none. The peer stops with a null pointer; here the target stays as it is.";
    RULE_TERM = Superset "rule term without its domains":
        "`<<r_x>>` without parameter domains names the only rule of that name here; the peer does not find a rule with parameters.";
    STATIC_OVER_DYNAMIC = Superset "static function over a dynamic domain":
        "The peer refuses a static definition over a dynamic domain such as `Agent`. Here only dynamic functions and the contents of dynamic domains are refused.";
    WIDER_NUMBERS = Superset "coercion of numbers":
        "Natural ⊂ Integer ⊂ Real: a term that the peer refuses or stops at is coerced here.";
    DIVISION = BetterFault "division by zero":
        "The peer goes on with `Infinity`. Here it is a fault.";
    INFINITE_CHOICE = BetterFault "choice in an infinite domain":
        "The peer draws any number. Here the elements to choose from must be enumerable.";
    INITIAL_UNCHECKED = BetterFault "initial value outside its domain":
        "The peer does not look whether an initial value lies in the function's domain. Here it is a fault.";
    MODEL_MISSING = BetterFault "scenario without its model":
        "The model that the scenario loads does not exist. The peer passes a scenario that makes no step.";
    OTHER_FAULT = BetterFault "another fault first":
        "Both stop in this step, each at the fault that it meets first.";
    UNBOUND = BetterFault "variable out of scope":
        "The peer accepts a variable outside the part of the rule that binds it. Here it is reported by the check.";
    DEFINED_ELEMENT = Decision "defined constant of an abstract domain":
        "A 0-ary static function of an abstract domain with a definition names another element. The peer makes it an element of its own all the same.";
    OWN_LIBRARY = Decision "own copy of a library":
        "Beside the model lies an older copy of a standard library with other declarations, which the peer reads. Here the built-in one is read.";
    SPLIT = Decision "split by a pattern":
        "The peer takes the second argument of `split` for a regular expression. Here it is the separator itself.";
}

/// What one of the two refuses to read and the other reads: the reason is about a text, not about a run.
const OF_TEXTS: [&str; 8] = [
    BUILT_IN_LIBRARY,
    LITERAL_OPERAND,
    MODEL_MISSING,
    MODEL_PATH,
    RULE_TERM,
    STATIC_OVER_DYNAMIC,
    UNBOUND,
    WIDER_NUMBERS,
];

/// All the reasons are about a text that one of the two refuses.
pub fn are_of_texts(names: &[String]) -> bool {
    names.iter().all(|name| OF_TEXTS.contains(&name.as_str()))
}

/// A reason by its name.
pub fn named(name: &str) -> Option<&'static Reason> {
    REASONS.iter().find(|reason| reason.name == name)
}

/// The class that decides for several reasons: the worst.
pub fn class(names: &[String]) -> Option<Class> {
    names.iter().filter_map(|name| named(name)).map(|reason| reason.class).max()
}
