#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "hexfield/io/hexex_io.hpp"
#include "rational.hpp"
#include "readers.hpp"
#include "scanner.hpp"

namespace hexfield {
namespace {

using io::Scanner;

std::size_t tokens_in_line(Scanner in) {
  in.at_end();
  Scanner line("", in.line());
  std::size_t n = 0;
  for (; !line.at_end(); ++n) line.token("");
  return n;
}

VertexId vertex(Scanner& in, std::size_t points) {
  const std::int64_t v = in.integer("a vertex");
  if (v < 0 || v >= static_cast<std::int64_t>(points))
    in.fail(fmt::format("vertex {} does not exist; there are {}", v, points));
  return VertexId(v);
}

double finite(Scanner& in, double value, const char* what) {
  if (!std::isfinite(value)) in.fail(fmt::format("{} is {}, no finite number", what, value));
  return value;
}

std::vector<Vec3> read_points(Scanner& in) {
  std::vector<Vec3> points(in.count("the number of vertices", 6));
  for (Vec3& p : points)
    for (int k = 0; k < 3; ++k) p[k] = finite(in, in.real("a coordinate"), "a coordinate");
  return points;
}

void read_tets(Scanner& in, std::size_t points, std::vector<std::array<VertexId, 4>>& tets,
               std::vector<std::array<Vec3, 4>>& uvw) {
  const std::size_t n = in.count("the number of tets", 32);
  if (n > std::numeric_limits<std::int32_t>::max() / 4) in.fail(fmt::format("{} tets are too many", n));
  if (n == 0) in.fail("there are no tetrahedra in it");
  tets.resize(n);
  uvw.resize(n);
  for (std::size_t t = 0; t < n; ++t) {
    for (VertexId& v : tets[t]) v = vertex(in, points);
    for (std::size_t k = 0; k < 6; ++k)
      if (tets[t][static_cast<std::size_t>(tet_edge_vertices[k][0])] ==
          tets[t][static_cast<std::size_t>(tet_edge_vertices[k][1])])
        in.fail(fmt::format("tet {} has a vertex twice", t));
    for (Vec3& p : uvw[t])
      for (int k = 0; k < 3; ++k) p[k] = finite(in, io::read_rational(in, "a parameter"), "a parameter");
  }
}

std::vector<WallTriangle> read_walls(Scanner& in, std::size_t points) {
  std::vector<WallTriangle> walls(in.count("the number of walls", 8));
  for (WallTriangle& wall : walls) {
    for (VertexId& v : wall.vertices) v = vertex(in, points);
    wall.distance = finite(in, io::read_rational(in, "a distance"), "a distance");
  }
  return walls;
}

Features read_features(Scanner& in, const TetMesh& mesh) {
  Features features;
  const std::size_t points = in.count("the number of feature vertices", 2);
  const std::size_t edges = in.count("the number of feature edges", 4);
  const std::size_t faces = in.count("the number of feature triangles", 6);
  const auto id = [&] { return vertex(in, mesh.num_vertices()); };
  for (std::size_t i = 0; i < points; ++i) features.points.emplace(id(), 1);
  for (std::size_t i = 0; i < edges; ++i) {
    const VertexId a = id(), b = id();
    if (a == b || !find_tet_with_edge(mesh, a, b).valid())
      in.fail(fmt::format("feature edge {} ({}, {}) is no edge of a tet", i, a.value, b.value));
    features.edges.emplace(edge_key(a, b), 1);
  }
  for (std::size_t i = 0; i < faces; ++i) {
    const VertexId a = id(), b = id(), c = id();
    const FaceKey key = face_key(a, b, c);
    if (!find_half_face(mesh, key).valid())
      in.fail(fmt::format("feature triangle {} ({}, {}, {}) is no face of a tet", i, a.value, b.value, c.value));
    features.faces.emplace(key, 1);
  }
  return features;
}

// Tets listed with negative volume get two corners exchanged, in space and in the map alike.
void orient(const std::vector<Vec3>& points, std::vector<std::array<VertexId, 4>>& tets,
            std::vector<std::array<Vec3, 4>>& uvw, HexexInput& input) {
  for (std::size_t t = 0; t < tets.size(); ++t) {
    auto& v = tets[t];
    const Vec3& o = points[v[0].index()];
    const double volume = (points[v[1].index()] - o).cross(points[v[2].index()] - o).dot(points[v[3].index()] - o);
    const TetId id(static_cast<std::int64_t>(t));
    if (volume == 0) input.flat.push_back(id);
    if (volume >= 0) continue;
    input.turned.push_back(id);
    std::swap(v[2], v[3]);
    std::swap(uvw[t][2], uvw[t][3]);
  }
}

}  // namespace

HexexInput io::read_hexex(Scanner in) {
  HexexInput input;
  std::vector<Vec3> points = read_points(in);
  std::vector<std::array<VertexId, 4>> tets;
  read_tets(in, points.size(), tets, input.map.uvw);
  orient(points, tets, input.map.uvw, input);
  // One number alone in its line counts walls, three count features.
  if (!in.at_end() && tokens_in_line(in) == 1) input.walls = read_walls(in, points.size());
  try {
    input.mesh = build_tet_mesh(std::move(points), std::move(tets));
  } catch (const Error& error) {
    throw Error(error.code(), in.file() + ": " + error.sentence(), error.ids(), error.places());
  }
  if (!in.at_end()) input.features = read_features(in, input.mesh);
  if (!in.at_end()) in.fail("the file goes on behind its last list");
  input.map.rotations = derive_rotations(input.mesh, input.map.uvw);
  return input;
}

HexexInput read_hexex(const std::filesystem::path& file) {
  const std::string data = io::load_file(file);
  return io::read_hexex(Scanner(file.string(), data));
}

std::vector<std::array<octahedral::Rotation, 4>> derive_rotations(const TetMesh& mesh,
                                                                  const std::vector<std::array<Vec3, 4>>& uvw) {
  std::vector<std::array<octahedral::Rotation, 4>> rotations(mesh.num_tets(), {0, 0, 0, 0});
  const auto corner = [&](TetId t, VertexId v) {
    return uvw[t.index()][static_cast<std::size_t>(mesh.local_index(t, v))];
  };
  for (std::size_t i = 0; i < 4 * mesh.num_tets(); ++i) {
    const HalfFaceId h{static_cast<std::int64_t>(i)};
    const HalfFaceId o = mesh.opposite_half_face(h);
    if (!o.valid() || o < h) continue;
    const auto f = mesh.face_vertices(h);
    std::array<Vec3, 3> here, there;
    for (std::size_t k = 0; k < 3; ++k) {
      here[k] = corner(h.tet(), f[(k + 1) % 3]) - corner(h.tet(), f[k]);
      there[k] = corner(o.tet(), f[(k + 1) % 3]) - corner(o.tet(), f[k]);
    }
    octahedral::Rotation best = octahedral::identity;
    double least = std::numeric_limits<double>::infinity();
    for (octahedral::Rotation r = 0; r < octahedral::order; ++r) {
      double misfit = 0;
      for (std::size_t k = 0; k < 3; ++k) misfit += (octahedral::apply(r, here[k]) - there[k]).norm();
      if (misfit < least) {
        least = misfit;
        best = r;
      }
    }
    rotations[h.tet().index()][static_cast<std::size_t>(h.local())] = best;
    rotations[o.tet().index()][static_cast<std::size_t>(o.local())] = octahedral::inverse(best);
  }
  return rotations;
}

}  // namespace hexfield
