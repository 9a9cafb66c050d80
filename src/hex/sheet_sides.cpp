#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "hexfield/hex/sheet.hpp"

namespace hexfield {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Number of v in a sorted list, -1 when it is not there.
int place(const std::vector<int>& sorted, int v) {
  const auto found = std::lower_bound(sorted.begin(), sorted.end(), v);
  return found != sorted.end() && *found == v ? static_cast<int>(found - sorted.begin()) : -1;
}

void sort_unique(std::vector<int>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

class SideFinder {
 public:
  SideFinder(const HexMesh& mesh, const HexComplex& complex) : mesh_(mesh), complex_(complex) {}

  SheetSides run(std::vector<int> quads, const std::vector<int>& feature_quads) {
    sides_.quads = std::move(quads);
    sort_unique(sides_.quads);
    if (sides_.quads.empty()) return fail("it is empty");
    for (int q : sides_.quads) {
      if (complex_.is_boundary_quad(q)) return fail(fmt::format("quad {} is on the boundary", q));
      if (place(feature_quads, q) >= 0) return fail(fmt::format("quad {} belongs to a feature surface", q));
    }
    in_sheet_.assign(complex_.quads.size(), 0);
    for (int q : sides_.quads) in_sheet_[at(q)] = 1;
    if (!orient()) return std::move(sides_);
    choose_first_side();
    for (int q : sides_.quads)
      for (int v : complex_.quads[at(q)]) sides_.vertices.push_back(v);
    sort_unique(sides_.vertices);
    for (int v : sides_.vertices)
      if (!divide(v)) return std::move(sides_);
    std::sort(sides_.b_corners.begin(), sides_.b_corners.end());
    return std::move(sides_);
  }

 private:
  SheetSides fail(std::string reason) {
    sides_.defect = std::move(reason);
    return std::move(sides_);
  }
  bool failed(std::string reason) {
    sides_.defect = std::move(reason);
    return false;
  }
  bool orient();
  int turn(int edge, int quad, int hex, int& next_quad) const;
  void choose_first_side();
  bool divide(int vertex);

  const HexMesh& mesh_;
  const HexComplex& complex_;
  SheetSides sides_;
  std::vector<char> in_sheet_;
};

// From `quad` through `hex` around the edge to the next quad of the sheet; the last hex before it.
int SideFinder::turn(int edge, int quad, int hex, int& next_quad) const {
  int q = quad;
  for (;;) {
    int across = -1;
    for (int other : complex_.hex_quads[at(hex)]) {
      const auto& edges = complex_.quad_edges[at(other)];
      if (other != q && std::find(edges.begin(), edges.end(), edge) != edges.end()) across = other;
    }
    if (in_sheet_[at(across)] != 0 || complex_.is_boundary_quad(across)) {
      next_quad = across;
      return hex;
    }
    q = across;
    const auto& hexes = complex_.quad_hexes[at(q)];
    hex = hexes[0] == hex ? hexes[1] : hexes[0];
  }
}

bool SideFinder::orient() {
  const std::size_t n = sides_.quads.size();
  sides_.a_hexes.assign(n, -1);
  sides_.a_hexes[0] = complex_.quad_hexes[at(sides_.quads[0])][0];
  std::vector<std::size_t> stack{0};
  std::size_t seen = 1;
  while (!stack.empty()) {
    const std::size_t k = stack.back();
    stack.pop_back();
    const int q = sides_.quads[k];
    for (int e : complex_.quad_edges[at(q)]) {
      int here = 0;
      for (int other : complex_.edge_quads[e]) here += in_sheet_[at(other)];
      const int wanted = complex_.is_boundary_edge(e) ? 1 : 2;
      if (here != wanted)
        return failed(fmt::format("edge ({}, {}) has {} of its quads, not {}", complex_.edges[at(e)][0],
                                  complex_.edges[at(e)][1], here, wanted));
      if (wanted == 1) continue;
      int next = -1;
      const int hex = turn(e, q, sides_.a_hexes[k], next);
      const auto m = at(place(sides_.quads, next));
      if (sides_.a_hexes[m] < 0) {
        sides_.a_hexes[m] = hex;
        stack.push_back(m);
        ++seen;
      } else if (sides_.a_hexes[m] != hex) {
        return failed("it has one side only");
      }
    }
  }
  return seen == n || failed("it is not connected");
}

// Side A becomes that of hex 0 when the sheet separates.
void SideFinder::choose_first_side() {
  std::vector<char> seen(mesh_.hexes.size(), 0);
  std::vector<int> stack{0};
  seen[0] = 1;
  while (!stack.empty()) {
    const int h = stack.back();
    stack.pop_back();
    for (int q : complex_.hex_quads[at(h)]) {
      const auto& hexes = complex_.quad_hexes[at(q)];
      const int other = hexes[0] == h ? hexes[1] : hexes[0];
      if (in_sheet_[at(q)] != 0 || other < 0 || seen[at(other)] != 0) continue;
      seen[at(other)] = 1;
      stack.push_back(other);
    }
  }
  const auto& hexes = complex_.quad_hexes[at(sides_.quads[0])];
  const int a = sides_.a_hexes[0];
  const int b = hexes[0] == a ? hexes[1] : hexes[0];
  if (seen[at(a)] != 0 || seen[at(b)] == 0) return;
  for (std::size_t k = 0; k < sides_.quads.size(); ++k) {
    const auto& pair = complex_.quad_hexes[at(sides_.quads[k])];
    sides_.a_hexes[k] = pair[0] == sides_.a_hexes[k] ? pair[1] : pair[0];
  }
}

// The hexes at a vertex fall into one part on each side.
bool SideFinder::divide(int vertex) {
  const auto corners = complex_.vertex_corners[vertex];
  std::map<int, int> side;  // per hex: 0 unknown, 1 A, 2 B
  for (int slot : corners) side[slot / 8] = 0;
  const auto quads_at = [&](int h) {
    std::vector<int> out;
    for (int q : complex_.hex_quads[at(h)])
      if (std::find(complex_.quads[at(q)].begin(), complex_.quads[at(q)].end(), vertex) != complex_.quads[at(q)].end())
        out.push_back(q);
    return out;
  };
  const auto fill = [&](int start, int value) {
    side[start] = value;
    std::vector<int> stack{start};
    while (!stack.empty()) {
      const int h = stack.back();
      stack.pop_back();
      for (int q : quads_at(h)) {
        const auto& hexes = complex_.quad_hexes[at(q)];
        const int other = hexes[0] == h ? hexes[1] : hexes[0];
        if (in_sheet_[at(q)] != 0 || other < 0 || side[other] != 0) continue;
        side[other] = value;
        stack.push_back(other);
      }
    }
  };
  bool good = true;
  std::array<int, 3> parts{};
  for (int slot : corners)
    for (int q : quads_at(slot / 8)) {
      if (in_sheet_[at(q)] == 0) continue;
      const int value = sides_.a_hexes[at(place(sides_.quads, q))] == slot / 8 ? 1 : 2;
      int& known = side[slot / 8];
      if (known == 0) {
        fill(slot / 8, value);
        ++parts[at(value)];
      }
      good = good && known == value;
    }
  for (const auto& [h, value] : side) good = good && value != 0;
  if (!good || parts[1] != 1 || parts[2] != 1) {
    sides_.defect_vertex = vertex;
    return failed(fmt::format("it passes vertex {} more than once", vertex));
  }
  for (int slot : corners)
    if (side[slot / 8] == 2) sides_.b_corners.push_back(slot);
  return true;
}

}  // namespace

SheetSides sheet_sides(const HexMesh& mesh, const HexComplex& complex, std::vector<int> quads,
                       const std::vector<int>& feature_quads) {
  return SideFinder(mesh, complex).run(std::move(quads), feature_quads);
}

std::vector<int> feature_quads_of(const HexMesh& mesh, const HexComplex& complex) {
  std::vector<int> out;
  for (const auto& quad : mesh.feature_quads) {
    const int q = complex.find_quad(quad.vertices);
    if (q >= 0) out.push_back(q);
  }
  sort_unique(out);
  return out;
}

}  // namespace hexfield
