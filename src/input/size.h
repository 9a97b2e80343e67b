#pragma once

#include "input/validate.h"
#include "model/case.h"

#include <string>

namespace whirl::input {

// What a case may ask for: numbers that no machine could go through are refused before it tries.

/// Largest number of anything that a case counts.
inline constexpr int largest_count = 1000000;

/// Balls or rings of one balancer.
inline constexpr int most_parts = 10000;

/// Counts that are refused on any machine: places on the shaft, parts of a balancer, points of a
/// map.
void check_counts(const model::Case &scene, const Check &check);

/// Bytes that a command takes for a case, at least: for the model by the number and the order of
/// its elements, for what it answers by the numbers that it keeps. From measured runs; other parts
/// of a run take more.
[[nodiscard]] double least_memory(const model::Case &scene, const std::string &command);

/// @param memory  of this machine, bytes
/// @param tree    the case as it was written
/// @throws model::BadInput where the command takes more: the entry that it follows from, and
/// numbers
void refuse_too_large(const model::Case &scene, const std::string &command, double memory,
                      const Node &tree);

} // namespace whirl::input
