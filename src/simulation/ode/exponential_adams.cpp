#include "simulation/ode/exponential_adams.h"

#include "linalg/check.h"
#include "simulation/ode/modal_parts.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace whirl::simulation {

namespace {

/// Of two steps that differ by less the weights are the same.
constexpr double same_step = 1e-9;
/// Sets of weights kept: more lengths than that a motion seldom returns to.
constexpr std::size_t most_weights = 32;
/// Of what is allowed, where the length of the steps is chosen.
constexpr double error_aimed_at = 0.3;
/// Longer steps at a stop are worth the differences that they cost.
constexpr double worth_a_change = 1.3;
/// From here on a fifth off the step is not enough.
constexpr double far_too_large = 5;
/// Steps between two looks at the neighbouring orders.
constexpr int order_every = 3;

} // namespace

ExponentialAdams::ExponentialAdams(OdeProblem stated)
    : OdeSolver(std::move(stated)), _half(problem().axes.count),
      _modes(linalg::whole_vectors(problem().axes.linear.eigenvalues.size())),
      _vectors(problem().axes.linear.vectors), _inverse(problem().axes.linear.inverse),
      _eigenvalues(parts_of(problem().axes.linear.eigenvalues, _modes)),
      _reach(adams_reach / problem().axes.linear.eigenvalues.cwiseAbs().maxCoeff()) {
    const TurningAxes &axes = problem().axes;
    const int size = problem().size;
    std::vector<bool> of_vectors(static_cast<std::size_t>(size), false);
    for (const int first : axes.first)
        std::fill_n(of_vectors.begin() + first, 2 * axes.count, true);
    for (int i = 0; i < size; ++i)
        if (!of_vectors[static_cast<std::size_t>(i)])
            _own.push_back(i);
    const Eigen::Index entries = 2 * _modes + static_cast<Eigen::Index>(_own.size());
    for (Point *point : {&_now, &_next, &_between}) {
        point->y.setZero(size);
        point->modal.setZero(2 * _modes);
        point->n.setZero(entries);
    }
    _differences.setZero(entries, kept);
    _past.setZero(entries, remembered);
    for (Eigen::VectorXd *n : {&_last, &_sum})
        n->setZero(entries);
    for (Eigen::VectorXd *y : {&_rates, &_allowed, &_error})
        y->setZero(size);
    _stack.setZero(linalg::whole_vectors(axes.linear.vectors.rows()), 2);
    _modal_sum.setZero(2 * _modes);
}

const ExponentialAdams::Weights &ExponentialAdams::weights_of(double h, double share,
                                                              std::list<Weights> &known) const {
    const auto found = std::ranges::find_if(
        known, [way = share * h](const Weights &w) { return std::abs(w.h / way - 1) < same_step; });
    if (found != known.end()) {
        known.splice(known.begin(), known, found);
        return known.front();
    }
    const AdamsWeights made = adams_weights(problem().axes.linear.eigenvalues, h, kept, share);
    known.push_front({made.h, parts_of(made.growth, _modes),
                      Eigen::MatrixXd(2 * _modes, made.modal.cols()), made.own});
    for (Eigen::Index j = 0; j < made.modal.cols(); ++j)
        known.front().modal.col(j) = parts_of(made.modal.col(j), _modes);
    if (known.size() > most_weights)
        known.pop_back();
    return known.front();
}

void ExponentialAdams::compose(const Eigen::VectorXd &modal, Eigen::VectorXd &y) {
    _vectors(modal.data(), modal.data() + _modes, _stack.col(0).data(), _stack.col(1).data());
    for (std::size_t i = 0; i < problem().axes.first.size(); ++i) {
        const auto at = static_cast<Eigen::Index>(i) * _half;
        y.segment(problem().axes.first[i], _half) = _stack.col(0).segment(at, _half);
        y.segment(problem().axes.first[i] + _half, _half) = _stack.col(1).segment(at, _half);
    }
}

/// The modal coordinates of the vectors of y, or of its rates.
void ExponentialAdams::decompose(const Eigen::VectorXd &y, double *modal) {
    for (std::size_t i = 0; i < problem().axes.first.size(); ++i) {
        const auto place = static_cast<Eigen::Index>(i) * _half;
        _stack.col(0).segment(place, _half) = y.segment(problem().axes.first[i], _half);
        _stack.col(1).segment(place, _half) = y.segment(problem().axes.first[i] + _half, _half);
    }
    _inverse(_stack.col(0).data(), _stack.col(1).data(), modal, modal + _modes);
}

/// @returns whether all rates are numbers.
bool ExponentialAdams::evaluate(Point &at) {
    ++_counts.rates;
    problem().rates_in_axes(0, at.y.data(), _rates.data());
    if (!_rates.allFinite())
        return false;
    double *n = at.n.data();
    decompose(_rates, n);
    linalg::in_lanes([&]() __attribute__((always_inline)) {
        add_products<-1>(_eigenvalues.data(), at.modal.data(), _modes, n);
    });
    double *own = n + 2 * _modes;
    for (const int i : _own)
        *own++ = _rates(i);
    return true;
}

void ExponentialAdams::start_in_axes(double t, const double *y, double /*step*/) {
    _t = _end = t;
    _now.y = Eigen::Map<const Eigen::VectorXd>(y, problem().size);
    decompose(_now.y, _now.modal.data());
    if (!evaluate(_now))
        throw linalg::SolverError("the motion grows beyond all numbers");
    _differences.col(0) = _now.n;
    _past.col(_newest) = _now.n;
    _order = _valid = _known = 1;
    _factor = 1;
    _left = 0;
    _twice = false;
    _last_step = 0;
    // So short that the rates bring a few times the error allowed; it soon doubles.
    problem().allowed_error(_now.y.data(), _allowed.data());
    Weights whole{0, {}, Eigen::MatrixXd::Zero(2 * _modes, 2), {0, 1}};
    whole.modal.col(1).head(_modes).setOnes();
    const double rate = norm(whole, 1, _now.n);
    _h = rate > 0 ? 4 / rate : HUGE_VAL;
}

/// Equal steps to the next stop, as long as the error allows.
void ExponentialAdams::aim(double end) {
    _end = end;
    const double way = end - _t;
    double wanted = _h;
    if (_factor < 1 || _factor > worth_a_change)
        wanted *= std::clamp(_factor, 0.8, _known > _order + 2 ? 2.0 : 1.0);
    wanted = std::min(wanted, _reach);
    const double parts = std::ceil(way / wanted - 1e-6);
    _left = std::max(1L, static_cast<long>(std::min(parts, 1e15)));
    change_step(way / static_cast<double>(_left));
}

/// The differences at steps twice as long, of values that are known.
void ExponentialAdams::double_step() {
    _known = (_known + 1) / 2;
    for (int i = 1; i < _known; ++i)
        _past.col(place(i)) = _past.col(place(2 * i));
    _valid = std::min(_known, kept);
    for (int i = 0; i < _valid; ++i)
        _differences.col(i) = _past.col(place(i));
    for (int j = 1; j < _valid; ++j)
        for (int i = _valid - 1; i >= j; --i)
            _differences.col(i) = _differences.col(i - 1) - _differences.col(i);
}

/// The differences of the polynomial through the last values, at steps of another length. Its
/// degree is no higher than the error needs, for it follows the errors of the values too; and lower
/// where it is continued beyond them.
void ExponentialAdams::rescale(double ratio) {
    const int count = std::min(_valid, _order + (ratio < 1 ? 2 : 1));
    _differences.leftCols(count) =
        (_differences.leftCols(count) * rescaled_differences(ratio, count)).eval();
    _valid = _known = count;
    for (int i = 0; i < count; ++i) {
        double binomial = 1;
        auto value = _past.col(place(i));
        value.setZero();
        for (int j = 0; j <= i; ++j) {
            value += binomial * _differences.col(j);
            binomial *= -static_cast<double>(i - j) / (j + 1);
        }
    }
}

void ExponentialAdams::change_step(double h) {
    const double ratio = h / _h;
    _h = h;
    if (std::abs(ratio - 1) > same_step && std::isfinite(ratio) && ratio > 0) {
        if (std::abs(ratio - 2) < same_step && _known >= 2 * _order - 1)
            double_step();
        else
            rescale(ratio);
    }
    (void)weights_of(h, 1, _weights);
}

void ExponentialAdams::advance(const Weights &w, int count, const Point &from, Point &to) {
    const auto own = std::ssize(_own);
    double *sum = _sum.data();
    linalg::in_lanes([&]() __attribute__((always_inline)) {
        for (Eigen::Index i = 0; i < _modes; i += linalg::lanes) {
            linalg::Complex4 modal;
            set_product(modal, four_at(w.growth.data() + i, _modes),
                        four_at(from.modal.data() + i, _modes));
            for (int j = 0; j < count; ++j)
                add_product(modal, four_at(w.modal.col(j).data() + i, _modes),
                            four_at(_differences.col(j).data() + i, _modes));
            std::memcpy(to.modal.data() + i, &modal.re, sizeof modal.re);
            std::memcpy(to.modal.data() + _modes + i, &modal.im, sizeof modal.im);
        }
        std::fill_n(sum, own, 0.0);
        for (int j = 0; j < count; ++j) {
            const double *column = _differences.col(j).data() + 2 * _modes;
            const double weight = w.own[static_cast<std::size_t>(j)];
            for (Eigen::Index i = 0; i < own; ++i)
                sum[i] += weight * column[i];
        }
    });
    for (const int i : _own)
        to.y(i) = from.y(i) + *sum++;
    compose(to.modal, to.y);
}

/// By the difference of order k that the predicted N makes.
void ExponentialAdams::correct() {
    const Weights &w = weights();
    linalg::in_lanes([&]() __attribute__((always_inline)) {
        double *last = _last.data();
        const Eigen::Index size = _last.size();
        std::copy_n(_next.n.data(), size, last);
        for (int j = 0; j < _order; ++j) {
            const double *column = _differences.col(j).data();
            for (Eigen::Index i = 0; i < size; ++i)
                last[i] -= column[i];
        }
        add_products<1>(w.modal.col(_order).data(), last, _modes, _next.modal.data());
    });
    const double *own = _last.data() + 2 * _modes;
    for (const int i : _own)
        _next.y(i) += w.own[static_cast<std::size_t>(_order)] * *own++;
    compose(_next.modal, _next.y);
}

/// What the last weight of an order makes of a difference, over the errors allowed, in the mean
/// square over the entries of y.
double ExponentialAdams::norm(const Weights &w, int order, const Eigen::VectorXd &difference) {
    _modal_sum.setZero();
    linalg::in_lanes([&]() __attribute__((always_inline)) {
        const double *high = w.modal.col(order).data();
        const double *low = w.modal.col(order - 1).data();
        add_products<1>(high, difference.data(), _modes, _modal_sum.data());
        add_products<-1>(low, difference.data(), _modes, _modal_sum.data());
    });
    compose(_modal_sum, _error);
    const auto k = static_cast<std::size_t>(order);
    const double *own = difference.data() + 2 * _modes;
    for (const int i : _own)
        _error(i) = (w.own[k] - w.own[k - 1]) * *own++;
    return std::sqrt((_error.array() / _allowed.array()).square().mean());
}

/// That of a step of this order (<= the present one), by the differences with the predicted N.
double ExponentialAdams::error(int order) {
    if (order == _order)
        return norm(weights(), order, _last);
    _sum = _last;
    for (int j = order; j < _order; ++j)
        _sum += _differences.col(j);
    return norm(weights(), order, _sum);
}

double ExponentialAdams::step_in_axes(double end) {
    if (_left == 0 || end != _end) {
        aim(end);
    } else if (_twice) {
        _left /= 2;
        change_step(2 * _h);
    }
    _twice = false;
    for (;;) {
        problem().allowed_error(_now.y.data(), _allowed.data());
        advance(weights(), _order, _now, _next);
        double size = HUGE_VAL;
        if (evaluate(_next)) {
            correct();
            size = error(_order);
            if (size <= 1 && evaluate(_next)) {
                accept(size);
                return _t;
            }
        }
        repeat(size);
    }
}

const double *ExponentialAdams::within_in_axes(double share) {
    advance(weights_of(_last_step, share, _within), std::min(_valid, _order + 1), _next, _between);
    return _between.y.data();
}

/// A shorter step: a little, half of it where the last one has been shortened already.
void ExponentialAdams::repeat(double error) {
    ++_counts.failed;
    if (_h < 32 * std::numeric_limits<double>::epsilon() * std::abs(_t) || _left > (1L << 60))
        throw linalg::SolverError("the steps become too short to go on");
    const bool again = _good < _order; // what was is no guide
    if (again)
        _order = (_order + 1) / 2;
    else if (std::isfinite(error) && _order > 1 && this->error(_order - 1) <= error)
        --_order;
    _good = 0;
    const double way = static_cast<double>(_left) * _h;
    _left = again || error > far_too_large ? 2 * _left : (5 * _left + 3) / 4;
    change_step(way / static_cast<double>(_left));
}

/// The differences with the new N; the first of the older ones becomes one more.
void ExponentialAdams::take_difference() {
    const int last = std::min(_valid, kept - 1);
    const Eigen::Index size = _next.n.size();
    double *difference = _sum.data();
    std::copy_n(_next.n.data(), size, difference);
    linalg::in_lanes([&]() __attribute__((always_inline)) {
        for (int j = 0; j <= last; ++j) {
            double *column = _differences.col(j).data();
            for (Eigen::Index i = 0; i < size; ++i) {
                const double before = column[i];
                column[i] = difference[i];
                difference[i] -= before;
            }
        }
    });
    _valid = last + 1;
    _newest = (_newest + 1) % remembered;
    _known = std::min(_known + 1, remembered);
    _past.col(_newest) = _next.n;
}

void ExponentialAdams::accept(double size) {
    ++_counts.steps;
    ++_good;
    const bool look = _order == 1 || _counts.steps % order_every == 0;
    const double lower = _order > 1 && look ? error(_order - 1) : HUGE_VAL;
    take_difference();
    std::swap(_now, _next);
    --_left;
    if (std::abs(_last_step / _h - 1) > same_step)
        _within.clear();
    _last_step = _h;
    _t = _left == 0 ? _end : _end - static_cast<double>(_left) * _h;
    choose_step(size);
    if (look && !_twice)
        choose_order(size, lower);
}

/// The next twice as long where the rest of the way is even.
void ExponentialAdams::choose_step(double error) {
    _factor = std::pow(error_aimed_at / std::max(error, 1e-30), 1.0 / (_order + 1));
    _twice =
        _factor >= 2 && _known >= 2 * _order - 1 && _left > 0 && _left % 2 == 0 && 2 * _h <= _reach;
}

/// Of this order, the one below and the one above that with the least error.
void ExponentialAdams::choose_order(double error, double lower) {
    if (lower <= error) {
        --_order;
        return;
    }
    if (_order == most || _valid < _order + 2)
        return;
    const int k = _order + 1;
    _sum = _differences.col(k);
    const double higher = norm(weights(), k, _sum);
    if (higher < (k == 2 ? error / 2 : error))
        _order = k;
}

} // namespace whirl::simulation
