#pragma once

#include <set>
#include <vector>

#include "hexfield/repair/strip.hpp"
#include "hexfield/repair/unzip_search.hpp"
#include "hexfield/repair/zipper_selection.hpp"

/// Repair of zipper nodes (paper sections 4.3, 4.5 step A4 and 5.2; spec-lmff section 5.6). Nothing here is collective.
namespace hexfield {

struct ZipperOptions {
  SelectionOptions selection;
  UnzipSearchOptions search;
  int sweeps = 20;  ///< of Algorithm 1 around a new strip
  int cap = 500;    ///< unzips per pass
};

/// Seeds of the search from a free zipper node: all tets around its two arcs, with the label against their flow.
std::vector<UnzipSeed> unzip_seeds(const RepairState& state, const FreeZipper& zipper);

/// Zipper nodes as goals of the search: the tets around their arcs, with the label along their flow.
UnzipPartners unzip_partners(const RepairState& state, std::span<const FreeZipper> zippers);

/// (S2) Unzipping: pulls the zipper node at path.seed.origin along the path. The arc of the start edge leaves the
/// node, which stays on the other arc (on the boundary, its end); both go on side by side to the boundary, or to the
/// two arcs of the partner. The edges of both new arcs get one new pair id. When it fails (false), the mesh is refined
/// and the field as it was. `strip`, if given, receives the surface between the arcs.
bool unzip(RepairState& state, const UnzipPath& path, const ZipperOptions& options, Strip* strip = nullptr);

/// Selects free zipper nodes, searches for all of them in parallel, and unzips them: first those with
/// a partner, the nearest pairs before the others, then those of the longest arcs; a search is done again when an
/// earlier unzip touched its path. Surfaces of this pass are not crossed. Where no path is found the node stays: the
/// next pass sees another field. Returns the number of zipper nodes unzipped (a partner counts).
int unzip_free_zipper_nodes(RepairState& state, const ZipperOptions& options = {});

/// (S1) Zipping near the boundary: both arcs of a free zipper node end on the boundary one edge away, at vertices
/// without other singular edges, with a fan of faces between them that meets the boundary in no feature edge: the
/// fan is zipped, and both arcs are gone. Returns the number of zipper nodes that went.
int zip_near_boundary(RepairState& state, const ZipperOptions& options = {});

}  // namespace hexfield
