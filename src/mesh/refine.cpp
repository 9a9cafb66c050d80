#include "hexfield/mesh/refine.hpp"

#include <fmt/format.h>

#include <limits>

#include "hexfield/mesh/edge_table.hpp"

namespace hexfield {
namespace {

using Tet = std::array<VertexId, 4>;

// A diagonal of the octahedron of the edge midpoints (numbered as tet_edge_vertices) and the four midpoints
// around it, such that (end 0, end 1, around[k], around[k + 1]) is positive.
struct Diagonal {
  std::array<std::size_t, 2> ends;
  std::array<std::size_t, 4> around;
};
constexpr std::array<Diagonal, 3> diagonals = {
    {{{0, 5}, {1, 2, 4, 3}}, {{1, 4}, {2, 0, 3, 5}}, {{2, 3}, {0, 1, 5, 4}}}};

// Decides between equally long diagonals without regard to rounding.
constexpr double margin = 1e-12;

class UniformRefinement {
 public:
  explicit UniformRefinement(const TetMesh& mesh) : mesh_(mesh), edges_(mesh), points_(mesh.points) {
    points_.resize(mesh.num_vertices() + edges_.num_edges());
    edges_.for_each([&](std::size_t i, const EdgeKey& e) {
      points_[mesh.num_vertices() + i] = (mesh.point(e[0]) + mesh.point(e[1])) / 2;
    });
  }

  VertexId midpoint(VertexId a, VertexId b) const {
    return VertexId(static_cast<std::int64_t>(mesh_.num_vertices()) + edges_.find(a, b));
  }

  void append_children(const Tet& v, std::vector<Tet>& tets) const {
    std::array<VertexId, 6> m;
    for (std::size_t e = 0; e < 6; ++e)
      m[e] = midpoint(v[static_cast<std::size_t>(tet_edge_vertices[e][0])],
                      v[static_cast<std::size_t>(tet_edge_vertices[e][1])]);
    tets.insert(
        tets.end(),
        {{v[0], m[0], m[1], m[2]}, {m[0], v[1], m[3], m[4]}, {m[1], m[3], v[2], m[5]}, {m[2], m[4], m[5], v[3]}});
    const Diagonal& d = shortest_diagonal(m);
    for (std::size_t k = 0; k < 4; ++k)
      tets.push_back({m[d.ends[0]], m[d.ends[1]], m[d.around[k]], m[d.around[(k + 1) % 4]]});
  }

  std::vector<Vec3> take_points() { return std::move(points_); }

 private:
  const Diagonal& shortest_diagonal(const std::array<VertexId, 6>& m) const {
    std::size_t best = 0;
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < diagonals.size(); ++i) {
      const auto& [a, b] = diagonals[i].ends;
      const double length = (points_[m[a].index()] - points_[m[b].index()]).norm();
      if (length < shortest * (1 - margin)) best = i, shortest = length;
    }
    return diagonals[best];
  }

  const TetMesh& mesh_;
  EdgeTable edges_;
  std::vector<Vec3> points_;
};

Features refined_features(const UniformRefinement& refinement, const Features& features) {
  Features refined;
  refined.points = features.points;
  refined.names = features.names;
  for (const auto& [e, colour] : features.edges) {
    const VertexId m = refinement.midpoint(e[0], e[1]);
    for (VertexId end : e) refined.edges[edge_key(end, m)] = colour;
  }
  for (const auto& [f, colour] : features.faces) {
    const VertexId a = refinement.midpoint(f[1], f[2]);
    const VertexId b = refinement.midpoint(f[0], f[2]);
    const VertexId c = refinement.midpoint(f[0], f[1]);
    for (const FaceKey& child : {face_key(f[0], b, c), face_key(f[1], a, c), face_key(f[2], a, b), face_key(a, b, c)})
      refined.faces[child] = colour;
  }
  refined.tet_colours.reserve(8 * features.tet_colours.size());
  for (int colour : features.tet_colours) refined.tet_colours.insert(refined.tet_colours.end(), 8, colour);
  return refined;
}

}  // namespace

void refine_uniform(TetMesh& mesh, Features& features) {
  constexpr std::size_t max_tets = std::numeric_limits<std::int32_t>::max() / 4;
  if (mesh.num_tets() > max_tets / 8)
    throw Error(ExitCode::bad_input, fmt::format("{} tets cannot be refined: eight times as many are more than the {} "
                                                 "that one process can hold.",
                                                 mesh.num_tets(), max_tets));
  for (const Tet& tet : mesh.tets) require(tet[0].valid(), "A mesh with tombstones cannot be refined.");
  UniformRefinement refinement(mesh);
  Features refined = refined_features(refinement, features);
  std::vector<Tet> tets;
  tets.reserve(8 * mesh.num_tets());
  for (const Tet& tet : mesh.tets) refinement.append_children(tet, tets);
  mesh = build_tet_mesh(refinement.take_points(), std::move(tets));
  features = std::move(refined);
}

}  // namespace hexfield
