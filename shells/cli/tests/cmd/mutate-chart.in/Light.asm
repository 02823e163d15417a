asm Light
import StandardLibrary
signature:
    controlled on: Boolean
    controlled count: Integer
definitions:
    main rule r_Main =
        par
            on := not on
            count := (count + 1) mod 3
        endpar
default init s0:
    function on = false
    function count = 0
