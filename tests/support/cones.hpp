#pragma once

#include <Eigen/SVD>
#include <algorithm>
#include <random>

#include "hexfield/repair/repair_state.hpp"

/// Cones over triangulated spheres: a vertex whose link has one octant per triangle (spec-lmff section 12, fact 17).
namespace hexfield::testing {

using Triangle = std::array<int, 3>;

/// Triangles of the convex hull of points around the origin, outward; no four of them in a plane.
inline std::vector<Triangle> hull(const std::vector<Vec3>& p) {
  std::vector<Triangle> faces;
  const int n = static_cast<int>(p.size());
  auto at = [&](int i) { return p[static_cast<std::size_t>(i)]; };
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b)
      for (int c = a + 1; c < n; ++c) {
        if (c == b) continue;
        const Vec3 normal = (at(b) - at(a)).cross(at(c) - at(a));
        bool outside = normal.dot(at(a)) > 0;
        for (int d = 0; d < n && outside; ++d)
          if (d != a && d != b && d != c && normal.dot(at(d) - at(a)) > -1e-9) outside = false;
        if (outside) faces.push_back({a, b, c});
      }
  return faces;
}

/// Two poles with rings of n vertices each, twisted against each other: degrees n (2 times) and 5.
inline std::vector<Vec3> antiprism(int n, double height) {
  std::vector<Vec3> p = {{0, 0, 1}, {0, 0, -1}};
  for (int k = 0; k < 2 * n; ++k) {
    const double angle = M_PI * k / n, z = k % 2 == 0 ? height : -height;
    p.emplace_back(std::cos(angle), std::sin(angle), z);
  }
  return p;
}

/// Points whose hull has n3, n4 and n5 vertices of degree 3, 4 and 5.
inline std::vector<Vec3> sphere_points(const Triangle& degrees) {
  const std::vector<Vec3> tetrahedron = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  const std::vector<Vec3> octahedron = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<Vec3> bipyramid = {{0, 0, 1}, {0, 0, -1}};
  for (int k = 0; k < 3; ++k) bipyramid.emplace_back(std::cos(2 * M_PI * k / 3), std::sin(2 * M_PI * k / 3), 0);
  if (degrees == Triangle{4, 0, 0}) return tetrahedron;
  if (degrees == Triangle{2, 3, 0}) return bipyramid;
  if (degrees == Triangle{0, 6, 0}) return octahedron;
  if (degrees == Triangle{0, 0, 12}) return antiprism(5, 0.5);
  if (degrees == Triangle{0, 2, 8}) return antiprism(4, 0.4);
  if (degrees == Triangle{2, 0, 6}) return antiprism(3, 0.35);
  std::vector<Vec3> p;
  if (degrees == Triangle{2, 2, 2}) {
    p = bipyramid;
    p.push_back(0.4 * (p[0] + p[2] + p[3]));
  } else if (degrees == Triangle{1, 3, 3}) {
    p = octahedron;
    p.emplace_back(0.4, 0.4, 0.4);
  } else if (degrees == Triangle{0, 4, 4}) {  // snub disphenoid
    p = {{1.28917, 0.41112, 0}, {-1.28917, 0.41112, 0}, {0, -0.41112, 1.28917}, {0, -0.41112, -1.28917},
         {1, -1.56786, 0},      {-1, -1.56786, 0},      {0, 1.56786, 1},        {0, 1.56786, -1}};
  } else if (degrees == Triangle{0, 3, 6}) {  // prism with caps
    for (int k = 0; k < 3; ++k) {
      const double a = 2 * M_PI * k / 3, b = a + M_PI / 3;
      p.emplace_back(std::cos(a), std::sin(a), 0.6);
      p.emplace_back(std::cos(a), std::sin(a), -0.6);
      p.emplace_back(1.2 * std::cos(b), 1.2 * std::sin(b), 0);
    }
  } else if (degrees == Triangle{0, 5, 2}) {  // pentagonal bipyramid
    p = {{0, 0, 1}, {0, 0, -1}};
    for (int k = 0; k < 5; ++k) p.emplace_back(std::cos(2 * M_PI * k / 5), std::sin(2 * M_PI * k / 5), 0);
  }
  return p;
}

struct Cone {
  RepairState state;
  VertexId apex;
  std::vector<int> degrees;  ///< of the octant triangulation, per vertex of it; their ids are 1, 2, ...
};

/// The rotation with images of +a and +b prescribed.
inline octahedral::Rotation rotation_of(int a, octahedral::Label image_a, int b, octahedral::Label image_b) {
  for (octahedral::Rotation r = 0; r < octahedral::order; ++r)
    if (octahedral::image(r, static_cast<octahedral::Label>(2 * a)) == image_a &&
        octahedral::image(r, static_cast<octahedral::Label>(2 * b)) == image_b)
      return r;
  return octahedral::identity;
}

/// Every triangle of the hull is an octant, cut into 4^levels tets with one frame, whose axes +u, +v, +w leave
/// through its corners. Codes are set at the apex only.
inline Cone cone(const std::vector<Vec3>& points, int levels) {
  Cone result;
  std::vector<Vec3> p = {Vec3::Zero()};
  for (const Vec3& x : points) p.push_back(x.normalized());
  const std::vector<Triangle> octants = hull(points);
  std::vector<Triangle> faces;
  std::vector<std::size_t> octant_of;
  for (std::size_t o = 0; o < octants.size(); ++o) {
    faces.push_back({octants[o][0] + 1, octants[o][1] + 1, octants[o][2] + 1});
    octant_of.push_back(o);
  }
  for (int level = 0; level < levels; ++level) {
    std::map<std::array<int, 2>, int> middles;
    auto middle = [&](int a, int b) {
      const auto [place, added] =
          middles.emplace(std::array{std::min(a, b), std::max(a, b)}, static_cast<int>(p.size()));
      if (added) p.push_back((p[static_cast<std::size_t>(a)] + p[static_cast<std::size_t>(b)]).normalized());
      return place->second;
    };
    std::vector<Triangle> fine;
    std::vector<std::size_t> fine_octant;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const auto [a, b, c] = faces[f];
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const Triangle& t : {Triangle{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}}) {
        fine.push_back(t);
        fine_octant.push_back(octant_of[f]);
      }
    }
    faces = fine, octant_of = fine_octant;
  }
  std::vector<std::array<VertexId, 4>> tets;
  for (const auto& f : faces) tets.push_back({VertexId(0), VertexId(f[0]), VertexId(f[1]), VertexId(f[2])});
  RepairState& state = result.state;
  state.mesh = build_tet_mesh(std::move(p), std::move(tets));
  state.target_length.assign(state.mesh.num_vertices(), 1.0);
  state.field.matchings.assign(faces.size(), {});
  for (std::size_t t = 0; t < faces.size(); ++t) {
    Mat3 axes;
    for (int k = 0; k < 3; ++k)
      axes.col(k) = state.mesh.points[static_cast<std::size_t>(octants[octant_of[t]][static_cast<std::size_t>(k)] + 1)];
    const Eigen::JacobiSVD<Mat3> svd(axes, Eigen::ComputeFullU | Eigen::ComputeFullV);
    state.field.frames.emplace_back(Mat3(svd.matrixU() * svd.matrixV().transpose()));
    for (int i = 1; i < 4; ++i) {
      const HalfFaceId o = state.mesh.opposite_half_face(HalfFaceId(TetId(static_cast<std::int64_t>(t)), i));
      const Triangle& here = octants[octant_of[t]];
      const Triangle& there = octants[octant_of[o.tet().index()]];
      if (here == there) continue;
      int mine[2], theirs[2], n = 0;  // corners that both octants have
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
          if (here[static_cast<std::size_t>(a)] == there[static_cast<std::size_t>(b)] && n < 2)
            mine[n] = a, theirs[n++] = b;
      state.field.matchings[t][static_cast<std::size_t>(i)] =
          rotation_of(theirs[0], static_cast<octahedral::Label>(2 * mine[0]), theirs[1],
                      static_cast<octahedral::Label>(2 * mine[1]));
    }
  }
  result.apex = VertexId(0);
  result.degrees.assign(points.size(), 0);
  for (const auto& o : octants)
    for (int v : o) ++result.degrees[static_cast<std::size_t>(v)];
  for (std::size_t i = 0; i < points.size(); ++i)
    if (result.degrees[i] != 4)
      state.codes[edge_key(VertexId(0), VertexId(static_cast<std::int64_t>(i) + 1))] = result.degrees[i] - 4;
  return result;
}

/// Turns every frame by up to `radians` about a random axis; matchings stay.
inline void shake(RepairState& state, double radians, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (Quaternion& q : state.field.frames) {
    const Vec3 axis = Vec3(uniform(random), uniform(random), uniform(random)).normalized();
    q = (Quaternion(Eigen::AngleAxisd(radians * uniform(random), axis)) * q).normalized();
  }
}

/// Another chart in every tet: F g with matchings g^-1 M (spec-lmff section 0).
inline void change_gauges(RepairState& state, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> any(0, octahedral::order - 1);
  for (std::size_t t = 0; t < state.mesh.num_tets(); ++t) {
    const TetId tet(static_cast<std::int64_t>(t));
    if (!state.mesh.alive(tet)) continue;
    const auto g = static_cast<octahedral::Rotation>(any(random));
    state.field.frames[t] = (state.field.frames[t] * octahedral::quaternion(g)).normalized();
    for (int i = 0; i < 4; ++i) {
      const HalfFaceId h(tet, i), o = state.mesh.opposite_half_face(h);
      if (!o.valid()) continue;
      const auto m = octahedral::product(octahedral::inverse(g), state.field.matching(h));
      state.field.matchings[t][static_cast<std::size_t>(i)] = m;
      state.field.matchings[o.tet().index()][static_cast<std::size_t>(o.local())] = octahedral::inverse(m);
    }
  }
}

}  // namespace hexfield::testing
