// Writes the sample meshes in every format into the directory of the first argument, for readers of others.
#include <string>

#include "hexfield/io/hex_io.hpp"
#include "hexfield/io/tet_io.hpp"
#include "io/samples.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  using hexfield::MeshFormat;
  const std::filesystem::path folder = argv[1];
  const auto tets = hexfield::samples::tagged_box();
  const auto hexes = hexfield::samples::tagged_hexes();
  const std::pair<const char*, MeshFormat> formats[] = {{"vtk", MeshFormat::vtk},    {"vtu", MeshFormat::vtu},
                                                        {"msh", MeshFormat::msh41},  {"22.msh", MeshFormat::msh22},
                                                        {"mesh", MeshFormat::medit}, {"inp", MeshFormat::abaqus}};
  for (const auto& [ending, format] : formats)
    for (const bool binary : {false, true}) {
      const std::string name = std::string(binary ? "binary." : "ascii.") + ending;
      write_tet_mesh(folder / ("tets_" + name), tets.mesh, tets.features, {format, binary});
      write_hex_mesh(folder / ("hexes_" + name), hexes, {format, binary});
    }
  return 0;
}
