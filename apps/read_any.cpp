#include "read_any.hpp"

#include <optional>

#include "hexfield/base/error.hpp"
#include "hexfield/io/hex_io.hpp"

namespace hexfield::apps {

std::variant<TetInput, HexMesh> read_any_mesh(const std::filesystem::path& file) {
  std::optional<Error> no_tets;
  try {
    return read_tet_mesh(file);
  } catch (const Error& error) {
    no_tets = error;
  }
  try {
    HexMesh mesh = read_hex_mesh(file);
    if (!mesh.hexes.empty()) return mesh;
  } catch (const Error&) {
    // What is wrong with it as a tet mesh is the better answer: most files that come here are inputs.
  }
  throw *no_tets;
}

}  // namespace hexfield::apps
