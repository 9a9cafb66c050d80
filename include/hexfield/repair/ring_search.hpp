#pragma once

#include <span>
#include <vector>

#include "hexfield/repair/one_ring.hpp"

/// Search for sectors between two spokes of a one-ring (Liu and Bommes 2023 section 5.2, "Establishing meshable
/// vertices"; spec-lmff section 5.3). Nothing here is collective.
namespace hexfield {

/// Which sector two edges form.
enum class Flow {
  through,   ///< hyperbolic: a streamline comes in along the first and goes out along the second (DT1, DT3)
  parallel,  ///< parabolic: two parallel arcs go out (DT2, DT4)
};

enum class RingTarget {
  free_arc,     ///< singular edges off features
  surface_arc,  ///< edges in feature faces: singular ones and feature edges
  any_edge,     ///< all spokes
  surface,      ///< faces of the domain boundary where the streamline leaves: boundary-truncated sectors
};

struct RingQuery {
  Flow flow = Flow::through;
  VertexId start;  ///< other end of the first spoke
  RingTarget target = RingTarget::free_arc;
  bool cross_surfaces = false;  ///< may the path cross feature faces, where the flow lets it (else: same region)
  bool any_code = false;        ///< DT3, DT4: any two codes; DT1: equal, DT2: opposite codes
};

/// A dual path in a one-ring, from a tet at the first spoke to a tet at the second or at a boundary face.
struct RingPath {
  VertexId from, to;              ///< ends of the spokes; `to` is invalid when the path leaves at `exit`
  std::vector<TetId> tets;        ///< consecutive ones share a face at the centre; no tet twice
  std::vector<HalfFaceId> faces;  ///< faces[k] leads from tets[k] to tets[k + 1]
  HalfFaceId exit;                ///< boundary half-face of the last tet
};

/// Breadth-first search over (tet, label): carries the label of the flow from all tets around the first spoke.
/// Steps must go roughly along the flow, within 100 degrees (through), or not along it, 45 degrees (parallel), so
/// that 2 pi rotations are not mistaken; free where the vertex or region has too few arcs to be mistaken. One path
/// per target, in the order of discovery; boundary faces in the order of preference of spec-lmff section 5.3.
std::vector<RingPath> find_ring_paths(const RepairState& state, const OneRing& ring, const RingQuery& query);

/// A defect of a vertex: two edges that go out in parallel through one sector.
struct ParabolicSector {
  VertexId first, second;  ///< ends of the spokes, first < second; `second` invalid: an arc that meets the boundary
                           ///< with reversed flow
  auto operator<=>(const ParabolicSector&) const = default;
};

/// All parabolic sectors between pairs of singular and feature edges at the centre, and the surface sectors without
/// a quad (which are fully constrained ones), ascending.
std::vector<ParabolicSector> parabolic_sectors(const RepairState& state, const OneRing& ring);

}  // namespace hexfield
