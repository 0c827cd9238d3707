// Presses by Tsitouras 5(4) in lanes, each with its own step: the motion, and nothing else.
//
// As the solver has them: the norm of the error, the control of steps, onsets that steps end on,
// openings that steps end behind, rates latched at onsets. Left out: the ledger of energy, sections,
// samples, and looks for contacts that a step would hide. Sines of a stage are those of the step's
// start, turned on by a small angle, and are renewed every 256 attempts; or, where EXACT says so,
// those of any angle.
#include "gaps.hpp"
#include "tsitouras.hpp"

constexpr double AFTER_MANY = 1e-9, CAUTIOUS = 0.3, LATE = 0.95, BEHIND = 1.02;
constexpr double TURN = 0.2;  // rad in a step at most, for `turned`
constexpr bool EXACT = SINES;
constexpr int MOST_LANDINGS = 12, RENEWED = 256;

template <int W> class Integrator {
    using V = typename Lanes<W>::Real;
    using M = typename Lanes<W>::Mask;

    const Mechanism mechanism;
    const double fastest_crank;
    Clearance<V> clearance{};
    Mode<V> mode[PINS]{};
    Gap<V> before[PINS]{}, after[PINS]{};
    Direction<V> base[ANGLES]{}, now[ANGLES]{};
    V y[STATES]{}, arrived[STATES]{}, k[STAGES][STATES]{}, weight[STATES]{};
    V time{}, step{}, tried{}, next_step{}, end{}, largest_step{}, full{};
    V memory{}, new_memory{}, fastest{};
    V impact_rate[PINS]{}, attempts{}, accepted{}, active{};
    M accept{}, lands{};
    Press *press[W]{}, *waiting, *last;
    int landing[W], landings[W];  // pin whose onset the step is to end on, and attempts at that
    int running = 0;

    void slopes(const V &since, const V *state, V *out, Gap<V> *gap) {
        for (int i = 0; i < 3; ++i)
            now[i] = EXACT ? towards<W>(state[1 + i]) : turned<V>(base[i], state[1 + i] - y[1 + i]);
        for (int j = 0; j < PINS; ++j) {
            const Crank &crank = mechanism.crank[j];
            now[3 + j] = EXACT ? towards<W>(crank.angle + crank.speed * (time + since))
                               : turned<V>(base[3 + j], crank.speed * since);
        }
        for (int i = 0; i < COORDINATES; ++i)
            out[i] = state[COORDINATES + i];
        accelerations<V>(mechanism, state, now, clearance, mode, out + COORDINATES, gap);
    }

    template <int S> __attribute__((always_inline)) void stage() {
        for (int i = 0; i < STATES; ++i) {
            V sum = A[S][0] * k[0][i];
            for (int s = 1; s < S; ++s)
                sum += A[S][s] * k[s][i];
            arrived[i] = y[i] + tried * sum;
        }
        slopes(NODE[S] * tried, arrived, k[S], after);
    }

    void renew(int lane) {
        for (int i = 0; i < ANGLES; ++i) {
            double angle;
            if (i < 3)
                angle = get(y[1 + i], lane);
            else
                angle = mechanism.crank[i - 3].angle + mechanism.crank[i - 3].speed * get(time, lane);
            set(base[i].cosine, lane, std::cos(angle));
            set(base[i].sine, lane, std::sin(angle));
        }
    }

    void load(int lane) {
        press[lane] = nullptr;
        aim(lane, NO_PIN);
        landings[lane] = 0;
        while (waiting != last && waiting->time >= waiting->end)
            ++waiting;
        set(active, lane, waiting != last ? 1.0 : 0.0);
        if (waiting == last) return;
        Press &p = *(press[lane] = waiting++);
        ++running;
        V *const given[] = {
            &clearance.radial,   &clearance.bearing_radius,  &clearance.stiffness, &clearance.hysteresis,
            &clearance.friction, &clearance.static_velocity, &clearance.ramp};
        for (int i = 0; i < 7; ++i)
            set(*given[i], lane, (&p.radial)[i]);
        for (int i = 0; i < STATES; ++i) {
            set(y[i], lane, p.y[i]);
            set(weight[i], lane, p.weight[i]);
        }
        V *const scalars[] = {&time,         &step, &memory,   &fastest, &end,
                              &largest_step, &full, &attempts, &accepted};
        const double values[] = {p.time,         p.step, p.memory,   p.fastest, p.end,
                                 p.largest_step, p.full, p.attempts, p.accepted};
        for (int i = 0; i < 9; ++i)
            set(*scalars[i], lane, values[i]);
        for (int j = 0; j < PINS; ++j) {
            set(mode[j].contact, lane, p.contact[j]);
            set(impact_rate[j], lane, p.impact_rate[j]);
            set(mode[j].inverse_rate, lane, 1.0 / p.impact_rate[j]);
        }
        renew(lane);
        V first[STATES];
        Gap<V> gap[PINS];
        slopes(V{}, y, first, gap);
        for (int i = 0; i < STATES; ++i)
            set(k[0][i], lane, get(first[i], lane));
        for (int j = 0; j < PINS; ++j) {
            set(before[j].depth, lane, get(gap[j].depth, lane));
            set(before[j].rate, lane, get(gap[j].rate, lane));
        }
    }

    void unload(int lane) {
        if (press[lane] == nullptr) return;
        Press &p = *press[lane];
        for (int i = 0; i < STATES; ++i)
            p.y[i] = get(y[i], lane);
        for (int j = 0; j < PINS; ++j) {
            p.contact[j] = get(mode[j].contact, lane);
            p.impact_rate[j] = get(impact_rate[j], lane);
        }
        p.time = get(time, lane), p.step = get(step, lane);
        p.memory = get(memory, lane), p.fastest = get(fastest, lane);
        p.attempts = get(attempts, lane), p.accepted = get(accepted, lane);
        press[lane] = nullptr;
        --running;
    }

    void aim(int lane, int target) {
        landing[lane] = target;
        set(lands, lane, target != NO_PIN);
    }

    void refuse(int lane, double share, int target) {
        set(accept, lane, false);
        set(next_step, lane, share * get(tried, lane));
        aim(lane, target);
    }

    Gaps gaps(int lane) const {
        Gaps found;
        const double h = get(tried, lane);
        for (int j = 0; j < PINS; ++j) {
            found.start[j] = get(before[j].depth, lane);
            found.start_rate[j] = get(before[j].rate, lane) * h;
            found.end[j] = get(after[j].depth, lane);
            found.end_rate[j] = get(after[j].rate, lane) * h;
            found.touches[j] = get(mode[j].contact, lane) > 0;
        }
        return found;
    }

    // Between a lane's attempt and its commit: a step that was rejected, or that gaps open or close in.
    void attend(int lane) {
        const Gaps found = gaps(lane);
        if (!get(accept, lane)) {
            aim(lane, NO_PIN);
            if (found.just_closed()) set(next_step, lane, CAUTIOUS * get(next_step, lane));
            return;
        }
        const double opening = found.opening();
        if (opening < LATE) {
            landings[lane] = 0;
            return refuse(lane, BEHIND * opening, NO_PIN);
        }
        double share;
        const int target = landing[lane];
        int pin = found.onset(target, share);
        if (target != NO_PIN && (pin == NO_PIN || pin == target)) {
            const double missed = std::fabs(found.end[target]);
            if (missed <= (landings[lane] > MOST_LANDINGS ? AFTER_MANY : LANDED)) return;
            if (found.end[target] < 0 && found.end_rate[target] <= 0) return aim(lane, NO_PIN);
            pin = target;
            share = found.corrected(target);
        }
        if (pin == NO_PIN) return;
        ++landings[lane];
        refuse(lane, landings[lane] % MOST_LANDINGS ? share : 0.25, pin);
    }

    // Once a lane's step is taken: contacts that begin and end, and the end of a run.
    void settle(int lane) {
        for (int j = 0; j < PINS; ++j) {
            const double depth = get(before[j].depth, lane), rate = get(before[j].rate, lane);
            if (j == landing[lane]) {
                const double latched = std::max(rate, press[lane]->impact_floor);
                set(mode[j].contact, lane, 1.0);
                set(impact_rate[j], lane, latched);
                set(mode[j].inverse_rate, lane, 1.0 / latched);
                set(step, lane, std::min(get(step, lane), press[lane]->restart / latched));
                ++press[lane]->onsets;
            } else if (depth <= 0 && (depth < -LANDED || rate < 0)) {
                set(mode[j].contact, lane, 0.0);
            }
        }
        aim(lane, NO_PIN);
        landings[lane] = 0;
        if (get(time, lane) >= get(end, lane)) {
            unload(lane);
            load(lane);
        }
    }

    // The error of the step in tolerances, and by it the next step.
    void judge() {
        V squared = V{} + 1e-16;
        const V scale = tried * (full / fastest), one = V{} + 1.0;
        for (int i = 0; i < STATES; ++i) {
            V sum = ERROR[0] * k[0][i];
            for (int s = 1; s < STAGES; ++s)
                sum += ERROR[s] * k[s][i];
            const V error = sum * (scale * weight[i]);
            squared += error * error;
        }
        accept = squared < 1.0 + 1e-12;
        new_memory = 0.5 * coarse_log2<W>(squared);
        const double again = 1.0 / 5, smooth = again - 0.75 * PROPORTIONAL;
        const V onwards = PROPORTIONAL * memory - smooth * new_memory;
        V factor = SAFETY * coarse_exp2<W>(accept ? onwards : -again * new_memory);
        factor = accept ? factor : smaller(factor, one);
        factor = factor > LARGEST_CUT ? smaller(factor, one * LARGEST_GROWTH) : one * LARGEST_CUT;
        next_step = tried * factor;
    }

    void take() {
        const M taken = accept & (active > 0.0);
        const V zero{};
        V most = fastest;
        for (int i = COORDINATES; i < STATES; ++i)
            most = larger(most, magnitude(arrived[i]) * weight[i]);
        fastest = taken ? smaller(most, full) : fastest;
        memory = taken ? new_memory : memory;
        time = taken ? time + tried : time;
        accepted += taken ? zero + 1.0 : zero;
        for (int i = 0; i < STATES; ++i) {
            y[i] = taken ? arrived[i] : y[i];
            k[0][i] = taken ? k[STAGES - 1][i] : k[0][i];
        }
        for (int j = 0; j < PINS; ++j) {
            before[j].depth = taken ? after[j].depth : before[j].depth;
            before[j].rate = taken ? after[j].rate : before[j].rate;
        }
        for (int i = 0; i < ANGLES; ++i) {
            base[i].cosine = taken ? now[i].cosine : base[i].cosine;
            base[i].sine = taken ? now[i].sine : base[i].sine;
        }
        step = next_step;
        attempts += active;
    }

    // Lanes that want attention before and after the commit.
    M unsettled() {
        M wanted = (!accept) | lands | (time + tried >= end);
        for (int j = 0; j < PINS; ++j)
            wanted = wanted | (mode[j].contact > 0.0 ? after[j].depth <= 0.0 : after[j].depth > 0.0);
        return wanted & (active > 0.0);
    }

  public:
    Integrator(const Mechanism &given, Press *presses, long count)
        : mechanism(with_inertia(given)),
          fastest_crank(std::max(std::fabs(given.crank[0].speed), std::fabs(given.crank[1].speed))),
          waiting(presses), last(presses + count) {}

    long run(long budget) {
        for (int lane = 0; lane < W; ++lane)
            load(lane);
        long made = 0;
        for (; running > 0 && made < budget; ++made) {
            const V fast = larger(larger(magnitude(y[5]), magnitude(y[6])), magnitude(y[7]));
            const V longest = smaller(largest_step, TURN / larger(fast, V{} + fastest_crank));
            tried = smaller(smaller(step, longest), end - time) * active;
            stage<1>();
            stage<2>();
            stage<3>();
            stage<4>();
            stage<5>();
            stage<6>();
            judge();
            const M wanted = unsettled();
            const bool attention = any(wanted);
            for (int lane = 0; attention && lane < W; ++lane)
                if (get(wanted, lane)) attend(lane);
            take();
            for (int lane = 0; attention && lane < W; ++lane)
                if (get(wanted, lane) && get(accept, lane)) settle(lane);
            if (made % RENEWED == RENEWED - 1)
                for (int lane = 0; lane < W; ++lane)
                    renew(lane);
        }
        for (int lane = 0; lane < W; ++lane)
            unload(lane);
        return made;
    }
};

// Compute presses until all have ended, or `budget` attempts of all lanes; return how many were made.
extern "C" long run(const Mechanism *mechanism, Press *presses, long count, long budget) {
    return Integrator<WIDTH>(*mechanism, presses, count).run(budget);
}
