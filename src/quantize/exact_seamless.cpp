#include "hexfield/quantize/exact_seamless.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "hexfield/map/conforming_space.hpp"
#include "hexfield/map/orientation.hpp"
#include "hexfield/map/verify.hpp"

namespace hexfield {
namespace {

std::vector<Violation> not_positive(const TetMesh& mesh, const CornerMap& map, const char* when) {
  std::vector<Violation> found;
  for (std::size_t t = 0; t < mesh.num_tets(); ++t) {
    const auto& f = map.uvw[t];
    if (orientation(f[0], f[1], f[2], f[3]) > 0) continue;
    found.push_back({fmt::format("Tet {} is inverted or flat in the seamless map{}.", t, when),
                     {static_cast<std::int64_t>(t)},
                     {centroid(mesh, TetId(t))}});
  }
  return found;
}

double mean_edge(const CornerMap& map) {
  double sum = 0;
  for (const auto& f : map.uvw) sum += (f[1] - f[0]).norm();
  return sum / static_cast<double>(map.uvw.size());
}

// Largest change of an edge vector, seen in the combed chart.
double largest_move(const CornerMap& before, const CornerMap& after, const CutGraph& cut) {
  double worst = 0;
  for (std::size_t t = 0; t < before.uvw.size(); ++t)
    for (std::size_t k = 1; k < 4; ++k) {
      const Vec3 old = octahedral::apply(octahedral::inverse(cut.gauges[t]), before.uvw[t][k] - before.uvw[t][0]);
      worst = std::max(worst, (old - (after.uvw[t][k] - after.uvw[t][0])).cwiseAbs().maxCoeff());
    }
  return worst;
}

class Maker {
 public:
  Maker(const TetMesh& mesh, const Features& features, const SeamlessMap& map, double tolerance)
      : mesh_(mesh), features_(features), map_(map), tolerance_(tolerance) {}

  ExactSeamless run() {
    if (input_is_sound()) make();
    if (result_.failure != ExactFailure::none) result_.map = {};
    return std::move(result_);
  }

 private:
  bool fail(ExactFailure failure, std::vector<Violation> violations) {
    if (violations.empty()) return true;
    result_.failure = failure;
    result_.violations = std::move(violations);
    return false;
  }

  bool input_is_sound() {
    std::vector<Violation> found;
    for (std::size_t t = 0; t < mesh_.num_tets(); ++t)
      for (const Vec3& p : map_.uvw[t])
        if (!p.allFinite())
          found.push_back({fmt::format("Tet {} has a parameter that is no finite number.", t),
                           {static_cast<std::int64_t>(t)},
                           {centroid(mesh_, TetId(t))}});
    if (!fail(ExactFailure::not_finite, std::move(found))) return false;
    if (!fail(ExactFailure::inverted_input, not_positive(mesh_, map_, ""))) return false;
    result_.codes = codes_of_map(mesh_, map_);
    const MapReport report = verify_map(mesh_, features_, result_.codes, map_);
    for (const EdgeKey& e : report.wrong_edges)
      found.push_back({fmt::format("Edge ({}, {}): the angle around it in the map is no multiple of 90 degrees.",
                                   e[0].value, e[1].value),
                       {e[0].value, e[1].value},
                       {0.5 * (mesh_.point(e[0]) + mesh_.point(e[1]))}});
    if (!fail(ExactFailure::unclear_index, std::move(found))) return false;
    const double allowed = tolerance_ * mean_edge(map_);
    if (report.max_residual <= allowed) return true;
    return fail(ExactFailure::not_seamless, misses(allowed));
  }

  const Vec3& at(TetId t, VertexId v) const {
    return map_.uvw[t.index()][static_cast<std::size_t>(mesh_.local_index(t, v))];
  }

  // Transitions and alignments that miss by more than `allowed`, the worst first.
  std::vector<Violation> misses(double allowed) const {
    std::vector<std::pair<double, Violation>> found;
    const auto add = [&](double miss, std::string what, std::vector<std::int64_t> ids, std::vector<Vec3> places) {
      if (!(miss > allowed)) return;
      found.push_back({miss, {fmt::format("{} by {:.3g}.", what, miss), std::move(ids), std::move(places)}});
    };
    for (std::size_t i = 0; i < 4 * mesh_.num_tets(); ++i) {
      const HalfFaceId h{static_cast<std::int64_t>(i)};
      const HalfFaceId o = mesh_.opposite_half_face(h);
      if (mesh_.is_boundary(h) || o < h) continue;
      const Vec3 translation = transition_translation(mesh_, map_, h);
      double miss = 0;
      Vec3 place = Vec3::Zero();
      for (VertexId v : mesh_.face_vertices(h)) {
        place += mesh_.point(v) / 3;
        const Vec3 there = octahedral::apply(map_.rotation(h), at(h.tet(), v)) + translation;
        miss = std::max(miss, (there - at(o.tet(), v)).cwiseAbs().maxCoeff());
      }
      add(miss, fmt::format("Tets {} and {}: the transition between them misses", h.tet().value, o.tet().value),
          {h.tet().value, o.tet().value}, {place});
    }
    const Alignments alignments = alignments_of_map(mesh_, features_, result_.codes, map_);
    for (const FaceAlignment& a : alignments.faces) {
      const auto v = mesh_.face_vertices(a.face);
      const TetId t = a.face.tet();
      const auto x = [&](std::size_t k) { return at(t, v[k])[a.axis]; };
      add(std::max(std::abs(x(1) - x(0)), std::abs(x(2) - x(0))),
          fmt::format("Tet {}: its boundary or feature face misses a coordinate plane", t.value), {t.value},
          {(mesh_.point(v[0]) + mesh_.point(v[1]) + mesh_.point(v[2])) / 3});
    }
    for (const EdgeAlignment& a : alignments.edges) {
      Vec3 across = at(a.tet, a.edge[1]) - at(a.tet, a.edge[0]);
      across[a.axis] = 0;
      add(across.cwiseAbs().maxCoeff(),
          fmt::format("Edge ({}, {}): a feature or singular edge misses a coordinate line", a.edge[0].value,
                      a.edge[1].value),
          {a.edge[0].value, a.edge[1].value}, {mesh_.point(a.edge[0]), mesh_.point(a.edge[1])});
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<Violation> violations;
    for (auto& entry : found) violations.push_back(std::move(entry.second));
    return violations;
  }

  void make() {
    CutGraph cut = cut_graph(mesh_, matchings_of(map_), singular_edges(result_.codes));
    const ConformingSpace space =
        conforming_space(mesh_, std::move(cut), alignments_of_map(mesh_, features_, result_.codes, map_));
    std::vector<Violation> found;
    for (TetId t : space.collapsed)
      found.push_back({fmt::format("Tet {} is forced flat by alignments and transitions.", t.value),
                       {t.value},
                       {centroid(mesh_, t)}});
    if (!fail(ExactFailure::contradiction, std::move(found))) return;
    std::vector<double> y = unknowns_of(mesh_, space, map_);
    quantize_to_dyadic_grid(space, y);
    result_.map = to_corner_map(space, coordinates(space, y));
    result_.largest_move = largest_move(map_, result_.map, space.cut);
    fail(ExactFailure::inverted_output, not_positive(mesh_, result_.map, " once it is exact"));
  }

  const TetMesh& mesh_;
  const Features& features_;
  const SeamlessMap& map_;
  double tolerance_;
  ExactSeamless result_;
};

}  // namespace

const char* name(ExactFailure failure) {
  switch (failure) {
    case ExactFailure::none:
      return "nothing fails";
    case ExactFailure::not_finite:
      return "parameters that are no numbers";
    case ExactFailure::inverted_input:
      return "tets inverted in the map";
    case ExactFailure::unclear_index:
      return "edges of unclear index";
    case ExactFailure::not_seamless:
      return "a broken transition or alignment";
    case ExactFailure::contradiction:
      return "contradicting alignments";
    case ExactFailure::inverted_output:
      return "tets that exactness inverts";
  }
  return "";
}

ExactSeamless make_exactly_seamless(const TetMesh& mesh, const Features& features, const SeamlessMap& map,
                                    double tolerance) {
  return Maker(mesh, features, map, tolerance).run();
}

std::vector<Violation> check_exactly_seamless(const TetMesh& mesh, const Features& features, const EdgeCodes& codes,
                                              const SeamlessMap& map) {
  std::vector<Violation> found = not_positive(mesh, map, "");
  const auto at = [&](TetId t, VertexId v) -> const Vec3& {
    return map.uvw[t.index()][static_cast<std::size_t>(mesh.local_index(t, v))];
  };
  const auto report = [&](const char* what, TetId t) {
    found.push_back(
        {fmt::format("Tet {}: {} does not hold bit for bit.", t.value, what), {t.value}, {centroid(mesh, t)}});
  };
  for (std::size_t i = 0; i < 4 * mesh.num_tets(); ++i) {
    const HalfFaceId h{static_cast<std::int64_t>(i)};
    if (mesh.is_boundary(h)) continue;
    const Vec3 t = transition_translation(mesh, map, h);
    const TetId other = mesh.opposite_half_face(h).tet();
    bool exact = map.rotation(mesh.opposite_half_face(h)) == octahedral::inverse(map.rotation(h));
    // The rounded sum and difference both being right means that neither was rounded.
    for (VertexId v : mesh.face_vertices(h)) {
      const Vec3 turned = octahedral::apply(map.rotation(h), at(h.tet(), v));
      exact = exact && turned + t == at(other, v) && at(other, v) - t == turned && at(other, v) - turned == t;
    }
    if (!exact) report("a transition", h.tet());
  }
  const Alignments alignments = alignments_of_map(mesh, features, codes, map);
  for (const FaceAlignment& a : alignments.faces) {
    const auto v = mesh.face_vertices(a.face);
    const TetId t = a.face.tet();
    if (at(t, v[0])[a.axis] != at(t, v[1])[a.axis] || at(t, v[0])[a.axis] != at(t, v[2])[a.axis])
      report("the alignment of a face", t);
  }
  for (const EdgeAlignment& a : alignments.edges)
    for (int k = 0; k < 3; ++k)
      if (k != a.axis && at(a.tet, a.edge[0])[k] != at(a.tet, a.edge[1])[k]) report("the alignment of an edge", a.tet);
  return found;
}

}  // namespace hexfield
