#include "hexfield/pipeline/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <system_error>

#include "hexfield/base/agree.hpp"
#include "hexfield/base/hash.hpp"
#include "hexfield/base/ledger.hpp"
#include "hexfield/base/parallel.hpp"
#include "hexfield/base/watchdog.hpp"
#include "hexfield/io/checkpoint.hpp"
#include "hexfield/io/whole_file.hpp"
#include "hexfield/pipeline/option_table.hpp"
#include "hexfield/pipeline/stage_names.hpp"
#include "outputs.hpp"
#include "report.hpp"
#include "stages.hpp"
#include "tries.hpp"

namespace hexfield {
namespace {

using Json = nlohmann::ordered_json;

/// Hash of everything that the value of each stage depends on: the input, and its options and those of the stages
/// before it. Numbers of ranks and threads are not among them.
std::map<std::string, std::string> stage_bases(const RunOptions& options, const std::string& input_hash) {
  RunOptions copy = options;
  const OptionTable table(copy);
  std::map<std::string, std::string> bases;
  std::string before =
      fmt::format("schema {} input {}{}", checkpoint_schema, input_hash, is_map_file(options.input) ? " map" : "");
  for (const std::string& stage : stage_names()) {
    std::string text = before + "\n" + stage + "\n";
    for (const OptionEntry& entry : table.entries()) {
      if (entry.stage == stage) text += fmt::format("{}={}\n", entry.key, value_text(entry));
    }
    bases[stage] = before = sha256(text);
    if (stage == "seamless") bases["map"] = before;
  }
  return bases;
}

/// One call of run(): the order of the stages, the checkpoint and the report.
class Runner {
 public:
  Runner(Team& team, const RunOptions& options, Log& log)
      : team_(team),
        safe_points_(team, options.time_limit, options.checkpoint_interval),
        state_{.team = team, .options = options, .log = log, .safe_points = safe_points_},
        log_(log),
        options_(options),
        stages_(is_map_file(options.input) ? map_stages() : all_stages()) {}

  Outcome go(const std::function<void(const std::string&)>& unheard);

 private:
  void prepare();
  void open_checkpoint();
  void open_output();
  void run_stage(std::size_t index);
  void run_stages();
  bool may_try_again(const Error& error) const;
  std::size_t try_again(const Error& error);
  TrySetting setting() const { return try_setting(options_.repair, state_.attempt, state_.input_tets); }
  bool restore(std::size_t index);
  void compute(std::size_t index);
  void end_stage(const Stage& stage, const std::string& note);
  void save(const Stage& stage, const std::string& basis);
  void judge(const Stage& stage);
  Outcome finish(Outcome outcome, const std::vector<Vec3>& where);
  std::string success_sentence() const;
  bool continues() const { return options_.resume || !from_stage_.empty(); }
  std::size_t index_of(const std::string& stage) const;

  Team& team_;
  SafePoints safe_points_;
  RunState state_;
  Log& log_;
  const RunOptions& options_;
  Ledger ledger_;
  std::vector<Stage> stages_;
  std::vector<std::string> bases_;
  std::optional<Checkpoint> checkpoint_;  // rank 0
  std::string from_stage_;                // empty: no --from, or the one with which a map enters the line
  std::size_t from_ = 0;                  // stages from here on are computed in any case
  std::size_t last_ = 0;
  std::string current_;
  bool restoring_ = true;
  bool output_open_ = false;
};

std::size_t Runner::index_of(const std::string& stage) const {
  const std::string name = resolve_stage(stage);
  const auto found = std::find_if(stages_.begin(), stages_.end(), [&](const Stage& s) { return s.name == name; });
  if (found == stages_.end()) {
    throw Error(ExitCode::usage,
                fmt::format("{} holds a seamless map: it enters at stage quantize, there is no stage {} for it.",
                            options_.input.string(), name));
  }
  return static_cast<std::size_t>(found - stages_.begin());
}

void Runner::prepare() {
  from_ = options_.from.empty() ? stages_.size() : index_of(options_.from);
  from_stage_ = options_.from;
  if (is_map_file(options_.input) && options_.from == "quantize") {
    from_stage_.clear();
    from_ = stages_.size();
  }
  last_ = options_.to.empty() ? stages_.size() - 1 : index_of(options_.to);
  if (from_ < stages_.size() && from_ > last_) {
    throw Error(ExitCode::usage, fmt::format("--from {} comes after --to {}.", options_.from, options_.to));
  }
  state_.report = empty_report(options_, team_.size(), threads());
  team_.on_root([&] {
    const std::string hash = sha256_of_file(options_.input);
    const std::map<std::string, std::string> bases = stage_bases(options_, hash);
    for (const Stage& stage : stages_) bases_.push_back(bases.at(stage.name));
    state_.report["input"]["hash"] = "sha256:" + hash;
    checkpoint_.emplace(options_.output / "run.h5", hash);
    if (continues()) open_checkpoint();
  });
  bases_.resize(stages_.size());
  safe_points_.keep_iterates_in(options_.output, options_.resume && from_stage_.empty());
}

void Runner::open_checkpoint() {
  std::error_code failure;
  if (!std::filesystem::exists(checkpoint_->file(), failure)) {
    if (!from_stage_.empty() && from_ > 0) {
      throw Error(ExitCode::bad_input,
                  fmt::format("--from {}: there is no checkpoint {}.", options_.from, checkpoint_->file().string()));
    }
    log_.info(
        fmt::format("There is no checkpoint {} yet: starting with the first stage.", checkpoint_->file().string()));
    return;
  }
  Checkpoint found = Checkpoint::open(checkpoint_->file());
  if (found.input_hash() != checkpoint_->input_hash()) {
    throw Error(
        ExitCode::bad_input,
        fmt::format(
            "The checkpoint {} was computed from another mesh than {} (SHA-256 {:.12}... instead of {:.12}...).",
            found.file().string(), options_.input.string(), found.input_hash(), checkpoint_->input_hash()));
  }
  checkpoint_.emplace(std::move(found));
  for (std::size_t i = 0; i < from_ && !from_stage_.empty(); ++i) {
    const StageEntry* entry = checkpoint_->find(stages_[i].name);
    if (entry == nullptr || entry->basis != bases_[i]) {
      throw Error(ExitCode::bad_input,
                  fmt::format("--from {}: the checkpoint {} has no finished stage '{}' of these options.",
                              options_.from, checkpoint_->file().string(), stages_[i].name));
    }
  }
}

void Runner::open_output() {
  if (output_open_) return;
  team_.on_root([&] {
    make_output_directory(options_.output);
    log_.open_file(options_.output / "log.txt", continues());
    if (!options_.resume) IterateRing::remove_all(options_.output);
  });
  output_open_ = true;
}

bool Runner::restore(std::size_t index) {
  const Stage& stage = stages_[index];
  if (!restoring_ || index >= from_) return false;
  int found = 0;
  if (team_.is_root()) {
    const StageEntry* entry = checkpoint_->find(stage.name);
    found = entry != nullptr && entry->basis == bases_[index] ? 1 : 0;
    if (entry != nullptr && found == 0) {
      log_.warning(
          fmt::format("The options of stage {} differ from those of the checkpoint: computing it again.", stage.name));
    }
  }
  MPI_Bcast(&found, 1, MPI_INT, 0, team_.comm());
  if (found == 0) return false;
  team_.on_root([&] {
    stage.unpack(state_, checkpoint_->load(stage.name));
    Json lines = Json::parse(checkpoint_->find(stage.name)->report);
    lines["restored"] = true;
    if (lines.contains("try")) {
      state_.attempt = lines["try"].get<int>() - 1;
      state_.tries = lines["tries_before"];
    }
    state_.report["stages"].push_back(std::move(lines));
    log_.info(fmt::format("{:<9} restored from {}", stage.name, checkpoint_->file().string()));
  });
  MPI_Bcast(&state_.attempt, 1, MPI_INT, 0, team_.comm());
  return true;
}

void Runner::compute(std::size_t index) {
  const Stage& stage = stages_[index];
  log_.debug(fmt::format("{} begins.", stage.name));
  ledger_.begin(stage.name);
  try {
    Progress progress(log_, stage.name);
    stage.compute(state_, bases_[index], progress);
  } catch (const Error& error) {
    end_stage(stage, error.code() == ExitCode::stopped ? "stopped" : "failed");
    throw;
  }
  end_stage(stage, "");
  safe_points_.pass_if_told("in stage " + stage.name);
}

void Runner::end_stage(const Stage& stage, const std::string& note) {
  const StageCost& cost = ledger_.end(team_.comm());
  if (!team_.is_root()) return;
  Json lines = stage_json(cost);
  if (stage.iterations) lines["iterations"] = stage.iterations(state_);
  if (stage.name == "field") lines["refined_input"] = setting().refined_input;
  if (stage.name == "repair") {
    lines["try"] = state_.attempt + 1;
    lines["tries_before"] = state_.tries;
  }
  if (!note.empty()) lines["ended"] = note;
  state_.report["stages"].push_back(lines);
  log_.info(
      fmt::format("{:<9} {:>8.2f} s  {:>8.0f} MiB  {}", stage.name, cost.seconds.max, cost.peak_rss_mb.max, note));
}

void Runner::save(const Stage& stage, const std::string& basis) {
  team_.on_root([&] {
    checkpoint_->save({stage.name, basis, state_.report["stages"].back().dump()}, stage.pack(state_));
    IterateRing::remove_all(options_.output);
    log_.debug(fmt::format("{} is in the checkpoint.", stage.name));
  });
}

void Runner::judge(const Stage& stage) {
  team_.on_root([&] {
    if (options_.check) {
      const std::vector<Violation> violations = stage.check(state_);
      if (!violations.empty()) {
        throw Error(
            ExitCode::bug,
            fmt::format("Stage {} broke an invariant of its value: {}", stage.name, violations.front().sentence),
            violations.front().ids, violations.front().places);
      }
    }
    stage.judge(state_);
  });
}

void Runner::run_stage(std::size_t index) {
  const Stage& stage = stages_[index];
  current_ = stage.name;
  if (restore(index)) {
    open_output();
  } else {
    restoring_ = false;
    compute(index);
    open_output();
    save(stage, bases_[index]);
  }
  judge(stage);
}

bool Runner::may_try_again(const Error& error) const {
  const bool worth_it = error.code() == ExitCode::not_meshable || error.code() == ExitCode::no_seamless_map;
  return worth_it && !is_map_file(options_.input) && state_.attempt + 1 < options_.tries;
}

// Goes back to the smooth field, for a repair with another setting, or to the input, for another field, where this one
// ends in a field that is not locally meshable or has no seamless map. Returns the stage to go on with.
std::size_t Runner::try_again(const Error& error) {
  const std::size_t field = index_of("field"), repair = index_of("repair");
  team_.on_root([&] {
    log_.warning(fmt::format("Try {} ({}) failed: {}", state_.attempt + 1, setting().name, error.sentence()));
    state_.tries.push_back(try_json(setting().name, error.code(), error.sentence()));
    state_.culprits = {};
    state_.seamless = {};
  });
  ++state_.attempt;
  std::size_t next = repair;
  team_.on_root([&] {
    const Json lines = Json::parse(checkpoint_->find(stages_[field].name)->report);
    if (lines.value("refined_input", false) != setting().refined_input) next = field;
    stages_[next - 1].unpack(state_, checkpoint_->load(stages_[next - 1].name));
  });
  MPI_Bcast(&next, 1, MPI_UNSIGNED_LONG, 0, team_.comm());
  restoring_ = false;
  return next;
}

void Runner::run_stages() {
  for (std::size_t i = 0; i <= last_; ++i) {
    try {
      run_stage(i);
    } catch (const Error& error) {
      if (!may_try_again(error)) throw;
      i = try_again(error) - 1;
      continue;
    }
    if (i < last_) safe_points_.pass("after stage " + stages_[i].name);
  }
}

std::string Runner::success_sentence() const {
  if (last_ + 1 < stages_.size()) return fmt::format("Finished stage {}, as --to asked.", stages_[last_].name);
  return state_.sentence;
}

Outcome Runner::go(const std::function<void(const std::string&)>& unheard) {
  Outcome outcome;
  std::vector<Vec3> where;
  try {
    // Until the results are written: from there on it is not long to the end.
    std::optional<Watchdog> dog;
    if (unheard && team_.is_root())
      dog.emplace([this] { return safe_points_.unheard(); }, patience_with_stages,
                  [&] { unheard("Stopped in the middle of a stage; --resume continues from the last checkpoint."); });
    prepare();
    run_stages();
    if (team_.is_root()) outcome.sentence = success_sentence();
  } catch (const Error& error) {
    outcome = {error.code(), error.sentence()};
    where = error.places();
  }
  return finish(std::move(outcome), where);
}

Outcome Runner::finish(Outcome outcome, const std::vector<Vec3>& where) {
  if (!output_open_) return outcome;
  if (outcome.code == ExitCode::stopped) {
    outcome.sentence = fmt::format("Stopped by {} at stage {}; the same command with --resume continues from {}.",
                                   safe_points_.reason(), current_, options_.output.string());
  }
  try {
    team_.on_root([&] {
      const bool failed = outcome.code != ExitCode::success && outcome.code != ExitCode::stopped;
      if (failed && state_.culprits.empty()) state_.culprits.places = where;
      write_results(state_, outcome);
      state_.tries.push_back(try_json(setting().name, outcome.code, outcome.sentence));
      close_report(state_.report, state_.tries, outcome, current_, where);
      write_text(options_.output / "report.json", state_.report.dump(2) + "\n");
    });
  } catch (const Error& error) {
    outcome = {error.code(), error.sentence()};
  }
  return outcome;
}

}  // namespace

Outcome run(MPI_Comm comm, const RunOptions& options, Log& log,
            const std::function<void(const std::string&)>& unheard) {
  Team team(comm, log);
  Outcome outcome;
  try {
    // A failure outside the stages is one of this rank alone unless all agree on it.
    team.together([&] { outcome = Runner(team, options, log).go(unheard); });
  } catch (const Error& error) {
    outcome = {error.code(), error.sentence()};
  }
  return outcome;
}

}  // namespace hexfield
