#include <fmt/format.h>

#include <cmath>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/field/singularity_graph.hpp"

namespace hexfield {
namespace {

std::string at(const Vec3& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x(), p.y(), p.z()); }

Defect edge_defect(const TetMesh& mesh, const EdgeKey& e, const std::string& what) {
  const Vec3 middle = (mesh.point(e[0]) + mesh.point(e[1])) / 2;
  return {fmt::format("The edge of vertices {} and {} at {} {}.", e[0].value, e[1].value, at(middle), what),
          {e[0], e[1]},
          {mesh.point(e[0]), mesh.point(e[1])}};
}

void judge_code(const TetMesh& mesh, const EdgeKey& e, EdgeCode code, std::vector<Defect>& found) {
  if (code == compound_code) found.push_back(edge_defect(mesh, e, "turns the frame about two axes at once"));
  if (code == undetermined_code) found.push_back(edge_defect(mesh, e, "runs across its own rotation axis"));
  if (code <= -4) found.push_back(edge_defect(mesh, e, "leaves no room for a quad around it"));
}

void judge_sectors(const TetMesh& mesh, const Features& features, const FrameField& field, const EdgeKey& e, TetId seed,
                   std::vector<Defect>& found) {
  const EdgeRing ring = edge_ring(mesh, seed, e[0], e[1]);
  for (const Sector& s : sectors(mesh, features, field, ring, e[0], e[1])) {
    const double degrees = s.dihedral * 180 / M_PI;
    if (s.quads == undetermined_code)
      found.push_back(
          edge_defect(mesh, e, fmt::format("has a sector of {:.3g} degrees whose frames fit no edge axis", degrees)));
    else if (s.quads < 1)
      found.push_back(
          edge_defect(mesh, e, fmt::format("has a sector of {:.3g} degrees that no hex can fill", degrees)));
  }
}

std::string counts_of(const EdgeCounts& n) {
  return fmt::format(
      "{} convex and {} concave edges on the surface, {} inner edges of index +1/4 and {} of index -1/4, {} others",
      n.boundary_minus, n.boundary_plus, n.inner_minus, n.inner_plus, n.other);
}

}  // namespace

std::vector<Defect> find_defects(const TetMesh& mesh, const Features& features, const FrameField& field,
                                 const EdgeCodes& codes) {
  std::vector<Defect> found;
  for (const auto& [e, code] : codes) judge_code(mesh, e, code, found);
  for (const auto& [edge, tet] : all_edges(mesh)) {
    const auto code = codes.find(edge);
    const bool special = code != codes.end() || features.edges.count(edge) != 0;
    if (special && (code == codes.end() || code->second != undetermined_code))
      judge_sectors(mesh, features, field, edge, tet, found);
  }
  for (const SingularNode& n : singularity_graph(mesh, features, field, codes).nodes) {
    const Vec3& p = mesh.point(n.vertex);
    if (n.kind == NodeKind::zipper)
      found.push_back({fmt::format("Two parallel singular arcs of opposite index meet, or one meets the surface with "
                                   "reversed flow, at vertex {} at {}.",
                                   n.vertex.value, at(p)),
                       {n.vertex},
                       {p}});
    if (n.kind == NodeKind::invalid)
      found.push_back({fmt::format("The singular edges at vertex {} at {} belong to no hex mesh: {}.", n.vertex.value,
                                   at(p), counts_of(n.counts)),
                       {n.vertex},
                       {p}});
  }
  return found;
}

}  // namespace hexfield
