/* A lamp */
asm Messy
signature:
  controlled on:Boolean   // lit



definitions:
  main rule r_Main=par
    // toggled
    on:=not( on )
  endpar
default init s0: function on=false
