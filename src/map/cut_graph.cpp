#include "hexfield/map/cut_graph.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "edge_table.hpp"

namespace hexfield {
namespace {

using octahedral::Rotation;
using Matchings = std::vector<std::array<Rotation, 4>>;

std::size_t local(HalfFaceId h) { return static_cast<std::size_t>(h.local()); }

// Breadth-first tree; fills gauges and components and marks tree faces with patch 0, other inner faces with 1.
void comb(const TetMesh& mesh, const Matchings& matchings, CutGraph& cut) {
  const std::size_t n = mesh.num_tets();
  cut.gauges.assign(n, octahedral::identity);
  cut.components.assign(n, -1);
  cut.patches.assign(n, {0, 0, 0, 0});
  for (std::size_t i = 0; i < n; ++i)
    for (int f = 0; f < 4; ++f)
      if (!mesh.is_boundary(HalfFaceId(TetId(i), f))) cut.patches[i][static_cast<std::size_t>(f)] = 1;
  std::vector<TetId> queue;
  for (std::size_t seed = 0; seed < n; ++seed) {
    if (cut.components[seed] >= 0) continue;
    cut.components[seed] = cut.num_components;
    queue.assign(1, TetId(seed));
    for (std::size_t k = 0; k < queue.size(); ++k) {
      const TetId t = queue[k];
      for (int f = 0; f < 4; ++f) {
        const HalfFaceId h(t, f);
        const HalfFaceId o = mesh.opposite_half_face(h);
        if (!o.valid() || cut.components[o.tet().index()] >= 0) continue;
        cut.components[o.tet().index()] = cut.num_components;
        cut.gauges[o.tet().index()] =
            octahedral::product(octahedral::inverse(matchings[t.index()][local(h)]), cut.gauges[t.index()]);
        cut.patches[t.index()][local(h)] = cut.patches[o.tet().index()][local(o)] = 0;
        queue.push_back(o.tet());
      }
    }
    ++cut.num_components;
  }
}

void set_rotations(const TetMesh& mesh, const Matchings& matchings, CutGraph& cut) {
  cut.rotations.assign(mesh.num_tets(), {0, 0, 0, 0});
  for (std::size_t i = 0; i < mesh.num_tets(); ++i)
    for (std::size_t f = 0; f < 4; ++f) {
      const HalfFaceId o = mesh.opposite[i][f];
      if (!o.valid()) continue;
      const Rotation back = octahedral::inverse(cut.gauges[o.tet().index()]);
      cut.rotations[i][f] =
          octahedral::product(back, octahedral::product(octahedral::inverse(matchings[i][f]), cut.gauges[i]));
    }
}

// Around such an edge the only transition is that of its one cut face, thus the identity: that face is no cut.
void peel(const TetMesh& mesh, const MapEdges& edges, const std::set<EdgeKey>& singular, CutGraph& cut) {
  std::vector<std::pair<std::size_t, HalfFaceId>> incidence;
  for (std::size_t i = 0; i < mesh.num_tets(); ++i)
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(TetId(i), f);
      if (cut.patch(h) == 0 || h.value > mesh.opposite_half_face(h).value) continue;
      const auto v = mesh.face_vertices(h);
      for (std::size_t k = 0; k < 3; ++k) incidence.emplace_back(edges.id(v[k], v[(k + 1) % 3]), h);
    }
  std::sort(incidence.begin(), incidence.end());
  std::vector<std::size_t> start(edges.size() + 1, 0);
  for (const auto& [e, h] : incidence) ++start[e + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<char> fixed(edges.size(), 0);
  std::vector<std::size_t> count(edges.size());
  std::vector<std::size_t> queue;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    count[e] = start[e + 1] - start[e];
    fixed[e] = edges.on_boundary(e) || singular.contains(edges.key(e));
    if (count[e] == 1 && fixed[e] == 0) queue.push_back(e);
  }
  for (std::size_t k = 0; k < queue.size(); ++k) {
    const std::size_t e = queue[k];
    if (count[e] != 1) continue;
    for (std::size_t j = start[e]; j < start[e + 1]; ++j) {
      const HalfFaceId h = incidence[j].second;
      if (cut.patch(h) == 0) continue;
      if (cut.rotation(h) != octahedral::identity) break;
      const HalfFaceId o = mesh.opposite_half_face(h);
      cut.patches[h.tet().index()][local(h)] = cut.patches[o.tet().index()][local(o)] = 0;
      const auto v = mesh.face_vertices(h);
      for (std::size_t s = 0; s < 3; ++s) {
        const std::size_t other = edges.id(v[s], v[(s + 1) % 3]);
        if (--count[other] == 1 && fixed[other] == 0) queue.push_back(other);
      }
      break;
    }
  }
}

// The other face of tet t at edge (a, b), seen from face h of t.
HalfFaceId other_face(const TetMesh& mesh, HalfFaceId h, VertexId a, VertexId b) {
  const auto& v = mesh.vertices(h.tet());
  for (int f = 0; f < 4; ++f)
    if (f != h.local() && v[static_cast<std::size_t>(f)] != a && v[static_cast<std::size_t>(f)] != b)
      return HalfFaceId(h.tet(), f);
  return HalfFaceId();
}

// Turns around edge (a, b) from cut face h through its tet to the next cut face; invalid at the boundary.
HalfFaceId next_cut_face(const TetMesh& mesh, const CutGraph& cut, HalfFaceId h, VertexId a, VertexId b) {
  for (HalfFaceId f = other_face(mesh, h, a, b);; f = other_face(mesh, mesh.opposite_half_face(f), a, b)) {
    if (mesh.is_boundary(f)) return HalfFaceId();
    if (cut.patch(f) != 0) return f;
  }
}

void flood_patches(const TetMesh& mesh, const std::set<EdgeKey>& singular, CutGraph& cut) {
  for (auto& faces : cut.patches)
    for (auto& p : faces) p = p != 0 ? std::numeric_limits<std::int32_t>::max() : 0;
  auto unset = [&](HalfFaceId h) { return cut.patch(h) == std::numeric_limits<std::int32_t>::max(); };
  auto assign = [&](HalfFaceId h, std::int32_t p) {
    const HalfFaceId o = mesh.opposite_half_face(h);
    cut.patches[h.tet().index()][local(h)] = p;
    cut.patches[o.tet().index()][local(o)] = -p;
  };
  std::vector<HalfFaceId> queue;
  for (std::size_t i = 0; i < mesh.num_tets(); ++i)
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId seed(TetId(i), f);
      if (!unset(seed)) continue;
      const auto p = static_cast<std::int32_t>(++cut.num_patches);
      cut.patch_face.push_back(seed);
      assign(seed, p);
      queue.assign(1, seed);
      for (std::size_t k = 0; k < queue.size(); ++k) {
        const HalfFaceId h = queue[k];
        const auto v = mesh.face_vertices(h);
        for (std::size_t s = 0; s < 3; ++s) {
          const VertexId a = v[s];
          const VertexId b = v[(s + 1) % 3];
          if (singular.contains(edge_key(a, b))) continue;
          const HalfFaceId next = next_cut_face(mesh, cut, h, a, b);
          if (!next.valid() || next == h || !unset(next)) continue;
          // Exactly two cut faces: from the back side one meets the same face.
          const HalfFaceId behind = next_cut_face(mesh, cut, mesh.opposite_half_face(h), a, b);
          if (!behind.valid() || behind != mesh.opposite_half_face(next)) continue;
          if (cut.rotation(next) != cut.rotation(h)) continue;
          assign(next, p);
          queue.push_back(next);
        }
      }
    }
}

void make_classes(const TetMesh& mesh, CutGraph& cut) {
  const std::size_t n = mesh.num_tets();
  std::vector<std::int32_t> parent(4 * n);
  std::iota(parent.begin(), parent.end(), 0);
  auto find = [&](std::int32_t x) {
    while (parent[static_cast<std::size_t>(x)] != x) {
      auto& p = parent[static_cast<std::size_t>(x)];
      p = parent[static_cast<std::size_t>(p)];
      x = p;
    }
    return x;
  };
  for (std::size_t i = 0; i < n; ++i)
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(TetId(i), f);
      const HalfFaceId o = mesh.opposite_half_face(h);
      if (!o.valid() || o.value < h.value || cut.patch(h) != 0) continue;
      for (VertexId v : mesh.face_vertices(h)) {
        const std::int32_t x = find(4 * h.tet().value + mesh.local_index(h.tet(), v));
        const std::int32_t y = find(4 * o.tet().value + mesh.local_index(o.tet(), v));
        parent[static_cast<std::size_t>(std::max(x, y))] = std::min(x, y);
      }
    }
  cut.classes.assign(n, {-1, -1, -1, -1});
  std::vector<std::int32_t> name(4 * n, -1);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 4; ++k) {
      const auto root = static_cast<std::size_t>(find(static_cast<std::int32_t>(4 * i + k)));
      if (name[root] < 0) {
        name[root] = static_cast<std::int32_t>(cut.class_vertex.size());
        cut.class_vertex.push_back(mesh.tets[i][k]);
      }
      cut.classes[i][k] = name[root];
    }
}

}  // namespace

CutGraph cut_graph(const TetMesh& mesh, const Matchings& matchings, const std::set<EdgeKey>& singular) {
  CutGraph cut;
  comb(mesh, matchings, cut);
  set_rotations(mesh, matchings, cut);
  peel(mesh, MapEdges(mesh), singular, cut);
  flood_patches(mesh, singular, cut);
  make_classes(mesh, cut);
  return cut;
}

Matchings matchings_of(const CornerMap& map) {
  Matchings matchings = map.rotations;
  for (auto& faces : matchings)
    for (Rotation& r : faces) r = octahedral::inverse(r);
  return matchings;
}

std::vector<Violation> check(const TetMesh& mesh, const CutGraph& cut) {
  std::vector<Violation> found;
  for (std::size_t i = 0; i < mesh.num_tets(); ++i)
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(TetId(i), f);
      const HalfFaceId o = mesh.opposite_half_face(h);
      const TetId t(i);
      auto report = [&](const char* what) {
        found.push_back({what, {t.value, o.valid() ? o.tet().value : -1}, {centroid(mesh, t)}});
      };
      if (!o.valid()) {
        if (cut.patch(h) != 0 || cut.rotation(h) != octahedral::identity) report("A boundary face is on the cut.");
        continue;
      }
      if (cut.patch(h) != -cut.patch(o)) report("The two sides of a cut face disagree about its patch.");
      if (cut.rotation(h) != octahedral::inverse(cut.rotation(o))) report("Rotations across a face are not mutual.");
      if (cut.patch(h) == 0 && cut.rotation(h) != octahedral::identity) report("A face off the cut has a rotation.");
      for (VertexId v : mesh.face_vertices(h)) {
        const auto a = cut.classes[i][static_cast<std::size_t>(mesh.local_index(t, v))];
        const auto b = cut.classes[o.tet().index()][static_cast<std::size_t>(mesh.local_index(o.tet(), v))];
        if (cut.class_vertex[static_cast<std::size_t>(a)] != v) report("A corner class belongs to another vertex.");
        if (cut.patch(h) == 0 && a != b) report("Corners across a face off the cut have different classes.");
      }
    }
  return found;
}

}  // namespace hexfield
