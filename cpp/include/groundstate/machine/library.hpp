// The library functions of the language on dynamic values, one a builtin of crates/program/src/builtin.rs.
//
// What each computes, and where it is not defined, is spec/standard-library.md's; crates/machine/src/builtin/ is the
// definition that these agree with. Each is named by its builtin in small letters, takes the operands, then the place in
// the model's text where the term stands; those that print take the model's names before that. A fault ends the step by
// `fail`.
//
// Not here, as they are no functions of values alone: chooseone, pre, program, print, the clock, temporal operators.
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
