// A screenshot with at most 256 colours: a third of the bytes, and nobody sees the difference on a page of flat colours.
//
// In: a PNG of 8 bits a channel without interlacing, as Chromium writes it. Out: a PNG with a palette.

import { deflateSync, inflateSync } from 'node:zlib'

const SIGNATURE = Buffer.from([137, 80, 78, 71, 13, 10, 26, 10])

const TABLE = Array.from({ length: 256 }, (_, index) => {
  let value = index
  for (let bit = 0; bit < 8; bit++) value = value & 1 ? 0xedb88320 ^ (value >>> 1) : value >>> 1
  return value >>> 0
})

function crc(bytes: Buffer): number {
  let value = 0xffffffff
  for (const byte of bytes) value = (TABLE[(value ^ byte) & 255] ?? 0) ^ (value >>> 8)
  return (value ^ 0xffffffff) >>> 0
}

function chunk(kind: string, data: Buffer): Buffer {
  const body = Buffer.concat([Buffer.from(kind, 'latin1'), data])
  const frame = Buffer.alloc(8)
  frame.writeUInt32BE(data.length, 0)
  frame.writeUInt32BE(crc(body), 4)
  return Buffer.concat([frame.subarray(0, 4), body, frame.subarray(4)])
}

interface Pixels {
  width: number
  height: number
  // Three bytes each.
  rgb: Uint8Array
}

function decoded(png: Buffer): Pixels {
  const [width, height] = [png.readUInt32BE(16), png.readUInt32BE(20)]
  const channels = png[25] === 6 ? 4 : 3
  const parts: Buffer[] = []
  for (let at = 8; at < png.length; ) {
    const length = png.readUInt32BE(at)
    if (png.toString('latin1', at + 4, at + 8) === 'IDAT') parts.push(png.subarray(at + 8, at + 8 + length))
    at += length + 12
  }
  const raw = inflateSync(Buffer.concat(parts))
  const stride = width * channels
  const lines = new Uint8Array(height * stride)
  const paeth = (a: number, b: number, c: number): number => {
    const p = a + b - c
    const [pa, pb, pc] = [Math.abs(p - a), Math.abs(p - b), Math.abs(p - c)]
    return pa <= pb && pa <= pc ? a : pb <= pc ? b : c
  }
  for (let y = 0; y < height; y++) {
    const filter = raw[y * (stride + 1)] ?? 0
    for (let x = 0; x < stride; x++) {
      const at = y * stride + x
      const a = x >= channels ? (lines[at - channels] ?? 0) : 0
      const b = y > 0 ? (lines[at - stride] ?? 0) : 0
      const c = x >= channels && y > 0 ? (lines[at - stride - channels] ?? 0) : 0
      const add = filter === 1 ? a : filter === 2 ? b : filter === 3 ? (a + b) >> 1 : filter === 4 ? paeth(a, b, c) : 0
      lines[at] = ((raw[y * (stride + 1) + 1 + x] ?? 0) + add) & 255
    }
  }
  const rgb = new Uint8Array(width * height * 3)
  for (let pixel = 0; pixel < width * height; pixel++)
    for (let channel = 0; channel < 3; channel++) rgb[pixel * 3 + channel] = lines[pixel * channels + channel] ?? 0
  return { width, height, rgb }
}

export function small(png: Buffer): Buffer {
  const { width, height, rgb } = decoded(png)
  const count = new Map<number, number>()
  const colour = (pixel: number): number => ((rgb[pixel * 3] ?? 0) << 16) | ((rgb[pixel * 3 + 1] ?? 0) << 8) | (rgb[pixel * 3 + 2] ?? 0)
  for (let pixel = 0; pixel < width * height; pixel++) count.set(colour(pixel), (count.get(colour(pixel)) ?? 0) + 1)
  // The most frequent colours, none too near to one that is there already.
  const palette: number[] = []
  const distance = (a: number, b: number): number => {
    const [red, green, blue] = [(a >> 16) - (b >> 16), ((a >> 8) & 255) - ((b >> 8) & 255), (a & 255) - (b & 255)]
    return red * red + green * green + blue * blue
  }
  for (const [one] of [...count].sort((a, b) => b[1] - a[1])) {
    if (palette.length === 256) break
    if (palette.every((known) => distance(known, one) > 60) || (count.get(one) ?? 0) > 400) palette.push(one)
  }
  const nearest = new Map<number, number>()
  for (const one of count.keys()) {
    let best = 0
    palette.forEach((known, index) => {
      if (distance(known, one) < distance(palette[best] ?? 0, one)) best = index
    })
    nearest.set(one, best)
  }
  const lines = Buffer.alloc(height * (width + 1))
  for (let y = 0; y < height; y++)
    for (let x = 0; x < width; x++) lines[y * (width + 1) + 1 + x] = nearest.get(colour(y * width + x)) ?? 0
  const head = Buffer.alloc(13)
  head.writeUInt32BE(width, 0)
  head.writeUInt32BE(height, 4)
  head.set([8, 3, 0, 0, 0], 8)
  const colours = Buffer.from(palette.flatMap((one) => [one >> 16, (one >> 8) & 255, one & 255]))
  return Buffer.concat([SIGNATURE, chunk('IHDR', head), chunk('PLTE', colours), chunk('IDAT', deflateSync(lines, { level: 9, memLevel: 9 })), chunk('IEND', Buffer.alloc(0))])
}
