//! The reasons why ours and the peer's results differ: one name and one sentence each.
//!
//! A reason is the peer's defect or limit, or a superset of ours, as spec/ and the language page tell it. Which
//! difference has which reason is decided in [`super::excuse`], [`super::accept`] and [`super::scenario`].

/// One reason.
#[derive(Debug, Clone, Copy)]
pub struct Reason {
    /// Its name.
    pub name: &'static str,
    /// What the peer does and what Groundstate does, in a sentence or two.
    pub sentence: &'static str,
}

macro_rules! reasons {
    ($($constant:ident = $name:literal: $sentence:literal;)*) => {
        $(
            #[doc = $sentence]
            pub const $constant: &str = $name;
        )*
        /// All reasons.
        pub const REASONS: &[Reason] = &[$(Reason { name: $name, sentence: $sentence }),*];
    };
}

reasons! {
    ASKED_TWICE = "input asked twice in a step":
        "The peer asks again for a monitored location that a `seq` or `while` reads, and may get another value. Here a location is asked for once a step.";
    BUILT_IN_LIBRARY = "library found":
        "The peer looks for the file of a standard library where the import says and does not find it. Here the standard libraries are built in.";
    CHOICE_ORDER = "another choice":
        "The verdict hangs on a `choose` that the scenario does not pick: some choice gives the peer's verdict.";
    CHOICES_UNKNOWN = "choices not found":
        "The record does not hold the choices, and the search for those that lead to the recorded states was cut off. Up to there the run agrees.";
    CLOCK = "the clock":
        "The model reads the clock of the machine it runs on, which the record does not hold.";
    DEFINED_ELEMENT = "defined constant of an abstract domain":
        "A 0-ary static function of an abstract domain with a definition names another element. The peer makes it an element of its own all the same.";
    DIFFERENCE = "symmetric difference":
        "`difference` of the peer is the symmetric difference.";
    DIVISION = "division by zero":
        "The peer goes on with `Infinity`. Here it is a fault.";
    GENERATED = "scenario that the peer cannot translate":
        "The peer writes a machine for the scenario and then cannot parse it. Here the scenario is run.";
    INFINITE_CHOICE = "choice in an infinite domain":
        "The peer draws any number. Here the elements to choose from must be enumerable.";
    INITIAL_INPUTS = "inputs of the initial state":
        "An initial value or an invariant asks for an input before the first step, which the record does not hold.";
    INITIAL_OUTSIDE = "initial value outside the parameters' domains":
        "The peer applies an initial value's term to any arguments, undef and values outside the declared domains included.";
    INITIAL_UNCHECKED = "initial value outside its domain":
        "The peer does not look whether an initial value lies in the function's domain.";
    INTERNAL_FAILURE = "internal failure of the peer":
        "The peer ends with a failure of its own program text (a null pointer, a class cast). The model goes on here.";
    LAZY_INITIAL = "lazy initial values":
        "The peer evaluates an initial value when the location is first read, in the state of that time. Here it is evaluated in the initial state.";
    LENIENT_SCENARIO = "scenario with syntax errors":
        "The peer runs a scenario that its own grammar does not allow. Here the faults are reported.";
    MODEL_MISSING = "scenario without its model":
        "The model that the scenario loads does not exist. The peer passes a scenario that makes no step.";
    MODEL_PATH = "path of the model":
        "The peer does not find the model by a path with backslashes or in other letters. Here either slash separates.";
    NEGATIVE_NATURAL = "negative Natural":
        "The peer lets a Natural become negative (`iton` of a negative number). Here it is a fault.";
    NEW_ELEMENT = "new element as a value":
        "The peer does not take an element that `extend` has just made for a value of the very domain that it extends.";
    NO_END = "step until without end":
        "The condition of a `step until` does not come true. The peer ends the run some time, comes to none of the checks and passes.";
    NO_CONTENTS = "domain without contents":
        "The peer stops where it needs the contents of a concrete domain that has no definition.";
    NO_DEFINITION = "static function without definition":
        "The peer stops where a static function that has no definition is evaluated. Here its value is undef.";
    NOT_IMPLEMENTED = "library function not implemented":
        "The peer declares the library function but has no implementation for these values, and stops. Here it is evaluated.";
    OTHER_FAULT = "another fault first":
        "Both stop in this step, each at the fault that it meets first.";
    OVERFLOW = "integer overflow":
        "The peer's integers wrap around. Here an overflow is a fault.";
    OWN_LIBRARY = "own copy of a library":
        "Beside the model lies an older copy of a standard library with other declarations, which the peer reads. Here the built-in one is read.";
    RANGE = "upper bound of range":
        "`range` of the peer leaves out its upper bound.";
    RESULT_STAYS = "result of a turbo rule":
        "The peer leaves the location `result` in the state after a turbo call. Here it lives as long as the call.";
    RULE_TERM = "rule term without its domains":
        "`<<r_x>>` without parameter domains names the only rule of that name here; the peer does not find a rule with parameters.";
    SELF_KEPT = "self not restored":
        "After `program(a)` the peer leaves `self` at that agent for the rules beside it. Here it is bound within the program alone.";
    SPLIT = "split by a pattern":
        "The peer takes the second argument of `split` for a regular expression. Here it is the separator itself.";
    STATIC_AGENTS = "static function over agents":
        "The peer refuses a static definition that names the dynamic domain `Agent`. Here only dynamic functions are refused.";
    UNBOUND = "variable out of scope":
        "The peer accepts a variable outside the part of the rule that binds it, and stops when a run gets there. Here it is reported by the check.";
    UPDATE_OF_MONITORED = "return into a monitored function":
        "The peer accepts a turbo rule's result for a monitored function. Here only the environment writes it.";
    WIDER_NUMBERS = "coercion of numbers":
        "Natural ⊂ Integer ⊂ Real: a term that the peer refuses or stops at is coerced here.";
}

/// The sentence of a reason.
pub fn sentence(name: &str) -> &'static str {
    REASONS.iter().find(|reason| reason.name == name).map_or("", |reason| reason.sentence)
}
