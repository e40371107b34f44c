// The transport of a browser: a WebSocket of `scadray serve --http`, which is opened anew when it is lost.
import type { Receiver, RpcMessage, Transport } from './connection';
import type { Frame } from './protocol';

const firstRetry_ms = 250;
const lastRetry_ms = 8000;

/** Takes apart a binary message: the length of the JSON (4 bytes, little endian), the JSON, the image's bytes. */
export function parseFrame(bytes: ArrayBuffer): [Frame, Blob] {
  const length = new DataView(bytes).getUint32(0, true);
  const text = new TextDecoder().decode(new Uint8Array(bytes, 4, length));
  const frame = (JSON.parse(text) as { params: Frame }).params;
  return [frame, new Blob([new Uint8Array(bytes, 4 + length)], { type: frame.type })];
}

export class WebSocketTransport implements Transport {
  private socket: WebSocket | null = null;
  private receiver!: Receiver;
  private retry_ms = firstRetry_ms;
  private timer = 0;

  constructor(private readonly address: string) {}

  start(receiver: Receiver): void {
    this.receiver = receiver;
    addEventListener('online', () => this.retry());
    this.connect();
  }

  send(message: RpcMessage): void {
    this.socket?.send(JSON.stringify(message));
  }

  retry(): void {
    if (this.socket) return;
    clearTimeout(this.timer);
    this.connect();
  }

  private connect(): void {
    const socket = new WebSocket(this.address);
    this.socket = socket;
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => {
      this.retry_ms = firstRetry_ms;
      this.receiver.opened();
    };
    socket.onmessage = (event: MessageEvent<string | ArrayBuffer>) => {
      if (typeof event.data === 'string') this.receiver.message(JSON.parse(event.data) as RpcMessage);
      else this.receiver.frame(...parseFrame(event.data));
    };
    socket.onclose = () => {
      this.socket = null;
      const wait_ms = this.retry_ms;
      this.retry_ms = Math.min(2 * this.retry_ms, lastRetry_ms);
      this.timer = setTimeout(() => this.connect(), wait_ms);
      this.receiver.closed(wait_ms);
    };
  }
}
