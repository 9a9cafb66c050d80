#pragma once

#include <span>
#include <utility>
#include <vector>

#include "hexfield/field/frame_field.hpp"
#include "hexfield/mesh/features.hpp"

/// Monodromies, sectors and singular codes of edges (spec-lmff section 3). Nothing here is collective.
/// A ring belongs to an oriented edge; its first tet gives the chart that labels are expressed in.
namespace hexfield {

/// Product of the matchings around a closed ring, in the chart of its first tet; identity for open rings.
octahedral::Rotation monodromy(const FrameField& field, const EdgeRing& ring);

/// A label of the chart of h.tet() in the chart across h.
octahedral::Label transport(const FrameField& field, HalfFaceId h, octahedral::Label label);

/// The signed axis of frame that is closest to a direction; the smaller label wins ties.
octahedral::Label closest_label(const Quaternion& frame, const Vec3& direction);

/// The same label in the chart of every tet of the ring, starting from the first.
std::vector<octahedral::Label> transport_around(const FrameField& field, const EdgeRing& ring, octahedral::Label label);

/// Frame with its axis `label` turned onto the unit `direction` by the smallest rotation.
Quaternion aligned_frame(const Quaternion& frame, octahedral::Label label, const Vec3& direction);

/// Code of an inner edge a -> b from its closed ring: 0, compound_code, undetermined_code or the number of
/// quad sectors minus 4.
EdgeCode interior_code(const TetMesh& mesh, const FrameField& field, const EdgeRing& ring, VertexId a, VertexId b);

/// A fan of tets around a -> b between two consecutive feature faces.
struct Sector {
  std::vector<TetId> tets;            ///< counter-clockwise
  std::vector<HalfFaceId> crossings;  ///< half-faces between consecutive tets: one less than tets
  HalfFaceId first;                   ///< feature half-face of the first tet
  HalfFaceId last;                    ///< feature half-face of the last tet
  int quads = 0;                      ///< number of quad sectors, or undetermined_code
  double dihedral = 0;                ///< radians
};

/// The sectors around a -> b; boundary faces always bound one. Empty for an inner edge without feature faces.
std::vector<Sector> sectors(const TetMesh& mesh, const Features& features, const FrameField& field,
                            const EdgeRing& ring, VertexId a, VertexId b);

/// Code of any edge: boundary edges have the sum of their sectors minus 2.
EdgeCode edge_code(const TetMesh& mesh, const Features& features, const FrameField& field, const EdgeRing& ring,
                   VertexId a, VertexId b);

/// Signed axis, in the chart of the first tet of the ring of a -> b, along which the arc leaves: the a with
/// monodromy = R_a(-2 pi I), I = -code / 4. For half-turns the sign comes from geometry. Needs an axial,
/// non-identity monodromy, else no_label.
octahedral::Label outgoing_label(const TetMesh& mesh, const FrameField& field, const EdgeRing& ring, EdgeCode code,
                                 VertexId a, VertexId b);

/// Every edge with its smallest tet, ordered by key.
std::vector<std::pair<EdgeKey, TetId>> all_edges(const TetMesh& mesh);

/// The edges of these tets with the smallest of the tets that has each, ordered by key.
std::vector<std::pair<EdgeKey, TetId>> edges_with_tets(const TetMesh& mesh, std::span<const TetId> tets);

/// Codes of all edges. The order of the map and the codes do not depend on the number of threads.
EdgeCodes compute_codes(const TetMesh& mesh, const Features& features, const FrameField& field);

}  // namespace hexfield
