/** Requests to the service: JSON in both directions, and problems as errors that can be shown. */

import { keyHeaders } from "./key.js";
import { patiently } from "./patiently.js";

/**
 * A problem document (RFC 9457): title, detail, and the fields that are wrong.
 *
 * @property after seconds after which the service would like to be asked again; null: it did not say
 */
export class Problem extends Error {
  constructor(status, document, after = null) {
    super(document.detail ?? document.title ?? `The service answered with status ${status}.`);
    this.status = status;
    this.after = after;
    this.title = document.title ?? "The service refused this";
    this.type = document.type ?? "";
    this.errors = document.errors ?? [];
  }
}

/** The service does not answer: it is being restarted, or the network is cut. */
export class Unreachable extends Error {
  constructor() {
    super("The service does not answer. What it accepted goes on; this page tries again.");
  }
}

/** Whether the service had too much to do (429, 503), or refused this for another reason. */
export function isBusy({ status }) {
  return status === 429 || status === 503;
}

/** Whether a fault may pass by itself: the service is away, busy, or broken behind its proxy. */
export function mayPass(error) {
  return error instanceof Unreachable || isBusy(error) || error.status >= 500;
}

const listeners = new Set();

/** Calls `listener` with true or false whenever the service answers, or does not. */
export function onReachable(listener) {
  listeners.add(listener);
}

/** Tells the page whether the service answered. */
export function report(reachable) {
  for (const listener of listeners) listener(reachable);
}

/** Returns what a GET answers, of a busy service later; `query` values of null and "" are left out. */
export function get(path, query = {}, signal = undefined) {
  return patiently(() => request("GET", withQuery(path, query), undefined, signal), signal, isBusy);
}

/** Returns what a POST of a document answers. */
export function post(path, document = undefined, signal = undefined) {
  return request("POST", path, document, signal);
}

/** Returns what a DELETE answers. */
export function remove(path) {
  return request("DELETE", path);
}

/** Returns a path with its query. */
export function withQuery(path, query) {
  const given = Object.entries(query).filter(([, v]) => v !== null && v !== undefined && v !== "");
  const text = new URLSearchParams(given).toString();
  return text ? `${path}?${text}` : path;
}

/** Returns the bytes that a GET answers in a form. */
export async function getBytes(path, form, signal) {
  const ask = () => answered("GET", path, undefined, signal, form);
  return whole((await patiently(ask, signal, isBusy)).arrayBuffer());
}

const withoutKey = new Set();

/** Calls `listener` with each problem that another key may solve: none was shown, or it is not for this. */
export function onKeyWanted(listener) {
  withoutKey.add(listener);
}

async function request(method, path, document, signal) {
  const answer = await answered(method, path, document, signal, "application/json");
  return whole(answer.json());
}

/** Returns what the body of an answer holds; one that was cut off is no answer. */
async function whole(reading) {
  try {
    return await reading;
  } catch (error) {
    if (error.name === "AbortError") throw error;
    report(false);
    throw new Unreachable();
  }
}

async function answered(method, path, document, signal, form) {
  const options = { method, signal, headers: { Accept: form, ...keyHeaders() } };
  if (document !== undefined) {
    options.headers["Content-Type"] = "application/json";
    options.body = typeof document === "string" ? document : JSON.stringify(document);
  }
  let answer;
  try {
    answer = await fetch(path, options);
  } catch (error) {
    if (error.name === "AbortError") throw error;
    report(false);
    throw new Unreachable();
  }
  report(true);
  if (answer.ok) return answer;
  const after = Number.parseFloat(answer.headers.get("Retry-After") ?? "");
  const problem = new Problem(answer.status, await answer.json().catch(() => ({})), Number.isNaN(after) ? null : after);
  const wanted = problem.status === 401 || problem.type === "/problems/scope-missing";
  if (wanted) for (const listener of withoutKey) listener(problem);
  throw problem;
}

/** Waits, or throws AbortError as soon as the view is left. */
export function pause(milliseconds, signal) {
  return new Promise((resolve, reject) => {
    let timer;
    const left = () => {
      clearTimeout(timer);
      reject(new DOMException("The view was left.", "AbortError"));
    };
    if (signal?.aborted) return left();
    timer = setTimeout(() => {
      signal?.removeEventListener("abort", left);
      resolve();
    }, milliseconds);
    signal?.addEventListener("abort", left, { once: true });
  });
}
