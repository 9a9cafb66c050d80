#include <fmt/format.h>

#include <optional>

#include "readers.hpp"
#include "vtk_cells.hpp"

namespace hexfield::io {
namespace {

// Legacy VTK files as the VTK manual describes them ("VTK File Formats", simple legacy formats), and the
// OFFSETS / CONNECTIVITY cells of version 5.1.
class VtkReader {
 public:
  explicit VtkReader(Scanner in) : in_(std::move(in)), binary_(read_header()), arrays_(in_, binary_) {}

  CellSoup read() {
    soup_.file = in_.file();
    if (binary_) in_.name_places_by_byte();
    while (!in_.at_end()) read_section(lower(in_.token("a section")));
    if (!have_points_) in_.fail("there is no POINTS section");
    if (!have_cells_) in_.fail("there is no CELLS section");
    if (!have_types_) in_.fail("there is no CELL_TYPES section");
    add_vtk_cells(in_, cells_, soup_);
    return std::move(soup_);
  }

 private:
  bool read_header();
  void read_section(const std::string& section);
  void read_points();
  void read_cells();
  void read_types();
  void read_attribute(const std::string& kind);
  void read_scalars();
  void read_field();
  void read_metadata();
  void take_values(const std::string& name, std::int64_t components, std::int64_t n, VtkType type);
  std::int64_t multiplied(std::int64_t a, std::int64_t b);

  Scanner in_;
  bool binary_;
  VtkArrays arrays_;
  CellSoup soup_;
  VtkCells cells_;
  std::size_t colour_rank_ = SIZE_MAX;  // lower is better
  bool have_points_ = false, have_cells_ = false, have_types_ = false;
  enum class Of { dataset, cells, points } attributes_of_ = Of::dataset;
  std::int64_t num_attributes_ = 0;
};

bool VtkReader::read_header() {
  in_.line();
  in_.line();
  const std::string kind = lower(in_.token("ASCII or BINARY"));
  if (kind != "ascii" && kind != "binary") in_.fail(fmt::format("\"{}\" is neither ASCII nor BINARY", printable(kind)));
  if (lower(in_.token("DATASET")) != "dataset") in_.fail("DATASET is expected");
  const std::string_view set = in_.token("the kind of data set");
  if (lower(set) != "unstructured_grid")
    in_.fail(fmt::format("the data set is {}; only UNSTRUCTURED_GRID holds tets or hexes with tags", printable(set)));
  return kind == "binary";
}

void VtkReader::read_section(const std::string& section) {
  if (section == "points") return read_points();
  if (section == "cells") return read_cells();
  if (section == "cell_types") return read_types();
  if (section == "metadata") return read_metadata();
  if (section == "field") return read_field();
  if (section == "cell_data" || section == "point_data") {
    attributes_of_ = section == "cell_data" ? Of::cells : Of::points;
    num_attributes_ = in_.integer("the number of attributes");
    const auto expected =
        static_cast<std::int64_t>(attributes_of_ == Of::cells ? cells_.types.size() : soup_.points.size());
    if (num_attributes_ != expected)
      in_.fail(fmt::format("{} is {} but the file has {} of them", section == "cell_data" ? "CELL_DATA" : "POINT_DATA",
                           num_attributes_, expected));
    return;
  }
  read_attribute(section);
}

void VtkReader::read_points() {
  if (have_points_) in_.fail("there is a second POINTS section");
  const std::int64_t n = in_.integer("the number of points");
  const VtkType type = vtk_type(in_, in_.token("the type of the points"));
  in_.line();
  const auto values = arrays_.reals(multiplied(n, 3), type, "coordinates of points");
  soup_.points.resize(values.size() / 3);
  for (std::size_t i = 0; i < soup_.points.size(); ++i)
    soup_.points[i] = Vec3(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
  have_points_ = true;
}

void VtkReader::read_cells() {
  if (have_cells_) in_.fail("there is a second CELLS section");
  have_cells_ = true;
  const std::int64_t n = in_.integer("the number of cells");
  const std::int64_t size = in_.integer("the size of the cells");
  in_.line();
  if (n < 0 || size < 0) in_.fail(fmt::format("the number or size of the cells is negative ({}, {})", n, size));
  if (lower(in_.peek().substr(0, 7)) == "offsets") {
    in_.token("OFFSETS");
    const VtkType offset_type = vtk_type(in_, in_.token("the type of the offsets"));
    in_.line();
    cells_.offsets = arrays_.integers(n, offset_type, "offsets of cells");
    if (lower(in_.token("CONNECTIVITY")) != "connectivity") in_.fail("CONNECTIVITY is expected");
    const VtkType type = vtk_type(in_, in_.token("the type of the connectivity"));
    in_.line();
    cells_.connectivity = arrays_.integers(size, type, "vertices of cells");
    if (cells_.offsets.empty()) cells_.offsets.push_back(0);
    for (std::size_t i = 0; i < cells_.offsets.size(); ++i)
      if (cells_.offsets[i] < (i == 0 ? 0 : cells_.offsets[i - 1]) || cells_.offsets[i] > size)
        in_.fail(fmt::format("offset {} of the cells is {}, which does not lie between its neighbours", i,
                             cells_.offsets[i]));
    return;
  }
  const auto values = arrays_.integers(size, VtkType::i32, "vertices of cells");
  cells_.offsets = {0};
  std::size_t at = 0;
  for (std::int64_t c = 0; c < n; ++c) {
    if (at >= values.size() || values[at] < 0 || values[at] > static_cast<std::int64_t>(values.size() - at - 1))
      in_.fail(fmt::format("the list of cells ends inside cell {} of {}", c, n));
    const auto corners = static_cast<std::size_t>(values[at]);
    cells_.connectivity.insert(cells_.connectivity.end(), values.begin() + static_cast<std::ptrdiff_t>(at + 1),
                               values.begin() + static_cast<std::ptrdiff_t>(at + 1 + corners));
    cells_.offsets.push_back(static_cast<std::int64_t>(cells_.connectivity.size()));
    at += 1 + corners;
  }
  if (at != values.size())
    in_.fail(fmt::format("the {} cells take {} numbers but the header says {}", n, at, values.size()));
}

void VtkReader::read_types() {
  if (have_types_) in_.fail("there is a second CELL_TYPES section");
  have_types_ = true;
  const std::int64_t n = in_.integer("the number of cell types");
  in_.line();
  cells_.types = arrays_.integers(n, VtkType::i32, "types of cells");
}

void VtkReader::read_attribute(const std::string& kind) {
  if (kind == "scalars") return read_scalars();
  const auto is = [&](const char* name) { return kind == name; };
  const std::string name(in_.token("the name of an attribute"));
  if (is("lookup_table")) {
    const std::int64_t n = in_.integer("the size of a lookup table");
    in_.line();
    return arrays_.skip(multiplied(n, 4), VtkType::u8, "a lookup table");
  }
  if (is("color_scalars")) {
    const std::int64_t components = in_.integer("the number of components");
    in_.line();
    return arrays_.skip(multiplied(num_attributes_, components), VtkType::u8, "colour scalars");
  }
  std::int64_t components = 0;
  if (is("vectors") || is("normals")) components = 3;
  if (is("tensors")) components = 9;
  if (is("tensors6")) components = 6;
  if (is("global_ids") || is("pedigree_ids")) components = 1;
  if (is("texture_coordinates")) components = in_.integer("the number of components");
  if (components <= 0) in_.fail(fmt::format("\"{}\" is no section of a VTK file", printable(kind)));
  const VtkType type = vtk_type(in_, in_.token("the type of an attribute"));
  in_.line();
  arrays_.skip(multiplied(num_attributes_, components), type, "an attribute");
}

void VtkReader::read_scalars() {
  const std::string name(in_.token("the name of the scalars"));
  const VtkType type = vtk_type(in_, in_.token("the type of the scalars"));
  const std::int64_t components = in_.more_in_line() ? in_.integer("the number of components") : 1;
  in_.line();
  if (lower(in_.peek().substr(0, 12)) == "lookup_table") in_.line();
  take_values(name, components, num_attributes_, type);
}

void VtkReader::read_field() {
  in_.token("the name of a field");
  const std::int64_t n = in_.integer("the number of arrays");
  for (std::int64_t i = 0; i < n; ++i) {
    std::string name(in_.token("the name of an array"));
    while (lower(name) == "metadata") {
      read_metadata();
      name = in_.token("the name of an array");
    }
    const std::int64_t components = in_.integer("the number of components");
    const std::int64_t tuples = in_.integer("the number of tuples");
    const VtkType type = vtk_type(in_, in_.token("the type of an array"));
    in_.line();
    take_values(name, components, tuples, type);
  }
}

// Ends at an empty line (VTK 5.x).
void VtkReader::read_metadata() {
  in_.line();
  while (in_.remaining() > 0 && in_.line().find_first_not_of(" \t\r") != std::string_view::npos) {
  }
}

// The cell scalar that holds the colours: the best of the well-known names, else the first integer one.
void VtkReader::take_values(const std::string& name, std::int64_t components, std::int64_t n, VtkType type) {
  const std::size_t rank = colour_rank(name, type);
  const bool is_colour = attributes_of_ == Of::cells && components == 1 &&
                         n == static_cast<std::int64_t>(cells_.types.size()) && rank < colour_rank_;
  if (!is_colour) return arrays_.skip(multiplied(n, components), type, "an array");
  cells_.colours = arrays_.integers(n, type, "colours of cells");
  colour_rank_ = rank;
}

std::int64_t VtkReader::multiplied(std::int64_t a, std::int64_t b) {
  constexpr std::int64_t limit = std::int64_t{1} << 60;
  if (a < 0 || b < 0 || (b > 0 && a > limit / b)) in_.fail(fmt::format("a size of {} x {} is impossible", a, b));
  return a * b;
}

}  // namespace

CellSoup read_legacy_vtk(Scanner in) { return VtkReader(std::move(in)).read(); }

}  // namespace hexfield::io
