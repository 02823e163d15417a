asm Neat

signature:

definitions:
	main rule r_Main = skip
