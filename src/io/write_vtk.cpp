#include <fmt/format.h>

#include "hexfield/io/debug_vtk.hpp"
#include "legacy_vtk.hpp"
#include "writers.hpp"

namespace hexfield::io {

LegacyVtkWriter::LegacyVtkWriter(BufferedWriter& out, bool binary) : out_(out), binary_(binary) {
  out_.print("# vtk DataFile Version 2.0\nhexfield\n{}\nDATASET UNSTRUCTURED_GRID\n", binary ? "BINARY" : "ASCII");
}

void LegacyVtkWriter::points(std::span<const Vec3> points) {
  out_.print("POINTS {} double\n", points.size());
  for (const Vec3& p : points)
    if (binary_)
      for (int k = 0; k < 3; ++k) big_endian(p[k]);
    else
      out_.print("{} {} {}\n", p.x(), p.y(), p.z());
  end_of_data();
}

void LegacyVtkWriter::begin_cells(std::size_t cells, std::size_t vertices) {
  out_.print("CELLS {} {}\n", cells, cells + vertices);
}

void LegacyVtkWriter::cell(std::span<const std::int32_t> vertices) {
  if (binary_) {
    big_endian(static_cast<std::int32_t>(vertices.size()));
    for (std::int32_t v : vertices) big_endian(v);
    return;
  }
  out_.print("{}", vertices.size());
  for (std::int32_t v : vertices) out_.print(" {}", v);
  out_.write("\n");
}

void LegacyVtkWriter::value(std::int32_t value) {
  if (binary_)
    big_endian(value);
  else
    out_.print("{}\n", value);
}

void LegacyVtkWriter::begin_types(std::size_t cells) {
  end_of_data();
  out_.print("CELL_TYPES {}\n", cells);
}

void LegacyVtkWriter::begin_cell_data(std::size_t cells) {
  end_of_data();
  out_.print("CELL_DATA {}\n", cells);
}

void LegacyVtkWriter::begin_scalar(const std::string& name) {
  out_.print("SCALARS {} int 1\nLOOKUP_TABLE default\n", name);
}

void LegacyVtkWriter::end_of_data() {
  if (binary_) out_.write("\n");
}

template <class T>
void LegacyVtkWriter::big_endian(T value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  if constexpr (!big_endian_machine)
    for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
  out_.write({bytes, sizeof(T)});
}

void write_legacy_vtk(BufferedWriter& out, const CellSoup& soup, bool binary) {
  LegacyVtkWriter writer(out, binary);
  writer.points(soup.points);
  std::size_t vertices = 0;
  for (const CellBlock& b : soup.blocks) vertices += b.vertices.size();
  writer.begin_cells(soup.num_cells(), vertices);
  for (std::size_t s = 0; s < num_shapes; ++s)
    for (std::size_t c = 0; c < soup.blocks[s].size(); ++c) writer.cell(corners(soup, s, c));
  writer.begin_types(soup.num_cells());
  for (std::size_t s = 0; s < num_shapes; ++s)
    for (std::size_t c = 0; c < soup.blocks[s].size(); ++c) writer.value(shape_vtk[s]);
  writer.begin_cell_data(soup.num_cells());
  writer.begin_scalar("CellEntityIds");
  for (const CellBlock& b : soup.blocks)
    for (int colour : b.colours) writer.value(colour);
  writer.end_of_data();
}

}  // namespace hexfield::io

namespace hexfield {

void write_vtk_debug(const std::filesystem::path& file, std::span<const Vec3> points, std::span<const DebugCell> cells,
                     std::span<const DebugScalar> scalars) {
  for (const DebugScalar& scalar : scalars)
    require(scalar.values.size() == cells.size(), "A debug scalar needs one value per cell.");
  io::write_file(file, [&](io::BufferedWriter& out) {
    io::LegacyVtkWriter writer(out, false);
    writer.points(points);
    std::size_t vertices = 0;
    for (const DebugCell& cell : cells) vertices += cell.size();
    writer.begin_cells(cells.size(), vertices);
    for (const DebugCell& cell : cells) {
      require(cell.size() >= 1 && cell.size() <= 4, "A debug cell has 1 to 4 vertices.");
      for (std::int32_t v : cell)
        require(v >= 0 && static_cast<std::size_t>(v) < points.size(), "A debug cell names a point that is not there.");
      writer.cell(cell);
    }
    static constexpr std::array<std::int32_t, 5> type_of_size = {0, 1, 3, 5, 10};
    writer.begin_types(cells.size());
    for (const DebugCell& cell : cells) writer.value(type_of_size[cell.size()]);
    if (!scalars.empty()) writer.begin_cell_data(cells.size());
    for (const DebugScalar& scalar : scalars) {
      writer.begin_scalar(scalar.name);
      for (int value : scalar.values) writer.value(value);
    }
  });
}

}  // namespace hexfield
