#include "hexfield/hex/sphere_triangulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "hexfield/base/error.hpp"

namespace hexfield {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Neighbours of v in order, from the successors that its triangles give; false when they are not one circle.
bool ring_of(const std::map<int, int>& next, std::vector<int>& ring) {
  if (next.empty()) return false;
  const int first = next.begin()->first;
  int w = first;
  do {
    ring.push_back(w);
    const auto found = next.find(w);
    if (found == next.end() || ring.size() > next.size()) return false;
    w = found->second;
  } while (w != first);
  return ring.size() == next.size();
}

}  // namespace

int SphereTriangulation::max_degree() const {
  std::size_t most = 0;
  for (const auto& ring : rings) most = std::max(most, ring.size());
  return static_cast<int>(most);
}

bool SphereTriangulation::has_edge(int a, int b) const {
  const auto& ring = rings[at(a)];
  return std::find(ring.begin(), ring.end(), b) != ring.end();
}

std::vector<std::array<int, 3>> SphereTriangulation::triangles() const {
  std::vector<std::array<int, 3>> out;
  for (int v = 0; v < size(); ++v) {
    const auto& ring = rings[at(v)];
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const int a = ring[k];
      const int b = ring[(k + 1) % ring.size()];
      if (v < a && v < b) out.push_back({v, a, b});
    }
  }
  return out;
}

bool try_sphere_from_triangles(int vertices, const std::vector<std::array<int, 3>>& triangles,
                               SphereTriangulation& sphere, std::string& reason) {
  std::vector<std::map<int, int>> next(at(vertices));
  for (const auto& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const int v = t[k];
      const int a = t[(k + 1) % 3];
      const int b = t[(k + 2) % 3];
      if (v < 0 || v >= vertices || a == v || b == v || a == b || !next[at(v)].emplace(a, b).second) {
        reason = fmt::format("the edge ({}, {}) is met twice in one direction", v, a);
        return false;
      }
    }
  sphere.rings.assign(at(vertices), {});
  std::size_t ends = 0;
  for (int v = 0; v < vertices; ++v) {
    auto& ring = sphere.rings[at(v)];
    if (!ring_of(next[at(v)], ring)) {
      reason = fmt::format("the triangles at vertex {} are not one closed fan", v);
      return false;
    }
    if (ring.size() < 3) {
      reason = fmt::format("vertex {} has degree {}", v, ring.size());
      return false;
    }
    ends += ring.size();
  }
  const auto characteristic = static_cast<std::int64_t>(vertices) - static_cast<std::int64_t>(ends / 2) +
                              static_cast<std::int64_t>(triangles.size());
  if (characteristic != 2) {
    reason = fmt::format("its Euler characteristic is {}, not 2", characteristic);
    return false;
  }
  return true;
}

SphereTriangulation sphere_from_triangles(int vertices, const std::vector<std::array<int, 3>>& triangles) {
  SphereTriangulation sphere;
  std::string reason;
  if (!try_sphere_from_triangles(vertices, triangles, sphere, reason))
    throw Error(ExitCode::bad_input, fmt::format("No triangulation of the sphere: {}.", reason));
  return sphere;
}

std::vector<int> signature(const SphereTriangulation& sphere) {
  std::vector<int> count(3, 0);
  for (int v = 0; v < sphere.size(); ++v) {
    const std::size_t k = at(sphere.degree(v) - 3);
    if (k >= count.size()) count.resize(k + 1, 0);
    ++count[k];
  }
  return count;
}

std::string signature_text(const SphereTriangulation& sphere) {
  return fmt::format("({})", fmt::join(signature(sphere), ","));
}

VertexType vertex_type(const SphereTriangulation& sphere) {
  int singular = 0;
  for (int v = 0; v < sphere.size(); ++v) singular += sphere.degree(v) != 4 ? 1 : 0;
  return singular == 0 ? VertexType::regular : singular == 2 ? VertexType::curve : VertexType::node;
}

}  // namespace hexfield
