#include "process/progress.h"

#include <utility>

namespace whirl::process {

namespace {

/// The part of the work that is being done, as shares of all of it.
struct Part {
    double from = 0, to = 1;
    model::Sentence doing;
};

ProgressListener &listener() {
    static ProgressListener one;
    return one;
}

Part &part() {
    static Part one;
    return one;
}

} // namespace

void on_progress(ProgressListener function) { listener() = std::move(function); }

Stage::Stage(const model::Sentence &doing, double from, double to)
    : _from(part().from), _to(part().to), _doing(part().doing) {
    part() = {_from + from * (_to - _from), _from + to * (_to - _from), doing};
    report_progress(0);
}

Stage::~Stage() { part() = {_from, _to, _doing}; }

void report_progress(double share) {
    const Part &now = part();
    if (listener())
        listener()(now.from + share * (now.to - now.from), now.doing);
}

} // namespace whirl::process
