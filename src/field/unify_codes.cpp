#include <algorithm>
#include <cmath>
#include <set>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/field/singularity_graph.hpp"

namespace hexfield {
namespace {

struct Link {
  EdgeKey edge;
  double flow;  // |mean cosine of axis and edge| times the length
  int sign;     // of the code; 0 for undetermined
};

struct Stretch {
  std::size_t begin, end;
  double flow;
  int sign;
};

bool is_quarter(EdgeCode code) { return code == 1 || code == -1 || code == undetermined_code; }

// The quarter-turn edges of the inside by vertex; a chain passes where exactly two singular edges meet.
class Chains {
 public:
  Chains(const TetMesh& mesh, const FrameField& field, const EdgeCodes& codes) : mesh_(mesh), field_(field) {
    for (const auto& [edge, code] : codes) {
      for (VertexId v : edge) ++degree_[v];
      const TetId seed = find_tet_with_edge(mesh, edge[0], edge[1]);
      const EdgeRing ring = edge_ring(mesh, seed, edge[0], edge[1]);
      if (!ring.closed || !is_quarter(code)) continue;
      const auto m = monodromy(field, ring);
      if (m == octahedral::identity || octahedral::is_compound(m) || m < 4) continue;
      links_.emplace(edge, Link{edge, flow(ring, octahedral::rotation_axis(m)), code == undetermined_code ? 0 : code});
      for (VertexId v : edge) edges_[v].push_back(edge);
    }
  }

  std::vector<std::vector<Link>> all() {
    std::vector<std::vector<Link>> chains;
    for (const auto& [v, edges] : edges_)
      if (!passes(v))
        for (const EdgeKey& e : edges)
          if (used_.insert(e).second) chains.push_back(walk(e, v));
    for (const auto& entry : links_)  // closed chains
      if (used_.insert(entry.first).second) chains.push_back(walk(entry.first, entry.first[0]));
    return chains;
  }

 private:
  bool passes(VertexId v) const {
    const auto found = edges_.find(v);
    return found != edges_.end() && found->second.size() == 2 && degree_.at(v) == 2;
  }

  std::vector<Link> walk(EdgeKey edge, VertexId from) {
    std::vector<Link> chain{links_.at(edge)};
    for (;;) {
      const VertexId to = edge[0] == from ? edge[1] : edge[0];
      if (!passes(to)) return chain;
      const auto& two = edges_.at(to);
      const EdgeKey next = two[0] == edge ? two[1] : two[0];
      if (!used_.insert(next).second) return chain;
      chain.push_back(links_.at(next));
      edge = next;
      from = to;
    }
  }

  double flow(const EdgeRing& ring, octahedral::Label axis) const {
    const auto labels = transport_around(field_, ring, axis);
    const Vec3 e = mesh_.point(ring_end(ring, 1)) - mesh_.point(ring_end(ring, 0));
    double sum = 0;
    for (std::size_t k = 0; k < ring.tets.size(); ++k)
      sum += (field_.frames[ring.tets[k].index()] * octahedral::direction(labels[k])).dot(e);
    return std::abs(sum) / static_cast<double>(ring.tets.size());
  }

  // The two vertices that the first and the last crossing share with all tets: the ends of the edge.
  VertexId ring_end(const EdgeRing& ring, int which) const {
    int seen = 0;
    for (VertexId v : mesh_.vertices(ring.tets[0])) {
      const bool in_all =
          std::all_of(ring.tets.begin(), ring.tets.end(), [&](TetId t) { return mesh_.has_vertex(t, v); });
      if (in_all && seen++ == which) return v;
    }
    throw Error(ExitCode::bug, "A ring of tets has no common edge.");
  }

  const TetMesh& mesh_;
  const FrameField& field_;
  std::map<VertexId, int> degree_;
  std::map<VertexId, std::vector<EdgeKey>> edges_;
  std::map<EdgeKey, Link> links_;
  std::set<EdgeKey> used_;
};

std::vector<Stretch> stretches(const std::vector<Link>& chain) {
  std::vector<Stretch> found;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    if (found.empty() || found.back().sign != chain[i].sign) found.push_back({i, i, 0, chain[i].sign});
    found.back().end = i + 1;
    found.back().flow += chain[i].sign == 0 ? 0 : chain[i].flow;
  }
  return found;
}

void unify(std::vector<Link>& chain, double share) {
  double total = 0;
  for (const Link& l : chain) total += l.sign == 0 ? 0 : l.flow;
  for (;;) {
    const auto parts = stretches(chain);
    if (parts.size() < 2) return;
    const auto least = std::min_element(parts.begin(), parts.end(), [](const Stretch& a, const Stretch& b) {
      return a.flow < b.flow - 1e-12 || (a.flow < b.flow + 1e-12 && a.begin < b.begin);
    });
    if (least->sign != 0 && least->flow >= share * total) return;
    const bool has_left = least != parts.begin();
    const bool has_right = least + 1 != parts.end();
    const double left = has_left ? (least - 1)->flow : -1;
    const double right = has_right ? (least + 1)->flow : -1;
    const int sign = left >= right ? (least - 1)->sign : (least + 1)->sign;
    for (std::size_t i = least->begin; i < least->end; ++i) chain[i].sign = sign;
    if (sign == 0) return;
  }
}

}  // namespace

int unify_codes(const TetMesh& mesh, const FrameField& field, EdgeCodes& codes, double share) {
  int changed = 0;
  for (std::vector<Link>& chain : Chains(mesh, field, codes).all()) {
    unify(chain, share);
    for (const Link& l : chain) {
      EdgeCode& code = codes.at(l.edge);
      if (l.sign == 0 || code == l.sign) continue;
      code = l.sign;
      ++changed;
    }
  }
  return changed;
}

}  // namespace hexfield
