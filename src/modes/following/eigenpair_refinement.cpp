#include "modes/following/eigenpair_refinement.h"

#include "linalg/check.h"
#include "linalg/lanes/vector_products.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace whirl::modes {

std::complex<double> nearest_root(std::complex<double> xMx, std::complex<double> xDx,
                                  std::complex<double> xKx, std::complex<double> near) {
    const std::complex<double> root = std::sqrt(xDx * xDx - 4.0 * xMx * xKx);
    // Both without cancellation.
    const std::complex<double> q =
        -(xDx + (std::real(std::conj(xDx) * root) >= 0 ? root : -root)) / 2.0;
    const std::complex<double> first = q / xMx;
    const std::complex<double> second = xKx / q;
    return std::norm(first - near) <= std::norm(second - near) ? first : second;
}

void EigenpairRefinement::load(const std::vector<Task> &tasks, std::size_t first) {
    std::array<const Eigen::VectorXcd *, linalg::lanes> vectors{};
    for (std::size_t lane = 0; lane < linalg::lanes; ++lane) {
        const Task &task = tasks[std::min(first + lane, tasks.size() - 1)];
        vectors[lane] = &task.pair->vector;
        _value.set(static_cast<int>(lane), task.pair->value);
        _speed[static_cast<int>(lane)] = task.speed;
    }
    linalg::set(_x, vectors);
    multiply();
}

/// Products and forms x^T A x of the vectors; the values become Rayleigh quotients.
void EigenpairRefinement::multiply() {
    _problem.multiply(_x, _speed, _of);
    for (linalg::Complex4 *form : {&_xMx, &_xDx, &_xKx, &_xD1x, &_xK1x})
        *form = linalg::Complex4{};
    linalg::in_lanes([&]() __attribute__((always_inline)) {
        for (std::size_t k = 0; k < _x.size(); ++k) {
            linalg::add_product(_xMx, _x[k], _of.M[k]);
            linalg::add_product(_xDx, _x[k], _of.D[k]);
            linalg::add_product(_xKx, _x[k], _of.K[k]);
            linalg::add_product(_xD1x, _x[k], _of.D1[k]);
        }
        for (std::size_t k = 0; k < _of.K1.size(); ++k)
            linalg::add_product(_xK1x, _x[k], _of.K1[k]);
    });
    for (int lane = 0; lane < linalg::lanes; ++lane)
        _value.set(lane,
                   nearest_root(_xMx.at(lane), _xDx.at(lane), _xKx.at(lane), _value.at(lane)));
}

/// Values and errors of the pairs in the lanes.
void EigenpairRefinement::settle(const std::vector<Task> &tasks, std::size_t first) {
    _residual.resize(_x.size());
    linalg::in_lanes([&]() __attribute__((always_inline)) {
        linalg::Complex4 square;
        linalg::set_product(square, _value, _value);
        for (std::size_t k = 0; k < _x.size(); ++k) {
            linalg::Complex4 sum = _of.K[k];
            linalg::add_product(sum, _value, _of.D[k]);
            linalg::add_product(sum, square, _of.M[k]);
            _residual[k] = sum;
        }
    });
    std::array<double, linalg::lanes> sizes{};
    for (int lane = 0; lane < linalg::lanes; ++lane)
        sizes[static_cast<std::size_t>(lane)] = std::abs(_value.at(lane));
    const std::array<double, linalg::lanes> energies = _problem.energies(_residual, sizes);
    for (std::size_t i = first; i < std::min(first + linalg::lanes, tasks.size()); ++i) {
        const auto lane = static_cast<int>(i - first);
        const Complex l = _value.at(lane);
        const double derivative = std::abs(l * (2.0 * l * _xMx.at(lane) + _xDx.at(lane)));
        SymmetricPair &pair = *tasks[i].pair;
        pair.value = l;
        pair.error = derivative > 0 && std::isfinite(derivative)
                         ? energies[i - first] / (derivative * std::min(1.0, tasks[i].distance))
                         : std::numeric_limits<double>::infinity();
    }
}

/// The vectors are those of Q(l)^-1 Q'(l) x.
void EigenpairRefinement::inverse_step() {
    _factors = &_problem.factorize(_value, _speed);
    linalg::in_lanes([&]() __attribute__((always_inline)) {
        const linalg::Complex4 twice{2 * _value.re, 2 * _value.im};
        for (std::size_t k = 0; k < _x.size(); ++k) {
            _x[k] = _of.D[k];
            linalg::add_product(_x[k], twice, _of.M[k]);
        }
    });
    _factors->solve(_x);
    linalg::Real4 scales{};
    for (const linalg::Complex4 &entry : _x) {
        const linalg::Real4 square = entry.re * entry.re + entry.im * entry.im;
        for (int lane = 0; lane < linalg::lanes; ++lane)
            scales[lane] = std::max(scales[lane], square[lane]);
    }
    for (int lane = 0; lane < linalg::lanes; ++lane)
        scales[lane] = 1 / std::sqrt(scales[lane]);
    for (linalg::Complex4 &entry : _x) {
        entry.re *= scales;
        entry.im *= scales;
    }
    multiply();
}

/// How the vectors change with the speed: Q(l) x' = -(l' Q'(l) + l D1 + K1) x, with the factors of
/// the last step. They are those of a value beside l: what that adds lies along x.
linalg::Vector4 EigenpairRefinement::turns() const {
    linalg::Complex4 rate;
    for (int lane = 0; lane < linalg::lanes; ++lane) {
        const Complex l = _value.at(lane);
        rate.set(lane,
                 (l * _xD1x.at(lane) + _xK1x.at(lane)) / (2.0 * l * _xMx.at(lane) + _xDx.at(lane)));
    }
    linalg::Vector4 out(_x.size());
    linalg::in_lanes([&]() __attribute__((always_inline)) {
        const linalg::Complex4 twice{2 * _value.re, 2 * _value.im};
        for (std::size_t k = 0; k < _x.size(); ++k) {
            linalg::Complex4 slope = _of.D[k];
            linalg::add_product(slope, twice, _of.M[k]);
            linalg::set_product(out[k], rate, slope);
            linalg::subtract_product(out[k], _value, _of.D1[k]);
        }
        for (std::size_t k = 0; k < _of.K1.size(); ++k) {
            out[k].re -= _of.K1[k].re;
            out[k].im -= _of.K1[k].im;
        }
    });
    _factors->solve(out);
    return out;
}

/// What is known of pairs in lanes, whose vectors get the length and the sign that carry on those
/// they have (guesses).
/// @returns what the vectors in the lanes were multiplied by
linalg::Complex4 EigenpairRefinement::fill(const InLanes &pairs) const {
    linalg::Complex4 scales{};
    linalg::Real4 sizes{};
    for (int lane = 0; lane < linalg::lanes; ++lane) {
        SymmetricPair *pair = pairs[static_cast<std::size_t>(lane)];
        if (pair == nullptr)
            continue;
        const Complex l = pair->value;
        pair->derivative = 2.0 * l * _xMx.at(lane) + _xDx.at(lane);
        pair->rate = -(l * _xD1x.at(lane) + _xK1x.at(lane)) / pair->derivative;
        sizes[lane] = std::abs(l);
        const Complex scale = std::sqrt(l / pair->derivative);
        scales.set(lane, std::isfinite(std::abs(scale)) && scale != 0.0 ? scale : 1);
    }
    std::array<Eigen::VectorXcd, linalg::lanes> vectors = linalg::vectors_of(_x, scales);
    const std::array<double, linalg::lanes> forms = _problem.absolute_forms(sizes, _speed, _x);
    for (std::size_t lane = 0; lane < linalg::lanes; ++lane) {
        if (pairs[lane] == nullptr)
            continue;
        SymmetricPair &pair = *pairs[lane];
        const auto place = static_cast<int>(lane);
        pair.rounding = std::numeric_limits<double>::epsilon() * forms[lane] /
                        std::abs(pair.value * pair.derivative);
        pair.derivative *= scales.at(place) * scales.at(place);
        if (linalg::dot(pair.vector, vectors[lane]).real() < 0) {
            scales.set(place, -scales.at(place));
            vectors[lane] = -vectors[lane];
        }
        pair.vector = std::move(vectors[lane]);
        pair.refined = true;
    }
    return scales;
}

/// That x^T Q'(l) x / l does not change tells the part along x.
void EigenpairRefinement::fill_turns(const InLanes &pairs, const linalg::Complex4 &scales) const {
    const linalg::Vector4 turned = turns();
    linalg::Complex4 zMx{};
    linalg::Complex4 zDx{};
    linalg::in_lanes([&]() __attribute__((always_inline)) {
        for (std::size_t k = 0; k < turned.size(); ++k) {
            linalg::add_product(zMx, turned[k], _of.M[k]);
            linalg::add_product(zDx, turned[k], _of.D[k]);
        }
    });
    std::array<Eigen::VectorXcd, linalg::lanes> vectors = linalg::vectors_of(turned, scales);
    for (int lane = 0; lane < linalg::lanes; ++lane) {
        SymmetricPair *pair = pairs[static_cast<std::size_t>(lane)];
        if (pair == nullptr)
            continue;
        const Complex l = pair->value;
        const Complex slope = 2.0 * l * zMx.at(lane) + zDx.at(lane);
        const Complex change = scales.at(lane) * scales.at(lane) *
                               (2.0 * slope + _xD1x.at(lane) - _xDx.at(lane) * pair->rate / l);
        pair->turn = std::move(vectors[static_cast<std::size_t>(lane)]);
        linalg::add_multiple(-change / (2.0 * pair->derivative), pair->vector, pair->turn);
    }
}

/// A step of those pairs in the lanes that are not good enough yet; what is not settled then is
/// added to those open.
/// @param at_last  no other step follows
void EigenpairRefinement::advance(const std::vector<Task> &tasks, std::size_t first, bool at_last,
                                  std::vector<Task> &open) try {
    const std::size_t count = std::min(tasks.size() - first, std::size_t{linalg::lanes});
    std::array<SymmetricPair, linalg::lanes> now;
    std::vector<Task> there;
    for (std::size_t i = 0; i < count; ++i) {
        there.push_back(tasks[first + i]);
        there.back().pair = &now[i];
    }
    inverse_step();
    settle(there, 0);
    InLanes settling{};
    for (std::size_t i = 0; i < count; ++i) {
        SymmetricPair &pair = *tasks[first + i].pair;
        if (pair.error <= there[i].enough)
            continue;
        const double last = std::exchange(pair.error, now[i].error);
        const bool rounding =
            pair.error <= std::max(there[i].enough, 1e-13) && (pair.error > 0.1 * last || at_last);
        pair.value = now[i].value;
        if (pair.error <= there[i].enough || rounding) {
            pair.solved = true;
            settling[i] = &pair;
            continue;
        }
        Eigen::VectorXcd vector = linalg::vector_of(_x, static_cast<int>(i));
        const Complex along = linalg::dot(vector, pair.vector);
        if (along != 0.0) // carries on the sign
            vector *= along / std::abs(along);
        pair.vector = std::move(vector);
        open.push_back(tasks[first + i]);
    }
    if (settling != InLanes{})
        fill_turns(settling, fill(settling));
} catch (const linalg::SolverError &) {
    // A pivot that happens to be zero: what is not settled is not refined.
}

/// Guesses that have moved by so much are not good as they are: their errors need not be looked at.
bool EigenpairRefinement::rough(const std::vector<Task> &tasks, std::size_t first) {
    constexpr double moved = 2e-6; // values are of second order in what vectors are off
    const auto begin = tasks.begin() + static_cast<std::ptrdiff_t>(first);
    const auto count = std::min(tasks.size() - first, std::size_t{linalg::lanes});
    return std::all_of(begin, begin + static_cast<std::ptrdiff_t>(count), [](const Task &task) {
        return task.enough <= enough_error && task.pair->doubt > moved &&
               std::isfinite(task.pair->doubt);
    });
}

/// Fills the pairs in the lanes that are good as they are, and adds the others to those open.
/// @param looked_at  their errors are known
void EigenpairRefinement::take_good(const std::vector<Task> &tasks, std::size_t first,
                                    bool looked_at, std::vector<Task> &open) {
    InLanes good{};
    for (std::size_t i = first; i < std::min(first + linalg::lanes, tasks.size()); ++i) {
        SymmetricPair &pair = *tasks[i].pair;
        pair.solved = false;
        pair.refined = false;
        pair.turn.resize(0);
        if (!looked_at)
            pair.error = std::numeric_limits<double>::infinity();
        if (pair.error <= tasks[i].enough)
            good[i - first] = &pair;
        else
            open.push_back(tasks[i]);
    }
    if (good != InLanes{})
        (void)fill(good);
}

/// Those of like size together: they are measured by the same energy.
void EigenpairRefinement::sort(std::vector<Task> &tasks) {
    const auto exponent = [](const Task &task) {
        return std::ilogb(std::norm(task.pair->value)) / 2;
    };
    std::stable_sort(tasks.begin(), tasks.end(),
                     [&](const Task &a, const Task &b) { return exponent(a) < exponent(b); });
}

void EigenpairRefinement::take_good(std::vector<Task> tasks) {
    sort(tasks);
    std::vector<Task> others;
    for (std::size_t first = 0; first < tasks.size(); first += linalg::lanes) {
        load(tasks, first);
        settle(tasks, first);
        take_good(tasks, first, true, others);
    }
}

void EigenpairRefinement::refine(std::vector<Task> tasks) {
    constexpr int most_steps = 8;
    sort(tasks);
    std::vector<Task> open;
    for (std::size_t first = 0; first < tasks.size(); first += linalg::lanes) {
        load(tasks, first);
        const bool looked_at = !rough(tasks, first);
        if (looked_at)
            settle(tasks, first);
        std::vector<Task> here;
        take_good(tasks, first, looked_at, here);
        if (here.size() <= linalg::lanes / 2) // together with others
            open.insert(open.end(), here.begin(), here.end());
        else
            advance(tasks, first, false, open);
    }
    for (int step = 1; step <= most_steps && !open.empty(); ++step) {
        const std::vector<Task> now = std::exchange(open, {});
        for (std::size_t first = 0; first < now.size(); first += linalg::lanes) {
            load(now, first);
            advance(now, first, step == most_steps, open);
        }
    }
}

SymmetricPair EigenpairRefinement::nearest(double speed, Complex value) {
    SymmetricPair pair;
    pair.value = value * (1 + 1e-6);
    pair.vector = Eigen::VectorXcd::Ones(_problem.size());
    const std::vector<Task> one{{&pair, speed, 1, enough_error}};
    load(one, 0);
    for (int step = 0; step < 3; ++step) {
        for (int lane = 0; lane < linalg::lanes; ++lane)
            _value.set(lane, pair.value); // not that of a vector that is no mode yet
        inverse_step();
    }
    pair.value = value;
    pair.vector = linalg::vector_of(_x, 0);
    refine(one); // whether it has settled is seen by who asked
    return pair;
}

double distance_from_others(const std::vector<SymmetricPair> &pairs, std::size_t i) {
    double first = 1;
    double second = 1;
    for (std::size_t j = 0; j < pairs.size(); ++j) {
        if (j == i)
            continue;
        const double away = std::norm(pairs[j].value - pairs[i].value);
        if (away < first * std::norm(pairs[i].value)) {
            second = first;
            first = away / std::norm(pairs[i].value);
        } else {
            second = std::min(second, away / std::norm(pairs[i].value));
        }
    }
    return std::sqrt(first * second);
}

std::vector<double> enough_errors(const std::vector<SymmetricPair> &pairs, int slowest) {
    std::vector<double> out(pairs.size(), enough_error);
    if (slowest >= std::ssize(pairs))
        return out;
    std::vector<double> frequencies;
    for (const SymmetricPair &pair : pairs)
        if (pair.whirls())
            frequencies.push_back(std::abs(pair.value.imag()));
    if (slowest >= std::ssize(frequencies))
        return out;
    // Values of guesses: the next one may be among the slowest.
    std::sort(frequencies.begin(), frequencies.end());
    const double last = 1.001 * frequencies[static_cast<std::size_t>(slowest - 1)];
    for (std::size_t i = 0; i < pairs.size(); ++i)
        if (std::abs(pairs[i].value.imag()) > last)
            out[i] = counted_error;
    return out;
}

} // namespace whirl::modes
