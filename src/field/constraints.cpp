#include "hexfield/field/constraints.hpp"

#include <algorithm>
#include <cmath>

#include "hexfield/field/edge_codes.hpp"

namespace hexfield {

using octahedral::Label;

namespace {

// The label of a feature edge in the first tet of the ring: consistent around the ring, perpendicular to
// the normals of all feature faces at the edge, and closest to e on average; no_label when there is none.
Label feature_edge_label(const TetMesh& mesh, const Features& features, const FrameField& field, const EdgeRing& ring,
                         const Vec3& e) {
  const auto m = monodromy(field, ring);
  std::vector<std::pair<std::size_t, Label>> normals;  // position in the ring, label of the normal there
  auto note_normal = [&](std::size_t k, HalfFaceId h) {
    if (mesh.is_boundary(h) || features.faces.count(mesh.key(h)) != 0)
      normals.emplace_back(k, closest_label(field.frames[ring.tets[k].index()], outward_normal(mesh, h)));
  };
  if (!ring.closed) note_normal(0, ring.first_boundary);
  for (std::size_t k = 0; k < ring.tets.size(); ++k) note_normal(k, ring.crossings[k]);
  Label best = octahedral::no_label;
  double most = 0;
  for (Label start = 0; start < 6; ++start) {
    if (octahedral::image(m, start) != start) continue;
    const auto labels = transport_around(field, ring, start);
    const bool parallel = std::any_of(normals.begin(), normals.end(), [&](const auto& n) {
      return octahedral::axis(labels[n.first]) == octahedral::axis(n.second);
    });
    if (parallel) continue;
    double dot = 0;
    for (std::size_t k = 0; k < ring.tets.size(); ++k)
      dot += (field.frames[ring.tets[k].index()] * octahedral::direction(labels[k])).dot(e);
    if (dot > most + 1e-9) best = start, most = dot;
  }
  return best;
}

void add_edge(const TetMesh& mesh, const FrameField& field, const EdgeRing& ring, EdgeKey edge, Label start,
              AxisConstraint::Kind kind, std::vector<AxisConstraint>& found) {
  if (start == octahedral::no_label) return;
  const Vec3 e = (mesh.point(edge[1]) - mesh.point(edge[0])).normalized();
  const auto labels = transport_around(field, ring, start);
  for (std::size_t k = 0; k < ring.tets.size(); ++k)
    found.push_back({ring.tets[k], labels[k], e, kind, HalfFaceId(), edge});
}

void add_faces(const TetMesh& mesh, const Features& features, const FrameField& field, TetId t,
               std::vector<AxisConstraint>& found) {
  for (int f = 0; f < 4; ++f) {
    const HalfFaceId h(t, f);
    if (!mesh.is_boundary(h) && features.faces.count(mesh.key(h)) == 0) continue;
    const Vec3 n = outward_normal(mesh, h);
    found.push_back({t, closest_label(field.frames[t.index()], n), n, AxisConstraint::Kind::feature_face, h});
  }
}

void add_feature_edge(const TetMesh& mesh, const Features& features, const FrameField& field, const EdgeKey& edge,
                      TetId seed, std::vector<AxisConstraint>& found) {
  const EdgeRing ring = edge_ring(mesh, seed, edge[0], edge[1]);
  const Vec3 e = (mesh.point(edge[1]) - mesh.point(edge[0])).normalized();
  add_edge(mesh, field, ring, edge, feature_edge_label(mesh, features, field, ring, e),
           AxisConstraint::Kind::feature_edge, found);
}

void add_singular_edge(const TetMesh& mesh, const Features& features, const FrameField& field, const EdgeKey& edge,
                       EdgeCode code, TetId seed, std::vector<AxisConstraint>& found) {
  const EdgeRing ring = edge_ring(mesh, seed, edge[0], edge[1]);
  const Vec3 e = (mesh.point(edge[1]) - mesh.point(edge[0])).normalized();
  const Label label = ring.closed ? outgoing_label(mesh, field, ring, code, edge[0], edge[1])
                                  : feature_edge_label(mesh, features, field, ring, e);
  add_edge(mesh, field, ring, edge, label, AxisConstraint::Kind::singular_edge, found);
}

void order(std::vector<AxisConstraint>& found) {
  std::stable_sort(found.begin(), found.end(),
                   [](const AxisConstraint& a, const AxisConstraint& b) { return a.tet < b.tet; });
}

}  // namespace

std::vector<AxisConstraint> collect_constraints(const TetMesh& mesh, const Features& features, const FrameField& field,
                                                const EdgeCodes& codes) {
  std::vector<AxisConstraint> found;
  for (std::size_t i = 0; i < mesh.num_tets(); ++i)
    if (const TetId t(static_cast<std::int64_t>(i)); mesh.alive(t)) add_faces(mesh, features, field, t, found);
  for (const auto& entry : features.edges)
    if (const TetId seed = find_tet_with_edge(mesh, entry.first[0], entry.first[1]); seed.valid())
      add_feature_edge(mesh, features, field, entry.first, seed, found);
  for (const auto& [edge, code] : codes) {
    if (features.edges.count(edge) != 0 || code == compound_code) continue;
    add_singular_edge(mesh, features, field, edge, code, find_tet_with_edge(mesh, edge[0], edge[1]), found);
  }
  order(found);
  return found;
}

std::vector<AxisConstraint> collect_constraints_of(const TetMesh& mesh, const Features& features,
                                                   const FrameField& field, const EdgeCodes& codes,
                                                   std::span<const TetId> tets, SingularSign sign) {
  std::vector<AxisConstraint> found;
  for (TetId t : tets) add_faces(mesh, features, field, t, found);
  const auto edges = edges_with_tets(mesh, tets);
  for (const auto& [edge, tet] : edges)
    if (features.edges.count(edge) != 0) add_feature_edge(mesh, features, field, edge, tet, found);
  for (const auto& [edge, tet] : edges) {
    const auto code = codes.find(edge);
    if (code == codes.end() || code->second == compound_code || features.edges.count(edge) != 0) continue;
    const bool geometry = sign == SingularSign::by_geometry;
    add_singular_edge(mesh, features, field, edge, geometry ? undetermined_code : code->second, tet, found);
  }
  std::erase_if(found, [&](const AxisConstraint& c) { return !std::binary_search(tets.begin(), tets.end(), c.tet); });
  order(found);
  return found;
}

}  // namespace hexfield
