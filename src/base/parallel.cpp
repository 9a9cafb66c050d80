#include "hexfield/base/parallel.hpp"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace hexfield {
namespace {

int thread_limit = 0;
std::unique_ptr<tbb::global_control> control;

}  // namespace

void set_threads(int count) {
  thread_limit = std::max(1, count);
  control = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                  static_cast<std::size_t>(thread_limit));
}

int threads() { return thread_limit > 0 ? thread_limit : tbb::info::default_concurrency(); }

void parallel_for(std::size_t n, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  grain = std::max<std::size_t>(grain, 1);
  const std::size_t pieces = (n + grain - 1) / grain;
  auto piece = [&](std::size_t p) { body(p * grain, std::min(n, (p + 1) * grain)); };
  if (pieces <= 1 || threads() == 1) {
    for (std::size_t p = 0; p < pieces; ++p) piece(p);
    return;
  }
  tbb::parallel_for(std::size_t{0}, pieces, piece);
}

double parallel_sum(std::size_t n, std::size_t grain, const std::function<double(std::size_t, std::size_t)>& body) {
  grain = std::max<std::size_t>(grain, 1);
  std::vector<double> parts((n + grain - 1) / grain, 0.0);
  parallel_for(n, grain, [&](std::size_t begin, std::size_t end) { parts[begin / grain] = body(begin, end); });
  double sum = 0;
  for (double part : parts) sum += part;
  return sum;
}

}  // namespace hexfield
