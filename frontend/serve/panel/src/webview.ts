// The transport of VS Code's webview: the extension passes messages on.
import type { Receiver, RpcMessage, Transport } from './connection';
import type { Frame, Place } from './protocol';

interface VsCode {
  postMessage(message: ToExtension): void;
  getState(): unknown;
  setState(state: unknown): void;
}

/** What the panel says to the extension. */
export type ToExtension =
  | { kind: 'ready' }
  | { kind: 'message'; message: RpcMessage }
  | { kind: 'reveal'; place: Place }
  | { kind: 'retry' }
  | { kind: 'write'; what: 'picture' | 'model' };

/** What the extension says to the panel. */
export type FromExtension =
  | { kind: 'opened' }
  | { kind: 'closed' }
  | { kind: 'message'; message: RpcMessage }
  | { kind: 'frame'; frame: Frame; image: ArrayBuffer }
  | { kind: 'command'; name: string };

declare global {
  var acquireVsCodeApi: (() => VsCode) | undefined;
}

export class WebviewTransport implements Transport {
  onCommand: (name: string) => void = () => {};

  constructor(private readonly vscode: VsCode) {}

  start(receiver: Receiver): void {
    addEventListener('message', ({ data }: MessageEvent<FromExtension>) => {
      switch (data.kind) {
        case 'opened':
          receiver.opened();
          break;
        case 'closed':
          receiver.closed(null);
          break;
        case 'message':
          receiver.message(data.message);
          break;
        case 'frame':
          receiver.frame(data.frame, new Blob([data.image], { type: data.frame.type }));
          break;
        case 'command':
          this.onCommand(data.name);
          break;
      }
    });
    this.vscode.postMessage({ kind: 'ready' });
  }

  send(message: RpcMessage): void {
    this.vscode.postMessage({ kind: 'message', message });
  }

  retry(): void {
    this.vscode.postMessage({ kind: 'retry' });
  }

  reveal(place: Place): void {
    this.vscode.postMessage({ kind: 'reveal', place });
  }

  write(what: 'picture' | 'model'): void {
    this.vscode.postMessage({ kind: 'write', what });
  }
}
