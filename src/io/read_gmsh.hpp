#pragma once

#include <array>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "cell_soup.hpp"
#include "scanner.hpp"

namespace hexfield::io {

/// Index of a node by its tag.
class NodeIndex {
 public:
  /// `tags` ascending, each once.
  explicit NodeIndex(std::vector<std::int64_t> tags);
  NodeIndex() = default;
  /// -1 when there is no such node.
  std::int64_t find(std::int64_t tag) const;
  const std::vector<std::int64_t>& tags() const { return tags_; }

 private:
  std::vector<std::int64_t> tags_;
  bool dense_ = false;  // tags are first, first + 1, ...
};

/// Reads MSH files as chapter "Gmsh mesh file formats" of the Gmsh reference manual describes them. Points and cells
/// come in ascending order of their tags.
class GmshReader {
 public:
  explicit GmshReader(Scanner in) : in_(std::move(in)) {}
  CellSoup read();

 private:
  struct Tags {
    std::int64_t physical = 0;
    std::int64_t elementary = 0;
  };

  void read_format();
  void read_names();
  void read_entities();
  void read_entity(int dimension);
  void read_nodes2();
  void read_nodes4();
  void read_elements2();
  void read_elements4();
  void read_element(Shape shape, Tags tags, std::int64_t id);
  void set_nodes(std::vector<std::pair<std::int64_t, Vec3>> nodes);
  void end_section(const std::string& name);
  Shape shape_of(std::int64_t type, std::int64_t element) const;
  void sort_cells();
  void choose_colours();

  std::int64_t integer(const char* what);
  std::int64_t size(const char* what);
  std::size_t size_of_list(const char* what, std::size_t ascii_bytes, std::size_t binary_bytes);
  double real(const char* what);

  Scanner in_;
  double version_ = 0;
  bool binary_ = false;
  bool have_nodes_ = false, have_elements_ = false;
  CellSoup soup_;
  NodeIndex index_;
  std::map<std::pair<int, std::int64_t>, std::int64_t> physical_of_;  // (dimension, entity) -> first physical tag
  std::array<std::vector<Tags>, num_shapes> tags_;
};

}  // namespace hexfield::io
