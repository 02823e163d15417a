// What files are called, and what goes by the same name.
//
// In: paths of files. Out: the parts of their names; the files that belong to one because they have its name; where a text names one, line
// by line. The endings are the server's.

import type { File, Named } from './protocol'

const ENDINGS = ['.report.yaml', '.verify.yaml', '.avalla', '.refine', '.chart', '.asm']

export const endingOf = (path: string): string => ENDINGS.find((ending) => path.endsWith(ending)) ?? ''

export const folderOf = (path: string): string => path.slice(0, path.lastIndexOf('/') + 1)

export const stemOf = (path: string): string => path.slice(folderOf(path).length, path.length - endingOf(path).length)

export const withStem = (path: string, stem: string): string => `${folderOf(path)}${stem}${endingOf(path)}`

// A chart, its model and their specifications are found by their name alone.
const BY_NAME: readonly File['kind'][] = ['chart', 'model', 'report', 'verification']

export function companions(files: readonly File[], file: File): File[] {
  if (!BY_NAME.includes(file.kind)) return []
  const isOne = (other: File): boolean =>
    other.path !== file.path && BY_NAME.includes(other.kind) && withStem(other.path, '') === `${folderOf(file.path)}${endingOf(other.path)}` && stemOf(other.path) === stemOf(file.path)
  return files.filter(isOne)
}

// Imports find a model by the name after `asm`, which is a name of the language; others may be called as the disk allows.
export function isFileName(file: File, stem: string): boolean {
  const form = file.kind === 'model' || file.kind === 'chart' ? /^[A-Za-z]\w*$/ : /^[^\s./\\:][^/\\:]*$/
  return form.test(stem) && stem.trim() === stem && !stem.endsWith('.')
}

// The lines at which each file names another one, from 1.
export function linesOf(places: readonly Pick<Named, 'path' | 'range'>[]): { path: string; lines: number[] }[] {
  const found = new Map<string, Set<number>>()
  for (const { path, range } of places) found.set(path, (found.get(path) ?? new Set()).add(range.start.line + 1))
  return [...found].map(([path, lines]) => ({ path, lines: [...lines].sort((a, b) => a - b) }))
}

// The folders that files lie in, and the one that is open itself.
export const foldersOf = (files: readonly File[]): string[] => [...new Set(['', ...files.map(({ path }) => folderOf(path))])].sort()

// A chart with one machine, which has nothing but the state that it begins in.
export function emptyChart(name: string): string {
  const control = `${name.charAt(0).toLowerCase()}${name.slice(1)}State`
  return `chart ${name}\n\nmachine ${name} "${name}"\n\tcontrol ${control}\n\tinitial state idle "Idle"\nendmachine\n`
}
