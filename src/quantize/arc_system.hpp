#pragma once

#include "hexfield/quantize/quantization.hpp"

namespace hexfield::quantize {

/// Sum of coefficient * length over arcs (or bundles), sorted by arc, without zeros.
using ArcSum = std::vector<std::pair<std::int32_t, int>>;

ArcSum sorted_sum(ArcSum terms);
/// Its value for integer lengths.
std::int64_t value_of(const ArcSum& sum, const std::vector<std::int64_t>& lengths);

/// A chain of singular or feature arcs between critical nodes, walked from its first node (spec 4.3).
struct Link {
  std::vector<std::int32_t> arcs;
  std::vector<std::int32_t> nodes;  ///< one more than arcs; the first again at the end when closed
  bool closed = false;
};

/// Critical entities and what they demand (spec-quantization 4.3).
struct CriticalSet {
  std::vector<char> nodes, arcs, patches;
  std::vector<Link> links;
  std::vector<ArcSum> statics;  ///< each at least 1: links, and boundary or feature regions
};
CriticalSet critical_set(const BlockComplex& complex);

/// Arcs that single-arc sides of patches force to be equal are one bundle; the other patch equations (spec 4.1, 5).
struct BundleSystem {
  std::vector<std::int32_t> bundle;  ///< per arc
  std::vector<double> size;          ///< arcs per bundle
  std::vector<double> target;        ///< scaled real length per bundle
  std::vector<ArcSum> equations;     ///< each 0, over bundles

  std::size_t num_bundles() const { return size.size(); }
  ArcSum on_bundles(const ArcSum& arcs) const;
  std::vector<std::int64_t> on_arcs(const std::vector<std::int64_t>& bundles) const;
};
BundleSystem bundle_system(const BlockComplex& complex, double scale);

}  // namespace hexfield::quantize
