#include "singular_vertices.hpp"

#include <algorithm>
#include <cstdlib>

#include "hexfield/base/parallel.hpp"
#include "hexfield/repair/state_ops.hpp"

namespace hexfield {
namespace {

std::vector<SingularVertex> with_spokes(const RepairState& state) {
  struct End {
    VertexId vertex;
    SingularSpoke spoke;
  };
  std::vector<End> ends;
  ends.reserve(2 * state.codes.size());
  for (const auto& [e, code] : state.codes) {
    const bool feature = state.features.edges.contains(e);
    ends.push_back({e[0], {e[1], code, feature}});
    ends.push_back({e[1], {e[0], code, feature}});
  }
  std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) {
    return std::pair(a.vertex, a.spoke.end) < std::pair(b.vertex, b.spoke.end);
  });
  std::vector<SingularVertex> vertices;
  for (const End& end : ends) {
    if (vertices.empty() || vertices.back().vertex != end.vertex) vertices.emplace_back().vertex = end.vertex;
    vertices.back().spokes.push_back(end.spoke);
  }
  return vertices;
}

// Feature faces at a vertex: sum of their normals, all turned to the side of the first.
struct SurfaceAt {
  bool any = false, artificial = false;
  int colour = 0;
  Vec3 normal{0, 0, 0};
};

SurfaceAt surface_at(const RepairState& state, VertexId v) {
  SurfaceAt s;
  for (TetId t : vertex_star(state.mesh, v))
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(t, f);
      if (state.mesh.vertices(t)[static_cast<std::size_t>(f)] == v) continue;
      const HalfFaceId o = state.mesh.opposite_half_face(h);
      if (o.valid() && o < h) continue;
      const auto found = state.features.faces.find(state.mesh.key(h));
      if (found == state.features.faces.end()) {
        s.artificial |= !o.valid();
        continue;
      }
      const Vec3 n = outward_normal(state.mesh, h);
      s.normal += n.dot(s.normal) < 0 ? Vec3(-n) : n;
      s.colour = found->second;
      s.any = true;
    }
  return s;
}

void find_place(const RepairState& state, SingularVertex& v) {
  using Place = SingularVertex::Place;
  if (state.features.points.contains(v.vertex)) return;
  const SurfaceAt surface = surface_at(state, v.vertex);
  if (surface.artificial) return;
  std::vector<EdgeKey> curve = edges_at(state.mesh, v.vertex);
  std::erase_if(curve, [&](const EdgeKey& e) { return !state.features.edges.contains(e); });
  if (!curve.empty()) {
    const bool arc_inside = std::any_of(v.spokes.begin(), v.spokes.end(), [](const auto& s) { return !s.feature; });
    if (curve.size() != 2 || !arc_inside) return;
    const auto other = [&](const EdgeKey& e) { return e[0] == v.vertex ? e[1] : e[0]; };
    const Vec3& p = state.mesh.point(v.vertex);
    v.direction =
        (p - state.mesh.point(other(curve[0]))).normalized() + (state.mesh.point(other(curve[1])) - p).normalized();
    if (v.direction.norm() < 1e-6) return;
    v.place = Place::curve;
    v.colour = state.features.edges.at(curve[0]);
  } else if (surface.any) {
    v.direction = surface.normal;
    if (v.direction.norm() < 1e-6) return;
    v.place = Place::surface;
    v.colour = surface.colour;
  } else {
    v.place = Place::inside;
    return;
  }
  v.direction.normalize();
}

}  // namespace

bool SingularVertex::is_zipper() const {
  return spokes.size() == 2 && std::abs(spokes[0].code) == 1 && spokes[0].code + spokes[1].code == 0;
}

RelocationEnergy::Freedom SingularVertex::freedom() const {
  RelocationEnergy::Freedom f;
  if (place == Place::inside) f.dimensions = 3;
  if (place == Place::curve) f.dimensions = 1, f.basis.col(0) = direction;
  if (place == Place::surface) {
    f.dimensions = 2;
    f.basis.col(0) = direction.unitOrthogonal();
    f.basis.col(1) = direction.cross(f.basis.col(0));
  }
  return f;
}

std::vector<SingularVertex> singular_vertices(const RepairState& state, const std::function<bool(VertexId)>& may_move) {
  std::vector<SingularVertex> vertices = with_spokes(state);
  parallel_for(vertices.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (!may_move || may_move(vertices[i].vertex)) find_place(state, vertices[i]);
  });
  return vertices;
}

}  // namespace hexfield
