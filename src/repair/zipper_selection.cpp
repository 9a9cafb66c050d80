#include "hexfield/repair/zipper_selection.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/field/singularity_graph.hpp"
#include "hexfield/repair/state_ops.hpp"

namespace hexfield {
namespace {

bool on_feature_face(const RepairState& state, VertexId v) {
  for (TetId t : vertex_star(state.mesh, v))
    for (int f = 0; f < 4; ++f)
      if (const HalfFaceId h(t, f);
          state.mesh.vertices(t)[static_cast<std::size_t>(f)] != v && is_feature_face(state, h))
        return true;
  return false;
}

// Inner edges of codes +1 and -1 by vertex, and all singular edges by vertex.
class Net {
 public:
  explicit Net(const RepairState& state) : state_(state) {
    for (const auto& [edge, code] : state.codes) {
      for (VertexId v : edge) all_[v].push_back(edge);
      if (std::abs(code) != 1 || state.features.edges.contains(edge)) continue;
      if (ring_of(state.mesh, edge[0], edge[1]).closed) quarter_.insert(edge);
    }
  }

  const std::set<EdgeKey>& edges() const { return quarter_; }

  // Next edge of the chain that arrives at v along `edge`, if it goes on there.
  const EdgeKey* next(VertexId v, const EdgeKey& edge) {
    const auto& here = all_.at(v);
    if (here.size() != 2 || !quarter_.contains(here[0]) || !quarter_.contains(here[1])) return nullptr;
    const auto known = surface_.find(v);
    const bool surface = known != surface_.end() ? known->second : (surface_[v] = on_feature_face(state_, v));
    return surface ? nullptr : &(here[0] == edge ? here[1] : here[0]);
  }

  const std::vector<EdgeKey>& at(VertexId v) const { return all_.at(v); }

 private:
  const RepairState& state_;
  std::map<VertexId, std::vector<EdgeKey>> all_;
  std::map<VertexId, bool> surface_;
  std::set<EdgeKey> quarter_;
};

VertexId other_end(const EdgeKey& edge, VertexId v) { return edge[0] == v ? edge[1] : edge[0]; }

// Walks from `from` along `edge` to the end of the chain; the vertices after `from`.
std::vector<VertexId> walk(Net& net, EdgeKey edge, VertexId from, std::set<EdgeKey>& used) {
  std::vector<VertexId> vertices;
  VertexId v = from;
  for (;;) {
    v = other_end(edge, v);
    vertices.push_back(v);
    const EdgeKey* next = net.next(v, edge);
    if (next == nullptr || !used.insert(*next).second) return vertices;
    edge = *next;
  }
}

// Mean over the ring of (axis of the outgoing label) . (b - a).
double flow_along(const RepairState& state, VertexId a, VertexId b, EdgeCode code) {
  const EdgeRing ring = ring_of(state.mesh, a, b);
  const octahedral::Label out = outgoing_label(state.mesh, state.field, ring, code, a, b);
  if (out == octahedral::no_label) return 0;
  const auto labels = transport_around(state.field, ring, out);
  Vec3 axis = Vec3::Zero();
  for (std::size_t k = 0; k < labels.size(); ++k)
    axis += state.field.frames[ring.tets[k].index()] * octahedral::direction(labels[k]);
  return axis.dot(state.mesh.point(b) - state.mesh.point(a)) / static_cast<double>(labels.size());
}

void measure(const RepairState& state, FlowChain& chain) {
  const std::size_t edges = chain.vertices.size() - 1;
  chain.flow = {0};
  double sign = 1;
  for (std::size_t i = 0; i < edges; ++i) {
    const VertexId a = chain.vertices[i], b = chain.vertices[i + 1];
    chain.codes.push_back(state.codes.at(edge_key(a, b)));
    if (i > 0 && chain.codes[i] != chain.codes[i - 1]) {
      chain.zippers.push_back(i);
      sign = -sign;
    }
    chain.flow.push_back(chain.flow.back() + sign * flow_along(state, a, b, chain.codes[i]));
    chain.length += (state.mesh.point(b) - state.mesh.point(a)).norm();
  }
  if (chain.closed && chain.codes.front() != chain.codes.back()) chain.zippers.insert(chain.zippers.begin(), 0);
}

// Closed chains start at a zipper node if there is one.
void rotate_to_zipper(const RepairState& state, FlowChain& chain) {
  auto& v = chain.vertices;
  const std::size_t n = v.size() - 1;
  auto code = [&](std::size_t i) { return state.codes.at(edge_key(v[i % n], v[i % n + 1])); };
  for (std::size_t i = 0; i < n; ++i)
    if (code(i) != code(i + n - 1)) {
      v.pop_back();
      std::rotate(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(i), v.end());
      v.push_back(v.front());
      return;
    }
}

}  // namespace

std::vector<FlowChain> flow_chains(const RepairState& state) {
  Net net(state);
  std::set<EdgeKey> used;
  std::vector<FlowChain> chains;
  for (const EdgeKey& edge : net.edges()) {
    if (!used.insert(edge).second) continue;
    FlowChain chain;
    const auto ahead = walk(net, edge, edge[0], used);
    if (ahead.back() == edge[0] && ahead.size() > 2 && net.next(edge[0], edge) != nullptr) {
      chain.closed = true;
      chain.vertices = {edge[0]};
    } else {
      chain.vertices = walk(net, edge, edge[1], used);
      std::reverse(chain.vertices.begin(), chain.vertices.end());
    }
    chain.vertices.insert(chain.vertices.end(), ahead.begin(), ahead.end());
    if (chain.closed) rotate_to_zipper(state, chain);
    measure(state, chain);
    chains.push_back(std::move(chain));
  }
  return chains;
}

namespace {

struct Segments {
  std::vector<double> length;  // between consecutive zipper nodes and ends; zipper k lies between k and k + 1
  double mean = 0;
};

Segments segments_of(const FlowChain& chain) {
  std::vector<std::size_t> stops = chain.zippers;
  if (chain.closed) {
    stops.push_back(chain.vertices.size() - 1);
  } else {
    stops.insert(stops.begin(), 0);
    stops.push_back(chain.vertices.size() - 1);
  }
  Segments s;
  for (std::size_t i = 0; i + 1 < stops.size(); ++i)
    s.length.push_back(std::abs(chain.flow[stops[i + 1]] - chain.flow[stops[i]]));
  for (double l : s.length) s.mean += l / static_cast<double>(s.length.size());
  if (chain.closed) s.length.insert(s.length.begin(), s.length.back());
  return s;
}

// First and last zipper node that count: a close pair beside a reversed end of the arc is noise.
std::pair<std::size_t, std::size_t> trimmed(const FlowChain& chain, const Segments& s,
                                            std::array<bool, 2> surface_zipper, double peak) {
  std::size_t first = 0, last = chain.zippers.size();
  if (chain.closed) return {first, last};
  if (surface_zipper[0] && last - first >= 2 && s.length[1] < peak * s.mean) first += 2;
  if (surface_zipper[1] && last - first >= 2 && s.length[last - 1] < peak * s.mean) last -= 2;
  return {first, last};
}

// The highest (or lowest) zipper node in [first, last) that lies beyond both ends by `margin`.
void add_peak(const FlowChain& chain, std::size_t first, std::size_t last, double sign, double margin,
              std::set<std::size_t>& kept) {
  std::size_t best = first;
  for (std::size_t k = first; k < last; ++k)
    if (sign * chain.flow[chain.zippers[k]] > sign * chain.flow[chain.zippers[best]]) best = k;
  const double end = std::max(sign * chain.flow.front(), sign * chain.flow.back());
  if (sign * chain.flow[chain.zippers[best]] >= end + margin) kept.insert(chain.zippers[best]);
}

}  // namespace

std::vector<std::size_t> kept_zippers(const FlowChain& chain, double mean_target, std::array<bool, 2> on_surface,
                                      std::array<bool, 2> surface_zipper, const SelectionOptions& options) {
  if (chain.zippers.empty()) return {};
  const Segments s = segments_of(chain);
  const auto [first, last] = trimmed(chain, s, surface_zipper, options.peak);
  const std::size_t count = last - first;
  std::set<std::size_t> kept;
  if (count > 0 && !chain.closed) {
    // The flow turns back at a zipper node: it is the end of what came before.
    const double sign = chain.flow[chain.zippers[first]] > chain.flow[chain.zippers[first] - 1] ? 1 : -1;
    const double margin = options.peak * s.mean;
    if (count % 2 == 1) {
      add_peak(chain, first, last, sign, -std::numeric_limits<double>::infinity(), kept);
    } else {
      add_peak(chain, first, last, 1, margin, kept);
      add_peak(chain, first, last, -1, margin, kept);
    }
  }
  const bool crowded =
      count > 2 && static_cast<double>(count) > options.crowded * static_cast<double>(chain.vertices.size());
  const double longer = std::min(options.segment * s.mean, options.absolute_segment * mean_target);
  for (std::size_t k = first; k < last && !crowded; ++k) {
    const bool before = s.length[k] > longer || (!chain.closed && k == 0 && on_surface[0]);
    const bool after = s.length[k + 1] > longer || (!chain.closed && k + 1 == chain.zippers.size() && on_surface[1]);
    if (before && after && (s.length[k] > longer || s.length[k + 1] > longer)) kept.insert(chain.zippers[k]);
  }
  return {kept.begin(), kept.end()};
}

std::vector<FreeZipper> select_free_zippers(const RepairState& state, const SelectionOptions& options) {
  double mean_target = 0;
  for (double l : state.target_length) mean_target += l / static_cast<double>(state.target_length.size());
  std::vector<FreeZipper> selected;
  for (const FlowChain& chain : flow_chains(state)) {
    if (chain.zippers.empty()) continue;
    std::array<bool, 2> surface{}, reversed{};
    for (std::size_t end = 0; end < 2 && !chain.closed; ++end) {
      const VertexId v = end == 0 ? chain.vertices.front() : chain.vertices.back();
      surface[end] = on_feature_face(state, v);
      if (!surface[end]) continue;
      const auto node =
          classify_vertex(state.mesh, state.features, state.field, state.codes, v, singular_edges_at(state, v));
      reversed[end] = node.kind == NodeKind::zipper;
    }
    for (std::size_t i : kept_zippers(chain, mean_target, surface, reversed, options)) {
      const std::size_t before = i == 0 ? chain.vertices.size() - 2 : i - 1;
      FreeZipper z;
      z.node = chain.vertices[i];
      z.edges = {edge_key(chain.vertices[before], z.node), edge_key(z.node, chain.vertices[i + 1])};
      if (state.codes.at(z.edges[0]) > 0) std::swap(z.edges[0], z.edges[1]);
      z.arc_length = chain.length;
      selected.push_back(z);
    }
  }
  std::sort(selected.begin(), selected.end(), [](const FreeZipper& a, const FreeZipper& b) {
    return a.arc_length != b.arc_length ? a.arc_length > b.arc_length : a.node < b.node;
  });
  return selected;
}

}  // namespace hexfield
