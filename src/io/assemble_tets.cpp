#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "cell_soup.hpp"
#include "hexfield/mesh/input_check.hpp"

namespace hexfield::io {
namespace {

// Tets and features by point indices of the soup.
struct RawTets {
  std::vector<std::array<VertexId, 4>> tets;
  Features features;
  bool reversed = false;
};

// Calls keep(vertices, colour) for every tagged cell of a shape.
template <std::size_t N, class Keep>
void for_tagged(const CellSoup& soup, Shape s, const Keep& keep) {
  const CellBlock& b = soup.block(s);
  for (std::size_t c = 0; c < b.size(); ++c) {
    if (b.colours[c] <= 0) continue;
    std::array<VertexId, N> v;
    for (std::size_t k = 0; k < N; ++k) v[k] = VertexId(b.vertices[N * c + k]);
    keep(v, b.colours[c]);
  }
}

Features features_of(const CellSoup& soup) {
  Features features;
  for_tagged<1>(soup, Shape::point, [&](const auto& v, int colour) { features.points.emplace(v[0], colour); });
  for_tagged<2>(soup, Shape::line,
                [&](const auto& v, int colour) { features.edges.emplace(edge_key(v[0], v[1]), colour); });
  for_tagged<3>(soup, Shape::triangle,
                [&](const auto& v, int colour) { features.faces.emplace(face_key(v[0], v[1], v[2]), colour); });
  features.names = soup.names;
  features.tet_colours = volume_colours(soup, Shape::tet);
  return features;
}

RawTets raw_tets(const CellSoup& soup) {
  check_indices(soup);
  for (const Shape s : {Shape::hex, Shape::quad})
    if (soup.block(s).size() > 0) refuse_cell(soup, s, 0, "cannot be part of a tet mesh");
  const CellBlock& block = soup.block(Shape::tet);
  if (block.size() == 0) refuse_without(soup, "tetrahedra");
  RawTets raw;
  raw.tets.resize(block.size());
  for (std::size_t t = 0; t < raw.tets.size(); ++t)
    for (std::size_t k = 0; k < 4; ++k) raw.tets[t][k] = VertexId(block.vertices[4 * t + k]);
  raw.reversed = orient_if_all_inverted(soup.points, raw.tets);
  raw.features = features_of(soup);
  return raw;
}

std::vector<Violation> violations_of(const CellSoup& soup, const RawTets& raw) {
  InputIds ids;
  ids.vertex = [&](std::int64_t i) { return soup.point_id(static_cast<std::size_t>(i)); };
  ids.tet = [&](std::int64_t t) { return soup.block(Shape::tet).ids[static_cast<std::size_t>(t)]; };
  return check_input(soup.points, raw.tets, raw.features, ids);
}

// Drops the points that no tet uses from `points`; the new index of each, invalid for these.
std::vector<VertexId> drop_unused(const RawTets& raw, std::vector<Vec3>& points) {
  std::vector<char> used(points.size(), 0);
  for (const auto& tet : raw.tets)
    for (VertexId v : tet) used[v.index()] = 1;
  std::vector<VertexId> index(points.size());
  std::size_t n = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (used[i] != 0) {
      index[i] = VertexId(static_cast<std::int64_t>(n));
      points[n++] = points[i];
    }
  points.resize(n);
  return index;
}

// The order of vertices stays, so sorted keys stay sorted.
void renumber(Features& features, const std::vector<VertexId>& index) {
  const auto renumbered = [&](const auto& old, const auto& key_of) {
    std::decay_t<decltype(old)> map;
    for (const auto& [key, colour] : old) map.emplace_hint(map.end(), key_of(key), colour);
    return map;
  };
  const auto all = [&](auto key) {
    for (VertexId& v : key) v = index[v.index()];
    return key;
  };
  features.points = renumbered(features.points, [&](VertexId v) { return index[v.index()]; });
  features.edges = renumbered(features.edges, all);
  features.faces = renumbered(features.faces, all);
}

std::vector<std::string> notes_on(const CellSoup& soup, const RawTets& raw, std::size_t kept_points) {
  std::vector<std::string> notes;
  if (raw.reversed) notes.push_back("All tets were listed inverted; two vertices of each were exchanged.");
  if (kept_points < soup.points.size())
    notes.push_back(fmt::format("Points that no tet uses were dropped: {}.", soup.points.size() - kept_points));
  std::size_t negative = 0;
  for (const CellBlock& b : soup.blocks) negative += b.negative;
  if (negative > 0) notes.push_back(fmt::format("Cells with negative tags, which count as no tag: {}.", negative));
  return notes;
}

}  // namespace

TetInput assemble_tets(const CellSoup& soup) {
  RawTets raw = raw_tets(soup);
  require_valid_input(soup.file, violations_of(soup, raw));
  std::vector<Vec3> points = soup.points;
  const auto index = drop_unused(raw, points);
  TetInput input;
  input.notes = notes_on(soup, raw, points.size());
  for (auto& tet : raw.tets)
    for (VertexId& v : tet) v = index[v.index()];
  renumber(raw.features, index);
  input.mesh = build_tet_mesh(std::move(points), std::move(raw.tets));
  input.features = std::move(raw.features);
  return input;
}

std::vector<Violation> check_tets(const CellSoup& soup) { return violations_of(soup, raw_tets(soup)); }

}  // namespace hexfield::io
