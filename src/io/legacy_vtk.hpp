#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "buffered_writer.hpp"
#include "hexfield/base/geometry.hpp"
#include "scanner.hpp"

namespace hexfield::io {

/// Writes the parts of a legacy VTK 2.0 unstructured grid in their order: points, cells, types, cell scalars.
class LegacyVtkWriter {
 public:
  LegacyVtkWriter(BufferedWriter& out, bool binary);
  void points(std::span<const Vec3> points);
  /// `vertices`: total number of corners of all cells.
  void begin_cells(std::size_t cells, std::size_t vertices);
  void cell(std::span<const std::int32_t> vertices);
  void begin_types(std::size_t cells);
  void begin_cell_data(std::size_t cells);
  void begin_scalar(const std::string& name);
  /// A cell type or a scalar.
  void value(std::int32_t value);
  void end_of_data();

 private:
  template <class T>
  void big_endian(T value);

  BufferedWriter& out_;
  bool binary_;
};

}  // namespace hexfield::io
