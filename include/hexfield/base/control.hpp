#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hexfield {

/// How a long computation talks to whoever runs it. Every member may be empty (no listener).
/// All calls are collective and happen at safe points, with the same arguments on all ranks.
struct Control {
  /// What is being done and how much of it is behind us (0..1, negative when unknown).
  std::function<void(const std::string& what, double fraction)> progress;
  /// True when the run must end now; the computation then saves its iterate and throws Error(stopped).
  std::function<bool()> stop_requested;
  /// Offers the iterate of a long solve, complete on rank 0 and in global order (empty elsewhere), for a
  /// checkpoint; the receiver decides whether it is time to write.
  std::function<void(const std::string& name, const std::function<std::vector<double>()>& gather_on_root)>
      offer_iterate;
  /// The newest iterate of that name from an interrupted run, on rank 0 (empty vector elsewhere); nullopt if none.
  std::function<std::optional<std::vector<double>>(const std::string& name)> restore_iterate;
};

}  // namespace hexfield
