#include "hexfield/map/conforming_space.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hexfield/base/error.hpp"
#include "integer_lattice.hpp"

namespace hexfield {
namespace {

using octahedral::Label;
using octahedral::Rotation;

/// x = sign * root + offset, offset a form over the translations of the cut patches (3 p + k).
struct Affine {
  std::int32_t root;
  int sign;
  LinearForm offset;
};

class AffineUnionFind {
 public:
  explicit AffineUnionFind(std::size_t n) : parent_(n), size_(n, 1) {
    for (std::size_t x = 0; x < n; ++x) parent_[x] = {static_cast<std::int32_t>(x), 1, {}};
  }

  const Affine& find(std::int32_t x) {
    Affine& up = parent_[static_cast<std::size_t>(x)];
    if (up.root == x || parent_[static_cast<std::size_t>(up.root)].root == up.root) return up;
    const Affine& top = find(up.root);
    up.offset = add(up.offset, up.sign, top.offset);
    up.sign *= top.sign;
    up.root = top.root;
    return up;
  }

  /// Adds x = sign * y + offset. Where both have one root already, `relation` gets what remains:
  /// (coefficient of the root, form over translations) = 0.
  void unite(std::int32_t x, int sign, std::int32_t y, const LinearForm& offset,
             std::vector<std::pair<std::pair<std::int32_t, int>, LinearForm>>& relations) {
    const Affine a = find(x);
    const Affine b = find(y);
    const int turn = sign * b.sign;
    // a.sign ra + a.offset = turn rb + sign b.offset + offset
    const LinearForm rest = add(add(offset, sign, b.offset), -1, a.offset);
    if (a.root == b.root) {
      const int coefficient = a.sign - turn;
      if (coefficient != 0 || !rest.empty()) relations.push_back({{a.root, coefficient}, scaled(rest, -1)});
      return;
    }
    auto ra = static_cast<std::size_t>(a.root);
    auto rb = static_cast<std::size_t>(b.root);
    if (size_[ra] <= size_[rb]) {
      parent_[ra] = {b.root, a.sign * turn, scaled(rest, a.sign)};
      size_[rb] += size_[ra];
    } else {
      parent_[rb] = {a.root, a.sign * turn, scaled(rest, -turn)};
      size_[ra] += size_[rb];
    }
  }

 private:
  std::vector<Affine> parent_;
  std::vector<std::int32_t> size_;
};

class Builder {
 public:
  Builder(const TetMesh& mesh, const Alignments& alignments, ConformingSpace& space)
      : mesh_(mesh),
        alignments_(alignments),
        space_(space),
        union_find_(space.num_coordinates()),
        integral_(space.num_coordinates(), 0),
        rank_(mesh.num_vertices(), 0) {}

  void build() {
    align_faces();
    align_edges();
    for (VertexId v : alignments_.points) rank_[v.index()] = 3;
    mark_points();
    join_cut();
    space_.pins = choose_pins();
    eliminate();
    write_rows();
    write_definitions();
    find_collapsed();
  }

 private:
  std::int32_t coordinate(TetId t, VertexId v, int axis) const {
    return 3 * space_.cut.classes[t.index()][static_cast<std::size_t>(mesh_.local_index(t, v))] + axis;
  }
  // The axis in the combed chart.
  int combed(TetId t, int axis) const {
    const Rotation g = space_.cut.gauges[t.index()];
    return octahedral::axis(octahedral::image(octahedral::inverse(g), static_cast<Label>(2 * axis)));
  }
  void join_equal(std::int32_t x, std::int32_t y) {
    integral_[static_cast<std::size_t>(x)] = integral_[static_cast<std::size_t>(y)] = 1;
    union_find_.unite(x, 1, y, {}, relations_);
  }
  void raise_rank(VertexId v, char rank) { rank_[v.index()] = std::max(rank_[v.index()], rank); }

  void align_faces() {
    for (const FaceAlignment& f : alignments_.faces) {
      const int axis = combed(f.face.tet(), f.axis);
      const auto v = mesh_.face_vertices(f.face);
      for (VertexId w : v) raise_rank(w, 1);
      for (std::size_t k = 1; k < 3; ++k)
        join_equal(coordinate(f.face.tet(), v[0], axis), coordinate(f.face.tet(), v[k], axis));
    }
  }
  void align_edges() {
    for (const EdgeAlignment& e : alignments_.edges) {
      const int axis = combed(e.tet, e.axis);
      for (VertexId w : e.edge) raise_rank(w, 2);
      for (int k = 0; k < 3; ++k)
        if (k != axis) join_equal(coordinate(e.tet, e.edge[0], k), coordinate(e.tet, e.edge[1], k));
    }
  }
  void mark_points() {
    for (std::size_t c = 0; c < space_.cut.num_classes(); ++c)
      if (rank_[space_.cut.class_vertex[c].index()] == 3)
        for (std::size_t k = 0; k < 3; ++k) integral_[3 * c + k] = 1;
  }
  void join_cut() {
    for (std::size_t i = 0; i < mesh_.num_tets(); ++i)
      for (int f = 0; f < 4; ++f) {
        const HalfFaceId h(TetId(i), f);
        const std::int32_t p = space_.cut.patch(h);
        if (p <= 0) continue;
        const HalfFaceId o = mesh_.opposite_half_face(h);
        for (VertexId v : mesh_.face_vertices(h))
          for (int k = 0; k < 3; ++k) {
            const Label to = octahedral::image(space_.cut.rotation(h), static_cast<Label>(2 * k));
            const std::int32_t translation = 3 * (p - 1) + octahedral::axis(to);
            union_find_.unite(coordinate(o.tet(), v, octahedral::axis(to)), (to & 1) != 0 ? -1 : 1,
                              coordinate(h.tet(), v, k), {{translation, 1}}, relations_);
          }
      }
  }
  // The pinned corner class of every component.
  std::vector<std::int32_t> choose_pins() const {
    std::vector<std::int32_t> pins(static_cast<std::size_t>(space_.cut.num_components), -1);
    std::vector<int> best(pins.size(), -1);
    for (std::size_t i = 0; i < mesh_.num_tets(); ++i)
      for (std::size_t k = 0; k < 4; ++k) {
        const auto component = static_cast<std::size_t>(space_.cut.components[i]);
        const int rank = rank_[mesh_.tets[i][k].index()];
        if (rank <= best[component]) continue;
        best[component] = rank;
        pins[component] = space_.cut.classes[i][k];
      }
    return pins;
  }

  LinearForm form_of(std::int32_t x) {
    const Affine& a = union_find_.find(x);
    return add(a.offset, a.sign, {{root_variable_[static_cast<std::size_t>(a.root)], 1}});
  }

  void eliminate() {
    for (std::size_t t = 0; t < 3 * space_.cut.num_patches; ++t) lattice_.add_variable(0);
    root_variable_.assign(space_.num_coordinates(), -1);
    auto make_variable = [&](std::int32_t root) {
      auto& variable = root_variable_[static_cast<std::size_t>(root)];
      if (variable < 0) variable = lattice_.add_variable(1), variable_root_.push_back(root);
    };
    for (std::size_t x = 0; x < integral_.size(); ++x)
      if (integral_[x] != 0) make_variable(union_find_.find(static_cast<std::int32_t>(x)).root);
    for (const auto& relation : relations_)
      if (relation.first.second != 0) make_variable(relation.first.first);
    for (std::int32_t pin : space_.pins)
      for (int k = 0; k < 3; ++k) make_variable(union_find_.find(3 * pin + k).root);
    for (const auto& [root, form] : relations_) {
      LinearForm whole = form;
      if (root.second != 0) whole = add(form, root.second, {{root_variable_[static_cast<std::size_t>(root.first)], 1}});
      lattice_.add_relation(whole);
    }
    for (std::int32_t pin : space_.pins)
      for (int k = 0; k < 3; ++k) lattice_.add_relation(form_of(3 * pin + k));
  }

  void write_rows() {
    std::vector<std::int32_t> real_column(space_.num_coordinates(), -1);
    for (std::size_t x = 0; x < space_.num_coordinates(); ++x) {
      const std::int32_t root = union_find_.find(static_cast<std::int32_t>(x)).root;
      auto& column = real_column[static_cast<std::size_t>(root)];
      if (root_variable_[static_cast<std::size_t>(root)] < 0 && column < 0)
        column = static_cast<std::int32_t>(space_.num_reals++);
    }
    std::vector<std::int32_t> integer_column(lattice_.num_variables(), -1);
    for (std::size_t v = 0; v < lattice_.num_variables(); ++v)
      if (lattice_.in_basis(static_cast<std::int32_t>(v)))
        integer_column[v] = static_cast<std::int32_t>(space_.num_reals + space_.num_integers++);
    space_.row_start.assign(1, 0);
    space_.integral.assign(space_.num_coordinates(), 0);
    for (std::size_t x = 0; x < space_.num_coordinates(); ++x) {
      const Affine& a = union_find_.find(static_cast<std::int32_t>(x));
      const auto root = static_cast<std::size_t>(a.root);
      LinearForm integer_part = a.offset;
      if (root_variable_[root] < 0) {
        space_.columns.push_back(real_column[root]);
        space_.coefficients.push_back(a.sign);
      } else {
        integer_part = add(integer_part, a.sign, {{root_variable_[root], 1}});
        space_.integral[x] = 1;
      }
      for (const auto& [v, c] : lattice_.reduce(integer_part)) {
        require(std::abs(c) < 1000000, "A coefficient of the conforming space is not small.");
        space_.columns.push_back(integer_column[static_cast<std::size_t>(v)]);
        space_.coefficients.push_back(static_cast<std::int32_t>(c));
      }
      space_.row_start.push_back(space_.columns.size());
    }
  }

  void write_definitions() {
    space_.definitions.resize(space_.num_unknowns());
    for (std::size_t x = 0; x < space_.num_coordinates(); ++x) {
      const auto coordinate_id = static_cast<std::int32_t>(x);
      if (union_find_.find(coordinate_id).root != coordinate_id || space_.integral[x] != 0) continue;
      space_.definitions[static_cast<std::size_t>(space_.columns[space_.row_start[x]])] = {{coordinate_id, 1}};
    }
    const auto first_root = static_cast<std::int32_t>(3 * space_.cut.num_patches);
    std::size_t column = space_.num_reals;
    for (std::size_t v = 0; v < lattice_.num_variables(); ++v) {
      if (!lattice_.in_basis(static_cast<std::int32_t>(v))) continue;
      for (const auto& [w, c] : lattice_.definition(static_cast<std::int32_t>(v)))
        space_.definitions[column].emplace_back(
            w < first_root ? ~w : variable_root_[static_cast<std::size_t>(w - first_root)],
            static_cast<std::int32_t>(c));
      ++column;
    }
  }

  bool same_row(std::size_t x, std::size_t y) const {
    const std::size_t n = space_.row_start[x + 1] - space_.row_start[x];
    if (n != space_.row_start[y + 1] - space_.row_start[y]) return false;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = space_.row_start[x] + k;
      const std::size_t j = space_.row_start[y] + k;
      if (space_.columns[i] != space_.columns[j] || space_.coefficients[i] != space_.coefficients[j]) return false;
    }
    return true;
  }
  void find_collapsed() {
    for (std::size_t i = 0; i < mesh_.num_tets(); ++i) {
      std::array<std::size_t, 4> c;
      for (std::size_t k = 0; k < 4; ++k) c[k] = static_cast<std::size_t>(space_.cut.classes[i][k]);
      bool flat = false;
      for (std::size_t k = 0; k < 3; ++k)
        flat = flat || (same_row(3 * c[0] + k, 3 * c[1] + k) && same_row(3 * c[0] + k, 3 * c[2] + k) &&
                        same_row(3 * c[0] + k, 3 * c[3] + k));
      for (const auto& e : tet_edge_vertices) {
        const std::size_t a = c[static_cast<std::size_t>(e[0])];
        const std::size_t b = c[static_cast<std::size_t>(e[1])];
        flat = flat || (same_row(3 * a, 3 * b) && same_row(3 * a + 1, 3 * b + 1) && same_row(3 * a + 2, 3 * b + 2));
      }
      if (flat) space_.collapsed.push_back(TetId(i));
    }
  }

  const TetMesh& mesh_;
  const Alignments& alignments_;
  ConformingSpace& space_;
  AffineUnionFind union_find_;
  std::vector<char> integral_;
  std::vector<char> rank_;  // per vertex: 3 critical point, 2 on a curve, 1 on a surface
  std::vector<std::pair<std::pair<std::int32_t, int>, LinearForm>> relations_;
  IntegerLattice lattice_;
  std::vector<std::int32_t> root_variable_;
  std::vector<std::int32_t> variable_root_;
};

// Coordinates of `map` in combed charts whose transitions off the cut are the identity, per corner class.
std::vector<double> combed_coordinates(const TetMesh& mesh, const CutGraph& cut, const CornerMap& map) {
  std::vector<double> x(3 * cut.num_classes(), 0);
  std::vector<Vec3> shift(mesh.num_tets(), Vec3::Zero());
  std::vector<char> reached(mesh.num_tets(), 0);
  auto at = [&](TetId t, VertexId v) {
    return octahedral::apply(octahedral::inverse(cut.gauges[t.index()]),
                             map.uvw[t.index()][static_cast<std::size_t>(mesh.local_index(t, v))]);
  };
  std::vector<TetId> queue;
  for (std::size_t seed = 0; seed < mesh.num_tets(); ++seed) {
    if (reached[seed] != 0) continue;
    reached[seed] = 1;
    queue.assign(1, TetId(seed));
    for (std::size_t q = 0; q < queue.size(); ++q) {
      const TetId t = queue[q];
      for (int f = 0; f < 4; ++f) {
        const HalfFaceId h(t, f);
        const HalfFaceId o = mesh.opposite_half_face(h);
        if (!o.valid() || cut.patch(h) != 0 || reached[o.tet().index()] != 0) continue;
        Vec3 sum = Vec3::Zero();
        for (VertexId v : mesh.face_vertices(h)) sum += at(t, v) + shift[t.index()] - at(o.tet(), v);
        shift[o.tet().index()] = sum / 3;
        reached[o.tet().index()] = 1;
        queue.push_back(o.tet());
      }
    }
  }
  std::vector<int> count(cut.num_classes(), 0);
  for (std::size_t i = 0; i < mesh.num_tets(); ++i)
    for (std::size_t k = 0; k < 4; ++k) {
      const auto c = static_cast<std::size_t>(cut.classes[i][k]);
      const Vec3 f = at(TetId(i), mesh.tets[i][k]) + shift[i];
      ++count[c];
      for (std::size_t a = 0; a < 3; ++a) x[3 * c + a] += f[static_cast<Eigen::Index>(a)];
    }
  for (std::size_t c = 0; c < count.size(); ++c)
    for (std::size_t a = 0; a < 3; ++a) x[3 * c + a] /= count[c];
  return x;
}

Vec3 point(std::span<const double> x, std::int32_t c) {
  const auto k = 3 * static_cast<std::size_t>(c);
  return {x[k], x[k + 1], x[k + 2]};
}

// Mean translation (front to back) of every cut patch, 3 per patch.
std::vector<double> patch_translations(const TetMesh& mesh, const CutGraph& cut, std::span<const double> x) {
  std::vector<double> sum(3 * cut.num_patches, 0);
  std::vector<int> count(cut.num_patches, 0);
  for (std::size_t i = 0; i < mesh.num_tets(); ++i)
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(TetId(i), f);
      if (cut.patch(h) <= 0) continue;
      const auto p = static_cast<std::size_t>(cut.patch(h) - 1);
      const HalfFaceId o = mesh.opposite_half_face(h);
      for (VertexId v : mesh.face_vertices(h)) {
        const auto& here = cut.classes[i][static_cast<std::size_t>(mesh.local_index(h.tet(), v))];
        const auto& there = cut.classes[o.tet().index()][static_cast<std::size_t>(mesh.local_index(o.tet(), v))];
        const Vec3 t = point(x, there) - octahedral::apply(cut.rotation(h), point(x, here));
        ++count[p];
        for (std::size_t a = 0; a < 3; ++a) sum[3 * p + a] += t[static_cast<Eigen::Index>(a)];
      }
    }
  for (std::size_t p = 0; p < count.size(); ++p)
    for (std::size_t a = 0; a < 3; ++a) sum[3 * p + a] /= count[p];
  return sum;
}

// Moves the map such that the pinned vertices are at the origin, where the space has them.
void move_pins_to_origin(const TetMesh& mesh, const ConformingSpace& space, std::vector<double>& x) {
  std::vector<Vec3> shift(space.pins.size());
  for (std::size_t p = 0; p < space.pins.size(); ++p) shift[p] = point(x, space.pins[p]);
  std::vector<char> moved(space.cut.num_classes(), 0);
  for (std::size_t i = 0; i < mesh.num_tets(); ++i)
    for (std::int32_t c : space.cut.classes[i]) {
      if (std::exchange(moved[static_cast<std::size_t>(c)], 1) != 0) continue;
      const Vec3& s = shift[static_cast<std::size_t>(space.cut.components[i])];
      for (std::size_t a = 0; a < 3; ++a) x[3 * static_cast<std::size_t>(c) + a] -= s[static_cast<Eigen::Index>(a)];
    }
}

}  // namespace

ConformingSpace conforming_space(const TetMesh& mesh, CutGraph cut, const Alignments& alignments) {
  ConformingSpace space;
  space.cut = std::move(cut);
  Builder(mesh, alignments, space).build();
  return space;
}

std::vector<double> coordinates(const ConformingSpace& space, std::span<const double> y) {
  std::vector<double> x(space.num_coordinates(), 0);
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t k = space.row_start[i]; k < space.row_start[i + 1]; ++k)
      x[i] += space.coefficients[k] * y[static_cast<std::size_t>(space.columns[k])];
  return x;
}

CornerMap to_corner_map(const ConformingSpace& space, std::span<const double> x) {
  CornerMap map;
  map.rotations = space.cut.rotations;
  map.uvw.resize(space.cut.classes.size());
  for (std::size_t i = 0; i < map.uvw.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k) map.uvw[i][k] = point(x, space.cut.classes[i][k]);
  return map;
}

std::vector<double> unknowns_of(const TetMesh& mesh, const ConformingSpace& space, const CornerMap& map) {
  std::vector<double> x = combed_coordinates(mesh, space.cut, map);
  move_pins_to_origin(mesh, space, x);
  const std::vector<double> translations = patch_translations(mesh, space.cut, x);
  std::vector<double> y(space.num_unknowns(), 0);
  for (std::size_t i = 0; i < y.size(); ++i)
    for (const auto& [source, c] : space.definitions[i])
      y[i] += c * (source >= 0 ? x[static_cast<std::size_t>(source)] : translations[static_cast<std::size_t>(~source)]);
  return y;
}

void quantize_to_dyadic_grid(const ConformingSpace& space, std::span<double> y) {
  double largest = 1;
  for (std::size_t x = 0; x < space.num_coordinates(); ++x) {
    double sum = 0;
    for (std::size_t k = space.row_start[x]; k < space.row_start[x + 1]; ++k)
      sum += std::abs(space.coefficients[k] * y[static_cast<std::size_t>(space.columns[k])]);
    largest = std::max(largest, sum);
  }
  // Sums of a few such numbers stay below 2^53 grid steps.
  const int exponent = 49 - std::ilogb(largest);
  for (double& value : y) value = std::ldexp(std::nearbyint(std::ldexp(value, exponent)), -exponent);
}

}  // namespace hexfield
