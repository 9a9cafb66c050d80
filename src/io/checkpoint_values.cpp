#include "hexfield/io/checkpoint_values.hpp"

#include <sstream>

#include "value_arrays.hpp"

namespace hexfield {
namespace {

static_assert(sizeof(Vec3) == 24 && sizeof(Quaternion) == 32 && sizeof(VertexId) == 4 && sizeof(HalfFaceId) == 4);
static_assert(sizeof(std::array<Vec3, 4>) == 96 && sizeof(std::array<octahedral::Rotation, 4>) == 4);

/// The opposites follow from the tets; the tet of each vertex is kept because several would be right.
void pack_mesh(const TetMesh& mesh, NamedArrays& arrays) {
  arrays.view("points", as_numbers<double>(mesh.points, 3), 3);
  arrays.view("tets", as_numbers<std::int32_t>(mesh.tets, 4), 4);
  arrays.view("vertex_tet", as_numbers<std::int32_t>(mesh.vertex_tet, 1), 1);
}

TetMesh unpack_mesh(const NamedArrays& arrays) {
  const auto points = arrays.get<double>("points", 3);
  const auto tets = arrays.get<std::int32_t>("tets", 4);
  const auto vertex_tet = arrays.get<std::int32_t>("vertex_tet", 1);
  require_same(3 * vertex_tet.size() == points.size(), "its mesh has not one tet per vertex");
  require_ids(tets, 0, vertex_tet.size(), "vertex");
  require_ids(vertex_tet, -1, tets.size() / 4, "tet");
  TetMesh mesh = build_tet_mesh(from_numbers<Vec3>(points, 3), from_numbers<std::array<VertexId, 4>>(tets, 4));
  mesh.vertex_tet = from_numbers<TetId>(vertex_tet, 1);
  return mesh;
}

void pack_features(const Features& features, NamedArrays& arrays) {
  std::vector<std::int32_t> points;
  for (const auto& [vertex, colour] : features.points) points.insert(points.end(), {vertex.value, colour});
  arrays.own("feature_points", std::move(points), 2);
  arrays.own("feature_edges", rows_of(features.edges), 3);
  arrays.own("feature_faces", rows_of(features.faces), 4);
  arrays.view<std::int32_t>("tet_colours", features.tet_colours, 1);
  arrays.own_text("group_names", names_text(features.names));
}

Features unpack_features(const NamedArrays& arrays, const TetMesh& mesh) {
  Features features;
  const auto points = arrays.get<std::int32_t>("feature_points", 2);
  for (std::size_t r = 0; r + 1 < points.size(); r += 2) features.points[VertexId(points[r])] = points[r + 1];
  features.edges = map_of<2>(arrays.get<std::int32_t>("feature_edges", 3));
  features.faces = map_of<3>(arrays.get<std::int32_t>("feature_faces", 4));
  const auto in_range = [&](VertexId v) { return v.valid() && v.index() < mesh.num_vertices(); };
  for (const auto& entry : features.points) require_same(in_range(entry.first), "a feature point is out of range");
  for (const auto& entry : features.edges) {
    for (VertexId v : entry.first) require_same(in_range(v), "a feature edge is out of range");
  }
  for (const auto& entry : features.faces) {
    for (VertexId v : entry.first) require_same(in_range(v), "a feature face is out of range");
  }
  const auto colours = arrays.get<std::int32_t>("tet_colours", 1);
  require_same(colours.empty() || colours.size() == mesh.num_tets(), "it has not one material per tet");
  features.tet_colours.assign(colours.begin(), colours.end());
  features.names = names_from_text(arrays.text("group_names"));
  return features;
}

void pack_map(const CornerMap& map, const MapReport& report, NamedArrays& arrays) {
  arrays.view("uvw", as_numbers<double>(map.uvw, 12), 12);
  arrays.view("rotations", as_numbers<std::uint8_t>(map.rotations, 4), 4);
  arrays.view("inverted", as_numbers<std::int32_t>(report.inverted, 1), 1);
  arrays.view("wrong_edges", as_numbers<std::int32_t>(report.wrong_edges, 2), 2);
  arrays.own("max_residual", std::vector<double>{report.max_residual}, 1);
}

void unpack_map(const NamedArrays& arrays, std::size_t num_tets, CornerMap& map, MapReport& report) {
  const auto uvw = arrays.get<double>("uvw", 12);
  const auto rotations = arrays.get<std::uint8_t>("rotations", 4);
  require_same(uvw.size() == 12 * num_tets && rotations.size() == 4 * num_tets, "its map belongs to another mesh");
  for (std::uint8_t r : rotations) require_same(r < octahedral::order, "a transition is no rotation of the cube");
  map.uvw = from_numbers<std::array<Vec3, 4>>(uvw, 12);
  map.rotations = from_numbers<std::array<octahedral::Rotation, 4>>(rotations, 4);
  report.inverted = from_numbers<TetId>(arrays.get<std::int32_t>("inverted", 1), 1);
  report.wrong_edges = from_numbers<EdgeKey>(arrays.get<std::int32_t>("wrong_edges", 2), 2);
  const auto residual = arrays.get<double>("max_residual", 1);
  require_same(residual.size() == 1, "its map has no residual");
  report.max_residual = residual[0];
}

}  // namespace

std::string names_text(const std::map<std::pair<int, int>, std::string>& names) {
  std::string text;
  for (const auto& [key, name] : names) {
    text += fmt::format("{} {} ", key.first, key.second);
    for (char c : name) {
      if (c == '\n' || c == '\\') text += '\\';
      text += c == '\n' ? 'n' : c;
    }
    text += '\n';
  }
  return text;
}

std::map<std::pair<int, int>, std::string> names_from_text(const std::string& text) {
  std::map<std::pair<int, int>, std::string> names;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::pair<int, int> key;
    words >> key.first >> key.second;
    require_same(!words.fail(), "a group name cannot be read");
    words.get();
    std::string name;
    for (char c; words.get(c);) {
      if (c != '\\') {
        name += c;
      } else if (words.get(c)) {
        name += c == 'n' ? '\n' : c;
      }
    }
    names[key] = name;
  }
  return names;
}

NamedArrays pack(const TetInput& input) {
  NamedArrays arrays;
  pack_mesh(input.mesh, arrays);
  pack_features(input.features, arrays);
  return arrays;
}

TetInput unpack_tet_input(const NamedArrays& arrays) {
  TetInput input;
  input.mesh = unpack_mesh(arrays);
  input.features = unpack_features(arrays, input.mesh);
  return input;
}

NamedArrays pack(const FieldResult& result) {
  NamedArrays arrays;
  pack_mesh(result.mesh, arrays);
  pack_features(result.features, arrays);
  arrays.view("frames_xyzw", as_numbers<double>(result.field.frames, 4), 4);
  arrays.view("matchings", as_numbers<std::uint8_t>(result.field.matchings, 4), 4);
  arrays.own("edge_codes", rows_of(result.codes), 3);
  return arrays;
}

FieldResult unpack_field(const NamedArrays& arrays) {
  FieldResult result;
  result.mesh = unpack_mesh(arrays);
  result.features = unpack_features(arrays, result.mesh);
  const auto frames = arrays.get<double>("frames_xyzw", 4);
  const auto matchings = arrays.get<std::uint8_t>("matchings", 4);
  const std::size_t n = result.mesh.num_tets();
  require_same(frames.size() == 4 * n && matchings.size() == 4 * n, "its field belongs to another mesh");
  for (std::uint8_t m : matchings) require_same(m < octahedral::order, "a matching is no rotation of the cube");
  result.field.frames = from_numbers<Quaternion>(frames, 4);
  result.field.matchings = from_numbers<std::array<octahedral::Rotation, 4>>(matchings, 4);
  result.codes = map_of<2>(arrays.get<std::int32_t>("edge_codes", 3));
  return result;
}

NamedArrays pack(const SeamlessResult& result) {
  NamedArrays arrays;
  pack_map(result.map, result.report, arrays);
  arrays.own("iterations", std::vector<std::int64_t>{result.newton_steps, result.linear_iterations}, 1);
  return arrays;
}

SeamlessResult unpack_seamless(const NamedArrays& arrays, std::size_t num_tets) {
  SeamlessResult result;
  unpack_map(arrays, num_tets, result.map, result.report);
  const auto iterations = arrays.get<std::int64_t>("iterations", 1);
  require_same(iterations.size() == 2, "its iteration counts are missing");
  result.newton_steps = static_cast<int>(iterations[0]);
  result.linear_iterations = static_cast<int>(iterations[1]);
  return result;
}

NamedArrays pack(const IgmResult& result) {
  NamedArrays arrays;
  pack_map(result.map, result.report, arrays);
  arrays.own("iterations", std::vector<std::int64_t>{result.newton_steps, result.linear_iterations}, 1);
  arrays.own("quantization_valid",
             std::vector<std::uint8_t>{result.quantization_valid ? std::uint8_t{1} : std::uint8_t{0}}, 1);
  arrays.own_text("reason", result.reason);
  arrays.view("where", as_numbers<double>(result.where, 3), 3);
  return arrays;
}

IgmResult unpack_igm(const NamedArrays& arrays, std::size_t num_tets) {
  IgmResult result;
  unpack_map(arrays, num_tets, result.map, result.report);
  const auto iterations = arrays.get<std::int64_t>("iterations", 1);
  const auto valid = arrays.get<std::uint8_t>("quantization_valid", 1);
  require_same(iterations.size() == 2 && valid.size() == 1, "its iteration counts are missing");
  result.newton_steps = static_cast<int>(iterations[0]);
  result.linear_iterations = static_cast<int>(iterations[1]);
  result.quantization_valid = valid[0] != 0;
  result.reason = arrays.text("reason");
  result.where = from_numbers<Vec3>(arrays.get<double>("where", 3), 3);
  return result;
}

}  // namespace hexfield
