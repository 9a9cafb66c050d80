#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <set>
#include <vector>

#include "hexfield/field/compute_field.hpp"

namespace hexfield {

/// Whom a repair asks whether it must end, and what it has done. All copies of a state share one.
struct RepairWatch {
  std::function<bool()> stop_requested;  ///< asked from any thread; may be empty
  std::atomic<long> work = 0;            ///< tets looked at, about; the same for any number of threads
  long budget = 0;                       ///< of work; 0: no limit

  /// Called before an operation that looks at about this many tets. Throws Error(stopped) when the run must end.
  void begin(std::size_t tets);
  /// Asked where no other thread works, so that the answer is the same for any number of threads.
  bool exhausted() const { return budget > 0 && work > budget; }
};

/// What stage 3 works on: the mesh with its features, the field with its codes, and what the repair needs to
/// remember between operations. Held whole by one rank.
struct RepairState : FieldResult {
  std::vector<double> target_length;   ///< per vertex: mean length of its edges in the input, kept under splits
  std::map<EdgeKey, int> pairs;        ///< singular edges of two arcs made by one unzipping share an id; they repel
  std::set<EdgeKey> kept;              ///< singular edges that must stay on their feature surface
  std::shared_ptr<RepairWatch> watch;  ///< null: nobody listens

  /// RepairWatch::begin() where somebody listens.
  void begin_operation(std::size_t tets) const {
    if (watch) watch->begin(tets);
  }
  bool exhausted() const { return watch && watch->exhausted(); }
};

}  // namespace hexfield
