#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace hexfield {

/// Sparse matrix in compressed rows, columns ascending in each row.
struct SparseRows {
  std::size_t width = 0;  ///< number of columns
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> columns;
  std::vector<double> values;

  std::size_t rows() const { return offsets.size() - 1; }
  std::size_t begin(std::size_t row) const { return static_cast<std::size_t>(offsets[row]); }
  std::size_t end(std::size_t row) const { return static_cast<std::size_t>(offsets[row + 1]); }
  std::size_t column(std::size_t k) const { return static_cast<std::size_t>(columns[k]); }
  /// Position of an entry that exists.
  std::size_t find(std::size_t row, std::int32_t wanted) const {
    const auto first = columns.begin() + offsets[row];
    return static_cast<std::size_t>(std::lower_bound(first, columns.begin() + offsets[row + 1], wanted) -
                                    columns.begin());
  }
};

SparseRows transposed(const SparseRows& a);
/// Rows are computed in parallel; every entry is summed in the order of the entries of `a`.
SparseRows product(const SparseRows& a, const SparseRows& b);

}  // namespace hexfield
