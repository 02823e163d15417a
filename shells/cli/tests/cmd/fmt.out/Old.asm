asm Old // caffè

signature:

definitions:
	main rule r_Main = skip
