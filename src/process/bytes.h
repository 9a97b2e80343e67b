#pragma once

#include "process/processes.h"

#include <cstring>
#include <iterator>
#include <type_traits>
#include <utility>
#include <vector>

namespace whirl::process {

/// Appends and reads plain values: all processes are one program on like machines.
class Bytes {
  public:
    explicit Bytes(std::vector<char> data = {}) : _data(std::move(data)) {}

    template <class T> void put(const T &value) { put(&value, 1); }
    /// A list with its length: std::vector, std::string, a vector of Eigen's.
    template <class List> void put_list(const List &list) {
        put(static_cast<std::size_t>(list.size()));
        put(list.data(), static_cast<std::size_t>(list.size()));
    }

    template <class T> T get() {
        T value{};
        get(&value, 1);
        return value;
    }
    template <class List> void get_list(List &list) {
        const auto count = get<std::size_t>();
        list.resize(static_cast<decltype(list.size())>(count));
        get(list.data(), count);
    }
    [[nodiscard]] const std::vector<char> &data() const { return _data; }
    [[nodiscard]] bool at_end() const { return _next == _data.size(); }

  private:
    std::vector<char> _data;
    std::size_t _next = 0;

    template <class T> static constexpr bool is_plain = std::is_trivially_copyable_v<T>;

    template <class T> void put(const T *values, std::size_t count) {
        static_assert(is_plain<T>);
        const auto *first = reinterpret_cast<const char *>(values);
        _data.insert(_data.end(), first, first + count * sizeof(T));
    }
    template <class T> void get(T *values, std::size_t count) {
        static_assert(is_plain<T>);
        if (count > 0) // an empty list has no address to copy to
            std::memcpy(values, _data.data() + _next, count * sizeof(T));
        _next += count * sizeof(T);
    }
};

/// Those of every process, in order of rank, on process 0 (empty elsewhere).
[[nodiscard]] inline std::vector<Bytes> gather(const Bytes &mine) {
    std::vector<std::vector<char>> parts = gather(mine.data());
    return {std::make_move_iterator(parts.begin()), std::make_move_iterator(parts.end())};
}

} // namespace whirl::process
