#include <fmt/format.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "hexfield/io/hex_io.hpp"
#include "hexfield/io/tet_io.hpp"
#include "io/samples.hpp"

using namespace hexfield;
using samples::expect_same;
using samples::scratch_file;
using samples::write_text;

namespace {

template <class T, class Value>
std::string bytes(const std::vector<Value>& values, bool big = false) {
  std::string out;
  for (const Value& value : values) {
    const T v = static_cast<T>(value);
    std::string b(reinterpret_cast<const char*>(&v), sizeof(T));
    if (big) std::reverse(b.begin(), b.end());
    out += b;
  }
  return out;
}

std::string base64(const std::string& data) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < data.size(); i += 3) {
    unsigned bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < data.size() ? static_cast<unsigned char>(data[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) out.push_back(i + k > data.size() ? '=' : digits[bits >> (18 - 6 * k) & 63]);
  }
  return out;
}

std::string compressed(const std::string& data) {
  std::string out(compressBound(static_cast<uLong>(data.size())), ' ');
  uLongf size = out.size();
  EXPECT_EQ(compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(data.data()),
                     static_cast<uLong>(data.size())),
            Z_OK);
  out.resize(size);
  return out;
}

struct Style {
  bool appended;
  bool raw;
  bool zlib;
  bool big;
};

// The sizes before the values, and the values, as VTK stores them: 32-bit sizes, blocks of 64 bytes.
std::string stored(const std::string& data, const Style& style) {
  if (!style.zlib) {
    const std::string all = bytes<std::uint32_t>(std::vector<std::size_t>{data.size()}, style.big) + data;
    return style.raw ? all : base64(all);
  }
  std::vector<std::size_t> sizes{(data.size() + 63) / 64, 64, data.size() % 64};
  std::string blocks;
  for (std::size_t i = 0; i < data.size(); i += 64) {
    const std::string block = compressed(data.substr(i, 64));
    sizes.push_back(block.size());
    blocks += block;
  }
  const std::string head = bytes<std::uint32_t>(sizes, style.big);
  return style.raw ? head + blocks : base64(head) + base64(blocks);
}

// The sample hexes the way VTK writes them, with floats and a point array that has nothing to do with it.
std::string file_of(const HexMesh& mesh, const Style& style) {
  std::string appended;
  const auto array = [&](const char* name, const char* type, int components, const std::string& data) {
    const std::string text = stored(data, style);
    const std::string head =
        fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"", type, name, components);
    if (!style.appended) return head + " format=\"binary\">\n  " + text + "\n</DataArray>\n";
    const std::size_t offset = appended.size();
    appended += text;
    return head + fmt::format(" format=\"appended\" offset=\"{}\"/>\n", offset);
  };
  std::vector<double> xyz;
  for (const Vec3& p : mesh.points) xyz.insert(xyz.end(), p.data(), p.data() + 3);
  std::vector<int> connectivity, offsets, types, colours;
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
    connectivity.insert(connectivity.end(), mesh.hexes[h].begin(), mesh.hexes[h].end());
    offsets.push_back(static_cast<int>(connectivity.size()));
    types.push_back(12);
    colours.push_back(mesh.hex_colours[h]);
  }
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n<!-- made up -->\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
      "byte_order=\"{}\"{}>\n<UnstructuredGrid><Piece NumberOfPoints='{}' NumberOfCells=\"{}\">\n<PointData>\n",
      style.big ? "BigEndian" : "LittleEndian", style.zlib ? " compressor=\"vtkZLibDataCompressor\"" : "",
      mesh.points.size(), mesh.hexes.size());
  text += array("x", "Float64", 1, bytes<double>(std::vector<double>(mesh.points.size(), 0.5), style.big));
  text += "</PointData><CellData>" + array("color", "Int64", 1, bytes<std::int64_t>(colours, style.big));
  text += "</CellData><Points>" + array("Points", "Float64", 3, bytes<double>(xyz, style.big)) + "</Points><Cells>";
  text += array("connectivity", "Int32", 1, bytes<std::int32_t>(connectivity, style.big));
  text += array("offsets", "Int64", 1, bytes<std::int64_t>(offsets, style.big));
  text += array("types", "UInt8", 1, bytes<std::uint8_t>(types, style.big));
  text += "</Cells></Piece></UnstructuredGrid>\n";
  if (style.appended)
    text += fmt::format("<AppendedData encoding=\"{}\">\n _", style.raw ? "raw" : "base64") + appended +
            "\n</AppendedData>\n";
  return text + "</VTKFile>\n";
}

HexMesh plain_hexes() {
  HexMesh mesh = samples::tagged_hexes();
  mesh.feature_points.clear();
  mesh.feature_lines.clear();
  mesh.feature_quads.clear();
  mesh.names.clear();
  return mesh;
}

std::string refusal(const std::string& text) {
  try {
    read_hex_mesh(write_text("bad.vtu", text));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    return error.sentence();
  }
  return "accepted";
}

}  // namespace

TEST(Vtu, EveryWayInWhichVtkStoresArrays) {
  const HexMesh mesh = plain_hexes();
  for (const bool zlib : {false, true})
    for (const bool big : {false, true})
      for (const Style& style :
           {Style{false, false, zlib, big}, Style{true, false, zlib, big}, Style{true, true, zlib, big}}) {
        SCOPED_TRACE(fmt::format("appended {}, raw {}, zlib {}, big {}", style.appended, style.raw, zlib, big));
        expect_same(read_hex_mesh(write_text("mesh.vtu", file_of(mesh, style))), mesh);
      }
}

TEST(Vtu, WhatIsDamagedIsRefused) {
  const std::string good = file_of(plain_hexes(), {false, false, false, false});
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  };
  const std::pair<std::string, const char*> cases[] = {
      {with("UnstructuredGrid\"", "PolyData\""), "PolyData"},
      {with("NumberOfPoints='12'", "NumberOfPoints='13'"), "more than"},
      {with("NumberOfPoints='12'", "NumberOfPoints='-1'"), "is no number"},
      {with("NumberOfPoints='12'", "NumberOfPoints='99999999999999'"), "more than"},
      {with("Name=\"offsets\"", "Name=\"offset\""), "no array \"offsets\""},
      {with("UInt8", "UInt9"), "unknown type"},
      {with("format=\"binary\"", "format=\"hex\""), "unknown format"},
      {with("<Piece", "<Piece NumberOfPoints=\"1\"/><Piece"), "more than one piece"},
      {with("version=\"0.1\"", "compressor=\"vtkLZMADataCompressor\""), "vtkLZMADataCompressor"},
      {with("</PointData><CellData>", "</PointData ?"), "an attribute"},
      {good.substr(0, good.find("<Cells>") + 7), "no array \"offsets\""},
      {good.substr(0, good.find("Name=\"types\"") + 58), "end is missing"},
      {"<VTKFile type=\"UnstructuredGrid\">", "no piece"},
  };
  for (const auto& [text, words] : cases) EXPECT_NE(refusal(text).find(words), std::string::npos) << refusal(text);
  const std::string packed = file_of(plain_hexes(), {true, true, true, false});
  for (std::size_t cut = packed.find('_') + 2; cut + 60 < packed.size(); cut += 7)
    EXPECT_NE(refusal(packed.substr(0, cut)), "accepted") << cut;
}
