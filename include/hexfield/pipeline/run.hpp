#pragma once

#include <mpi.h>

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
Outcome run(MPI_Comm comm, const RunOptions& options, Log& log);

}  // namespace hexfield
