// The operators of computation tree logic, for CTLSPEC formulas, and patterns made from them.
//
// It is built in: an import whose path ends in `CTLLibrary` finds this text, and the standard library with it. A
// formula over these is checked against all runs by the verifier; within a rule or a definition an operator has
// no value.
module CTLLibrary

import StandardLibrary

export *

signature:
	// On some path (e…), on all paths (a…): next, finally, globally, until.
	static ex: Boolean -> Boolean
	static ef: Boolean -> Boolean
	static eg: Boolean -> Boolean
	static eu: Prod(Boolean, Boolean) -> Boolean
	static ax: Boolean -> Boolean
	static af: Boolean -> Boolean
	static ag: Boolean -> Boolean
	static au: Prod(Boolean, Boolean) -> Boolean

	// Weak until: p until q, or p for ever.
	static ew: Prod(Boolean, Boolean) -> Boolean
	static aw: Prod(Boolean, Boolean) -> Boolean

	// After exactly n steps.
	static exN: Prod(Boolean, Natural) -> Boolean
	static axN: Prod(Boolean, Natural) -> Boolean

	// Absence of p: globally; before r; after q; between q and r; after q until r.
	static absenceG: Boolean -> Boolean
	static absenceBefore: Prod(Boolean, Boolean) -> Boolean
	static absenceAfter: Prod(Boolean, Boolean) -> Boolean
	static absenceBetween: Prod(Boolean, Boolean, Boolean) -> Boolean
	static absenceAfterUntil: Prod(Boolean, Boolean, Boolean) -> Boolean

	// ap(p, s): s precedes p; pb(p, s, r): s precedes p before r.
	static ap: Prod(Boolean, Boolean) -> Boolean
	static pb: Prod(Boolean, Boolean, Boolean) -> Boolean

definitions:
