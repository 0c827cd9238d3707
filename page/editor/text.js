/** An editor of JSON text, in a shadow of its own: the page's policy allows no other styles. */

import {
  EditorState, EditorView, HighlightStyle, bracketMatching, closeBrackets, closeBracketsKeymap,
  completionKeymap, defaultKeymap, drawSelection, foldGutter, foldKeymap, highlightActiveLine,
  history, historyKeymap, indentOnInput, json, keymap, lineNumbers, lintGutter, lintKeymap,
  setDiagnostics, syntaxHighlighting, tags,
} from "../vendor/codemirror/codemirror.js";
import { element } from "../interface/element.js";
import { rangeAt } from "./pointers.js";

const LOOK = EditorView.theme({
  "&": { height: "100%", color: "var(--ink)", backgroundColor: "var(--paper)", fontSize: "14px" },
  ".cm-scroller": { fontFamily: "ui-monospace, Menlo, Consolas, monospace", lineHeight: "1.5" },
  ".cm-gutters": { backgroundColor: "var(--surface)", color: "var(--quiet)", border: "none" },
  ".cm-activeLine, .cm-activeLineGutter": { backgroundColor: "var(--surface)" },
  ".cm-cursor": { borderLeftColor: "var(--ink)" },
  "&.cm-focused .cm-selectionBackground, .cm-selectionBackground": { backgroundColor: "var(--ground)" },
  ".cm-tooltip": { backgroundColor: "var(--paper)", color: "var(--ink)", border: "1px solid var(--line)" },
  ".cm-tooltip-autocomplete ul li[aria-selected]": { backgroundColor: "var(--accent)", color: "var(--on-accent)" },
  ".help-tip": { padding: "0.4rem 0.6rem", maxWidth: "26rem", whiteSpace: "pre-wrap" },
});
const COLOURS = HighlightStyle.define([
  { tag: tags.propertyName, color: "var(--accent)" },
  { tag: tags.string, color: "var(--good)" },
  { tag: tags.number, color: "var(--play)" },
  { tag: [tags.bool, tags.null], color: "var(--curve-3)" },
]);

export class TextEditor {
  /** @param onchange called with the text whenever it was edited */
  constructor(text, extensions, onchange) {
    this.element = element("div", { class: "editor-room" });
    const root = this.element.attachShadow({ mode: "open" });
    this.view = new EditorView({
      root,
      parent: root,
      state: EditorState.create({
        doc: text,
        extensions: [
          lineNumbers(), foldGutter(), lintGutter(), history(), drawSelection(), indentOnInput(),
          bracketMatching(), closeBrackets(), highlightActiveLine(), json(),
          syntaxHighlighting(COLOURS), LOOK,
          EditorView.contentAttributes.of({ "aria-label": "Scene document" }),
          keymap.of([
            ...closeBracketsKeymap, ...defaultKeymap, ...historyKeymap, ...foldKeymap,
            ...completionKeymap, ...lintKeymap,
          ]),
          EditorView.updateListener.of((update) => {
            if (update.docChanged) onchange(this.text);
          }),
          extensions,
        ],
      }),
    });
    this.view.scrollDOM.tabIndex = 0; // for readers who scroll with keys
  }

  get text() {
    return this.view.state.doc.toString();
  }

  set text(text) {
    this.view.dispatch({ changes: { from: 0, to: this.view.state.doc.length, insert: text } });
  }

  /** Marks what is wrong at its place: `{pointer, detail}` or `{from, to, detail}`. */
  mark(errors) {
    const found = errors.map(({ pointer, from, to, detail }) => ({
      ...(pointer === undefined ? { from, to } : rangeAt(this.view.state, pointer)),
      severity: "error",
      message: detail,
    }));
    this.view.dispatch(setDiagnostics(this.view.state, found));
  }

  /** Goes to the place that a pointer names. */
  reveal(pointer) {
    const { from, to } = rangeAt(this.view.state, pointer);
    this.view.dispatch({ selection: { anchor: from, head: to }, scrollIntoView: true });
    this.view.focus();
  }
}
