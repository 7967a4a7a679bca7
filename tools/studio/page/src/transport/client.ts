import {type Frame, FrameReader} from './frames';

/** What the server would not do, in its own sentence. */
export class Refusal extends Error {
  constructor(message: string, readonly status: number, readonly code: number | null) {
    super(message);
  }
}

export const gone = 'The server does not answer any more. Start it again with `aplomb studio`.';
const wrongToken = 'This address has no right to the studio: its token is missing or wrong. ' +
  'Open the address that `aplomb studio` printed.';
const cutOff = 'The answer was cut off.';

const ticket = /^once-/;

/** The token that an address has in its fragment; a ticket, which the browser was opened with, is changed for one. */
export async function tokenOf(fragment: string, fetcher: typeof fetch = (...all) => fetch(...all)): Promise<string> {
  if (!ticket.test(fragment)) return fragment;
  const asking = new Client('', fetcher);
  return (await asking.json<{token: string}>('/api/token', {name: fragment.replace(ticket, '')})).token;
}

/** Requests with the token of the address. The token stays in memory; it is in no request's address. */
export class Client {
  constructor(private readonly token: string, private readonly fetcher: typeof fetch = (...all) => fetch(...all)) {}

  async json<T>(path: string, body?: unknown, signal?: AbortSignal): Promise<T> {
    const response = await this.#ask(path, body, signal);
    return (response.status === 204 ? undefined : await response.json()) as T;
  }

  async upload<T>(kind: 'model' | 'profile', name: string, bytes: Blob, signal: AbortSignal): Promise<T> {
    return (await this.#ask(`/api/${kind}?name=${encodeURIComponent(name)}`, bytes, signal)).json() as Promise<T>;
  }

  /** A file of the last run, and the name that the server gives it. */
  async file(path: string, body: unknown): Promise<{name: string; bytes: Blob}> {
    const response = await this.#ask(path, body);
    const said = response.headers.get('Content-Disposition') ?? '';
    return {name: nameIn(said), bytes: await response.blob()};
  }

  /** The frames of a stream, without the heartbeats. Throws where it ends too early. */
  async *stream(path: string, body: unknown, signal: AbortSignal): AsyncGenerator<Frame> {
    const response = await this.#ask(path, body, signal);
    const reader = (response.body as ReadableStream<Uint8Array>).getReader();
    const frames = new FrameReader();
    try {
      for (;;) {
        const {done, value} = await reader.read().catch((error: unknown) => {
          throw isAbort(error) ? error : new Refusal(cutOff, 0, null);
        });
        if (done) break;
        for (const frame of frames.push(value)) {
          if (frame.kind === 'end') return;
          if (frame.kind === 'json' && frame.message.type === 'alive') continue;
          yield frame;
        }
      }
    } finally {
      await reader.cancel().catch(() => undefined);
    }
    if (!frames.ended) throw new Refusal(cutOff, 0, null);
  }

  async #ask(path: string, body?: unknown, signal?: AbortSignal): Promise<Response> {
    const headers: Record<string, string> = {Authorization: `Bearer ${this.token}`};
    if (body !== undefined) headers['Content-Type'] = body instanceof Blob ? 'application/octet-stream' : 'application/json';
    const sent = body === undefined || body instanceof Blob ? (body as Blob | undefined) : JSON.stringify(body);
    let response: Response;
    try {
      response = await this.fetcher(path, {method: path === '/api/start' ? 'GET' : 'POST', headers, body: sent, signal});
    } catch (error) {
      throw isAbort(error) ? error : new Refusal(gone, 0, null);
    }
    if (response.ok) return response;
    throw await refusalOf(response);
  }
}

export function isAbort(error: unknown): boolean {
  return error instanceof DOMException && error.name === 'AbortError';
}

async function refusalOf(response: Response): Promise<Refusal> {
  if (response.status === 401) return new Refusal(wrongToken, 401, null);
  const said = (await response.json().catch(() => null)) as {error?: string; code?: number} | null;
  return new Refusal(said?.error ?? `The server refused that (${response.status}).`, response.status, said?.code ?? null);
}

/** The file's name in a Content-Disposition, plain or in UTF-8. */
export function nameIn(disposition: string): string {
  const utf8 = /filename\*=UTF-8''([^;]+)/i.exec(disposition)?.[1];
  return utf8 ? decodeURIComponent(utf8) : /filename="?([^";]+)"?/i.exec(disposition)?.[1] ?? 'aplomb';
}
