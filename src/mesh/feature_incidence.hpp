#pragma once

#include <span>
#include <vector>

#include "hexfield/mesh/features.hpp"

namespace hexfield {

/// Which feature faces meet at an edge, and which feature edges at a vertex.
struct FeatureIncidence {
  struct AtEdge {
    EdgeKey edge;
    std::size_t face;  ///< place in `faces`
  };
  struct AtVertex {
    VertexId vertex;
    std::size_t edge;  ///< place in `edges`
  };

  std::vector<std::pair<FaceKey, int>> faces;  ///< with colours, ascending
  std::vector<std::pair<EdgeKey, int>> edges;

  /// Calls visit(edge, places in `faces`) for every edge of a feature face, ascending.
  template <class Visit>
  void for_each_edge(const Visit& visit) const {
    for_each_group(
        at_edge_, [](const AtEdge& a) { return a.edge; }, [](const AtEdge& a) { return a.face; }, visit);
  }
  /// Calls visit(vertex, places in `edges`) for every vertex of a feature edge, ascending.
  template <class Visit>
  void for_each_vertex(const Visit& visit) const {
    for_each_group(
        at_vertex_, [](const AtVertex& a) { return a.vertex; }, [](const AtVertex& a) { return a.edge; }, visit);
  }

  /// Reads faces (for_each_edge) again.
  void set_faces(const std::map<FaceKey, int>& from);
  /// Reads edges (for_each_vertex) again.
  void set_edges(const std::map<EdgeKey, int>& from);

 private:
  template <class T, class Key, class Value, class Visit>
  static void for_each_group(const std::vector<T>& sorted, const Key& key, const Value& value, const Visit& visit) {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < sorted.size();) {
      const auto group = key(sorted[i]);
      places.clear();
      for (; i < sorted.size() && key(sorted[i]) == group; ++i) places.push_back(value(sorted[i]));
      visit(group, std::span<const std::size_t>(places));
    }
  }

  std::vector<AtEdge> at_edge_;
  std::vector<AtVertex> at_vertex_;
};

/// The boundary faces and the faces between tets of different colours (empty: one colour), unsorted.
std::vector<FaceKey> outer_and_interface_faces(const TetMesh& mesh, const std::vector<int>& tet_colours);

/// Whether closure makes an edge with these feature faces, or a vertex with these feature edges, a feature:
/// their number is not 2, or their colours differ. `items` are pairs with a colour, `places` those that meet.
template <class Items>
bool needs_closure(const Items& items, std::span<const std::size_t> places) {
  return places.size() != 2 || items[places[0]].second != items[places[1]].second;
}

}  // namespace hexfield
