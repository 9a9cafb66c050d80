#pragma once

#include <functional>
#include <vector>

#include "hexfield/base/control.hpp"
#include "node_measure.hpp"
#include "quad_classes.hpp"

namespace hexfield::hex {

/// What a sheet would do.
struct SheetCandidate {
  std::vector<int> quads;  ///< ascending
  int change = 0;          ///< of the sum of node measures
  bool operator<(const SheetCandidate& o) const {
    if (change != o.change) return change < o.change;
    return quads.size() != o.quads.size() ? quads.size() < o.quads.size() : quads < o.quads;
  }
};

struct SearchLimits {
  int max_valence = 6;         ///< of any edge that a sheet makes
  std::int64_t steps = 20000;  ///< classes tried for one seed
  std::size_t sheets = 400;    ///< kept for one seed
};

/// Exact search for all sheets through a seed (spec-sheets 6.2): backtracking over the singular edges at the rim of
/// the classes chosen so far.
class SheetSearch {
 public:
  SheetSearch(const HexMesh& mesh, const HexComplex& complex, const QuadClasses& classes,
              const std::vector<VertexSphere>& spheres, NodeMeasure& measure, const SearchLimits& limits,
              const Control& control);

  /// Appends the sheets that hold all quads of the seed. False when a limit was hit, so that there may be more. Throws
  /// Error(stopped) when the control asks for it.
  bool find(const std::vector<int>& seed, std::vector<SheetCandidate>& out);
  /// Change of the sum of node measures by a sheet; false when it makes a valence outside 3..max_valence.
  bool evaluate(const std::vector<int>& quads, int& change);
  /// Propagation of the paper (Algorithm 2): straight on where that is possible, else around the vertex on the rim
  /// by the fewest quads. Empty when the quads do not become a sheet.
  std::vector<int> propagate_greedily(const std::vector<int>& seed);

  /// Classes tried by all searches so far.
  std::int64_t steps_taken() const { return all_steps_; }

 private:
  bool add_class(int c);
  void remove_last();
  bool vertex_allows(int v) const;
  bool edge_allows(int e) const;
  void extend();
  int choose_edge() const;
  std::vector<int> options(int e) const;
  void keep();

  const HexMesh& mesh_;
  const HexComplex& complex_;
  const QuadClasses& classes_;
  const std::vector<VertexSphere>& spheres_;
  NodeMeasure& measure_;
  SearchLimits limits_;
  const Control& control_;
  std::vector<char> chosen_;  ///< per class
  std::vector<int> banned_;   ///< per class: number of chosen classes against it
  std::vector<char> count_;   ///< per edge: chosen quads at singular edges
  std::vector<int> order_;    ///< chosen classes
  std::vector<int> open_;     ///< singular edges that were touched, newest last
  std::int64_t steps_ = 0;
  std::int64_t all_steps_ = 0;
  std::vector<SheetCandidate>* found_ = nullptr;
  std::size_t first_found_ = 0;
  bool complete_ = true;
};

}  // namespace hexfield::hex
