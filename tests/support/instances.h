#pragma once

// For the precompiled header: what many tests include, and what many use of the templates of
// libraries, which are then instantiated once. Never called.

#include "analyses/balance.h"
#include "analyses/campbell.h"
#include "analyses/critical.h"
#include "analyses/response.h"
#include "analyses/simulate.h"
#include "analyses/stability.h"
#include "assembly/discretization.h"
#include "assembly/rotating_system.h"
#include "assembly/system.h"
#include "balancers/arrangement.h"
#include "balancers/linear_element.h"
#include "linalg/harmonic_solve.h"
#include "linalg/matrix.h"
#include "modes/biorthogonal.h"
#include "modes/spectrum.h"
#include "oracles/continuum.h"
#include "stability/band_finder.h"
#include "support/balancer_scenes.h"
#include "support/common_instances.h"
#include "support/rotating_scenes.h"
#include "support/scenes.h"
#include "support/test_rotors.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

namespace whirl::tests::instances {

template <class Json> void json(std::ifstream &file, const std::string &text) {
    const Json one = Json::parse(text);
    Json other = Json::parse(file);
    EXPECT_EQ(one, other);
    EXPECT_EQ(one, text);
    EXPECT_EQ(one.at("key"), "text");
    EXPECT_GT(one, 0);
    EXPECT_NE(one, other);
    if (one == "text" || one.contains("key") || one.value("key", 1.0) > 0 || one.is_array())
        other["key"] = one.at("key").template get<double>();
    other = one.at(0).template get<std::string>();
    other = one.at(0).template get<std::vector<double>>();
    other = one.at(0).template get<std::vector<std::string>>();
    other = one.at(0).template get<bool>();
    other = one.at(0).template get<int>();
    other = Json::array({text, 1, 1.0, true});
    other = {{"key", text}, {"other", 1.0}};
    other.push_back(one.dump());
    for (const auto &[key, value] : one.items())
        other[key] = value;
    for (const Json &item : one)
        other.push_back(item);
}

inline void json(std::ifstream &file, const std::string &text) {
    json<nlohmann::json>(file, text);
    json<nlohmann::ordered_json>(file, text);
}

inline std::string regular(const std::string &text) {
    const std::regex expression("a+");
    std::smatch found;
    if (std::regex_match(text, found, expression) || std::regex_search(text, found, expression) ||
        std::regex_search(text, expression) || std::regex_match(text, expression))
        return found[1];
    std::string out;
    for (std::sregex_iterator i(text.begin(), text.end(), expression), end; i != end; ++i)
        out += i->str() + (*i)[1].str();
    return std::regex_replace(text, expression, out);
}

} // namespace whirl::tests::instances
