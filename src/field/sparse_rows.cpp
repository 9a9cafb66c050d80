#include "sparse_rows.hpp"

#include "hexfield/base/parallel.hpp"

namespace hexfield {
namespace {

constexpr std::size_t grain = 4096;

struct Piece {
  std::vector<std::int32_t> columns;
  std::vector<double> values;
  std::vector<std::int64_t> sizes;  // of the rows
};

Piece multiply(const SparseRows& a, const SparseRows& b, std::size_t begin, std::size_t end) {
  Piece piece;
  std::vector<double> sum(b.width, 0.0);
  std::vector<char> seen(b.width, 0);
  std::vector<std::int32_t> touched;
  for (std::size_t i = begin; i < end; ++i) {
    touched.clear();
    for (std::size_t k = a.begin(i); k < a.end(i); ++k)
      for (std::size_t l = b.begin(a.column(k)); l < b.end(a.column(k)); ++l) {
        const std::size_t c = b.column(l);
        if (seen[c] == 0) touched.push_back(b.columns[l]), seen[c] = 1;
        sum[c] += a.values[k] * b.values[l];
      }
    std::sort(touched.begin(), touched.end());
    for (std::int32_t t : touched) {
      const auto c = static_cast<std::size_t>(t);
      piece.columns.push_back(t);
      piece.values.push_back(sum[c]);
      sum[c] = 0;
      seen[c] = 0;
    }
    piece.sizes.push_back(static_cast<std::int64_t>(touched.size()));
  }
  return piece;
}

}  // namespace

SparseRows transposed(const SparseRows& a) {
  SparseRows t;
  t.width = a.rows();
  t.offsets.assign(a.width + 1, 0);
  for (std::int32_t c : a.columns) ++t.offsets[static_cast<std::size_t>(c) + 1];
  for (std::size_t c = 0; c < a.width; ++c) t.offsets[c + 1] += t.offsets[c];
  t.columns.resize(a.columns.size());
  t.values.resize(a.values.size());
  std::vector<std::int64_t> next(t.offsets.begin(), t.offsets.end() - 1);
  for (std::size_t i = 0; i < a.rows(); ++i)
    for (std::size_t k = a.begin(i); k < a.end(i); ++k) {
      const auto at = static_cast<std::size_t>(next[a.column(k)]++);
      t.columns[at] = static_cast<std::int32_t>(i);
      t.values[at] = a.values[k];
    }
  return t;
}

SparseRows product(const SparseRows& a, const SparseRows& b) {
  // Few large pieces: each has its own dense row of sums.
  const std::size_t rows_of_piece = std::max(grain, a.rows() / 16 + 1);
  std::vector<Piece> pieces((a.rows() + rows_of_piece - 1) / rows_of_piece);
  parallel_for(a.rows(), rows_of_piece,
               [&](std::size_t begin, std::size_t end) { pieces[begin / rows_of_piece] = multiply(a, b, begin, end); });
  SparseRows c;
  c.width = b.width;
  c.offsets.reserve(a.rows() + 1);
  for (Piece& p : pieces) {
    c.columns.insert(c.columns.end(), p.columns.begin(), p.columns.end());
    c.values.insert(c.values.end(), p.values.begin(), p.values.end());
    for (std::int64_t n : p.sizes) c.offsets.push_back(c.offsets.back() + n);
    p = Piece();
  }
  return c;
}

}  // namespace hexfield
