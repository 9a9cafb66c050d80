#include "node_measure.hpp"

namespace hexfield::hex {

int NodeMeasure::operator()(const SphereTriangulation& sphere) {
  if (vertex_type(sphere) != VertexType::node && sphere.max_degree() <= final_valence_) return 0;
  const std::string code = canonical_code(sphere);
  if (const auto found = known_.find(code); found != known_.end()) return found->second;
  int value = 0;
  if (const auto row = cut_table().find(code); row != cut_table().end()) {
    value = final_valence_ <= 5 ? row->second.splits_to_5 : row->second.splits_to_6;
  } else if (sphere.max_degree() >= 6) {
    // A longer curve of high valence is cut in two of about half; its halves are smaller in every case.
    known_[code] = 2 * sphere.size();  // where a base case leads back
    const SphereSplit halves = split(sphere, general_cut(sphere));
    value = 1 + (*this)(halves.left) + (*this)(halves.right);
  }
  known_[code] = value;
  return value;
}

}  // namespace hexfield::hex
