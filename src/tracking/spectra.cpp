#include "tracking/spectra.h"

#include "model/errors.h"
#include "process/processes.h"
#include "process/progress.h"
#include "results/whirl.h"

#include <cstring>
#include <string>
#include <type_traits>

namespace whirl::tracking {

namespace {

/// Plain values one after the other: all processes are one program on like machines.
class Written {
  public:
    template <class T> void values(const T *first, std::size_t count) {
        const auto *bytes = reinterpret_cast<const char *>(first);
        _data.insert(_data.end(), bytes, bytes + count * sizeof(T));
    }
    template <class Vector> void list(const Vector &vector) {
        const auto size = static_cast<std::size_t>(vector.size());
        values(&size, 1);
        values(vector.data(), size);
    }
    std::size_t count(std::size_t size) {
        values(&size, 1);
        return size;
    }

    [[nodiscard]] const std::vector<char> &data() const { return _data; }

  private:
    std::vector<char> _data;
};

/// The same values, read in the same order.
class Read {
  public:
    explicit Read(std::vector<char> data) : _data(std::move(data)) {}

    template <class T> void values(T *first, std::size_t count) {
        std::memcpy(first, _data.data() + _next, count * sizeof(T));
        _next += count * sizeof(T);
    }
    template <class Vector> void list(Vector &vector) {
        using Size = decltype(vector.size());
        vector.resize(static_cast<Size>(count(0)));
        values(vector.data(), static_cast<std::size_t>(vector.size()));
    }
    std::size_t count(std::size_t size) {
        values(&size, 1);
        return size;
    }

  private:
    std::vector<char> _data;
    std::size_t _next = 0;
};

/// Writes a spectrum, or reads it.
template <class Bytes, class Spectrum> void pass(Bytes &bytes, Spectrum &spectrum) {
    const auto each = [&bytes](auto &...values) { (bytes.values(&values, 1), ...); };
    const auto lists = [&bytes](auto &...vectors) { (bytes.list(vectors), ...); };
    each(spectrum.speed, spectrum.complete_radius);
    lists(spectrum.overdamped, spectrum.growing);
    const std::size_t count = bytes.count(spectrum.modes.size());
    if constexpr (!std::is_const_v<Spectrum>)
        spectrum.modes.resize(count);
    for (auto &mode : spectrum.modes) {
        each(mode.eigenvalue, mode.whirl, mode.forward_fraction, mode.residual, mode.rounding,
             mode.confirmed, mode.frequency_rotating, mode.other_frequency, mode.rotating_value);
        lists(mode.shape, mode.left, mode.rotating_vector, mode.rotating_left);
    }
}

/// Every process learns whether one of them failed, and throws the same.
void agree_on_failure(std::string failure) {
    const std::vector<char> mine(failure.begin(), failure.end());
    failure.clear();
    for (const std::vector<char> &part : process::gather(mine))
        if (failure.empty())
            failure.assign(part.begin(), part.end());
    std::vector<char> all(failure.begin(), failure.end());
    process::broadcast(all);
    if (!all.empty())
        throw model::AnalysisFailure(std::string(all.begin(), all.end()));
}

} // namespace

std::vector<modes::Spectrum> spectra_alone(const modes::SpectrumSolver &solver,
                                           const std::vector<double> &speeds, int wanted,
                                           bool follow) {
    if (follow)
        solver.follow(speeds, wanted);
    std::vector<modes::Spectrum> spectra;
    for (const double speed : speeds) {
        spectra.push_back(solver.at(speed, wanted));
        process::report_progress(static_cast<double>(spectra.size()) /
                                 static_cast<double>(speeds.size()));
    }
    return spectra;
}

std::vector<modes::Spectrum> spectra_at(const modes::SpectrumSolver &solver,
                                        const std::vector<double> &speeds, int wanted,
                                        bool follow) {
    const auto processes = static_cast<std::size_t>(process::process_count());
    if (processes == 1)
        return spectra_alone(solver, speeds, wanted, follow);
    Written mine;
    std::string failure;
    try {
        std::vector<double> own;
        for (auto i = static_cast<std::size_t>(process::process_rank()); i < speeds.size();
             i += processes)
            own.push_back(speeds[i]);
        for (const modes::Spectrum &spectrum : spectra_alone(solver, own, wanted, follow))
            pass(mine, spectrum);
    } catch (const model::AnalysisFailure &error) {
        failure = error.what();
    }
    agree_on_failure(failure);
    std::vector<modes::Spectrum> spectra;
    std::vector<Read> parts;
    for (std::vector<char> &part : process::gather(mine.data()))
        parts.emplace_back(std::move(part));
    if (!parts.empty())
        for (std::size_t i = 0; i < speeds.size(); ++i)
            pass(parts[i % processes], spectra.emplace_back());
    return spectra;
}

} // namespace whirl::tracking
