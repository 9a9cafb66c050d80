#include <algorithm>
#include <queue>

#include "hexfield/base/error.hpp"
#include "hexfield/hex/cut_table.hpp"

namespace hexfield {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// The cut of Proposition 1 through one vertex u and its ring.
class RingCut {
 public:
  RingCut(const SphereTriangulation& sphere, int u) : sphere_(sphere), u_(u), ring_(sphere.rings[at(u)]) {
    place_.assign(sphere.rings.size(), -1);
    for (std::size_t i = 0; i < ring_.size(); ++i) place_[at(ring_[i])] = static_cast<int>(i);
  }

  std::vector<int> run() {
    const int m = static_cast<int>(ring_.size());
    std::vector<char> tip(ring_.size(), 0);
    for (int i = 0; i < m; ++i)
      for (int w : sphere_.rings[at(ring_[at(i)])]) {
        const int j = place_[at(w)];
        const int apart = j < 0 ? 0 : std::min((j - i + m) % m, (i - j + m) % m);
        if (apart >= 3) return {u_, ring_[at(i)], w};  // rule 1
        if (apart == 2) tip[at((j - i + m) % m == 2 ? (i + 1) % m : (j + 1) % m)] = 1;
      }
    std::vector<int> best;  // rule 2, the shortest path
    for (int i = 0; i < m; ++i)
      for (int j = i + 3; j < m && j - i <= m - 3; ++j) {
        if (tip[at(i)] != 0 || tip[at(j)] != 0) continue;
        const std::vector<int> path = path_between(ring_[at(i)], ring_[at(j)]);
        if (!path.empty() && (best.empty() || path.size() + 1 < best.size())) {
          best = path;
          best.insert(best.begin(), u_);
        }
      }
    return best;
  }

 private:
  // Shortest path through vertices that are neither u nor in the ring.
  std::vector<int> path_between(int a, int b) const {
    std::vector<int> from(sphere_.rings.size(), -1);
    std::queue<int> queue;
    queue.push(a);
    from[at(a)] = a;
    while (!queue.empty()) {
      const int v = queue.front();
      queue.pop();
      for (int w : sphere_.rings[at(v)]) {
        if (from[at(w)] >= 0 || w == u_ || (place_[at(w)] >= 0 && w != b)) continue;
        from[at(w)] = v;
        if (w != b) queue.push(w);
      }
    }
    if (from[at(b)] < 0) return {};
    std::vector<int> path{b};
    while (path.back() != a) path.push_back(from[at(path.back())]);
    return path;
  }

  const SphereTriangulation& sphere_;
  int u_;
  const std::vector<int>& ring_;
  std::vector<int> place_;
};

// Rules 3 and 4: any cycle with smaller halves, else the base case with halves of valences 3, 4 and 5.
std::vector<int> any_cut(const SphereTriangulation& sphere) {
  std::vector<int> base;
  for (int length = 3; length <= sphere.size(); ++length)
    for (const auto& cycle : simple_cycles(sphere, length)) {
      if (static_cast<int>(cycle.size()) != length) continue;
      const SphereSplit halves = split(sphere, cycle);
      if (halves.left.size() < sphere.size() && halves.right.size() < sphere.size()) return cycle;
      if (base.empty() && halves.left.max_degree() <= 5 && halves.right.max_degree() <= 5) base = cycle;
    }
  return base;
}

}  // namespace

std::vector<int> general_cut(const SphereTriangulation& sphere) {
  const int m = sphere.max_degree();
  if (m < 6) throw Error(ExitCode::bad_input, "A general cut needs a vertex of degree 6 or more.");
  std::vector<int> best;
  for (int u = 0; u < sphere.size(); ++u) {
    if (sphere.degree(u) != m) continue;
    const std::vector<int> cycle = RingCut(sphere, u).run();
    if (!cycle.empty() && (best.empty() || cycle.size() < best.size())) best = cycle;
  }
  if (best.empty()) best = any_cut(sphere);
  require(!best.empty(), "Every triangulation with a degree above 5 has a cut.");
  return best;
}

}  // namespace hexfield
