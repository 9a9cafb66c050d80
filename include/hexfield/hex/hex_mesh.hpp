#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "hexfield/base/error.hpp"
#include "hexfield/base/geometry.hpp"

namespace hexfield {

/// Hexahedral mesh with the features of the input carried over. Vertex order of a hex as in VTK
/// (0-3 bottom counter-clockwise seen from above, 4-7 above them).
struct HexMesh {
  struct Point {
    int vertex;
    int colour;
  };
  struct Line {
    std::array<int, 2> vertices;
    int colour;
  };
  struct Quad {
    std::array<int, 4> vertices;
    int colour;
  };

  std::vector<Vec3> points;
  std::vector<std::array<int, 8>> hexes;
  std::vector<int> hex_colours;  ///< material per hex; empty when the input has one unnamed volume
  std::vector<Point> feature_points;
  std::vector<Line> feature_lines;
  std::vector<Quad> feature_quads;
  std::map<std::pair<int, int>, std::string> names;  ///< (dimension, colour) -> physical name
};

}  // namespace hexfield
