#pragma once

#include <string>
#include <vector>

namespace whirl::cli {

/// Columns of text, as wide as their widest entry: the first to the left, the others to the right.
class Table {
  public:
    explicit Table(std::vector<std::string> header) { _rows.push_back(std::move(header)); }
    void add(std::vector<std::string> row) { _rows.push_back(std::move(row)); }
    [[nodiscard]] bool empty() const { return _rows.size() == 1; }
    [[nodiscard]] std::string text() const;

  private:
    std::vector<std::vector<std::string>> _rows;
};

} // namespace whirl::cli
