#pragma once

#include <map>
#include <set>

#include "binary_program.hpp"
#include "sheet_search.hpp"

namespace hexfield::hex {

/// All sheets of a mesh at once as an integer program: a variable per class of quads, and one per way in which a sheet
/// can pass a vertex that is not regular: a cycle of its sphere, on the boundary an arc from boundary to boundary, that
/// goes straight through its regular edges. Exactly the chosen classes are in the chosen ways, classes that cross
/// exclude each other, and the sum of node measures falls as far as it can. Sheets bend at singular edges only, as
/// those of SheetSearch. What is wrong with a solution at one vertex is forbidden there, whatever the sheet does
/// elsewhere.
class SheetProgram {
 public:
  SheetProgram(const HexMesh& mesh, const HexComplex& complex, const QuadClasses& classes,
               const std::vector<VertexSphere>& spheres, NodeMeasure& measure, int max_valence);

  struct Result {
    std::vector<SheetCandidate> sheets;  ///< disjoint, each lowers the measure; best first
    bool complete = false;               ///< without sheets: there is none
    std::string limit;                   ///< what ended the search early, empty when nothing did
  };
  /// The same for the same mesh. Throws Error(stopped) when the control asks for it.
  Result solve(const BinaryLimits& limits, const Control& control);

 private:
  /// A cycle by its classes, ascending, and what it does to the measure.
  struct Pass {
    std::vector<int> classes;
    int change;
    auto operator<=>(const Pass&) const = default;
  };
  using Row = BinaryProgram::Row;
  std::vector<Pass> passes_of(const VertexSphere& star);
  bool straight(const SphereTriangulation& sphere, const std::vector<int>& cycle) const;
  void add_conflicts();
  void gather_vertices();
  void gather_boundary(std::map<std::vector<Pass>, int>& groups);
  void fix_unpassed(int vertex, const std::vector<Pass>& passes);
  void add_passes(const std::vector<Pass>& passes, int vertices);
  void add_free_edges();
  std::vector<std::vector<int>> components(const std::vector<int>& chosen) const;
  SheetCandidate sheet_of(const std::vector<int>& part) const;
  /// Forbids a sheet that cannot be inflated, if possible by its classes at one vertex.
  void forbid(const std::vector<int>& part, const Error& error);

  const HexMesh& mesh_;
  const HexComplex& complex_;
  const QuadClasses& classes_;
  const std::vector<VertexSphere>& spheres_;
  NodeMeasure& measure_;
  int max_valence_;
  std::string limit_;  ///< a cap met when the program was made
  std::map<std::vector<std::vector<int>>, std::vector<std::pair<std::vector<int>, int>>> cycles_;  ///< by the rings
  BinaryProgram program_;  ///< the classes are its first variables
};

}  // namespace hexfield::hex
