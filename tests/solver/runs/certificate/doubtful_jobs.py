"""Jobs whose certificates once claimed what was not so; truths are of an independent integration
in absolute coordinates, to 1e-12, and of the runs' own ledgers.
"""

from typing import Any

GUIDE: dict[str, Any] = {
    "kind": "simulate",
    "scene": {
        "name": "g",
        "gravity": [-5.73720418, 7.23147438],
        "ground": {"points": {"O": [0.0, 0.0], "W": [-0.46970916333023677, 0.23675311005336497]}},
        "bodies": {
            "s": {
                "mass": 5.78321589,
                "inertia": 0.07549780244782511,
                "points": {
                    "p": [-0.05283176473228614, 0.0022039606432629607],
                    "q": [0.016019901467713857, 0.0022039606432629607],
                },
            },
            "arm": {
                "mass": 1.0,
                "inertia": 0.1,
                "points": {"O": [0.0, 0.0], "g": [-0.0688031364, -0.0485284611], "far": [0.5, 0.0]},
            },
        },
        "joints": {
            "guide": {
                "type": "prismatic",
                "guide": "arm.g",
                "slider": "s.p",
                "axis": [-0.939113858434658, 0.3436061130072762],
                "angle": 0.0,
                "clearance": {
                    "wall_clearance": 0.000243118492,
                    "length": 0.229505554,
                    "height": 0.0564609214,
                    "contact": {
                        "law": "lankarani-nikravesh",
                        "stiffness": 60926791200.0,
                        "restitution": 0.941141862,
                        "impact_rate_floor": 1e-3,
                    },
                    "friction": {
                        "law": "lugre",
                        "static_coefficient": 0.05339035087334526,
                        "kinetic_coefficient": 0.0339006566,
                        "stribeck_velocity": 0.0477434822,
                        "bristle_stiffness": 396.847334,
                        "bristle_damping": 6.40326656,
                        "viscous_damping": 0.0190666724,
                    },
                },
            },
            "A": {"type": "revolute", "bearing": "ground.O", "journal": "arm.O"},
        },
        "forces": {
            "k": {
                "type": "spring-damper",
                "first": "arm.far",
                "second": "s.p",
                "stiffness": 32993.933467169096,
                "damping": 0.9371844079513165,
                "free_length": 0.237902489,
            }
        },
        "start": {
            "guides": {"guide": {"offset": 5.8382762521174525e-06, "tilt": 0.0}},
            "points": {"s.p": [-0.07109003819630899, -0.04769793863054457]},
            "velocities": {"s": [0.0, 0.0]},  # which does not turn unless it is said
            "angular_velocities": {"s": 0.418875828 * 54.917503},
        },
        "drivers": {
            "d": {
                "joint": "A",
                "motion": {"type": "sinusoidal", "amplitude": 0.418875828, "frequency": 54.917503},
            }
        },
    },
    "duration": 0.251801323,
    "accuracy": "standard",
}

SLOT: dict[str, Any] = {
    "kind": "simulate",
    "scene": {
        "name": "sl",
        "gravity": [0.0, 0.0],
        "ground": {"points": {"O": [0.0, 0.0], "W": [0.1, 0.3], "R": [0.0, -0.2]}},
        "bodies": {
            "crank": {
                "mass": 1.0,
                "inertia": 0.001,
                "points": {"O": [0.0, 0.0], "pin": [0.060293938, 0.0]},
            },
            "rock": {
                "mass": 0.0811465497,
                "inertia": 0.004573298892401907,
                "points": {"R": [0.0, -0.2], "s": [0.0, 0.0]},
            },
        },
        "joints": {
            "O": {"type": "revolute", "bearing": "ground.O", "journal": "crank.O"},
            "R": {"type": "revolute", "bearing": "ground.R", "journal": "rock.R"},
            "slot": {
                "type": "pin-in-slot",
                "slot": "rock.s",
                "pin": "crank.pin",
                "axis": [0.0, 1.0],
                "clearance": {
                    "wall_clearance": 4.11157286e-05,
                    "pin_radius": 0.0122987695,
                    "contact": {
                        "law": "stiffness-and-dissipation",
                        "stiffness": {
                            "law": "power",
                            "stiffness": 94497755300.0,
                            "exponent": 1.24644713,
                        },
                        "dissipation": {
                            "law": "lankarani-nikravesh",
                            "restitution": 0.597470127,
                            "impact_rate_floor": 1e-3,
                        },
                    },
                    "friction": {
                        "law": "lugre",
                        "static_coefficient": 0.4445276669689705,
                        "kinetic_coefficient": 0.374617952,
                        "stribeck_velocity": 0.00573066889,
                        "bristle_stiffness": 1599.77807,
                        "bristle_damping": 0.0,
                        "viscous_damping": 0.0,
                    },
                },
            },
        },
        "drivers": {"d": {"joint": "O", "position": 1.5707963267948966, "speed": -4.83651083}},
        "forces": {
            "t": {
                "type": "torsion-spring",
                "first": "ground.R",
                "second": "rock.R",
                "stiffness": 5.031923181092051,
                "damping": 0.0,
                "free_angle": -0.26266179,
            }
        },
    },
    "duration": 0.7968920670156251,
    "accuracy": "standard",
}

FAILS: dict[str, Any] = {
    "kind": "simulate",
    "scene": {"preset": "double-four-bar", "parameters": {"speed": -30.0}},
    "duration": 2.6666666666666665,
    "accuracy": "reference",
    "output_step": 0.005333333333333333,
}

BRISTLES: dict[str, Any] = {
    "kind": "simulate",
    "scene": {
        "name": "br",
        "gravity": [0.0, -9.81],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {
            "j": {
                "mass": 0.58397006,
                "inertia": 0.0007085682766223044,
                "points": {"c": [0.0, 0.0], "q": [0.1, 0.0]},
            }
        },
        "joints": {
            "B": {
                "type": "revolute",
                "bearing": "ground.O",
                "journal": "j.c",
                "clearance": {
                    "radial_clearance": 3.27593804e-05,
                    "bearing_radius": 0.0251565388,
                    "contact": {
                        "law": "stiffness-and-dissipation",
                        "stiffness": {
                            "law": "power",
                            "stiffness": 12322052400.0,
                            "exponent": 1.33827993,
                        },
                        "dissipation": {
                            "law": "flores",
                            "restitution": 0.932678503,
                            "impact_rate_floor": 1e-3,
                        },
                    },
                    "friction": {
                        "law": "lugre",
                        "static_coefficient": 0.422976545098434,
                        "kinetic_coefficient": 0.37479201,
                        "stribeck_velocity": 0.083565171,
                        "bristle_stiffness": 156.901689,
                        "bristle_damping": 0.272439751,
                        "viscous_damping": 0.926156923,
                    },
                },
            }
        },
        "start": {
            "angular_velocities": {"j": 104.564862},
            "joints": {
                "B": {
                    "eccentricity": [-9.563616432746982e-07, 2.587219453533749e-07],
                    "rate": [0.0496470858, 0.0219804899],
                }
            },
        },
    },
    "duration": 0.351176703,
    "accuracy": "standard",
}

ROTOR: dict[str, Any] = {
    "kind": "simulate",
    "scene": {
        "name": "rotor",
        "gravity": [0.0, 0.0],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {
            "rotor": {
                "mass": 0.0234556388,
                "inertia": 0.0174031649,
                "points": {"centre": [4.312736251093273e-05, 0.0]},
            }
        },
        "joints": {
            "J": {
                "type": "revolute",
                "bearing": "ground.O",
                "journal": "rotor.centre",
                "clearance": {
                    "radial_clearance": 3.80619486e-05,
                    "bearing_radius": 0.0005386007953140891,
                    "contact": {
                        "law": "lankarani-nikravesh",
                        "stiffness": 3964479450.0,
                        "restitution": 0.0,
                        "impact_rate_floor": 1e-3,
                    },
                    "friction": {
                        "law": "modified-coulomb",
                        "coefficient": 0.0101809739,
                        "static_velocity": 0.02383059665,
                        "dynamic_velocity": 0.0476611933,
                    },
                },
            }
        },
        "start": {
            "angles": {"rotor": 0.0},
            "angular_velocities": {"rotor": 15.2819838},
            "velocities": {"rotor": [-0.159067054, 0.0959848427]},
            "joints": {"J": {"eccentricity": [-2.22128255431844e-05, -1.1916700349779486e-05]}},
        },
    },
    "duration": 0.109863676,
    "method": "bogacki-shampine",
    "tolerance": 4.1919853e-07,
}

LEG: dict[str, Any] = {
    "kind": "simulate",
    "scene": {"preset": "jansen-leg", "parameters": {"speed": 1000.0}},
    "duration": 0.002,
}
