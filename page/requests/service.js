/** Requests to the service: JSON in both directions, and problems as errors that can be shown. */

import { keyHeaders } from "./key.js";

/** A problem document (RFC 9457): title, detail, and the fields that are wrong. */
export class Problem extends Error {
  constructor(status, document) {
    super(document.detail ?? document.title ?? `The service answered with status ${status}.`);
    this.status = status;
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

const listeners = new Set();

/** Calls `listener` with true or false whenever the service answers, or does not. */
export function onReachable(listener) {
  listeners.add(listener);
}

/** Tells the page whether the service answered. */
export function report(reachable) {
  for (const listener of listeners) listener(reachable);
}

/** Returns what a GET answers; `query` values of null and "" are left out. */
export function get(path, query = {}, signal = undefined) {
  return request("GET", withQuery(path, query), undefined, signal);
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
  return (await answered("GET", path, undefined, signal, form)).arrayBuffer();
}

async function request(method, path, document, signal) {
  return (await answered(method, path, document, signal, "application/json")).json();
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
  if (!answer.ok) throw new Problem(answer.status, await answer.json().catch(() => ({})));
  return answer;
}

/** Waits, or throws AbortError as soon as the view is left. */
export function pause(milliseconds, signal) {
  return new Promise((resolve, reject) => {
    const left = () => {
      clearTimeout(timer);
      reject(new DOMException("The view was left.", "AbortError"));
    };
    if (signal?.aborted) return left();
    const timer = setTimeout(() => {
      signal?.removeEventListener("abort", left);
      resolve();
    }, milliseconds);
    signal?.addEventListener("abort", left, { once: true });
  });
}
