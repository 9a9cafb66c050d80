#pragma once

#include <vector>

#include "hexfield/field/singularity_graph.hpp"

namespace hexfield {

/// Kind of a vertex from the codes of its singular edges.
SingularNode classify_vertex(const TetMesh& mesh, const Features& features, const FrameField& field,
                             const EdgeCodes& codes, VertexId v, const std::vector<EdgeKey>& edges);

}  // namespace hexfield
