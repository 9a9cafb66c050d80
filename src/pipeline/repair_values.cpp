#include "repair_values.hpp"

#include <fmt/format.h>

#include <sstream>

#include "hexfield/base/error.hpp"
#include "hexfield/io/checkpoint_values.hpp"

namespace hexfield {
namespace {

void require_same(bool holds, const std::string& what) {
  if (!holds) throw Error(ExitCode::bad_input, fmt::format("The checkpoint contradicts itself: {}.", what));
}

// A report as lines "number name"; names have no end of line.
class ReportLines {
 public:
  void add(const std::string& name, double value) { text_ += fmt::format("{} {}\n", value, name); }
  template <class T>
  void add(const std::string& prefix, const std::map<std::string, T>& values) {
    for (const auto& [name, value] : values) add(prefix + name, static_cast<double>(value));
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

template <class T>
void take(const std::map<std::string, double>& lines, const std::string& prefix, std::map<std::string, T>& values) {
  for (auto it = lines.lower_bound(prefix); it != lines.end() && it->first.starts_with(prefix); ++it)
    values[it->first.substr(prefix.size())] = static_cast<T>(it->second);
}

void add_counts(ReportLines& lines, const std::string& when, const DefectCounts& counts) {
  lines.add(when + "/edges", static_cast<double>(counts.edges));
  lines.add(when + "/vertices", static_cast<double>(counts.vertices));
  lines.add(when + "/kind/", counts.kinds);
}

DefectCounts counts_from(const std::map<std::string, double>& lines, const std::string& when) {
  const auto number = [&](const std::string& name) {
    const auto found = lines.find(name);
    require_same(found != lines.end(), fmt::format("its repair report has no {}", name));
    return static_cast<std::size_t>(found->second);
  };
  DefectCounts counts{number(when + "/edges"), number(when + "/vertices"), {}};
  take(lines, when + "/kind/", counts.kinds);
  return counts;
}

std::string text_of(const RepairReport& report) {
  ReportLines lines;
  add_counts(lines, "before", report.before);
  add_counts(lines, "after", report.after);
  lines.add("operation/", report.operations);
  lines.add("seconds/", report.seconds);
  lines.add("iterations", report.iterations);
  lines.add("work", static_cast<double>(report.work));
  return lines.text();
}

RepairReport report_from(const std::string& text) {
  std::map<std::string, double> lines;
  std::istringstream stream(text);
  double value = 0;
  for (std::string name; stream >> value && std::getline(stream >> std::ws, name);) lines[name] = value;
  RepairReport report;
  report.before = counts_from(lines, "before");
  report.after = counts_from(lines, "after");
  take(lines, "operation/", report.operations);
  take(lines, "seconds/", report.seconds);
  report.iterations = static_cast<int>(lines["iterations"]);
  report.work = static_cast<long>(lines["work"]);
  return report;
}

std::vector<std::int32_t> rows_of(const std::map<EdgeKey, int>& values) {
  std::vector<std::int32_t> rows;
  for (const auto& [e, value] : values) rows.insert(rows.end(), {e[0].value, e[1].value, value});
  return rows;
}

std::vector<std::int32_t> rows_of(const std::set<EdgeKey>& edges) {
  std::vector<std::int32_t> rows;
  for (const EdgeKey& e : edges) rows.insert(rows.end(), {e[0].value, e[1].value});
  return rows;
}

}  // namespace

NamedArrays pack_repair(const FieldResult& field, const RepairReport& report) {
  NamedArrays arrays = pack(field);
  arrays.own_text("repair_report", text_of(report));
  return arrays;
}

RepairResult unpack_repair(const NamedArrays& arrays) {
  return {unpack_field(arrays), report_from(arrays.text("repair_report"))};
}

NamedArrays pack(const RepairIterate& iterate) {
  NamedArrays arrays = pack(static_cast<const FieldResult&>(iterate.state));
  arrays.view<double>("target_length", iterate.state.target_length, 1);
  arrays.own("pairs", rows_of(iterate.state.pairs), 3);
  arrays.own("kept", rows_of(iterate.state.kept), 2);
  arrays.own(
      "weights",
      std::vector<double>{iterate.compound_shrink, iterate.zipper_shrink, static_cast<double>(iterate.stale_rounds),
                          static_cast<double>(iterate.fewest_defects)},
      1);
  std::vector<std::int64_t> keys;
  std::vector<std::int32_t> verdicts;
  for (const auto& [key, verdict] : iterate.verdicts.all()) {
    keys.push_back(static_cast<std::int64_t>(key));
    verdicts.push_back(static_cast<std::int32_t>(verdict));
  }
  arrays.own("verdict_keys", std::move(keys), 1);
  arrays.own("verdicts", std::move(verdicts), 1);
  arrays.own_text("repair_report", text_of(iterate.report));
  return arrays;
}

RepairIterate unpack_repair_iterate(const NamedArrays& arrays) {
  RepairIterate iterate;
  static_cast<FieldResult&>(iterate.state) = unpack_field(arrays);
  const auto lengths = arrays.get<double>("target_length", 1);
  require_same(lengths.size() == iterate.state.mesh.num_vertices(), "it has not one target length per vertex");
  iterate.state.target_length.assign(lengths.begin(), lengths.end());
  const auto pairs = arrays.get<std::int32_t>("pairs", 3);
  for (std::size_t i = 0; i + 2 < pairs.size(); i += 3)
    iterate.state.pairs[{VertexId(pairs[i]), VertexId(pairs[i + 1])}] = pairs[i + 2];
  const auto kept = arrays.get<std::int32_t>("kept", 2);
  for (std::size_t i = 0; i + 1 < kept.size(); i += 2)
    iterate.state.kept.insert({VertexId(kept[i]), VertexId(kept[i + 1])});
  const auto weights = arrays.get<double>("weights", 1);
  require_same(weights.size() == 4, "its weights are missing");
  iterate.compound_shrink = weights[0];
  iterate.zipper_shrink = weights[1];
  iterate.stale_rounds = static_cast<int>(weights[2]);
  iterate.fewest_defects = static_cast<int>(weights[3]);
  const auto keys = arrays.get<std::int64_t>("verdict_keys", 1);
  const auto verdicts = arrays.get<std::int32_t>("verdicts", 1);
  require_same(keys.size() == verdicts.size(), "it has not one verdict per key");
  for (std::size_t i = 0; i < keys.size(); ++i)
    iterate.verdicts.note(static_cast<VerdictMemory::Key>(keys[i]), static_cast<VertexVerdict>(verdicts[i]));
  iterate.report = report_from(arrays.text("repair_report"));
  return iterate;
}

}  // namespace hexfield
