#include "sheet_search.hpp"

#include <algorithm>
#include <map>

#include "hexfield/hex/sheet.hpp"

namespace hexfield::hex {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

constexpr std::int64_t steps_between_looks = 256;

// The curves that chosen quads form around a vertex, as unions of the edges at it.
struct Curves {
  int closed = 0;
  int finished = 0;  // from boundary to boundary
  int open = 0;
  int longest = 0;
};

Curves curves_at(const HexComplex& complex, int v, const auto& is_chosen) {
  const auto edges = complex.vertex_edges[v];
  const auto local = [&](int e) {
    return static_cast<int>(std::lower_bound(edges.begin(), edges.end(), e) - edges.begin());
  };
  std::vector<std::array<int, 2>> next(edges.size(), {-1, -1});
  std::vector<int> degree(edges.size(), 0);
  for (std::size_t k = 0; k < edges.size(); ++k)
    for (int q : complex.edge_quads[edges[k]])
      if (is_chosen(q) && degree[k] < 2) next[k][at(degree[k]++)] = local(complex.next_edge(q, edges[k], v));
  Curves out;
  std::vector<char> seen(edges.size(), 0);
  for (const int wanted : {1, 2})  // paths first, what remains is closed
    for (std::size_t start = 0; start < edges.size(); ++start) {
      if (degree[start] != wanted || seen[start] != 0) continue;
      int length = 0;
      int loose = 0;
      for (int k = static_cast<int>(start), from = -1; k >= 0 && seen[at(k)] == 0;) {
        seen[at(k)] = 1;
        ++length;
        if (degree[at(k)] == 1 && !complex.is_boundary_edge(edges[at(k)])) ++loose;
        const int to = next[at(k)][0] != from ? next[at(k)][0] : next[at(k)][1];
        from = k;
        k = to;
      }
      out.longest = std::max(out.longest, length);
      ++(wanted == 2 ? out.closed : loose == 0 ? out.finished : out.open);
    }
  return out;
}

}  // namespace

SheetSearch::SheetSearch(const HexMesh& mesh, const HexComplex& complex, const QuadClasses& classes,
                         const std::vector<VertexSphere>& spheres, NodeMeasure& measure, const SearchLimits& limits,
                         const Control& control)
    : mesh_(mesh),
      complex_(complex),
      classes_(classes),
      spheres_(spheres),
      measure_(measure),
      limits_(limits),
      control_(control),
      chosen_(classes.usable.size(), 0),
      banned_(classes.usable.size(), 0),
      count_(complex.edges.size(), 0) {}

bool SheetSearch::vertex_allows(int v) const {
  const Curves curves = curves_at(complex_, v, [&](int q) {
    const int c = classes_.class_of[at(q)];
    return c >= 0 && chosen_[at(c)] != 0;
  });
  if (complex_.is_boundary_vertex(v))
    return curves.closed == 0 && curves.finished <= 1 && (curves.finished == 0 || curves.open == 0);
  return curves.longest <= limits_.max_valence && (curves.closed == 0 || (curves.closed == 1 && curves.open == 0));
}

// Valences of the two copies of a singular edge between two chosen quads.
bool SheetSearch::edge_allows(int e) const {
  const auto quads = complex_.edge_quads[e];
  std::array<int, 2> pair{-1, -1};
  std::size_t n = 0;
  for (int q : quads)
    if (chosen_[at(classes_.class_of[at(q)])] != 0 && n < 2) pair[n++] = q;
  if (n < 2) return true;
  // Hexes passed on the way from the first to the second.
  int passed = 0;
  int hex = complex_.quad_hexes[at(pair[0])][0];
  for (int q = pair[0];;) {
    ++passed;
    for (int other : complex_.hex_quads[at(hex)])
      if (other != q && std::find(quads.begin(), quads.end(), other) != quads.end()) {
        q = other;
        break;
      }
    if (q == pair[1]) break;
    const auto& hexes = complex_.quad_hexes[at(q)];
    hex = hexes[0] == hex ? hexes[1] : hexes[0];
  }
  const int other_side = static_cast<int>(quads.size()) - passed;
  return std::max(passed, other_side) + 2 <= limits_.max_valence;
}

bool SheetSearch::add_class(int c) {
  chosen_[at(c)] = 1;
  order_.push_back(c);
  for (int other : classes_.conflicts[c]) ++banned_[at(other)];
  bool good = true;
  const auto rims = classes_.rims[c];
  for (int e : rims) {
    int here = 0;
    for (int q : complex_.edge_quads[e]) here += classes_.class_of[at(q)] == c ? 1 : 0;
    count_[at(e)] = static_cast<char>(count_[at(e)] + here);
    if (count_[at(e)] > 2) good = false;
    open_.push_back(e);
  }
  for (int e : rims) good = good && (count_[at(e)] != 2 || edge_allows(e));
  if (good)
    for (int v : classes_.special[c])
      if (!vertex_allows(v)) return false;
  return good;
}

void SheetSearch::remove_last() {
  const int c = order_.back();
  order_.pop_back();
  chosen_[at(c)] = 0;
  for (int other : classes_.conflicts[c]) --banned_[at(other)];
  for (int e : classes_.rims[c]) {
    int here = 0;
    for (int q : complex_.edge_quads[e]) here += classes_.class_of[at(q)] == c ? 1 : 0;
    count_[at(e)] = static_cast<char>(count_[at(e)] - here);
    open_.pop_back();
  }
}

std::vector<int> SheetSearch::options(int e) const {
  std::vector<int> out;
  for (int q : complex_.edge_quads[e]) {
    const int c = classes_.class_of[at(q)];
    if (chosen_[at(c)] == 0 && banned_[at(c)] == 0 && classes_.usable[at(c)] != 0) out.push_back(c);
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  std::stable_sort(out.begin(), out.end(),
                   [&](int a, int b) { return classes_.quads[a].size() < classes_.quads[b].size(); });
  return out;
}

// An edge with one chosen quad: of the newest few the one with the fewest ways on. -1 when the rim is closed.
int SheetSearch::choose_edge() const {
  int best = -1;
  std::size_t fewest = 1000;
  int looked = 0;
  for (std::size_t k = open_.size(); k-- > 0 && looked < 24;) {
    if (count_[at(open_[k])] != 1) continue;
    ++looked;
    const std::size_t ways = options(open_[k]).size();
    if (ways < fewest) {
      fewest = ways;
      best = open_[k];
    }
    if (fewest <= 1) break;
  }
  return best;
}

void SheetSearch::keep() {
  SheetCandidate sheet;
  for (int c : order_) {
    const auto quads = classes_.quads[c];
    sheet.quads.insert(sheet.quads.end(), quads.begin(), quads.end());
  }
  std::sort(sheet.quads.begin(), sheet.quads.end());
  if (evaluate(sheet.quads, sheet.change)) found_->push_back(std::move(sheet));
  if (found_->size() - first_found_ >= limits_.sheets) complete_ = false;
}

void SheetSearch::extend() {
  const int e = choose_edge();
  if (e < 0) {
    keep();
    return;
  }
  for (int c : options(e)) {
    if (++steps_ > limits_.steps) complete_ = false;
    if (steps_ % steps_between_looks == 1 && control_.stop_requested && control_.stop_requested())
      throw Error(ExitCode::stopped, "Stopped while sheets were searched for.");
    if (steps_ > limits_.steps || found_->size() - first_found_ >= limits_.sheets) return;
    if (add_class(c)) extend();
    remove_last();
  }
}

bool SheetSearch::find(const std::vector<int>& seed, std::vector<SheetCandidate>& out) {
  found_ = &out;
  first_found_ = out.size();
  steps_ = 0;
  complete_ = true;
  std::vector<int> start;
  for (int q : seed) start.push_back(classes_.class_of[at(q)]);
  std::sort(start.begin(), start.end());
  start.erase(std::unique(start.begin(), start.end()), start.end());
  bool good = true;
  for (int c : start) {
    good = good && c >= 0 && classes_.usable[at(c)] != 0 && banned_[at(c)] == 0;
    if (!good) break;
    good = add_class(c);
  }
  if (good) extend();
  while (!order_.empty()) remove_last();
  all_steps_ += steps_;
  return complete_;
}

bool SheetSearch::evaluate(const std::vector<int>& quads, int& change) {
  std::map<int, std::vector<std::array<int, 2>>> arcs;  // at vertices with a sphere: pairs of sphere vertices
  for (int q : quads)
    for (int v : complex_.quads[at(q)]) {
      if (spheres_[at(v)].edges.empty()) continue;
      const auto& edges = spheres_[at(v)].edges;
      std::array<int, 2> arc{-1, -1};
      std::size_t n = 0;
      for (int e : complex_.quad_edges[at(q)])
        if (complex_.edges[at(e)][0] == v || complex_.edges[at(e)][1] == v)
          arc[n++] = static_cast<int>(std::lower_bound(edges.begin(), edges.end(), e) - edges.begin());
      arcs[v].push_back(arc);
    }
  change = 0;
  for (auto& [v, list] : arcs) {
    std::vector<int> cycle{list[0][0], list[0][1]};
    std::vector<char> used(list.size(), 0);
    used[0] = 1;
    while (cycle.front() != cycle.back()) {
      std::size_t k = 0;
      while (k < list.size() && (used[k] != 0 || (list[k][0] != cycle.back() && list[k][1] != cycle.back()))) ++k;
      if (k == list.size()) return false;
      used[k] = 1;
      cycle.push_back(list[k][0] == cycle.back() ? list[k][1] : list[k][0]);
    }
    cycle.pop_back();
    if (cycle.size() != list.size() || cycle.size() < 3) return false;
    const SphereTriangulation& sphere = spheres_[at(v)].sphere;
    const SphereSplit halves = split(sphere, cycle);
    const int most = std::max(limits_.max_valence, sphere.max_degree());
    if (halves.left.max_degree() > most || halves.right.max_degree() > most) return false;
    change += measure_(halves.left) + measure_(halves.right) - measure_(sphere);
  }
  return true;
}

std::vector<int> SheetSearch::propagate_greedily(const std::vector<int>& seed) {
  std::vector<char> in(complex_.quads.size(), 0);
  std::vector<int> quads;
  const auto add = [&](int q) {
    const int c = classes_.class_of[at(q)];
    if (c < 0 || classes_.usable[at(c)] == 0) return false;
    for (int member : classes_.quads[c])  // parallel faces come along
      if (in[at(member)] == 0) {
        in[at(member)] = 1;
        quads.push_back(member);
      }
    return true;
  };
  for (int q : seed)
    if (!add(q)) return {};
  for (;;) {
    // The lowest interior singular vertex with an open path of quads.
    int vertex = -1;
    std::vector<int> ends;
    for (int q : quads)
      for (int e : complex_.quad_edges[at(q)]) {
        if (!complex_.is_singular(e)) continue;
        int here = 0;
        for (int other : complex_.edge_quads[e]) here += in[at(other)];
        if (here > 2) return {};
        if (here == 1)
          for (int v : complex_.edges[at(e)])
            if (!complex_.is_boundary_vertex(v) && (vertex < 0 || v < vertex)) vertex = v;
      }
    if (vertex < 0) break;
    // Shortest path of edges at the vertex between the loose ends that leaves out those inside the path.
    const auto around = complex_.vertex_edges[vertex];
    std::map<int, int> degree;
    for (int e : around)
      for (int q : complex_.edge_quads[e]) degree[e] += in[at(q)];
    for (int e : around)
      if (degree[e] == 1) ends.push_back(e);
    if (ends.size() != 2) return {};
    std::map<int, std::pair<int, int>> from;  // edge -> (edge before, quad)
    std::vector<int> queue{ends[0]};
    from[ends[0]] = {-1, -1};
    for (std::size_t k = 0; k < queue.size() && !from.contains(ends[1]); ++k)
      for (int q : complex_.edge_quads[queue[k]]) {
        const int f = complex_.next_edge(q, queue[k], vertex);
        if (in[at(q)] != 0 || from.contains(f) || (degree[f] != 0 && f != ends[1])) continue;
        from[f] = {queue[k], q};
        queue.push_back(f);
      }
    if (!from.contains(ends[1])) return {};
    for (int e = ends[1]; from[e].first >= 0; e = from[e].first)
      if (!add(from[e].second)) return {};
  }
  std::sort(quads.begin(), quads.end());
  return sheet_sides(mesh_, complex_, quads, {}).defect.empty() ? quads : std::vector<int>{};
}

}  // namespace hexfield::hex
