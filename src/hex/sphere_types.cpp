#include <map>

#include "hexfield/hex/sphere_triangulation.hpp"

namespace hexfield {
namespace {

using Triangles = std::vector<std::array<int, 3>>;
using Types = std::map<std::string, SphereTriangulation>;

// Replaces the fan of triangles between ring places k and k + removed + 1 at v by a new vertex.
void insert_vertex(const SphereTriangulation& sphere, int v, std::size_t k, std::size_t removed, Types& out) {
  const auto& ring = sphere.rings[static_cast<std::size_t>(v)];
  const std::size_t n = ring.size();
  if (removed + 2 > n) return;
  std::vector<int> hole{v};
  for (std::size_t i = 0; i <= removed + 1; ++i) hole.push_back(ring[(k + i) % n]);
  Triangles triangles;
  for (const auto& t : sphere.triangles()) {
    bool gone = false;
    for (std::size_t i = 0; i <= removed; ++i) {
      const int a = ring[(k + i) % n];
      const int b = ring[(k + i + 1) % n];
      const auto has = [&](int w) { return t[0] == w || t[1] == w || t[2] == w; };
      gone = gone || (has(v) && has(a) && has(b));
    }
    if (!gone) triangles.push_back(t);
  }
  for (std::size_t i = 0; i < hole.size(); ++i)
    triangles.push_back({hole[i], hole[(i + 1) % hole.size()], sphere.size()});
  SphereTriangulation grown;
  std::string reason;
  if (try_sphere_from_triangles(sphere.size() + 1, triangles, grown, reason)) {
    std::string code = canonical_code(grown);
    out.emplace(std::move(code), std::move(grown));
  }
}

}  // namespace

std::vector<std::vector<SphereTriangulation>> all_sphere_triangulations(int most) {
  std::vector<std::vector<SphereTriangulation>> out;
  if (most < 4) return out;
  out.push_back({sphere_from_triangles(4, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}})});
  while (static_cast<int>(out.size()) + 3 < most) {
    Types grown;
    for (const SphereTriangulation& sphere : out.back())
      for (int v = 0; v < sphere.size(); ++v)
        for (std::size_t k = 0; k < sphere.rings[static_cast<std::size_t>(v)].size(); ++k)
          for (std::size_t removed = 0; removed <= 2; ++removed) insert_vertex(sphere, v, k, removed, grown);
    out.emplace_back();
    for (auto& [code, sphere] : grown) out.back().push_back(std::move(sphere));
  }
  return out;
}

}  // namespace hexfield
