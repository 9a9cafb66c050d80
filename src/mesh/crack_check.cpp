#include <fmt/format.h>

#include <algorithm>

#include "hexfield/mesh/aabb_tree.hpp"
#include "hexfield/mesh/surface.hpp"
#include "input_report.hpp"

namespace hexfield {
namespace {

// Distance below which a vertex is on a face, in longest edges of the face, and in rounding errors of the coordinates.
constexpr double relative_tolerance = 1e-10;
constexpr double roundings = 8;

class CrackCheck {
 public:
  CrackCheck(const std::vector<Vec3>& points, const std::vector<FaceKey>& outside, InputReport& report)
      : points_(points), faces_(outside), report_(report), tolerance_(outside.size()) {
    std::vector<AabbTree::Box> boxes(faces_.size());
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      const auto [a, b, c] = corners(i);
      for (const Vec3& p : {a, b, c}) boxes[i].extend(p);
      const double longest = std::sqrt(std::max({(a - b).squaredNorm(), (b - c).squaredNorm(), (c - a).squaredNorm()}));
      const double magnitude = std::max({a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff(), c.cwiseAbs().maxCoeff()});
      tolerance_[i] = relative_tolerance * longest + roundings * std::numeric_limits<double>::epsilon() * magnitude;
      boxes[i].min().array() -= tolerance_[i];
      boxes[i].max().array() += tolerance_[i];
    }
    tree_ = AabbTree(boxes);
  }

  void run() {
    std::vector<VertexId> vertices;
    for (const FaceKey& f : faces_) vertices.insert(vertices.end(), f.begin(), f.end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    std::vector<Touch> touches(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) touches[i] = touch(vertices[i]);
    report_.start("coincident vertices");
    for (std::size_t i = 0; i < vertices.size(); ++i)
      if (touches[i].twin.valid() && touches[i].twin < vertices[i]) report_twins(touches[i].twin, vertices[i]);
    report_.start("hanging vertices");
    for (std::size_t i = 0; i < vertices.size(); ++i)
      if (touches[i].face >= 0 && !touches[i].twin.valid())
        report_hanging(vertices[i], faces_[static_cast<std::size_t>(touches[i].face)]);
  }

 private:
  struct Touch {
    VertexId twin;           // lowest vertex at the same place
    std::int32_t face = -1;  // lowest face that the vertex lies in
  };

  std::array<Vec3, 3> corners(std::size_t face) const {
    const FaceKey& f = faces_[face];
    return {points_[f[0].index()], points_[f[1].index()], points_[f[2].index()]};
  }

  Touch touch(VertexId v) const {
    Touch result;
    const Vec3& p = points_[v.index()];
    tree_.overlapping(AabbTree::Box(p), [&](std::int32_t i) {
      const auto face = static_cast<std::size_t>(i);
      const FaceKey& f = faces_[face];
      if (std::find(f.begin(), f.end(), v) != f.end()) return;
      const auto [a, b, c] = corners(face);
      if (!((closest_on_triangle(p, a, b, c) - p).norm() <= tolerance_[face])) return;
      for (VertexId w : f)
        if ((points_[w.index()] - p).norm() <= tolerance_[face] && (!result.twin.valid() || w < result.twin))
          result.twin = w;
      if (result.face < 0 || i < result.face) result.face = i;
    });
    return result;
  }

  void report_twins(VertexId a, VertexId b) {
    report_.add(fmt::format("Vertices {} and {} lie both at {}, so the mesh has a crack there.", report_.vertex_id(a),
                            report_.vertex_id(b), InputReport::text(points_[a.index()])),
                {report_.vertex_id(a), report_.vertex_id(b)}, {points_[a.index()]});
  }

  void report_hanging(VertexId v, const FaceKey& face) {
    const auto ids = report_.vertex_ids(face);
    report_.add(fmt::format("Vertex {} at {} hangs: it lies inside the face of vertices {}, {}, {} without being a "
                            "corner of it.",
                            report_.vertex_id(v), InputReport::text(points_[v.index()]), ids[0], ids[1], ids[2]),
                {report_.vertex_id(v), ids[0], ids[1], ids[2]}, {points_[v.index()]});
  }

  const std::vector<Vec3>& points_;
  const std::vector<FaceKey>& faces_;
  InputReport& report_;
  std::vector<double> tolerance_;
  AabbTree tree_;
};

}  // namespace

void check_cracks(const std::vector<Vec3>& points, const std::vector<FaceKey>& outside, InputReport& report) {
  CrackCheck(points, outside, report).run();
}

}  // namespace hexfield
