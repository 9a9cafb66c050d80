#include "../src/pipeline/tries.hpp"

#include <gtest/gtest.h>

#include <set>

using namespace hexfield;

TEST(Tries, TheFirstOneIsWhatTheOptionsSay) {
  RepairOptions options;
  options.alignment_weight = 7;
  const TrySetting first = try_setting(options, 0, 100);
  EXPECT_EQ(first.name, "default");
  EXPECT_EQ(first.repair.alignment_weight, 7);
  EXPECT_FALSE(first.refined_input);
}

TEST(Tries, OnlyInputsOfFewTetsAreRefined) {
  EXPECT_TRUE(try_setting({}, 1, 1000).refined_input);
  for (int attempt = 0; attempt < 4; ++attempt) EXPECT_FALSE(try_setting({}, attempt, 100000).refined_input);
}

TEST(Tries, NoSettingComesTwice) {
  for (std::size_t tets : {1000, 100000}) {
    std::set<std::string> names;
    for (int attempt = 0; attempt < 4; ++attempt) EXPECT_TRUE(names.insert(try_setting({}, attempt, tets).name).second);
  }
}
