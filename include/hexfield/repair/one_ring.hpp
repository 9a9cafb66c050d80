#pragma once

#include <array>
#include <unordered_map>
#include <vector>

#include "hexfield/repair/repair_state.hpp"

/// The tets at one vertex as the repair of vertices sees them (spec-lmff section 5.3). Nothing here is collective.
namespace hexfield {

/// A singular or feature edge at the centre of a one-ring.
struct Spoke {
  VertexId end;
  EdgeKey edge{};
  EdgeCode code = 0;
  bool feature = false;     ///< tagged as feature edge
  bool boundary = false;    ///< on the boundary of the domain
  bool in_surface = false;  ///< lies in a feature face
  std::vector<TetId> tets;  ///< around centre -> end, counter-clockwise
  /// Outgoing label (spec-lmff section 3) in the chart of each of these tets; for edges whose monodromy has no axis of
  /// its own the label that runs along the edge and is perpendicular to the feature faces. Empty when there is none.
  std::vector<octahedral::Label> labels;

  /// No label in this tet: no_label.
  octahedral::Label label_in(TetId t) const;
  /// A singular arc that is no feature and lies in no feature face.
  bool free_arc() const { return code != 0 && !feature && !in_surface; }
};

/// A sector of a feature surface at the centre, between two consecutive spokes that lie in it, on one side of it.
struct SurfaceSector {
  VertexId first, last;           ///< ends of the spokes; equal when one spoke bounds the sector on both sides
  std::vector<HalfFaceId> faces;  ///< half-faces of the side, counter-clockwise about the outward normal
  double angle = 0;               ///< radians
  int quads = 0;                  ///< number of quad sectors, or undetermined_code
};

/// The tets at a vertex, their regions and spokes. A view of the state as it was: worthless after changes.
class OneRing {
 public:
  /// Takes frames aligned to features and singular edges (20 sweeps in these tets); the state itself stays.
  OneRing(RepairState& state, VertexId centre);

  VertexId centre() const { return centre_; }
  const std::vector<TetId>& tets() const { return tets_; }      ///< ascending
  const std::vector<Spoke>& spokes() const { return spokes_; }  ///< ascending by end
  const Spoke* spoke(VertexId end) const;                       ///< null when the edge there is regular
  /// Place of a tet among tets(); -1 when it is not at the centre.
  int index(TetId t) const;
  /// The spokes that tet index(t) is at, by place among spokes(), with their labels there (those that have labels).
  const std::vector<std::pair<std::size_t, octahedral::Label>>& labels_at(int tet_index) const {
    return labels_at_[static_cast<std::size_t>(tet_index)];
  }
  /// Regions are the parts of the one-ring that feature faces separate; numbered from 0.
  int region(TetId t) const { return region_[static_cast<std::size_t>(index(t))]; }
  /// World direction of a label of a tet in the aligned frames.
  Vec3 axis(TetId t, octahedral::Label label) const;
  const Quaternion& frame(TetId t) const { return frames_[static_cast<std::size_t>(index(t))]; }

 private:
  VertexId centre_;
  std::vector<TetId> tets_;
  std::unordered_map<TetId, int> index_;
  std::vector<int> region_;
  std::vector<Quaternion> frames_;
  std::vector<Spoke> spokes_;
  std::vector<std::vector<std::pair<std::size_t, octahedral::Label>>> labels_at_;
};

/// The label that runs along an edge in the first tet of its ring: fixed by the monodromy, perpendicular to the
/// normals of the feature faces there and closest to the edge; no_label when there is none.
octahedral::Label label_along(const RepairState& state, const EdgeRing& ring, VertexId a, VertexId b);

/// All sectors of feature surfaces at the centre, ordered by their first half-face.
std::vector<SurfaceSector> surface_sectors(const RepairState& state, const OneRing& ring);

/// Splits edges and faces at v until all singularities and features among its tets are edges, faces or the
/// vertex v itself, none on the link (isolation; Liu and Bommes 2023 section 5, spec-lmff section 1). Returns the
/// number of splits. It only refines.
int isolate_star(RepairState& state, VertexId v);

}  // namespace hexfield
