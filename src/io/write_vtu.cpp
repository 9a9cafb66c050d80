#include <fmt/format.h>

#include <map>

#include "scanner.hpp"
#include "writers.hpp"

namespace hexfield::io {
namespace {

template <class T>
constexpr const char* vtu_type() {
  if constexpr (std::is_same_v<T, double>) return "Float64";
  if constexpr (std::is_same_v<T, std::int64_t>) return "Int64";
  if constexpr (std::is_same_v<T, std::int32_t>) return "Int32";
  return "UInt8";
}

std::string escaped(const std::string& text) {
  std::string result;
  for (char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c >= 0 && c < ' ' ? ' ' : c;
  }
  return result;
}

class VtuWriter {
 public:
  VtuWriter(BufferedWriter& out, bool binary) : out_(out), binary_(binary) {}

  /// `attributes`: anything more in the tag.
  template <class T>
  void array(const std::string& name, int components, const std::vector<T>& values,
             const std::string& attributes = "") {
    out_.print("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"{} format=\"{}\">\n", vtu_type<T>(),
               escaped(name), components, attributes, binary_ ? "binary" : "ascii");
    if (binary_) {
      const std::uint64_t bytes = values.size() * sizeof(T);
      base64(&bytes, sizeof(bytes));
      base64(values.data(), bytes);
      end_base64();
    } else {
      for (std::size_t i = 0; i < values.size(); ++i)
        out_.print("{}{}", +values[i], (i + 1) % static_cast<std::size_t>(components) == 0 ? '\n' : ' ');
    }
    out_.write("\n</DataArray>\n");
  }

 private:
  void base64(const void* data, std::size_t bytes) {
    for (std::size_t i = 0; i < bytes; ++i) {
      three_[filled_++] = static_cast<const unsigned char*>(data)[i];
      if (filled_ == 3) put();
    }
  }
  void end_base64() {
    if (filled_ > 0) put();
  }
  void put() {
    static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t k = filled_; k < 3; ++k) three_[k] = 0;
    const unsigned bits = three_[0] * 65536U + three_[1] * 256U + three_[2];
    char four[4] = {digits[bits >> 18], digits[(bits >> 12) & 63], digits[(bits >> 6) & 63], digits[bits & 63]};
    for (std::size_t k = filled_ + 1; k < 4; ++k) four[k] = '=';
    out_.write({four, 4});
    filled_ = 0;
  }

  BufferedWriter& out_;
  bool binary_;
  std::array<unsigned char, 3> three_{};
  std::size_t filled_ = 0;
};

// Names the way Gmsh-aware readers keep them: an array of that name with (colour, dimension).
void write_names(BufferedWriter& out, const CellSoup& soup) {
  if (soup.names.empty()) return;
  std::map<std::string, std::vector<std::int32_t>> groups;
  for (const auto& [key, name] : soup.names) {
    groups[name].push_back(key.second);
    groups[name].push_back(key.first);
  }
  out.write("<FieldData>\n");
  for (const auto& [name, values] : groups)
    VtuWriter(out, false).array(name, 2, values, fmt::format(" NumberOfTuples=\"{}\"", values.size() / 2));
  out.write("</FieldData>\n");
}

}  // namespace

void write_vtu(BufferedWriter& out, const CellSoup& soup, bool binary) {
  out.print(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"{}\" "
      "header_type=\"UInt64\">\n<UnstructuredGrid>\n",
      big_endian_machine ? "BigEndian" : "LittleEndian");
  write_names(out, soup);
  out.print("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", soup.points.size(), soup.num_cells());
  std::vector<double> coordinates;
  for (const Vec3& p : soup.points) coordinates.insert(coordinates.end(), p.data(), p.data() + 3);
  std::vector<std::int32_t> connectivity, colours;
  std::vector<std::int64_t> offsets;
  std::vector<std::uint8_t> types;
  for (std::size_t s = 0; s < num_shapes; ++s) {
    const CellBlock& b = soup.blocks[s];
    connectivity.insert(connectivity.end(), b.vertices.begin(), b.vertices.end());
    colours.insert(colours.end(), b.colours.begin(), b.colours.end());
    types.insert(types.end(), b.size(), static_cast<std::uint8_t>(shape_vtk[s]));
    for (std::size_t c = 0; c < b.size(); ++c)
      offsets.push_back((offsets.empty() ? 0 : offsets.back()) + shape_corners[s]);
  }
  VtuWriter writer(out, binary);
  out.write("<Points>\n");
  writer.array("Points", 3, coordinates);
  out.write("</Points>\n<Cells>\n");
  writer.array("connectivity", 1, connectivity);
  writer.array("offsets", 1, offsets);
  writer.array("types", 1, types);
  out.write("</Cells>\n<CellData Scalars=\"CellEntityIds\">\n");
  writer.array("CellEntityIds", 1, colours);
  out.write("</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
}

}  // namespace hexfield::io
