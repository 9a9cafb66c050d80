#include "buffered_writer.hpp"
#include "hexfield/io/hexex_io.hpp"

namespace hexfield {

void write_hexex(const std::filesystem::path& file, const TetMesh& mesh, const CornerMap& map,
                 const Features& features) {
  require(map.uvw.size() == mesh.num_tets(), "The map has not one entry per tet.");
  io::write_file(file, [&](io::BufferedWriter& out) {
    out.print("{}\n", mesh.num_vertices());
    for (const Vec3& p : mesh.points) out.print("{} {} {}\n", p.x(), p.y(), p.z());
    out.print("{}\n", mesh.num_tets());
    for (std::size_t t = 0; t < mesh.num_tets(); ++t) {
      const auto& v = mesh.tets[t];
      out.print("{} {} {} {}", v[0].value, v[1].value, v[2].value, v[3].value);
      for (const Vec3& p : map.uvw[t]) out.print(" {} {} {}", p.x(), p.y(), p.z());
      out.write("\n");
    }
    out.print("{} {} {}\n", features.points.size(), features.edges.size(), features.faces.size());
    for (const auto& [v, colour] : features.points) out.print("{}\n", v.value);
    for (const auto& [e, colour] : features.edges) out.print("{} {}\n", e[0].value, e[1].value);
    for (const auto& [f, colour] : features.faces) out.print("{} {} {}\n", f[0].value, f[1].value, f[2].value);
  });
}

}  // namespace hexfield
