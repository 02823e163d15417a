asm Circle
import Circle2
signature:
definitions:
	main rule r_Main = skip
