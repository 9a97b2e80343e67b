#pragma once

#include <functional>
#include <string>
#include <vector>

namespace whirl::benchmarks {

/// A straightforward dense route to the same numbers: so many equal solves.
struct DenseRoute {
    std::function<void()> solve{}; ///< one of them, without assembly
    int solves = 0;
};

/// An analysis of the program whose time is measured: a call of the library, no pictures.
struct Workload {
    std::string name;
    std::string what; ///< in words, without a comma
    std::function<void()> run;
    int parts = 1;      ///< equal parts of the run, of which the time of one is wanted
    DenseRoute dense{}; ///< without solves: there is none
};

/// All of them, in the order of the table.
/// @param folder  of the cases
[[nodiscard]] std::vector<Workload> all_workloads(const std::string &folder);

/// The unit of time: all eigenvalues and right eigenvectors of a full real 392 x 392 matrix, the
/// state matrix of the rotor with three discs on 48 classical elements.
[[nodiscard]] std::function<void()> unit_of_time(const std::string &folder);

} // namespace whirl::benchmarks
