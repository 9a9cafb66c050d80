#include <fmt/format.h>

#include <optional>
#include <utility>

#include "readers.hpp"

namespace hexfield::io {
namespace {

// ASCII .mesh files, version 1 to 4, as the libMeshb documentation lists their keywords.
class MeditReader {
 public:
  explicit MeditReader(Scanner in) : in_(std::move(in)) {}

  CellSoup read() {
    soup_.file = in_.file();
    soup_.first_point_id = 1;
    bool end = false;
    while (!end && !at_end()) end = !read_section(std::string(in_.token("a keyword")));
    if (!have_vertices_) in_.fail("there is no section Vertices");
    add_corners();
    return std::move(soup_);
  }

 private:
  bool at_end() {
    while (!in_.at_end() && in_.peek().starts_with('#')) in_.line();
    return in_.at_end();
  }
  std::int64_t integer(const char* what) {
    at_end();
    return in_.integer(what);
  }
  std::size_t count(const char* what, std::size_t bytes_each) {
    at_end();
    return in_.count(what, bytes_each);
  }

  bool read_section(const std::string& keyword);
  bool read_cells(const std::string& keyword);
  bool skip_list(const std::string& keyword);
  void read_vertices();
  void add_corners();

  Scanner in_;
  CellSoup soup_;
  bool have_vertices_ = false;
  std::vector<std::int64_t> references_;  // of the vertices
  std::vector<std::int64_t> corners_;     // from 1
};

bool MeditReader::read_section(const std::string& keyword) {
  if (keyword == "End") return false;
  if (keyword == "MeshVersionFormatted") {
    integer("the version");
  } else if (keyword == "Dimension") {
    const std::int64_t dimension = integer("the dimension");
    if (dimension != 3) in_.fail(fmt::format("the dimension is {}, not 3", dimension));
  } else if (keyword == "Vertices") {
    read_vertices();
  } else if (keyword == "Corners") {
    const std::size_t n = count("the number of corners", 2);
    for (std::size_t i = 0; i < n; ++i) corners_.push_back(integer("a corner"));
  } else if (!read_cells(keyword) && !skip_list(keyword)) {
    in_.fail(fmt::format("\"{}\" is no keyword that is known here", printable(keyword)));
  }
  return true;
}

void MeditReader::read_vertices() {
  if (have_vertices_) in_.fail("there is a second section Vertices");
  have_vertices_ = true;
  soup_.points.resize(count("the number of vertices", 8));
  references_.reserve(soup_.points.size());
  for (Vec3& p : soup_.points) {
    at_end();
    for (int k = 0; k < 3; ++k) p[k] = in_.real("a coordinate");
    references_.push_back(in_.integer("the reference of a vertex"));
  }
}

bool MeditReader::read_cells(const std::string& keyword) {
  static constexpr std::pair<std::string_view, Shape> lists[] = {
      {"Edges", Shape::line},     {"Triangles", Shape::triangle}, {"Quadrilaterals", Shape::quad},
      {"Tetrahedra", Shape::tet}, {"Hexahedra", Shape::hex},      {"Hexaedra", Shape::hex}};
  for (const auto& [name, shape] : lists) {
    if (keyword != name) continue;
    const int corners = shape_corners[static_cast<std::size_t>(shape)];
    const std::size_t n = count("the number of elements", 2 * static_cast<std::size_t>(corners + 1));
    for (std::size_t i = 0; i < n; ++i) {
      std::array<std::int64_t, 8> vertices{};
      at_end();
      const auto id = static_cast<std::int64_t>(i + 1);
      for (int k = 0; k < corners; ++k) {
        const std::int64_t v = in_.integer("a vertex of an element");
        if (v < 1 || v > static_cast<std::int64_t>(soup_.points.size()))
          in_.fail(fmt::format("{} {} names vertex {}, which does not exist; there are {}",
                               shape_name[static_cast<std::size_t>(shape)], id, v, soup_.points.size()));
        vertices[static_cast<std::size_t>(k)] = v - 1;
      }
      soup_.add(shape, vertices.data(), in_.integer("the reference of an element"), id);
    }
    return true;
  }
  return false;
}

// Lists that say nothing of features or that the features' own references say already.
bool MeditReader::skip_list(const std::string& keyword) {
  static constexpr std::pair<std::string_view, int> lists[] = {{"RequiredVertices", 1},
                                                               {"Ridges", 1},
                                                               {"RequiredEdges", 1},
                                                               {"RequiredTriangles", 1},
                                                               {"RequiredQuadrilaterals", 1},
                                                               {"RequiredTetrahedra", 1},
                                                               {"Normals", 3},
                                                               {"Tangents", 3},
                                                               {"NormalAtVertices", 2},
                                                               {"TangentAtVertices", 2},
                                                               {"NormalAtTriangleVertices", 3},
                                                               {"NormalAtQuadrilateralVertices", 3},
                                                               {"TangentAtEdges", 3}};
  for (const auto& [name, width] : lists) {
    if (keyword != name) continue;
    const std::size_t n = count("the length of a list", 2 * static_cast<std::size_t>(width));
    for (std::size_t i = 0; i < n; ++i) {
      at_end();
      for (int k = 0; k < width; ++k) in_.real("a number");
    }
    return true;
  }
  return false;
}

void MeditReader::add_corners() {
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const std::int64_t v = corners_[i];
    if (v < 1 || v > static_cast<std::int64_t>(soup_.points.size()))
      in_.fail(
          fmt::format("corner {} names vertex {}, which does not exist; there are {}", i + 1, v, soup_.points.size()));
    const std::int64_t vertex = v - 1;
    const std::int64_t reference = references_[static_cast<std::size_t>(vertex)];
    soup_.add(Shape::point, &vertex, reference > 0 ? reference : static_cast<std::int64_t>(i + 1), v);
  }
}

}  // namespace

CellSoup read_medit(Scanner in) { return MeditReader(std::move(in)).read(); }

}  // namespace hexfield::io
