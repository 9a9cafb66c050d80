#pragma once

#include <span>
#include <vector>

#include "hexfield/repair/repair_state.hpp"

namespace hexfield {

/// A small part of a RepairState as a value of its own: operations of the repair work on it and commit()
/// writes it back, or it is dropped, and nothing has happened. Neighbourhoods that share no tet can be worked
/// on at the same time; committing them in index order gives one result for any number of threads.
///
/// `local` has its own ids. Its tets are the editable region and a frozen shell: all other tets that share a
/// vertex with the region. Hence every edge with an editable tet has its full ring in `local`, and faces on the
/// boundary of `local` that are no feature faces are artificial: only frozen tets have them.
class Neighbourhood {
 public:
  /// Copies the alive tets `region` of `state` (any order) and their shell.
  Neighbourhood(const RepairState& state, std::span<const TetId> region);

  RepairState local;

  /// True for tets of the region and those made from them; frozen tets must keep vertices, frame and matchings
  /// (except the opposite of a changed matching).
  bool editable(TetId local_tet) const;
  /// True when all tets around the edge are editable.
  bool edge_inside(VertexId a, VertexId b) const;
  /// Local id of a vertex of the parent; invalid when it is not here.
  VertexId to_local(VertexId parent) const;
  /// Id in the parent; invalid for vertices made here and not yet committed.
  VertexId to_parent(VertexId local_vertex) const;
  /// Tets of the parent in region and shell: what must not be shared by operations at the same time.
  std::span<const TetId> footprint() const { return tet_parent_; }

  /// Local id of a copied tet of the parent; invalid when it is not here.
  TetId to_local(TetId parent) const;

  /// Replaces the region in `state`, which must still hold all tets of footprint(), by this one. Returns the ids that
  /// the local vertices have there.
  std::vector<VertexId> commit(RepairState& state) const;

 private:
  std::size_t num_copied_tets() const { return tet_parent_.size(); }

  std::vector<TetId> tet_parent_;        // per copied tet
  std::vector<char> frozen_;             // per copied tet
  std::vector<VertexId> vertex_parent_;  // per copied vertex, ascending
  Features features_before_;
  EdgeCodes codes_before_;
  std::map<EdgeKey, int> pairs_before_;
  std::set<EdgeKey> kept_before_;
};

/// All alive tets within `rings` vertex rings of the seeds (0: the tets at the seeds), ascending.
std::vector<TetId> tets_around(const TetMesh& mesh, std::span<const VertexId> seeds, int rings);

}  // namespace hexfield
