#pragma once

#include "report/common/units.h"

namespace whirl::report {

/// Units of what is written while it lives; those before come back.
class WrittenIn {
  public:
    explicit WrittenIn(const model::OutputUnits &units) : _before(written_units()) {
        write_in(units);
    }
    ~WrittenIn() { write_in(_before); }
    WrittenIn(const WrittenIn &) = delete;
    WrittenIn &operator=(const WrittenIn &) = delete;
    WrittenIn(WrittenIn &&) = delete;
    WrittenIn &operator=(WrittenIn &&) = delete;

  private:
    model::OutputUnits _before;
};

} // namespace whirl::report
