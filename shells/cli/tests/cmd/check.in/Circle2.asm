module Circle2
import Circle
export *
signature:
definitions:
