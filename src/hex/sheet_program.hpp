#pragma once

#include <map>

#include "sheet_search.hpp"

namespace hexfield::hex {

/// All sheets of a mesh at once as an integer program: a variable per class of quads, and one per way in which a sheet
/// can pass a singular vertex, a cycle of its sphere that goes straight through its regular edges. Exactly the chosen
/// classes are in the chosen cycles, classes that cross exclude each other, and the sum of node measures falls as far
/// as it can. Sheets bend at singular edges only, as those of SheetSearch.
class SheetProgram {
 public:
  SheetProgram(const HexMesh& mesh, const HexComplex& complex, const QuadClasses& classes,
               const std::vector<VertexSphere>& spheres, NodeMeasure& measure, int max_valence);

  struct Result {
    std::vector<SheetCandidate> sheets;  ///< disjoint, each lowers the measure; best first
    bool complete = false;               ///< without sheets: there is none
  };
  /// The same for the same mesh: the search is limited by branches, not by time.
  Result solve(int most_branches);

 private:
  /// A cycle by its classes, ascending, and what it does to the measure.
  struct Pass {
    std::vector<int> classes;
    int change;
    auto operator<=>(const Pass&) const = default;
  };
  struct Row {
    std::vector<std::pair<int, double>> terms;
    double low, high;
  };
  struct Solution {
    std::vector<int> classes;
    bool optimal = false;
  };
  std::vector<Pass> passes_of(const VertexSphere& star);
  bool straight(const SphereTriangulation& sphere, const std::vector<int>& cycle) const;
  void gather_vertices();
  void add_passes(const std::vector<Pass>& passes, int vertices);
  void add_free_edges();
  Solution optimise(int most_branches) const;
  std::vector<std::vector<int>> components(const std::vector<int>& chosen) const;
  int add_column(double cost, double upper);

  const HexMesh& mesh_;
  const HexComplex& complex_;
  const QuadClasses& classes_;
  const std::vector<VertexSphere>& spheres_;
  NodeMeasure& measure_;
  int max_valence_;
  bool complete_ = true;
  std::map<std::vector<std::vector<int>>, std::vector<std::pair<std::vector<int>, int>>> cycles_;  ///< by the rings
  std::vector<double> cost_;
  std::vector<double> upper_;
  std::vector<Row> rows_;
};

}  // namespace hexfield::hex
