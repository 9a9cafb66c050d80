#pragma once

#include <optional>
#include <vector>

#include "hexfield/repair/ring_search.hpp"
#include "hexfield/repair/zipping.hpp"

namespace hexfield {

/// The fan of triangles that unzips the arc of path.from: Z = (v, h_i, h_i+1) over a chain on the link of v from
/// path.from to path.to or to the boundary (Liu and Bommes 2023, Fig. 16; spec-lmff section 5.2).
struct RingPatch {
  ZipPatch patch;
  std::vector<VertexId> chain;  ///< first: path.from; last: path.to or a vertex of the boundary
};

/// On an isolated star every tet is a triangle of the link and the path a strip of them, so handles need no cutting:
/// the chain runs through vertices of the strip that are nothing special, where it can, and else through the middles
/// of the crossed edges of the link, which are split (P_s in the paper). A chain of a parabolic sector has an inner
/// vertex. Nothing when the strip leaves no way or the path crosses something special; then the state is as it was.
std::optional<RingPatch> ring_patch(RepairState& state, VertexId v, const RingPath& path, Flow flow);

}  // namespace hexfield
