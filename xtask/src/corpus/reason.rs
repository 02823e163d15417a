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
            Class::Record => "What the record does not contain",
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
        "When a `seq` or `while` reads a monitored location again, the peer asks for it again and may get another value (9.1, 14). Here a location is asked for once per step.";
    BOTH_SIDES = Defect "both sides of a connective":
        "The peer evaluates the right side of `and`, `or` and `implies` even if the left one decides, and stops if the right side is undefined (9.4, 14); in interactive runs it does not (9.2). By its own Kleene logic the left side decides, as it does here.";
    CHOICE_ORDER = Defect "hash order in a choice":
        "The peer takes the first candidate in the order of its hash tables (9.5). Here it is the first in canonical order; some choice gives the peer's result.";
    DEPENDENT_RANGE = Defect "range over an earlier variable":
        "The peer's parser accepts a range that names an earlier variable of the same `choose`; its simulator finds that variable unbound. Here the variable has its value.";
    DIFFERENCE = Defect "symmetric difference":
        "The peer's `difference` is the symmetric difference (10.1).";
    GENERATED = Defect "scenario that the peer cannot translate":
        "The peer translates a scenario of its own language (12) into a machine, which its own parser refuses although it accepts the model. Here the scenario is run.";
    INITIAL_OUTSIDE = Defect "initial value outside the parameters' domains":
        "When a location is first read, the peer evaluates its initial value for any arguments, including undef and values outside the declared domains (8.1, 9.2, 14).";
    LAZY_INITIAL = Defect "lazy initial values":
        "The peer evaluates an initial value when the location is first read, in the state at that time (9.2, 14). Here it is evaluated in the initial state.";
    LENIENT_SCENARIO = Defect "scenario with syntax errors":
        "The peer ignores syntax errors in a scenario (12) and runs the rest; doing the same here gives its verdict and its number of checks. Here the faults are reported.";
    NEGATIVE_NATURAL = Defect "negative Natural":
        "The peer allows a negative Natural, by `iton` of a negative number (10.1, 14). Here it is a fault.";
    NEW_ELEMENT = Defect "new element as a value":
        "If a function's codomain is a growing subset, the peer refuses an element that the same step adds to that subset, because it checks in the state before the step (9.1). In the next state the element is in the subset; for an abstract domain the peer accepts it. Here it is accepted.";
    NO_END = Defect "step until without end":
        "A scenario passes if its run reaches its end (12). The condition of a `step until` never becomes true; the peer eventually ends the run, reaches none of the later checks, and passes. Here reaching the bound is a failure.";
    NOT_IMPLEMENTED = Defect "library function not implemented":
        "The peer declares the library function but does not implement it for these values, and stops (10). Here it is evaluated.";
    NOT_RUN = Defect "construct that is parsed and not run":
        "The peer parses `iterate`, `whilerec` and local state but does not run them (9.1). Here they are run.";
    RANGE = Defect "upper bound of range":
        "The peer's `range` leaves out its upper bound (10.1).";
    RESULT_STAYS = Defect "result of a turbo rule":
        "After a turbo call the peer keeps the location `result` in the state, so two parallel calls clash (9.1, 14). Here the target of the call replaces it, as in the book.";
    SELF_KEPT = Defect "self not restored":
        "After `program(a)` the peer keeps that agent as `self` for the parallel rules (9.1, 14). Here it is bound only within the program.";
    WRAP = Defect "integers that wrap around":
        "The peer's integers wrap around at 64 bits (14), and the run continues with a number that is no sum or product. Here an overflow is a fault.";
    CHOICES_UNKNOWN = Record "choices not found":
        "The record does not contain the choices, and the search for choices that lead to the recorded states was cut off. Up to that point the run agrees.";
    INITIAL_INPUTS = Record "inputs of the initial state":
        "An initial value or an invariant reads an input before the first step, which the record does not contain.";
    BUILT_IN_LIBRARY = Superset "library found":
        "The peer does not find the file of a standard library at the import's path. Here the standard libraries are built in.";
    INTERNAL_FAILURE = Superset "internal failure of the peer":
        "The peer stops with an internal error (a null pointer, a class cast of undef). Here the run continues.";
    LITERAL_OPERAND = Superset "collection as an operand":
        "The peer's grammar does not allow a set or sequence in brackets as an operand (6.1), so it refuses a check such as `f = [1, 2]`. Here it is a term like any other.";
    MODEL_PATH = Superset "path of the model":
        "The peer does not find the model by a path with backslashes. Here both slashes separate folders.";
    NO_CONTENTS = Superset "domain without contents":
        "The peer stops when it needs the contents of a concrete domain without a definition. Here the items of tuples and collections are not checked; `check` warns.";
    NO_RESULT = Superset "turbo rule without a result":
        "A turbo rule is called for its result but sets none. The peer stops with a null pointer; here the target keeps its value.";
    RULE_TERM = Superset "rule term without its domains":
        "Here `<<r_x>>` without parameter domains names the only rule of that name; the peer does not find a rule with parameters.";
    STATIC_OVER_DYNAMIC = Superset "static function over a dynamic domain":
        "The peer refuses a static definition over a dynamic domain such as `Agent`. Here only dynamic functions and the contents of dynamic domains are refused.";
    WIDER_NUMBERS = Superset "coercion of numbers":
        "Natural ⊂ Integer ⊂ Real: here a term is coerced that the peer refuses or stops at.";
    DIVISION = BetterFault "division by zero":
        "The peer continues with `Infinity`. Here it is a fault.";
    INFINITE_CHOICE = BetterFault "choice in an infinite domain":
        "The peer draws any number. Here the elements to choose from must be enumerable.";
    INITIAL_UNCHECKED = BetterFault "initial value outside its domain":
        "The peer does not check whether an initial value lies in the function's codomain. Here a value outside is a fault.";
    MODEL_MISSING = BetterFault "scenario without its model":
        "The model that the scenario loads does not exist. The peer passes a scenario that makes no steps.";
    OTHER_FAULT = BetterFault "another fault first":
        "Both stop in this step, each at the first fault it meets.";
    UNBOUND = BetterFault "variable out of scope":
        "The peer accepts a variable outside of its scope. Here `check` reports it.";
    DEFINED_ELEMENT = Decision "defined constant of an abstract domain":
        "The definition of a 0-ary static function over an abstract domain names another element. The peer still makes it an element of its own.";
    OWN_LIBRARY = Decision "own copy of a library":
        "An older copy of a standard library, with different declarations, lies beside the model. The peer reads that copy; here the built-in library is read.";
    SPLIT = Decision "split by a pattern":
        "The peer treats the second argument of `split` as a regular expression. Here it is the separator itself.";
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
