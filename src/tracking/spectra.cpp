#include "tracking/spectra.h"

#include "model/errors.h"
#include "process/bytes.h"
#include "process/parallel.h"
#include "process/progress.h"
#include "results/whirl.h"

#include <string>

namespace whirl::tracking {

namespace {

using process::Bytes;

void put(Bytes &bytes, const modes::Spectrum &spectrum) {
    bytes.put(spectrum.speed);
    bytes.put(spectrum.complete_radius);
    bytes.put_list(spectrum.overdamped);
    bytes.put_list(spectrum.growing);
    bytes.put(spectrum.modes.size());
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
             {&mode.shape, &mode.left, &mode.rotating_vector, &mode.rotating_left})
            bytes.put_list(*vector);
    }
}

modes::Spectrum get_spectrum(Bytes &bytes) {
    modes::Spectrum spectrum;
    spectrum.speed = bytes.get<double>();
    spectrum.complete_radius = bytes.get<double>();
    bytes.get_list(spectrum.overdamped);
    bytes.get_list(spectrum.growing);
    spectrum.modes.resize(bytes.get<std::size_t>());
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
             {&mode.shape, &mode.left, &mode.rotating_vector, &mode.rotating_left})
            bytes.get_list(*vector);
    }
    return spectrum;
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
    process::agree_on_failure(failure);
    std::vector<modes::Spectrum> spectra;
    std::vector<Bytes> parts = process::gather(mine);
    if (!parts.empty())
        for (std::size_t i = 0; i < speeds.size(); ++i)
            spectra.push_back(get_spectrum(parts[i % processes]));
    return spectra;
}

} // namespace whirl::tracking
