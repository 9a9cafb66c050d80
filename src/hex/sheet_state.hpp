#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "hexfield/hex/decompose.hpp"
#include "sheet_search.hpp"

namespace hexfield::hex {

/// A mesh on the way, with what the search for its sheets needs.
class SheetState {
 public:
  SheetState(HexMesh mesh, std::vector<DecomposeStep> steps, NodeMeasure& measure);

  const HexMesh& mesh() const { return mesh_; }
  const HexComplex& complex() const { return complex_; }
  const std::vector<DecomposeStep>& steps() const { return steps_; }
  int measure() const { return total_; }
  /// More vertices have a measure than are searched from one by one.
  bool has_many_nodes() const { return vertices_by_measure().size() > few_vertices; }
  /// Equal for isomorphic meshes.
  std::uint64_t hash() const;

  struct Found {
    std::vector<SheetCandidate> sheets;  ///< best first, each once
    bool complete = true;                ///< no limit was hit by the search for sheets without bends
    std::int64_t steps = 0;
    std::set<std::string> limits;  ///< that were hit, where the search is not complete
  };
  /// Sheets that change the sum of measures by at most `most`: from seeds at the first `targets` vertices that have
  /// any, or, where many vertices have a measure, those that lower it most together. Where there are none, sheets that
  /// bend at the vertex they start from. Throws Error(stopped) when the control asks for it.
  Found sheets(const DecomposeOptions& options, int most, int targets, std::size_t keep, NodeMeasure& measure,
               const Control& control) const;

 private:
  static constexpr std::size_t few_vertices = 12;
  struct Seed {
    int measure_after;
    std::vector<int> cycle;
  };
  void add_seeded_sheets(const DecomposeOptions& options, const QuadClasses& classes, int most, int targets,
                         std::size_t keep, NodeMeasure& measure, const Control& control, Found& found) const;
  void add_bent_sheets(const DecomposeOptions& options, int most, std::size_t keep, NodeMeasure& measure,
                       const Control& control, Found& found) const;
  /// Adds to `limits` when cycles were left out.
  std::vector<Seed> seeds_at(int v, int max_valence, int most, NodeMeasure& measure,
                             std::set<std::string>& limits) const;
  /// Vertices with positive measure, nodes first, the largest measure first.
  std::vector<int> vertices_by_measure() const;
  /// Keeps the best sheets that change the measure by at most `most` and can be inflated, each once.
  void keep_possible(std::vector<SheetCandidate>& sheets, int most, std::size_t keep) const;
  /// Regular edges at which a sheet with this cycle at v has to bend: from v straight on to the boundary or the
  /// next singular vertex. Ascending.
  std::vector<int> bends_of(int v, const std::vector<int>& cycle) const;
  std::vector<int> quads_of(int v, const std::vector<int>& cycle) const;

  HexMesh mesh_;
  std::vector<DecomposeStep> steps_;
  HexComplex complex_;
  std::vector<VertexSphere> spheres_;  ///< at interior singular vertices
  std::vector<int> measures_;
  int total_ = 0;
  int max_valence_ = 0;
};

}  // namespace hexfield::hex
