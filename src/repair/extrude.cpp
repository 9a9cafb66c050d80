#include "extrude.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>

#include "hexfield/base/error.hpp"
#include "hexfield/mesh/quality.hpp"
#include "hexfield/repair/state_ops.hpp"

namespace hexfield {
namespace {

// How far below its old place a vertex may go, in mean edge lengths at it; the best one is taken.
constexpr std::array<double, 6> depths = {0.4, 0.25, 0.15, 0.08, 0.04, 0.02};

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// The values of the new tet t on the former face h of the surface; local 3 is the cover.
void take_values(RepairState& state, TetId t, HalfFaceId h, VertexId v) {
  const auto crossing = state.field.matching(h);
  const Quaternion frame = state.field.frames[h.tet().index()];
  state.field.frames.push_back(frame);
  state.field.matchings.emplace_back();
  state.field.matchings.back().fill(octahedral::identity);
  if (const HalfFaceId beyond = state.mesh.opposite_half_face(h); beyond.valid()) {
    const HalfFaceId outer(t, state.mesh.local_index(t, v));
    state.mesh.opposite[t.index()][at(outer.local())] = beyond;
    state.mesh.opposite[beyond.tet().index()][at(beyond.local())] = outer;
    state.field.matchings.back()[at(outer.local())] = crossing;
    state.field.matchings[h.tet().index()][at(h.local())] = octahedral::identity;
  }
  if (!state.features.tet_colours.empty()) {
    const int material = state.features.tet_colours[h.tet().index()];
    state.features.tet_colours.push_back(material);
  }
  const auto face = state.features.faces.find(state.mesh.key(h));
  if (face == state.features.faces.end()) return;
  const int colour = face->second;
  state.features.faces.erase(face);
  state.features.faces[state.mesh.key(HalfFaceId(t, state.mesh.local_index(t, v)))] = colour;
}

template <class Container>
void rename_end(Container& values, VertexId v, VertexId cover, VertexId end) {
  auto node = values.extract(edge_key(v, end));
  if (node.empty()) return;
  if constexpr (requires { node.mapped(); })
    values[edge_key(cover, end)] = node.mapped();
  else
    values.insert(edge_key(cover, end));
}

// Tets beyond the surface have the cover instead of v.
void go_over(RepairState& state, std::span<const TetId> beyond, VertexId v, VertexId cover) {
  std::set<VertexId> ends;
  for (TetId t : beyond) {
    ends.insert(state.mesh.vertices(t).begin(), state.mesh.vertices(t).end());
    std::ranges::replace(state.mesh.tets[t.index()], v, cover);
  }
  for (TetId t : vertex_star(state.mesh, v))
    for (VertexId w : state.mesh.vertices(t)) ends.erase(w);
  for (VertexId end : ends) {
    rename_end(state.codes, v, cover, end);
    rename_end(state.pairs, v, cover, end);
    rename_end(state.kept, v, cover, end);
  }
}

double worst_at(const TetMesh& mesh, VertexId v) {
  double worst = 0;
  for (TetId t : vertex_star(mesh, v)) worst = std::max(worst, tet_distortion(mesh, t));
  return worst;
}

}  // namespace

std::vector<HalfFaceId> boundary_faces_at(const TetMesh& mesh, VertexId v) {
  std::vector<HalfFaceId> faces;
  for (TetId t : vertex_star(mesh, v))
    for (int f = 0; f < 4; ++f)
      if (const HalfFaceId h(t, f); mesh.is_boundary(h) && mesh.vertices(t)[at(f)] != v) faces.push_back(h);
  return faces;
}

VertexId extrude_vertex(RepairState& state, VertexId v, std::span<const HalfFaceId> faces,
                        std::span<const TetId> beyond) {
  TetMesh& mesh = state.mesh;
  const VertexId cover(static_cast<std::int64_t>(mesh.num_vertices()));
  const Vec3 place = mesh.point(v);
  mesh.points.push_back(place);
  mesh.vertex_tet.emplace_back(static_cast<std::int64_t>(mesh.num_tets()));
  const double length = state.target_length[v.index()];
  state.target_length.push_back(length);
  std::map<VertexId, HalfFaceId> open;  // faces (v, cover, w) that have one tet so far
  for (HalfFaceId h : faces) {
    const TetId t(static_cast<std::int64_t>(mesh.num_tets()));
    const auto below = mesh.face_vertices(h);
    mesh.tets.push_back({below[0], below[1], below[2], cover});
    mesh.opposite.emplace_back();
    take_values(state, t, h, v);
    mesh.opposite[t.index()][3] = h;
    mesh.opposite[h.tet().index()][at(h.local())] = HalfFaceId(t, 3);
    for (int i = 0; i < 3; ++i) {
      if (below[at(i)] == v) continue;
      const HalfFaceId side(t, i);
      const VertexId next = below[at((i + 1) % 3)], after = below[at((i + 2) % 3)];
      const auto [entry, first] = open.emplace(next == v ? after : next, side);
      if (first) continue;
      const HalfFaceId other = entry->second;
      mesh.opposite[t.index()][at(i)] = other;
      mesh.opposite[other.tet().index()][at(other.local())] = side;
      open.erase(entry);
    }
  }
  require(!faces.empty() && open.empty(), "The faces at a vertex to extrude are no disc around it.");
  mesh.vertex_tet[v.index()] = faces.front().tet();
  go_over(state, beyond, v, cover);
  return cover;
}

bool move_below(RepairState& state, VertexId v, std::span<const HalfFaceId> covered) {
  const Vec3 before = state.mesh.point(v);
  Vec3 inward = Vec3::Zero(), middle = Vec3::Zero();
  double length = 0;
  for (HalfFaceId h : covered) inward -= outward_normal(state.mesh, h);
  const auto edges = edges_at(state.mesh, v);
  for (const EdgeKey& e : edges) {
    const Vec3 arm = state.mesh.point(other_end(e, v)) - before;
    middle += arm;
    length += arm.norm() / static_cast<double>(edges.size());
  }
  double best = std::numeric_limits<double>::infinity();
  Vec3 place = before;
  for (const Vec3& direction : {inward, middle, Vec3(inward.normalized() + middle.normalized())})
    for (double depth : depths) {
      if (!(direction.norm() > 0)) continue;
      state.mesh.points[v.index()] = before + depth * length * direction.normalized();
      if (const double worst = worst_at(state.mesh, v); worst < best) best = worst, place = state.mesh.point(v);
    }
  state.mesh.points[v.index()] = place;
  return best < std::numeric_limits<double>::infinity();
}

}  // namespace hexfield
