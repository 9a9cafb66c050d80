#pragma once

#include <set>
#include <vector>

#include "hexfield/field/frame_field.hpp"
#include "hexfield/map/corner_map.hpp"
#include "hexfield/mesh/features.hpp"

namespace hexfield {

/// Coordinate `axis` of the chart of face.tet() is constant on the face.
struct FaceAlignment {
  HalfFaceId face;
  int axis;
};
/// Only coordinate `axis` of the chart of `tet` varies along the edge.
struct EdgeAlignment {
  TetId tet;
  EdgeKey edge;
  int axis;
};

/// What a map must keep on coordinate planes, lines and points.
struct Alignments {
  std::vector<FaceAlignment> faces;  ///< feature and boundary faces
  std::vector<EdgeAlignment> edges;  ///< feature and singular edges, one per tet around them
  std::vector<VertexId> points;      ///< feature points, singular nodes and ends of curves, ascending
};

/// Edges with a non-zero code.
std::set<EdgeKey> singular_edges(const EdgeCodes& codes);

/// Feature points and all vertices where not 0 or 2 feature edges, or not 0 or 2 singular edges, meet
/// (feature closure of spec-quantization section 1). Ascending.
std::vector<VertexId> critical_points(const Features& features, const EdgeCodes& codes);

/// Alignments that the constraints of a field ask for (labels are axes of the tets' frames).
Alignments alignments_of_field(const std::vector<AxisConstraint>& constraints, const Features& features,
                               const EdgeCodes& codes);

/// Alignments that a map has: boundary and feature faces by their coordinate of least spread, feature and
/// singular edges by their longest coordinate.
Alignments alignments_of_map(const TetMesh& mesh, const Features& features, const EdgeCodes& codes,
                             const CornerMap& map);

}  // namespace hexfield
