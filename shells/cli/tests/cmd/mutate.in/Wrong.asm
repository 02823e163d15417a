asm Wrong
import StandardLibrary
signature:
    controlled on: Boolean
definitions:
    invariant inv_off over on: not on
    main rule r_Main = on := true
default init s0:
    function on = false
