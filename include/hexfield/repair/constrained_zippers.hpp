#pragma once

#include <optional>
#include <vector>

#include "hexfield/repair/guides.hpp"
#include "hexfield/repair/strip.hpp"
#include "hexfield/repair/zipper_nodes.hpp"

/// Zipper nodes that features hold (paper section 4.4, "Resolving Non-Isolated and Feature-Constrained Zipper Nodes";
/// spec-lmff section 5.6). The strip runs along a guide: its first side stays on the feature curve and takes one
/// arc, the second goes through the inside. Nothing here is collective.
namespace hexfield {

/// The first side of a strip: vertices on a guide, then new vertices of a free path, to a transversal boundary or on to
/// the guide of a partner.
struct GuidedPath {
  std::vector<VertexId> vertices;
  std::size_t held = 0;       ///< so many lie on the guide
  std::size_t held_last = 0;  ///< so many last ones on that of the partner
  std::vector<Vec3> side;     ///< per vertex: the wanted side, carried along by the field
  VertexId exit;              ///< new vertex in the boundary face where a guide ends; invalid after a free path
};

/// A node whose own guide comes from the other side: where its way starts, along the label u of that tet, and the
/// boundary face there in which it starts.
struct GuidePartner {
  FlowPlace start;
  octahedral::Label u = octahedral::no_label;
  HalfFaceId face;
};

/// Follows u (label of start's tet) along feature curves and beyond, and inserts the path. Two nodes whose ways lead
/// towards each other need one way only: each by itself would want the line through the other's curve on another side.
/// Nothing, and nothing has changed, when no transversal boundary is reached. Vertices of feature edges may gain
/// singular edges.
std::optional<GuidedPath> lay_guided_path(RepairState& state, const FlowPlace& start, octahedral::Label u,
                                          const Vec3& side, const ZipperOptions& options,
                                          std::span<const GuidePartner> partners = {});

/// (T5 with S2) Transversal unzipping of a surface sector of the domain boundary that has no quad: two feature curves
/// leave v in parallel. A line of code +1 that starts at v and one of code -1 that starts inside the sector go
/// through the domain, along a guide if v has one, to a transversal boundary, or to such a sector of one of `others`;
/// the sector becomes a quad. False, and the field as it was, when no such way is found or more defects would come
/// about.
bool unzip_sector_transversally(RepairState& state, VertexId v, const ZipperOptions& options = {},
                                std::span<const VertexId> others = {});

/// Detaches the inner arc `edge` from the vertex v of the boundary, where it leaves v against the direction `u` in
/// which the boundary goes on: the arc goes on beside the guide, which takes its opposite. False as above.
bool unzip_along_guide(RepairState& state, VertexId v, const EdgeKey& edge, const ZipperOptions& options = {});

/// Both for all zipper nodes on feature curves, the first also for other bad nodes where feature curves meet, ascending
/// by vertex; what fails leaves no splits. Copies the state for each. Returns the number repaired.
int repair_constrained_zipper_nodes(RepairState& state, const ZipperOptions& options = {});

}  // namespace hexfield
