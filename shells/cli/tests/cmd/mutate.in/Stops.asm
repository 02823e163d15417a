asm Stops
import StandardLibrary
signature:
    monitored amount: Integer
    controlled level: Integer
definitions:
    main rule r_Main = if level + amount < 4 then level := level + amount endif
default init s0:
    function level = 0
