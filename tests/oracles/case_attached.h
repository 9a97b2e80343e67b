#pragma once

#include "oracles/case_rotor.h"
#include "oracles/case_values.h"

namespace whirl::oracles {

// Supports and balancers as a case file has them.

[[nodiscard]] Support support_of(const toml::table &table);
[[nodiscard]] Mount mount_of(const toml::table &table);
/// By columns named kxx, ..., cyy.
[[nodiscard]] SpeedTable speed_table_of(const std::string &file, double z);
[[nodiscard]] Balancer balancer_of(const toml::table &table);

} // namespace whirl::oracles
