#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "writers.hpp"

namespace hexfield::io {
namespace {

/// Numbers of an MSH file, text or binary.
class MshWriter {
 public:
  MshWriter(BufferedWriter& out, bool binary, const char* version) : out_(out), binary_(binary) {
    out_.print("$MeshFormat\n{} {} 8\n", version, binary ? 1 : 0);
    if (binary) {
      out_.binary(std::int32_t{1});
      out_.write("\n");
    }
    out_.write("$EndMeshFormat\n");
  }

  void integer(std::int64_t value) { number(static_cast<std::int32_t>(value)); }
  void size(std::size_t value) { number(static_cast<std::uint64_t>(value)); }
  void real(double value) { number(value); }
  /// End of a line of text; nothing in binary.
  void end_line() {
    if (!binary_) out_.write("\n");
  }
  void section(const char* name) { out_.print("${}\n", name); }
  void end_section(const char* name) {
    if (binary_) out_.write("\n");
    out_.print("$End{}\n", name);
  }

 private:
  template <class T>
  void number(T value) {
    if (binary_)
      out_.binary(value);
    else
      out_.print("{} ", value);
  }

  BufferedWriter& out_;
  bool binary_;
};

void write_names(BufferedWriter& out, const CellSoup& soup) {
  if (soup.names.empty()) return;
  out.print("$PhysicalNames\n{}\n", soup.names.size());
  for (const auto& [key, name] : soup.names) {
    std::string line = name;
    std::replace(line.begin(), line.end(), '\n', ' ');
    out.print("{} {} \"{}\"\n", key.first, key.second, line);
  }
  out.write("$EndPhysicalNames\n");
}

/// All that belongs to one (dimension, colour), which becomes an entity and a physical group of that number.
struct Entity {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  std::vector<std::size_t> nodes;                         // classified on it
  std::map<std::size_t, std::vector<std::size_t>> cells;  // shape -> cells
};
using Entities = std::map<std::pair<int, int>, Entity>;

Entities entities_of(const CellSoup& soup) {
  Entities entities;
  std::vector<char> classified(soup.points.size(), 0);
  for (std::size_t s = 0; s < num_shapes; ++s)  // shapes ascend in dimension
    for (std::size_t c = 0; c < soup.blocks[s].size(); ++c) {
      Entity& entity = entities[{shape_dimension[s], soup.blocks[s].colours[c]}];
      entity.cells[s].push_back(c);
      for (std::int32_t v : corners(soup, s, c)) {
        const auto i = static_cast<std::size_t>(v);
        entity.low = entity.low.cwiseMin(soup.points[i]);
        entity.high = entity.high.cwiseMax(soup.points[i]);
        if (classified[i] == 0) entity.nodes.push_back(i);
        classified[i] = 1;
      }
    }
  // A point of no cell goes to the last entity, so that it is not lost.
  for (std::size_t i = 0; i < classified.size(); ++i)
    if (classified[i] == 0 && !entities.empty()) entities.rbegin()->second.nodes.push_back(i);
  for (auto& [key, entity] : entities) std::sort(entity.nodes.begin(), entity.nodes.end());
  return entities;
}

void write_entities(MshWriter& out, const Entities& entities) {
  out.section("Entities");
  for (int dimension = 0; dimension < 4; ++dimension)
    out.size(static_cast<std::size_t>(
        std::count_if(entities.begin(), entities.end(), [&](const auto& e) { return e.first.first == dimension; })));
  out.end_line();
  for (const auto& [key, entity] : entities) {
    out.integer(key.second);
    for (int k = 0; k < 3; ++k) out.real(entity.low[k]);
    for (int k = 0; k < 3 && key.first > 0; ++k) out.real(entity.high[k]);
    out.size(1);
    out.integer(key.second);
    if (key.first > 0) out.size(0);
    out.end_line();
  }
  out.end_section("Entities");
}

void write_nodes(MshWriter& out, const CellSoup& soup, const Entities& entities) {
  out.section("Nodes");
  out.size(entities.size());
  out.size(soup.points.size());
  out.size(soup.points.empty() ? 0 : 1);
  out.size(soup.points.size());
  out.end_line();
  for (const auto& [key, entity] : entities) {
    out.integer(key.first);
    out.integer(key.second);
    out.integer(0);
    out.size(entity.nodes.size());
    out.end_line();
    for (std::size_t i : entity.nodes) {
      out.size(i + 1);
      out.end_line();
    }
    for (std::size_t i : entity.nodes) {
      for (int k = 0; k < 3; ++k) out.real(soup.points[i][k]);
      out.end_line();
    }
  }
  out.end_section("Nodes");
}

}  // namespace

void write_msh22(BufferedWriter& file, const CellSoup& soup, bool binary) {
  MshWriter out(file, binary, "2.2");
  write_names(file, soup);
  file.print("$Nodes\n{}\n", soup.points.size());
  for (std::size_t i = 0; i < soup.points.size(); ++i) {
    out.integer(static_cast<std::int64_t>(i + 1));
    for (int k = 0; k < 3; ++k) out.real(soup.points[i][k]);
    out.end_line();
  }
  out.end_section("Nodes");
  file.print("$Elements\n{}\n", soup.num_cells());
  std::int64_t id = 0;
  for (std::size_t s = 0; s < num_shapes; ++s) {
    const std::size_t cells = soup.blocks[s].size();
    if (binary && cells > 0)
      for (std::int64_t v : {std::int64_t{shape_gmsh[s]}, static_cast<std::int64_t>(cells), std::int64_t{2}})
        out.integer(v);
    for (std::size_t c = 0; c < cells; ++c) {
      out.integer(++id);
      if (!binary) {
        out.integer(shape_gmsh[s]);
        out.integer(2);
      }
      out.integer(soup.blocks[s].colours[c]);
      out.integer(soup.blocks[s].colours[c]);
      for (std::int32_t v : corners(soup, s, c)) out.integer(v + 1);
      out.end_line();
    }
  }
  out.end_section("Elements");
}

void write_msh41(BufferedWriter& file, const CellSoup& soup, bool binary) {
  MshWriter out(file, binary, "4.1");
  const Entities entities = entities_of(soup);
  write_names(file, soup);
  write_entities(out, entities);
  write_nodes(out, soup, entities);
  std::array<std::size_t, num_shapes + 1> first{1};  // tags ascend in the order of the soup
  for (std::size_t s = 0; s < num_shapes; ++s) first[s + 1] = first[s] + soup.blocks[s].size();
  std::size_t blocks = 0;
  for (const auto& [key, entity] : entities) blocks += entity.cells.size();
  out.section("Elements");
  out.size(blocks);
  out.size(soup.num_cells());
  out.size(soup.num_cells() == 0 ? 0 : 1);
  out.size(soup.num_cells());
  out.end_line();
  for (const auto& [key, entity] : entities)
    for (const auto& [s, cells] : entity.cells) {
      out.integer(key.first);
      out.integer(key.second);
      out.integer(shape_gmsh[s]);
      out.size(cells.size());
      out.end_line();
      for (std::size_t c : cells) {
        out.size(first[s] + c);
        for (std::int32_t v : corners(soup, s, c)) out.size(static_cast<std::size_t>(v) + 1);
        out.end_line();
      }
    }
  out.end_section("Elements");
}

}  // namespace hexfield::io
