#pragma once

#include "chart_mesh.hpp"
#include "hexfield/quantize/block_complex.hpp"

namespace hexfield::quantize {

/// Where a block must be cut by another wall: it is a solid torus, or it meets itself.
struct BlockCut {
  std::int32_t block;
  int axis;                          ///< in the chart of the block
  bool torus;                        ///< anywhere along the axis
  double low = 0, high = 0, at = 0;  ///< not a torus: at a place between the two, grid units in the chart of the block
};

/// Blocks, patches, arcs and nodes of the walls in a mesh (spec-quantization 3.3 and 3.4).
class WallCells {
 public:
  /// The inside of one block between two consecutive wall faces at an edge.
  struct Fan {
    std::int32_t first, last;  ///< half-faces, both seen from inside the fan
    int quarters;              ///< 1 or 2
  };
  struct WallEdge {
    std::int32_t a, b;  ///< vertices
    std::int32_t first_fan, num_fans;
    bool arc;
  };

  explicit WallCells(ChartMesh& mesh) : mesh_(mesh) {}

  /// Finds everything; stops early with cuts() when blocks must be cut first. Throws Error(no_integer_grid_map) naming
  /// the place where the walls do not bound cuboids.
  void build();
  const std::vector<BlockCut>& cuts() const { return cuts_; }
  /// Lights the fires that carry out a cut.
  void ignite(const BlockCut& cut, class BrushFire& fire);
  /// Valid when there are no cuts.
  BlockComplex complex;
  std::int32_t block_of_tet(std::int32_t t) const { return block_[static_cast<std::size_t>(t)]; }
  const ChartStep& to_block(std::int32_t t) const { return to_block_[static_cast<std::size_t>(t)]; }
  /// The node at a vertex of the cut mesh, or -1.
  std::int32_t node_at(std::int32_t vertex) const { return node_[static_cast<std::size_t>(vertex)]; }
  /// The patch that wall half-face h is part of.
  std::int32_t patch_at(std::int32_t h) const {
    return patch_of_face_[static_cast<std::size_t>(face_[static_cast<std::size_t>(h)])];
  }
  /// Removes the walls of a patch from the mesh.
  void clear_patch(std::int32_t patch);

 private:
  void flood();
  void collect_walls();
  void find_torus_cuts();
  void collect_edges();
  void make_edge(std::int32_t a, std::int32_t b, std::int32_t seed, bool has_boundary);
  void find_nodes();
  void chain_arcs();
  double turning(const std::vector<std::int32_t>& chain) const;
  void join_patches();
  void place_nodes();
  void fill_patches();
  void fill_blocks();
  void find_self_cuts(std::int32_t block, const std::vector<std::pair<std::int32_t, BlockComplex::Integer3>>& places);
  void draw();

  std::int32_t block_of(std::int32_t h) const { return block_[static_cast<std::size_t>(h / 4)]; }
  octahedral::Label outward(std::int32_t h);
  octahedral::Label direction(std::int32_t t, std::int32_t from, std::int32_t to) const;
  bool ignite_at_arc(const BlockCut& cut, class BrushFire& fire);
  bool ignite_at_face(const BlockCut& cut, std::int32_t h, class BrushFire& fire);
  void ignite_fan(int axis, std::int32_t h, std::int32_t a, std::int32_t b, class BrushFire& fire);
  [[noreturn]] void fail(const char* what, std::int32_t vertex) const;

  ChartMesh& mesh_;
  std::vector<std::int32_t> block_;         // per tet
  std::vector<ChartStep> to_block_;         // per tet
  std::vector<char> torus_;                 // per block
  std::vector<std::int32_t> walls_;         // half-faces, one per wall face, the lower of the two
  std::vector<std::int32_t> face_;          // per half-face: index into walls_
  std::vector<octahedral::Label> outward_;  // per half-face, in the chart of its block
  std::vector<WallEdge> edges_;
  std::vector<Fan> fans_;
  std::vector<std::int32_t> node_;                                  // per vertex: node, or -1
  std::vector<std::pair<std::int32_t, std::int32_t>> first_edges_;  // per arc: edge, and 1 when it runs b -> a
  std::vector<std::int32_t> arc_of_edge_;
  std::vector<std::int32_t> patch_of_face_;
  std::vector<BlockCut> cuts_;
};

/// Walls from all sources, further cuts of blocks that need them, then the removal of walls; leaves `cells` built.
void trace_and_reduce(ChartMesh& walls, WallCells& cells, bool reduce);

}  // namespace hexfield::quantize
