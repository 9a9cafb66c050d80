#include <algorithm>
#include <array>

#include "hexfield/mesh/tet_mesh.hpp"

namespace hexfield {
namespace {

// Local vertices (c, d) of t besides a and b such that (a, b, c, d) is positively oriented.
std::array<int, 2> wing_vertices(const TetMesh& mesh, TetId t, VertexId a, VertexId b) {
  const int i = mesh.local_index(t, a);
  const int j = mesh.local_index(t, b);
  std::array<int, 4> order{i, j, -1, -1};
  std::size_t n = 2;
  for (int k = 0; k < 4; ++k)
    if (k != i && k != j) order[n++] = k;
  int inversions = 0;
  for (std::size_t x = 0; x < 4; ++x)
    for (std::size_t y = x + 1; y < 4; ++y) inversions += order[x] > order[y];
  if (inversions % 2 != 0) std::swap(order[2], order[3]);
  return {order[2], order[3]};
}

// Set of tets by open addressing: on the stack as long as it is small.
class SeenTets {
 public:
  // False when it was there already.
  bool insert(TetId t) {
    if (2 * (size_ + 1) > slots_) grow();
    return place(t);
  }

 private:
  bool place(TetId t) {
    TetId* table = large_.empty() ? small_.data() : large_.data();
    for (std::size_t i = hash(t);; i = (i + 1) % slots_) {
      if (table[i] == t) return false;
      if (table[i].valid()) continue;
      table[i] = t;
      ++size_;
      return true;
    }
  }
  std::size_t hash(TetId t) const { return t.index() * 0x9E3779B1u % slots_; }
  void grow() {
    const std::vector<TetId> old = large_.empty() ? std::vector<TetId>(small_.begin(), small_.end()) : large_;
    slots_ *= 4;
    size_ = 0;
    large_.assign(slots_, TetId());
    for (TetId t : old)
      if (t.valid()) place(t);
  }

  std::size_t slots_ = 128;
  std::size_t size_ = 0;
  std::array<TetId, 128> small_{};
  std::vector<TetId> large_;
};

}  // namespace

EdgeRing edge_ring(const TetMesh& mesh, TetId seed, VertexId a, VertexId b) {
  // Counter-clockwise one leaves through the face opposite to c, clockwise through the one opposite to d.
  auto leave = [&](TetId t, bool ccw) { return HalfFaceId(t, wing_vertices(mesh, t, a, b)[ccw ? 0 : 1]); };
  EdgeRing ring;
  ring.tets.reserve(8);
  ring.crossings.reserve(8);
  for (TetId t = seed;;) {
    ring.tets.push_back(t);
    ring.crossings.push_back(leave(t, true));
    const HalfFaceId in = mesh.opposite_half_face(ring.crossings.back());
    if (!in.valid()) break;
    t = in.tet();
    ring.closed = t == seed;
    if (ring.closed) return ring;
  }
  const std::size_t ahead = ring.tets.size();
  for (TetId t = seed;;) {
    ring.first_boundary = leave(t, false);
    const HalfFaceId back = mesh.opposite_half_face(ring.first_boundary);
    if (!back.valid()) break;
    t = back.tet();
    ring.tets.push_back(t);
    ring.crossings.push_back(back);
  }
  // What was found clockwise comes first, the last of it before all.
  const auto clockwise_first = [&](auto& list) {
    std::rotate(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(ahead), list.end());
    std::reverse(list.begin(), list.end() - static_cast<std::ptrdiff_t>(ahead));
  };
  clockwise_first(ring.tets);
  clockwise_first(ring.crossings);
  return ring;
}

namespace {

// Visits the alive tets at v that faces at v connect with mesh.vertex_tet[v], each once, in an order of walking, until
// `visit` returns false.
template <class Visit>
void walk_star(const TetMesh& mesh, VertexId v, const Visit& visit) {
  const TetId seed = mesh.vertex_tet[v.index()];
  if (!seed.valid()) return;
  SeenTets seen;
  std::vector<TetId> star;
  star.reserve(48);
  star.push_back(seed);
  seen.insert(seed);
  for (std::size_t i = 0; i < star.size(); ++i) {
    const TetId t = star[i];
    if (!visit(t)) return;
    for (int f = 0; f < 4; ++f) {
      if (mesh.vertices(t)[static_cast<std::size_t>(f)] == v) continue;
      const HalfFaceId o = mesh.opposite_half_face(HalfFaceId(t, f));
      if (o.valid() && seen.insert(o.tet())) star.push_back(o.tet());
    }
  }
}

}  // namespace

std::vector<TetId> vertex_star(const TetMesh& mesh, VertexId v) {
  std::vector<TetId> star;
  star.reserve(48);
  walk_star(mesh, v, [&](TetId t) {
    star.push_back(t);
    return true;
  });
  std::sort(star.begin(), star.end());
  return star;
}

TetId find_tet_with_edge(const TetMesh& mesh, VertexId a, VertexId b) {
  TetId seed;
  if (a == b) return seed;
  walk_star(mesh, a, [&](TetId t) {
    if (mesh.has_vertex(t, b)) seed = t;
    return !seed.valid();
  });
  if (!seed.valid()) return seed;
  const EdgeRing ring = edge_ring(mesh, seed, a, b);
  return *std::min_element(ring.tets.begin(), ring.tets.end());
}

HalfFaceId find_half_face(const TetMesh& mesh, const FaceKey& face) {
  HalfFaceId found;
  walk_star(mesh, face[0], [&](TetId t) {
    if (!mesh.has_vertex(t, face[1]) || !mesh.has_vertex(t, face[2])) return true;
    for (int i = 0; i < 4; ++i)
      if (mesh.key(HalfFaceId(t, i)) == face) found = HalfFaceId(t, i);
    const HalfFaceId beyond = mesh.opposite_half_face(found);
    if (beyond.valid() && beyond < found) found = beyond;
    return false;
  });
  return found;
}

}  // namespace hexfield
