#include "boundary_passes.hpp"

#include <algorithm>
#include <map>

namespace hexfield::hex {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

constexpr int most_tries = 20000;  // quads, in all

class ArcSearch {
 public:
  ArcSearch(const HexComplex& complex, const QuadClasses& classes, int vertex)
      : complex_(complex), classes_(classes), vertex_(vertex) {
    for (int e : complex.vertex_edges[vertex])
      for (int q : complex.edge_quads[e])
        if (const int c = classes.class_of[at(q)]; c >= 0) ++twice_[c];  // each quad has two edges at the vertex
  }

  std::optional<std::vector<std::vector<int>>> run() {
    for (int e : complex_.vertex_edges[vertex_]) {
      if (!complex_.is_boundary_edge(e)) continue;
      first_ = e;
      edges_ = {e};
      extend(e, -1);
    }
    if (tries_ > most_tries) return std::nullopt;
    std::sort(found_.begin(), found_.end());
    found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
    return std::move(found_);
  }

 private:
  bool shares_hex(int q, int other) const {
    for (int h : complex_.quad_hexes[at(q)])
      for (int g : complex_.quad_hexes[at(other)])
        if (h == g && h >= 0) return true;
    return false;
  }

  // On from edge e, which was reached over quad `from`.
  void extend(int e, int from) {
    for (int q : complex_.edge_quads[e]) {
      const int c = classes_.class_of[at(q)];
      if (q == from || c < 0 || classes_.usable[at(c)] == 0) continue;
      if (from >= 0 && complex_.valence(e) == 4 && shares_hex(q, from)) continue;
      if (++tries_ > most_tries) return;
      const int next = complex_.next_edge(q, e, vertex_);
      if (std::find(edges_.begin(), edges_.end(), next) != edges_.end()) continue;
      quads_.push_back(q);
      if (complex_.is_boundary_edge(next)) {
        if (next > first_) keep();  // each arc from one of its ends
      } else {
        edges_.push_back(next);
        extend(next, q);
        edges_.pop_back();
      }
      quads_.pop_back();
    }
  }

  void keep() {
    std::map<int, int> here;
    for (int q : quads_) here[classes_.class_of[at(q)]] += 2;
    std::vector<int> pass;
    for (const auto& [c, n] : here) {
      if (n != twice_.at(c)) return;
      pass.push_back(c);
    }
    found_.push_back(std::move(pass));
  }

  const HexComplex& complex_;
  const QuadClasses& classes_;
  int vertex_;
  int first_ = -1;
  int tries_ = 0;
  std::map<int, int> twice_;
  std::vector<int> edges_;
  std::vector<int> quads_;
  std::vector<std::vector<int>> found_;
};

}  // namespace

std::optional<std::vector<std::vector<int>>> boundary_passes(const HexComplex& complex, const QuadClasses& classes,
                                                             int vertex) {
  return ArcSearch(complex, classes, vertex).run();
}

}  // namespace hexfield::hex
