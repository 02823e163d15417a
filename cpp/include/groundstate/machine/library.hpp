// The library functions of the language on dynamic values, one for each builtin of crates/program/src/builtin.rs.
//
// spec/standard-library.md says what each computes, and where it is not defined; crates/machine/src/builtin/ is the
// definition with which these agree. Each has the name of its builtin in small letters, takes the operands, then the
// place in the model's text where the term stands; those that print take the model's names before that. A fault ends
// the step by `fail`.
//
// Not here, because they are not functions of values alone: chooseone, pre, program, print, the clock, temporal
// operators.
#pragma once

#include "agents.hpp"
#include "bags.hpp"
#include "complex_numbers.hpp"
#include "integers.hpp"
#include "logic.hpp"
#include "maps.hpp"
#include "ranging.hpp"
#include "reals.hpp"
#include "sequences.hpp"
#include "sets.hpp"
#include "strings.hpp"
