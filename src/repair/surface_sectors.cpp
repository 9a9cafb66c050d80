#include <algorithm>
#include <cmath>
#include <map>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/repair/one_ring.hpp"
#include "hexfield/repair/state_ops.hpp"

namespace hexfield {
namespace {

using octahedral::Label;

// The surface on one side of an edge at the centre: from the half-face clockwise of it to the one counter-clockwise.
struct Hinge {
  Sector sector;
  VertexId end;
};

std::map<HalfFaceId, Hinge> hinges_at(const RepairState& state, VertexId centre) {
  std::map<HalfFaceId, Hinge> hinges;
  for (const EdgeKey& e : edges_at(state.mesh, centre)) {
    const VertexId end = e[0] == centre ? e[1] : e[0];
    const EdgeRing ring = ring_of(state.mesh, centre, end);
    for (const Sector& s : sectors(state.mesh, state.features, state.field, ring, centre, end))
      hinges[s.first] = {s, end};
  }
  return hinges;
}

double angle_at(const TetMesh& mesh, HalfFaceId h, VertexId v) {
  const auto f = mesh.face_vertices(h);
  std::array<Vec3, 2> arms;
  std::size_t n = 0;
  for (VertexId w : f)
    if (w != v) arms[n++] = (mesh.point(w) - mesh.point(v)).normalized();
  return std::acos(std::clamp(arms[0].dot(arms[1]), -1.0, 1.0));
}

// Quarter-turns from a to b about n; -1 when one of them is parallel to n.
int quarter_turns(Label a, Label b, Label n) {
  if (octahedral::axis(a) == octahedral::axis(n) || octahedral::axis(b) == octahedral::axis(n)) return -1;
  for (int k = 0; k < 4; ++k) {
    if (a == b) return k;
    a = octahedral::image(octahedral::quarter_turn(n), a);
  }
  return -1;
}

// Walks from the spoke counter-clockwise about the outward normal to the next spoke.
SurfaceSector walk(const RepairState& state, const OneRing& ring, const std::map<HalfFaceId, Hinge>& hinges,
                   const Hinge& start) {
  SurfaceSector found;
  found.first = start.end;
  HalfFaceId face = start.sector.last;
  Label label = ring.spoke(start.end)->label_in(face.tet());
  for (;;) {
    found.faces.push_back(face);
    found.angle += angle_at(state.mesh, face, ring.centre());
    const Hinge& hinge = hinges.at(face);
    if (const Spoke* spoke = ring.spoke(hinge.end)) {
      found.last = hinge.end;
      const Label normal = closest_label(state.field.frames[face.tet().index()], outward_normal(state.mesh, face));
      const Label other = spoke->label_in(face.tet());
      const bool known = label != octahedral::no_label && other != octahedral::no_label;
      const int turns = known ? quarter_turns(label, other, normal) : -1;
      const double wanted = found.angle / (M_PI / 2);
      found.quads = turns < 0 ? undetermined_code : turns + 4 * static_cast<int>(std::lround((wanted - turns) / 4));
      return found;
    }
    for (HalfFaceId h : hinge.sector.crossings)
      if (label != octahedral::no_label) label = transport(state.field, h, label);
    face = hinge.sector.last;
  }
}

}  // namespace

std::vector<SurfaceSector> surface_sectors(const RepairState& state, const OneRing& ring) {
  const auto hinges = hinges_at(state, ring.centre());
  std::vector<SurfaceSector> found;
  for (const auto& entry : hinges)
    if (ring.spoke(entry.second.end) != nullptr) found.push_back(walk(state, ring, hinges, entry.second));
  std::sort(found.begin(), found.end(),
            [](const SurfaceSector& a, const SurfaceSector& b) { return a.faces.front() < b.faces.front(); });
  return found;
}

}  // namespace hexfield
