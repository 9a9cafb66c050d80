#include "link_map.hpp"

namespace hexfield {

using octahedral::Rotation;

namespace {

constexpr std::size_t next(std::size_t k) { return (k + 1) % 3; }
constexpr std::size_t last(std::size_t k) { return (k + 2) % 3; }

// Children of triangle t: 4 t + k at corner k, with corners (corner k, midpoint of side k, midpoint of the side
// before), and 4 t + 3 in the middle, whose corner k is the midpoint of side k.
class Refinement {
 public:
  explicit Refinement(const Link& link) : link_(link) {
    const std::size_t n = link.triangles.size();
    middle_.assign(n, {-1, -1, -1});
    turn_.assign(n, {octahedral::identity, octahedral::identity, octahedral::identity});
    fine_.vertices = link.vertices;
    for (std::size_t t = 0; t < n; ++t)
      for (std::size_t k = 0; k < 3; ++k)
        if (middle_[t][k] < 0) add_midpoint(t, k);
    for (std::size_t t = 0; t < n; ++t) add_children(t);
    add_old_sectors();
    for (std::size_t t = 0; t < n; ++t)
      for (std::size_t k = 0; k < 3; ++k) add_new_sectors(t, k);
  }

  Link take() { return std::move(fine_); }

 private:
  static int id(std::size_t i) { return static_cast<int>(i); }
  static int corner(std::size_t triangle, std::size_t local) { return static_cast<int>(3 * triangle + local); }

  // The side of triangle s that is side k of t.
  std::size_t same_side(std::size_t s, std::size_t t, std::size_t k) const {
    const LinkTriangle& other = link_.triangles[s];
    std::size_t j = 0;
    while (j < 2 && !(other.across[j] == id(t) && other.vertex[next(j)] == link_.triangles[t].vertex[k])) ++j;
    return j;
  }

  void add_midpoint(std::size_t t, std::size_t k) {
    const LinkTriangle& triangle = link_.triangles[t];
    const LinkVertex& a = link_.vertices[static_cast<std::size_t>(triangle.vertex[k])];
    const LinkVertex& b = link_.vertices[static_cast<std::size_t>(triangle.vertex[next(k)])];
    LinkVertex m;
    m.direction = (a.direction + b.direction).normalized();
    m.start = octahedral::apply(triangle.to_tet[k], a.start) + octahedral::apply(triangle.to_tet[next(k)], b.start);
    if (triangle.normal[k] != octahedral::no_label) {
      m.free[static_cast<std::size_t>(octahedral::axis(triangle.normal[k]))] = false;
      m.start[octahedral::axis(triangle.normal[k])] = 0;
    }
    if (const double length = m.start.norm(); length > 1e-9) m.start /= length;
    middle_[t][k] = id(fine_.vertices.size());
    fine_.vertices.push_back(m);
    if (triangle.across[k] < 0) return;
    const auto s = static_cast<std::size_t>(triangle.across[k]);
    const std::size_t j = same_side(s, t, k);
    middle_[s][j] = middle_[t][k];
    turn_[s][j] = triangle.from_chart[k];
  }

  // Half of the side k of t becomes side `side` of the child.
  void set_side(LinkTriangle& child, std::size_t side, std::size_t t, std::size_t k, bool first_half) const {
    const LinkTriangle& p = link_.triangles[t];
    child.normal[side] = p.normal[k];
    child.from_chart[side] = p.from_chart[k];
    if (p.across[k] < 0) return;
    const auto s = static_cast<std::size_t>(p.across[k]);
    const std::size_t j = same_side(s, t, k);
    child.across[side] = id(4 * s + (first_half ? next(j) : j));
  }

  void add_children(std::size_t t) {
    const LinkTriangle& p = link_.triangles[t];
    LinkTriangle inner;
    inner.tet = p.tet;
    inner.frame = p.frame;
    inner.vertex = middle_[t];
    inner.to_tet = turn_[t];
    for (std::size_t k = 0; k < 3; ++k) {
      LinkTriangle child;
      child.tet = p.tet;
      child.frame = p.frame;
      child.vertex = {p.vertex[k], middle_[t][k], middle_[t][last(k)]};
      child.to_tet = {p.to_tet[k], turn_[t][k], turn_[t][last(k)]};
      set_side(child, 0, t, k, true);
      set_side(child, 2, t, last(k), false);
      child.across[1] = id(4 * t + 3);
      inner.across[last(k)] = id(4 * t + k);
      fine_.triangles.push_back(child);
    }
    fine_.triangles.push_back(inner);
  }

  void add_old_sectors() {
    for (const LinkSector& sector : link_.sectors) {
      LinkSector s{{}, sector.quads};
      for (int c : sector.corners) s.corners.push_back(3 * (4 * (c / 3) + c % 3));
      fine_.sectors.push_back(s);
    }
  }

  std::vector<int> corners_at_midpoint(std::size_t t, std::size_t k) const {
    return {corner(4 * t + k, 1), corner(4 * t + 3, k), corner(4 * t + next(k), 2)};
  }

  // At a midpoint each triangle is half a turn; a feature face keeps the halves apart.
  void add_new_sectors(std::size_t t, std::size_t k) {
    const LinkTriangle& p = link_.triangles[t];
    if (p.across[k] < 0 || p.normal[k] != octahedral::no_label) {
      fine_.sectors.push_back({corners_at_midpoint(t, k), 2});
      return;
    }
    const auto s = static_cast<std::size_t>(p.across[k]);
    const std::size_t j = same_side(s, t, k);
    if (s < t || (s == t && j < k)) return;
    LinkSector sector{corners_at_midpoint(t, k), 4};
    for (int c : corners_at_midpoint(s, j)) sector.corners.push_back(c);
    fine_.sectors.push_back(sector);
  }

  const Link& link_;
  Link fine_;
  std::vector<std::array<int, 3>> middle_;     // per triangle and side: link vertex
  std::vector<std::array<Rotation, 3>> turn_;  // takes its image to the chart of the triangle
};

}  // namespace

Link refined(const Link& link) { return Refinement(link).take(); }

}  // namespace hexfield
