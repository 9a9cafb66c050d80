#include "fixed_map.hpp"

#include <fmt/core.h>

#include <atomic>

#include "hexfield/base/parallel.hpp"

namespace hexfield::hex {
namespace {

// x * 2^shift as an integer; false when it is not one.
bool to_fixed(double x, int shift, std::int64_t& value) {
  const double scaled = std::ldexp(x, shift);
  if (!(std::abs(scaled) <= 0x1p53) || scaled != std::floor(scaled)) return false;
  value = static_cast<std::int64_t>(scaled);
  return true;
}

bool fix_tet(const TetMesh& mesh, const IntegerGridMap& map, TetId t, FixedMap& fixed) {
  for (std::size_t i = 0; i < 4; ++i)
    for (int a = 0; a < 3; ++a)
      if (!to_fixed(map.uvw[t.index()][i][a], fixed.shift, fixed.corners[t.index()][i][static_cast<std::size_t>(a)]))
        return false;
  for (int i = 0; i < 4; ++i) {
    const HalfFaceId h(t, i);
    if (mesh.is_boundary(h)) continue;
    const HalfFaceId o = mesh.opposite_half_face(h);
    LatticeTransition& transition = fixed.transitions[t.index()][static_cast<std::size_t>(i)];
    transition.rotation = map.rotation(h);
    const Vec3 translation = transition_translation(mesh, map, h);
    for (VertexId v : mesh.face_vertices(h)) {
      const Vec3& here = map.uvw[t.index()][static_cast<std::size_t>(mesh.local_index(t, v))];
      const Vec3& there = map.uvw[o.tet().index()][static_cast<std::size_t>(mesh.local_index(o.tet(), v))];
      if (there - octahedral::apply(transition.rotation, here) != translation) return false;
    }
    for (int a = 0; a < 3; ++a) {
      if (translation[a] != std::round(translation[a])) return false;
      transition.translation[static_cast<std::size_t>(a)] = static_cast<std::int32_t>(translation[a]);
    }
  }
  return true;
}

}  // namespace

int fixed_shift(double largest) {
  if (!(largest < 0x1p29)) return -1;
  int exponent = 0;
  std::frexp(largest + 1, &exponent);
  return 52 - exponent;
}

FixedMap fixed_map(const TetMesh& mesh, const IntegerGridMap& map, std::vector<char>* tell) {
  const std::size_t n = mesh.num_tets();
  double largest = 0;
  for (const auto& corners : map.uvw)
    for (const Vec3& p : corners) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  FixedMap fixed;
  fixed.shift = fixed_shift(largest);
  if (fixed.shift < 0)
    throw Error(ExitCode::bad_hex_mesh, fmt::format("The integer-grid map has a coordinate of size {:.3g}.", largest));
  fixed.corners.resize(n);
  fixed.transitions.resize(n);
  std::vector<char> wrong(n, 0);
  parallel_for(n, 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) wrong[t] = !fix_tet(mesh, map, TetId(t), fixed);
  });
  if (tell != nullptr) {
    *tell = std::move(wrong);
    return fixed;
  }
  for (std::size_t t = 0; t < n; ++t)
    if (wrong[t] != 0)
      throw Error(ExitCode::bad_hex_mesh,
                  fmt::format("Tet {}: the integer-grid map is not exactly seamless with integer transitions.", t),
                  {static_cast<std::int64_t>(t)}, {centroid(mesh, TetId(t))});
  return fixed;
}

VertexTets vertex_tets(const TetMesh& mesh) {
  VertexTets star;
  star.first.assign(mesh.num_vertices() + 1, 0);
  for (const auto& tet : mesh.tets)
    for (VertexId v : tet) ++star.first[v.index() + 1];
  for (std::size_t v = 0; v < mesh.num_vertices(); ++v) star.first[v + 1] += star.first[v];
  star.tets.resize(4 * mesh.num_tets());
  std::vector<std::size_t> next(star.first.begin(), star.first.end() - 1);
  for (std::size_t t = 0; t < mesh.num_tets(); ++t)
    for (VertexId v : mesh.tets[t]) star.tets[next[v.index()]++] = TetId(t);
  return star;
}

}  // namespace hexfield::hex
