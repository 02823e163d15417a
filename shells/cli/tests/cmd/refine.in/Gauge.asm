asm Gauge
import StandardLibrary
signature:
    monitored inflow: Integer
    controlled seen: Integer
    controlled high: Boolean
definitions:
    main rule r_Main =
        par
            seen := inflow
            high := inflow > 5 and inflow <= 10
        endpar
default init s0:
    function seen = 0
    function high = false
