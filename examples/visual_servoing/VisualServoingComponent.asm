/* Made from VisualServoingComponent.chart. The rules of its machines and the domains of its control states are written
   anew from there; all else is kept.

   What Figure 11 leaves to be refined is refined by data here: images, told apart by numbers, go through the component, from
   its buffer to set-points, which are known by the images that they come from. When an action ends, and when a lock is
   free, is left open. */
asm VisualServoingComponent

import ../../library/std/StandardLibrary

export *

signature:
	abstract domain Controller
	static controller1: Controller
	domain Image subsetof Integer

	// the newest image that the camera has written, and whether it was not yet handed over
	controlled offered: Image
	controlled isNew: Boolean
	// the camera, or the robot controller, is working on its array
	controlled imagesBusy: Boolean
	controlled setPointsBusy: Boolean
	// handed over: what the component reads
	controlled taken: Image
	controlled image: Controller -> Image
	controlled setPoint: Controller -> Image
	// in the buffer, and handed over to the robot controller
	controlled written: Image
	controlled given: Image
	// the control states
	enum domain VsState = {WAITING | ELABORATING | VISUAL_SERVOING_READING | VISUAL_SERVOING_WRITING}
	controlled vsState: Controller -> VsState
	// the control states
	enum domain ReadState = {MASTER_READING_MANAGING | MASTER_READING_READING}
	controlled readState: Controller -> ReadState
	// the control states
	enum domain WriteState = {MASTER_WRITING_WRITING | MASTER_WRITING_MANAGING}
	controlled writeState: Controller -> WriteState
	derived imageAvailable: Controller -> Boolean
	// Elaboration time elapsed
	monitored elaborationElapsed: Controller -> Boolean
	// Swinging buffer managed
	controlled imagesManaged: Controller -> Boolean
	// Time elapsed
	monitored readingElapsed: Controller -> Boolean
	// Time elapsed
	monitored writingElapsed: Controller -> Boolean
	// Swinging buffer managed
	controlled setPointsManaged: Controller -> Boolean

definitions:
	domain Image = {0, 1}

	function imageAvailable($c in Controller) = isNew

	rule r_elaborateImage($c in Controller) =
		setPoint($c) := image($c)

	// The lock is free, or it is not: then this is tried again. It is not while the other side works on its array.
	rule r_manageImages($c in Controller) =
		choose $granted in Boolean with $granted implies not imagesBusy do
			if $granted then
				par
					imagesManaged($c) := true
					taken := offered
					isNew := false
				endpar
			endif

	rule r_releaseImages($c in Controller) =
		imagesManaged($c) := false

	rule r_readImage($c in Controller) =
		image($c) := taken

	rule r_writeSetPoint($c in Controller) =
		written := setPoint($c)

	rule r_manageSetPoints($c in Controller) =
		choose $granted in Boolean with $granted implies not setPointsBusy do
			if $granted then
				par
					setPointsManaged($c) := true
					given := written
				endpar
			endif

	rule r_releaseSetPoints($c in Controller) =
		setPointsManaged($c) := false

	// Visual servoing component
	rule r_visualServoing($c in Controller) =
		par
			// Waiting for image
			if vsState($c) = WAITING then
				if imageAvailable($c) then
					par
						r_masterReading[$c]
						vsState($c) := VISUAL_SERVOING_READING
					endpar
				endif
			endif
			// Elaborating image
			if vsState($c) = ELABORATING then
				if elaborationElapsed($c) then
					par
						r_masterWriting[$c]
						vsState($c) := VISUAL_SERVOING_WRITING
					endpar
				endif
			endif
			// Read image
			if vsState($c) = VISUAL_SERVOING_READING then
				if isUndef(readState($c)) then
					par
						r_elaborateImage[$c]
						vsState($c) := ELABORATING
					endpar
				else
					r_masterReading[$c]
				endif
			endif
			// Write set-point
			if vsState($c) = VISUAL_SERVOING_WRITING then
				if isUndef(writeState($c)) then
					vsState($c) := WAITING
				else
					r_masterWriting[$c]
				endif
			endif
		endpar

	// Asynchronous master reading
	rule r_masterReading($c in Controller) =
		par
			// entering
			if isUndef(readState($c)) then
				par
					r_manageImages[$c]
					readState($c) := MASTER_READING_MANAGING
				endpar
			endif
			// Managing swinging buffer
			if readState($c) = MASTER_READING_MANAGING then
				if imagesManaged($c) then
					par
						r_releaseImages[$c]
						r_readImage[$c]
						readState($c) := MASTER_READING_READING
					endpar
				else
					par
						r_manageImages[$c]
						readState($c) := MASTER_READING_MANAGING
					endpar
				endif
			endif
			// Reading
			if readState($c) = MASTER_READING_READING then
				if readingElapsed($c) then
					readState($c) := undef // exit
				endif
			endif
		endpar

	// Asynchronous master writing
	rule r_masterWriting($c in Controller) =
		par
			// entering
			if isUndef(writeState($c)) then
				par
					r_writeSetPoint[$c]
					writeState($c) := MASTER_WRITING_WRITING
				endpar
			endif
			// Writing
			if writeState($c) = MASTER_WRITING_WRITING then
				if writingElapsed($c) then
					par
						r_manageSetPoints[$c]
						writeState($c) := MASTER_WRITING_MANAGING
					endpar
				endif
			endif
			// Managing swinging buffer
			if writeState($c) = MASTER_WRITING_MANAGING then
				if setPointsManaged($c) then
					par
						r_releaseSetPoints[$c]
						writeState($c) := undef // exit
					endpar
				else
					par
						r_manageSetPoints[$c]
						writeState($c) := MASTER_WRITING_MANAGING
					endpar
				endif
			endif
		endpar

	// By itself it gets an image whenever it has taken the one before.
	main rule r_Main =
		par
			if not isNew then
				choose $image in Image with true do
					par
						offered := $image
						isNew := true
					endpar
			endif
			forall $c in Controller with true do r_visualServoing[$c]
		endpar

default init s0:
	function vsState($c in Controller) = WAITING
	function offered = 0
	function isNew = true
	function imagesBusy = false
	function setPointsBusy = false
	function taken = 0
	function image($c in Controller) = 0
	function setPoint($c in Controller) = 0
	function written = 0
	function given = 0
	function imagesManaged($c in Controller) = false
	function setPointsManaged($c in Controller) = false
