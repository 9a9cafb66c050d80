#include <algorithm>
#include <cmath>
#include <optional>

#include "edge_meshability.hpp"
#include "hexfield/field/edge_codes.hpp"
#include "link_map.hpp"

namespace hexfield {

using octahedral::Label;
using octahedral::Rotation;

namespace {

constexpr std::size_t next(std::size_t k) { return (k + 1) % 3; }

// Builds the link of one vertex; fails when an edge at it cannot be mapped whatever the others do.
class LinkBuilder {
 public:
  LinkBuilder(const FieldView& view, VertexId v) : view_(view), v_(v), star_(vertex_star(view.mesh, v)) {}

  std::optional<Link> build() {
    collect_ends();
    add_triangles();
    link_.vertices.resize(ends_.size());
    for (std::size_t w = 0; w < ends_.size(); ++w)
      if (!add_vertex(w)) return std::nullopt;
    return std::move(link_);
  }

 private:
  bool is_feature(HalfFaceId h) const {
    return view_.mesh.is_boundary(h) || view_.features.faces.contains(view_.mesh.key(h));
  }

  void collect_ends() {
    for (TetId t : star_)
      for (VertexId w : view_.mesh.vertices(t))
        if (w != v_) ends_.push_back(w);
    std::sort(ends_.begin(), ends_.end());
    ends_.erase(std::unique(ends_.begin(), ends_.end()), ends_.end());
    seeds_.resize(ends_.size());
    for (auto t = star_.rbegin(); t != star_.rend(); ++t)
      for (VertexId w : view_.mesh.vertices(*t))
        if (w != v_) seeds_[end_number(w)] = *t;
  }

  std::size_t end_number(VertexId w) const {
    return static_cast<std::size_t>(std::lower_bound(ends_.begin(), ends_.end(), w) - ends_.begin());
  }

  int triangle_of(TetId t) const {
    return static_cast<int>(std::lower_bound(star_.begin(), star_.end(), t) - star_.begin());
  }

  void add_triangles() {
    const TetMesh& mesh = view_.mesh;
    for (TetId t : star_) {
      LinkTriangle triangle;
      triangle.tet = t;
      triangle.frame = view_.field.frames[t.index()];
      const auto corners = mesh.face_vertices(HalfFaceId(t, mesh.local_index(t, v_)));
      for (std::size_t k = 0; k < 3; ++k) {
        triangle.vertex[k] = static_cast<int>(end_number(corners[k]));
        const HalfFaceId side(t, mesh.local_index(t, corners[next(next(k))]));
        if (is_feature(side))
          triangle.normal[k] = closest_label(view_.field.frames[t.index()], outward_normal(mesh, side));
        if (mesh.is_boundary(side)) continue;
        triangle.across[k] = triangle_of(mesh.opposite_half_face(side).tet());
        triangle.from_chart[k] = octahedral::inverse(view_.field.matching(side));
      }
      link_.triangles.push_back(triangle);
    }
  }

  std::size_t corner_in(std::size_t triangle, std::size_t w) const {
    const auto& vertex = link_.triangles[triangle].vertex;
    return static_cast<std::size_t>(std::find(vertex.begin(), vertex.end(), static_cast<int>(w)) - vertex.begin());
  }

  // Coordinates that the image of the edge may have in the chart of the first tet of its ring: those that the
  // monodromy keeps and no feature face at the edge forbids.
  std::array<bool, 3> free_coordinates(const EdgeRing& ring, std::size_t w) const {
    const Rotation around = monodromy(view_.field, ring);
    std::array<bool, 3> free{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto label = static_cast<Label>(2 * i);
      free[i] = octahedral::image(around, label) == label;
    }
    for (TetId t : ring.tets) {
      const auto triangle = static_cast<std::size_t>(triangle_of(t));
      const LinkTriangle& at = link_.triangles[triangle];
      const std::size_t k = corner_in(triangle, w);
      for (std::size_t side : {k, next(next(k))})
        if (const Label normal = at.normal[side]; normal != octahedral::no_label)
          free[static_cast<std::size_t>(
              octahedral::axis(octahedral::image(octahedral::inverse(at.to_tet[k]), normal)))] = false;
    }
    return free;
  }

  void add_sectors(const EdgeRing& ring, std::span<const Sector> between, std::size_t w, EdgeCode code) {
    auto corners_of = [&](const std::vector<TetId>& tets) {
      std::vector<int> corners;
      for (TetId t : tets) {
        const auto triangle = static_cast<std::size_t>(triangle_of(t));
        corners.push_back(static_cast<int>(3 * triangle + corner_in(triangle, w)));
      }
      return corners;
    };
    if (between.empty()) link_.sectors.push_back({corners_of(ring.tets), 4 + code});
    for (const Sector& s : between) link_.sectors.push_back({corners_of(s.tets), s.quads});
  }

  Vec3 seen_direction(const EdgeRing& ring, std::size_t w, const Vec3& direction) const {
    Vec3 sum = Vec3::Zero();
    for (TetId t : ring.tets) {
      const LinkTriangle& triangle = link_.triangles[static_cast<std::size_t>(triangle_of(t))];
      const Rotation to_tet = triangle.to_tet[corner_in(static_cast<std::size_t>(triangle_of(t)), w)];
      sum += octahedral::apply(octahedral::inverse(to_tet), triangle.frame.conjugate() * direction);
    }
    return sum;
  }

  bool add_vertex(std::size_t w) {
    const TetMesh& mesh = view_.mesh;
    const EdgeKey key = edge_key(v_, ends_[w]);
    const EdgeRing ring = edge_ring(mesh, seeds_[w], v_, ends_[w]);
    const auto between = sectors(mesh, view_.features, view_.field, ring, v_, ends_[w]);
    if (!edge_meshable(view_, key, ring, between)) return false;
    const auto found = view_.codes.find(key);
    const EdgeCode code = found == view_.codes.end() ? 0 : found->second;
    Rotation to_tet = octahedral::identity;
    for (std::size_t i = 0; i < ring.tets.size(); ++i) {
      const auto triangle = static_cast<std::size_t>(triangle_of(ring.tets[i]));
      link_.triangles[triangle].to_tet[corner_in(triangle, w)] = to_tet;
      if (i + 1 < ring.tets.size())
        to_tet = octahedral::product(octahedral::inverse(view_.field.matching(ring.crossings[i])), to_tet);
    }
    LinkVertex& vertex = link_.vertices[w];
    vertex.direction = (mesh.point(ends_[w]) - mesh.point(v_)).normalized();
    vertex.free = free_coordinates(ring, w);
    if (vertex.free_count() == 0) return false;
    if (code != 0 || view_.features.edges.count(key) != 0) put_on_axis(ring, w, code);
    add_sectors(ring, between, w, code);
    return true;
  }

  // Special edges lie on one coordinate axis: the free one that the field sees them along; arcs inside leave along
  // the label that their code gives.
  void put_on_axis(const EdgeRing& ring, std::size_t w, EdgeCode code) {
    LinkVertex& vertex = link_.vertices[w];
    const Vec3 seen = seen_direction(ring, w, vertex.direction);
    Eigen::Index best = -1;
    for (Eigen::Index i = 0; i < 3; ++i)
      if (vertex.free[static_cast<std::size_t>(i)] && (best < 0 || std::abs(seen[i]) > std::abs(seen[best]) + 1e-12))
        best = i;
    vertex.free = {best == 0, best == 1, best == 2};
    vertex.start = (seen[best] < 0 ? -1 : 1) * Vec3::Unit(best);
    if (!ring.closed || code == 0) return;
    const Label out = outgoing_label(view_.mesh, view_.field, ring, code, v_, ends_[w]);
    if (out != octahedral::no_label) vertex.start = octahedral::direction(out);
  }

  const FieldView& view_;
  VertexId v_;
  std::vector<TetId> star_;
  std::vector<VertexId> ends_;
  std::vector<TetId> seeds_;  // per end: the first tet of the star that has it
  Link link_;
};

constexpr std::size_t work_of_untangling = 200;  // a drawing by sweeps and Newton steps, against a look at each tet

std::vector<MappedTet> mapped(const Link& link, const std::vector<Vec3>& images) {
  std::vector<MappedTet> map;
  for (std::size_t t = 0; t < link.triangles.size(); ++t) {
    MappedTet m;
    m.tet = link.triangles[t].tet;
    for (std::size_t k = 0; k < 3; ++k) {
      m.directions[k] = link.vertices[static_cast<std::size_t>(link.triangles[t].vertex[k])].direction;
      m.images[k] = image_of(link, t, k, images);
    }
    map.push_back(m);
  }
  return map;
}

}  // namespace

namespace {

VertexVerdict search_map(Link plain, const VertexMapOptions& options, std::vector<MappedTet>* map, RepairWatch* watch) {
  if (!admits_area(plain)) return VertexVerdict::not_meshable;
  guess_images(plain);
  if (is_drawing(plain, starts(plain), options.smallest_det)) {
    if (map != nullptr) *map = mapped(plain, starts(plain));
    return VertexVerdict::meshable;
  }
  Link harmonic = plain;
  const bool placed = place_harmonically(harmonic);
  if (placed && is_drawing(harmonic, starts(harmonic), options.smallest_det)) {
    if (map != nullptr) *map = mapped(harmonic, starts(harmonic));
    return VertexVerdict::meshable;
  }
  if (watch != nullptr) watch->begin(work_of_untangling * plain.triangles.size());
  std::vector<Link> guesses = {plain, plain};
  align_frames(guesses[0], options.sweeps);
  guess_images(guesses[0]);
  guesses.push_back(guesses[0]);
  align_frames(guesses[2], 4 * options.sweeps);
  guess_images(guesses[2]);
  if (placed) guesses.push_back(harmonic);
  for (int level = 0; level <= options.refinements; ++level) {
    if (level > 0 && !is_cramped(guesses[0])) break;
    if (level > 0) guesses = {refined(guesses[0])};  // the larger problem gets one guess only
    const std::vector<Vec3> images = find_drawing(guesses, options);
    if (images.empty()) continue;
    if (map != nullptr) *map = mapped(guesses[0], images);
    return level == 0 ? VertexVerdict::meshable : VertexVerdict::meshable_when_split;
  }
  return VertexVerdict::not_meshable;
}

}  // namespace

VertexVerdict vertex_verdict(const FieldView& view, VertexId v, const VertexMapOptions& options,
                             std::vector<MappedTet>* map, std::optional<VerdictMemory::Key>* key) {
  if (view.watch != nullptr) view.watch->begin(vertex_star(view.mesh, v).size());
  std::optional<Link> link = LinkBuilder(view, v).build();
  if (!link) return VertexVerdict::not_meshable;
  if (key == nullptr && options.memory == nullptr) return search_map(*std::move(link), options, map, view.watch);
  const VerdictMemory::Key hash = structure_hash(*link);
  if (key != nullptr) *key = hash;
  const auto known = options.memory != nullptr ? options.memory->find(hash) : std::nullopt;
  return known ? *known : search_map(*std::move(link), options, map, view.watch);
}

bool is_trivially_regular(const FieldView& view, VertexId v) {
  for (TetId t : vertex_star(view.mesh, v)) {
    const auto& corners = view.mesh.vertices(t);
    for (int i = 0; i < 4; ++i) {
      const VertexId w = corners[static_cast<std::size_t>(i)];
      if (w == v) continue;
      const HalfFaceId h(t, i);
      if (view.mesh.is_boundary(h) || view.features.faces.count(view.mesh.key(h)) != 0) return false;
      const EdgeKey key = edge_key(v, w);
      if (view.codes.count(key) != 0 || view.features.edges.count(key) != 0) return false;
    }
  }
  return true;
}

bool vertex_meshable(const FieldView& view, VertexId v, const VertexMapOptions& options) {
  return is_trivially_regular(view, v) || vertex_verdict(view, v, options) != VertexVerdict::not_meshable;
}

}  // namespace hexfield
