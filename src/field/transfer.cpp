#include "hexfield/field/transfer.hpp"

#include <algorithm>
#include <deque>

#include "hexfield/base/octahedral.hpp"
#include "hexfield/base/parallel.hpp"

namespace hexfield {
namespace {

bool is_singular(const FaceKey& f, const std::vector<Quaternion>& frames) {
  const auto ab = octahedral::matching(frames[f[0].index()], frames[f[1].index()]);
  const auto bc = octahedral::matching(frames[f[1].index()], frames[f[2].index()]);
  const auto ca = octahedral::matching(frames[f[2].index()], frames[f[0].index()]);
  return octahedral::product(octahedral::product(ab, bc), ca) != octahedral::identity;
}

double length(const TetMesh& mesh, const EdgeKey& e) { return (mesh.point(e[0]) - mesh.point(e[1])).norm(); }

// Longest edge of a simplex; the smaller key wins ties.
template <class Vertices>
EdgeKey longest_edge(const TetMesh& mesh, const Vertices& v) {
  EdgeKey best = edge_key(v[0], v[1]);
  for (std::size_t i = 0; i < v.size(); ++i)
    for (std::size_t j = i + 1; j < v.size(); ++j) {
      const EdgeKey e = edge_key(v[i], v[j]);
      const double margin = 1e-12 * length(mesh, best);
      if (length(mesh, e) > length(mesh, best) + margin || (length(mesh, e) > length(mesh, best) - margin && e < best))
        best = e;
    }
  return best;
}

// Follows longest edges of the tets around an edge until none is longer: splitting only such edges keeps
// the tets from degenerating [Rivara 1997].
EdgeKey locally_longest_edge(const TetMesh& mesh, EdgeKey edge, TetId seed) {
  for (bool moved = true; moved;) {
    moved = false;
    for (TetId t : edge_ring(mesh, seed, edge[0], edge[1]).tets) {
      const EdgeKey e = longest_edge(mesh, mesh.vertices(t));
      if (length(mesh, e) <= length(mesh, edge) * (1 + 1e-9)) continue;
      edge = e;
      seed = t;
      moved = true;
      break;
    }
  }
  return edge;
}

double mean_edge(const TetMesh& mesh) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < mesh.num_tets(); ++i) {
    if (!mesh.alive(TetId(static_cast<std::int64_t>(i)))) continue;
    const auto& v = mesh.tets[i];
    for (const auto& e : tet_edge_vertices)
      sum += (mesh.point(v[static_cast<std::size_t>(e[0])]) - mesh.point(v[static_cast<std::size_t>(e[1])])).norm();
    count += 6;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

}  // namespace

void VertexShAttribute::on_split(const TetMesh& mesh, const SplitRecord& record) {
  harmonics::Sh sum = harmonics::Sh::Zero();
  for (VertexId v : record.parents) sum += sh_[v.index()];
  sh_.resize(mesh.num_vertices());
  sh_[record.new_vertex.index()] = harmonics::project(sum).sh;
}

RefinementReport refine_singular_faces(TetMesh& mesh, std::vector<harmonics::Sh>& vertex_sh, double edge_factor,
                                       int max_splits, std::vector<MeshAttribute*> attributes) {
  VertexShAttribute follow(vertex_sh);
  attributes.push_back(&follow);
  std::vector<Quaternion> frames(vertex_sh.size());
  parallel_for(frames.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) frames[v] = harmonics::project(vertex_sh[v]).frame;
  });
  const double limit = edge_factor * mean_edge(mesh);
  std::deque<FaceKey> queue;
  for (std::size_t i = 0; i < mesh.num_tets(); ++i)
    for (int f = 0; f < 4 && mesh.alive(TetId(static_cast<std::int64_t>(i))); ++f) {
      const HalfFaceId h(TetId(static_cast<std::int64_t>(i)), f);
      const HalfFaceId o = mesh.opposite_half_face(h);
      if ((!o.valid() || h < o) && is_singular(mesh.key(h), frames)) queue.push_back(mesh.key(h));
    }
  RefinementReport report;
  while (!queue.empty()) {
    const FaceKey f = queue.front();
    const HalfFaceId h0 = find_half_face(mesh, f);
    const EdgeKey longest = longest_edge(mesh, f);
    if (!h0.valid() || length(mesh, longest) <= limit) {
      queue.pop_front();
      continue;
    }
    if (report.splits == max_splits) {
      report.capped = true;
      break;
    }
    const EdgeKey edge = locally_longest_edge(mesh, longest, h0.tet());
    const VertexId v = split_edge(mesh, edge[0], edge[1], attributes);
    ++report.splits;
    frames.push_back(harmonics::project(vertex_sh[v.index()]).frame);
    for (TetId t : vertex_star(mesh, v))
      for (int k = 0; k < 4; ++k) {
        const HalfFaceId h(t, k);
        const HalfFaceId o = mesh.opposite_half_face(h);
        if (o.valid() && o < h && mesh.has_vertex(o.tet(), v)) continue;
        if (is_singular(mesh.key(h), frames)) queue.push_back(mesh.key(h));
      }
  }
  return report;
}

std::vector<Quaternion> tet_frames(const TetMesh& mesh, const std::vector<harmonics::Sh>& vertex_sh) {
  std::vector<Quaternion> frames(mesh.num_tets(), Quaternion::Identity());
  parallel_for(mesh.num_tets(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!mesh.alive(TetId(static_cast<std::int64_t>(i)))) continue;
      harmonics::Sh sum = harmonics::Sh::Zero();
      for (VertexId v : mesh.tets[i]) sum += vertex_sh[v.index()];
      frames[i] = harmonics::project(sum).frame;
    }
  });
  return frames;
}

}  // namespace hexfield
