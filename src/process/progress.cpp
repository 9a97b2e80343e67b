#include "process/progress.h"

#include <utility>

namespace whirl::process {

namespace {

std::function<void(double)> &listener() {
    static std::function<void(double)> one;
    return one;
}

} // namespace

void on_progress(std::function<void(double)> function) { listener() = std::move(function); }

void report_progress(double share) {
    if (listener())
        listener()(share);
}

} // namespace whirl::process
