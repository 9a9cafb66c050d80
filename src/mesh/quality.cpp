#include "hexfield/mesh/quality.hpp"

#include <cmath>
#include <limits>

namespace hexfield {

// With the edges of a regular tet of length 1, |J|^2 is half the sum of the squared edges of the tet and det J is
// sqrt(2) times six volumes.
double tet_distortion(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 x = b - a, y = c - a, z = d - a;
  const double volume6 = x.cross(y).dot(z);
  if (!(volume6 > 0)) return std::numeric_limits<double>::infinity();
  const double trace =
      (3 * (x.squaredNorm() + y.squaredNorm() + z.squaredNorm()) - 2 * (x.dot(y) + y.dot(z) + z.dot(x))) / 2;
  return trace * trace * trace / (2 * volume6 * volume6);
}

double tet_distortion(const TetMesh& mesh, TetId t) {
  const auto& v = mesh.vertices(t);
  return tet_distortion(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3]));
}

double log_energy(double distortion) { return std::log(distortion) / 3; }

double total_volume(const TetMesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.num_tets(); ++i)
    if (const TetId t(static_cast<std::int64_t>(i)); mesh.alive(t)) sum += signed_volume6(mesh, t) / 6;
  return sum;
}

}  // namespace hexfield
