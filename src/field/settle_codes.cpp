#include "hexfield/field/settle_codes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "hexfield/field/edge_codes.hpp"

namespace hexfield {
namespace {

using octahedral::Rotation;

constexpr double blunt_margin = 20.0 / 90.0;  // of a quad sector: how near to the middle between two counts
constexpr int worst_code = 100;               // compound and undetermined edges weigh more than any others
constexpr int passes = 10;
constexpr double fair_share = 0.2, prevailing_share = 0.75;

class Settling {
 public:
  Settling(const TetMesh& mesh, const Features& features, FrameField& field, EdgeCodes& codes)
      : mesh_(mesh), features_(features), field_(field), codes_(codes) {}

  int run() {
    const auto all = curves();
    int changed = 0;
    for (const std::vector<EdgeKey>& curve : all)
      if (const auto code = prevailing_code(curve)) changed += give_code(curve, *code);
    changed += give_back();
    for (const std::vector<EdgeKey>& curve : all)
      if (const auto code = code_to_agree_on(curve)) changed += give_code(curve, *code);
    return changed;
  }

 private:
  int give_back() {
    int changed = 0;
    for (int pass = 0; pass < passes; ++pass) {
      const int before = changed;
      for (const auto& entry : features_.edges)
        if (!settled_.contains(entry.first)) changed += settle(entry.first);
      if (changed == before) break;
    }
    return changed;
  }

  int settle(const EdgeKey& e) {
    int changed = 0;
    for (HalfFaceId h : blunt_faces(e)) changed += turn_if_better(h, e);
    return changed;
  }

  // Inner faces of the sectors at e that may have a quad more or less.
  std::vector<HalfFaceId> blunt_faces(const EdgeKey& e) const {
    std::vector<HalfFaceId> faces;
    for (const Sector& sector : sectors(mesh_, features_, field_, ring_of(e), e[0], e[1]))
      if (is_blunt(sector)) faces.insert(faces.end(), sector.crossings.begin(), sector.crossings.end());
    return faces;
  }

  // Chains of feature edges between feature points and vertices where other than two meet.
  std::vector<std::vector<EdgeKey>> curves() const {
    std::map<VertexId, std::vector<EdgeKey>> at;
    for (const auto& entry : features_.edges)
      for (VertexId v : entry.first) at[v].push_back(entry.first);
    std::vector<std::vector<EdgeKey>> found;
    std::set<EdgeKey> seen;
    for (const auto& entry : features_.edges) {
      if (!seen.insert(entry.first).second) continue;
      std::vector<EdgeKey>& curve = found.emplace_back(std::vector<EdgeKey>{entry.first});
      for (std::size_t i = 0; i < curve.size(); ++i)
        for (VertexId v : EdgeKey(curve[i]))
          if (at.at(v).size() == 2 && !features_.points.contains(v))
            for (const EdgeKey& next : at.at(v))
              if (seen.insert(next).second) curve.push_back(next);
    }
    return found;
  }

  struct Share {
    double length = 0;
    double distortion = 0;  // mean |log| of the angle per quad over 90 degrees, times length
  };

  Share share_of(const EdgeKey& e) const {
    double angle = 0, quads = 0;
    for (const Sector& s : sectors(mesh_, features_, field_, ring_of(e), e[0], e[1]))
      angle += s.dihedral, quads += s.quads;
    const double length = (mesh_.point(e[1]) - mesh_.point(e[0])).norm();
    return {length, quads > 0 ? length * std::abs(std::log(angle / quads / (M_PI / 2))) : length * worst_code};
  }

  // The code of most of the edges that are not blunt; where all are, of those with a fair share of the curve the one
  // whose quads come nearest to right angles. Nothing when there is one code only.
  std::optional<EdgeCode> code_to_agree_on(const std::vector<EdgeKey>& curve) const {
    std::map<EdgeCode, Share> blunt;
    std::map<EdgeCode, double> angular;
    double length = 0;
    for (const EdgeKey& e : curve) {
      const Share share = share_of(e);
      const EdgeCode code = code_of(e);
      length += share.length;
      if (blunt_faces(e).empty()) angular[code] += share.length;
      blunt[code].length += share.length;
      blunt[code].distortion += share.distortion;
    }
    if (blunt.size() < 2) return {};
    const auto shorter = [](const auto& a, const auto& b) { return a.second < b.second; };
    if (!angular.empty()) return std::ranges::max_element(angular, shorter)->first;
    std::optional<EdgeCode> best;
    double least = 0;
    for (const auto& [code, share] : blunt)
      if (const double mean = share.distortion / share.length;
          share.length > fair_share * length && (!best || mean < least))
        best = code, least = mean;
    return best;
  }

  // The code that nearly all of the curve has; the curve is settled then.
  std::optional<EdgeCode> prevailing_code(const std::vector<EdgeKey>& curve) {
    std::map<EdgeCode, double> lengths;
    double length = 0;
    for (const EdgeKey& e : curve) {
      const double l = (mesh_.point(e[1]) - mesh_.point(e[0])).norm();
      lengths[code_of(e)] += l;
      length += l;
    }
    for (const auto& [code, l] : lengths)
      if (l > prevailing_share * length) {
        settled_.insert(curve.begin(), curve.end());
        return code;
      }
    return {};
  }

  int give_code(const std::vector<EdgeKey>& curve, EdgeCode code) {
    int changed = 0;
    for (const EdgeKey& e : curve)
      if (code_of(e) != code) changed += turn_to_code(e, code);
    return changed;
  }

  // The face and turn that give e the code and leave the least singular edges.
  bool turn_to_code(const EdgeKey& e, EdgeCode wanted) {
    std::optional<std::pair<HalfFaceId, Rotation>> best;
    int least = worst_code;
    for (HalfFaceId h : blunt_faces(e)) {
      const Rotation old = field_.matching(h);
      for (const Rotation turned : turns(h, e)) {
        set_matching(h, turned);
        const int weight = weight_of(h);
        if (code_of(e) != wanted || weight >= least || !count_is_near(e)) continue;
        least = weight;
        best = {h, turned};
      }
      set_matching(h, old);
    }
    if (!best) return false;
    set_matching(best->first, best->second);
    update_codes(best->first);
    return true;
  }

  // The matching of h with a quarter-turn more about e, either way.
  std::array<Rotation, 2> turns(HalfFaceId h, const EdgeKey& e) const {
    const auto label = closest_label(field_.frames[h.tet().index()], mesh_.point(e[1]) - mesh_.point(e[0]));
    const Rotation old = field_.matching(h);
    return {octahedral::product(octahedral::quarter_turn(label), old),
            octahedral::product(octahedral::quarter_turn(octahedral::negate(label)), old)};
  }

  static bool is_blunt(const Sector& sector) {
    const double quads = sector.dihedral / (M_PI / 2);
    return std::abs(quads - std::floor(quads) - 0.5) < blunt_margin;
  }

  bool turn_if_better(HalfFaceId h, const EdgeKey& e) {
    const Rotation old = field_.matching(h);
    const int before = weight_of(h);
    for (const Rotation turned : turns(h, e)) {
      set_matching(h, turned);
      if (weight_of(h) < before && count_is_near(e)) {
        update_codes(h);
        return true;
      }
    }
    set_matching(h, old);
    return false;
  }

  // One of the two counts of quads next to every dihedral angle at the edge.
  bool count_is_near(const EdgeKey& e) const {
    return std::ranges::all_of(sectors(mesh_, features_, field_, ring_of(e), e[0], e[1]), [](const Sector& s) {
      return s.quads != undetermined_code && std::abs(s.quads - s.dihedral / (M_PI / 2)) < 0.5 + blunt_margin;
    });
  }

  int weight_of(HalfFaceId h) const {
    int weight = 0;
    for (const EdgeKey& e : edges_of(h)) weight += std::min(worst_code, std::abs(code_of(e)));
    return weight;
  }

  void update_codes(HalfFaceId h) {
    for (const EdgeKey& e : edges_of(h)) {
      codes_.erase(e);
      if (const EdgeCode code = code_of(e); code != 0) codes_[e] = code;
    }
  }

  std::array<EdgeKey, 3> edges_of(HalfFaceId h) const {
    const auto v = mesh_.face_vertices(h);
    return {edge_key(v[0], v[1]), edge_key(v[1], v[2]), edge_key(v[2], v[0])};
  }

  EdgeRing ring_of(const EdgeKey& e) const {
    return edge_ring(mesh_, find_tet_with_edge(mesh_, e[0], e[1]), e[0], e[1]);
  }

  EdgeCode code_of(const EdgeKey& e) const { return edge_code(mesh_, features_, field_, ring_of(e), e[0], e[1]); }

  void set_matching(HalfFaceId h, Rotation matching) {
    const HalfFaceId o = mesh_.opposite_half_face(h);
    field_.matchings[h.tet().index()][static_cast<std::size_t>(h.local())] = matching;
    field_.matchings[o.tet().index()][static_cast<std::size_t>(o.local())] = octahedral::inverse(matching);
  }

  const TetMesh& mesh_;
  const Features& features_;
  FrameField& field_;
  EdgeCodes& codes_;
  std::set<EdgeKey> settled_;
};

}  // namespace

int settle_blunt_edges(const TetMesh& mesh, const Features& features, FrameField& field, EdgeCodes& codes) {
  return Settling(mesh, features, field, codes).run();
}

}  // namespace hexfield
