#include "input_report.hpp"

#include <fmt/format.h>

#include "hexfield/base/error.hpp"

namespace hexfield {

std::vector<std::int64_t> InputReport::vertex_ids(std::span<const VertexId> vertices) const {
  std::vector<std::int64_t> ids;
  for (VertexId v : vertices) ids.push_back(vertex_id(v));
  return ids;
}

Vec3 InputReport::place(std::span<const VertexId> vertices) const {
  Vec3 sum = Vec3::Zero();
  int n = 0;
  for (VertexId v : vertices)
    if (v.valid() && v.index() < points_.size()) sum += points_[v.index()], ++n;
  return n > 0 ? Vec3(sum / n) : sum;
}

std::string InputReport::text(const Vec3& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x(), p.y(), p.z()); }

void InputReport::finish() {
  if (count_ > limit) found_.back().sentence += fmt::format(" And {} more {}.", count_ - limit, many_);
  count_ = 0;
}

void InputReport::start(const char* many) {
  finish();
  many_ = many;
}

void InputReport::add(std::string sentence, std::vector<std::int64_t> ids, std::vector<Vec3> places) {
  if (++count_ <= limit) found_.push_back({std::move(sentence), std::move(ids), std::move(places)});
}

std::vector<Violation> InputReport::take() {
  finish();
  return std::move(found_);
}

void require_valid_input(const std::string& source, const std::vector<Violation>& violations) {
  if (violations.empty()) return;
  const Violation& first = violations.front();
  std::string sentence = fmt::format("{}: {}", source, first.sentence);
  if (violations.size() > 1) {
    sentence.back() = ' ';  // the full stop
    sentence += fmt::format("({} more {} found).", violations.size() - 1,
                            violations.size() == 2 ? "defect was" : "defects were");
  }
  throw Error(ExitCode::bad_input, sentence, first.ids, first.places);
}

}  // namespace hexfield
