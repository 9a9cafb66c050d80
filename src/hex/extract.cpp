#include "hexfield/hex/extract.hpp"

#include <fmt/core.h>

#include <cmath>

#include "assemble.hpp"
#include "carry_features.hpp"
#include "hexfield/base/parallel.hpp"
#include "hexfield/hex/sanitise.hpp"

namespace hexfield {
namespace {

[[noreturn]] void refuse(const std::vector<Violation>& violations) {
  constexpr std::size_t most = 100;
  std::vector<std::int64_t> ids;
  std::vector<Vec3> places;
  for (std::size_t k = 0; k < violations.size() && k < most; ++k) {
    ids.insert(ids.end(), violations[k].ids.begin(), violations[k].ids.end());
    places.insert(places.end(), violations[k].places.begin(), violations[k].places.end());
  }
  std::string sentence = "The integer-grid map is not valid. " + violations[0].sentence;
  if (!violations[0].places.empty()) {
    const Vec3& p = violations[0].places[0];
    sentence += fmt::format(" Place: ({:.6g}, {:.6g}, {:.6g}).", p.x(), p.y(), p.z());
  }
  if (violations.size() > 1) sentence += fmt::format(" ({} more defects.)", violations.size() - 1);
  throw Error(ExitCode::bad_hex_mesh, sentence, std::move(ids), std::move(places));
}

// The hexes fill the map: its exact volume is their number.
void check_volume(const hex::FixedMap& map, std::size_t hexes) {
  hex::WideSum volume6;
  for (const auto& c : map.corners) volume6 += hex::determinant(c[0], c[1], c[2], c[3]);
  hex::WideSum expected;
  expected.high = hex::Wide{6} * static_cast<std::int64_t>(hexes) * (hex::Wide{1} << (3 * map.shift - 60));
  if (volume6.high != expected.high || volume6.low != 0) {
    const double ratio = std::ldexp(static_cast<double>(volume6.high), 60 - 3 * map.shift) / 6;
    throw Error(ExitCode::bad_hex_mesh,
                fmt::format("The integer-grid map has volume {:.6f}, but {} hexes were found in it.", ratio, hexes));
  }
}

}  // namespace

HexMesh hex::assemble(const TetMesh& mesh, const Features& features, const FixedMap& fixed,
                      const std::vector<char>* open) {
  const VertexTets star = vertex_tets(mesh);
  LatticeVertices vertices = find_vertices(mesh, fixed, star);
  const Cells cells = find_cells(mesh, fixed, vertices, open);
  const std::size_t n = cells.root.size();
  if (open == nullptr) check_volume(fixed, n);
  HexMesh out;
  out.points = std::move(vertices.places);
  out.hexes.resize(n);
  if (!features.tet_colours.empty()) out.hex_colours.resize(n);
  parallel_for(n, 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      for (std::size_t k = 0; k < 8; ++k) out.hexes[c][k] = cells.corners[c][vtk_corner_bits[k]];
      if (!features.tet_colours.empty())
        out.hex_colours[c] = features.tet_colours[cells.tet(static_cast<std::size_t>(cells.root[c])).index()];
    }
  });
  out.names = features.names;
  carry_features(mesh, features, fixed, star, vertices, cells, out, open != nullptr);
  return out;
}

HexMesh extract_hex_mesh(const TetMesh& mesh, const Features& features, const IntegerGridMap& map) {
  const SanitisedMap exact = sanitise_igm(mesh, features, map);
  if (!exact.violations.empty()) refuse(exact.violations);
  return hex::assemble(mesh, features, hex::fixed_map(mesh, exact.map), nullptr);
}

}  // namespace hexfield
