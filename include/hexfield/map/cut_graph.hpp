#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <vector>

#include "hexfield/map/corner_map.hpp"
#include "hexfield/mesh/tet_mesh.hpp"

namespace hexfield {

/// A cut that leaves every component of the mesh simply connected, and gauges in which all transitions off
/// the cut are the identity (spec-lmff section 8, steps 1 to 3).
struct CutGraph {
  /// Gauge g_i per tet: the combed frame is F_i g_i and combed coordinates are g_i^-1 times the old ones.
  std::vector<octahedral::Rotation> gauges;
  /// Rotation R of the combed coordinates across each half-face: f_j = R f_i + t. Identity off the cut.
  std::vector<std::array<octahedral::Rotation, 4>> rotations;
  /// Per half-face: 0 off the cut, p + 1 on the front side of cut patch p, -(p + 1) on its back side.
  /// A patch is a manifold piece of the cut: it has one rotation and one translation (front to back).
  std::vector<std::array<std::int32_t, 4>> patches;
  std::size_t num_patches = 0;
  /// Front half-face of the first face of each patch.
  std::vector<HalfFaceId> patch_face;
  /// Corner class per tet and local vertex: corners of one vertex that are joined across faces off the cut.
  std::vector<std::array<std::int32_t, 4>> classes;
  std::vector<VertexId> class_vertex;
  /// Component of the mesh per tet.
  std::vector<std::int32_t> components;
  std::int32_t num_components = 0;

  std::size_t num_classes() const { return class_vertex.size(); }
  std::int32_t patch(HalfFaceId h) const { return patches[h.tet().index()][static_cast<std::size_t>(h.local())]; }
  octahedral::Rotation rotation(HalfFaceId h) const {
    return rotations[h.tet().index()][static_cast<std::size_t>(h.local())];
  }
};

/// Cut graph of a mesh without tombstones with matchings M_ij per half-face (FrameField::matchings): a
/// breadth-first spanning tree over the tets, gauges combed along it, all other inner faces cut and then
/// peeled from inner edges, not in `singular`, that have only one cut face. Deterministic.
CutGraph cut_graph(const TetMesh& mesh, const std::vector<std::array<octahedral::Rotation, 4>>& matchings,
                   const std::set<EdgeKey>& singular);

/// Matchings of a map: the inverses of its transitions' rotations.
std::vector<std::array<octahedral::Rotation, 4>> matchings_of(const CornerMap& map);

/// Broken invariants: rotations not mutual, a transition off the cut, classes that do not follow the cut.
std::vector<Violation> check(const TetMesh& mesh, const CutGraph& cut);

}  // namespace hexfield
