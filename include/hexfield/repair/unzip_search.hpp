#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "hexfield/repair/repair_state.hpp"

/// Flow-guided dual path search (paper section 5.2, "Resolving Zipper Vertices"; spec-lmff section 5.6, "Unzip
/// search"): from a zipper node along the field to where the zipper comes apart. Reads only, so that many searches
/// can run at the same time. Nothing here is collective.
namespace hexfield {

struct UnzipSearchOptions {
  double deviation = 100;       ///< s in d^2 = u^2 + s (v^2 + w^2): price of leaving the streamline
  double smallest_dot = -0.09;  ///< outward face normal . axis of u, for a step (95 degrees)
  double partner_bonus = 2.0;   ///< a partner is preferred to a boundary that is nearer by up to this factor ...
  double partner_slack = 1.1;   ///< ... and this one
};

/// Where a search starts: a tet, the label u of its chart that the path follows, and the edge that the strip starts
/// with; coordinates are measured from `origin`.
struct UnzipSeed {
  TetId tet;
  octahedral::Label u = octahedral::no_label;
  EdgeKey edge{};
  VertexId origin;
  Vec3 side = Vec3::Zero();  ///< direction in space, at the seed, that the strip should have across
};

/// An edge at an anti-parallel zipper node, seen from a tet around it: reached by a path whose label is `u`.
struct UnzipPartner {
  VertexId node;
  EdgeKey edge{};  ///< no edge: the node as such
  octahedral::Label u = octahedral::no_label;
};
using UnzipPartners = std::multimap<TetId, UnzipPartner>;

struct UnzipPath {
  UnzipSeed seed;
  std::vector<TetId> tets;              ///< from seed.tet
  std::vector<FaceKey> faces;           ///< between them; at a boundary goal the boundary face comes last
  std::vector<Vec3> side;               ///< per face: seed.side carried along by the field, perpendicular to u
  std::optional<UnzipPartner> partner;  ///< the goal, unless it is the boundary
  double distance = 0;                  ///< of the last tet
};

/// Expands tets by distance d in coordinates integrated along the path, each once, until one has a boundary face
/// whose outward normal label is u, or an edge of a partner that is not in `consumed`. Feature faces are crossed
/// only where their normal label is u; faces in `blocked` never. Ties by tet id.
std::optional<UnzipPath> find_unzip_path(const RepairState& state, std::span<const UnzipSeed> seeds,
                                         const UnzipPartners& partners, const std::set<FaceKey>& blocked,
                                         const std::set<VertexId>& consumed, const UnzipSearchOptions& options = {});

}  // namespace hexfield
