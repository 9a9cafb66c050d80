#pragma once

#include <mpi.h>

#include <functional>
#include <string>

#include "hexfield/base/error.hpp"
#include "hexfield/base/log.hpp"
#include "hexfield/pipeline/options.hpp"

namespace hexfield {

/// How a run ended; the same on all ranks.
struct Outcome {
  ExitCode code = ExitCode::success;
  std::string sentence;  ///< why and where
};

/// The whole way of DESIGN section 1 from options.input to the files of DESIGN section 6 in options.output.
/// Every failure is an Outcome; what was reached is written, but nothing at all before the input and an
/// existing checkpoint are accepted. Collective; rank 0 holds all values and writes all files.
///
/// Where a wish to stop is not heard for patience_with_stages seconds, because a library has the word, `unheard` is
/// called with a sentence, from another thread: the checkpoint may be left as it is and the process ended. May be
/// empty.
Outcome run(MPI_Comm comm, const RunOptions& options, Log& log,
            const std::function<void(const std::string&)>& unheard = {});

constexpr double patience_with_stages = 8;

}  // namespace hexfield
