#pragma once

#include <filesystem>

#include "hexfield/hex/hex_singular_graph.hpp"

namespace hexfield::apps {

/// Lines on nodes and curves of a hex mesh for people.
/// Refuses a mesh that is no hex mesh or that sheets cannot be put into, with the first defect and its place:
/// Error(bad_input).
void require_good_hexes(const std::string& file, const HexMesh& mesh);

void print_graph(const HexSingularGraph& graph);

/// Picture of a singular graph: lines with `valence` and `curve`, nodes as vertices with valence 0 and curve -1.
void write_graph(const std::filesystem::path& file, const HexMesh& mesh, const HexSingularGraph& graph);

}  // namespace hexfield::apps
