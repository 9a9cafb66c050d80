#pragma once

#include <map>
#include <string>

#include "hexfield/hex/cut_table.hpp"

namespace hexfield::hex {

/// f of spec-sheets 4.1: how many splits a vertex needs to become curves of valence at most `final_valence` (5 or 6),
/// from the table of cuts; for types beyond it an upper bound by general cuts.
class NodeMeasure {
 public:
  explicit NodeMeasure(int final_valence) : final_valence_(final_valence) {}

  int operator()(const SphereTriangulation& sphere);

 private:
  int final_valence_;
  std::map<std::string, int> known_;
};

}  // namespace hexfield::hex
