asm Level
import StandardLibrary
signature:
    monitored inflow: Integer
    controlled high: Boolean
definitions:
    main rule r_Main = if inflow > 5 then high := true else high := false endif
default init s0:
    function high = false
