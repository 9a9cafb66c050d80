#pragma once

#include <span>
#include <utility>
#include <vector>

#include "hexfield/repair/repair_state.hpp"

namespace hexfield {

/// Frames and matchings of some tets, codes, pairs and kept flags of their edges, as they were: undoes an operation
/// that changed the field only there, at the cost of these tets. Worthless once one of the tets was split. A matching
/// must have changed on both sides, so that the face has both tets here.
class FieldSnapshot {
 public:
  FieldSnapshot(const RepairState& state, std::span<const TetId> tets);
  void restore(RepairState& state) const;

  std::span<const TetId> tets() const { return tets_; }      ///< ascending
  std::span<const EdgeKey> edges() const { return edges_; }  ///< all edges of the tets, ascending
  EdgeCode code(const EdgeKey& edge) const;                  ///< 0 for regular edges

 private:
  std::vector<TetId> tets_;
  std::vector<Quaternion> frames_;
  std::vector<std::array<octahedral::Rotation, 4>> matchings_;
  std::vector<EdgeKey> edges_;
  EdgeCodes codes_;
  std::map<EdgeKey, int> pairs_;
  std::set<EdgeKey> kept_;
};

}  // namespace hexfield
