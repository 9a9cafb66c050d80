#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scanner.hpp"

namespace hexfield::io {

/// Number types of legacy VTK files.
enum class VtkType { bit, i8, u8, i16, u16, i32, u32, i64, u64, f32, f64, text };

/// Type of a VTK type name; fails at the scanner's place when there is none of that name.
VtkType vtk_type(const Scanner& in, std::string_view name);
bool is_integer(VtkType type);

/// Reads the data arrays of a legacy VTK file, ASCII or big-endian binary.
class VtkArrays {
 public:
  VtkArrays(Scanner& in, bool binary) : in_(in), binary_(binary) { in.swap_bytes(!big_endian_machine); }

  /// Refuses a number of values that the rest of the file cannot hold.
  void check_size(std::int64_t n, VtkType type, const char* what) const;
  std::vector<double> reals(std::int64_t n, VtkType type, const char* what);
  std::vector<std::int64_t> integers(std::int64_t n, VtkType type, const char* what);
  void skip(std::int64_t n, VtkType type, const char* what);

 private:
  double real(VtkType type, const char* what);
  std::int64_t integer(VtkType type, const char* what);
  void skip_text(std::int64_t n, const char* what);

  Scanner& in_;
  bool binary_;
};

}  // namespace hexfield::io
