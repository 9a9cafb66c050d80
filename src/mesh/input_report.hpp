#pragma once

#include <span>
#include <string>
#include <vector>

#include "hexfield/mesh/input_check.hpp"

namespace hexfield {

/// Raw input under inspection, and the list of what is wrong with it.
class InputReport {
 public:
  InputReport(const std::vector<Vec3>& points, const InputIds& ids) : points_(points), ids_(ids) {}

  std::int64_t vertex_id(VertexId v) const { return ids_.vertex ? ids_.vertex(v.value) : v.value; }
  std::int64_t tet_id(std::size_t t) const {
    const auto index = static_cast<std::int64_t>(t);
    return ids_.tet ? ids_.tet(index) : index;
  }
  std::vector<std::int64_t> vertex_ids(std::span<const VertexId> vertices) const;
  /// Mean of the vertices as "(x, y, z)"; ids out of range are left out.
  Vec3 place(std::span<const VertexId> vertices) const;
  static std::string text(const Vec3& p);

  /// Starts a new kind of defect: `many` names it in "... and N more <many>".
  void start(const char* many);
  void add(std::string sentence, std::vector<std::int64_t> ids, std::vector<Vec3> places);
  /// Ends the last kind and hands over the list.
  std::vector<Violation> take();
  bool empty() const { return found_.empty(); }

 private:
  static constexpr std::size_t limit = 1000;
  void finish();

  const std::vector<Vec3>& points_;
  const InputIds& ids_;
  std::vector<Violation> found_;
  const char* many_ = "";
  std::size_t count_ = 0;
};

/// Coincident and hanging vertices of the boundary; `outside` are the faces that only one tet has.
void check_cracks(const std::vector<Vec3>& points, const std::vector<FaceKey>& outside, InputReport& report);

}  // namespace hexfield
