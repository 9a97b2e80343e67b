#pragma once

// The precompiled header of all targets: headers of libraries that most sources include, and none
// that changes with the program; every source names what it needs all the same.

#include "eigen/decompositions.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <complex>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>
