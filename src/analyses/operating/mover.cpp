#include "analyses/operating/mover.h"

#include "forced/response_peaks.h"
#include "forced/response_places.h"
#include "modes/orbits.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace whirl::analyses {

Moving &Moving::operator+=(const Moving &other) {
    const double sum = amplitude + other.amplitude;
    if (std::isfinite(sum) && sum > 0)
        error = (error * amplitude + other.error * other.amplitude) / sum;
    else if (std::isfinite(sum))
        error = std::max(error, other.error);
    else // without limit: nothing to be wrong about
        error = forced::no_value;
    amplitude = sum;
    velocity += other.velocity;
    velocity_rms += other.velocity_rms;
    acceleration += other.acceleration;
    if (std::isnan(phase))
        phase = other.phase;
    return *this;
}

Moving Moving::times(double factor) const {
    Moving out = *this;
    for (double *one : {&out.amplitude, &out.velocity, &out.velocity_rms, &out.acceleration})
        *one *= factor;
    return out;
}

Moving Moving::without_limit() {
    return {forced::unlimited, forced::unlimited, forced::unlimited,
            forced::unlimited, forced::no_value,  forced::no_value};
}

namespace {

class ForcedMover : public Mover {
  public:
    ForcedMover(const assembly::Discretization &d, results::Form form, forced::Drive drive,
                MotionAt motion_at)
        : Mover(drive.imbalances() || drive.unbalanced), _d(d), _form(form),
          _drive(std::move(drive)), _motion_at(std::move(motion_at)), _quick(d, form, _drive) {}

    bool solve(double speed, bool with_error) override {
        _speed = speed;
        _full.reset();
        // What rounding could have decided is judged by the finer elements too.
        if (!with_error && forced::solves(_quick, speed) &&
            _quick.rounding() <= forced::resonance_rounding)
            return true;
        if (const auto solved = _motion_at(speed))
            _full.emplace(*solved);
        return _full.has_value();
    }

    [[nodiscard]] Moving of(const forced::Quantity &quantity) const override {
        const forced::Phasor u = (_full ? _full->motion : _quick).of(quantity);
        const double frequency = std::abs(_drive.frequency_at(_speed));
        Moving out;
        out.amplitude = modes::ellipse_of(u.x, u.y).major;
        out.velocity = frequency * out.amplitude;
        out.velocity_rms = out.velocity / std::numbers::sqrt2;
        out.acceleration = frequency * out.velocity;
        if (out.amplitude > 0)
            out.phase = std::arg(u.x);
        if (_full)
            out.error = _full->error(
                [&](const forced::ResponseError &finer) { return finer.of_quantity(quantity, u); });
        return out;
    }

    [[nodiscard]] Look look(double from, double to,
                            const std::vector<forced::Quantity> &quantities) const override {
        Look out;
        const forced::CertifiedPeaks found =
            forced::response_peaks(_d, _form, quantities, from, to, {_drive, false});
        for (const auto &sample : found.curve)
            out.speeds.push_back(sample.speed);
        for (const forced::Peak &peak : found.peaks) {
            out.speeds.push_back(peak.speed);
            if (std::isinf(peak.value))
                out.without_limit.emplace_back(peak.quantity, peak.speed);
        }
        return out;
    }

  private:
    const assembly::Discretization &_d;
    results::Form _form;
    forced::Drive _drive;
    MotionAt _motion_at;
    forced::ForcedMotion _quick;
    std::optional<SolvedMotion> _full;
    double _speed = 0;
};

} // namespace

std::unique_ptr<Mover> forced_mover(const assembly::Discretization &d, results::Form form,
                                    forced::Drive drive, MotionAt motion_at) {
    return std::make_unique<ForcedMover>(d, form, std::move(drive), std::move(motion_at));
}

} // namespace whirl::analyses
