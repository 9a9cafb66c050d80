#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "hexfield/base/parallel.hpp"
#include "hexfield/hex/hex_complex.hpp"
#include "hexfield/mesh/aabb_tree.hpp"
#include "hexfield/mesh/surface.hpp"

namespace hexfield {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

constexpr double touching = 1e-6;  // of the diagonal of a face

void check_stars(const HexMesh& mesh, const HexComplex& complex, std::vector<Violation>& out) {
  std::vector<Violation> found(mesh.points.size());
  parallel_for(mesh.points.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const int id = static_cast<int>(v);
      if (complex.is_boundary_vertex(id) || complex.vertex_corners[id].empty()) continue;
      try {
        vertex_sphere(mesh, complex, id);
      } catch (const Error& error) {
        found[v] = {error.sentence(), error.ids(), error.places()};
      }
    }
  });
  for (Violation& violation : found)
    if (!violation.sentence.empty()) out.push_back(std::move(violation));
}

// Boundary vertices that lie in a boundary face of which they are no corner.
void check_hanging(const HexMesh& mesh, const HexComplex& complex, std::vector<Violation>& out) {
  std::vector<int> faces;
  std::vector<AabbTree::Box> boxes;
  for (std::size_t q = 0; q < complex.quads.size(); ++q) {
    if (!complex.is_boundary_quad(static_cast<int>(q))) continue;
    faces.push_back(static_cast<int>(q));
    AabbTree::Box box;
    for (int v : complex.quads[q]) box.extend(mesh.points[at(v)]);
    const Vec3 margin = Vec3::Constant(touching * box.diagonal().norm());
    boxes.emplace_back(box.min() - margin, box.max() + margin);
  }
  const AabbTree tree(boxes);
  std::vector<int> face_of(mesh.points.size(), -1);
  parallel_for(mesh.points.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      if (!complex.is_boundary_vertex(static_cast<int>(v))) continue;
      const Vec3& p = mesh.points[v];
      tree.overlapping(AabbTree::Box(p, p), [&](std::int32_t k) {
        const auto& quad = complex.quads[at(faces[at(k)])];
        if (std::find(quad.begin(), quad.end(), static_cast<int>(v)) != quad.end()) return;
        const auto corner = [&](std::size_t i) -> const Vec3& { return mesh.points[at(quad[i])]; };
        const double limit = touching * boxes[at(k)].diagonal().norm();
        const double distance = std::min((closest_on_triangle(p, corner(0), corner(1), corner(2)) - p).norm(),
                                         (closest_on_triangle(p, corner(0), corner(2), corner(3)) - p).norm());
        if (distance <= limit) face_of[v] = faces[at(k)];
      });
    }
  });
  for (std::size_t v = 0; v < face_of.size(); ++v) {
    if (face_of[v] < 0) continue;
    const Vec3& p = mesh.points[v];
    out.push_back({fmt::format("Vertex {} at ({:.6g}, {:.6g}, {:.6g}) lies in a face of hex {} without being its "
                               "corner: a hanging face, or a doubled vertex.",
                               v, p.x(), p.y(), p.z(), complex.quad_hexes[at(face_of[v])][0]),
                   {static_cast<std::int64_t>(v)},
                   {p}});
  }
}

}  // namespace

std::vector<Violation> check_for_sheets(const HexMesh& mesh, const HexComplex& complex) {
  std::vector<Violation> out;
  check_stars(mesh, complex, out);
  check_hanging(mesh, complex, out);
  return out;
}

}  // namespace hexfield
