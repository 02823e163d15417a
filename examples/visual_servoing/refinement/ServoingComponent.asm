/* The visual servoing component of Figure 11, with its two neighbours as it sees them: a camera that writes images, and a robot controller
   that reads what it is given. Any of the three move in a step, one or several at once.

   ServoingUntimed refines it: there the three are tasks of the pattern library, with swinging buffers between them. */
asm ServoingComponent

import ../../../library/std/StandardLibrary
import ../VisualServoingComponent

signature:
	// the set-point that the robot controller works with
	controlled used: Image

definitions:
	// what is given to the robot controller comes from the image that was read for it
	invariant inv_ofItsImage over setPointsManaged:
		setPointsManaged(controller1) implies given = image(controller1)

	// Neither neighbour begins while the component swaps.
	rule r_camera =
		if imagesBusy then
			imagesBusy := false
		else
			choose $image in Image with not imagesManaged(controller1) do
				par
					imagesBusy := true
					offered := $image
					isNew := true
				endpar
		endif

	rule r_robot =
		if setPointsBusy then
			setPointsBusy := false
		else
			if not setPointsManaged(controller1) then
				par
					setPointsBusy := true
					used := given
				endpar
			endif
		endif

	main rule r_Main =
		choose $camera in Boolean, $servoing in Boolean, $robot in Boolean with true do
			seq
				if $servoing then r_visualServoing[controller1] endif
				par
					if $camera then r_camera[] endif
					if $robot then r_robot[] endif
				endpar
			endseq

default init s0:
	function vsState($c in Controller) = WAITING
	function offered = 0
	function isNew = false
	function imagesBusy = false
	function setPointsBusy = false
	function taken = 0
	function image($c in Controller) = 0
	function setPoint($c in Controller) = 0
	function written = 0
	function given = 0
	function imagesManaged($c in Controller) = false
	function setPointsManaged($c in Controller) = false
	function used = 0
