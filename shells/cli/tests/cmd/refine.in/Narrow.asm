asm Narrow
import StandardLibrary
signature:
    domain Litre subsetof Integer
    monitored inflow: Litre
    monitored calm: Boolean
    controlled high: Boolean
    controlled last: Litre
definitions:
    domain Litre = {0 : 3}
    main rule r_Main =
        par
            high := inflow > 1
            last := inflow
            if inflow = 7 and calm then last := 0 endif
        endpar
default init s0:
    function high = false
    function last = 0
