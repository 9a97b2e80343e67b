#include "tracking/spectra.h"

#include "model/errors.h"
#include "process/bytes.h"
#include "process/parallel.h"
#include "process/progress.h"
#include "results/whirl.h"

#include <string>
#include <type_traits>

namespace whirl::tracking {

namespace {

using process::Bytes;

/// All of a spectrum but how many modes it has.
/// @param value  of each plain value
/// @param list   of each list
template <class Spectrum, class Value, class List>
void each_part(Spectrum &spectrum, const Value &value, const List &list) {
    const auto values = [&value](auto &...of) { (value(of), ...); };
    const auto lists = [&list](auto &...of) { (list(of), ...); };
    values(spectrum.speed, spectrum.complete_radius, spectrum.relaxation);
    lists(spectrum.overdamped, spectrum.growing);
    for (auto &mode : spectrum.modes) {
        values(mode.eigenvalue, mode.whirl, mode.forward_fraction, mode.plane, mode.residual,
               mode.rounding, mode.confirmed, mode.frequency_rotating, mode.other_frequency,
               mode.rotating_value);
        lists(mode.shape, mode.left, mode.rotating_vector);
    }
}

void put(Bytes &bytes, const modes::Spectrum &spectrum) {
    bytes.put(spectrum.modes.size());
    each_part(
        spectrum, [&bytes](const auto &value) { bytes.put(value); },
        [&bytes](const auto &list) { bytes.put_list(list); });
}

void get(Bytes &bytes, modes::Spectrum &spectrum) {
    spectrum.modes.resize(bytes.get<std::size_t>());
    each_part(
        spectrum,
        [&bytes](auto &value) { value = bytes.get<std::remove_cvref_t<decltype(value)>>(); },
        [&bytes](auto &list) { bytes.get_list(list); });
}

/// @param sweep  what is asked for of all processes
/// @param own    of this one
std::vector<modes::Spectrum> spectra_of(const modes::SpectrumSolver &solver,
                                        const std::vector<double> &sweep,
                                        const std::vector<double> &own, int wanted, bool follow) {
    solver.expect(sweep, wanted);
    if (follow)
        solver.follow(sweep, wanted);
    std::vector<modes::Spectrum> spectra;
    for (const double speed : own) {
        spectra.push_back(solver.at(speed, wanted));
        process::report_progress(static_cast<double>(spectra.size()) /
                                 static_cast<double>(own.size()));
    }
    return spectra;
}

} // namespace

std::vector<modes::Spectrum> spectra_alone(const modes::SpectrumSolver &solver,
                                           const std::vector<double> &speeds, int wanted,
                                           bool follow) {
    return spectra_of(solver, speeds, speeds, wanted, follow);
}

std::vector<modes::Spectrum> spectra_at(const modes::SpectrumSolver &solver,
                                        const std::vector<double> &speeds, int wanted,
                                        bool follow) {
    const auto processes = static_cast<std::size_t>(process::process_count());
    if (processes == 1)
        return spectra_alone(solver, speeds, wanted, follow);
    const auto rank = static_cast<std::size_t>(process::process_rank());
    std::vector<modes::Spectrum> spectra;
    Bytes mine;
    bool shared = true;
    std::string failure;
    try {
        shared = !solver.carries_over(follow);
        std::vector<double> own;
        for (std::size_t i = rank; shared && i < speeds.size(); i += processes)
            own.push_back(speeds[i]);
        if (shared)
            for (const modes::Spectrum &spectrum : spectra_of(solver, speeds, own, wanted, follow))
                put(mine, spectrum);
        else if (rank == 0)
            spectra = spectra_alone(solver, speeds, wanted, follow);
    } catch (const model::AnalysisFailure &error) {
        failure = error.what();
    }
    process::agree_on_failure(failure);
    if (!shared)
        return spectra;
    std::vector<Bytes> parts = process::gather(mine);
    if (!parts.empty())
        for (std::size_t i = 0; i < speeds.size(); ++i)
            get(parts[i % processes], spectra.emplace_back());
    return spectra;
}

} // namespace whirl::tracking
