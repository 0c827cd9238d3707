/** Choice of the channels that are plotted. */

import { element, fill } from "./element.js";

const MOST = 8;
const LISTED = 400;

export class ChannelChoice {
  /** @param onchange called with the names that are chosen, in the order of the choice */
  constructor(channels, names, onchange) {
    Object.assign(this, { channels, names: [...names], onchange });
    this.list = element("div", { class: "fields small" });
    this.search = element("input", {
      type: "search", "aria-label": "Find a channel", placeholder: "Find a channel",
      oninput: () => this.refresh(),
    });
    this.said = element("p", { class: "quiet", role: "status" });
    this.element = element("details", {},
      element("summary", {}, `Channels (${channels.length})`),
      element("div", { class: "stacked" }, this.search, this.said, this.list));
    this.refresh();
  }

  refresh() {
    const text = this.search.value.trim().toLowerCase();
    const found = this.channels.filter((name) => name.toLowerCase().includes(text));
    fill(this.list, found.slice(0, LISTED).map((name) => element("label", { class: "buttons" },
      element("input", {
        type: "checkbox", checked: this.names.includes(name),
        onchange: (event) => this.choose(name, event.target),
      }), name)));
  }

  choose(name, box) {
    const full = box.checked && this.names.length >= MOST;
    this.said.textContent = full ? `At most ${MOST} channels are shown; leave one out first.` : "";
    if (full) {
      box.checked = false;
      return;
    }
    this.names = box.checked ? [...this.names, name] : this.names.filter((one) => one !== name);
    this.onchange(this.names);
  }
}
