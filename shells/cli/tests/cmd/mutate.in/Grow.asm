asm Grow
import StandardLibrary
signature:
    controlled size: Integer
definitions:
    main rule r_Main = size := 2 * size
default init s0:
    function size = 0
