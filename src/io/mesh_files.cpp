#include <fmt/format.h>

#include "hexfield/io/hex_io.hpp"
#include "hexfield/io/tet_io.hpp"
#include "readers.hpp"
#include "writers.hpp"

namespace hexfield {
namespace io {

CellSoup read_soup(const std::filesystem::path& file) { return parse_soup(file, load_file(file)); }

CellSoup parse_soup(const std::filesystem::path& file, std::string_view data) {
  Scanner in(file.string(), data);
  if (data.starts_with("# vtk DataFile")) return read_legacy_vtk(std::move(in));
  const std::string first(Scanner(in).peek().substr(0, 40));
  if (first.starts_with("$")) return read_gmsh(std::move(in));
  if (first.starts_with("<?xml") || first.starts_with("<VTKFile")) return read_vtu(file.string(), data);
  const std::string extension = lower(file.extension().string());
  if (first.starts_with("MeshVersionFormatted") || (extension == ".mesh" && first.starts_with("#")))
    return read_medit(std::move(in));
  throw Error(ExitCode::bad_input,
              fmt::format("{}: begins with \"{}\", which is none of the formats known here (legacy VTK, VTU, Gmsh MSH "
                          "2.2 or 4.1, Medit .mesh in ASCII).",
                          file.string(), printable(first)));
}

void write_soup(const std::filesystem::path& file, const CellSoup& soup, const WriteOptions& options) {
  const MeshFormat format = choose_format(file, options);
  write_file(file, [&](BufferedWriter& out) {
    switch (format) {
      case MeshFormat::vtk:
        write_legacy_vtk(out, soup, options.binary);
        break;
      case MeshFormat::vtu:
        write_vtu(out, soup, options.binary);
        break;
      case MeshFormat::msh41:
        write_msh41(out, soup, options.binary);
        break;
      case MeshFormat::msh22:
        write_msh22(out, soup, options.binary);
        break;
      case MeshFormat::medit:
        write_medit(out, soup);
        break;
      case MeshFormat::abaqus:
        write_abaqus(out, soup);
        break;
    }
  });
}

}  // namespace io

TetInput read_tet_mesh(const std::filesystem::path& file) { return io::assemble_tets(io::read_soup(file)); }

std::vector<Violation> check_tet_file(const std::filesystem::path& file) { return io::check_tets(io::read_soup(file)); }

HexMesh read_hex_mesh(const std::filesystem::path& file) { return io::assemble_hexes(io::read_soup(file)); }

void write_tet_mesh(const std::filesystem::path& file, const TetMesh& mesh, const Features& features,
                    const WriteOptions& options) {
  io::write_soup(file, io::soup_of(mesh, features), options);
}

void write_hex_mesh(const std::filesystem::path& file, const HexMesh& mesh, const WriteOptions& options) {
  io::write_soup(file, io::soup_of(mesh), options);
}

}  // namespace hexfield
