#pragma once

#include <optional>
#include <span>
#include <vector>

#include "hexfield/repair/repair_state.hpp"

namespace hexfield {

/// What a collapse or swap may change, kept for the case that its result is not wanted. Costs what the named parts
/// cost. Tets made after the backup must be the last ones when it is restored.
class StateBackup {
 public:
  /// `tets`: those that the edit changes; their face neighbours are kept too. `edges`, `faces`: keys whose values
  /// (features, codes, pairs, kept edges) the edit may change, make or remove.
  StateBackup(const RepairState& state, std::span<const TetId> tets, std::span<const EdgeKey> edges,
              std::span<const FaceKey> faces);
  void restore(RepairState& state) const;

 private:
  struct Tet {
    TetId id;
    std::array<VertexId, 4> vertices;
    std::array<HalfFaceId, 4> opposite;
    Quaternion frame;
    std::array<octahedral::Rotation, 4> matchings;
  };
  struct Edge {
    EdgeKey key;
    std::optional<int> feature, code, pair;
    bool kept;
  };
  std::size_t num_tets_;
  std::vector<Tet> tets_;
  std::vector<std::pair<VertexId, TetId>> vertex_tets_;
  std::vector<Edge> edges_;
  std::vector<std::pair<FaceKey, std::optional<int>>> faces_;
};

}  // namespace hexfield
