#include "spacing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "hexfield/base/parallel.hpp"

namespace hexfield {
namespace {

using octahedral::Label;

constexpr int max_steps = 20000;
// Longer ones cannot collapse by rounding, which moves a coordinate by one or two.
constexpr double max_length = 6;

/// Where a ray starts: the form of its coordinate on the travel axis, the axis of the edge that it stands
/// for (-1 for none) and half the length of this edge.
struct Source {
  LinearForm form;
  int along = -1;
  double reach = 0;
};

class Tracer {
 public:
  Tracer(const TetMesh& mesh, const ConformingSpace& space, const Alignments& alignments, std::span<const double> y)
      : mesh_(mesh), space_(space), map_(to_corner_map(space, coordinates(space, y))) {
    aligned_.assign(mesh.num_tets(), {-1, -1, -1, -1});
    for (const FaceAlignment& a : alignments.faces)
      aligned_[a.face.tet().index()][static_cast<std::size_t>(a.face.local())] = combed(a.face.tet(), a.axis);
    special_.resize(mesh.num_tets());
    for (const EdgeAlignment& e : alignments.edges) special_[e.tet.index()].push_back({e.edge, combed(e.tet, e.axis)});
  }

  /// Row of a coordinate of the map as a form over all unknowns.
  LinearForm form(TetId t, VertexId v, int axis) const {
    const std::size_t x = coordinate(t, v, axis);
    LinearForm f;
    for (std::size_t k = space_.row_start[x]; k < space_.row_start[x + 1]; ++k)
      f.emplace_back(space_.columns[k], space_.coefficients[k]);
    std::sort(f.begin(), f.end());
    return f;
  }
  bool integral(TetId t, VertexId v, int axis) const { return space_.integral[coordinate(t, v, axis)] != 0; }
  const Vec3& at(TetId t, VertexId v) const {
    return map_.uvw[t.index()][static_cast<std::size_t>(mesh_.local_index(t, v))];
  }
  int aligned_axis(HalfFaceId h) const { return aligned_[h.tet().index()][static_cast<std::size_t>(h.local())]; }
  int combed(TetId t, int axis) const {
    return octahedral::axis(
        octahedral::image(octahedral::inverse(space_.cut.gauges[t.index()]), static_cast<Label>(2 * axis)));
  }

  /// Follows the axis `direction` from point p in tet t (not back through `from`), whose coordinate on that
  /// axis has the form `start`, and adds what it finds.
  void trace(TetId t, int from, Vec3 p, Label direction, Source source, std::vector<Spacing>& found) const {
    // Coordinate on the start axis = sign * coordinate on the current axis + offset.
    LinearForm offset;
    int sign = 1;
    double offset_value = 0;
    const double start_value = p[octahedral::axis(direction)];
    const int start_sign = (direction & 1) != 0 ? -1 : 1;
    // `aside`: by how much the ray passes it.
    auto add_found = [&](TetId at_tet, VertexId v, int axis, double aside) {
      const double length = start_sign * (sign * at(at_tet, v)[axis] + offset_value - start_value);
      if (length < 1e-6 || length < aside) return;
      LinearForm f = hexfield::add(hexfield::add(offset, sign, form(at_tet, v, axis)), -1, source.form);
      if (f.empty()) return;
      found.push_back({scaled(f, start_sign), length, v});
    };
    for (int step = 0; step < max_steps; ++step) {
      const int axis = octahedral::axis(direction);
      pass_arcs(t, p, axis, source, add_found);
      const int exit = leave(t, from, p, direction);
      if (exit < 0) return;
      if (std::abs(sign * p[axis] + offset_value - start_value) > max_length) return;
      const HalfFaceId h(t, exit);
      if (aligned_axis(h) == axis) return add_found(t, mesh_.face_vertices(h)[0], axis, 0);
      const HalfFaceId o = mesh_.opposite_half_face(h);
      if (!o.valid()) return;
      if (space_.cut.patch(h) != 0) {
        const octahedral::Rotation r = space_.cut.rotation(h);
        const Label to = octahedral::image(r, static_cast<Label>(2 * axis));
        const int turn = (to & 1) != 0 ? -1 : 1;
        const VertexId v = mesh_.face_vertices(h)[0];
        // x_t[axis] = turn (x_o[axis'] - T[axis']), T = x_o - R x_t at v.
        const LinearForm translation = hexfield::add(form(o.tet(), v, octahedral::axis(to)), -turn, form(t, v, axis));
        const Vec3 shift = at(o.tet(), v) - octahedral::apply(r, at(t, v));
        offset = hexfield::add(offset, -sign * turn, translation);
        offset_value -= sign * turn * shift[octahedral::axis(to)];
        sign *= turn;
        p = octahedral::apply(r, p) + shift;
        direction = octahedral::image(r, direction);
        if (source.along >= 0)
          source.along = octahedral::axis(octahedral::image(r, static_cast<Label>(2 * source.along)));
      }
      t = o.tet();
      from = o.local();
    }
  }

  const TetMesh& mesh() const { return mesh_; }

 private:
  std::size_t coordinate(TetId t, VertexId v, int axis) const {
    return 3 * static_cast<std::size_t>(
                   space_.cut.classes[t.index()][static_cast<std::size_t>(mesh_.local_index(t, v))]) +
           static_cast<std::size_t>(axis);
  }

  // Moves p to where the ray leaves t; the local face, or -1 when it does not move on.
  int leave(TetId t, int from, Vec3& p, Label direction) const {
    const Vec3 d = octahedral::direction(direction);
    double best = std::numeric_limits<double>::infinity();
    int exit = -1;
    for (int f = 0; f < 4; ++f) {
      if (f == from) continue;
      const auto v = mesh_.face_vertices(HalfFaceId(t, f));
      const Vec3 n = (at(t, v[1]) - at(t, v[0])).cross(at(t, v[2]) - at(t, v[0]));
      const double speed = n.dot(d);
      if (!(speed > 1e-12 * n.norm())) continue;
      const double time = std::max(0.0, n.dot(at(t, v[0]) - p) / speed);
      if (time < best) best = time, exit = f;
    }
    if (exit >= 0) p += best * d;
    return exit;
  }

  // Arcs at tet t whose coordinate on `axis` is integer and that the ray at p passes closely.
  template <class F>
  void pass_arcs(TetId t, const Vec3& p, int axis, const Source& source, const F& add_found) const {
    for (const auto& [edge, along] : special_[t.index()]) {
      if (along == axis) continue;
      const int side = 3 - axis - along;
      const Vec3& a = at(t, edge[0]);
      const Vec3& b = at(t, edge[1]);
      // Along its own edge the source meets everything within its length.
      const double margin = source.along == along ? source.reach : 0.25;
      if (std::min(a[along], b[along]) - margin > p[along] || std::max(a[along], b[along]) + margin < p[along])
        continue;
      const double aside = std::abs(a[side] - p[side]);
      if (source.along == side ? aside > source.reach : aside > 1) continue;
      add_found(t, edge[0], axis, source.along == side ? 0 : aside);
    }
  }

  struct Special {
    EdgeKey edge;
    int axis;
  };
  const TetMesh& mesh_;
  const ConformingSpace& space_;
  CornerMap map_;
  std::vector<std::array<int, 4>> aligned_;
  std::vector<std::vector<Special>> special_;
};

void trace_from_faces(const Tracer& tracer, const Alignments& alignments, std::vector<Spacing>& found) {
  const TetMesh& mesh = tracer.mesh();
  for (const FaceAlignment& a : alignments.faces) {
    const TetId t = a.face.tet();
    const int axis = tracer.combed(t, a.axis);
    const auto v = mesh.face_vertices(a.face);
    const Vec3 p = (tracer.at(t, v[0]) + tracer.at(t, v[1]) + tracer.at(t, v[2])) / 3;
    const VertexId apex = mesh.vertices(t)[static_cast<std::size_t>(a.face.local())];
    const bool down = tracer.at(t, apex)[axis] < p[axis];
    tracer.trace(t, a.face.local(), p, static_cast<Label>(2 * axis + (down ? 1 : 0)), {tracer.form(t, v[0], axis)},
                 found);
  }
}

// Whether one moves from p into tet t in direction d: p lies on the faces that hold all of `on`.
bool points_inside(const Tracer& tracer, TetId t, std::span<const VertexId> on, const Vec3& d, double tolerance) {
  const TetMesh& mesh = tracer.mesh();
  for (int f = 0; f < 4; ++f) {
    const VertexId opposite = mesh.vertices(t)[static_cast<std::size_t>(f)];
    if (std::find(on.begin(), on.end(), opposite) != on.end()) continue;
    const auto v = mesh.face_vertices(HalfFaceId(t, f));
    const Vec3 n = (tracer.at(t, v[1]) - tracer.at(t, v[0])).cross(tracer.at(t, v[2]) - tracer.at(t, v[0]));
    if (n.dot(d) > tolerance * n.norm()) return false;
  }
  return true;
}

// From the middle of each special edge into every tet around it, along the axes inside the tet.
void trace_from_edges(const Tracer& tracer, const Alignments& alignments, std::vector<Spacing>& found) {
  for (const EdgeAlignment& e : alignments.edges) {
    const TetId t = e.tet;
    const int along = tracer.combed(t, e.axis);
    const Vec3& a = tracer.at(t, e.edge[0]);
    const Vec3& b = tracer.at(t, e.edge[1]);
    for (Label direction = 0; direction < 6; ++direction) {
      const int axis = octahedral::axis(direction);
      if (axis == along || !points_inside(tracer, t, e.edge, octahedral::direction(direction), 1e-9)) continue;
      const double reach = 0.5 * std::abs(b[along] - a[along]) + 1e-6;
      tracer.trace(t, -1, 0.5 * (a + b), direction, {tracer.form(t, e.edge[0], axis), along, reach}, found);
    }
  }
}

// From points where all coordinates are integer, along all axes.
void trace_from_points(const Tracer& tracer, const Alignments& alignments, std::vector<Spacing>& found) {
  const TetMesh& mesh = tracer.mesh();
  std::set<VertexId> points(alignments.points.begin(), alignments.points.end());
  for (const EdgeAlignment& e : alignments.edges)
    for (VertexId v : e.edge)
      if (tracer.integral(e.tet, v, tracer.combed(e.tet, e.axis))) points.insert(v);
  for (VertexId v : points)
    for (TetId t : vertex_star(mesh, v))
      for (Label direction = 0; direction < 6; ++direction) {
        if (!points_inside(tracer, t, {&v, 1}, octahedral::direction(direction), 1e-9)) continue;
        tracer.trace(t, -1, tracer.at(t, v), direction, {tracer.form(t, v, octahedral::axis(direction))}, found);
      }
}

// Chains of special edges between points where all coordinates are integer.
void walk_links(const Tracer& tracer, const Alignments& alignments, std::vector<Spacing>& found) {
  struct Step {
    TetId tet;
    int axis;
  };
  std::map<EdgeKey, Step> edges;
  std::map<VertexId, std::vector<EdgeKey>> at_vertex;
  std::map<VertexId, bool> node;
  for (const EdgeAlignment& e : alignments.edges) {
    const int axis = tracer.combed(e.tet, e.axis);
    if (!edges.emplace(e.edge, Step{e.tet, axis}).second) continue;
    for (VertexId v : e.edge) {
      at_vertex[v].push_back(e.edge);
      node[v] = tracer.integral(e.tet, v, axis);
    }
  }
  for (const auto& [v, is_node] : node) {
    if (!is_node) continue;
    for (EdgeKey edge : at_vertex[v]) {
      LinearForm form;
      double length = 0;
      VertexId here = v;
      for (std::size_t steps = 0; steps <= edges.size(); ++steps) {
        const VertexId next = edge[0] == here ? edge[1] : edge[0];
        const auto& [t, axis] = edges.at(edge);
        const double d = tracer.at(t, next)[axis] - tracer.at(t, here)[axis];
        const int sign = d < 0 ? -1 : 1;
        form = add(add(form, sign, tracer.form(t, next, axis)), -sign, tracer.form(t, here, axis));
        length += std::abs(d);
        here = next;
        if (node.at(here)) break;
        // Inside a chain exactly one other special edge goes on.
        const auto& star = at_vertex.at(here);
        if (star.size() != 2) break;
        edge = star[0] == edge ? star[1] : star[0];
      }
      if (node.at(here) && !form.empty() && length <= max_length) found.push_back({form, length, v});
    }
  }
}

}  // namespace

std::vector<Spacing> required_spacings(const TetMesh& mesh, const ConformingSpace& space, const Alignments& alignments,
                                       std::span<const double> y) {
  const Tracer tracer(mesh, space, alignments, y);
  std::vector<Spacing> found;
  walk_links(tracer, alignments, found);
  trace_from_faces(tracer, alignments, found);
  trace_from_edges(tracer, alignments, found);
  trace_from_points(tracer, alignments, found);
  std::vector<Spacing> distinct;
  std::set<LinearForm> seen;
  const auto first = static_cast<std::int32_t>(space.num_reals);
  for (Spacing& s : found) {
    for (auto& entry : s.form) entry.first -= first;
    // Real unknowns left in a form: the two ends do not belong to integer coordinates after all.
    if (s.form.empty() || s.form.front().first < 0 || !seen.insert(s.form).second) continue;
    distinct.push_back(std::move(s));
  }
  return distinct;
}

}  // namespace hexfield
