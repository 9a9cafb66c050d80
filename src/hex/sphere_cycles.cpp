#include <algorithm>

#include "hexfield/base/error.hpp"
#include "hexfield/hex/sphere_triangulation.hpp"

namespace hexfield {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Depth-first search for cycles whose lowest vertex is the first of the path.
class CycleSearch {
 public:
  CycleSearch(const SphereTriangulation& sphere, int longest) : longest_(longest), used_(sphere.rings.size(), 0) {
    for (const auto& ring : sphere.rings) {
      sorted_.push_back(ring);
      std::sort(sorted_.back().begin(), sorted_.back().end());
    }
  }

  std::vector<std::vector<int>> run() {
    for (std::size_t v = 0; v < sorted_.size(); ++v) {
      path_ = {static_cast<int>(v)};
      used_[v] = 1;
      extend();
      used_[v] = 0;
    }
    return std::move(found_);
  }

 private:
  void extend() {
    const int first = path_.front();
    for (int w : sorted_[at(path_.back())]) {
      if (w == first && path_.size() >= 3 && path_[1] < path_.back()) found_.push_back(path_);
      if (w <= first || used_[at(w)] != 0 || static_cast<int>(path_.size()) >= longest_) continue;
      used_[at(w)] = 1;
      path_.push_back(w);
      extend();
      path_.pop_back();
      used_[at(w)] = 0;
    }
  }

  int longest_;
  std::vector<std::vector<int>> sorted_;
  std::vector<char> used_;
  std::vector<int> path_;
  std::vector<std::vector<int>> found_;
};

// Neighbours strictly between a and b, counter-clockwise from a.
std::vector<int> between(const std::vector<int>& ring, int a, int b) {
  const std::size_t n = ring.size();
  std::vector<int> out;
  auto k = static_cast<std::size_t>(std::find(ring.begin(), ring.end(), a) - ring.begin());
  require(k < n, "A cycle of a triangulation must run along its edges.");
  for (k = (k + 1) % n; ring[k] != b; k = (k + 1) % n) out.push_back(ring[k]);
  return out;
}

}  // namespace

std::vector<std::vector<int>> simple_cycles(const SphereTriangulation& sphere, int longest) {
  std::vector<std::vector<int>> cycles = CycleSearch(sphere, longest).run();
  std::sort(cycles.begin(), cycles.end());
  return cycles;
}

namespace {

// The part left of the cycle, closed by an apex.
SphereTriangulation left_half(const SphereTriangulation& sphere, const std::vector<int>& cycle,
                              std::vector<int>& origin) {
  const std::size_t n = cycle.size();
  std::vector<char> inside(sphere.rings.size(), 0);  // 1: left of the cycle, 2: on it
  std::vector<std::vector<int>> left(n);
  for (int c : cycle) inside[at(c)] = 2;
  std::vector<int> stack;
  for (std::size_t i = 0; i < n; ++i) {
    left[i] = between(sphere.rings[at(cycle[i])], cycle[(i + 1) % n], cycle[(i + n - 1) % n]);
    for (int w : left[i])
      if (inside[at(w)] == 0) {
        inside[at(w)] = 1;
        stack.push_back(w);
      }
  }
  while (!stack.empty()) {
    const int v = stack.back();
    stack.pop_back();
    for (int w : sphere.rings[at(v)])
      if (inside[at(w)] == 0) {
        inside[at(w)] = 1;
        stack.push_back(w);
      }
  }
  std::vector<int> number(sphere.rings.size(), -1);
  origin.clear();
  for (int v = 0; v < sphere.size(); ++v)
    if (inside[at(v)] != 0) {
      number[at(v)] = static_cast<int>(origin.size());
      origin.push_back(v);
    }
  const int apex = static_cast<int>(origin.size());
  SphereTriangulation half;
  half.rings.resize(origin.size() + 1);
  for (std::size_t k = 0; k < origin.size(); ++k)
    if (inside[at(origin[k])] == 1)
      for (int w : sphere.rings[at(origin[k])]) half.rings[k].push_back(number[at(w)]);
  for (std::size_t i = 0; i < n; ++i) {
    auto& ring = half.rings[at(number[at(cycle[i])])];
    ring.push_back(number[at(cycle[(i + 1) % n])]);
    for (int w : left[i]) ring.push_back(number[at(w)]);
    ring.push_back(number[at(cycle[(i + n - 1) % n])]);
    ring.push_back(apex);
  }
  for (std::size_t i = n; i-- > 0;) half.rings.back().push_back(number[at(cycle[i])]);
  origin.push_back(-1);
  return half;
}

}  // namespace

SphereSplit split(const SphereTriangulation& sphere, const std::vector<int>& cycle) {
  SphereSplit out;
  out.left = left_half(sphere, cycle, out.left_of);
  const std::vector<int> reversed(cycle.rbegin(), cycle.rend());
  out.right = left_half(sphere, reversed, out.right_of);
  return out;
}

}  // namespace hexfield
