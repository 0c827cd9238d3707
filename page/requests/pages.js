/** Answers that come in pages: each says where the next one begins. */

/**
 * Returns an answer and those that follow it, in order; null as soon as they are not `wanted` any more.
 *
 * @param answer its `next_start` is null, or not there, if nothing follows
 * @param ask returns the answer that begins at a start
 */
export async function withNext(answer, ask, wanted = () => true) {
  const pages = [answer];
  while (wanted() && (pages.at(-1).next_start ?? null) !== null) pages.push(await ask(pages.at(-1).next_start));
  return wanted() ? pages : null;
}
