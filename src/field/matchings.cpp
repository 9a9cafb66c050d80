#include "hexfield/field/matchings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hexfield/base/parallel.hpp"

namespace hexfield {
namespace {

octahedral::Rotation& slot(FrameField& field, HalfFaceId h) {
  return field.matchings[h.tet().index()][static_cast<std::size_t>(h.local())];
}

}  // namespace

void compute_matchings(const TetMesh& mesh, FrameField& field) {
  field.matchings.assign(mesh.num_tets(), {});
  parallel_for(mesh.num_tets(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const TetId t(static_cast<std::int64_t>(i));
      if (!mesh.alive(t)) continue;
      for (int f = 0; f < 4; ++f) {
        const HalfFaceId h(t, f);
        const HalfFaceId o = mesh.opposite_half_face(h);
        if (!o.valid()) continue;
        const TetId low = std::min(t, o.tet());
        const TetId high = std::max(t, o.tet());
        const auto m = octahedral::matching(field.frames[low.index()], field.frames[high.index()]);
        slot(field, h) = t == low ? m : octahedral::inverse(m);
      }
    }
  });
}

void change_gauge(const TetMesh& mesh, FrameField& field, TetId tet, octahedral::Rotation g) {
  if (g == octahedral::identity) return;
  field.frames[tet.index()] = (field.frames[tet.index()] * octahedral::quaternion(g)).normalized();
  for (int f = 0; f < 4; ++f) {
    const HalfFaceId h(tet, f);
    const HalfFaceId o = mesh.opposite_half_face(h);
    if (!o.valid()) continue;
    slot(field, h) = octahedral::product(octahedral::inverse(g), slot(field, h));
    slot(field, o) = octahedral::inverse(slot(field, h));
  }
}

void comb(const TetMesh& mesh, FrameField& field) {
  std::vector<char> seen(mesh.num_tets(), 0);
  std::vector<TetId> queue;
  for (std::size_t root = 0; root < mesh.num_tets(); ++root) {
    const TetId start(static_cast<std::int64_t>(root));
    if (seen[root] != 0 || !mesh.alive(start)) continue;
    seen[root] = 1;
    queue.assign(1, start);
    for (std::size_t k = 0; k < queue.size(); ++k)
      for (int f = 0; f < 4; ++f) {
        const HalfFaceId h(queue[k], f);
        const HalfFaceId o = mesh.opposite_half_face(h);
        if (!o.valid() || seen[o.tet().index()] != 0) continue;
        seen[o.tet().index()] = 1;
        change_gauge(mesh, field, o.tet(), field.matching(o));  // M_ji becomes M_ji^-1 M_ji
        queue.push_back(o.tet());
      }
  }
}

double matched_angle(const TetMesh& mesh, const FrameField& field, HalfFaceId h) {
  const HalfFaceId o = mesh.opposite_half_face(h);
  if (!o.valid()) return 0;
  const Quaternion moved = field.frames[h.tet().index()] * octahedral::quaternion(field.matching(h));
  return 2 * std::acos(std::min(1.0, std::abs(moved.dot(field.frames[o.tet().index()]))));
}

std::vector<Violation> check(const TetMesh& mesh, const FrameField& field) {
  std::vector<Violation> found;
  if (field.frames.size() != mesh.num_tets() || field.matchings.size() != mesh.num_tets()) {
    found.push_back({fmt::format("The field has {} frames and {} matchings for {} tets.", field.frames.size(),
                                 field.matchings.size(), mesh.num_tets()),
                     {},
                     {}});
    return found;
  }
  for (std::size_t i = 0; i < mesh.num_tets(); ++i) {
    const TetId t(static_cast<std::int64_t>(i));
    if (!mesh.alive(t)) continue;
    if (!(std::abs(field.frames[i].norm() - 1) < 1e-9))
      found.push_back(
          {fmt::format("The frame of tet {} is not a unit quaternion.", i), {t.value}, {centroid(mesh, t)}});
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(t, f);
      const HalfFaceId o = mesh.opposite_half_face(h);
      const auto expected = o.valid() ? octahedral::inverse(field.matching(o)) : octahedral::identity;
      if (field.matching(h) != expected)
        found.push_back({fmt::format("Half-face {} has a matching that is not the inverse of its opposite.", h.value),
                         {h.value},
                         {centroid(mesh, t)}});
    }
  }
  return found;
}

void FieldAttribute::on_split(const TetMesh& mesh, const SplitRecord& record) {
  field_.frames.resize(mesh.num_tets(), Quaternion::Identity());
  field_.matchings.resize(mesh.num_tets(), {});
  for (const auto& [child, parent] : record.child_of) field_.frames[child.index()] = field_.frames[parent.index()];
  for (const NewHalfFace& n : record.half_faces)
    slot(field_, n.half_face) = n.origin.valid() ? field_.matching(n.origin) : octahedral::identity;
}

void FieldAttribute::on_collapse(const TetMesh&, const CollapseRecord& record) {
  for (const auto& m : record.merged) {
    const bool inner = m.beyond_from.valid() && m.beyond_to.valid();
    // From the tet beyond the face at `from` through the removed tet to the one beyond the face at `to`.
    const auto through =
        inner ? octahedral::product(octahedral::inverse(field_.matching(m.at_from)), field_.matching(m.at_to))
              : octahedral::identity;
    if (m.beyond_from.valid()) slot(field_, m.beyond_from) = through;
    if (m.beyond_to.valid()) slot(field_, m.beyond_to) = octahedral::inverse(through);
  }
}

void FieldAttribute::on_swap(const TetMesh& mesh, const SwapRecord& record) {
  field_.frames.resize(mesh.num_tets(), Quaternion::Identity());
  field_.matchings.resize(mesh.num_tets(), {});
  std::vector<octahedral::Rotation> to(record.removed.size(), octahedral::order);  // matching from removed[0]
  const auto position = [&](TetId t) {
    return static_cast<std::size_t>(std::find(record.removed.begin(), record.removed.end(), t) -
                                    record.removed.begin());
  };
  to[0] = octahedral::identity;
  for (const auto& [from, across] : record.crossings) {
    const auto m = octahedral::product(to[position(from.tet())], field_.matching(from));
    auto& known = to[position(across.tet())];
    require(known == octahedral::order || known == m, "A singular edge was swapped.");
    known = m;
  }
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  for (std::size_t k = 0; k < to.size(); ++k) {
    const Quaternion q = field_.frames[record.removed[k].index()] * octahedral::quaternion(octahedral::inverse(to[k]));
    sum += q.coeffs().dot(sum) < 0 ? Eigen::Vector4d(-q.coeffs()) : q.coeffs();
  }
  const Quaternion mean =
      sum.norm() > 1e-6 ? Quaternion(Eigen::Vector4d(sum.normalized())) : field_.frames[record.removed[0].index()];
  for (const auto& [t, like] : record.added) field_.frames[t.index()] = mean;
  for (const NewHalfFace& n : record.half_faces) {
    const auto m = n.origin.valid() && !mesh.is_boundary(n.half_face)
                       ? octahedral::product(to[position(n.origin.tet())], field_.matching(n.origin))
                       : octahedral::identity;
    slot(field_, n.half_face) = m;
    if (!mesh.is_boundary(n.half_face)) slot(field_, mesh.opposite_half_face(n.half_face)) = octahedral::inverse(m);
  }
}

void FieldAttribute::on_compact(const std::vector<TetId>& new_tet) {
  std::size_t alive = 0;
  for (std::size_t i = 0; i < new_tet.size(); ++i) {
    if (!new_tet[i].valid()) continue;
    field_.frames[new_tet[i].index()] = field_.frames[i];  // order is kept, so nothing is overwritten early
    field_.matchings[new_tet[i].index()] = field_.matchings[i];
    ++alive;
  }
  field_.frames.resize(alive);
  field_.matchings.resize(alive);
}

}  // namespace hexfield
