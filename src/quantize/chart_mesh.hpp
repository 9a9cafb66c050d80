#pragma once

#include <span>
#include <unordered_map>

#include "exact_points.hpp"
#include "hexfield/field/frame_field.hpp"
#include "hexfield/map/corner_map.hpp"
#include "hexfield/mesh/features.hpp"

namespace hexfield::quantize {

/// x -> rotation x + translation between charts, in grid units.
struct ChartStep {
  octahedral::Rotation rotation = octahedral::identity;
  std::array<double, 3> translation{};

  bool is_identity() const {
    return rotation == octahedral::identity && translation[0] == 0 && translation[1] == 0 && translation[2] == 0;
  }
  bool operator==(const ChartStep&) const = default;
};

/// The image of coordinate plane `axis` = q.
struct ChartPlane {
  int axis;
  double q;
};
ChartPlane apply(const ChartStep& step, const ChartPlane& plane);
std::array<double, 3> transport(const ChartStep& step, const std::array<double, 3>& x);
/// First b, then a.
ChartStep product(const ChartStep& a, const ChartStep& b);
ChartStep inverse(const ChartStep& step);

/// What an edge is; kept when it is split.
enum EdgeFlag : std::uint8_t { singular_edge = 1, feature_edge = 2 };

/// A tet mesh with an exactly seamless map whose edges can be cut at coordinate planes, and wall faces in it. A tet
/// that was cut stays, dead, and knows its two children. Charts: children have that of their tet.
class ChartMesh {
 public:
  static constexpr std::int32_t none = -1;
  struct Tet {
    std::array<std::int32_t, 4> vertices;
    std::array<std::int32_t, 4> points;    ///< in `points`, in the chart of this tet
    std::array<std::int32_t, 4> opposite;  ///< half-faces 4 t + i, none on the boundary
    std::array<std::int32_t, 4> original;  ///< half-face of the input that each face is part of, none inside
    std::array<std::int8_t, 4> wall_axis{-1, -1, -1, -1};  ///< axis of the wall in this chart, -1: no wall
    std::int32_t child = none;  ///< the child with the first end of `split`; the next one has the second
    std::int32_t split = none;
  };
  struct Split {
    std::int32_t first, second, middle;  // vertices
  };

  /// Boundary and feature faces are walls. `map` as make_exactly_seamless() gives it. Throws Error when its
  /// coordinates do not lie on one grid of 52 bits.
  ChartMesh(const TetMesh& mesh, const Features& features, const EdgeCodes& codes, const SeamlessMap& map);

  std::size_t num_tets() const { return tets_.size(); }
  bool alive(std::int32_t t) const { return tet(t).child == none; }
  const Tet& tet(std::int32_t t) const { return tets_[static_cast<std::size_t>(t)]; }
  const Split& split(std::int32_t s) const { return splits_[static_cast<std::size_t>(s)]; }
  int local(std::int32_t t, std::int32_t v) const;
  int find_local(std::int32_t t, std::int32_t v) const;
  std::int32_t point(std::int32_t t, int i) const { return tet(t).points[static_cast<std::size_t>(i)]; }
  std::int32_t opposite(std::int32_t h) const { return tet(h / 4).opposite[static_cast<std::size_t>(h % 4)]; }
  int wall_axis(std::int32_t h) const { return tet(h / 4).wall_axis[static_cast<std::size_t>(h % 4)]; }
  bool is_wall(std::int32_t h) const { return wall_axis(h) >= 0; }
  /// Out of the tet of half-face h.
  const ChartStep& step(std::int32_t h) const {
    const std::int32_t o = tet(h / 4).original[static_cast<std::size_t>(h % 4)];
    return o < 0 ? identity_ : steps_[static_cast<std::size_t>(o)];
  }
  bool crosses_original(std::int32_t h) const { return tet(h / 4).original[static_cast<std::size_t>(h % 4)] >= 0; }

  void set_wall(std::int32_t h, int axis, double distance);
  void clear_wall(std::int32_t h);
  double distance(std::int32_t h) const { return distances_[static_cast<std::size_t>(h)]; }

  /// Cuts the edge between vertices a and b of t, and all tets around it, where coordinate `axis` of t's chart is q.
  /// Returns the new vertex.
  std::int32_t cut_edge(std::int32_t t, std::int32_t a, std::int32_t b, int axis, double q);

  std::uint8_t edge_flags(std::int32_t a, std::int32_t b) const;
  int edge_code(std::int32_t a, std::int32_t b) const;
  bool is_feature_vertex(std::int32_t v) const {
    return static_cast<std::size_t>(v) < feature_vertex_.size() && feature_vertex_[static_cast<std::size_t>(v)] != 0;
  }
  std::int32_t num_input_vertices() const { return static_cast<std::int32_t>(feature_vertex_.size()); }
  bool is_feature_face(std::int32_t h) const {
    const std::int32_t o = tet(h / 4).original[static_cast<std::size_t>(h % 4)];
    return o >= 0 && feature_face_[static_cast<std::size_t>(o)] != 0;
  }

  ExactPoints points;
  std::vector<Vec3> places;  ///< of the vertices, in the input's space
  int grid_exponent = 0;     ///< parameter units are 2^grid_exponent grid steps

 private:
  struct EdgeInfo {
    std::uint8_t flags = 0;
    int code = 0;
  };
  static std::uint64_t key(std::int32_t a, std::int32_t b) {
    if (a > b) std::swap(a, b);
    return static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint64_t>(b);
  }
  struct RingTet {
    std::int32_t tet;
    ChartPlane plane;  // the cutting plane in its chart
  };
  void ring_of(std::int32_t t, std::int32_t a, std::int32_t b, const ChartPlane& plane);
  void read_corners(const TetMesh& mesh, const SeamlessMap& map);
  void read_walls(const TetMesh& mesh, const Features& features);
  void make_children(std::int32_t t, std::int32_t a, std::int32_t b, std::int32_t n, std::int32_t point);
  void link_children(std::int32_t t, std::int32_t a, std::int32_t b);

  std::vector<Tet> tets_;
  std::vector<double> distances_;  // per half-face
  std::vector<Split> splits_;
  std::vector<ChartStep> steps_;  // per original half-face
  std::vector<char> feature_face_;
  std::vector<char> feature_vertex_;
  std::unordered_map<std::uint64_t, EdgeInfo> edges_;  // looked up only
  std::vector<RingTet> ring_;
  ChartStep identity_;
};

}  // namespace hexfield::quantize
