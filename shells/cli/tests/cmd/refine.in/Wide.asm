asm Wide
import StandardLibrary
signature:
    domain Litre subsetof Integer
    monitored inflow: Litre
    controlled high: Boolean
definitions:
    domain Litre = {0 : 3}
    main rule r_Main = if inflow > 1 then high := true else high := false endif
default init s0:
    function high = false
