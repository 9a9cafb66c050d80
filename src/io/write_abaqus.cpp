#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "scanner.hpp"
#include "writers.hpp"

namespace hexfield::io {
namespace {

// Labels of Abaqus: letters, digits, '_' and '-', a letter first, case-insensitive, at most 80 characters.
std::string label_of(const std::string& name) {
  std::string label = name.substr(0, 60);
  for (char& c : label) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    const bool other = (c >= '0' && c <= '9') || c == '_' || c == '-';
    if (!letter && !other) c = '_';
  }
  const char first = label.empty() ? '0' : label[0];
  return (first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z') ? label : "S" + label;
}

// One label per (dimension, colour), from its name or its kind; no label twice.
class SetLabels {
 public:
  explicit SetLabels(const CellSoup& soup) : soup_(soup) {}

  const std::string& operator()(int dimension, int colour) {
    std::string& label = labels_[{dimension, colour}];
    if (!label.empty()) return label;
    static constexpr std::array<const char*, 4> kinds = {"POINT", "CURVE", "SURFACE", "VOLUME"};
    const std::string generic = fmt::format("{}{}", kinds[static_cast<std::size_t>(dimension)], colour);
    const auto name = soup_.names.find({dimension, colour});
    label = name == soup_.names.end() ? generic : label_of(name->second);
    if (!taken_.insert(lower(label)).second) {
      label += "_" + generic;
      taken_.insert(lower(label));
    }
    return label;
  }

 private:
  const CellSoup& soup_;
  std::map<std::pair<int, int>, std::string> labels_;
  std::set<std::string> taken_;
};

}  // namespace

void write_abaqus(BufferedWriter& out, const CellSoup& soup) {
  static constexpr std::array<const char*, num_shapes> types = {"", "T3D2", "S3", "S4", "C3D4", "C3D8"};
  SetLabels label(soup);
  out.write("*HEADING\nhexfield\n*NODE\n");
  for (std::size_t i = 0; i < soup.points.size(); ++i)
    out.print("{}, {}, {}, {}\n", i + 1, soup.points[i].x(), soup.points[i].y(), soup.points[i].z());
  std::size_t id = 0;
  for (std::size_t s = 1; s < num_shapes; ++s) {
    std::map<int, std::vector<std::size_t>> cells_of;
    for (std::size_t c = 0; c < soup.blocks[s].size(); ++c) cells_of[soup.blocks[s].colours[c]].push_back(c);
    for (const auto& [colour, cells] : cells_of) {
      out.print("*ELEMENT, TYPE={}, ELSET={}\n", types[s], label(shape_dimension[s], colour));
      for (std::size_t c : cells) {
        out.print("{}", ++id);
        for (std::int32_t v : corners(soup, s, c)) out.print(", {}", v + 1);
        out.write("\n");
      }
    }
  }
  std::map<int, std::vector<std::int32_t>> nodes_of;
  const CellBlock& points = soup.block(Shape::point);
  for (std::size_t c = 0; c < points.size(); ++c) nodes_of[points.colours[c]].push_back(points.vertices[c]);
  for (const auto& [colour, nodes] : nodes_of) {
    out.print("*NSET, NSET={}\n", label(0, colour));
    for (std::int32_t v : nodes) out.print("{}\n", v + 1);
  }
}

}  // namespace hexfield::io
