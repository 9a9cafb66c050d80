#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "assemble.hpp"
#include "hexfield/hex/check.hpp"
#include "hexfield/hex/extract.hpp"
#include "hexfield/hex/sanitise.hpp"

namespace hexfield {
namespace {

using hex::FixedMap;

// The mesh without some of its tets, its features and its map; vertices stay.
struct PartOfMap {
  TetMesh mesh;
  Features features;
  IntegerGridMap map;
  std::vector<char> open;  // per half-face: there was a tet behind it
};

PartOfMap without(const TetMesh& mesh, const Features& features, const IntegerGridMap& map,
                  const std::vector<char>& left_out) {
  PartOfMap part;
  std::vector<TetId> kept;
  std::vector<std::array<VertexId, 4>> tets;
  for (std::size_t t = 0; t < mesh.num_tets(); ++t) {
    if (left_out[t] != 0) continue;
    kept.emplace_back(t);
    tets.push_back(mesh.tets[t]);
    part.map.uvw.push_back(map.uvw[t]);
    part.map.rotations.push_back(map.rotations[t]);
  }
  part.mesh = build_tet_mesh(mesh.points, std::move(tets));
  part.features = features;
  part.features.tet_colours.clear();
  for (TetId t : kept) {
    if (!features.tet_colours.empty()) part.features.tet_colours.push_back(features.tet_colours[t.index()]);
    for (int i = 0; i < 4; ++i) {
      const HalfFaceId o = mesh.opposite_half_face(HalfFaceId(t, i));
      part.open.push_back(o.valid() && left_out[o.tet().index()] != 0);
    }
  }
  return part;
}

// Leaves out the points that no hex has.
void drop_unused_points(HexMesh& mesh) {
  std::vector<int> number(mesh.points.size(), -1);
  for (const auto& h : mesh.hexes)
    for (int v : h) number[static_cast<std::size_t>(v)] = 0;
  std::vector<Vec3> points;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] < 0) continue;
    number[v] = static_cast<int>(points.size());
    points.push_back(mesh.points[v]);
  }
  mesh.points = std::move(points);
  const auto renumber = [&](int& v) { v = number[static_cast<std::size_t>(v)]; };
  for (auto& h : mesh.hexes) std::for_each(h.begin(), h.end(), renumber);
  std::erase_if(mesh.feature_points, [&](const auto& p) { return number[static_cast<std::size_t>(p.vertex)] < 0; });
  for (auto& p : mesh.feature_points) renumber(p.vertex);
  for (auto& l : mesh.feature_lines) std::for_each(l.vertices.begin(), l.vertices.end(), renumber);
  for (auto& q : mesh.feature_quads) std::for_each(q.vertices.begin(), q.vertices.end(), renumber);
}

double volume(const FixedMap& map) {
  double sum = 0;
  for (const auto& c : map.corners) {
    const hex::WideSum six = hex::determinant(c[0], c[1], c[2], c[3]);
    sum += std::ldexp(static_cast<double>(six.high), 60 - 3 * map.shift) / 6;
  }
  return sum;
}

// The whole mesh, flat tets passed through; false when that is not as good as the mesh of a valid map.
bool extract_all(const TetMesh& mesh, const Features& features, const FixedMap& fixed, TolerantExtraction& out) {
  try {
    out.mesh = hex::assemble(mesh, features, fixed, nullptr);
    drop_unused_points(out.mesh);
  } catch (const Error& error) {
    out.defects.push_back({error.sentence(), error.ids(), error.places()});
    return false;
  }
  const MeshTopology hexes = topology(out.mesh);
  const MeshTopology tets = topology(mesh);
  if (hexes.euler_volume == tets.euler_volume && hexes.euler_boundary == tets.euler_boundary &&
      hexes.boundary_edges_not_in_two_faces == tets.boundary_edges_not_in_two_faces)
    return true;
  out.defects.push_back({"The hex mesh has another topology than the tet mesh.", {}, {}});
  return false;
}

}  // namespace

TolerantExtraction extract_tolerantly(const TetMesh& mesh, const Features& features, const IntegerGridMap& map) {
  TolerantExtraction out;
  HealedMap healed = heal_igm(mesh, features, map);
  out.defects = std::move(healed.defects);
  out.moved = healed.moved.size();
  std::vector<char> left_out;
  FixedMap fixed = hex::fixed_map(mesh, healed.map, &left_out);
  std::vector<char> flat(mesh.num_tets(), 0);
  for (std::size_t t = 0; t < mesh.num_tets(); ++t) {
    if (healed.tets[t] == HealedMap::Tet::unusable) left_out[t] = 1;
    flat[t] = healed.tets[t] == HealedMap::Tet::flat;
  }
  if (std::find(flat.begin(), flat.end(), 1) != flat.end()) fixed.flat = flat;
  if (std::find(left_out.begin(), left_out.end(), 1) == left_out.end() && extract_all(mesh, features, fixed, out)) {
    out.complete = true;
    return out;
  }
  for (std::size_t t = 0; t < mesh.num_tets(); ++t) left_out[t] = left_out[t] != 0 || flat[t] != 0;
  const PartOfMap part = without(mesh, features, healed.map, left_out);
  out.mesh = hex::assemble(part.mesh, part.features, hex::fixed_map(part.mesh, part.map), &part.open);
  drop_unused_points(out.mesh);
  out.missing = volume(fixed) - static_cast<double>(out.mesh.hexes.size());
  std::vector<std::int64_t> ids;
  std::vector<Vec3> places;
  for (std::size_t t = 0; t < mesh.num_tets(); ++t)
    if (left_out[t] != 0) ids.push_back(static_cast<std::int64_t>(t)), places.push_back(centroid(mesh, TetId(t)));
  out.defects.push_back({fmt::format("Hexes are missing around {} tets: {} were found, in a volume of {:.6g}.",
                                     ids.size(), out.mesh.hexes.size(), volume(fixed)),
                         std::move(ids), std::move(places)});
  return out;
}

}  // namespace hexfield
