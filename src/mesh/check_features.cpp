#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "feature_incidence.hpp"

namespace hexfield {
namespace {

class FeatureCheck {
 public:
  FeatureCheck(const TetMesh& mesh, const Features& features) : mesh_(mesh), features_(features) {}

  std::vector<Violation> run() {
    check_tet_colours();
    check_entities();
    if (found_.empty()) check_closure();
    return std::move(found_);
  }

 private:
  bool exists(VertexId v) const {
    return v.valid() && v.index() < mesh_.num_vertices() && mesh_.vertex_tet[v.index()].valid();
  }

  void report(const std::string& what, std::span<const VertexId> vertices, const std::string& reason) {
    Violation violation;
    Vec3 sum = Vec3::Zero();
    bool placed = true;
    for (VertexId v : vertices) {
      violation.ids.push_back(v.value);
      placed = placed && v.valid() && v.index() < mesh_.num_vertices();
      if (placed) sum += mesh_.point(v);
    }
    violation.sentence = fmt::format("{} {}", what, fmt::join(violation.ids, ", "));
    if (placed) {
      const Vec3 place = sum / static_cast<double>(vertices.size());
      violation.sentence += fmt::format(" at ({:.6g}, {:.6g}, {:.6g})", place.x(), place.y(), place.z());
      violation.places.push_back(place);
    }
    violation.sentence += " " + reason + ".";
    found_.push_back(std::move(violation));
  }

  void check_tet_colours() {
    if (!features_.tet_colours.empty() && features_.tet_colours.size() != mesh_.num_tets())
      found_.push_back(
          {fmt::format("There are {} tet colours for {} tets.", features_.tet_colours.size(), mesh_.num_tets()),
           {},
           {}});
  }

  void check_entities() {
    const char* no_colour = "has no positive colour";
    for (const auto& [v, colour] : features_.points) {
      if (!exists(v)) report("Feature point", {&v, 1}, "is no vertex of a tet");
      if (colour <= 0) report("Feature point", {&v, 1}, no_colour);
    }
    for (const auto& [e, colour] : features_.edges) {
      if (!exists(e[0]) || !exists(e[1]) || !(e[0] < e[1]) || !find_tet_with_edge(mesh_, e[0], e[1]).valid())
        report("Feature edge", e, "is no edge of a tet");
      if (colour <= 0) report("Feature edge", e, no_colour);
    }
    for (const auto& [f, colour] : features_.faces) {
      if (!std::all_of(f.begin(), f.end(), [&](VertexId v) { return exists(v); }) || !find_half_face(mesh_, f).valid())
        report("Feature face", f, "is no face of a tet");
      if (colour <= 0) report("Feature face", f, no_colour);
    }
  }

  void check_closure() {
    for (const FaceKey& face : outer_and_interface_faces(mesh_, features_.tet_colours))
      if (!features_.faces.contains(face)) report("Face", face, "is a boundary or interface face but no feature");
    FeatureIncidence incidence;
    incidence.set_faces(features_.faces);
    incidence.set_edges(features_.edges);
    incidence.for_each_edge([&](const EdgeKey& edge, std::span<const std::size_t> faces) {
      if (needs_closure(incidence.faces, faces) && !features_.edges.contains(edge))
        report("Edge", edge, fmt::format("bounds {} feature faces or two colours but is no feature", faces.size()));
    });
    incidence.for_each_vertex([&](VertexId v, std::span<const std::size_t> edges) {
      if (needs_closure(incidence.edges, edges) && !features_.points.contains(v))
        report("Vertex", {&v, 1}, fmt::format("ends {} feature edges or two colours but is no feature", edges.size()));
    });
  }

  const TetMesh& mesh_;
  const Features& features_;
  std::vector<Violation> found_;
};

}  // namespace

std::vector<Violation> check(const TetMesh& mesh, const Features& features) {
  return FeatureCheck(mesh, features).run();
}

}  // namespace hexfield
