#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "hexfield/hex/check.hpp"
#include "hexfield/mesh/surface.hpp"

namespace hexfield {
namespace {

// Length or area, and end vertices with one line, of one colour in both meshes.
struct Extent {
  double tets = 0;
  double hexes = 0;
  double distance = 0;
  std::map<int, int> tet_ends;
  std::map<int, int> hex_ends;
};

int ends(const std::map<int, int>& uses) {
  return static_cast<int>(std::count_if(uses.begin(), uses.end(), [](const auto& u) { return u.second == 1; }));
}

class Comparison {
 public:
  Comparison(const HexMesh& hexes, const TetMesh& mesh, const Features& features, double tolerance)
      : hexes_(hexes), mesh_(mesh), features_(features), tolerance_(tolerance) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : mesh.points) box.extend(p);
    diagonal_ = box.isEmpty() ? 0 : box.diagonal().norm();
  }

  HexAgainstTets run() {
    topologies();
    volumes();
    points();
    curves();
    surfaces();
    return std::move(out_);
  }

 private:
  const Vec3& at(int v) const { return hexes_.points[static_cast<std::size_t>(v)]; }
  void add(std::string sentence, std::vector<std::int64_t> ids = {}, std::vector<Vec3> places = {}) {
    out_.violations.push_back({std::move(sentence), std::move(ids), std::move(places)});
  }
  void topologies();
  void volumes();
  void points();
  void curves();
  void surfaces();
  void judge(const char* what, int colour, const Extent& extent, HexAgainstTets::Coverage& coverage);

  const HexMesh& hexes_;
  const TetMesh& mesh_;
  const Features& features_;
  double tolerance_;
  double diagonal_ = 0;
  HexAgainstTets out_;
};

void Comparison::topologies() {
  out_.hexes = topology(hexes_);
  out_.tets = topology(mesh_);
  const auto same = [&](const char* what, int hex, int tet) {
    if (hex != tet) add(fmt::format("The hex mesh has {} {}, the tet mesh {}.", what, hex, tet));
  };
  same("number of components", out_.hexes.components, out_.tets.components);
  same("number of boundary components", out_.hexes.boundary_components, out_.tets.boundary_components);
  same("Euler number of the volume", out_.hexes.euler_volume, out_.tets.euler_volume);
  same("Euler number of the boundary", out_.hexes.euler_boundary, out_.tets.euler_boundary);
}

void Comparison::volumes() {
  double tets = 0;
  for (std::size_t t = 0; t < mesh_.num_tets(); ++t)
    if (mesh_.alive(TetId(t))) tets += signed_volume6(mesh_, TetId(t)) / 6;
  out_.volume_ratio = volume(hexes_) / tets;
  if (!(std::abs(out_.volume_ratio - 1) <= 3 * tolerance_))
    add(fmt::format("The volume of the hex mesh is {:.4f} times that of the tet mesh.", out_.volume_ratio));
}

void Comparison::points() {
  out_.points.wanted = static_cast<int>(features_.points.size());
  std::multimap<int, int> by_colour;
  for (const auto& p : hexes_.feature_points) by_colour.emplace(p.colour, p.vertex);
  for (const auto& [v, colour] : features_.points) {
    const auto range = by_colour.equal_range(colour);
    const Vec3& place = mesh_.point(v);
    const bool found = std::any_of(range.first, range.second,
                                   [&](const auto& p) { return (at(p.second) - place).norm() <= 1e-6 * diagonal_; });
    if (found) continue;
    ++out_.points.wrong;
    add(fmt::format("Feature vertex {} of colour {} has no hex vertex.", v.value, colour), {v.value}, {place});
  }
}

void Comparison::judge(const char* what, int colour, const Extent& extent, HexAgainstTets::Coverage& coverage) {
  ++coverage.wanted;
  const double ratio = extent.hexes / extent.tets;
  std::string why;
  if (extent.hexes == 0)
    why = "is missing";
  else if (extent.distance > tolerance_ * diagonal_)
    why = fmt::format("is {:.4f} diagonals away from the input", extent.distance / diagonal_);
  else if (!(std::abs(ratio - 1) <= 5 * tolerance_))
    why = fmt::format("has {:.4f} times the size of the input's", ratio);
  else if (ends(extent.tet_ends) != ends(extent.hex_ends))
    why = fmt::format("has {} ends, the input's {}", ends(extent.hex_ends), ends(extent.tet_ends));
  if (why.empty()) return;
  ++coverage.wrong;
  add(fmt::format("The feature {} of colour {} {}.", what, colour, why), {colour});
}

void Comparison::curves() {
  std::map<int, Extent> extents;
  for (const auto& [edge, colour] : features_.edges) {
    Extent& e = extents[colour];
    e.tets += (mesh_.point(edge[0]) - mesh_.point(edge[1])).norm();
    for (VertexId v : edge) ++e.tet_ends[v.value];
  }
  const ClosestCurve closest(mesh_, features_);
  for (const auto& line : hexes_.feature_lines) {
    const auto found = extents.find(line.colour);
    if (found == extents.end()) {
      add(fmt::format("The hex mesh has a feature line of the unknown colour {}.", line.colour), {line.vertices[0]},
          {at(line.vertices[0])});
      continue;
    }
    Extent& e = found->second;
    const Vec3& a = at(line.vertices[0]);
    const Vec3& b = at(line.vertices[1]);
    e.hexes += (a - b).norm();
    for (int v : line.vertices) ++e.hex_ends[v];
    for (const Vec3& p : {a, b, Vec3((a + b) / 2)})
      e.distance = std::max(e.distance, closest.project(p, line.colour).distance);
  }
  for (const auto& [colour, extent] : extents) judge("curve", colour, extent, out_.curves);
}

void Comparison::surfaces() {
  std::map<int, Extent> extents;
  const auto area = [](const Vec3& a, const Vec3& b, const Vec3& c) { return (b - a).cross(c - a).norm() / 2; };
  for (const auto& [face, colour] : features_.faces)
    extents[colour].tets += area(mesh_.point(face[0]), mesh_.point(face[1]), mesh_.point(face[2]));
  const ClosestSurface closest(mesh_, features_);
  for (const auto& quad : hexes_.feature_quads) {
    const auto& v = quad.vertices;
    const auto found = extents.find(quad.colour);
    if (found == extents.end()) {
      add(fmt::format("The hex mesh has a feature quad of the unknown colour {}.", quad.colour), {v[0]}, {at(v[0])});
      continue;
    }
    Extent& e = found->second;
    e.hexes += area(at(v[0]), at(v[1]), at(v[2])) + area(at(v[0]), at(v[2]), at(v[3]));
    const Vec3 middle = (at(v[0]) + at(v[1]) + at(v[2]) + at(v[3])) / 4;
    for (const Vec3& p : {at(v[0]), at(v[1]), at(v[2]), at(v[3]), middle})
      e.distance = std::max(e.distance, closest.project(p, quad.colour).distance);
  }
  for (const auto& [colour, extent] : extents) judge("surface", colour, extent, out_.surfaces);
}

}  // namespace

HexAgainstTets check_against(const HexMesh& hexes, const TetMesh& mesh, const Features& features, double tolerance) {
  return Comparison(hexes, mesh, features, tolerance).run();
}

}  // namespace hexfield
