/** Fields of parameters that have distributions: a name, a distribution and its two numbers each. */

const SLOTS = [1, 2, 3];
const OF_LOGARITHM = "log-normal"; // whose standard deviation is that of the logarithm
export const NONE = "–"; // nothing is drawn, or varies

export class DrawnParameters {
  /**
   * @param field    of the document
   * @param members  numbers of each distribution; those of two can be typed here
   * @param of       what may be drawn: see `choice`
   * @param choice   makes the field of a parameter
   * @param proposed gives a range of its values
   */
  constructor(field, { members, varied: of }, choice, proposed) {
    Object.assign(this, { field, members, of, choice, proposed });
    this.kinds = Object.keys(members).filter((kind) => members[kind].length === 2);
    this.titles = [0, 1].map((place) =>
      [...new Set(this.kinds.map((kind) => members[kind][place].replaceAll("_", " ")))].join(" or "));
  }

  names(nth) {
    return ["", "_distribution", "_a", "_b"].map((part) => `${this.field}_${nth}${part}`);
  }

  fields(document) {
    return Object.assign({}, ...SLOTS.map((nth) => {
      const [name, kind, a, b] = this.names(nth);
      const title = `${this.of.includes("start") ? "Number of the start" : "Parameter"} ${nth}`;
      const one = this.choice(document, { of: this.of, none: nth > 1 });
      const proposes = (chosen) => {
        const { from, to } = this.proposed(document, chosen);
        return { [a]: from, [b]: to };
      };
      const shown = (all) => all[name] !== NONE;
      const place = (all) => `${this.field}/${(all[name] ?? "").replaceAll("~", "~0").replaceAll("/", "~1")}`;
      const number = (end, value) => ({
        shown, pointer: (all) => `${place(all)}/${this.members[all[kind]]?.[end]}`,
        title: `${title}, ${this.titles[end]}`, help: "", required: nth === 1, default: value, empty: "",
        unit: (all) => (end && all[kind] === OF_LOGARITHM ? "1" : one.units[all[name]]),
      });
      const range = proposes(one.default);
      return {
        [name]: { ...one, title, help: "What is drawn.", proposes, pointer: place, once: this.field },
        [kind]: {
          shown, title: `${title}, distribution`, help: "", unit: "1", choices: this.kinds,
          default: this.kinds[0],
        },
        [a]: number(0, range[a]),
        [b]: number(1, range[b]),
      };
    }));
  }

  made(all) {
    const chosen = SLOTS.map((nth) => this.names(nth).map((name) => all[name]))
      .filter(([name]) => name && name !== NONE);
    return Object.fromEntries(chosen.map(([name, kind, ...numbers]) => [name, {
      distribution: kind,
      ...Object.fromEntries(this.members[kind].map((member, place) => [member, numbers[place]])),
    }]));
  }

  given(written) {
    return Object.assign({}, ...Object.entries(written ?? {}).slice(0, SLOTS.length).map(([name, one], place) => {
      const [parameter, kind, ...numbers] = this.names(place + 1);
      if (!this.kinds.includes(one.distribution)) return { [parameter]: name };
      return {
        [parameter]: name, [kind]: one.distribution,
        ...Object.fromEntries(this.members[one.distribution].map((member, i) => [numbers[i], one[member]])),
      };
    }));
  }
}
