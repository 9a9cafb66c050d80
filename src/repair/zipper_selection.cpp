#include "hexfield/repair/zipper_selection.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/field/singularity_graph.hpp"
#include "hexfield/repair/free_ends.hpp"
#include "hexfield/repair/state_ops.hpp"

namespace hexfield {
namespace {

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
  if (chain.closed) return;
  for (std::size_t end = 0; end < 2; ++end) {
    const VertexId v = end == 0 ? chain.vertices.front() : chain.vertices.back();
    chain.on_surface[end] = on_feature_face(state, v);
    if (!chain.on_surface[end] || !is_free_zipper(state, v)) continue;
    chain.zippers.insert(end == 0 ? chain.zippers.begin() : chain.zippers.end(), end == 0 ? 0 : edges);
  }
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

bool is_free_zipper(const RepairState& state, VertexId v) {
  if (is_zipper_on_curve(state, v)) return true;
  const auto edges = singular_edges_at(state, v);
  if (edges.size() == 2)
    return std::abs(code_of(state, edges[0])) == 1 && code_of(state, edges[0]) == -code_of(state, edges[1]) &&
           !on_feature_face(state, v);
  if (edges.size() != 1 || std::abs(code_of(state, edges[0])) != 1 || !on_boundary(state.mesh, v)) return false;
  for (const EdgeKey& e : edges_at(state.mesh, v))
    if (state.features.edges.contains(e)) return false;
  return classify_vertex(state.mesh, state.features, state.field, state.codes, v, edges).kind == NodeKind::zipper;
}

FreeZipper free_zipper_at(const RepairState& state, VertexId v) {
  FreeZipper z;
  z.node = v;
  z.edges = singular_edges_at(state, v);
  std::erase_if(z.edges, [&](const EdgeKey& e) { return state.features.edges.contains(e); });
  if (z.edges.size() == 2 && code_of(state, z.edges[0]) > 0) std::swap(z.edges[0], z.edges[1]);
  return z;
}

namespace {

// Flow between consecutive zipper nodes and ends.
struct Segments {
  std::vector<double> before, after;  // per zipper node; infinite beyond a surface, 0 beyond another end
  double mean = 0;
};

Segments segments_of(const FlowChain& chain) {
  const std::size_t end = chain.vertices.size() - 1, zippers = chain.zippers.size();
  auto stretch = [&](std::size_t a, std::size_t b) { return std::abs(chain.flow[a] - chain.flow[b]); };
  Segments s;
  std::set<std::size_t> stops(chain.zippers.begin(), chain.zippers.end());
  stops.insert({0, end});
  for (auto it = std::next(stops.begin()); it != stops.end(); ++it)
    s.mean += stretch(*std::prev(it), *it) / static_cast<double>(stops.size() - 1);
  const double surface = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < zippers; ++k) {
    const std::size_t here = chain.zippers[k];
    if (k > 0)
      s.before.push_back(stretch(chain.zippers[k - 1], here));
    else
      s.before.push_back(chain.closed ? stretch(chain.zippers.back(), end)
                                      : (chain.on_surface[0] ? surface : stretch(0, here)));
    if (k + 1 < zippers)
      s.after.push_back(stretch(here, chain.zippers[k + 1]));
    else
      s.after.push_back(!chain.closed && chain.on_surface[1] ? surface : stretch(here, end));
  }
  return s;
}

// The highest (or lowest) zipper node if it lies beyond both ends by `margin`.
void add_peak(const FlowChain& chain, double sign, double margin, std::set<std::size_t>& kept) {
  std::size_t best = chain.zippers.front();
  for (std::size_t i : chain.zippers)
    if (sign * chain.flow[i] > sign * chain.flow[best]) best = i;
  const double end = std::max(sign * chain.flow.front(), sign * chain.flow.back());
  if (sign * chain.flow[best] >= end + margin) kept.insert(best);
}

}  // namespace

std::vector<std::size_t> kept_zippers(const FlowChain& chain, double mean_target, const SelectionOptions& options) {
  const std::size_t count = chain.zippers.size();
  if (count == 0) return {};
  const Segments s = segments_of(chain);
  std::set<std::size_t> kept;
  if (!chain.closed && count % 2 == 1) {
    // The flow turns back at a zipper node: whether down or up tells where the first one lies.
    const std::size_t first = chain.zippers.front();
    const double beside = chain.flow[first == 0 ? 1 : first - 1];
    add_peak(chain, chain.flow[first] > beside ? 1 : -1, -std::numeric_limits<double>::infinity(), kept);
  } else if (!chain.closed) {
    add_peak(chain, 1, options.peak * s.mean, kept);
    add_peak(chain, -1, options.peak * s.mean, kept);
  }
  if (count > 2 && static_cast<double>(count) > options.crowded * static_cast<double>(chain.vertices.size()))
    return {kept.begin(), kept.end()};
  const double longer = std::min(options.segment * s.mean, options.absolute_segment * mean_target);
  for (std::size_t k = 0; k < count; ++k)
    if (s.before[k] > longer && s.after[k] > longer && std::isfinite(std::min(s.before[k], s.after[k])))
      kept.insert(chain.zippers[k]);
  return {kept.begin(), kept.end()};
}

std::vector<FreeZipper> select_free_zippers(const RepairState& state, const SelectionOptions& options) {
  double mean_target = 0;
  for (double l : state.target_length) mean_target += l / static_cast<double>(state.target_length.size());
  std::vector<FreeZipper> selected;
  for (const FlowChain& chain : flow_chains(state))
    for (std::size_t i : kept_zippers(chain, mean_target, options)) {
      selected.push_back(free_zipper_at(state, chain.vertices[i]));
      selected.back().arc_length = chain.length;
    }
  std::sort(selected.begin(), selected.end(), [](const FreeZipper& a, const FreeZipper& b) {
    return a.arc_length != b.arc_length ? a.arc_length > b.arc_length : a.node < b.node;
  });
  return selected;
}

}  // namespace hexfield
