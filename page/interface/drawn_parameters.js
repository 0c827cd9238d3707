/** Fields of parameters that have distributions: a name, a distribution and its two numbers each. */

const SLOTS = [1, 2, 3];
const NONE = "–";

export class DrawnParameters {
  /**
   * @param field   of the document
   * @param members numbers of each distribution; those of two can be typed here
   * @param choice  makes the field of a parameter
   */
  constructor(field, members, choice) {
    Object.assign(this, { field, members, choice });
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
      const title = `Parameter ${nth}`;
      const one = this.choice(document, nth > 1 ? [NONE] : [], nth - 1);
      const first = document.parameters?.[one.default]?.default || 1;
      const number = (place, value) => ({
        title: `${title}, ${this.titles[place]}`, help: "", unit: "1", required: nth === 1,
        default: nth === 1 ? Number(value.toPrecision(2)) : null, empty: "",
      });
      return {
        [name]: { ...one, title, help: "What is drawn.", ...(nth > 1 ? { default: NONE } : {}) },
        [kind]: {
          title: `${title}, distribution`, help: "", unit: "1", choices: this.kinds,
          default: this.kinds[0],
        },
        [a]: number(0, first * 0.5),
        [b]: number(1, first * 1.5),
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
