asm Broken
signature:
definitions:
  main rule r_Main = par skip
