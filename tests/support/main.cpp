#include <gtest/gtest.h>

#include "hexfield/base/session.hpp"

// Every rank runs the same tests in the same order; rank 0 prints, and a failure anywhere fails everywhere.
int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  hexfield::Session session(argc, argv);
  if (session.rank() != 0) {
    auto& listeners = ::testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
  }
  int failed = RUN_ALL_TESTS();
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return failed;
}
