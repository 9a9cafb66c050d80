#include <algorithm>
#include <cmath>
#include <limits>

#include "feature_incidence.hpp"
#include "union_find.hpp"

namespace hexfield {
namespace {

// Marks what has been added but not been coloured yet; colours of the input are positive.
constexpr int uncoloured = 0;
// Keeps rounding noise from deciding at angles of exactly the limit.
constexpr double angle_margin = 1e-9;

VertexId third_vertex(const FaceKey& face, const EdgeKey& edge) {
  for (VertexId v : face)
    if (v != edge[0] && v != edge[1]) return v;
  return VertexId();
}

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

// By how much two faces at an edge deviate from a plane, whichever way they are oriented.
double fold_angle(const TetMesh& mesh, const EdgeKey& edge, const FaceKey& f, const FaceKey& g) {
  const Vec3 origin = mesh.point(edge[0]);
  const Vec3 axis = (mesh.point(edge[1]) - origin).normalized();
  auto wing = [&](const FaceKey& face) {
    const Vec3 d = mesh.point(third_vertex(face, edge)) - origin;
    return Vec3(d - d.dot(axis) * axis);
  };
  return M_PI - angle_between(wing(f), wing(g));
}

// By how much a curve turns at a vertex.
double turn_angle(const TetMesh& mesh, VertexId v, const EdgeKey& e, const EdgeKey& f) {
  auto arm = [&](const EdgeKey& edge) { return Vec3(mesh.point(edge[0] == v ? edge[1] : edge[0]) - mesh.point(v)); };
  return M_PI - angle_between(arm(e), arm(f));
}

template <class Key>
int next_colour(const std::map<Key, int>& tagged) {
  int highest = 0;
  for (const auto& [key, colour] : tagged) highest = std::max(highest, colour);
  require(highest < std::numeric_limits<int>::max(), "No colour is left for new features.");
  return highest + 1;
}

// Gives each set of uncoloured items one new colour, in the order of their first members.
template <class Key>
void colour_sets(std::map<Key, int>& tagged, const std::vector<std::pair<Key, int>>& items, UnionFind& sets) {
  int colour = next_colour(tagged);
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].second != uncoloured) continue;
    const std::size_t first = sets.find(i);
    tagged[items[i].first] = first == i ? colour++ : tagged.at(items[first].first);
  }
}

void add_edges(const TetMesh& mesh, const FeatureIncidence& incidence, double limit, Features& features) {
  incidence.for_each_edge([&](const EdgeKey& edge, std::span<const std::size_t> faces) {
    if (needs_closure(incidence.faces, faces) ||
        fold_angle(mesh, edge, incidence.faces[faces[0]].first, incidence.faces[faces[1]].first) > limit)
      features.edges.emplace(edge, uncoloured);
  });
}

void colour_patches(const FeatureIncidence& incidence, Features& features) {
  UnionFind patches(incidence.faces.size());
  incidence.for_each_edge([&](const EdgeKey& edge, std::span<const std::size_t> faces) {
    if (!features.edges.contains(edge)) patches.unite(faces[0], faces[1]);
  });
  colour_sets(features.faces, incidence.faces, patches);
}

void add_points(const TetMesh& mesh, const FeatureIncidence& incidence, double limit, Features& features) {
  int colour = next_colour(features.points);
  incidence.for_each_vertex([&](VertexId v, std::span<const std::size_t> edges) {
    if (features.points.contains(v)) return;
    if (needs_closure(incidence.edges, edges) ||
        turn_angle(mesh, v, incidence.edges[edges[0]].first, incidence.edges[edges[1]].first) > limit)
      features.points[v] = colour++;
  });
}

void colour_curves(const FeatureIncidence& incidence, Features& features) {
  UnionFind curves(incidence.edges.size());
  incidence.for_each_vertex([&](VertexId v, std::span<const std::size_t> edges) {
    if (!features.points.contains(v)) curves.unite(edges[0], edges[1]);
  });
  colour_sets(features.edges, incidence.edges, curves);
}

}  // namespace

void complete_features(const TetMesh& mesh, Features& features, double degrees) {
  const double limit = degrees * M_PI / 180 + angle_margin;
  const double never = std::numeric_limits<double>::infinity();
  const double fold_limit = features.edges.empty() ? limit : never;
  const double turn_limit = features.points.empty() ? limit : never;
  for (const FaceKey& face : outer_and_interface_faces(mesh, features.tet_colours))
    features.faces.emplace(face, uncoloured);
  FeatureIncidence incidence;
  incidence.set_faces(features.faces);
  add_edges(mesh, incidence, fold_limit, features);
  colour_patches(incidence, features);
  incidence.set_edges(features.edges);
  add_points(mesh, incidence, turn_limit, features);
  colour_curves(incidence, features);
}

Features features_from_angles(const TetMesh& mesh, double degrees, std::vector<int> tet_colours) {
  Features features;
  features.tet_colours = std::move(tet_colours);
  complete_features(mesh, features, degrees);
  return features;
}

}  // namespace hexfield
