// A lamp whose model is built, and a scenario that leaves something out: what several tests mark.

import { execFileSync } from 'node:child_process'
import { writeFileSync } from 'node:fs'
import { join } from 'node:path'

const LAMP = `chart Lamp

machine lamp "Lamp"
	control light
	initial state off "Off"
	state on "On"
	guard pressed "Pressed"
	guard held "Held"
	action count "COUNT"
	off -> pressed yes -> count -> on
	on -> held yes -> off
	pressed no -> off
	held no -> on
endmachine
`

// It never leaves `on`.
export const SCENARIO = `scenario Press
load Lamp.asm
set pressed := false;
step
check light = OFF;
set pressed := true;
step
check light = ON;
`

export function lampBuilt(folder: string): void {
  writeFileSync(join(folder, 'Lamp.chart'), LAMP)
  writeFileSync(join(folder, 'Press.avalla'), SCENARIO)
  execFileSync(process.env['GROUNDSTATE'] ?? join(import.meta.dirname, '../../target/debug/groundstate'), ['chart', 'build', 'Lamp.chart'], { cwd: folder })
}
