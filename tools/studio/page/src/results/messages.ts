import {Refusal} from '../transport/client';
import type {Frame} from '../transport/frames';

export type Message = Extract<Frame, {kind: 'json'}>['message'];

/** Throws what a message says went wrong. \return whether the stream goes on: else the server had to end it. */
export function goesOn(message: Message): boolean {
  if (message.type === 'error') throw new Refusal(String(message.message), 0, Number(message.code));
  return message.type !== 'cancelled';
}

const waits_ms = [100, 400, 1600];

/**
 * Asks again where the server ended an answer for somebody else's sake, as for another page of this server.
 *
 * `ask` tells whether it was answered. Ends without one when the signal is aborted, and throws when it was asked often enough.
 */
export async function insist(ask: () => Promise<boolean>, signal: AbortSignal): Promise<void> {
  for (const wait_ms of [...waits_ms, null]) {
    if ((await ask()) || signal.aborted) return;
    if (wait_ms !== null) await pause(wait_ms, signal);
    if (signal.aborted) return;
  }
  throw new Error('The server was kept from answering. Try again.');
}

function pause(wait_ms: number, signal: AbortSignal): Promise<void> {
  return new Promise((resolve) => {
    setTimeout(resolve, wait_ms);
    signal.addEventListener('abort', () => resolve(), {once: true});
  });
}
