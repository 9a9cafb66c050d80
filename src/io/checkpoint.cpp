#include "hexfield/io/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <system_error>
#include <utility>

#include "checkpoint_container.hpp"
#include "hexfield/base/error.hpp"

namespace hexfield {
namespace fs = std::filesystem;
namespace {

/// The stages of an open checkpoint in the order in which they were finished. Groups are listed in the attribute
/// `stages` of the root; one that is not marked complete counts for nothing.
std::vector<StageEntry> list_stages(const hdf5::File& file) {
  std::vector<StageEntry> stages;
  const std::string order = file.get_text("/", "stages");
  for (std::size_t begin = 0; begin < order.size();) {
    const std::size_t end = std::min(order.find(' ', begin), order.size());
    const std::string name = order.substr(begin, end - begin);
    begin = end + 1;
    if (!file.has_attribute(name, "complete")) break;
    stages.push_back({name, file.get_text(name, "basis"), file.get_text(name, "report")});
  }
  return stages;
}

void write_stage(hdf5::File& file, const StageEntry& entry, const NamedArrays& values) {
  file.make_group(entry.name);
  for (const auto& [name, array] : values.all()) file.write(entry.name, name, array);
  file.set_text(entry.name, "basis", entry.basis);
  file.set_text(entry.name, "report", entry.report);
  file.set_text(entry.name, "complete", "yes");
}

}  // namespace

Checkpoint::Checkpoint(fs::path file, std::string input_hash)
    : file_(std::move(file)), input_hash_(std::move(input_hash)) {}

Checkpoint Checkpoint::open(const fs::path& file) {
  const hdf5::File opened = open_container(file);
  Checkpoint checkpoint(file, opened.get_text("/", "input_hash"));
  checkpoint.stages_ = list_stages(opened);
  checkpoint.on_disk_ = true;
  return checkpoint;
}

const StageEntry* Checkpoint::find(const std::string& stage) const {
  for (const StageEntry& entry : stages_) {
    if (entry.name == stage) return &entry;
  }
  return nullptr;
}

NamedArrays Checkpoint::load(const std::string& stage) const {
  if (find(stage) == nullptr) {
    throw Error(ExitCode::bad_input,
                fmt::format("The checkpoint {} has no finished stage '{}'.", file_.string(), stage));
  }
  return hdf5::File::open(file_).read(stage);
}

void Checkpoint::forget_from(const std::string& stage) {
  const auto first =
      std::find_if(stages_.begin(), stages_.end(), [&](const auto& entry) { return entry.name == stage; });
  stages_.erase(first, stages_.end());
}

void Checkpoint::save(const StageEntry& entry, const NamedArrays& values) {
  forget_from(entry.name);
  std::string order;
  for (const StageEntry& kept : stages_) order += kept.name + " ";
  order += entry.name;
  write_container(file_, [&](hdf5::File& fresh) {
    if (on_disk_ && !stages_.empty()) {
      const hdf5::File old = hdf5::File::open(file_);
      for (const StageEntry& kept : stages_) fresh.copy_group(old, kept.name);
    }
    write_stage(fresh, entry, values);
    fresh.set_text("/", "schema", std::to_string(checkpoint_schema));
    fresh.set_text("/", "input_hash", input_hash_);
    fresh.set_text("/", "stages", order);
  });
  on_disk_ = true;
  stages_.push_back(entry);
}

IterateRing::IterateRing(fs::path directory, std::string name, std::string basis)
    : directory_(std::move(directory)), name_(std::move(name)), basis_(std::move(basis)) {
  std::replace_if(
      name_.begin(), name_.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
}

fs::path IterateRing::slot(int k) const { return directory_ / fmt::format("iterate-{}.{}.h5", name_, k); }

void IterateRing::save(const std::vector<double>& values) {
  NamedArrays arrays;
  arrays.view<double>("values", values, 1);
  save(arrays);
}

void IterateRing::save(const NamedArrays& values) {
  if (next_ < 0) newest_arrays();
  write_container(slot(static_cast<int>(next_ % 2)), [&](hdf5::File& fresh) {
    fresh.set_text("/", "sequence", std::to_string(next_));
    write_stage(fresh, {"iterate", basis_, "{}"}, values);
  });
  ++next_;
}

std::optional<std::vector<double>> IterateRing::newest() {
  const auto arrays = newest_arrays();
  if (!arrays) return std::nullopt;
  const auto values = arrays->get<double>("values", 1);
  return std::vector<double>(values.begin(), values.end());
}

std::optional<NamedArrays> IterateRing::newest_arrays() {
  std::optional<NamedArrays> best;
  long long best_sequence = -1;
  for (int k : {0, 1}) {
    std::error_code failure;
    if (!fs::exists(slot(k), failure)) continue;
    try {
      const hdf5::File file = open_container(slot(k));
      const long long sequence = std::stoll(file.get_text("/", "sequence"));
      if (file.get_text("iterate", "basis") != basis_ || sequence <= best_sequence) continue;
      best.emplace(file.read("iterate"));
      best_sequence = sequence;
    } catch (const std::exception&) {
      continue;  // The other slot is the older, whole one.
    }
  }
  next_ = best_sequence + 1;
  return best;
}

void IterateRing::remove_all(const fs::path& directory) {
  std::error_code failure;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(directory, failure)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("iterate-") && name.ends_with(".h5")) found.push_back(entry.path());
  }
  for (const fs::path& file : found) fs::remove(file, failure);
}

}  // namespace hexfield
