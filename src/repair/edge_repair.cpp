#include "hexfield/repair/edge_repair.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/repair/field_snapshot.hpp"
#include "hexfield/repair/state_ops.hpp"
#include "hexfield/repair/zipping.hpp"

namespace hexfield {

using octahedral::Rotation;

namespace {

constexpr std::size_t work_of_zipping = 100;  // with the smoothing of the frames around

bool is_half_turn(Rotation r) { return r != octahedral::identity && octahedral::product(r, r) == octahedral::identity; }
bool is_quarter_turn(Rotation r) { return octahedral::is_axial(r) && r != octahedral::identity && !is_half_turn(r); }

VertexId third_vertex(const FaceKey& f, const EdgeKey& e) {
  for (VertexId v : f)
    if (v != e[0] && v != e[1]) return v;
  return VertexId();
}

// A new arc may pass through k: nothing special is there.
bool is_free_vertex(const RepairState& state, VertexId k) {
  for (TetId t : vertex_star(state.mesh, k))
    for (int f = 0; f < 4; ++f)
      if (state.mesh.vertices(t)[static_cast<std::size_t>(f)] != k && is_feature_face(state, HalfFaceId(t, f)))
        return false;
  const auto edges = edges_at(state.mesh, k);
  return std::none_of(edges.begin(), edges.end(), [&](const EdgeKey& e) { return is_special(state, e); });
}

bool is_free_face(const RepairState& state, const EdgeKey& e, HalfFaceId h) {
  return !is_feature_face(state, h) && is_free_vertex(state, third_vertex(state.mesh.key(h), e));
}

std::vector<FaceKey> free_faces(const RepairState& state, const EdgeKey& e, const std::vector<HalfFaceId>& crossings) {
  std::vector<FaceKey> faces;
  for (HalfFaceId h : crossings)
    if (is_free_face(state, e, h)) faces.push_back(state.mesh.key(h));
  return faces;
}

// Triangles at the edge that only it makes special, one made by a split where there is none: of the widest tet, so that
// both halves keep room.
std::vector<FaceKey> faces_to_unzip(RepairState& state, const EdgeKey& e, const std::vector<TetId>& tets,
                                    const std::vector<HalfFaceId>& crossings) {
  std::vector<FaceKey> faces = free_faces(state, e, crossings);
  if (!faces.empty()) return faces;
  TetId widest = tets.front();
  double most = -1;
  for (TetId t : tets)
    if (const double angle = dihedral_angle(state.mesh, t, e[0], e[1]); angle > most) widest = t, most = angle;
  return {face_key(e[0], e[1], split_tet(state, widest))};
}

double turning_around(const RepairState& state, const EdgeKey& e) {
  double sum = 0;
  const EdgeRing ring = ring_of(state.mesh, e[0], e[1]);
  for (HalfFaceId h : ring.crossings) {
    if (state.mesh.is_boundary(h)) continue;
    const Quaternion moved = state.field.frames[h.tet().index()] * octahedral::quaternion(state.field.matching(h));
    const Quaternion& next = state.field.frames[state.mesh.opposite_half_face(h).tet().index()];
    sum += 2 * std::acos(std::min(1.0, std::abs(moved.dot(next))));
  }
  return sum;
}

// Small is good: what the codes of the triangle are worth first, then the turning around the edge.
using Score = std::tuple<int, double>;

int badness(EdgeCode code) {
  if (code == compound_code) return 100;
  if (code == undetermined_code) return 1;
  return 10 * std::max(0, std::abs(code) - 1);
}

std::array<EdgeKey, 3> edges_of_face(const FaceKey& f) {
  return {edge_key(f[0], f[1]), edge_key(f[0], f[2]), edge_key(f[1], f[2])};
}

Score score_of(const RepairState& state, const EdgeKey& e, const FaceKey& face) {
  int bad = 0;
  for (const EdgeKey& x : edges_of_face(face)) bad += badness(code_of(state, x));
  return {bad, turning_around(state, e)};
}

struct Unzip {
  FaceKey face;
  Rotation target;
};

bool unzip(RepairState& state, const EdgeKey& e, const Unzip& u) {
  ZipPatch patch;
  patch.faces = {u.face};
  patch.start = e;
  for (const EdgeKey& x : edges_of_face(u.face)) patch.boundary.push_back(x);
  ZipOptions options;
  options.allow_half_turns = true;
  return zip_patch(state, patch, u.target, options);
}

// Tries all of them and does the best again, if `accept` takes any.
template <class Accept>
bool best_unzip(RepairState& state, const EdgeKey& e, const std::vector<Unzip>& candidates, const Accept& accept) {
  std::optional<Unzip> best;
  Score least;
  for (const Unzip& u : candidates) {
    const FieldSnapshot before(state, tets_touching(state.mesh, std::span(&u.face, 1)));
    state.begin_operation(work_of_zipping);
    if (!unzip(state, e, u)) continue;
    if (accept()) {
      const Score score = score_of(state, e, u.face);
      if (!best || score < least) best = u, least = score;
    }
    before.restore(state);
  }
  return best && unzip(state, e, *best);
}

// All targets that leave a quarter-turn to the new arc.
std::vector<Unzip> factorisations(const std::vector<FaceKey>& faces, Rotation monodromy, bool half_turns) {
  std::vector<Unzip> candidates;
  for (const FaceKey& f : faces)
    for (Rotation target = 1; octahedral::is_axial(target); ++target) {
      if (is_half_turn(target) != half_turns) continue;
      if (is_quarter_turn(octahedral::product(octahedral::inverse(target), monodromy)))
        candidates.push_back({f, target});
    }
  return candidates;
}

}  // namespace

bool repair_compound_edge(RepairState& state, const EdgeKey& edge) {
  if (code_of(state, edge) != compound_code) return false;
  EdgeRing ring = ring_of(state.mesh, edge[0], edge[1]);
  if (!ring.closed) return false;
  const std::vector<FaceKey> faces = faces_to_unzip(state, edge, ring.tets, ring.crossings);
  const Rotation m = monodromy(state.field, ring_of(state.mesh, edge[0], edge[1]));
  auto mended = [&] { return code_of(state, edge) != compound_code; };
  return best_unzip(state, edge, factorisations(faces, m, is_half_turn(m)), mended);
}

bool lower_index(RepairState& state, const EdgeKey& edge) {
  const EdgeCode code = code_of(state, edge);
  if (code == compound_code || code == undetermined_code || std::abs(code) < 2) return false;
  const EdgeRing ring = ring_of(state.mesh, edge[0], edge[1]);
  if (!ring.closed) return false;
  const std::vector<FaceKey> faces = faces_to_unzip(state, edge, ring.tets, ring.crossings);
  const Rotation m = monodromy(state.field, ring_of(state.mesh, edge[0], edge[1]));
  const bool half_turns = std::abs(code) == 3;
  auto lowered = [&] {
    const EdgeCode now = code_of(state, edge);
    return now != compound_code && now != undetermined_code && std::abs(now) < std::abs(code);
  };
  return best_unzip(state, edge, factorisations(faces, m, half_turns), lowered);
}

namespace {

std::vector<Sector> sectors_at(const RepairState& state, const EdgeKey& e) {
  const EdgeRing ring = ring_of(state.mesh, e[0], e[1]);
  return sectors(state.mesh, state.features, state.field, ring, e[0], e[1]);
}

bool crosses(const TetMesh& mesh, const Sector& s, const FaceKey& face) {
  return std::any_of(s.crossings.begin(), s.crossings.end(), [&](HalfFaceId h) { return mesh.key(h) == face; });
}

// Gives the sector `by` more quads and leaves all others.
bool change_sector(RepairState& state, const EdgeKey& edge, const Sector& sector, int by) {
  const std::vector<FaceKey> faces = faces_to_unzip(state, edge, sector.tets, sector.crossings);
  const std::vector<Sector> before = sectors_at(state, edge);  // a split may have made the ring start elsewhere
  const Rotation m = closed_monodromy(state, ring_of(state.mesh, edge[0], edge[1]), edge[0], edge[1]);
  std::vector<Unzip> candidates;
  for (const FaceKey& f : faces)
    for (octahedral::Label l = 0; l < 6; ++l)
      candidates.push_back({f, octahedral::product(m, octahedral::quarter_turn(l))});
  return best_unzip(state, edge, candidates, [&] {
    const std::vector<Sector> after = sectors_at(state, edge);
    for (std::size_t i = 0; i < after.size(); ++i) {
      const bool the_one = crosses(state.mesh, before[i], faces[0]);
      if (after[i].quads != before[i].quads + (the_one ? by : 0)) return false;
    }
    return true;
  });
}

}  // namespace

bool repair_sectors(RepairState& state, const EdgeKey& edge) {
  const std::vector<Sector> all = sectors_at(state, edge);
  const auto found = std::find_if(all.begin(), all.end(), [](const Sector& s) { return s.quads < 1; });
  if (found != all.end()) return change_sector(state, edge, *found, 1);
  if (const EdgeCode code = code_of(state, edge); code < 2 || code == compound_code || code == undetermined_code)
    return false;
  const auto wide = std::find_if(all.begin(), all.end(),
                                 [](const Sector& s) { return s.quads >= 4 && s.quads != undetermined_code; });
  return wide != all.end() && change_sector(state, edge, *wide, -1);
}

bool lift_from_surface(RepairState& state, const EdgeKey& edge) {
  const EdgeCode code = code_of(state, edge);
  if (code == 0 || code == compound_code || state.features.edges.contains(edge)) return false;
  const EdgeRing ring = ring_of(state.mesh, edge[0], edge[1]);
  const std::vector<Sector> between = sectors_at(state, edge);
  auto quads = [](const std::vector<Sector>& all) {
    int sum = 0;
    for (const Sector& s : all) sum += s.quads;
    return sum;
  };
  if (!ring.closed || between.empty() || quads(between) == 4 + code) return false;
  std::vector<Unzip> candidates;
  for (const Sector& s : between)
    for (const FaceKey& f : faces_to_unzip(state, edge, s.tets, s.crossings))
      candidates.push_back({f, octahedral::identity});
  return best_unzip(state, edge, candidates,
                    [&] { return code_of(state, edge) == 0 && quads(sectors_at(state, edge)) == 4; });
}

bool remove_singular_triangle(RepairState& state, const FaceKey& face) {
  const HalfFaceId h = find_half_face(state.mesh, face);
  if (!h.valid() || is_feature_face(state, h)) return false;
  const auto edges = edges_of_face(face);
  for (const EdgeKey& e : edges)
    if (!state.codes.contains(e) || state.features.edges.contains(e) || !ring_of(state.mesh, e[0], e[1]).closed)
      return false;
  const FieldSnapshot before(state, tets_touching(state.mesh, std::span(&face, 1)));
  state.begin_operation(work_of_zipping);
  if (!unzip(state, edges[0], {face, octahedral::identity})) return false;
  if (std::none_of(edges.begin(), edges.end(), [&](const EdgeKey& e) { return state.codes.contains(e); })) return true;
  before.restore(state);
  return false;
}

}  // namespace hexfield
