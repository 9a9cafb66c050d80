#include "untangle_images.hpp"

#include <algorithm>
#include <cmath>

namespace hexfield::hex {
namespace {

constexpr int max_passes = 30;
constexpr int max_steps = 40;

// The tets at a vertex, with their other three corners in the chart of the first: parameter units.
struct Star {
  std::vector<TetId> tets;
  std::vector<LatticeTransition> to_chart;  // of the first tet -> chart of each
  std::vector<std::array<Vec3, 3>> other;   // positive with the vertex before them
};

class ImageUntangler {
 public:
  ImageUntangler(const TetMesh& mesh, FixedMap& map, const VertexTets& star, const std::vector<std::uint8_t>& pinned)
      : mesh_(mesh), map_(map), star_(star), pinned_(pinned) {}

  std::vector<VertexId> run() {
    std::vector<char> moved(mesh_.num_vertices(), 0);
    for (int pass = 0; pass < max_passes; ++pass) {
      const std::vector<VertexId> near = vertices_near_bad_tets(pass >= 3);
      bool any = false;
      for (VertexId v : near)
        if (improve(v)) moved[v.index()] = 1, any = true;
      if (!any) break;
    }
    std::vector<VertexId> list;
    for (std::size_t v = 0; v < moved.size(); ++v)
      if (moved[v] != 0) list.emplace_back(v);
    return list;
  }

 private:
  bool positive(TetId t) const {
    const auto& c = map_.corners[t.index()];
    return orient3d(c[0], c[1], c[2], c[3]) > 0;
  }
  std::vector<VertexId> vertices_near_bad_tets(bool ring) const;
  bool improve(VertexId v);
  bool unfold(VertexId v, Star& star) const;
  Vec3 ascend(const Star& star, const Vec3& start, unsigned pinned) const;
  void write(VertexId v, const Star& star, const Vec3& place, unsigned pinned);

  const TetMesh& mesh_;
  FixedMap& map_;
  const VertexTets& star_;
  const std::vector<std::uint8_t>& pinned_;
};

std::vector<VertexId> ImageUntangler::vertices_near_bad_tets(bool ring) const {
  std::vector<VertexId> near;
  for (std::size_t t = 0; t < mesh_.num_tets(); ++t)
    if (!positive(TetId(t))) near.insert(near.end(), mesh_.tets[t].begin(), mesh_.tets[t].end());
  const std::size_t n = ring ? near.size() : 0;
  for (std::size_t k = 0; k < n; ++k)
    for (const TetId* t = star_.begin(near[k]); t != star_.end(near[k]); ++t)
      near.insert(near.end(), mesh_.vertices(*t).begin(), mesh_.vertices(*t).end());
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  return near;
}

Vec3 units(const Fixed3& x, std::int64_t one) {
  return Vec3(static_cast<double>(x[0]), static_cast<double>(x[1]), static_cast<double>(x[2])) /
         static_cast<double>(one);
}

// False where the tets at v do not hang together.
bool ImageUntangler::unfold(VertexId v, Star& star) const {
  star = {{*star_.begin(v)}, {LatticeTransition{}}, {}};
  for (std::size_t k = 0; k < star.tets.size(); ++k)
    for (int i = 0; i < 4; ++i) {
      const HalfFaceId h(star.tets[k], i);
      const HalfFaceId o = mesh_.opposite_half_face(h);
      if (!o.valid() || mesh_.vertices(h.tet())[static_cast<std::size_t>(i)] == v) continue;
      if (std::find(star.tets.begin(), star.tets.end(), o.tet()) != star.tets.end()) continue;
      const LatticeTransition& step = map_.transition(h);
      star.tets.push_back(o.tet());
      star.to_chart.push_back(
          {octahedral::product(step.rotation, star.to_chart[k].rotation), step.point(star.to_chart[k].translation)});
    }
  if (star.tets.size() != static_cast<std::size_t>(star_.end(v) - star_.begin(v))) return false;
  for (std::size_t k = 0; k < star.tets.size(); ++k) {
    const int i = mesh_.local_index(star.tets[k], v);
    const LatticeTransition& to = star.to_chart[k];
    const octahedral::Rotation back = octahedral::inverse(to.rotation);
    auto& other = star.other.emplace_back();
    for (std::size_t n = 0; n < 3; ++n) {
      const int j = tet_face_vertices[static_cast<std::size_t>(i)][n];
      Fixed3 x = map_.corner(star.tets[k], j);
      for (std::size_t a = 0; a < 3; ++a) x[a] -= to.translation[a] * map_.one();
      other[n] = units(rotate(back, x), map_.one());
    }
  }
  return true;
}

// Volume of the worst tet relative to its size.
double measure(const Star& star, const Vec3& p, std::size_t& worst) {
  double least = 2;
  for (std::size_t k = 0; k < star.other.size(); ++k) {
    const auto& q = star.other[k];
    const Vec3 a = q[0] - p, b = q[1] - p, c = q[2] - p;
    const double size = std::max({a.squaredNorm(), b.squaredNorm(), c.squaredNorm(), (q[1] - q[0]).squaredNorm(),
                                  (q[2] - q[1]).squaredNorm(), (q[0] - q[2]).squaredNorm(), 1e-30});
    const double value = a.cross(b).dot(c) / (size * std::sqrt(size));
    if (value < least) least = value, worst = k;
  }
  return least;
}

// Steps that enlarge the worst tet, each as long as that makes the new worst one better.
Vec3 ImageUntangler::ascend(const Star& star, const Vec3& start, unsigned pinned) const {
  const auto free = [pinned](Vec3 d) {
    for (int a = 0; a < 3; ++a)
      if ((pinned >> a & 1U) != 0) d[a] = 0;
    return d;
  };
  Vec3 centre = Vec3::Zero();
  for (const auto& q : star.other) centre += (q[0] + q[1] + q[2]) / (3 * static_cast<double>(star.other.size()));
  std::size_t worst = 0;
  Vec3 p = start;
  double best = measure(star, p, worst);
  const auto attempt = [&](const Vec3& candidate) {
    std::size_t other = 0;
    const double value = measure(star, candidate, other);
    if (!(value > best + 1e-9)) return false;
    p = candidate, best = value, worst = other;
    return true;
  };
  for (const double part : {1.0, 0.75, 0.5, 0.25}) attempt(start + part * free(centre - start));
  double length = free(centre - start).norm();
  for (const auto& q : star.other) length = std::max(length, 0.25 * (q[1] - q[0]).norm());
  for (int step = 0; step < max_steps && length > 1e-6; ++step) {
    const auto& q = star.other[worst];
    const Vec3 gradient = free(-(q[1] - q[0]).cross(q[2] - q[0]));
    if (gradient.norm() == 0 || !attempt(p + length * gradient.normalized())) length *= 0.5;
  }
  return p;
}

void ImageUntangler::write(VertexId v, const Star& star, const Vec3& place, unsigned pinned) {
  Fixed3 x = map_.corner(star.tets[0], mesh_.local_index(star.tets[0], v));
  for (std::size_t a = 0; a < 3; ++a)
    if ((pinned >> a & 1U) == 0)
      x[a] = std::llround(place[static_cast<Eigen::Index>(a)] * static_cast<double>(map_.one()));
  for (std::size_t k = 0; k < star.tets.size(); ++k) {
    Fixed3 image = rotate(star.to_chart[k].rotation, x);
    for (std::size_t a = 0; a < 3; ++a) image[a] += star.to_chart[k].translation[a] * map_.one();
    map_.corners[star.tets[k].index()][static_cast<std::size_t>(mesh_.local_index(star.tets[k], v))] = image;
  }
}

bool ImageUntangler::improve(VertexId v) {
  const unsigned pinned = pinned_[v.index()];
  if ((pinned & 7U) == 7U || star_.begin(v) == star_.end(v)) return false;
  Star star;
  if (!unfold(v, star)) return false;
  const Vec3 start = units(map_.corner(star.tets[0], mesh_.local_index(star.tets[0], v)), map_.one());
  const Vec3 place = ascend(star, start, pinned);
  if (place == start) return false;
  write(v, star, place, pinned);
  return true;
}

}  // namespace

std::vector<VertexId> untangle_images(const TetMesh& mesh, FixedMap& map, const VertexTets& star,
                                      const std::vector<std::uint8_t>& pinned) {
  return ImageUntangler(mesh, map, star, pinned).run();
}

}  // namespace hexfield::hex
