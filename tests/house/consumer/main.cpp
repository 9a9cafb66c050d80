#include <cmath>

#include "hexfield/base/session.hpp"
#include "hexfield/mesh/tet_mesh.hpp"

// A program of somebody else: the volume of one tet, through the installed library.
int main(int argc, char** argv) {
  using hexfield::VertexId;
  hexfield::Session session(argc, argv);
  const auto mesh = hexfield::build_tet_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                             {{VertexId(0), VertexId(1), VertexId(2), VertexId(3)}});
  const bool right = std::abs(hexfield::signed_volume6(mesh, hexfield::TetId(0)) - 1) < 1e-12;
  return right && hexfield::check(mesh).empty() ? 0 : 1;
}
