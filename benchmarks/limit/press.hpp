// The press with play at both crank pins: four coordinates and, of each pin, journal and bearing.
//
// q = (s, theta6, theta2, theta3): the slider's position and the angles of links 6, 2 and 3. With u(a) =
// (cos a, sin a) the slider is D = (s, 0), the joint of the links C = D - L6 u6, and the journals
// A = C - L2 u2 and B = C - L3 u3. The bearings are the pins of cranks that turn at constant speed.
#pragma once
#include "lanes.hpp"

constexpr int COORDINATES = 4, STATES = 8, PINS = 2, ANGLES = 3 + PINS;

struct Crank {
    double length, x, y, angle, speed;
};
// Constants of the mass matrix: mass, first moments, moments of inertia about the slider's joint and
// one over those about C.
struct Inertia {
    double total, first6, first2, first3, about_slider, inverse2, inverse3;
};
// As Python gives it, but for `inertia`.
struct Mechanism {
    Crank crank[PINS];
    double length6, length2, length3;  // m
    double centre6, centre2, centre3;  // of mass, from D and from C, m
    double mass7, mass6, mass2, mass3, inertia6, inertia2, inertia3;
    double gravity_x, gravity_y;
    Inertia inertia;
};

inline Mechanism with_inertia(Mechanism p) {
    const double both = p.mass2 + p.mass3;
    const double about6 = p.inertia6 + p.mass6 * p.centre6 * p.centre6;
    const double about2 = p.inertia2 + p.mass2 * p.centre2 * p.centre2;
    const double about3 = p.inertia3 + p.mass3 * p.centre3 * p.centre3;
    p.inertia = {p.mass7 + p.mass6 + both,
                 p.mass6 * p.centre6 + both * p.length6,
                 p.mass2 * p.centre2,
                 p.mass3 * p.centre3,
                 about6 + both * p.length6 * p.length6,
                 1.0 / about2,
                 1.0 / about3};
    return p;
}

// A run: its numbers, where it is and what it has counted. All doubles, as `numbers.py` has them.
struct Press {
    double radial, bearing_radius, stiffness, hysteresis, friction, static_velocity, ramp;
    double impact_floor, restart, end, largest_step, full, weight[STATES];
    double y[STATES], time, step, memory, fastest, contact[PINS], impact_rate[PINS];
    double attempts, accepted, onsets;
};

// Numbers of a clearance that runs may differ in: of every lane.
template <class V> struct Clearance {
    V radial, bearing_radius, stiffness, hysteresis, friction, static_velocity, ramp;
};
// Of a pin: whether it is in contact, 1 or 0, and one over the penetration rate at the onset.
template <class V> struct Mode {
    V contact, inverse_rate;
};
template <class V> struct Gap {
    V depth, rate;  // penetration e - c, m, and its rate: negative while apart
};
template <class V> struct Force {
    V x, y, moment;
};

// The forces on a journal whose centre is (ex, ey) from that of its bearing: eqs. 2 to 17.
template <class V>
inline Force<V> contact(V ex, V ey, V vx, V vy, V spin_journal, double spin_bearing,
                        const Clearance<V> &c, const Mode<V> &mode, Gap<V> &gap) {
    const V zero{}, square = ex * ex + ey * ey + 1e-300;
    const V distance = root(square), inverse = 1.0 / distance;
    const V nx = ex * inverse, ny = ey * inverse;
    const V journal_radius = c.bearing_radius - c.radial;
    gap.depth = distance - c.radial;
    gap.rate = vx * nx + vy * ny;
    const V slip = nx * vy - ny * vx + journal_radius * spin_journal - c.bearing_radius * spin_bearing;
    const V depth = mode.contact * larger(gap.depth, zero);
    const V elastic = c.stiffness * depth * root(depth);
    const V normal = larger(elastic * (1.0 + c.hysteresis * gap.rate * mode.inverse_rate), zero);
    const V ramp = (magnitude(slip) - c.static_velocity) * c.ramp;
    const V share = smaller(larger(ramp, zero), zero + 1.0);
    const V along = c.friction * share * normal;
    const V tangential = slip > 0.0 ? -along : along;
    return {-(normal * nx) - tangential * ny, tangential * nx - normal * ny,
            journal_radius * tangential};
}

// Accelerations of the coordinates: M q'' = Q, whose M23 is 0, so that q2'' and q3'' are eliminated.
// `u` : directions of links 6, 2, 3 and of the cranks.
template <class V>
inline void accelerations(const Mechanism &p, const V *y, const Direction<V> *u,
                          const Clearance<V> &clearance, const Mode<V> *mode, V *out,
                          Gap<V> *gap) {
    const V ds = y[4], w6 = y[5], w2 = y[6], w3 = y[7];
    const V x6 = p.length6 * u[0].cosine, y6 = p.length6 * u[0].sine;
    const V x2 = p.length2 * u[1].cosine, y2 = p.length2 * u[1].sine;
    const V x3 = p.length3 * u[2].cosine, y3 = p.length3 * u[2].sine;
    const V cx = y[0] - x6, cy = -y6, cvx = ds + y6 * w6, cvy = -(x6 * w6);
    Force<V> on[PINS];
    const V lx[PINS] = {x2, x3}, ly[PINS] = {y2, y3}, spin[PINS] = {w2, w3};
    for (int j = 0; j < PINS; ++j) {
        const Crank &crank = p.crank[j];
        const V px = crank.length * u[3 + j].cosine, py = crank.length * u[3 + j].sine;
        const V ex = cx - lx[j] - (px + crank.x), ey = cy - ly[j] - (py + crank.y);
        const V vx = cvx + ly[j] * spin[j] + py * crank.speed;
        const V vy = cvy - lx[j] * spin[j] - px * crank.speed;
        on[j] = contact<V>(ex, ey, vx, vy, spin[j], crank.speed, clearance, mode[j], gap[j]);
    }
    const Inertia &m = p.inertia;
    const double s6 = m.first6, s2 = m.first2, s3 = m.first3;
    const V cos62 = u[0].cosine * u[1].cosine + u[0].sine * u[1].sine;
    const V sin62 = u[0].sine * u[1].cosine - u[0].cosine * u[1].sine;
    const V cos63 = u[0].cosine * u[2].cosine + u[0].sine * u[2].sine;
    const V sin63 = u[0].sine * u[2].cosine - u[0].cosine * u[2].sine;
    const V m01 = s6 * u[0].sine, m02 = s2 * u[1].sine, m03 = s3 * u[2].sine;
    const V m12 = (s2 * p.length6) * cos62, m13 = (s3 * p.length6) * cos63;
    const V q6 = w6 * w6, q2 = w2 * w2, q3 = w3 * w3;
    const V fx = on[0].x + on[1].x, fy = on[0].y + on[1].y;
    const V f0 = m.total * p.gravity_x - s6 * u[0].cosine * q6 - s2 * u[1].cosine * q2 -
                 s3 * u[2].cosine * q3 + fx;
    const V f1 = s6 * (u[0].sine * p.gravity_x - u[0].cosine * p.gravity_y) -
                 (s2 * p.length6) * sin62 * q2 - (s3 * p.length6) * sin63 * q3 + y6 * fx - x6 * fy;
    const V f2 = s2 * (u[1].sine * p.gravity_x - u[1].cosine * p.gravity_y) +
                 (s2 * p.length6) * sin62 * q6 + y2 * on[0].x - x2 * on[0].y + on[0].moment;
    const V f3 = s3 * (u[2].sine * p.gravity_x - u[2].cosine * p.gravity_y) +
                 (s3 * p.length6) * sin63 * q6 + y3 * on[1].x - x3 * on[1].y + on[1].moment;
    const V a0 = m02 * m.inverse2, a1 = m12 * m.inverse2;
    const V b0 = m03 * m.inverse3, b1 = m13 * m.inverse3;
    const V n00 = m.total - a0 * m02 - b0 * m03, n01 = m01 - a0 * m12 - b0 * m13;
    const V n11 = m.about_slider - a1 * m12 - b1 * m13;
    const V r0 = f0 - a0 * f2 - b0 * f3, r1 = f1 - a1 * f2 - b1 * f3;
    const V inverse = 1.0 / (n00 * n11 - n01 * n01);
    out[0] = (n11 * r0 - n01 * r1) * inverse;
    out[1] = (n00 * r1 - n01 * r0) * inverse;
    out[2] = f2 * m.inverse2 - a0 * out[0] - a1 * out[1];
    out[3] = f3 * m.inverse3 - b0 * out[0] - b1 * out[1];
}
