#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hexfield {

/// Formats that meshes can be written in.
enum class MeshFormat {
  vtk,    ///< legacy VTK 2.0, extension .vtk
  vtu,    ///< VTK XML, .vtu
  msh41,  ///< Gmsh 4.1, .msh
  msh22,  ///< Gmsh 2.2, .msh or .msh2
  medit,  ///< .mesh
  abaqus  ///< .inp
};

struct WriteOptions {
  std::optional<MeshFormat> format;  ///< default: by extension (.msh: 4.1)
  bool binary = false;               ///< binary variant of vtk, vtu (base64), msh22 and msh41; ignored by the others
};

/// Format of a file extension, with or without the dot, or of a name: vtk, vtu, msh, msh41, msh22, msh2, mesh, inp.
std::optional<MeshFormat> format_of_name(std::string_view name);
/// Extension with its dot.
std::string extension_of(MeshFormat format);
/// All names that format_of_name() takes, for messages.
std::vector<std::string> format_names();

/// options.format, else the format of the file's extension; Error(usage) naming the known ones when unknown.
MeshFormat choose_format(const std::filesystem::path& file, const WriteOptions& options);

}  // namespace hexfield
