// A name for a recorded run: a scenario beside its model.

// One that no file beside the model has.
export function freeName(model: string, taken: readonly string[]): string {
  for (let count = 1; ; count++) {
    const name = `${model}Run${count}`
    if (!taken.includes(name)) return name
  }
}
