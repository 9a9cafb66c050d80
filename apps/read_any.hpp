#pragma once

#include <filesystem>
#include <variant>

#include "hexfield/hex/hex_mesh.hpp"
#include "hexfield/io/tet_io.hpp"

namespace hexfield::apps {

/// A mesh file of either kind. Throws Error(bad_input) when it is neither.
std::variant<TetInput, HexMesh> read_any_mesh(const std::filesystem::path& file);

}  // namespace hexfield::apps
