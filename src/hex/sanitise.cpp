#include "hexfield/hex/sanitise.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "fixed_map.hpp"
#include "hexfield/base/parallel.hpp"
#include "untangle_images.hpp"

namespace hexfield {
namespace {

using hex::Fixed3;
using hex::Lattice3;
using hex::LatticeTransition;

constexpr std::size_t grain = 512;

// A coordinate of a corner that must be an integer.
struct Pin {
  std::size_t axis;
  std::int32_t value;
};

double angle_at_edge(const std::array<Vec3, 4>& x, int i, int j) {
  std::array<int, 2> other{};
  std::size_t n = 0;
  for (int k = 0; k < 4; ++k)
    if (k != i && k != j) other[n++] = k;
  const auto at = [&](int k) -> const Vec3& { return x[static_cast<std::size_t>(k)]; };
  const Vec3 axis = (at(j) - at(i)).normalized();
  const Vec3 a = at(other[0]) - at(i);
  const Vec3 b = at(other[1]) - at(i);
  return std::atan2(std::abs(axis.dot(a.cross(b))), a.dot(b) - axis.dot(a) * axis.dot(b));
}

// Everything the vertices share while they are made exact.
class Sanitiser {
 public:
  /// Deviations above the tolerance are told, those above the limit are not followed.
  Sanitiser(const TetMesh& mesh, const Features& features, const IntegerGridMap& map, double tolerance, double limit)
      : mesh_(mesh),
        features_(features),
        map_(map),
        tolerance_(tolerance),
        limit_(limit),
        star_(hex::vertex_tets(mesh)),
        broken_(mesh.num_tets(), 0),
        pinned_(mesh.num_vertices(), 0) {}

  SanitisedMap run();
  HealedMap heal();

 private:
  struct Found {
    std::vector<Violation> violations;
    double largest_move = 0;
    std::vector<TetId> broken;
  };

  bool tolerant() const { return limit_ > tolerance_; }
  bool read_coordinates();
  void sanitise_vertices();
  bool turns_around(TetId t, VertexId a, VertexId b) const;
  Vec3 reference(VertexId v, std::size_t seed, const std::vector<std::size_t>& fan,
                 const std::vector<LatticeTransition>& to_chart) const;
  const Vec3& uvw(TetId t, VertexId v) const {
    return map_.uvw[t.index()][static_cast<std::size_t>(mesh_.local_index(t, v))];
  }
  void round_transitions();
  void sanitise_vertex(VertexId v, Found& found);
  void sanitise_fan(VertexId v, std::size_t seed, std::vector<int>& chart, std::vector<LatticeTransition>& to_chart,
                    Found& found);
  std::vector<std::size_t> walk_fan(VertexId v, std::size_t seed, std::vector<int>& chart,
                                    std::vector<LatticeTransition>& to_chart) const;
  void pin_face(HalfFaceId h, std::vector<Pin>& pins, Found& found) const;
  void pin_edge(TetId t, VertexId a, VertexId b, std::vector<Pin>& pins, Found& found) const;
  std::optional<std::int32_t> lattice_value(double x, VertexId v, const char* what, Found& found) const;
  void add_edge_pins(VertexId v, const std::vector<std::size_t>& fan,
                     const std::function<void(std::size_t, const std::vector<Pin>&)>& apply, Found& found) const;
  void check_positive();

  const TetMesh& mesh_;
  const Features& features_;
  const IntegerGridMap& map_;
  double tolerance_, limit_;
  hex::VertexTets star_;
  std::vector<char> broken_;          // per tet: an alignment or transition that cannot be followed
  std::vector<char> not_positive_;    // per tet, as the map was given
  std::vector<std::uint8_t> pinned_;  // per vertex: mask of axes in the chart of its first tet
  int shift_ = 0;
  std::vector<std::array<LatticeTransition, 4>> transitions_;
  std::vector<std::array<Fixed3, 4>> corners_;
  SanitisedMap result_;
};

void Sanitiser::round_transitions() {
  transitions_.resize(mesh_.num_tets());
  std::vector<double> deviation(mesh_.num_tets(), 0);
  parallel_for(mesh_.num_tets(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t)
      for (int i = 0; i < 4; ++i) {
        const HalfFaceId h(TetId(t), i);
        if (mesh_.is_boundary(h)) continue;
        LatticeTransition& transition = transitions_[t][static_cast<std::size_t>(i)];
        transition.rotation = map_.rotation(h);
        const TetId other = mesh_.opposite_half_face(h).tet();
        Vec3 mean = Vec3::Zero();
        std::array<Vec3, 3> each;
        for (std::size_t k = 0; k < 3; ++k) {
          const VertexId v = mesh_.face_vertices(h)[k];
          each[k] = uvw(other, v) - octahedral::apply(transition.rotation, uvw(TetId(t), v));
          mean += each[k] / 3;
        }
        for (int a = 0; a < 3; ++a) {
          const double rounded = std::round(mean[a]);
          transition.translation[static_cast<std::size_t>(a)] = static_cast<std::int32_t>(rounded);
          for (const Vec3& e : each) deviation[t] = std::max(deviation[t], std::abs(e[a] - rounded));
        }
      }
  });
  for (std::size_t t = 0; t < mesh_.num_tets(); ++t) {
    if (!(deviation[t] <= limit_)) broken_[t] = 1;
    if (!(deviation[t] <= tolerance_))
      result_.violations.push_back(
          {fmt::format("Tet {}: a transition is {:.3g} away from an integer one.", t, deviation[t]),
           {static_cast<std::int64_t>(t)},
           {centroid(mesh_, TetId(t))}});
  }
}

// The tets of the fan of star member `seed`, with the transition from the seed's chart to each of theirs.
std::vector<std::size_t> Sanitiser::walk_fan(VertexId v, std::size_t seed, std::vector<int>& chart,
                                             std::vector<LatticeTransition>& to_chart) const {
  const TetId* tets = star_.begin(v);
  std::vector<std::size_t> fan{seed};
  chart[seed] = 1;
  to_chart[seed] = {};
  for (std::size_t k = 0; k < fan.size(); ++k) {
    const TetId t = tets[fan[k]];
    for (int i = 0; i < 4; ++i) {
      const HalfFaceId h(t, i);
      if (mesh_.vertices(t)[static_cast<std::size_t>(i)] == v || mesh_.is_boundary(h)) continue;
      const TetId other = mesh_.opposite_half_face(h).tet();
      const auto next = static_cast<std::size_t>(std::lower_bound(tets, star_.end(v), other) - tets);
      if (chart[next] != 0) continue;
      chart[next] = 1;
      const LatticeTransition& step = transitions_[t.index()][static_cast<std::size_t>(i)];
      to_chart[next].rotation = octahedral::product(step.rotation, to_chart[fan[k]].rotation);
      to_chart[next].translation = step.point(to_chart[fan[k]].translation);
      fan.push_back(next);
    }
  }
  return fan;
}

std::optional<std::int32_t> Sanitiser::lattice_value(double x, VertexId v, const char* what, Found& found) const {
  const double rounded = std::round(x);
  const bool close = std::abs(x - rounded) <= limit_;
  if (std::abs(x - rounded) <= tolerance_) return static_cast<std::int32_t>(rounded);
  found.violations.push_back(
      {fmt::format("Vertex {}: {} lies at coordinate {:.6g}, not on the lattice.", v.value, what, x),
       {v.value},
       {mesh_.point(v)}});
  if (close) return static_cast<std::int32_t>(rounded);
  found.broken.insert(found.broken.end(), star_.begin(v), star_.end(v));
  return std::nullopt;
}

void Sanitiser::pin_face(HalfFaceId h, std::vector<Pin>& pins, Found& found) const {
  const auto v = mesh_.face_vertices(h);
  const Vec3& a = uvw(h.tet(), v[0]);
  const Vec3& b = uvw(h.tet(), v[1]);
  const Vec3& c = uvw(h.tet(), v[2]);
  Eigen::Index axis = 0;
  (b - a).cross(c - a).cwiseAbs().maxCoeff(&axis);
  const double mean = (a[axis] + b[axis] + c[axis]) / 3;
  const Vec3 spread(a[axis] - mean, b[axis] - mean, c[axis] - mean);
  const char* what = mesh_.is_boundary(h) ? "a boundary face" : "a feature face";
  if (spread.cwiseAbs().maxCoeff() > tolerance_) {
    found.violations.push_back({fmt::format("Tet {}: {} is not mapped onto a coordinate plane (spread {:.3g}).",
                                            h.tet().value, what, spread.cwiseAbs().maxCoeff()),
                                {h.tet().value},
                                {(mesh_.point(v[0]) + mesh_.point(v[1]) + mesh_.point(v[2])) / 3}});
    if (!(spread.cwiseAbs().maxCoeff() <= limit_)) {
      found.broken.push_back(h.tet());
      return;
    }
  }
  if (const auto value = lattice_value(mean, v[0], what, found))
    pins.push_back({static_cast<std::size_t>(axis), *value});
}

void Sanitiser::pin_edge(TetId t, VertexId a, VertexId b, std::vector<Pin>& pins, Found& found) const {
  const Vec3& x = uvw(t, a);
  const Vec3& y = uvw(t, b);
  Eigen::Index along = 0;
  (y - x).cwiseAbs().maxCoeff(&along);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (axis == along) continue;
    if (std::abs(x[axis] - y[axis]) > tolerance_) {
      found.violations.push_back(
          {fmt::format("Edge ({}, {}): a feature or singular edge is not mapped onto a coordinate line.", a.value,
                       b.value),
           {a.value, b.value},
           {mesh_.point(a), mesh_.point(b)}});
      if (!(std::abs(x[axis] - y[axis]) <= limit_)) {
        found.broken.push_back(t);
        return;
      }
    }
    if (const auto value = lattice_value((x[axis] + y[axis]) / 2, a, "a feature or singular edge", found))
      pins.push_back({static_cast<std::size_t>(axis), *value});
  }
}

// Feature and singular edges at v: `apply(star member, pins in its chart)`.
void Sanitiser::add_edge_pins(VertexId v, const std::vector<std::size_t>& fan,
                              const std::function<void(std::size_t, const std::vector<Pin>&)>& apply,
                              Found& found) const {
  struct Spoke {
    VertexId end;
    double angle;
    std::size_t member;
    bool boundary;
  };
  std::vector<Spoke> spokes;
  const TetId* tets = star_.begin(v);
  for (std::size_t member : fan) {
    const TetId t = tets[member];
    const int i = mesh_.local_index(t, v);
    for (int j = 0; j < 4; ++j) {
      if (j == i) continue;
      bool boundary = false;
      for (int f = 0; f < 4; ++f) boundary = boundary || (f != i && f != j && mesh_.is_boundary(HalfFaceId(t, f)));
      spokes.push_back(
          {mesh_.vertices(t)[static_cast<std::size_t>(j)], angle_at_edge(map_.uvw[t.index()], i, j), member, boundary});
    }
  }
  std::stable_sort(spokes.begin(), spokes.end(), [](const Spoke& a, const Spoke& b) { return a.end < b.end; });
  for (std::size_t k = 0; k < spokes.size();) {
    double angle = 0;
    bool boundary = false;
    bool clear = true;
    std::size_t next = k;
    for (; next < spokes.size() && spokes[next].end == spokes[k].end; ++next) {
      angle += spokes[next].angle;
      boundary = boundary || spokes[next].boundary;
      clear = clear && not_positive_[tets[spokes[next].member].index()] == 0;
    }
    // Angles say nothing where a tet is folded over.
    const bool singular = clear ? std::lround(angle * 2 / M_PI) != (boundary ? 2 : 4)
                                : turns_around(tets[spokes[k].member], v, spokes[k].end);
    if (singular || features_.edges.contains(edge_key(v, spokes[k].end))) {
      std::vector<Pin> pins;
      pin_edge(tets[spokes[k].member], v, spokes[k].end, pins, found);
      apply(spokes[k].member, pins);
    }
    k = next;
  }
}

void Sanitiser::sanitise_fan(VertexId v, std::size_t seed, std::vector<int>& chart,
                             std::vector<LatticeTransition>& to_chart, Found& found) {
  const TetId* tets = star_.begin(v);
  const std::vector<std::size_t> fan = walk_fan(v, seed, chart, to_chart);
  std::array<std::optional<std::int32_t>, 3> pinned;
  bool conflict = false;
  // A pin of another chart, said in the seed's: coordinate `axis` there is +-(coordinate `from` here) + translation.
  const auto apply = [&](std::size_t member, const std::vector<Pin>& pins) {
    const LatticeTransition& to = to_chart[member];
    const octahedral::Rotation back = octahedral::inverse(to.rotation);
    for (const Pin& pin : pins) {
      const octahedral::Label from = octahedral::image(back, static_cast<octahedral::Label>(2 * pin.axis));
      const std::int32_t offset = pin.value - to.translation[pin.axis];
      const std::int32_t value = (from & 1) != 0 ? -offset : offset;
      auto& slot = pinned[static_cast<std::size_t>(from / 2)];
      conflict = conflict || (slot && *slot != value);
      slot = value;
    }
  };
  for (std::size_t member : fan)
    for (int i = 0; i < 4; ++i) {
      const HalfFaceId h(tets[member], i);
      if (mesh_.vertices(tets[member])[static_cast<std::size_t>(i)] == v) continue;
      if (!mesh_.is_boundary(h) && (features_.faces.empty() || !features_.faces.contains(mesh_.key(h)))) continue;
      std::vector<Pin> pins;
      pin_face(h, pins, found);
      apply(member, pins);
    }
  add_edge_pins(v, fan, apply, found);
  const Vec3 here = reference(v, seed, fan, to_chart);
  if (features_.points.contains(v))
    for (std::size_t a = 0; a < 3; ++a)
      if (const auto value = lattice_value(here[static_cast<Eigen::Index>(a)], v, "a feature vertex", found))
        apply(seed, {{a, *value}});
  if (conflict) {
    found.violations.push_back(
        {fmt::format("Vertex {}: its boundary and features ask for different lattice values.", v.value),
         {v.value},
         {mesh_.point(v)}});
    for (std::size_t member : fan) found.broken.push_back(tets[member]);
  }
  for (std::size_t a = 0; a < 3; ++a)
    if (pinned[a] || seed != 0) pinned_[v.index()] = static_cast<std::uint8_t>(pinned_[v.index()] | 1U << a);
  Fixed3 place{};
  for (std::size_t a = 0; a < 3; ++a)
    place[a] = pinned[a] ? *pinned[a] * (std::int64_t{1} << shift_)
                         : std::llround(std::ldexp(here[static_cast<Eigen::Index>(a)], shift_));
  for (std::size_t member : fan) {
    const TetId t = tets[member];
    const auto i = static_cast<std::size_t>(mesh_.local_index(t, v));
    Fixed3 image = hex::rotate(to_chart[member].rotation, place);
    for (std::size_t a = 0; a < 3; ++a) {
      image[a] += to_chart[member].translation[a] * (std::int64_t{1} << shift_);
      result_.map.uvw[t.index()][i][static_cast<Eigen::Index>(a)] = std::ldexp(static_cast<double>(image[a]), -shift_);
    }
    corners_[t.index()][i] = image;
    const double move = (result_.map.uvw[t.index()][i] - map_.uvw[t.index()][i]).cwiseAbs().maxCoeff();
    found.largest_move = std::max(found.largest_move, move);
  }
}

void Sanitiser::sanitise_vertex(VertexId v, Found& found) {
  const auto size = static_cast<std::size_t>(star_.end(v) - star_.begin(v));
  std::vector<int> chart(size, 0);
  std::vector<LatticeTransition> to_chart(size);
  for (std::size_t seed = 0; seed < size; ++seed)
    if (chart[seed] == 0) sanitise_fan(v, seed, chart, to_chart, found);
}

void Sanitiser::check_positive() {
  not_positive_.assign(mesh_.num_tets(), 0);
  parallel_for(mesh_.num_tets(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const auto& c = corners_[t];
      not_positive_[t] = hex::orient3d(c[0], c[1], c[2], c[3]) <= 0;
    }
  });
  for (std::size_t t = 0; t < mesh_.num_tets(); ++t)
    if (not_positive_[t] != 0)
      result_.violations.push_back({fmt::format("Tet {} is inverted or flat in the integer-grid map.", t),
                                    {static_cast<std::int64_t>(t)},
                                    {centroid(mesh_, TetId(t))}});
}

// Whether the charts turn on a way around the inner edge (a, b) of tet t.
bool Sanitiser::turns_around(TetId t, VertexId a, VertexId b) const {
  octahedral::Rotation turn = octahedral::identity;
  TetId at = t;
  int leave = -1;
  for (int i = 0; i < 4; ++i) {
    const VertexId v = mesh_.vertices(t)[static_cast<std::size_t>(i)];
    if (v != a && v != b) leave = i;
  }
  do {
    const HalfFaceId h(at, leave);
    const HalfFaceId o = mesh_.opposite_half_face(h);
    if (!o.valid()) return false;
    turn = octahedral::product(map_.rotation(h), turn);
    at = o.tet();
    for (int i = 0; i < 4; ++i) {
      const VertexId v = mesh_.vertices(at)[static_cast<std::size_t>(i)];
      if (i != o.local() && v != a && v != b) leave = i;
    }
  } while (at != t);
  return turn != octahedral::identity;
}

// Where v lies in the chart of the fan's first tet: there, or the median of what all its tets say.
Vec3 Sanitiser::reference(VertexId v, std::size_t seed, const std::vector<std::size_t>& fan,
                          const std::vector<LatticeTransition>& to_chart) const {
  const TetId* tets = star_.begin(v);
  if (!tolerant()) return uvw(tets[seed], v);
  std::array<std::vector<double>, 3> values;
  for (std::size_t member : fan) {
    const LatticeTransition& to = to_chart[member];
    const Vec3 shift(to.translation[0], to.translation[1], to.translation[2]);
    const Vec3 x = octahedral::apply(octahedral::inverse(to.rotation), uvw(tets[member], v) - shift);
    for (std::size_t a = 0; a < 3; ++a) values[a].push_back(x[static_cast<Eigen::Index>(a)]);
  }
  Vec3 median;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto middle = values[a].begin() + static_cast<std::ptrdiff_t>(values[a].size() / 2);
    std::nth_element(values[a].begin(), middle, values[a].end());
    median[static_cast<Eigen::Index>(a)] = *middle;
  }
  return median;
}

bool Sanitiser::read_coordinates() {
  double largest = 0;
  for (std::size_t t = 0; t < mesh_.num_tets(); ++t)
    for (const Vec3& p : map_.uvw[t]) {
      if (!p.allFinite() || !(p.cwiseAbs().maxCoeff() < 0x1p28)) {
        result_.violations.push_back(
            {fmt::format("Tet {}: a coordinate of the integer-grid map is not finite or too large.", t),
             {static_cast<std::int64_t>(t)},
             {centroid(mesh_, TetId(t))}});
        return false;
      }
      largest = std::max(largest, p.cwiseAbs().maxCoeff());
    }
  shift_ = hex::fixed_shift(std::ceil(largest + limit_));
  corners_.resize(mesh_.num_tets());
  for (std::size_t t = 0; t < mesh_.num_tets(); ++t)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t a = 0; a < 3; ++a)
        corners_[t][i][a] = std::llround(std::ldexp(map_.uvw[t][i][static_cast<Eigen::Index>(a)], shift_));
  return true;
}

void Sanitiser::sanitise_vertices() {
  result_.map = map_;
  const std::size_t n = mesh_.num_vertices();
  std::vector<Found> found((n + grain - 1) / grain);
  parallel_for(n, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) sanitise_vertex(VertexId(v), found[begin / grain]);
  });
  for (Found& f : found) {
    result_.largest_move = std::max(result_.largest_move, f.largest_move);
    std::move(f.violations.begin(), f.violations.end(), std::back_inserter(result_.violations));
    for (TetId t : f.broken) broken_[t.index()] = 1;
  }
}

SanitisedMap Sanitiser::run() {
  if (!read_coordinates()) return std::move(result_);
  check_positive();  // first, because a fold makes everything near it look wrong as well
  if (result_.violations.empty()) round_transitions();
  if (!result_.violations.empty()) return std::move(result_);
  sanitise_vertices();
  if (!(result_.largest_move <= tolerance_))
    result_.violations.push_back(
        {fmt::format("Making the integer-grid map exact moves a corner by {:.3g}.", result_.largest_move), {}, {}});
  check_positive();
  return std::move(result_);
}

HealedMap Sanitiser::heal() {
  if (!read_coordinates())
    throw Error(ExitCode::bad_hex_mesh, result_.violations[0].sentence, result_.violations[0].ids,
                result_.violations[0].places);
  check_positive();
  round_transitions();
  sanitise_vertices();
  HealedMap healed;
  healed.defects = std::move(result_.violations);
  hex::FixedMap fixed{shift_, std::move(corners_), std::move(transitions_)};
  healed.moved = hex::untangle_images(mesh_, fixed, star_, pinned_);
  healed.map = std::move(result_.map);
  healed.tets.assign(mesh_.num_tets(), HealedMap::Tet::positive);
  for (std::size_t t = 0; t < mesh_.num_tets(); ++t) {
    const auto& c = fixed.corners[t];
    const int sign = hex::orient3d(c[0], c[1], c[2], c[3]);
    if (sign < 0 || broken_[t] != 0)
      healed.tets[t] = HealedMap::Tet::unusable;
    else if (sign == 0)
      healed.tets[t] = HealedMap::Tet::flat;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t a = 0; a < 3; ++a)
        healed.map.uvw[t][i][static_cast<Eigen::Index>(a)] =
            std::ldexp(static_cast<double>(fixed.corners[t][i][a]), -shift_);
  }
  return healed;
}

}  // namespace

SanitisedMap sanitise_igm(const TetMesh& mesh, const Features& features, const IntegerGridMap& map, double tolerance) {
  return Sanitiser(mesh, features, map, tolerance, tolerance).run();
}

HealedMap heal_igm(const TetMesh& mesh, const Features& features, const IntegerGridMap& map, double tolerance,
                   double limit) {
  return Sanitiser(mesh, features, map, tolerance, limit).heal();
}

}  // namespace hexfield
