#include "vtk_arrays.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace hexfield::io {
namespace {

std::size_t bytes_of(VtkType type) {
  switch (type) {
    case VtkType::i8:
    case VtkType::u8:
    case VtkType::text:
      return 1;
    case VtkType::i16:
    case VtkType::u16:
      return 2;
    case VtkType::i32:
    case VtkType::u32:
    case VtkType::f32:
      return 4;
    case VtkType::i64:
    case VtkType::u64:
    case VtkType::f64:
      return 8;
    case VtkType::bit:
      return 0;
  }
  return 0;
}

}  // namespace

VtkType vtk_type(const Scanner& in, std::string_view name) {
  // vtkIdType is written as int by VTK's own legacy writer.
  static constexpr std::pair<std::string_view, VtkType> names[] = {{"double", VtkType::f64},
                                                                   {"float", VtkType::f32},
                                                                   {"int", VtkType::i32},
                                                                   {"vtktypeint64", VtkType::i64},
                                                                   {"long", VtkType::i64},
                                                                   {"vtkidtype", VtkType::i32},
                                                                   {"unsigned_char", VtkType::u8},
                                                                   {"char", VtkType::i8},
                                                                   {"signed_char", VtkType::i8},
                                                                   {"unsigned_short", VtkType::u16},
                                                                   {"short", VtkType::i16},
                                                                   {"unsigned_int", VtkType::u32},
                                                                   {"unsigned_long", VtkType::u64},
                                                                   {"vtktypeuint64", VtkType::u64},
                                                                   {"long_long", VtkType::i64},
                                                                   {"vtktypeint8", VtkType::i8},
                                                                   {"vtktypeuint8", VtkType::u8},
                                                                   {"vtktypeint16", VtkType::i16},
                                                                   {"vtktypeuint16", VtkType::u16},
                                                                   {"vtktypeint32", VtkType::i32},
                                                                   {"vtktypeuint32", VtkType::u32},
                                                                   {"vtktypefloat32", VtkType::f32},
                                                                   {"vtktypefloat64", VtkType::f64},
                                                                   {"bit", VtkType::bit},
                                                                   {"string", VtkType::text}};
  const std::string wanted = lower(name);
  for (const auto& [text, type] : names)
    if (text == wanted) return type;
  in.fail(fmt::format("\"{}\" is no VTK number type", printable(name)));
}

bool is_integer(VtkType type) {
  return type != VtkType::f32 && type != VtkType::f64 && type != VtkType::text && type != VtkType::bit;
}

void VtkArrays::check_size(std::int64_t n, VtkType type, const char* what) const {
  if (type == VtkType::bit)
    in_.check_count(n < 0 ? n : n / 8, what, 1);
  else
    in_.check_count(n, what, binary_ || type == VtkType::text ? bytes_of(type) : 2);
}

std::vector<double> VtkArrays::reals(std::int64_t n, VtkType type, const char* what) {
  check_size(n, type, what);
  std::vector<double> values(static_cast<std::size_t>(n));
  for (double& value : values) value = real(type, what);
  return values;
}

std::vector<std::int64_t> VtkArrays::integers(std::int64_t n, VtkType type, const char* what) {
  check_size(n, type, what);
  std::vector<std::int64_t> values(static_cast<std::size_t>(n));
  for (std::int64_t& value : values) value = integer(type, what);
  return values;
}

double VtkArrays::real(VtkType type, const char* what) {
  if (!binary_) return in_.real(what);
  if (type == VtkType::f64) return in_.binary<double>(what);
  if (type == VtkType::f32) return static_cast<double>(in_.binary<float>(what));
  return static_cast<double>(integer(type, what));
}

std::int64_t VtkArrays::integer(VtkType type, const char* what) {
  if (type == VtkType::f32 || type == VtkType::f64) {
    const double value = real(type, what);
    if (!(std::abs(value) < 9e15) || value != std::floor(value))
      in_.fail(fmt::format("{} is no integer, where {} is expected", value, what));
    return static_cast<std::int64_t>(value);
  }
  if (!binary_) return in_.integer(what);
  switch (type) {
    case VtkType::i8:
      return in_.binary<std::int8_t>(what);
    case VtkType::u8:
      return in_.binary<std::uint8_t>(what);
    case VtkType::i16:
      return in_.binary<std::int16_t>(what);
    case VtkType::u16:
      return in_.binary<std::uint16_t>(what);
    case VtkType::i32:
      return in_.binary<std::int32_t>(what);
    case VtkType::u32:
      return in_.binary<std::uint32_t>(what);
    case VtkType::i64:
      return in_.binary<std::int64_t>(what);
    case VtkType::u64: {
      const auto value = in_.binary<std::uint64_t>(what);
      if (value > static_cast<std::uint64_t>(INT64_MAX)) in_.fail(fmt::format("{} is too large for {}", value, what));
      return static_cast<std::int64_t>(value);
    }
    default:
      in_.fail(fmt::format("{} cannot be read from bits or strings", what));
  }
}

void VtkArrays::skip(std::int64_t n, VtkType type, const char* what) {
  check_size(n, type, what);
  if (type == VtkType::text) return skip_text(n, what);
  if (binary_) {
    const auto count = static_cast<std::size_t>(n);
    in_.skip_bytes(type == VtkType::bit ? (count + 7) / 8 : count * bytes_of(type), what);
    return;
  }
  for (std::int64_t i = 0; i < n; ++i) in_.token(what);
}

// Binary strings: the upper two bits of the first byte tell the size of the length (3: 1 byte, 2: 2, 1: 4, 0: 8).
void VtkArrays::skip_text(std::int64_t n, const char* what) {
  for (std::int64_t i = 0; i < n; ++i) {
    if (!binary_) {
      in_.line();
      continue;
    }
    std::uint64_t length = in_.binary<std::uint8_t>(what);
    const int kind = static_cast<int>(length >> 6);
    length &= 63;
    const int more = kind == 3 ? 0 : kind == 2 ? 1 : kind == 1 ? 3 : 7;
    for (int k = 0; k < more; ++k) length = (length << 8) | in_.binary<std::uint8_t>(what);
    in_.skip_bytes(length, what);
  }
}

}  // namespace hexfield::io
