#include "hexfield/mesh/input_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <set>

#include "face_table.hpp"
#include "input_report.hpp"

namespace hexfield {
namespace {

using Tet = std::array<VertexId, 4>;

constexpr double max_coordinate = 1e100;
constexpr double flat_factor = 1e-14;
constexpr std::size_t max_tets = std::numeric_limits<std::int32_t>::max() / 4;

bool in_range(const Tet& tet, std::size_t num_points) {
  return std::all_of(tet.begin(), tet.end(), [&](VertexId v) { return v.valid() && v.index() < num_points; });
}

struct Size {
  double volume6;
  double flat;  // 6 volumes up to which a tet of these edges counts as flat
};

Size size_of(const std::vector<Vec3>& points, const Tet& tet) {
  std::array<Vec3, 4> p;
  for (std::size_t i = 0; i < 4; ++i) p[i] = points[tet[i].index()];
  double longest = 0;
  for (const auto& [i, j] : tet_edge_vertices)
    longest = std::max(longest, (p[static_cast<std::size_t>(i)] - p[static_cast<std::size_t>(j)]).norm());
  return {(p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]), flat_factor * longest * longest * longest};
}

class InputCheck {
 public:
  InputCheck(const std::vector<Vec3>& points, const std::vector<Tet>& tets, const Features& features,
             const InputIds& ids)
      : points_(points), tets_(tets), features_(features), report_(points, ids) {}

  std::vector<Violation> run() {
    check_counts();
    check_coordinates();
    check_ids();
    if (!report_.empty()) return report_.take();
    check_volumes();
    check_doubled();
    check_faces();
    check_cracks(points_, outside_, report_);
    check_colours();
    check_feature_points();
    check_feature_edges();
    check_feature_faces();
    return report_.take();
  }

 private:
  void check_counts() {
    report_.start("");
    if (tets_.empty()) report_.add("There are no tets.", {}, {});
    if (tets_.size() > max_tets)
      report_.add(fmt::format("There are {} tets, more than the {} that one process can hold.", tets_.size(), max_tets),
                  {}, {});
  }

  void check_coordinates() {
    report_.start("vertices with such coordinates");
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Vec3& p = points_[i];
      if (p.allFinite() && p.cwiseAbs().maxCoeff() <= max_coordinate) continue;
      const std::int64_t id = report_.vertex_id(VertexId(static_cast<std::int64_t>(i)));
      report_.add(
          fmt::format("Vertex {} has a coordinate that is not a number or too large: {}.", id, InputReport::text(p)),
          {id}, {});
    }
  }

  void check_ids() {
    report_.start("tets with vertex ids out of range");
    for (std::size_t t = 0; t < tets_.size(); ++t)
      if (!in_range(tets_[t], points_.size()))
        report_.add(fmt::format("Tet {} names a vertex that does not exist; there are {} vertices.", report_.tet_id(t),
                                points_.size()),
                    {report_.tet_id(t)}, {});
    report_.start("tets with a repeated vertex");
    for (std::size_t t = 0; t < tets_.size(); ++t) {
      Tet v = tets_[t];
      std::sort(v.begin(), v.end());
      if (std::adjacent_find(v.begin(), v.end()) == v.end() || !in_range(v, points_.size())) continue;
      add_tet(t, fmt::format("has a vertex twice: {}", fmt::join(report_.vertex_ids(tets_[t]), ", ")));
    }
  }

  void check_volumes() {
    odd_.assign(tets_.size(), false);
    std::vector<Size> sizes(tets_.size());
    for (std::size_t t = 0; t < tets_.size(); ++t) {
      sizes[t] = size_of(points_, tets_[t]);
      odd_[t] = !(sizes[t].volume6 > sizes[t].flat);
    }
    report_.start("inverted tets");
    for (std::size_t t = 0; t < tets_.size(); ++t)
      if (sizes[t].volume6 < -sizes[t].flat)
        add_tet(t, fmt::format("is inverted: its volume is {:.6g}", sizes[t].volume6 / 6));
    report_.start("flat tets");
    for (std::size_t t = 0; t < tets_.size(); ++t)
      if (std::abs(sizes[t].volume6) <= sizes[t].flat)
        add_tet(t, fmt::format("is flat: its volume is {:.6g}", sizes[t].volume6 / 6));
  }

  void check_doubled() {
    std::vector<std::pair<Tet, std::size_t>> sorted;
    sorted.reserve(tets_.size());
    for (std::size_t t = 0; t < tets_.size(); ++t) {
      sorted.emplace_back(tets_[t], t);
      std::sort(sorted.back().first.begin(), sorted.back().first.end());
    }
    std::sort(sorted.begin(), sorted.end());
    report_.start("doubled tets");
    for (std::size_t i = 1; i < sorted.size(); ++i) {
      if (sorted[i].first != sorted[i - 1].first) continue;
      odd_[sorted[i].second] = odd_[sorted[i - 1].second] = true;
      add_tet(sorted[i].second, fmt::format("has the same vertices as tet {}", report_.tet_id(sorted[i - 1].second)));
    }
  }

  void check_faces() {
    std::vector<std::pair<FaceKey, std::vector<std::size_t>>> overlaps;
    const FaceTable table(points_.size(), tets_);
    report_.start("faces in more than two tets");
    table.for_each_face([&](const FaceKey& face, std::span<const FaceTable::Entry> sides) {
      if (sides.size() == 1) outside_.push_back(face);
      std::vector<std::size_t> tets;  // tets with a fault of their own would only repeat it here
      for (const auto& side : sides)
        if (const std::size_t t = side.half_face().tet().index(); !odd_[t]) tets.push_back(t);
      if (tets.size() > 2) add_face(face, tets, "belongs to more than two tets:");
      if (sides.size() == 2 && tets.size() == 2 && sides[0].even() == sides[1].even())
        overlaps.emplace_back(face, std::move(tets));
    });
    report_.start("overlapping tets");
    for (const auto& [face, tets] : overlaps) add_face(face, tets, "has the same side in the overlapping tets");
  }

  void check_colours() {
    report_.start("");
    if (!features_.tet_colours.empty() && features_.tet_colours.size() != tets_.size())
      report_.add(fmt::format("There are {} tet colours for {} tets.", features_.tet_colours.size(), tets_.size()), {},
                  {});
  }

  void check_feature_points() {
    std::vector<bool> used(points_.size(), false);
    for (const Tet& tet : tets_)
      for (VertexId v : tet) used[v.index()] = true;
    report_.start("feature points that are no vertices of tets");
    for (const auto& [v, colour] : features_.points)
      if (!v.valid() || v.index() >= points_.size() || !used[v.index()])
        add_feature("point of vertex", {&v, 1}, "is no vertex of a tet");
  }

  // Calls candidate(tet) for every tet with at least `n` vertices of `tagged` entities.
  template <class Map, class Candidate>
  void for_each_tet_at(const Map& tagged, int n, const Candidate& candidate) const {
    if (tagged.empty()) return;
    std::vector<bool> marked(points_.size(), false);
    for (const auto& [key, colour] : tagged)
      for (VertexId v : key)
        if (v.valid() && v.index() < points_.size()) marked[v.index()] = true;
    for (const Tet& tet : tets_)
      if (std::count_if(tet.begin(), tet.end(), [&](VertexId v) { return marked[v.index()]; }) >= n) candidate(tet);
  }

  void check_feature_edges() {
    std::set<EdgeKey> missing;
    for (const auto& [e, colour] : features_.edges) missing.insert(e);
    for_each_tet_at(features_.edges, 2, [&](const Tet& tet) {
      for (const auto& [i, j] : tet_edge_vertices)
        missing.erase(edge_key(tet[static_cast<std::size_t>(i)], tet[static_cast<std::size_t>(j)]));
    });
    report_.start("feature edges that are no edges of tets");
    for (const EdgeKey& e : missing) add_feature("edge of vertices", e, "is no edge of a tet");
  }

  void check_feature_faces() {
    std::set<FaceKey> missing;
    for (const auto& [f, colour] : features_.faces) missing.insert(f);
    for_each_tet_at(features_.faces, 3, [&](const Tet& tet) {
      for (const auto& [i, j, k] : tet_face_vertices)
        missing.erase(face_key(tet[static_cast<std::size_t>(i)], tet[static_cast<std::size_t>(j)],
                               tet[static_cast<std::size_t>(k)]));
    });
    report_.start("feature faces that are no faces of tets");
    for (const FaceKey& f : missing) add_feature("face of vertices", f, "is no face of a tet");
  }

  void add_tet(std::size_t t, const std::string& what) {
    const Vec3 place = report_.place(tets_[t]);
    report_.add(fmt::format("Tet {} at {} {}.", report_.tet_id(t), InputReport::text(place), what), {report_.tet_id(t)},
                {place});
  }

  void add_face(const FaceKey& face, const std::vector<std::size_t>& tets, const char* what) {
    std::vector<std::int64_t> ids;
    for (std::size_t t : tets) ids.push_back(report_.tet_id(t));
    const Vec3 place = report_.place(face);
    report_.add(fmt::format("The face of vertices {} at {} {} {}.", fmt::join(report_.vertex_ids(face), ", "),
                            InputReport::text(place), what, fmt::join(ids, ", ")),
                ids, {place});
  }

  void add_feature(const char* kind, std::span<const VertexId> vertices, const char* what) {
    const auto ids = report_.vertex_ids(vertices);
    const bool placed = std::all_of(vertices.begin(), vertices.end(),
                                    [&](VertexId v) { return v.valid() && v.index() < points_.size(); });
    std::vector<Vec3> places;
    if (placed) places.push_back(report_.place(vertices));
    report_.add(fmt::format("The feature {} {}{} {}.", kind, fmt::join(ids, ", "),
                            placed ? " at " + InputReport::text(places[0]) : "", what),
                ids, places);
  }

  const std::vector<Vec3>& points_;
  const std::vector<Tet>& tets_;
  const Features& features_;
  InputReport report_;
  std::vector<bool> odd_;         // tets that have been reported
  std::vector<FaceKey> outside_;  // faces of one tet
};

}  // namespace

bool orient_if_all_inverted(const std::vector<Vec3>& points, std::vector<Tet>& tets) {
  for (const Tet& tet : tets) {
    if (!in_range(tet, points.size())) return false;
    const Size size = size_of(points, tet);
    if (!(size.volume6 < -size.flat)) return false;
  }
  for (Tet& tet : tets) std::swap(tet[2], tet[3]);
  return !tets.empty();
}

std::vector<Violation> check_input(const std::vector<Vec3>& points, const std::vector<Tet>& tets,
                                   const Features& features, const InputIds& ids) {
  return InputCheck(points, tets, features, ids).run();
}

}  // namespace hexfield
