#pragma once

#include <cstddef>
#include <functional>

namespace hexfield {

/// Limits parallel_for() of this process to `threads` (>= 1). Not thread safe; called once at start.
void set_threads(int threads);
int threads();

/// Calls body(begin, end) for disjoint pieces that cover [0, n), in any order, on the threads of this
/// process. Pieces do not depend on the number of threads, so a result written by index, or summed by
/// piece in index order, is the same for any number of them.
void parallel_for(std::size_t n, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body);

/// Sum of body(begin, end) over the pieces of [0, n), added in index order.
double parallel_sum(std::size_t n, std::size_t grain, const std::function<double(std::size_t, std::size_t)>& body);

}  // namespace hexfield
