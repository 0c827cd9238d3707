// Gaps of one press at both ends of a step, and where inside it they close and open.
#pragma once
#include <algorithm>
#include <cmath>

#include "press.hpp"

constexpr double LANDED = 1e-13;  // penetration, m, at which an onset counts as located
constexpr int NO_PIN = -1;

// Where in 0..1 the cubic through both ends has its change of sign: Newton inside a bracket.
inline double crossing(double start, double start_rate, double end, double end_rate) {
    const double square = 3 * (end - start) - 2 * start_rate - end_rate;
    const double cube = 2 * (start - end) + start_rate + end_rate;
    double low = 0, high = 1, x = start / (start - end);
    for (int i = 0; i < 40; ++i) {
        const double value = start + x * (start_rate + x * (square + x * cube));
        const double slope = start_rate + x * (2 * square + 3 * x * cube);
        (value * end < 0 ? low : high) = x;
        double better = x - value / slope;
        if (!(better > low && better < high)) better = 0.5 * (low + high);
        if (std::fabs(better - x) <= 1e-15) break;
        x = better;
    }
    return x;
}

struct Gaps {
    double start[PINS], start_rate[PINS], end[PINS], end_rate[PINS];  // m; rates: in the whole step
    bool touches[PINS];

    bool just_closed() const {
        bool found = false;
        for (int j = 0; j < PINS; ++j)
            found |= touches[j] && std::fabs(start[j]) <= LANDED;
        return found;
    }

    double crossing_of(int j) const { return crossing(start[j], start_rate[j], end[j], end_rate[j]); }

    // The share of the step at which the first contact ends; 1: none does.
    double opening() const {
        double soonest = 1;
        for (int j = 0; j < PINS; ++j)
            if (touches[j] && start[j] > LANDED && end[j] <= 0)
                soonest = std::min(soonest, crossing_of(j));
        return soonest;
    }

    // The pin whose contact begins first, and the share of the step before that. One that steps aim
    // at counts as closed only where it is too deep.
    int onset(int target, double &share) const {
        int pin = NO_PIN;
        share = 2;
        for (int j = 0; j < PINS; ++j) {
            const bool closed = end[j] > (j == target ? LANDED : 0);
            if (touches[j] || start[j] >= 0 || !closed) continue;
            const double found = crossing_of(j);
            if (found < share) share = found, pin = j;
        }
        return pin;
    }

    // The share of the step after which the gap is zero, by Newton's rule from the step's end.
    double corrected(int j) const {
        return end_rate[j] > 0 ? std::clamp(1 - end[j] / end_rate[j], 0.1, 2.0) : 1;
    }
};
