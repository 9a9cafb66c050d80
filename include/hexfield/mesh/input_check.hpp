#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "hexfield/mesh/features.hpp"
#include "hexfield/mesh/tet_mesh.hpp"

namespace hexfield {

/// How the file calls an entity (sentences and ids of violations use these); empty: its index.
struct InputIds {
  std::function<std::int64_t(std::int64_t)> vertex;
  std::function<std::int64_t(std::int64_t)> tet;
};

/// When every tet is negative (volume well below zero), reverses all of them and returns true: the file
/// uses the other orientation. Anything else is left to check_input().
/// Ids out of range are left alone.
bool orient_if_all_inverted(const std::vector<Vec3>& points, std::vector<std::array<VertexId, 4>>& tets);

/// Every defect of raw tets and features before build_tet_mesh(), the gravest kinds first:
///  * no tets; more tets than 32-bit half-faces can count; coordinates that are not finite or beyond 1e100;
///    vertex ids out of range; a vertex twice in a tet (these end the check);
///  * tets that are flat (6 volumes of at most 1e-14 times the cube of the longest edge) or inverted;
///    two tets of the same vertices; faces in three tets; overlapping tets at the same side of a face;
///  * cracks: boundary vertices that coincide, or that lie inside a boundary face or edge without being a
///    corner of it (hanging), within 1e-10 of the face's longest edge;
///  * a wrong number of tet colours; feature points, edges and faces that are no entities of tets.
/// Unused points, several components and non-manifold boundaries are legal. At most 1000 of a kind are
/// listed; the sentence of the last one then says how many more there are. Not collective.
std::vector<Violation> check_input(const std::vector<Vec3>& points, const std::vector<std::array<VertexId, 4>>& tets,
                                   const Features& features, const InputIds& ids = {});

/// Throws Error(bad_input) with the first violation, `source` (a file) before it and their number behind it.
void require_valid_input(const std::string& source, const std::vector<Violation>& violations);

}  // namespace hexfield
