#include "integer_frames.hpp"

#include <cmath>

namespace hexfield::quantize {

using octahedral::Label;
using octahedral::Rotation;
using Integer3 = BlockComplex::Integer3;

namespace {

Integer3 plus(const Integer3& a, const Integer3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Integer3 minus(const Integer3& a, const Integer3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

}  // namespace

IntegerFrames::IntegerFrames(const ChartMesh& mesh, const WallCells& cells, const ConformingSpace& space,
                             const std::vector<std::int64_t>& lengths)
    : mesh_(mesh), cells_(cells), space_(space), layout_(cells.complex, lengths) {
  name_origins();
  collect_corners();
  flood();
  translate_cut();
}

void IntegerFrames::fail(const char* what, std::int32_t t) const {
  const std::int32_t v = mesh_.tet(t).vertices[0];
  throw Error(ExitCode::no_integer_grid_map, what, {static_cast<std::int64_t>(input_tet(t))},
              {mesh_.places[static_cast<std::size_t>(v)]});
}

// Children come after their parents.
void IntegerFrames::name_origins() {
  origin_.assign(mesh_.num_tets(), -1);
  for (std::size_t t = 0; t < mesh_.num_tets(); ++t) {
    if (origin_[t] < 0) origin_[t] = static_cast<std::int32_t>(t);
    const auto child = mesh_.tet(static_cast<std::int32_t>(t)).child;
    for (std::int32_t c = child; child >= 0 && c < child + 2; ++c) origin_[static_cast<std::size_t>(c)] = origin_[t];
  }
}

// Descendants keep the local numbers of the vertices that they have from their tet.
void IntegerFrames::collect_corners() {
  corners_.resize(space_.cut.num_classes());
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh_.num_tets()); ++t) {
    if (!mesh_.alive(t)) continue;
    for (int i = 0; i < 4; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (mesh_.tet(t).vertices[k] != mesh_.tet(origin_[static_cast<std::size_t>(t)]).vertices[k]) continue;
      corners_[static_cast<std::size_t>(space_.cut.classes[input_tet(t)][k])].push_back({t, i});
    }
  }
}

IntegerFrames::Frame IntegerFrames::across(std::int32_t h) const {
  const Frame& here = frames_[static_cast<std::size_t>(h / 4)];
  if (!mesh_.is_wall(h)) return here;
  const std::int32_t p = cells_.patch_at(h);
  const auto& patch = cells_.complex.patches[static_cast<std::size_t>(p)];
  const std::int32_t from = cells_.block_of_tet(h / 4);
  const bool forward = patch.blocks[0] == from;
  const std::int32_t to = patch.blocks[forward ? 1 : 0];
  const Rotation turn = forward ? patch.rotation : octahedral::inverse(patch.rotation);
  std::int32_t node = -1;
  for (const auto& side : patch.sides)
    if (!side.empty()) node = cells_.complex.arcs[static_cast<std::size_t>(side[0])].nodes[0];
  const Integer3 step = minus(layout_.place(to, node), rotate(turn, layout_.place(from, node)));
  return {octahedral::product(turn, here.rotation), plus(rotate(turn, here.translation), step)};
}

void IntegerFrames::flood() {
  frames_.resize(mesh_.num_tets());
  reached_.assign(mesh_.num_tets(), 0);
  std::vector<std::int32_t> stack;
  for (std::int32_t seed = 0; seed < static_cast<std::int32_t>(mesh_.num_tets()); ++seed) {
    if (!mesh_.alive(seed) || reached_[static_cast<std::size_t>(seed)] != 0) continue;
    frames_[static_cast<std::size_t>(seed)] = {
        octahedral::product(cells_.to_block(seed).rotation, space_.cut.gauges[input_tet(seed)]), {}};
    reached_[static_cast<std::size_t>(seed)] = 1;
    stack.assign(1, seed);
    for (std::size_t k = 0; k < stack.size(); ++k)
      for (std::int32_t h = 4 * stack[k]; h < 4 * stack[k] + 4; ++h) {
        const std::int32_t o = mesh_.opposite(h);
        if (o < 0 || (mesh_.crosses_original(h) && space_.cut.patch(original(h)) != 0)) continue;
        const auto next = static_cast<std::size_t>(o / 4);
        const Frame frame = across(h);
        if (std::exchange(reached_[next], 1) == 0) {
          frames_[next] = frame;
          stack.push_back(o / 4);
        } else if (frames_[next].rotation != frame.rotation || frames_[next].translation != frame.translation) {
          fail("The integer blocks do not fit together around an arc.", o / 4);
        }
      }
  }
}

// R' (R_c X + t) + T' = frame across of X.
void IntegerFrames::translate_cut() {
  translations_.resize(space_.cut.num_patches);
  for (std::int32_t h = 0; h < static_cast<std::int32_t>(4 * mesh_.num_tets()); ++h) {
    if (!mesh_.alive(h / 4) || !mesh_.crosses_original(h)) continue;
    const HalfFaceId face = original(h);
    const std::int32_t patch = space_.cut.patch(face);
    if (patch <= 0) continue;
    const Frame over = across(h);
    const Frame& there = frames_[static_cast<std::size_t>(mesh_.opposite(h) / 4)];
    const Rotation back = octahedral::inverse(there.rotation);
    if (octahedral::product(back, over.rotation) != space_.cut.rotation(face))
      fail("The integer blocks turn differently from the map across its cut.", h / 4);
    const Integer3 t = rotate(back, minus(over.translation, there.translation));
    auto& known = translations_[static_cast<std::size_t>(patch - 1)];
    if (known && *known != t) fail("The integer blocks move differently along one piece of the cut.", h / 4);
    known = t;
  }
}

std::array<std::int64_t, 3> IntegerFrames::grid_place(const Corner& corner) const {
  std::array<double, 3> x;
  for (int k = 0; k < 3; ++k)
    x[static_cast<std::size_t>(k)] = mesh_.points.value(mesh_.point(corner.tet, corner.local), k);
  x = transport(cells_.to_block(corner.tet), x);
  return {std::llround(x[0]), std::llround(x[1]), std::llround(x[2])};
}

// Combed integer coordinate of a corner that is a node, or lies on the face of its block across that axis.
std::optional<std::int64_t> IntegerFrames::value(const Corner& corner, int axis) const {
  const Frame& frame = frames_[static_cast<std::size_t>(corner.tet)];
  const Label to = octahedral::image(frame.rotation, static_cast<Label>(2 * axis));
  const std::size_t a = to / 2;
  const std::int32_t b = cells_.block_of_tet(corner.tet);
  const std::int32_t node = cells_.node_at(mesh_.tet(corner.tet).vertices[static_cast<std::size_t>(corner.local)]);
  const auto& block = cells_.complex.blocks[static_cast<std::size_t>(b)];
  const std::int64_t real = grid_place(corner)[a];
  std::int64_t place = 0;
  if (node >= 0)
    place = layout_.place(b, node)[a];
  else if (real == block.low[a])
    place = layout_.cuboid(b).low[a];
  else if (real == block.high[a])
    place = layout_.cuboid(b).high[a];
  else
    return std::nullopt;
  return ((to & 1) != 0 ? -1 : 1) * (place - frame.translation[a]);
}

std::int64_t IntegerFrames::value_of_class(std::int32_t corner_class, int axis) const {
  const auto& corners = corners_[static_cast<std::size_t>(corner_class)];
  std::optional<std::int64_t> known;
  for (const Corner& corner : corners) {
    const auto found = value(corner, axis);
    if (!found) continue;
    if (known && *known != *found) fail("A corner of the map has two integer coordinates.", corner.tet);
    known = found;
  }
  if (!known) fail("A corner of the map that must be integer lies on no side of its blocks.", corners.at(0).tet);
  return *known;
}

// For the pinned corner along an axis in which the map may slide: where it lies between the sides of its block.
std::int64_t IntegerFrames::interpolated(std::int32_t corner_class, int axis) const {
  const auto& corners = corners_[static_cast<std::size_t>(corner_class)];
  for (const Corner& corner : corners)
    if (value(corner, axis)) return value_of_class(corner_class, axis);
  const Corner& corner = corners.at(0);
  const Frame& frame = frames_[static_cast<std::size_t>(corner.tet)];
  const Label to = octahedral::image(frame.rotation, static_cast<Label>(2 * axis));
  const std::size_t a = to / 2;
  const std::int32_t b = cells_.block_of_tet(corner.tet);
  const auto& block = cells_.complex.blocks[static_cast<std::size_t>(b)];
  const IntegerBox& cuboid = layout_.cuboid(b);
  const double part =
      static_cast<double>(grid_place(corner)[a] - block.low[a]) / static_cast<double>(block.high[a] - block.low[a]);
  const std::int64_t place = cuboid.low[a] + std::llround(part * static_cast<double>(cuboid.high[a] - cuboid.low[a]));
  return ((to & 1) != 0 ? -1 : 1) * (place - frame.translation[a]);
}

std::vector<double> IntegerFrames::unknowns() {
  std::vector<Integer3> origin(space_.pins.size());
  for (std::size_t p = 0; p < origin.size(); ++p)
    for (int k = 0; k < 3; ++k) origin[p][static_cast<std::size_t>(k)] = interpolated(space_.pins[p], k);
  const auto component = [&](std::int32_t t) { return static_cast<std::size_t>(space_.cut.components[input_tet(t)]); };
  std::vector<double> y(space_.num_integers, 0);
  for (std::size_t i = 0; i < y.size(); ++i) {
    std::int64_t sum = 0;
    for (const auto& [source, c] : space_.definitions[space_.num_reals + i]) {
      if (source >= 0) {
        const auto axis = static_cast<std::size_t>(source % 3);
        const std::int32_t t = corners_[static_cast<std::size_t>(source / 3)].at(0).tet;
        sum += c * (value_of_class(source / 3, source % 3) - origin[component(t)][axis]);
        continue;
      }
      const auto patch = static_cast<std::size_t>(~source) / 3;
      const auto axis = static_cast<std::size_t>(~source) % 3;
      const HalfFaceId face = space_.cut.patch_face[patch];
      const Integer3& o = origin[static_cast<std::size_t>(space_.cut.components[face.tet().index()])];
      require(translations_[patch].has_value(), "A piece of the cut has no face.");
      sum += c * ((*translations_[patch])[axis] + rotate(space_.cut.rotation(face), o)[axis] - o[axis]);
    }
    y[i] = static_cast<double>(sum);
  }
  return y;
}

}  // namespace hexfield::quantize
