#include "read_gmsh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <set>

#include "readers.hpp"

namespace hexfield::io {

NodeIndex::NodeIndex(std::vector<std::int64_t> tags) : tags_(std::move(tags)) {
  dense_ = !tags_.empty() && tags_.back() - tags_.front() == static_cast<std::int64_t>(tags_.size()) - 1;
}

std::int64_t NodeIndex::find(std::int64_t tag) const {
  if (tags_.empty() || tag < tags_.front() || tag > tags_.back()) return -1;
  if (dense_) return tag - tags_.front();
  const auto at = std::lower_bound(tags_.begin(), tags_.end(), tag);
  return *at == tag ? at - tags_.begin() : -1;
}

CellSoup GmshReader::read() {
  soup_.file = in_.file();
  soup_.cell_word = "element";
  while (!in_.at_end()) {
    const std::string section(in_.token("a section"));
    if (section == "$MeshFormat")
      read_format();
    else if (version_ == 0 && section != "$Comments")
      in_.fail(fmt::format("\"{}\" stands where $MeshFormat is expected", printable(section)));
    else if (section == "$PhysicalNames")
      read_names();
    else if (section == "$Entities" && version_ >= 4)
      read_entities();
    else if (section == "$Nodes")
      version_ >= 4 ? read_nodes4() : read_nodes2();
    else if (section == "$Elements")
      version_ >= 4 ? read_elements4() : read_elements2();
    else if (section == "$PartitionedEntities" || section == "$ParametricNodes")
      in_.fail(fmt::format("{} cannot be read here; save the mesh unpartitioned and without parameters", section));
    else if (!section.starts_with('$'))
      in_.fail(fmt::format("\"{}\" stands where a section is expected", printable(section)));
    else if (!in_.skip_to_line("$End" + section.substr(1)))
      in_.fail(fmt::format("the file ends inside the section {}", printable(section)));
  }
  if (!have_nodes_) in_.fail("there is no $Nodes section");
  if (!have_elements_) in_.fail("there is no $Elements section");
  sort_cells();
  choose_colours();
  return std::move(soup_);
}

void GmshReader::read_format() {
  version_ = in_.real("the version");
  const bool known = (version_ >= 2 && version_ < 3) || version_ == 4.1;
  if (!known) in_.fail(fmt::format("MSH version {} is not known here; save the mesh as 4.1 or 2.2", version_));
  const std::int64_t kind = in_.integer("the file type");
  if (kind != 0 && kind != 1) in_.fail(fmt::format("the file type is {}, neither 0 (ASCII) nor 1 (binary)", kind));
  const std::int64_t bytes = in_.integer("the data size");
  if (bytes != 8) in_.fail(fmt::format("the data size is {}, not 8", bytes));
  in_.line();
  binary_ = kind == 1;
  if (binary_) {
    in_.name_places_by_byte();
    const auto one = in_.binary<std::int32_t>("the byte order");
    if (one != 1 && one != 0x01000000) in_.fail("the number that tells the byte order is not 1");
    in_.swap_bytes(one != 1);
  }
  end_section("$EndMeshFormat");
}

void GmshReader::read_names() {
  const std::size_t n = in_.count("the number of physical names", 6);
  for (std::size_t i = 0; i < n; ++i) {
    const std::int64_t dimension = in_.integer("the dimension of a physical group");
    if (dimension < 0 || dimension > 3) in_.fail(fmt::format("a physical group has the dimension {}", dimension));
    const std::int64_t tag = std::abs(std::max(in_.integer("the tag of a physical group"), -INT64_MAX));
    const std::string_view rest = in_.line();
    const std::size_t begin = rest.find('"');
    const std::size_t end = rest.rfind('"');
    if (begin == std::string_view::npos || begin == end) in_.fail("a physical name is not in quotation marks");
    if (tag > std::numeric_limits<int>::max()) in_.fail(fmt::format("the tag {} is too large", tag));
    soup_.names[{static_cast<int>(dimension), static_cast<int>(tag)}] = rest.substr(begin + 1, end - begin - 1);
  }
  end_section("$EndPhysicalNames");
}

void GmshReader::read_entities() {
  if (binary_) in_.line();
  std::array<std::size_t, 4> counts{};
  for (std::size_t& n : counts) n = size_of_list("the number of entities", 2, 4);
  for (int dimension = 0; dimension < 4; ++dimension)
    for (std::size_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) read_entity(dimension);
  end_section("$EndEntities");
}

void GmshReader::read_entity(int dimension) {
  const std::int64_t tag = integer("the tag of an entity");
  for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) real("the box of an entity");
  const std::size_t groups = size_of_list("the number of physical tags", 2, 4);
  for (std::size_t i = 0; i < groups; ++i) {
    const std::int64_t physical = integer("a physical tag");
    if (physical != 0) physical_of_.emplace(std::pair(dimension, tag), std::abs(std::max(physical, -INT64_MAX)));
  }
  if (dimension == 0) return;
  const std::size_t bounds = size_of_list("the number of bounding entities", 2, 4);
  for (std::size_t i = 0; i < bounds; ++i) integer("a bounding entity");
}

void GmshReader::read_nodes2() {
  std::vector<std::pair<std::int64_t, Vec3>> nodes(in_.count("the number of nodes", binary_ ? 28 : 8));
  in_.line();
  for (auto& [tag, p] : nodes) {
    tag = integer("the tag of a node");
    for (int k = 0; k < 3; ++k) p[k] = real("a coordinate");
  }
  set_nodes(std::move(nodes));
}

void GmshReader::read_nodes4() {
  if (binary_) in_.line();
  const std::int64_t blocks = size("the number of node blocks");
  std::vector<std::pair<std::int64_t, Vec3>> nodes(size_of_list("the number of nodes", 8, 32));
  size("the smallest node tag");
  size("the largest node tag");
  std::size_t done = 0;
  for (std::int64_t b = 0; b < blocks; ++b) {
    const std::int64_t dimension = integer("the dimension of an entity");
    integer("the tag of an entity");
    const bool parametric = integer("whether nodes have parameters") != 0;
    const std::int64_t n = size("the number of nodes");
    if (dimension < 0 || dimension > 3) in_.fail(fmt::format("an entity has the dimension {}", dimension));
    if (n < 0 || n > static_cast<std::int64_t>(nodes.size() - done))
      in_.fail(fmt::format("the blocks have more than the {} nodes of the header", nodes.size()));
    const std::size_t end = done + static_cast<std::size_t>(n);
    for (std::size_t i = done; i < end; ++i) nodes[i].first = size("the tag of a node");
    for (; done < end; ++done) {
      for (int k = 0; k < 3; ++k) nodes[done].second[k] = real("a coordinate");
      for (std::int64_t k = 0; parametric && k < dimension; ++k) real("a parameter");
    }
  }
  if (done != nodes.size())
    in_.fail(fmt::format("the blocks have {} nodes but the header says {}", done, nodes.size()));
  set_nodes(std::move(nodes));
}

void GmshReader::set_nodes(std::vector<std::pair<std::int64_t, Vec3>> nodes) {
  if (have_nodes_) in_.fail("there is a second $Nodes section");
  have_nodes_ = true;
  const auto before = [](const auto& a, const auto& b) { return a.first < b.first; };
  if (!std::is_sorted(nodes.begin(), nodes.end(), before)) std::stable_sort(nodes.begin(), nodes.end(), before);
  std::vector<std::int64_t> tags;
  tags.reserve(nodes.size());
  soup_.points.reserve(nodes.size());
  for (const auto& [tag, p] : nodes) {
    if (tag < 0 || (!tags.empty() && tag == tags.back()))
      in_.fail(fmt::format("the node tag {} {}", tag, tag < 0 ? "is negative" : "is there twice"));
    tags.push_back(tag);
    soup_.points.push_back(p);
  }
  index_ = NodeIndex(std::move(tags));
  soup_.point_ids = index_.tags();
  end_section("$EndNodes");
}

void GmshReader::read_elements2() {
  if (!have_nodes_) in_.fail("$Elements comes before $Nodes");
  have_elements_ = true;
  const auto n = static_cast<std::int64_t>(in_.count("the number of elements", 6));
  in_.line();
  for (std::int64_t done = 0; done < n;) {
    // Binary elements come in runs of one type; in ASCII each stands alone with its id first.
    std::int64_t id = binary_ ? 0 : integer("the tag of an element");
    const std::int64_t type = integer("the type of an element");
    const std::int64_t run = binary_ ? integer("the number of elements") : 1;
    const std::int64_t num_tags = integer("the number of tags");
    if (run < 1 || run > n - done) in_.fail(fmt::format("a run of {} elements where {} are left", run, n - done));
    in_.check_count(num_tags, "the number of tags", binary_ ? 4 : 2);
    for (std::int64_t i = 0; i < run; ++i, ++done) {
      if (binary_) id = integer("the tag of an element");
      Tags tags;
      for (std::int64_t k = 0; k < num_tags; ++k) {
        const std::int64_t tag = integer("a tag of an element");
        if (k == 0) tags.physical = std::abs(std::max(tag, -INT64_MAX));
        if (k == 1) tags.elementary = tag;
      }
      read_element(shape_of(type, id), tags, id);
    }
  }
  end_section("$EndElements");
}

void GmshReader::read_elements4() {
  if (!have_nodes_) in_.fail("$Elements comes before $Nodes");
  have_elements_ = true;
  if (binary_) in_.line();
  const std::int64_t blocks = size("the number of element blocks");
  auto left = static_cast<std::int64_t>(size_of_list("the number of elements", 4, 16));
  size("the smallest element tag");
  size("the largest element tag");
  for (std::int64_t b = 0; b < blocks; ++b) {
    const std::int64_t dimension = integer("the dimension of an entity");
    const std::int64_t entity = integer("the tag of an entity");
    const std::int64_t type = integer("the type of elements");
    const std::int64_t n = size("the number of elements");
    if (n < 0 || n > left) in_.fail(fmt::format("a block of {} elements where {} are left", n, left));
    left -= n;
    if (n == 0) continue;
    const auto physical = physical_of_.find({static_cast<int>(std::clamp<std::int64_t>(dimension, -1, 4)), entity});
    const Tags tags{physical == physical_of_.end() ? 0 : physical->second, entity};
    for (std::int64_t i = 0; i < n; ++i) {
      const std::int64_t id = size("the tag of an element");
      read_element(shape_of(type, id), tags, id);
    }
  }
  if (left != 0) in_.fail(fmt::format("the blocks have {} elements less than the header says", left));
  end_section("$EndElements");
}

void GmshReader::read_element(Shape shape, Tags tags, std::int64_t id) {
  std::array<std::int64_t, 8> vertices{};
  for (int k = 0; k < shape_corners[static_cast<std::size_t>(shape)]; ++k) {
    const std::int64_t tag = version_ >= 4 ? size("a node of an element") : integer("a node of an element");
    const std::int64_t v = index_.find(tag);
    if (v < 0) in_.fail(fmt::format("element {} names the node {}, which does not exist", id, tag));
    vertices[static_cast<std::size_t>(k)] = v;
  }
  soup_.add(shape, vertices.data(), 0, id);
  tags_[static_cast<std::size_t>(shape)].push_back(tags);
}

Shape GmshReader::shape_of(std::int64_t type, std::int64_t element) const {
  for (std::size_t s = 0; s < num_shapes; ++s)
    if (shape_gmsh[s] == type) return static_cast<Shape>(s);
  in_.fail(
      fmt::format("element {} has Gmsh type {}; only points (15) and lines (1), triangles (2), quads (3), tets (4) "
                  "and hexes (5) of first order are known here",
                  element, type));
}

void GmshReader::end_section(const std::string& name) {
  const std::string_view token = in_.token(name.c_str());
  if (token != name) in_.fail(fmt::format("\"{}\" stands where {} is expected", printable(token), name));
}

void GmshReader::sort_cells() {
  for (std::size_t s = 0; s < num_shapes; ++s) {
    CellBlock& block = soup_.blocks[s];
    if (std::is_sorted(block.ids.begin(), block.ids.end())) continue;
    std::vector<std::size_t> order(block.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return block.ids[a] < block.ids[b]; });
    const auto corners = static_cast<std::size_t>(shape_corners[s]);
    CellBlock sorted;
    std::vector<Tags> tags;
    for (std::size_t c : order) {
      const auto begin = block.vertices.begin() + static_cast<std::ptrdiff_t>(corners * c);
      sorted.vertices.insert(sorted.vertices.end(), begin, begin + static_cast<std::ptrdiff_t>(corners));
      sorted.ids.push_back(block.ids[c]);
      tags.push_back(tags_[s][c]);
    }
    sorted.colours.assign(order.size(), 0);
    block = std::move(sorted);
    tags_[s] = std::move(tags);
  }
}

// The physical tag where there is one, else the elementary tag, moved out of the way of the physical ones.
void GmshReader::choose_colours() {
  for (int dimension = 0; dimension < 4; ++dimension) {
    std::set<std::int64_t> physical;
    bool clash = false;
    const auto each = [&](const auto& visit) {
      for (std::size_t s = 0; s < num_shapes; ++s)
        if (shape_dimension[s] == dimension)
          for (std::size_t c = 0; c < tags_[s].size(); ++c) visit(s, c, tags_[s][c]);
    };
    each([&](std::size_t, std::size_t, const Tags& t) {
      if (t.physical > 0) physical.insert(t.physical);
    });
    each([&](std::size_t, std::size_t, const Tags& t) {
      clash = clash || (t.physical <= 0 && physical.contains(t.elementary));
    });
    const std::int64_t shift = clash ? *physical.rbegin() : 0;
    each([&](std::size_t s, std::size_t c, const Tags& t) {
      const std::int64_t elementary = t.elementary > 0 ? t.elementary : 0;
      const bool too_large = shift > INT64_MAX - elementary;
      const std::int64_t colour = t.physical > 0                 ? t.physical
                                  : elementary > 0 && !too_large ? elementary + shift
                                                                 : elementary;
      if (colour > std::numeric_limits<int>::max())
        in_.fail(fmt::format("element {} has the tag {}, which is too large", soup_.blocks[s].ids[c], colour));
      soup_.blocks[s].colours[c] = static_cast<int>(colour);
    });
  }
}

std::int64_t GmshReader::integer(const char* what) {
  return binary_ ? in_.binary<std::int32_t>(what) : in_.integer(what);
}

std::int64_t GmshReader::size(const char* what) {
  const std::int64_t value = binary_ ? in_.binary<std::int64_t>(what) : in_.integer(what);
  if (value < 0) in_.fail(fmt::format("{} is negative or too large", what));
  return value;
}

std::size_t GmshReader::size_of_list(const char* what, std::size_t ascii_bytes, std::size_t binary_bytes) {
  const std::int64_t n = size(what);
  in_.check_count(n, what, binary_ ? binary_bytes : ascii_bytes);
  return static_cast<std::size_t>(n);
}

double GmshReader::real(const char* what) { return binary_ ? in_.binary<double>(what) : in_.real(what); }

CellSoup read_gmsh(Scanner in) { return GmshReader(std::move(in)).read(); }

}  // namespace hexfield::io
