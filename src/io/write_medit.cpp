#include <fmt/format.h>

#include <utility>

#include "writers.hpp"

namespace hexfield::io {

void write_medit(BufferedWriter& out, const CellSoup& soup) {
  const CellBlock& corners_block = soup.block(Shape::point);
  std::vector<int> references(soup.points.size(), 0);
  for (std::size_t c = 0; c < corners_block.size(); ++c)
    references[static_cast<std::size_t>(corners_block.vertices[c])] = corners_block.colours[c];
  out.print("MeshVersionFormatted 2\nDimension 3\n\nVertices\n{}\n", soup.points.size());
  for (std::size_t i = 0; i < soup.points.size(); ++i)
    out.print("{} {} {} {}\n", soup.points[i].x(), soup.points[i].y(), soup.points[i].z(), references[i]);
  if (corners_block.size() > 0) out.print("\nCorners\n{}\n", corners_block.size());
  for (std::int32_t v : corners_block.vertices) out.print("{}\n", v + 1);
  static constexpr std::pair<Shape, const char*> lists[] = {{Shape::line, "Edges"},
                                                            {Shape::triangle, "Triangles"},
                                                            {Shape::quad, "Quadrilaterals"},
                                                            {Shape::tet, "Tetrahedra"},
                                                            {Shape::hex, "Hexahedra"}};
  for (const auto& [shape, name] : lists) {
    const auto s = static_cast<std::size_t>(shape);
    if (soup.blocks[s].size() == 0) continue;
    out.print("\n{}\n{}\n", name, soup.blocks[s].size());
    for (std::size_t c = 0; c < soup.blocks[s].size(); ++c) {
      for (std::int32_t v : corners(soup, s, c)) out.print("{} ", v + 1);
      out.print("{}\n", soup.blocks[s].colours[c]);
    }
  }
  out.write("\nEnd\n");
}

}  // namespace hexfield::io
