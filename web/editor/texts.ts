// The files that the language client knows: one view each.
//
// In: views as they are opened and closed. Out: what the language server is told of them. Files that it asks for are read by the studio.

import { type LSPClient, LSPPlugin, Workspace, type WorkspaceFile } from '@codemirror/lsp-client'
import type { Text, TransactionSpec } from '@codemirror/state'
import type { EditorView } from '@codemirror/view'

import type { Studio } from './studio'

export class Texts extends Workspace {
  files: (WorkspaceFile & { view: EditorView })[] = []
  private versions = new Map<string, number>()

  constructor(
    client: LSPClient,
    private readonly studio: Studio,
  ) {
    super(client)
  }

  private version(uri: string): number {
    const version = (this.versions.get(uri) ?? -1) + 1
    this.versions.set(uri, version)
    return version
  }

  syncFiles() {
    if (this.studio.server.online !== 'open') return []
    const updates = []
    for (const file of this.files) {
      const plugin = LSPPlugin.get(file.view)
      if (!plugin || plugin.unsyncedChanges.empty) continue
      updates.push({ changes: plugin.unsyncedChanges, file, prevDoc: file.doc })
      file.doc = file.view.state.doc
      file.version = this.version(file.uri)
      plugin.clear()
    }
    return updates
  }

  openFile(uri: string, languageId: string, view: EditorView): void {
    const doc: Text = view.state.doc
    const file = { uri, languageId, version: this.version(uri), doc, view, getView: () => view }
    this.files.push(file)
    this.client.didOpen(file)
  }

  closeFile(uri: string): void {
    this.files = this.files.filter((file) => file.uri !== uri)
    this.client.didClose(uri)
  }

  override async requestFile(uri: string): Promise<WorkspaceFile | null> {
    await this.studio.document(uri)
    return this.getFile(uri)
  }

  override updateFile(uri: string, update: TransactionSpec): void {
    this.getFile(uri)?.getView()?.dispatch(update)
  }

  override async displayFile(uri: string): Promise<EditorView | null> {
    return (await this.studio.open(uri))?.view ?? null
  }
}
