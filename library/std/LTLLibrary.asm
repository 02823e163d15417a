// The operators of linear temporal logic with past, for LTLSPEC formulas.
//
// It is built in: an import whose path ends in `LTLLibrary` finds this text. A formula over these is checked
// against runs by the verifier; within a rule or a definition an operator has no value.
module LTLLibrary

export *

signature:
	basic domain Boolean

	// Future.
	static x: Boolean -> Boolean // in the next state
	static g: Boolean -> Boolean // globally
	static f: Boolean -> Boolean // finally
	static u: Prod(Boolean, Boolean) -> Boolean // p until q, and q happens
	static v: Prod(Boolean, Boolean) -> Boolean // p releases q

	// Past.
	static y: Boolean -> Boolean // in the state before, and there is one
	static z: Boolean -> Boolean // in the state before, if there is one
	static h: Boolean -> Boolean // historically: in all states so far
	static o: Boolean -> Boolean // once: in some state so far
	static s: Prod(Boolean, Boolean) -> Boolean // p since q
	static t: Prod(Boolean, Boolean) -> Boolean // p triggered by q

definitions:
