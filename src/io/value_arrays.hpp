#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hexfield/base/error.hpp"
#include "hexfield/io/named_arrays.hpp"
#include "hexfield/mesh/tet_mesh.hpp"

/// Helpers between our containers and the arrays of a checkpoint.
namespace hexfield {

/// A vector of structures that are `columns` numbers of type T, seen as numbers.
template <class T, class S>
std::span<const T> as_numbers(const std::vector<S>& values, std::size_t columns) {
  static_assert(sizeof(S) % sizeof(T) == 0);
  return {reinterpret_cast<const T*>(values.data()), values.size() * columns};
}

template <class S, class T>
std::vector<S> from_numbers(std::span<const T> numbers, std::size_t columns) {
  std::vector<S> values(numbers.size() / columns);
  if (!values.empty()) std::memcpy(static_cast<void*>(values.data()), numbers.data(), numbers.size_bytes());
  return values;
}

inline void require_same(bool holds, const std::string& what) {
  if (!holds) throw Error(ExitCode::bad_input, fmt::format("The checkpoint contradicts itself: {}.", what));
}

inline void require_ids(std::span<const std::int32_t> ids, std::int64_t lowest, std::size_t end,
                        const std::string& what) {
  for (std::int32_t id : ids) {
    require_same(id >= lowest && id < static_cast<std::int64_t>(end), fmt::format("{} {} is out of range", what, id));
  }
}

/// Rows (ids of the key..., value) of a map from vertex ids to integers.
template <std::size_t N>
std::vector<std::int32_t> rows_of(const std::map<std::array<VertexId, N>, int>& entries) {
  std::vector<std::int32_t> rows;
  rows.reserve(entries.size() * (N + 1));
  for (const auto& [key, value] : entries) {
    for (VertexId v : key) rows.push_back(v.value);
    rows.push_back(value);
  }
  return rows;
}

template <std::size_t N>
std::map<std::array<VertexId, N>, int> map_of(std::span<const std::int32_t> rows) {
  std::map<std::array<VertexId, N>, int> entries;
  for (std::size_t r = 0; r + N < rows.size(); r += N + 1) {
    std::array<VertexId, N> key;
    for (std::size_t k = 0; k < N; ++k) key[k] = VertexId(rows[r + k]);
    entries.emplace_hint(entries.end(), key, rows[r + N]);
  }
  return entries;
}

/// Names of groups as lines "dimension colour name" with newlines and backslashes escaped.
std::string names_text(const std::map<std::pair<int, int>, std::string>& names);
std::map<std::pair<int, int>, std::string> names_from_text(const std::string& text);

}  // namespace hexfield
