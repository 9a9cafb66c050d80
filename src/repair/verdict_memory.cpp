#include "link_map.hpp"

namespace hexfield {
namespace {

// The finaliser of splitmix64 (Steele, Lea and Flood 2014) over a running state.
class Hash {
 public:
  void add(std::uint64_t value) {
    std::uint64_t z = state_ ^ (value + 0x9E3779B97F4A7C15u + (state_ << 6) + (state_ >> 2));
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    state_ = z ^ (z >> 31);
  }
  void add(int value) { add(static_cast<std::uint64_t>(static_cast<std::int64_t>(value))); }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0;
};

}  // namespace

std::optional<VertexVerdict> VerdictMemory::find(Key key) const {
  const auto found = verdicts_.find(key);
  return found == verdicts_.end() ? std::nullopt : std::optional(found->second);
}

VerdictMemory VerdictMemory::found() const {
  VerdictMemory good;
  for (const auto& [key, verdict] : verdicts_)
    if (verdict != VertexVerdict::not_meshable) good.note(key, verdict);
  return good;
}

VerdictMemory::Key structure_hash(const Link& link) {
  Hash hash;
  hash.add(static_cast<std::uint64_t>(link.vertices.size()));
  for (const LinkVertex& v : link.vertices) hash.add(v.free[0] + 2 * v.free[1] + 4 * v.free[2]);
  hash.add(static_cast<std::uint64_t>(link.triangles.size()));
  for (const LinkTriangle& t : link.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      hash.add(t.vertex[k]);
      hash.add(t.across[k]);
      hash.add((t.to_tet[k] * 32 + t.from_chart[k]) * 256 + t.normal[k]);
    }
  for (const LinkSector& s : link.sectors) {
    hash.add(s.quads);
    hash.add(static_cast<std::uint64_t>(s.corners.size()));
    for (int c : s.corners) hash.add(c);
  }
  return hash.value();
}

}  // namespace hexfield
