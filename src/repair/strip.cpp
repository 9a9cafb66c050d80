#include "hexfield/repair/strip.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "hexfield/repair/state_ops.hpp"
#include "rounding.hpp"

namespace hexfield {
namespace {

// Corners of a crossed face and where the path pierces it, in barycentric coordinates.
struct Piercing {
  std::array<Vec3, 3> corner;
  Vec3 bary = Vec3::Constant(1.0 / 3);
  Vec3 point() const { return bary[0] * corner[0] + bary[1] * corner[1] + bary[2] * corner[2]; }
};

constexpr double smallest_bary = 0.15;  // how near to an edge the path may pierce a face
constexpr int tightening_sweeps = 20;

// Barycentric coordinates of the foot of p in the plane of the face, kept inside.
Vec3 inner_foot(const Piercing& face, const Vec3& p) {
  const Vec3 a = face.corner[1] - face.corner[0];
  const Vec3 b = face.corner[2] - face.corner[0];
  const Vec3 n = a.cross(b);
  const double area2 = n.squaredNorm();
  if (area2 <= 0) return face.bary;
  const Vec3 d = p - face.corner[0];
  Vec3 bary;
  bary[1] = d.cross(b).dot(n) / area2;
  bary[2] = a.cross(d).dot(n) / area2;
  bary[0] = 1 - bary[1] - bary[2];
  bary = bary.cwiseMax(smallest_bary);
  return bary / bary.sum();
}

std::vector<Piercing> taut_string(const TetMesh& mesh, std::span<const FaceKey> faces, const Vec3& from,
                                  const std::optional<Vec3>& to) {
  std::vector<Piercing> string(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) string[i].corner[k] = mesh.point(faces[i][k]);
  for (int sweep = 0; sweep < tightening_sweeps; ++sweep)
    for (std::size_t i = 0; i < string.size(); ++i) {
      const Vec3 before = i == 0 ? from : string[i - 1].point();
      const Vec3 after = i + 1 < string.size() ? string[i + 1].point() : to.value_or(before);
      string[i].bary = inner_foot(string[i], (before + after) / 2);
    }
  return string;
}

// A spoke: index of the path vertex and the vertex beside the path.
using Rung = std::pair<std::size_t, VertexId>;

class SpokeSearch {
 public:
  SpokeSearch(const RepairState& state, const StripRequest& request) : state_(state), request_(request) {
    taken_.insert(request.path.begin(), request.path.end());
  }

  // Cheapest chain of spokes (Dijkstra; ties by path index, then vertex id); empty when there is none.
  std::vector<Rung> run() {
    const Rung start{0, request_.start};
    best_[start] = {0.0, start};
    queue_.insert({0.0, start});
    while (!queue_.empty()) {
      const auto [cost, spoke] = *queue_.begin();
      queue_.erase(queue_.begin());
      if (cost > best_.at(spoke).cost) continue;
      if (is_goal(spoke)) return chain_to(spoke);
      expand(spoke, cost);
    }
    return {};
  }

 private:
  struct Reached {
    double cost;
    Rung before;
  };

  VertexId path(std::size_t i) const { return request_.path[i]; }

  bool is_goal(const Rung& s) const {
    if (s.first + 1 != request_.path.size()) return false;
    if (request_.end.valid()) return s.second == request_.end;
    if (s == Rung{0, request_.start} || ring_of(state_.mesh, path(s.first), s.second).closed) return false;
    return request_.exits.empty() || std::ranges::find(request_.exits, s.second) != request_.exits.end();
  }

  std::vector<Rung> chain_to(Rung s) const {
    std::vector<Rung> chain{s};
    while (best_.at(s).before != s) chain.push_back(s = best_.at(s).before);
    std::reverse(chain.begin(), chain.end());
    return chain;
  }

  // The whole end edge may be special; all other spokes are split and must not be.
  bool admissible(const Rung& s, const EdgeRing& ring) const {
    const bool last = s.first + 1 == request_.path.size();
    if (last && request_.end.valid() && s.second == request_.end) return true;
    if (is_special(state_, edge_key(path(s.first), s.second))) return false;
    bool in_feature = !ring.closed;
    for (HalfFaceId h : ring.crossings) in_feature = in_feature || is_feature_face(state_, h);
    const bool held = s.first < request_.held || s.first + request_.held_last >= request_.path.size();
    if (!in_feature || !held) return true;
    return last && std::ranges::find(request_.exits, s.second) != request_.exits.end();
  }

  void relax(const Rung& from, const Rung& to, double cost) {
    if (!admissible(to, ring_of(state_.mesh, path(to.first), to.second))) return;
    const double total = without_noise(cost + cost_of(to));
    const auto found = best_.find(to);
    if (found != best_.end() && found->second.cost <= total) return;
    best_[to] = {total, from};
    queue_.insert({total, to});
  }

  void expand(const Rung& s, double cost) {
    const VertexId m = path(s.first);
    const EdgeRing ring = ring_of(state_.mesh, m, s.second);
    for (HalfFaceId h : ring.crossings) {
      if (is_feature_face(state_, h)) continue;
      for (VertexId w : state_.mesh.face_vertices(h)) {
        if (w == m || w == s.second) continue;
        if (s.first + 1 < request_.path.size() && w == path(s.first + 1))
          relax(s, {s.first + 1, s.second}, cost);
        else if (!taken_.contains(w))
          relax(s, {s.first, w}, cost);
      }
    }
  }

  // 0.1 per spoke, and up to 2 for its angle against the wanted side, seen along the path.
  double cost_of(const Rung& s) const {
    const Vec3 wanted = request_.side.empty() ? Vec3::Zero() : request_.side[s.first];
    if (wanted.isZero()) return 0.1;
    const VertexId before = path(s.first == 0 ? 0 : s.first - 1);
    const VertexId after = path(std::min(s.first + 1, request_.path.size() - 1));
    const Vec3 along = (state_.mesh.point(after) - state_.mesh.point(before)).normalized();
    Vec3 spoke = state_.mesh.point(s.second) - state_.mesh.point(path(s.first));
    if (before != after) spoke -= spoke.dot(along) * along;
    const double size = spoke.norm() * wanted.norm();
    return 1.1 - (size > 0 ? spoke.dot(wanted) / size : 0.0);
  }

  const RepairState& state_;
  const StripRequest& request_;
  std::set<VertexId> taken_;
  std::map<Rung, Reached> best_;
  std::set<std::pair<double, Rung>> queue_;
};

void add_face(Strip& strip, VertexId a, VertexId b, VertexId c) {
  if (a != b && b != c && a != c) strip.faces.push_back(face_key(a, b, c));
}

// In a feature face, or special itself: no spoke for a vertex on a feature.
bool is_held(const RepairState& state, VertexId a, VertexId b) {
  if (is_special(state, edge_key(a, b))) return true;
  const EdgeRing ring = ring_of(state.mesh, a, b);
  return !ring.closed || std::ranges::any_of(ring.crossings, [&](HalfFaceId h) { return is_feature_face(state, h); });
}

}  // namespace

void free_spokes(RepairState& state, VertexId v) {
  std::set<FaceKey> narrow;
  for (TetId t : vertex_star(state.mesh, v))
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(t, f);
      if (state.mesh.vertices(t)[static_cast<std::size_t>(f)] == v || is_feature_face(state, h)) continue;
      const auto corners = state.mesh.face_vertices(h);
      if (std::ranges::all_of(corners, [&](VertexId w) { return w == v || is_held(state, v, w); }))
        narrow.insert(state.mesh.key(h));
    }
  for (const FaceKey& face : narrow) split_face(state, find_half_face(state.mesh, face));
}

std::vector<VertexId> insert_path(RepairState& state, std::span<const FaceKey> faces, const Vec3& from,
                                  const std::optional<Vec3>& to) {
  const auto string = taut_string(state.mesh, faces, from, to);
  std::vector<VertexId> path;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    path.push_back(split_face(state, find_half_face(state.mesh, faces[i])));
    state.mesh.points[path.back().index()] = string[i].point();
  }
  return path;
}

std::vector<EdgeKey> Strip::boundary() const {
  std::vector<EdgeKey> edges;
  if (!from_boundary) edges.push_back(start);
  for (const auto* side : {&first, &second})
    for (std::size_t i = 0; i + 1 < side->size(); ++i) edges.push_back(edge_key((*side)[i], (*side)[i + 1]));
  if (!at_boundary && first.back() != second.back()) edges.push_back(edge_key(first.back(), second.back()));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

std::optional<Strip> build_strip(RepairState& state, const StripRequest& request) {
  const std::vector<Rung> spokes = SpokeSearch(state, request).run();
  if (spokes.empty()) return {};
  Strip strip;
  strip.first = request.path;
  strip.second = {request.split_start ? split_edge(state, request.path.front(), request.start) : request.start};
  strip.start = edge_key(request.path.front(), strip.second.front());
  strip.from_boundary = request.split_start;
  strip.at_boundary = !request.end.valid();
  for (std::size_t j = 1; j < spokes.size(); ++j) {
    const VertexId before = request.path[spokes[j - 1].first];
    const VertexId m = request.path[spokes[j].first];
    const bool whole = j + 1 == spokes.size() && request.end.valid();
    const VertexId n = whole ? spokes[j].second : split_edge(state, m, spokes[j].second);
    const VertexId last = strip.second.back();
    if (m == before) {
      add_face(strip, m, last, n);
    } else if (last == spokes[j].second) {  // the start is whole: the split cut the triangle (before, m, last)
      add_face(strip, before, last, n);
      add_face(strip, before, n, m);
    } else {
      add_face(strip, before, last, m);
      add_face(strip, last, n, m);
    }
    if (n != last) strip.second.push_back(n);
  }
  return strip;
}

}  // namespace hexfield
