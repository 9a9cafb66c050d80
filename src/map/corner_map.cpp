#include "hexfield/map/corner_map.hpp"

namespace hexfield {

Vec3 transition_translation(const TetMesh& mesh, const CornerMap& map, HalfFaceId h) {
  const HalfFaceId o = mesh.opposite_half_face(h);
  const VertexId v = mesh.face_vertices(h)[0];
  const Vec3& here = map.uvw[h.tet().index()][static_cast<std::size_t>(mesh.local_index(h.tet(), v))];
  const Vec3& there = map.uvw[o.tet().index()][static_cast<std::size_t>(mesh.local_index(o.tet(), v))];
  return there - octahedral::apply(map.rotation(h), here);
}

}  // namespace hexfield
