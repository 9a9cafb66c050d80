#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "hexfield/base/error.hpp"
#include "hexfield/hex/sphere_triangulation.hpp"

namespace hexfield {
namespace {

constexpr int most_vertices = 120;  // labels are characters

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Breadth-first renumbering of a triangulation from one directed edge, in either sense of rotation.
class Numbering {
 public:
  explicit Numbering(const SphereTriangulation& sphere) : sphere_(sphere) {
    place_.resize(sphere.rings.size());
    for (std::size_t v = 0; v < sphere.rings.size(); ++v)
      for (std::size_t k = 0; k < sphere.rings[v].size(); ++k)
        place_[v].emplace_back(sphere.rings[v][k], static_cast<int>(k));
    for (auto& entries : place_) std::sort(entries.begin(), entries.end());
  }

  // Writes neighbour lists as labels into `text`; stops and returns false as soon as it is above `best`.
  bool write(int tail, int head, bool mirrored, const std::string& best, std::string& text) {
    text.clear();
    order.clear();
    label_.assign(sphere_.rings.size(), -1);
    from_.assign(sphere_.rings.size(), -1);
    visit(tail, head);
    bool below = best.empty();
    for (std::size_t k = 0; k < order.size(); ++k) {
      const int v = order[k];
      const auto& ring = sphere_.rings[at(v)];
      const int n = static_cast<int>(ring.size());
      const int start = index(v, from_[at(v)]);
      for (int step = 0; step < n; ++step) {
        const int w = ring[at(((mirrored ? start - step : start + step) + n) % n)];
        if (label_[at(w)] < 0) visit(w, v);
        if (!put(static_cast<char>('a' + label_[at(w)]), best, text, below)) return false;
      }
      if (!put(',', best, text, below)) return false;
    }
    return true;
  }

  std::vector<int> order;  ///< vertex per label

 private:
  void visit(int v, int from) {
    label_[at(v)] = static_cast<int>(order.size());
    from_[at(v)] = from;
    order.push_back(v);
  }
  static bool put(char c, const std::string& best, std::string& text, bool& below) {
    if (!below) {
      const auto other = static_cast<unsigned char>(best[text.size()]);
      if (static_cast<unsigned char>(c) > other) return false;
      below = static_cast<unsigned char>(c) < other;
    }
    text.push_back(c);
    return true;
  }
  int index(int v, int w) const {
    const auto& entries = place_[at(v)];
    return std::lower_bound(entries.begin(), entries.end(), std::pair<int, int>(w, 0))->second;
  }

  const SphereTriangulation& sphere_;
  std::vector<std::vector<std::pair<int, int>>> place_;
  std::vector<int> label_;
  std::vector<int> from_;
};

struct Start {
  int tail;
  int head;
};

// Directed edges of the rarest pair of degrees: an isomorphism maps them onto each other.
std::vector<Start> starts_of(const SphereTriangulation& sphere) {
  std::map<std::pair<int, int>, std::vector<Start>> by_degrees;
  for (int v = 0; v < sphere.size(); ++v)
    for (int w : sphere.rings[at(v)]) by_degrees[{sphere.degree(v), sphere.degree(w)}].push_back({v, w});
  const auto* best = &by_degrees.begin()->second;
  for (const auto& [degrees, starts] : by_degrees)
    if (starts.size() < best->size()) best = &starts;
  return *best;
}

// The smallest text and every numbering that gives it.
std::pair<std::string, std::vector<std::vector<int>>> smallest(const SphereTriangulation& sphere) {
  if (sphere.size() < 4 || sphere.size() > most_vertices)
    throw Error(ExitCode::bad_input,
                fmt::format("A vertex with {} edges is beyond the {} that codes hold.", sphere.size(), most_vertices));
  Numbering numbering(sphere);
  std::string best;
  std::string text;
  std::vector<std::vector<int>> orders;
  for (const Start& start : starts_of(sphere))
    for (const bool mirrored : {false, true}) {
      if (!numbering.write(start.tail, start.head, mirrored, best, text)) continue;
      if (text != best) orders.clear();
      best = text;
      orders.push_back(numbering.order);
    }
  return {best, orders};
}

std::vector<int> map_orders(const std::vector<int>& from, const std::vector<int>& to) {
  std::vector<int> image(from.size());
  for (std::size_t k = 0; k < from.size(); ++k) image[at(from[k])] = to[k];
  return image;
}

}  // namespace

std::string canonical_code(const SphereTriangulation& sphere) {
  std::string text = smallest(sphere).first;
  text.pop_back();
  return fmt::format("{} {}", sphere.size(), text);
}

std::vector<std::vector<int>> automorphisms(const SphereTriangulation& sphere) {
  const auto orders = smallest(sphere).second;
  std::vector<std::vector<int>> out;
  for (const auto& order : orders) out.push_back(map_orders(orders.front(), order));
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<int> isomorphism(const SphereTriangulation& from, const SphereTriangulation& to) {
  if (from.size() != to.size()) return {};
  const auto [code, orders] = smallest(from);
  const auto [other_code, other_orders] = smallest(to);
  return code == other_code ? map_orders(orders.front(), other_orders.front()) : std::vector<int>{};
}

SphereTriangulation sphere_from_code(const std::string& code) {
  const std::size_t space = code.find(' ');
  SphereTriangulation raw;
  raw.rings.emplace_back();
  for (std::size_t k = space == std::string::npos ? code.size() : space + 1; k < code.size(); ++k) {
    if (code[k] == ',')
      raw.rings.emplace_back();
    else
      raw.rings.back().push_back(static_cast<unsigned char>(code[k]) - 'a');
  }
  const int n = raw.size();
  for (const auto& ring : raw.rings)
    for (int w : ring)
      if (w < 0 || w >= n) throw Error(ExitCode::bad_input, fmt::format("'{}' is no code of a triangulation.", code));
  return sphere_from_triangles(n, raw.triangles());
}

}  // namespace hexfield
