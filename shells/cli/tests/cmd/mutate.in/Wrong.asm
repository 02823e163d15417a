asm Wrong
import StandardLibrary
signature:
    controlled count: Integer
definitions:
    invariant inv_few over count: count < 3
    main rule r_Main = count := count + 1
default init s0:
    function count = 0
