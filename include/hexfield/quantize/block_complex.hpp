#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "hexfield/base/error.hpp"
#include "hexfield/base/geometry.hpp"
#include "hexfield/base/octahedral.hpp"

namespace hexfield {

/// The cells of a motorcycle complex (spec-quantization 3.3 to 3.5): cuboid blocks whose sides are covered by
/// rectangular patches, with T-junctions. Lengths and positions are integers in steps of 2^-grid_exponent of the
/// seamless map's parameter units; directions are labels in the chart of a block.
struct BlockComplex {
  using Label = octahedral::Label;
  using Integer3 = std::array<std::int64_t, 3>;

  struct Node {
    Vec3 place;            ///< in the input's space
    std::int32_t vertex;   ///< of the input mesh, -1 when the node is none
    bool feature = false;  ///< a feature point
  };
  /// A straight line between two nodes: a chain of edges of the cut mesh.
  struct Arc {
    std::array<std::int32_t, 2> nodes;
    std::int64_t length = 0;
    bool singular = false;  ///< inner singular arc, or boundary arc that is not flat
    bool feature = false;
    bool boundary = false;
    int code = 0;        ///< quarter-turns minus 4 (inner) or 2 (boundary)
    double turning = 0;  ///< of the curve it stands for in the input's space, radians
  };
  struct Patch {
    std::array<std::int32_t, 2> blocks{-1, -1};  ///< ascending; the second is -1 on the boundary
    std::array<Label, 2> normals{};              ///< out of each block, in its chart
    octahedral::Rotation rotation = 0;           ///< chart of blocks[0] -> chart of blocks[1]
    /// Arcs by the direction, in the chart of blocks[0], in which they bound the patch (four of the six are used).
    std::array<std::vector<std::int32_t>, 6> sides;
    bool feature = false;
    double distance = 0;  ///< that the fire had travelled when it reached the patch, grid steps
  };
  struct Block {
    Integer3 low{}, high{};
    std::vector<std::pair<std::int32_t, Integer3>> nodes;  ///< ascending, with their positions in the block's chart
    std::vector<std::pair<std::int32_t, Label>> arcs;      ///< ascending, with the direction from nodes[0] to nodes[1]
    std::array<std::vector<std::int32_t>, 6> faces;        ///< patches by outward label
    std::array<std::vector<std::int32_t>, 12>
        edges;  ///< arcs by block edge: 4 axis + 2 (high on the next axis) + (high on the one after)
    std::array<std::int32_t, 8> corners{};  ///< nodes; bit k: high on axis k
  };
  std::vector<Node> nodes;
  std::vector<Arc> arcs;
  std::vector<Patch> patches;
  std::vector<Block> blocks;
  int grid_exponent = 0;

  /// Triangles of the walls and line pieces of the arcs, with their patch and arc, for pictures.
  std::vector<Vec3> picture_points;
  std::vector<std::pair<std::array<std::int32_t, 3>, std::int32_t>> picture_triangles;
  std::vector<std::pair<std::array<std::int32_t, 2>, std::int32_t>> picture_lines;

  /// Real length of an arc in parameter units.
  double length(std::size_t arc) const;
  /// nodes - arcs + patches - blocks.
  std::int64_t euler() const;
};

/// Broken invariants of spec-quantization section 8: patches that are no rectangles, blocks that are no cuboids or
/// whose parallel edges differ, arcs and nodes that do not fit, singular arcs that end inside.
std::vector<Violation> check(const BlockComplex& complex);

}  // namespace hexfield
