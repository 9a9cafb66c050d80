#pragma once

#include <cstdint>
#include <exception>
#include <string>
#include <vector>

#include "hexfield/base/geometry.hpp"

namespace hexfield {

/// Exit codes of the program (DESIGN section 6); a library Error carries one of them.
enum class ExitCode : int {
  success = 0,
  usage = 2,
  bad_input = 3,
  not_meshable = 4,
  no_seamless_map = 5,
  no_integer_grid_map = 6,
  bad_hex_mesh = 7,
  stopped = 9,
  bug = 70,
};

/// A failure said in one sentence that names file, entity ids and coordinates where there are any.
class Error : public std::exception {
 public:
  Error(ExitCode code, std::string sentence, std::vector<std::int64_t> ids = {}, std::vector<Vec3> places = {});

  const char* what() const noexcept override { return sentence_.c_str(); }
  ExitCode code() const { return code_; }
  const std::string& sentence() const { return sentence_; }
  /// Ids of the offending entities, in the numbering that the sentence names.
  const std::vector<std::int64_t>& ids() const { return ids_; }
  /// Where the offending entities are, in the coordinates of the input mesh.
  const std::vector<Vec3>& places() const { return places_; }

 private:
  ExitCode code_;
  std::string sentence_;
  std::vector<std::int64_t> ids_;
  std::vector<Vec3> places_;
};

/// One violated invariant found by a check() function.
struct Violation {
  std::string sentence;
  std::vector<std::int64_t> ids;
  std::vector<Vec3> places;
};

/// Throws Error(bug) when `holds` is false; for invariants that only a defect of this program can break.
void require(bool holds, const char* sentence);

}  // namespace hexfield
