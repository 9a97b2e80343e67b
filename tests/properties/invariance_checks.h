#pragma once

#include "model/case.h"
#include "properties/draw.h"
#include "results/campbell.h"
#include "results/critical.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace whirl::properties {

/// One scene with the answers everything is compared with, computed when first asked for.
class InvarianceScene {
  public:
    explicit InvarianceScene(int number);

    /// At one speed of its range.
    [[nodiscard]] const model::Case &scene() const { return _scene; }
    [[nodiscard]] const model::SpeedRange &range() const { return _range; }
    [[nodiscard]] Draw &draw() { return _draw; }
    const results::CampbellResult &campbell();
    const results::CriticalResult &critical();
    /// What it is made of, for messages.
    [[nodiscard]] std::string words() const;
    [[nodiscard]] bool tables() const { return _scene.rotor.bearings_depend_on_speed(); }
    /// Whether it takes a Hill series.
    [[nodiscard]] bool series() const;
    [[nodiscard]] bool turning_parts() const { return _scene.rotor.rotating_anisotropy(); }

  private:
    model::Case _scene;
    model::SpeedRange _range;
    Draw _draw;
    std::optional<results::CampbellResult> _campbell;
    std::optional<results::CriticalResult> _critical;
};

/// Something that must not change an answer.
struct Invariance {
    std::string name;
    /// nullopt: does not apply to this scene; empty: holds; else how it is broken.
    std::function<std::optional<std::string>(InvarianceScene &)> difference;
    bool long_running = false;
};

[[nodiscard]] const std::vector<Invariance> &invariances();

} // namespace whirl::properties
