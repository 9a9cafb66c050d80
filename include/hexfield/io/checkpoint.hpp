#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hexfield/io/named_arrays.hpp"

/// The checkpoint of a run: one HDF5 file with one group per finished stage.
///
/// Layout. The first 512 bytes are an HDF5 user block in plain text: the words "hexfield checkpoint", the schema,
/// and size and SHA-256 of the HDF5 file behind it, so that a torn or foreign file is known for one before HDF5
/// reads it. The root has the attributes `schema` and `input_hash`; each stage is a group with the attributes
/// `basis` (hash of the input and of all options that it was computed from), `report` (its lines of the report as
/// JSON) and `complete`, written last, and its arrays as datasets in the ids of rank 0, thus readable by any
/// number of ranks.
///
/// Safety. A save writes a complete new file beside the old one, flushes it to the disk and renames it over the
/// old one: at any moment the name leads to a whole file. The iterates of long solves are small files of the same
/// layout, two per name, written in turn.
///
/// Nothing here is collective; rank 0, which holds all values, reads and writes.
namespace hexfield {

inline constexpr int checkpoint_schema = 1;

/// One stage as the file lists it.
struct StageEntry {
  std::string name;
  std::string basis;
  std::string report;
};

class Checkpoint {
 public:
  /// No file yet: the first save makes it.
  Checkpoint(std::filesystem::path file, std::string input_hash);
  /// Lists an existing file after checking all its bytes. Throws Error(bad_input) naming the file when it cannot be
  /// read, is torn, is not a checkpoint of this program, or has a newer schema.
  static Checkpoint open(const std::filesystem::path& file);

  const std::filesystem::path& file() const { return file_; }
  const std::string& input_hash() const { return input_hash_; }
  const std::vector<StageEntry>& stages() const { return stages_; }
  const StageEntry* find(const std::string& stage) const;

  /// Throws Error(bad_input) when the stage or its values cannot be read.
  NamedArrays load(const std::string& stage) const;
  /// Adds a finished stage and forgets those of the file that are not listed any more.
  /// Throws Error(bad_input) when the disk does not take it; the old file is then still whole.
  void save(const StageEntry& entry, const NamedArrays& values);
  /// Forgets this stage and all that follow it, from the next save on.
  void forget_from(const std::string& stage);

 private:
  std::filesystem::path file_;
  std::string input_hash_;
  std::vector<StageEntry> stages_;
  bool on_disk_ = false;
};

/// True when the file starts like a checkpoint of this program (of any schema, whole or torn).
bool looks_like_checkpoint(const std::filesystem::path& file);

/// Version of the HDF5 library in use, "1.10.8".
std::string hdf5_version();

/// The two-slot ring of iterates of one named long solve, beside the checkpoint.
class IterateRing {
 public:
  /// Files `<directory>/iterate-<name>.0.h5` and `.1.h5`.
  IterateRing(std::filesystem::path directory, std::string name, std::string basis);

  /// Writes into the older slot. Throws Error(bad_input) when the disk does not take it.
  void save(const NamedArrays& values);
  void save(const std::vector<double>& values);
  /// The newest whole iterate of this basis; nullopt when there is none. Torn and foreign slots are passed over.
  std::optional<NamedArrays> newest_arrays();
  /// The same for one that was saved as a vector.
  std::optional<std::vector<double>> newest();
  /// Removes every iterate of the directory.
  static void remove_all(const std::filesystem::path& directory);

 private:
  std::filesystem::path slot(int k) const;

  std::filesystem::path directory_;
  std::string name_;
  std::string basis_;
  std::int64_t next_ = -1;  ///< sequence number of the next save; negative: not known yet
};

}  // namespace hexfield
