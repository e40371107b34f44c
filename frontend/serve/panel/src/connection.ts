// JSON-RPC with the server, over any transport.
import type { Frame, Notifications, Requests } from './protocol';

export interface RpcMessage {
  jsonrpc: '2.0';
  id?: number;
  method?: string;
  params?: unknown;
  result?: unknown;
  error?: { code: number; message: string };
}

/** What a transport tells of. */
export interface Receiver {
  opened(): void;
  /** The connection is lost, or could not be made. The transport goes on trying; in how many ms it does is told. */
  closed(retryIn_ms: number | null): void;
  message(message: RpcMessage): void;
  frame(frame: Frame, image: Blob): void;
}

/** Carries messages to a server and back: a WebSocket, or VS Code's extension. */
export interface Transport {
  start(receiver: Receiver): void;
  send(message: RpcMessage): void;
  /** Tries again at once. */
  retry(): void;
}

export class RequestError extends Error {
  constructor(
    readonly code: number,
    message: string,
  ) {
    super(message);
  }
}

interface Pending {
  resolve(result: unknown): void;
  reject(error: Error): void;
}

export class Connection {
  isOpen = false;
  onOpened: () => void = () => {};
  onClosed: (retryIn_ms: number | null) => void = () => {};
  onNotification: (method: string, params: unknown) => void = () => {};
  onFrame: (frame: Frame, image: Blob) => void = () => {};

  private lastId = 0;
  private readonly pending = new Map<number, Pending>();

  constructor(private readonly transport: Transport) {}

  start(): void {
    this.transport.start({
      opened: () => {
        this.isOpen = true;
        this.onOpened();
      },
      closed: (retryIn_ms) => {
        this.isOpen = false;
        for (const { reject } of this.pending.values()) reject(new RequestError(0, 'the connection is lost'));
        this.pending.clear();
        this.onClosed(retryIn_ms);
      },
      message: (message) => this.take(message),
      frame: (frame, image) => this.onFrame(frame, image),
    });
  }

  retry(): void {
    if (!this.isOpen) this.transport.retry();
  }

  request<M extends keyof Requests>(method: M, params: Requests[M][0]): Promise<Requests[M][1]> {
    return new Promise((resolve, reject) => {
      if (!this.isOpen) {
        reject(new RequestError(0, 'there is no connection'));
        return;
      }
      const id = ++this.lastId;
      this.pending.set(id, { resolve: resolve as (result: unknown) => void, reject });
      this.transport.send({ jsonrpc: '2.0', id, method, params });
    });
  }

  /** Without a connection, what is said is lost: the preview says it all again when it is opened. */
  notify<M extends keyof Notifications>(method: M, params: Notifications[M]): void {
    if (this.isOpen) this.transport.send({ jsonrpc: '2.0', method, params });
  }

  private take(message: RpcMessage): void {
    if (message.method !== undefined) {
      this.onNotification(message.method, message.params);
      return;
    }
    const pending = this.pending.get(message.id ?? 0);
    if (!pending) return;
    this.pending.delete(message.id!);
    if (message.error) pending.reject(new RequestError(message.error.code, message.error.message));
    else pending.resolve(message.result);
  }
}
