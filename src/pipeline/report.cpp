#include "report.hpp"

#include <cmath>

#include "hexfield/pipeline/option_table.hpp"
#include "hexfield/pipeline/version.hpp"

namespace hexfield {
namespace {

using Json = nlohmann::ordered_json;

Json spread_json(const Spread& spread) { return {{"min", spread.min}, {"mean", spread.mean}, {"max", spread.max}}; }

Json value_json(const OptionEntry& entry) {
  return std::visit([](const auto* value) -> Json { return *value; }, entry.value);
}

}  // namespace

Json options_json(const RunOptions& options) {
  RunOptions copy = options;
  Json json = Json::object();
  const OptionTable table(copy);
  for (const OptionEntry& entry : table.entries()) {
    Json* place = &json;
    std::string key = entry.key;
    if (const auto dot = key.find('.'); dot != std::string::npos) {
      place = &json[key.substr(0, dot)];
      key = key.substr(dot + 1);
    }
    (*place)[key] = value_json(entry);
  }
  json["from"] = options.from.empty() ? Json() : Json(options.from);
  json["to"] = options.to.empty() ? Json() : Json(options.to);
  json["resume"] = options.resume;
  return json;
}

Json empty_report(const RunOptions& options, int ranks, int threads) {
  Json json;
  json["schema"] = report_schema;
  json["program"] = {{"version", program_version()}, {"git", program_git()}};
  json["input"] = {{"path", options.input.string()}, {"hash", nullptr}, {"tets", nullptr}, {"vertices", nullptr}};
  json["options"] = options_json(options);
  json["ranks"] = ranks;
  json["threads"] = threads;
  json["stages"] = Json::array();
  for (const char* section :
       {"field", "meshability", "repair", "seamless", "igm", "quantization", "decomposition", "hex"})
    json[section] = nullptr;
  return json;
}

Json stage_json(const StageCost& cost) {
  return {{"name", cost.name},
          {"seconds", cost.seconds.max},
          {"peak_rss_mb", cost.peak_rss_mb.max},
          {"iterations", nullptr},
          {"restored", false},
          {"seconds_over_ranks", spread_json(cost.seconds)},
          {"peak_rss_mb_over_ranks", spread_json(cost.peak_rss_mb)}};
}

Json try_json(const std::string& setting, ExitCode verdict, const std::string& sentence) {
  return {{"settings", setting}, {"verdict", static_cast<int>(verdict)}, {"text", sentence}};
}

void close_report(Json& report, const Json& tries, const Outcome& outcome, const std::string& stage,
                  const std::vector<Vec3>& where) {
  Json places = Json::array();
  for (const Vec3& p : where) {
    if (p.allFinite() && places.size() < 100) places.push_back({p.x(), p.y(), p.z()});
  }
  report["tries"] = tries;
  report["verdict"] = {{"code", static_cast<int>(outcome.code)},
                       {"text", outcome.sentence},
                       {"where", places},
                       {"stage", stage.empty() ? Json() : Json(stage)}};
}

}  // namespace hexfield
