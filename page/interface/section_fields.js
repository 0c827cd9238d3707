/** Fields of where a study takes its sections: once a period, as contact begins, or where a channel crosses a value. */

import { withUnit } from "./numbers.js";

const WORDS = {
  crank_angle: "once a period, at an angle of the drive",
  onset: "whenever contact begins in a joint",
  channel: "whenever a channel passes a value",
};
const FORMS = Object.keys(WORDS);
const OF_MOTIONS = "A motion counts as an even turn in each of its periods.";
const WHEN_IT_ENDS = "With contacts and values a run ends with its last section, or after 20 periods for each.";
const LARGEST_ANGLE = 6.283185; // rad: less than a turn
/** What is offered of a scene that cannot be put together: what is wrong is told when it is run. */
export const UNKNOWN = { channels: [], contacts: [], period: null, sections: [{ crank_angle: 0 }] };

/**
 * Returns the fields of a kind's sections; those of a form that is not chosen are hidden.
 *
 * @param members fields by form, of the forms that the kind has
 * @param offered what `POST /v1/scenes/channels` answers of the scene
 */
export function sectionFields({ members }, offered) {
  const suits = offered.sections.filter((one) => members[formOf(one)] || formOf(one) === "crank_angle");
  const { onset = offered.contacts[0] ?? "", channel = "", value, direction = "up" } = Object.assign({}, ...suits);
  const units = Object.fromEntries(offered.channels.map(({ name, unit }) => [name, unit]));
  const forms = suits.map(formOf);
  const alone = Object.keys(members).join() === "crank_angle";
  if (alone && !forms.length) return {}; // nothing turns it, and there is no other form
  const of = (form) => ({ help: "", unit: "1", shown: ({ section }) => alone || section === form });
  if (members.onset && onset && !forms.includes("onset")) forms.push("onset"); // a parameter may open a joint
  const period = offered.period === null ? "" : `A period is ${withUnit(offered.period, "s")} here.`;
  return {
    ...(!alone && {
      section: {
        title: "Sections are taken", unit: "1", choices: forms, words: WORDS, default: forms[0],
        help: `${members.onset ? WHEN_IT_ENDS : ""} ${period}`,
      },
    }),
    ...(members.crank_angle && {
      section_angle: {
        ...of("crank_angle"), title: alone ? "Poincaré sections at" : "Angle of the drive",
        help: `${alone ? `Once a period, when the first driver has turned so far since the start. ${period}`
          : "Turned by the first driver since the start."} ${OF_MOTIONS}`,
        unit: "rad", minimum: 0, maximum: LARGEST_ANGLE, default: 0, pointer: "section/crank_angle",
      },
    }),
    ...(members.onset && {
      section_onset: {
        ...of("onset"), title: "Joint with play", choices: offered.contacts, default: onset,
        pointer: "section/onset",
      },
    }),
    ...(members.channel && {
      section_channel: {
        ...of("channel"), title: "Channel", choices: Object.keys(units), default: channel,
        proposes: (chosen) => ({ section_value: chosen === channel ? value : 0 }),
        pointer: "section/channel",
      },
      section_value: {
        ...of("channel"), title: "Value that it passes",
        help: ({ section_channel: passes }) => (units[passes] === "rad" ? "An angle passes it once a turn." : ""),
        unit: (all) => units[all.section_channel] ?? "1", default: value, required: true,
        pointer: "section/value",
      },
      section_direction: {
        ...of("channel"), title: "Sense", choices: ["up", "down"], words: { up: "upwards", down: "downwards" },
        default: direction,
      },
    }),
  };
}

/** Whether a scene moves by nothing but its start and its weight, and strikes until it is at rest: it need not settle. */
export function fades({ forces }, { sections: [first] }) {
  return "onset" in first && Object.keys(forces ?? {}).length === 0;
}

/** Returns the `section` of a job's document, as a part of it; none where it is as usual. */
export function sectionMade({ section, ...all }) {
  if (section === "onset") return { section: { onset: all.section_onset } };
  if (section === "channel") {
    return {
      section: { channel: all.section_channel, value: all.section_value, direction: all.section_direction },
    };
  }
  return all.section_angle ? { section: { crank_angle: all.section_angle } } : {};
}

/** Returns the values of the fields that give a job's `section`. */
export function sectionGiven(written) {
  if (!written) return {};
  const values = { angle: written.crank_angle, ...written };
  const named = ["angle", "onset", "channel", "value", "direction"].filter((name) => values[name] !== undefined)
    .map((name) => [`section_${name}`, values[name]]);
  return { section: formOf(written), ...Object.fromEntries(named) };
}

function formOf(section) {
  return FORMS.find((form) => form in section);
}
