#pragma once

#include <cstdint>

#include "chart_mesh.hpp"

namespace hexfield::quantize {

/// The walls of the motorcycle complex, spread like fire from ignition edges at unit speed until they meet what is
/// burnt already (spec-quantization 3.1 and 3.2). Ties of the distance are broken by the order of ignition.
class BrushFire {
 public:
  explicit BrushFire(ChartMesh& mesh) : mesh_(mesh) {}

  /// Ignites singular edges (inner ones, and boundary edges of three or more quarter-turns), feature edges, and the
  /// edges along an axis at feature vertices.
  void ignite_sources();
  /// Ignites edge (b, c) inside tet t: the wall through it on which coordinate `axis` of t's chart is constant.
  void ignite(std::int32_t t, std::int32_t b, std::int32_t c, int axis);
  /// Burns until no front is left. Throws Error when a chart is degenerate.
  void burn();

 private:
  struct Front {
    std::int32_t tet, b, c;
    int iso, travel;
    double q, origin;        // iso value, coordinate of the source on the travel axis; grid units
    double burnt, straight;  // distance travelled, and straight from the source
    std::int64_t serial;
    bool operator>(const Front& other) const {
      return burnt != other.burnt ? burnt > other.burnt : serial > other.serial;
    }
  };
  class Queue {
   public:
    bool empty() const { return fronts_.empty(); }
    void push(const Front& front);
    Front pop();

   private:
    std::vector<Front> fronts_;  // a heap
  };

  void visit(const Front& front, std::int32_t t, std::int32_t b, std::int32_t c);
  void burn_tet(Front front);
  void spread(const Front& front, std::int32_t wall, std::int32_t b, std::int32_t c);

  ChartMesh& mesh_;
  Queue global_, local_;
  std::int64_t serial_ = 0;
};

}  // namespace hexfield::quantize
