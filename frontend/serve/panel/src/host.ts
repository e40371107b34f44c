// Where the panel stands: in a browser's page of `scadray serve --http`, or in a webview of VS Code.
import type { Transport } from './connection';
import type { Place } from './protocol';
import type { Memory } from './preview';
import { WebSocketTransport } from './websocket';
import { WebviewTransport } from './webview';

export interface Host {
  transport: Transport;
  /** Shows a place in the editor; without one, the panel shows the text itself. */
  reveal?: (place: Place) => void;
  /** Asks for a path and writes; without it, the panel does. */
  write?: (what: 'picture' | 'model') => void;
  /** What the editor's commands ask for. */
  listen?: (run: (command: string) => void) => void;
  remember(memory: Memory): void;
  recall(): Memory;
}

/** Reads what was kept; whatever else stands there is not ours. */
function memoryOf(kept: unknown): Memory {
  const { look = {}, values = {} } = (kept ?? {}) as Partial<Memory>;
  return { look, values };
}

function browserHost(uri: string): Host {
  const address = new URL('socket', location.href);
  address.protocol = location.protocol === 'https:' ? 'wss:' : 'ws:';
  address.search = location.search;
  const key = `scadray ${uri}`;
  return {
    transport: new WebSocketTransport(address.href),
    remember: (memory) => sessionStorage.setItem(key, JSON.stringify(memory)),
    recall: () => {
      try {
        return memoryOf(JSON.parse(sessionStorage.getItem(key) ?? 'null'));
      } catch {
        return memoryOf(null);
      }
    },
  };
}

function webviewHost(uri: string, acquire: NonNullable<typeof acquireVsCodeApi>): Host {
  const vscode = acquire();
  const transport = new WebviewTransport(vscode);
  return {
    transport,
    reveal: (place) => transport.reveal(place),
    write: (what) => transport.write(what),
    listen: (run) => (transport.onCommand = run),
    remember: (memory) => vscode.setState({ ...memory, uri }), // the extension reads which design to open again
    recall: () => memoryOf(vscode.getState()),
  };
}

export function hostOf(uri: string): Host {
  return globalThis.acquireVsCodeApi ? webviewHost(uri, globalThis.acquireVsCodeApi) : browserHost(uri);
}
