#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace hexfield {

/// A 32-bit index local to one process that cannot be mixed up with an index of another kind.
/// A default-constructed id is invalid (-1).
template <class Tag>
struct Id {
  std::int32_t value = -1;

  constexpr Id() = default;
  constexpr explicit Id(std::int64_t v) : value(static_cast<std::int32_t>(v)) {}
  constexpr bool valid() const { return value >= 0; }
  /// Index into an array; only for valid ids.
  constexpr std::size_t index() const { return static_cast<std::size_t>(value); }
  constexpr auto operator<=>(const Id&) const = default;
};

using VertexId = Id<struct VertexTag>;
using TetId = Id<struct TetTag>;

/// Face `local` (0..3, opposite to local vertex `local`) of tet `tet` is half-face 4 * tet + local.
struct HalfFaceId : Id<struct HalfFaceTag> {
  using Id::Id;
  constexpr HalfFaceId(TetId tet, int local) : Id(4 * static_cast<std::int64_t>(tet.value) + local) {}
  constexpr TetId tet() const { return TetId(value / 4); }
  constexpr int local() const { return value % 4; }
};

}  // namespace hexfield

template <class Tag>
struct std::hash<hexfield::Id<Tag>> {
  std::size_t operator()(hexfield::Id<Tag> id) const noexcept { return std::hash<std::int32_t>{}(id.value); }
};
