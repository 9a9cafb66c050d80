#pragma once

#include <string>
#include <string_view>

namespace hexfield::io {

/// How the binary data arrays of a VTK XML file are stored.
struct VtuEncoding {
  bool base64 = true;        ///< else raw
  bool zlib = false;         ///< in blocks
  bool long_header = false;  ///< sizes are 64 bit, else 32
  bool swap = false;         ///< of the other byte order than this machine's
};

/// The bytes of a data array that begins at the front of `data`: its sizes, then the values, both decoded and
/// decompressed. `what` (with the name of the file in front) begins the sentence of Error(bad_input).
std::string vtu_bytes(std::string_view data, const VtuEncoding& encoding, const std::string& what);

}  // namespace hexfield::io
