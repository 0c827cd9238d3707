/** How exactly a job computes, as one choice of a form: a named accuracy, or a tolerance. */

const STANDARD = "standard";

/** The field of forms that are written here. */
export const ACCURACY = {
  title: "Accuracy",
  help: "How small the error of every step is kept.",
  unit: "1",
  choices: ["draft", STANDARD, "fine", "reference"],
  default: STANDARD,
};

/** Returns the part of a job's document that a choice stands for; nothing for what is usual. */
export function accurate(choice) {
  const tolerance = Number(/^tolerance (.+)$/.exec(choice)?.[1]);
  if (tolerance > 0) return { tolerance };
  return ACCURACY.choices.includes(choice) && choice !== STANDARD ? { accuracy: choice } : {};
}

/** Returns the choice that a job's document made; undefined where it says nothing. */
export function accuracyOf({ accuracy, tolerance }) {
  return accuracy ?? (tolerance ? `tolerance ${tolerance.toExponential()}` : undefined);
}
