#include "quantize_values.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>

#include "hexfield/base/error.hpp"

namespace hexfield {
namespace {

template <class T, class S>
std::span<const T> numbers(const std::vector<S>& rows) {
  static_assert(sizeof(S) % sizeof(T) == 0);
  return {reinterpret_cast<const T*>(rows.data()), rows.size() * (sizeof(S) / sizeof(T))};
}

template <class S, class T>
void take(const NamedArrays& arrays, const std::string& name, std::vector<S>& rows) {
  constexpr std::size_t columns = sizeof(S) / sizeof(T);
  const auto values = arrays.get<T>(name, columns);
  rows.resize(values.size() / columns);
  std::copy(values.begin(), values.end(), reinterpret_cast<T*>(rows.data()));
}

}  // namespace

BlockPicture picture_of(const BlockComplex& complex, const std::vector<std::int64_t>& lengths) {
  BlockPicture picture;
  picture.points = complex.picture_points;
  for (const auto& [corners, patch] : complex.picture_triangles) {
    const auto& p = complex.patches[static_cast<std::size_t>(patch)];
    picture.triangles.push_back(corners);
    picture.walls.push_back({patch, p.blocks[0], p.blocks[1], p.blocks[1] < 0 ? 1 : 0});
  }
  for (const auto& [ends, arc] : complex.picture_lines) {
    const auto& a = complex.arcs[static_cast<std::size_t>(arc)];
    picture.lines.push_back(ends);
    picture.arcs.push_back(
        {arc, a.code, a.feature ? 1 : 0, static_cast<std::int32_t>(lengths[static_cast<std::size_t>(arc)])});
  }
  return picture;
}

std::string spacing_near(const QuantizeResult& result, const std::vector<Vec3>& places) {
  const BlockPicture& picture = result.picture;
  double worst = -1;
  std::string sentence;
  for (const Vec3& place : places) {
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < picture.lines.size(); ++i) {
      const auto& [a, b] = picture.lines[i];
      const Vec3 middle =
          0.5 * (picture.points[static_cast<std::size_t>(a)] + picture.points[static_cast<std::size_t>(b)]);
      const double distance = (middle - place).squaredNorm();
      if (distance < least) least = distance, nearest = i;
    }
    if (picture.lines.empty()) return "";
    const auto arc = static_cast<std::size_t>(picture.arcs[nearest][0]);
    const auto length = static_cast<double>(picture.arcs[nearest][3]);
    if (std::abs(length - result.wanted[arc]) <= worst) continue;
    worst = std::abs(length - result.wanted[arc]);
    const Vec3& p = picture.points[static_cast<std::size_t>(picture.lines[nearest][0])];
    sentence = fmt::format("The arc at ({:.6g}, {:.6g}, {:.6g}) is to hold {} hexes where the map has room for {:.3g}.",
                           p.x(), p.y(), p.z(), length, result.wanted[arc]);
  }
  return sentence;
}

NamedArrays pack(const QuantizeResult& result) {
  NamedArrays arrays;
  const Quantization& q = result.integers;
  const nlohmann::json words = {{"kind", result.kind},
                                {"notes", result.notes},
                                {"seconds", result.seconds},
                                {"method", q.method},
                                {"proven", q.proven_optimal}};
  arrays.own_text("quantize_words", words.dump());
  arrays.own("quantize_counts",
             std::vector<std::int64_t>{result.nodes, result.arcs, result.patches, result.blocks, result.euler, q.hexes,
                                       q.rounds, static_cast<std::int64_t>(q.separations),
                                       static_cast<std::int64_t>(q.sheets)},
             1);
  arrays.own("quantize_measures", std::vector<double>{result.largest_move, q.scale, q.objective}, 1);
  arrays.view<std::int64_t>("quantize_lengths", q.lengths, 1);
  arrays.view<double>("quantize_wanted", result.wanted, 1);
  arrays.view<double>("quantize_unknowns", result.unknowns, 1);
  arrays.view("quantize_stretches", numbers<double>(result.stretches), 3);
  arrays.view("quantize_points", numbers<double>(result.picture.points), 3);
  arrays.view("quantize_triangles", numbers<std::int32_t>(result.picture.triangles), 3);
  arrays.view("quantize_walls", numbers<std::int32_t>(result.picture.walls), 4);
  arrays.view("quantize_lines", numbers<std::int32_t>(result.picture.lines), 2);
  arrays.view("quantize_line_arcs", numbers<std::int32_t>(result.picture.arcs), 4);
  return arrays;
}

QuantizeResult unpack_quantize(const NamedArrays& arrays) {
  QuantizeResult result;
  Quantization& q = result.integers;
  const auto counts = arrays.get<std::int64_t>("quantize_counts", 1);
  const auto measures = arrays.get<double>("quantize_measures", 1);
  try {
    const auto words = nlohmann::json::parse(arrays.text("quantize_words"));
    words.at("kind").get_to(result.kind);
    words.at("notes").get_to(result.notes);
    words.at("seconds").get_to(result.seconds);
    words.at("method").get_to(q.method);
    words.at("proven").get_to(q.proven_optimal);
  } catch (const nlohmann::json::exception& error) {
    throw Error(ExitCode::bad_input,
                fmt::format("The checkpoint contradicts itself: its quantization: {}.", error.what()));
  }
  if (counts.size() != 9 || measures.size() != 3)
    throw Error(ExitCode::bad_input, "The checkpoint contradicts itself: counts of its quantization are missing.");
  result.nodes = counts[0], result.arcs = counts[1], result.patches = counts[2], result.blocks = counts[3];
  result.euler = counts[4];
  q.hexes = counts[5], q.rounds = static_cast<int>(counts[6]);
  q.separations = static_cast<std::size_t>(counts[7]), q.sheets = static_cast<std::size_t>(counts[8]);
  result.largest_move = measures[0], q.scale = measures[1], q.objective = measures[2];
  take<std::int64_t, std::int64_t>(arrays, "quantize_lengths", q.lengths);
  take<double, double>(arrays, "quantize_wanted", result.wanted);
  take<double, double>(arrays, "quantize_unknowns", result.unknowns);
  take<Vec3, double>(arrays, "quantize_stretches", result.stretches);
  take<Vec3, double>(arrays, "quantize_points", result.picture.points);
  take<std::array<std::int32_t, 3>, std::int32_t>(arrays, "quantize_triangles", result.picture.triangles);
  take<std::array<std::int32_t, 4>, std::int32_t>(arrays, "quantize_walls", result.picture.walls);
  take<std::array<std::int32_t, 2>, std::int32_t>(arrays, "quantize_lines", result.picture.lines);
  take<std::array<std::int32_t, 4>, std::int32_t>(arrays, "quantize_line_arcs", result.picture.arcs);
  return result;
}

NamedArrays joined(NamedArrays a, const NamedArrays& b) {
  for (const auto& [name, array] : b.all()) {
    require(!a.contains(name), "Two arrays of a checkpoint have the same name.");
    a.add(name, array);
  }
  return a;
}

}  // namespace hexfield
