#pragma once

#include <optional>

#include "hexfield/map/conforming_space.hpp"
#include "integer_layout.hpp"
#include "wall_cells.hpp"

namespace hexfield::quantize {

/// The integer blocks of a complex laid out in the combed charts of a cut-open mesh (spec-quantization 6): per living
/// tet an integer frame B = R X + T from combed chart to block.
class IntegerFrames {
 public:
  IntegerFrames(const ChartMesh& mesh, const WallCells& cells, const ConformingSpace& space,
                const std::vector<std::int64_t>& lengths);

  /// Values of the integer unknowns of the space.
  std::vector<double> unknowns();

 private:
  using Integer3 = BlockComplex::Integer3;
  struct Frame {
    octahedral::Rotation rotation = 0;
    Integer3 translation{};
  };
  /// A living tet at a corner class, and the vertex's number in it.
  struct Corner {
    std::int32_t tet;
    int local;
  };

  void name_origins();
  void collect_corners();
  void flood();
  void translate_cut();
  /// The frame on the other side of h's wall (or of none), were there no cut: of the combed chart of h's tet.
  Frame across(std::int32_t h) const;
  std::optional<std::int64_t> value(const Corner& corner, int axis) const;
  std::int64_t value_of_class(std::int32_t corner_class, int axis) const;
  std::int64_t interpolated(std::int32_t corner_class, int axis) const;
  std::array<std::int64_t, 3> grid_place(const Corner& corner) const;
  [[noreturn]] void fail(const char* what, std::int32_t t) const;
  HalfFaceId original(std::int32_t h) const {
    return HalfFaceId(static_cast<std::int64_t>(mesh_.tet(h / 4).original[static_cast<std::size_t>(h % 4)]));
  }
  std::size_t input_tet(std::int32_t t) const { return static_cast<std::size_t>(origin_[static_cast<std::size_t>(t)]); }

  const ChartMesh& mesh_;
  const WallCells& cells_;
  const ConformingSpace& space_;
  IntegerLayout layout_;
  std::vector<std::int32_t> origin_;  // per tet of the cut mesh: tet of the input
  std::vector<Frame> frames_;
  std::vector<char> reached_;
  std::vector<std::vector<Corner>> corners_;           // per corner class
  std::vector<std::optional<Integer3>> translations_;  // per cut patch
};

}  // namespace hexfield::quantize
