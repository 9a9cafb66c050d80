#include "hexfield/field/edge_codes.hpp"

#include <algorithm>
#include <cmath>

#include "hexfield/base/parallel.hpp"

namespace hexfield {

using octahedral::Label;
using octahedral::Rotation;

namespace {

// Below this a sum of cosines is taken as zero: the edge is orthogonal to its axis.
constexpr double orthogonal_margin = 1e-6;
// A turn between neighbours that comes this close to a half-turn has no reliable sign.
constexpr double largest_turn = 178 * M_PI / 180;

Vec3 edge_direction(const TetMesh& mesh, VertexId a, VertexId b) {
  return (mesh.point(b) - mesh.point(a)).normalized();
}

// Signed angle about e from the aligned frame F_k M to the aligned frame F_l; both have one axis along e.
double turn_about(const Quaternion& from, const Quaternion& to, const Vec3& e) {
  Quaternion turn = to * from.conjugate();
  if (turn.w() < 0) turn.coeffs() *= -1;
  return 2 * std::atan2(turn.vec().dot(e), turn.w());
}

struct Turning {
  double total = 0;
  double largest = 0;
};

// Sum of the turns over the crossings, with the frames aligned such that labels[k] points along e in tet k.
Turning turning(const FrameField& field, const std::vector<TetId>& tets, const std::vector<HalfFaceId>& crossings,
                const std::vector<Quaternion>& aligned, const Vec3& e) {
  Turning sum;
  for (std::size_t k = 0; k < crossings.size(); ++k) {
    const std::size_t next = (k + 1) % tets.size();
    const Quaternion moved = aligned[k] * octahedral::quaternion(field.matching(crossings[k]));
    const double turn = turn_about(moved, aligned[next], e);
    sum.total += turn;
    sum.largest = std::max(sum.largest, std::abs(turn));
  }
  return sum;
}

double label_dot(const FrameField& field, const std::vector<TetId>& tets, const std::vector<Label>& labels,
                 const Vec3& e) {
  double sum = 0;
  for (std::size_t k = 0; k < tets.size(); ++k)
    sum += (field.frames[tets[k].index()] * octahedral::direction(labels[k])).dot(e);
  return sum;
}

std::vector<Quaternion> aligned_frames(const FrameField& field, const std::vector<TetId>& tets,
                                       const std::vector<Label>& labels, const Vec3& e) {
  std::vector<Quaternion> frames(tets.size());
  for (std::size_t k = 0; k < tets.size(); ++k) frames[k] = aligned_frame(field.frames[tets[k].index()], labels[k], e);
  return frames;
}

double dihedral_sum(const TetMesh& mesh, const std::vector<TetId>& tets, VertexId a, VertexId b) {
  double sum = 0;
  for (TetId t : tets) sum += dihedral_angle(mesh, t, a, b);
  return sum;
}

// Dominant axis of a ring with identity monodromy: the label of largest |sum of cosines|.
Label dominant_axis(const FrameField& field, const EdgeRing& ring, const Vec3& e) {
  Label best = 0;
  double most = -1;
  for (Label l = 0; l < 6; l = static_cast<Label>(l + 2)) {
    const double dot = std::abs(label_dot(field, ring.tets, transport_around(field, ring, l), e));
    if (dot > most + 1e-9) best = l, most = dot;
  }
  return best;
}

}  // namespace

Rotation monodromy(const FrameField& field, const EdgeRing& ring) {
  Rotation m = octahedral::identity;
  if (!ring.closed) return m;
  for (HalfFaceId h : ring.crossings) m = octahedral::product(m, field.matching(h));
  return m;
}

Label transport(const FrameField& field, HalfFaceId h, Label label) {
  return octahedral::image(octahedral::inverse(field.matching(h)), label);
}

Label closest_label(const Quaternion& frame, const Vec3& direction) {
  const Vec3 d = frame.conjugate() * direction;
  Label best = 0;
  double most = -2;
  for (Label l = 0; l < 6; ++l) {
    const double dot = octahedral::sign(l) * d[octahedral::axis(l)];
    if (dot > most + 1e-12) best = l, most = dot;
  }
  return best;
}

std::vector<Label> transport_around(const FrameField& field, const EdgeRing& ring, Label label) {
  std::vector<Label> labels(ring.tets.size());
  labels[0] = label;
  for (std::size_t k = 0; k + 1 < ring.tets.size(); ++k) labels[k + 1] = transport(field, ring.crossings[k], labels[k]);
  return labels;
}

Quaternion aligned_frame(const Quaternion& frame, Label label, const Vec3& direction) {
  const Vec3 axis = frame * octahedral::direction(label);
  return (Quaternion::FromTwoVectors(axis, direction) * frame).normalized();
}

EdgeCode interior_code(const TetMesh& mesh, const FrameField& field, const EdgeRing& ring, VertexId a, VertexId b) {
  const Rotation m = monodromy(field, ring);
  if (octahedral::is_compound(m)) return compound_code;
  const Vec3 e = edge_direction(mesh, a, b);
  if (m == octahedral::identity) {
    double total = 0;
    for (HalfFaceId h : ring.crossings) {
      const HalfFaceId o = mesh.opposite_half_face(h);
      const Quaternion moved = field.frames[h.tet().index()] * octahedral::quaternion(field.matching(h));
      total += 2 * std::acos(std::min(1.0, std::abs(moved.dot(field.frames[o.tet().index()]))));
    }
    if (total <= M_PI) return 0;
  }
  const Label axis = m == octahedral::identity ? dominant_axis(field, ring, e) : octahedral::rotation_axis(m);
  std::vector<Label> labels = transport_around(field, ring, axis);
  const double dot = label_dot(field, ring.tets, labels, e);
  const bool half_turn = m != octahedral::identity && octahedral::product(m, m) == octahedral::identity;
  if (std::abs(dot) < orthogonal_margin * static_cast<double>(ring.tets.size()))
    return half_turn ? 2 : (m == octahedral::identity ? 0 : undetermined_code);
  if (dot < 0)
    for (Label& l : labels) l = octahedral::negate(l);
  const Turning turns = turning(field, ring.tets, ring.crossings, aligned_frames(field, ring.tets, labels, e), e);
  if (turns.largest > largest_turn) return half_turn ? 2 : (m == octahedral::identity ? 0 : undetermined_code);
  const double gamma = dihedral_sum(mesh, ring.tets, a, b) - turns.total;
  return static_cast<int>(std::lround(gamma / (M_PI / 2))) - 4;
}

EdgeCode edge_code(const TetMesh& mesh, const Features& features, const FrameField& field, const EdgeRing& ring,
                   VertexId a, VertexId b) {
  if (ring.closed) return interior_code(mesh, field, ring, a, b);
  EdgeCode sum = -2;
  for (const Sector& s : sectors(mesh, features, field, ring, a, b)) {
    if (s.quads == undetermined_code) return undetermined_code;
    sum += s.quads;
  }
  return sum;
}

Label outgoing_label(const TetMesh& mesh, const FrameField& field, const EdgeRing& ring, EdgeCode code, VertexId a,
                     VertexId b) {
  const Rotation m = monodromy(field, ring);
  if (m == octahedral::identity || octahedral::is_compound(m)) return octahedral::no_label;
  const Label axis = octahedral::rotation_axis(m);  // quarter-turns: m is the +90 degree turn about it
  const bool half_turn = octahedral::product(m, m) == octahedral::identity;
  if (!half_turn && code != undetermined_code) {
    // R_axis(90) = R_label(-2 pi I) = R_label(90 code): code 1 modulo 4 keeps the sign, -1 (3) turns it.
    const int turns = ((code % 4) + 4) % 4;
    if (turns == 1) return axis;
    if (turns == 3) return octahedral::negate(axis);
  }
  const double dot = label_dot(field, ring.tets, transport_around(field, ring, axis), edge_direction(mesh, a, b));
  return dot < 0 ? octahedral::negate(axis) : axis;
}

namespace {

// Edges of the tets that `for_each_tet` visits, each with its smallest tet, ordered by key. A bucket per lower vertex,
// each sorted by the higher one and then by tet: no sort of the whole list.
template <class ForEachTet>
std::vector<std::pair<EdgeKey, TetId>> bucketed_edges(const TetMesh& mesh, const ForEachTet& for_each_tet) {
  using Entry = std::pair<VertexId, TetId>;
  const std::size_t n = mesh.num_vertices();
  std::vector<std::size_t> starts(n + 1, 0);
  auto for_each_edge = [&](const auto& visit) {
    for_each_tet([&](TetId t) {
      const auto& v = mesh.vertices(t);
      for (const auto& e : tet_edge_vertices)
        visit(edge_key(v[static_cast<std::size_t>(e[0])], v[static_cast<std::size_t>(e[1])]), t);
    });
  };
  for_each_edge([&](const EdgeKey& e, TetId) { ++starts[e[0].index() + 1]; });
  for (std::size_t v = 0; v < n; ++v) starts[v + 1] += starts[v];
  std::vector<Entry> entries(starts[n]);
  std::vector<std::size_t> next(starts.begin(), starts.end() - 1);
  for_each_edge([&](const EdgeKey& e, TetId t) { entries[next[e[0].index()]++] = {e[1], t}; });
  parallel_for(n, 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const auto first = entries.begin() + static_cast<std::ptrdiff_t>(starts[v]);
      const auto last = entries.begin() + static_cast<std::ptrdiff_t>(starts[v + 1]);
      std::sort(first, last);
      const auto same = [](const Entry& x, const Entry& y) { return x.first == y.first; };
      next[v] = static_cast<std::size_t>(std::unique(first, last, same) - entries.begin());  // end of what is left
    }
  });
  std::size_t count = 0;
  for (std::size_t v = 0; v < n; ++v) count += next[v] - starts[v];
  std::vector<std::pair<EdgeKey, TetId>> edges;
  edges.reserve(count);
  for (std::size_t v = 0; v < n; ++v)
    for (std::size_t k = starts[v]; k < next[v]; ++k)
      edges.emplace_back(EdgeKey{VertexId(static_cast<std::int64_t>(v)), entries[k].first}, entries[k].second);
  return edges;
}

}  // namespace

std::vector<std::pair<EdgeKey, TetId>> all_edges(const TetMesh& mesh) {
  return bucketed_edges(mesh, [&](const auto& visit) {
    for (std::size_t i = 0; i < mesh.num_tets(); ++i)
      if (const TetId t(static_cast<std::int64_t>(i)); mesh.alive(t)) visit(t);
  });
}

std::vector<std::pair<EdgeKey, TetId>> edges_with_tets(const TetMesh& mesh, std::span<const TetId> tets) {
  if (2 * tets.size() > mesh.num_vertices())
    return bucketed_edges(mesh, [&](const auto& visit) {
      for (TetId t : tets) visit(t);
    });
  std::vector<std::pair<EdgeKey, TetId>> edges;
  edges.reserve(6 * tets.size());
  for (TetId t : tets) {
    const auto& v = mesh.vertices(t);
    for (const auto& e : tet_edge_vertices)
      edges.emplace_back(edge_key(v[static_cast<std::size_t>(e[0])], v[static_cast<std::size_t>(e[1])]), t);
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end(), [](const auto& x, const auto& y) { return x.first == y.first; }),
              edges.end());
  return edges;
}

EdgeCodes compute_codes(const TetMesh& mesh, const Features& features, const FrameField& field) {
  const auto edges = all_edges(mesh);
  std::vector<EdgeCode> codes(edges.size(), 0);
  parallel_for(edges.size(), 2048, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [edge, tet] = edges[i];
      codes[i] = edge_code(mesh, features, field, edge_ring(mesh, tet, edge[0], edge[1]), edge[0], edge[1]);
    }
  });
  EdgeCodes result;
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (codes[i] != 0) result.emplace_hint(result.end(), edges[i].first, codes[i]);
  return result;
}

}  // namespace hexfield
