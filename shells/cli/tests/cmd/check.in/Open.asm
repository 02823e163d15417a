asm Open
signature:
definitions:
	main rule r_Main = par skip