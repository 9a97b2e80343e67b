#include "tracking/spectra.h"

#include "model/errors.h"
#include "process/processes.h"
#include "process/progress.h"
#include "results/whirl.h"

#include <cstring>
#include <string>

namespace whirl::tracking {

namespace {

/// Appends and reads plain values: all processes are one program on like machines.
class Bytes {
  public:
    explicit Bytes(std::vector<char> data = {}) : _data(std::move(data)) {}

    template <class T> void put(const T *values, std::size_t count) {
        const auto *first = reinterpret_cast<const char *>(values);
        _data.insert(_data.end(), first, first + count * sizeof(T));
    }
    template <class T> void put(const T &value) { put(&value, 1); }

    template <class T> void get(T *values, std::size_t count) {
        std::memcpy(values, _data.data() + _next, count * sizeof(T));
        _next += count * sizeof(T);
    }
    template <class T> T get() {
        T value{};
        get(&value, 1);
        return value;
    }
    [[nodiscard]] const std::vector<char> &data() const { return _data; }
    [[nodiscard]] bool at_end() const { return _next == _data.size(); }

  private:
    std::vector<char> _data;
    std::size_t _next = 0;
};

void put(Bytes &bytes, const modes::Spectrum &spectrum) {
    bytes.put(spectrum.speed);
    bytes.put(spectrum.complete_radius);
    bytes.put(spectrum.overdamped.size());
    bytes.put(spectrum.overdamped.data(), spectrum.overdamped.size());
    bytes.put(spectrum.modes.size());
    bytes.put(spectrum.growing.size());
    bytes.put(spectrum.growing.data(), spectrum.growing.size());
    for (const modes::WhirlMode &mode : spectrum.modes) {
        bytes.put(mode.eigenvalue);
        bytes.put(mode.whirl);
        bytes.put(mode.forward_fraction);
        bytes.put(mode.residual);
        bytes.put(mode.rounding);
        bytes.put(mode.confirmed);
        bytes.put(mode.frequency_rotating);
        bytes.put(mode.other_frequency);
        bytes.put(mode.rotating_value);
        for (const Eigen::VectorXcd *vector :
             {&mode.shape, &mode.left, &mode.rotating_vector, &mode.rotating_left}) {
            bytes.put(vector->size());
            bytes.put(vector->data(), static_cast<std::size_t>(vector->size()));
        }
    }
}

modes::Spectrum get_spectrum(Bytes &bytes) {
    modes::Spectrum spectrum;
    spectrum.speed = bytes.get<double>();
    spectrum.complete_radius = bytes.get<double>();
    spectrum.overdamped.resize(bytes.get<std::size_t>());
    bytes.get(spectrum.overdamped.data(), spectrum.overdamped.size());
    spectrum.modes.resize(bytes.get<std::size_t>());
    spectrum.growing.resize(bytes.get<std::size_t>());
    bytes.get(spectrum.growing.data(), spectrum.growing.size());
    for (modes::WhirlMode &mode : spectrum.modes) {
        mode.eigenvalue = bytes.get<std::complex<double>>();
        mode.whirl = bytes.get<results::Whirl>();
        mode.forward_fraction = bytes.get<double>();
        mode.residual = bytes.get<double>();
        mode.rounding = bytes.get<double>();
        mode.confirmed = bytes.get<bool>();
        mode.frequency_rotating = bytes.get<double>();
        mode.other_frequency = bytes.get<std::optional<double>>();
        mode.rotating_value = bytes.get<std::complex<double>>();
        for (Eigen::VectorXcd *vector :
             {&mode.shape, &mode.left, &mode.rotating_vector, &mode.rotating_left}) {
            vector->resize(bytes.get<Eigen::Index>());
            bytes.get(vector->data(), static_cast<std::size_t>(vector->size()));
        }
    }
    return spectrum;
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
    Bytes mine;
    std::string failure;
    try {
        std::vector<double> own;
        for (auto i = static_cast<std::size_t>(process::process_rank()); i < speeds.size();
             i += processes)
            own.push_back(speeds[i]);
        for (const modes::Spectrum &spectrum : spectra_alone(solver, own, wanted, follow))
            put(mine, spectrum);
    } catch (const model::AnalysisFailure &error) {
        failure = error.what();
    }
    agree_on_failure(failure);
    std::vector<modes::Spectrum> spectra;
    std::vector<Bytes> parts;
    for (std::vector<char> &part : process::gather(mine.data()))
        parts.emplace_back(std::move(part));
    if (!parts.empty())
        for (std::size_t i = 0; i < speeds.size(); ++i)
            spectra.push_back(get_spectrum(parts[i % processes]));
    return spectra;
}

} // namespace whirl::tracking
