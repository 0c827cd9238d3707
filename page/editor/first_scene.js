/** The mechanism that an empty editor begins with: a slider-crank with play at its small end. */

export const FIRST_SCENE = {
  name: "mine",
  ground: { points: { O: [0, 0] } },
  bodies: {
    crank: { mass: 0.5, inertia: 4e-4, points: { O: [-0.05, 0], pin: [0.05, 0] } },
    rod: { mass: 0.3, inertia: 1e-3, points: { crank: [-0.1, 0], slider: [0.1, 0] } },
    slider: { mass: 0.2, inertia: 1e-4, points: { pin: [0, 0] } },
  },
  joints: {
    main: { type: "revolute", bearing: "ground.O", journal: "crank.O" },
    small: {
      type: "revolute",
      bearing: "crank.pin",
      journal: "rod.crank",
      clearance: {
        radial_clearance: 2e-4,
        bearing_radius: 0.01,
        contact: { law: "lankarani-nikravesh", restitution: 0.8 },
        friction: { law: "modified-coulomb", coefficient: 0.05 },
      },
    },
    wrist: { type: "revolute", bearing: "slider.pin", journal: "rod.slider" },
    guide: { type: "prismatic", guide: "ground.O", slider: "slider.pin", axis: [1, 0] },
  },
  drivers: { motor: { joint: "main", position: 1, speed: 60 } },
  start: { angles: { crank: 1 } },
  parameters: {
    clearance: {
      help: "Radial clearance of the small end.", unit: "m", default: 2e-4, minimum: 0, maximum: 1e-3,
      targets: [{ path: "/joints/small/clearance/radial_clearance" }],
    },
    speed: {
      help: "Speed of the crank.", unit: "rad/s", default: 60, targets: [{ path: "/drivers/motor/speed" }],
    },
  },
};
