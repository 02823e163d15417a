asm literals
signature:
definitions:
  function a = "abc
  function b = f("abc)
  function c = 'a
  function d = "a\qb"
  function e = 1.5e3 + .5 + 5.
  function f = 1 @ 2
  function g = $ + $1
  function h = “quoted”
  # a comment of another language
  function i = a\b
  main rule r_Main = par
    x := 1 /* a comment without end
  endpar
