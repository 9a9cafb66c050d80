#pragma once

#include <span>
#include <vector>

#include "hexfield/repair/repair_state.hpp"

/// Discrete arc zipping [Z, A1, A2, dI] (Liu and Bommes 2023 section 5.2; spec-lmff section 5.1), the operation that
/// all repairs of edges and vertices are made of. Nothing here is collective.
namespace hexfield {

/// A disc of triangles whose matchings an arc zipping changes. Inner edges of the disc must be regular.
struct ZipPatch {
  std::vector<FaceKey> faces;     ///< Z: inner faces of the mesh
  EdgeKey start;                  ///< an edge of exactly one face of Z, whose monodromy becomes the target
  std::vector<EdgeKey> boundary;  ///< B, with the start: the edges that bound Z and may become or cease to be singular.
                                  ///< Edges of Z on the boundary of the domain need not be listed.
};

struct ZipOptions {
  int sweeps = 20;                  ///< of Algorithm 1 in the tets that touch Z (spec-lmff section 4: 20)
  bool allow_half_turns = false;    ///< may an edge get a half-turn (code 2 or -2) that it had not?
  bool allow_zero_sectors = false;  ///< may a sector at a feature face get empty that was not?
};

/// Monodromy of a -> b in the chart of the first tet of its ring. An open ring is closed through the outside such
/// that outward normals and edge axes fit (virtual closure): an edge of the boundary gives the quarter-turns of its
/// code about its axis, identity when flat. Inner edges: monodromy() of field/edge_codes.hpp.
octahedral::Rotation closed_monodromy(const RepairState& state, const EdgeRing& ring, VertexId a, VertexId b);

/// Turns the matchings of Z such that the oriented edge start[0] -> start[1] gets the monodromy `target`, in the
/// chart of the first tet of ring_of(start[0], start[1]) (see closed_monodromy), and all inner edges of Z the
/// identity. Frames of tets that touch Z are smoothed (signs by geometry) and codes brought up to date. The inverse
/// is the same patch with the old monodromy as target.
///
/// False, and the state is as it was, when Z leaves a matching undetermined, an inner edge does not get regular, or
/// an edge of Z gets compound, a code beyond +-1 or an empty sector at a feature face that it had not.
bool zip_patch(RepairState& state, const ZipPatch& patch, octahedral::Rotation target, const ZipOptions& options = {});

/// Number of empty sectors (quads < 1) at feature faces around an edge (spec-lmff section 3).
int empty_sectors(const RepairState& state, const EdgeKey& edge);

/// Alive tets that share a vertex with one of the faces, ascending: what zip_patch() may change.
std::vector<TetId> tets_touching(const TetMesh& mesh, std::span<const FaceKey> faces);

}  // namespace hexfield
