// A studio for the tests: the program on a copy of a folder, with the front end of this tree.
//
// Owns: starting and ending the program, and a small server before it that gives the files of `dist` with the program's own
// headers and hands the WebSocket on. So the front end is tried without building the program anew.

import { type ChildProcess, execFileSync, spawn } from 'node:child_process'
import { cpSync, mkdtempSync, readFileSync, rmSync } from 'node:fs'
import { type IncomingMessage, type Server, createServer, get } from 'node:http'
import { tmpdir } from 'node:os'
import { extname, join, resolve } from 'node:path'
import { WebSocket, WebSocketServer } from 'ws'

const DIST = resolve(import.meta.dirname, '../dist')
const ROOT = resolve(import.meta.dirname, '../..')

const KINDS: Record<string, string> = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript; charset=utf-8',
  '.css': 'text/css; charset=utf-8',
  '.svg': 'image/svg+xml',
}

export interface Served {
  address: string
  folder: string
  // Breaks connections, and lets none come until it is told so.
  cut: (broken: boolean) => void
  stop: () => void
}

const program = (): string => process.env['GROUNDSTATE'] ?? join(ROOT, 'target/debug/groundstate')

function fetched(address: string, headers: Record<string, string> = {}): Promise<IncomingMessage> {
  return new Promise((done, failed) => {
    get(address, { headers }, (response) => {
      response.resume()
      done(response)
    }).on('error', failed)
  })
}

function started(folder: string): Promise<{ child: ChildProcess; address: string }> {
  const child = spawn(program(), ['studio', folder, '--no-open'], { stdio: ['ignore', 'pipe', 'pipe'] })
  return new Promise((done, failed) => {
    let said = ''
    const read = (data: Buffer): void => {
      said += String(data)
      const address = /http:\/\/\S+token=\w+/.exec(said)?.[0]
      if (address) done({ child, address })
    }
    child.stdout.on('data', read)
    child.stderr.on('data', read)
    child.on('exit', () => failed(new Error(`the studio ended: ${said}`)))
  })
}

// A folder that only these tests write to.
export function copied(...from: string[]): string {
  const folder = mkdtempSync(join(tmpdir(), 'studio-'))
  for (const path of from) cpSync(join(ROOT, path), join(folder, path.split('/').at(-1) ?? path), { recursive: true })
  return folder
}

export async function served(folder: string, port = 0): Promise<Served> {
  const { child, address } = await started(folder)
  const origin = new URL(address).origin
  const entered = await fetched(address)
  const cookie = entered.headers['set-cookie']?.[0]?.split(';')[0] ?? ''
  const page = await fetched(origin, { cookie })
  const policy = String(page.headers['content-security-policy'] ?? '')
  const server: Server = createServer((request, response) => {
    const path = new URL(request.url ?? '/', 'http://localhost').pathname
    const file = join(DIST, path === '/' ? 'index.html' : path)
    try {
      const body = readFileSync(file)
      response.writeHead(200, { 'content-type': KINDS[extname(file)] ?? 'application/octet-stream', 'content-security-policy': policy })
      response.end(body)
    } catch {
      response.writeHead(404).end()
    }
  })
  const sockets = new WebSocketServer({ server, path: '/ws' })
  let broken = false
  sockets.on('connection', (near) => {
    if (broken) return near.terminate()
    const far = new WebSocket(`${origin.replace('http', 'ws')}/ws`, { origin, headers: { cookie } })
    const early: string[] = []
    near.on('message', (data) => (far.readyState === WebSocket.OPEN ? far.send(String(data)) : early.push(String(data))))
    far.on('open', () => early.splice(0).forEach((message) => far.send(message)))
    far.on('message', (data) => near.send(String(data)))
    far.on('close', () => near.close())
    far.on('error', () => near.close())
    near.on('close', () => far.close())
  })
  await new Promise<void>((done) => server.listen(port, '127.0.0.1', done))
  const own = server.address()
  const listening = typeof own === 'object' && own ? own.port : port
  return {
    address: `http://127.0.0.1:${listening}/`,
    folder,
    cut: (now) => {
      broken = now
      if (now) sockets.clients.forEach((client) => client.terminate())
    },
    stop: () => {
      sockets.clients.forEach((client) => client.terminate())
      server.close()
      child.kill('SIGINT')
    },
  }
}

export const removed = (folder: string): void => rmSync(folder, { recursive: true, force: true })

// The folder as a site of files alone, with the front end of this tree.
export async function exported(folder: string): Promise<Served> {
  const site = join(mkdtempSync(join(tmpdir(), 'studio-')), 'site')
  execFileSync(program(), ['studio', '--export', site, folder], { stdio: 'ignore' })
  const server = createServer((request, response) => {
    const path = new URL(request.url ?? '/', 'http://localhost').pathname
    try {
      const body =
        path === '/'
          ? readFileSync(join(DIST, 'index.html'), 'utf8').replace('<head>', '<head><meta name="groundstate-project" content="project.json" />')
          : readFileSync(path === '/project.json' ? join(site, 'project.json') : join(DIST, path))
      response.writeHead(200, { 'content-type': KINDS[extname(path === '/' ? '.html' : path)] ?? (path === '/' ? KINDS['.html'] : 'application/json') })
      response.end(body)
    } catch {
      response.writeHead(404).end()
    }
  })
  await new Promise<void>((done) => server.listen(0, '127.0.0.1', done))
  const own = server.address()
  const port = typeof own === 'object' && own ? own.port : 0
  const stop = (): void => {
    server.close()
    removed(site)
  }
  return { address: `http://127.0.0.1:${port}/`, folder, cut: () => undefined, stop }
}
