#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "readers.hpp"
#include "vtk_cells.hpp"
#include "vtu_bytes.hpp"
#include "xml_tags.hpp"

namespace hexfield::io {
namespace {

/// A data array before it is decoded.
struct Stored {
  std::string section;  ///< of the piece, or FieldData
  std::string name;
  std::string type;
  std::string format;
  std::int64_t components;
  std::uint64_t offset;
  std::string_view text;
};

// VTK XML unstructured grids (VTK file formats, "XML file formats"): ascii, base64 and appended arrays, with zlib or
// without.
class VtuReader {
 public:
  VtuReader(const std::string& file, std::string_view data) : file_(file), tags_(file, data) {}

  CellSoup read() {
    soup_.file = file_;
    read_tags();
    if (!points_) tags_.fail("there is no piece with points and cells");
    take_points();
    take_cells();
    for (const Stored& array : arrays_)
      if (array.section == "FieldData") take_names(array);
    add_vtk_cells(Scanner(file_, ""), cells_, soup_);
    return std::move(soup_);
  }

 private:
  void read_tags();
  void open(const XmlTags::Tag& tag);
  void read_head(const XmlTags::Tag& tag);
  void note_array(const XmlTags::Tag& tag);
  std::int64_t number(const XmlTags::Tag& tag, const std::string& key, std::int64_t otherwise);
  const Stored& find(const std::string& section, const std::string& name);
  VtkType type_of(const Stored& array);
  template <class Take>
  auto values(const Stored& array, std::int64_t wanted, const Take& take);
  std::vector<std::int64_t> integers(const Stored& array, std::int64_t wanted);
  void take_points();
  void take_cells();
  void take_names(const Stored& array);

  std::string file_;
  XmlTags tags_;
  VtuEncoding encoding_;
  std::string section_;
  std::vector<Stored> arrays_;
  std::optional<std::string_view> appended_;
  bool appended_base64_ = false;
  std::optional<std::int64_t> points_;
  std::int64_t num_cells_ = 0;
  CellSoup soup_;
  VtkCells cells_;
};

std::int64_t VtuReader::number(const XmlTags::Tag& tag, const std::string& key, std::int64_t otherwise) {
  const std::string text = tag.get(key);
  if (text.empty()) return otherwise;
  std::int64_t value = 0;
  const auto [at, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || at != text.data() + text.size() || value < 0)
    tags_.fail(fmt::format("{}=\"{}\" is no number", key, printable(text)));
  return value;
}

void VtuReader::read_head(const XmlTags::Tag& tag) {
  const std::string kind = tag.get("type");
  if (kind != "UnstructuredGrid")
    tags_.fail(
        fmt::format("the data set is \"{}\"; only UnstructuredGrid holds tets or hexes with tags", printable(kind)));
  encoding_.swap = (tag.get("byte_order", "LittleEndian") == "BigEndian") != big_endian_machine;
  encoding_.long_header = tag.get("header_type", "UInt32") == "UInt64";
  const std::string compressor = tag.get("compressor");
  if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
    tags_.fail(fmt::format("the arrays are compressed by {}; only vtkZLibDataCompressor is known here",
                           printable(compressor)));
  encoding_.zlib = !compressor.empty();
}

void VtuReader::note_array(const XmlTags::Tag& tag) {
  Stored array{section_,
               tag.get("Name"),
               tag.get("type"),
               tag.get("format", "ascii"),
               number(tag, "NumberOfComponents", 1),
               static_cast<std::uint64_t>(number(tag, "offset", 0)),
               tag.empty ? std::string_view() : tags_.text()};
  if (array.format != "ascii" && array.format != "binary" && array.format != "appended")
    tags_.fail(
        fmt::format("the array {} has the unknown format \"{}\"", printable(array.name), printable(array.format)));
  arrays_.push_back(std::move(array));
}

void VtuReader::open(const XmlTags::Tag& tag) {
  if (tag.name == "VTKFile") {
    read_head(tag);
  } else if (tag.name == "Piece") {
    if (points_) tags_.fail("there is more than one piece");
    points_ = number(tag, "NumberOfPoints", 0);
    num_cells_ = number(tag, "NumberOfCells", 0);
  } else if (tag.name == "DataArray" || tag.name == "Array") {
    note_array(tag);
  } else if (tag.name == "AppendedData") {
    appended_base64_ = tag.get("encoding", "base64") == "base64";
    std::string_view rest = tags_.rest();
    const std::size_t begin = rest.find('_');
    if (begin == std::string_view::npos) tags_.fail("the appended data do not begin with \"_\"");
    appended_ = rest.substr(begin + 1);
  } else {
    section_ = tag.name;
  }
}

void VtuReader::read_tags() {
  XmlTags::Tag tag;
  while (!appended_ && tags_.next(tag))
    if (!tag.closing) open(tag);
}

const Stored& VtuReader::find(const std::string& section, const std::string& name) {
  for (const Stored& array : arrays_)
    if (array.section == section && (name.empty() || array.name == name)) return array;
  tags_.fail(name.empty() ? fmt::format("there is no array in {}", section)
                          : fmt::format("there is no array \"{}\" in {}", name, section));
}

VtkType VtuReader::type_of(const Stored& array) {
  static constexpr std::pair<std::string_view, VtkType> names[] = {
      {"Int8", VtkType::i8},     {"UInt8", VtkType::u8},    {"Int16", VtkType::i16},  {"UInt16", VtkType::u16},
      {"Int32", VtkType::i32},   {"UInt32", VtkType::u32},  {"Int64", VtkType::i64},  {"UInt64", VtkType::u64},
      {"Float32", VtkType::f32}, {"Float64", VtkType::f64}, {"String", VtkType::text}};
  for (const auto& [name, type] : names)
    if (name == array.type) return type;
  tags_.fail(fmt::format("the array {} has the unknown type \"{}\"", printable(array.name), printable(array.type)));
}

// take(arrays, type, number of values).
template <class Take>
auto VtuReader::values(const Stored& array, std::int64_t wanted, const Take& take) {
  const VtkType type = type_of(array);
  const std::string what = fmt::format("{}, array \"{}\"", file_, printable(array.name));
  if (array.format == "ascii") {
    Scanner in(what, array.text);
    VtkArrays arrays(in, false);
    return take(arrays, type, wanted);
  }
  VtuEncoding encoding = encoding_;
  std::string_view data = array.text;
  if (array.format == "appended") {
    if (!appended_ || array.offset > appended_->size())
      tags_.fail(fmt::format("the offset {} of the array {} lies behind the end", array.offset, printable(array.name)));
    data = appended_->substr(array.offset);
    encoding.base64 = appended_base64_;
  }
  const std::string bytes = vtu_bytes(data, encoding, what);
  Scanner in(what, bytes);
  in.name_places_by_byte();
  VtkArrays arrays(in, true);
  in.swap_bytes(encoding.swap);
  return take(arrays, type, wanted);
}

std::vector<std::int64_t> VtuReader::integers(const Stored& array, std::int64_t wanted) {
  return values(array, wanted, [](VtkArrays& arrays, VtkType type, std::int64_t n) {
    return arrays.integers(n, type, "an array of integers");
  });
}

void VtuReader::take_points() {
  const Stored& array = find("Points", "");
  if (array.components != 3) tags_.fail(fmt::format("the points have {} coordinates, not 3", array.components));
  if (*points_ > INT64_MAX / 8) tags_.fail(fmt::format("{} points are impossible", *points_));
  const auto xyz = values(array, 3 * *points_, [](VtkArrays& arrays, VtkType type, std::int64_t n) {
    return arrays.reals(n, type, "coordinates of points");
  });
  for (std::size_t i = 0; i < xyz.size(); i += 3) soup_.points.emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);
}

void VtuReader::take_cells() {
  cells_.offsets = integers(find("Cells", "offsets"), num_cells_);
  cells_.offsets.insert(cells_.offsets.begin(), 0);
  for (std::size_t c = 0; c + 1 < cells_.offsets.size(); ++c)
    if (cells_.offsets[c + 1] < cells_.offsets[c])
      tags_.fail(fmt::format("offset {} of the cells is {}, less than the one before", c, cells_.offsets[c + 1]));
  cells_.connectivity = integers(find("Cells", "connectivity"), cells_.offsets.back());
  cells_.types = integers(find("Cells", "types"), num_cells_);
  const Stored* best = nullptr;
  std::size_t best_rank = SIZE_MAX;
  for (const Stored& array : arrays_) {
    if (array.section != "CellData" || array.components != 1) continue;
    const std::size_t rank = colour_rank(array.name, type_of(array));
    if (rank >= best_rank) continue;
    best_rank = rank;
    best = &array;
  }
  if (best != nullptr) cells_.colours = integers(*best, num_cells_);
}

// Names as write_vtu() writes them: an array of the name with pairs of a colour and a dimension.
void VtuReader::take_names(const Stored& array) {
  if (array.components != 2 || array.format != "ascii" || !is_integer(type_of(array))) return;
  Scanner in(fmt::format("{}, array \"{}\"", file_, printable(array.name)), array.text);
  while (!in.at_end()) {
    const std::int64_t colour = in.integer("a colour");
    const std::int64_t dimension = in.integer("a dimension");
    if (colour > 0 && colour <= INT32_MAX && dimension >= 0 && dimension <= 3)
      soup_.names[{static_cast<int>(dimension), static_cast<int>(colour)}] = array.name;
  }
}

}  // namespace

CellSoup read_vtu(const std::string& file, std::string_view data) { return VtuReader(file, data).read(); }

}  // namespace hexfield::io
