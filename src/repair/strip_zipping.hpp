#pragma once

#include "hexfield/field/singularity_graph.hpp"
#include "hexfield/repair/guides.hpp"
#include "hexfield/repair/strip.hpp"
#include "hexfield/repair/zipper_nodes.hpp"

/// Zipping of strips with a test of what came out; shared by all ways to unzip.
namespace hexfield {

NodeKind kind_of(const RepairState& state, VertexId v);

/// Neither regular nor an arc nor an admissible node.
bool is_defect(const RepairState& state, VertexId v);

/// A quarter-turn that gives an edge a code, as zip_patch() wants it.
struct ZipTarget {
  EdgeKey start{};
  octahedral::Rotation monodromy = octahedral::identity;
};

/// The target that gives the regular edge from -> to the code +1 or -1 with the outgoing label `label` of the chart of
/// `tet`, a tet at `from`. Nothing when the edge is not in the same region of the star of `from`.
std::optional<ZipTarget> code_target(const RepairState& state, VertexId from, VertexId to, TetId tet,
                                     octahedral::Label label, EdgeCode code);

/// Zips, gives the inner edges of the first side the code `first_code`, those of the second its opposite, and both one
/// new pair id, marks edges on features as kept, and smooths with these signs. Undone (false) unless there are fewer
/// defects at the vertices of the strip than before.
bool zip_strip(RepairState& state, const Strip& strip, const ZipTarget& target, EdgeCode first_code,
               const ZipperOptions& options);

}  // namespace hexfield
