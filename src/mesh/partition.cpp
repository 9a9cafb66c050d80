#include "hexfield/mesh/partition.hpp"

#include <fmt/format.h>
#include <metis.h>

namespace hexfield {
namespace {

struct DualGraph {
  std::vector<idx_t> offsets{0};
  std::vector<idx_t> neighbours;
};

DualGraph dual_graph(const TetMesh& mesh) {
  DualGraph graph;
  graph.offsets.reserve(mesh.num_tets() + 1);
  graph.neighbours.reserve(4 * mesh.num_tets());
  for (const auto& opposite : mesh.opposite) {
    for (HalfFaceId h : opposite)
      if (h.valid()) graph.neighbours.push_back(h.tet().value);
    graph.offsets.push_back(static_cast<idx_t>(graph.neighbours.size()));
  }
  return graph;
}

// METIS cannot bisect graphs with next to nothing in them.
constexpr std::size_t min_tets_per_part = 8;

}  // namespace

std::vector<int> partition_tets(const TetMesh& mesh, int parts) {
  require(parts > 0, "A mesh cannot be cut into no parts.");
  const std::size_t n = mesh.num_tets();
  const auto count = static_cast<std::size_t>(parts);
  std::vector<int> part(n, 0);
  if (parts == 1 || n == 0) return part;
  if (n < min_tets_per_part * count) {
    for (std::size_t t = 0; t < n; ++t) part[t] = static_cast<int>(n < count ? t : t * count / n);
    return part;
  }
  DualGraph graph = dual_graph(mesh);
  std::vector<idx_t> result(n);
  idx_t vertices = static_cast<idx_t>(n), constraints = 1, part_count = parts, cut = 0;
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_NUMBERING] = 0;
  // Recursive bisection gives the better cuts for few parts (METIS manual, section 5.1).
  const auto partition = parts <= 8 ? METIS_PartGraphRecursive : METIS_PartGraphKway;
  const int status = partition(&vertices, &constraints, graph.offsets.data(), graph.neighbours.data(), nullptr, nullptr,
                               nullptr, &part_count, nullptr, nullptr, options, &cut, result.data());
  if (status != METIS_OK)
    throw Error(ExitCode::bug, fmt::format("METIS could not cut {} tets into {} parts (status {}).", n, parts, status));
  part.assign(result.begin(), result.end());
  return part;
}

}  // namespace hexfield
