#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "hexfield/hex/check.hpp"
#include "hexfield/hex/extract.hpp"
#include "hexfield/hex/improve.hpp"
#include "hexfield/hex/sanitise.hpp"
#include "hexfield/io/hexex_io.hpp"
#include "support/scratch.hpp"

using namespace hexfield;
namespace fs = std::filesystem;

namespace {

fs::path shared_data() {
  const char* other = std::getenv("HEXFIELD_SHARED_DATA");
  return other != nullptr ? fs::path(other) : fs::path(HEXFIELD_SOURCE_DIR) / ".." / "shared" / "data";
}

// Hexes per model by the table of the data set.
std::map<std::string, std::size_t> expected_hexes() {
  std::map<std::string, std::size_t> expected;
  std::ifstream table(shared_data() / "hexme" / "reference.csv");
  std::string line;
  std::size_t column = 0;
  while (std::getline(table, line)) {
    std::vector<std::string> cells;
    std::stringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    if (cells.empty()) continue;
    if (cells[0] == "model")
      column = static_cast<std::size_t>(std::find(cells.begin(), cells.end(), "hexes") - cells.begin());
    else if (cells.size() > column && !cells[column].empty())
      expected[cells[0]] = std::stoul(cells[column]);
  }
  return expected;
}

class IgmModel : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const fs::path maps = shared_data() / "igm-maps";
    if (!fs::exists(maps)) GTEST_SKIP() << "no shared data beside the checkout";
    const auto unpack = [&](const std::string& kind) {
      const std::string name = std::string(GetParam()) + "." + kind + ".hexex";
      const fs::path file = scratch_ / name;
      const std::string command = "zstd -qdc '" + (maps / (name + ".zst")).string() + "' > '" + file.string() + "'";
      EXPECT_EQ(std::system(command.c_str()), 0) << command;
      return read_hexex(file);
    };
    input_ = unpack("igm");
    features_ = unpack("seamless").features;
  }
  hexfield::testing::ScratchDirectory scratch_;
  HexexInput input_;
  Features features_;
};

}  // namespace

TEST_P(IgmModel, GivesThePublishedNumberOfHexesAndBecomesValid) {
  const SanitisedMap exact = sanitise_igm(input_.mesh, features_, input_.map);
  EXPECT_TRUE(exact.violations.empty());
  EXPECT_LT(exact.largest_move, 1e-6);
  HexMesh hexes = extract_hex_mesh(input_.mesh, features_, input_.map);
  EXPECT_EQ(hexes.hexes.size(), expected_hexes().at(GetParam()));
  EXPECT_EQ(hexes.feature_points.size(), features_.points.size());
  const double before = quality(hexes).min;
  improve_hex_mesh(hexes, input_.mesh, features_, {}, {});
  const HexQuality after = quality(hexes);
  EXPECT_GE(after.min, before);
  EXPECT_EQ(after.not_positive, 0u);
  for (const Violation& violation : check(hexes)) ADD_FAILURE() << violation.sentence;
  for (const Violation& violation : check_against(hexes, input_.mesh, features_).violations)
    ADD_FAILURE() << violation.sentence;
}

TEST_P(IgmModel, TwiceTheMapGivesEightTimesTheHexes) {
  for (auto& tet : input_.map.uvw)
    for (Vec3& p : tet) p *= 2;
  const HexMesh hexes = extract_hex_mesh(input_.mesh, features_, input_.map);
  EXPECT_EQ(hexes.hexes.size(), 8 * expected_hexes().at(GetParam()));
  const MeshTopology fine = topology(hexes);
  const MeshTopology tets = topology(input_.mesh);
  EXPECT_EQ(fine.euler_volume, tets.euler_volume);
  EXPECT_EQ(fine.euler_boundary, tets.euler_boundary);
  EXPECT_EQ(fine.boundary_edges_not_in_two_faces, 0);
}

INSTANTIATE_TEST_SUITE_P(All, IgmModel,
                         ::testing::Values("s01c_cube", "s02u_prism", "s07c_notch", "s16c_torus",
                                           "n02c_skijump_anti_box_cyl", "n08c_pentapyr", "i14c_s7", "i20c_s25"));
