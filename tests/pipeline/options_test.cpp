#include "hexfield/pipeline/option_table.hpp"

#include <gmock/gmock.h>

#include "../src/pipeline/config_text.hpp"
#include "hexfield/base/error.hpp"
#include "hexfield/pipeline/stage_names.hpp"
#include "support/scratch.hpp"

namespace hexfield {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Code and sentence of the Error that `work` throws; code success when it throws none.
template <class Work>
std::pair<ExitCode, std::string> failure(Work work) {
  try {
    work();
  } catch (const Error& error) {
    return {error.code(), error.sentence()};
  }
  return {ExitCode::success, ""};
}

TEST(Options, FileThenAssignmentsThenOwnOptions) {
  const testing::ScratchDirectory scratch;
  testing::write_bytes(scratch / "a.toml", R"(# a comment
target_hexes = 2_500      # numbers may have underscores
check = true
formats = ["vtu", 'mesh']
field.alignment_sweeps = 7
[field]
smoothing_tolerance = 1e-9
[improve]
max_rounds = 3
)");
  RunOptions options;
  OptionTable table(options);
  table.read_file(scratch / "a.toml");
  table.set_assignment("field.alignment_sweeps=8");
  table.set("improve.max_rounds", "+4", ExitCode::usage, "command line");
  EXPECT_EQ(options.target_hexes, 2500);
  EXPECT_TRUE(options.check);
  EXPECT_EQ(options.formats, (std::vector<std::string>{"vtu", "mesh"}));
  EXPECT_EQ(options.field.alignment_sweeps, 8);
  EXPECT_EQ(options.field.smoothing_tolerance, 1e-9);
  EXPECT_EQ(options.improve.max_rounds, 4);
}

TEST(Options, AWrongKeyNamesTheNearestOne) {
  RunOptions options;
  OptionTable table(options);
  const auto typo = failure([&] { table.set_assignment("field.aligment_sweeps=3"); });
  EXPECT_EQ(typo.first, ExitCode::usage);
  EXPECT_THAT(typo.second, AllOf(HasSubstr("field.aligment_sweeps"), HasSubstr("'field.alignment_sweeps'")));
  EXPECT_THAT(failure([&] { table.set_assignment("max_round=3"); }).second, HasSubstr("'improve.max_rounds'"));
  EXPECT_THAT(failure([&] { table.set_assignment("target_hexs=3"); }).second, HasSubstr("'target_hexes'"));

  const testing::ScratchDirectory scratch;
  testing::write_bytes(scratch / "typo.toml", "\n[field]\nalignment_sweep = 3\n");
  const auto in_file = failure([&] { table.read_file(scratch / "typo.toml"); });
  EXPECT_EQ(in_file.first, ExitCode::bad_input);
  EXPECT_THAT(in_file.second, AllOf(HasSubstr("typo.toml, line 3"), HasSubstr("'field.alignment_sweeps'")));
  EXPECT_EQ(failure([&] { table.read_file(scratch / "none.toml"); }).first, ExitCode::bad_input);
}

TEST(Options, ValuesAreCheckedAgainstTypeAndRange) {
  RunOptions options;
  OptionTable table(options);
  for (const char* bad : {"target_hexes=many", "target_hexes=0", "target_hexes=nan", "target_hexes=1e99", "threads=1.5",
                          "threads=-1", "check=yes", "quantizer=best", "quantizer=", "min_layers=0",
                          "feature_angle=181", "target_hexes=", "seed=99999999999999", "=3", "target_hexes"}) {
    EXPECT_EQ(failure([&] { table.set_assignment(bad); }).first, ExitCode::usage) << bad;
  }
  EXPECT_EQ(options.target_hexes, RunOptions().target_hexes);
  EXPECT_THAT(failure([&] { table.set_assignment("quantizer=pomp"); }).second, HasSubstr("pump or ilp or rounding"));
  table.set_assignment("quantizer=ilp");
  EXPECT_EQ(options.quantizer, "ilp");
}

TEST(Options, TextOfAValueReadsBackToTheSameBits) {
  RunOptions options;
  options.field.smoothing_tolerance = 0.1 + 0.2;
  options.formats = {"vtk", "msh22"};
  options.quantizer = "rounding";
  RunOptions copy;
  OptionTable from(options);
  OptionTable to(copy);
  for (const OptionEntry& entry : from.entries()) to.set(entry.key, value_text(entry), ExitCode::bug, "test");
  EXPECT_EQ(copy.field.smoothing_tolerance, options.field.smoothing_tolerance);
  EXPECT_EQ(copy.formats, options.formats);
  EXPECT_EQ(copy.quantizer, "rounding");
}

TEST(Config, RefusesWhatItDoesNotKnow) {
  for (const char* bad :
       {"x", "x =", "= 3", "[t", "x = \"a", "x = 'b>", "x = [1, 2", "x = 1 2", "x = word", "x = 1\nx = 2",
        "x = \"\\q\"", "[a]]", "x = [1 2]", "\xe2\xa7", "x = {}", "x = \"\"\"a\"\"\""}) {
    const auto [code, sentence] = failure([&] { parse_config(bad, "f.toml"); });
    EXPECT_EQ(code, ExitCode::bad_input) << bad;
    EXPECT_THAT(sentence, HasSubstr("f.toml, line ")) << bad;
  }
}

TEST(Config, ReadsAnyBytesWithoutHarm) {
  std::uint32_t state = 7;
  const auto random = [&] { return state = state * 1664525 + 1013904223; };
  const std::string alphabet = "ab.=[]\"'\\,# \n\t1-+_e\r\xff{}";
  int good = 0;
  for (int k = 0; k < 20000; ++k) {
    std::string text;
    for (std::uint32_t n = random() % 24; n > 0; --n) text += alphabet[(random() >> 16) % alphabet.size()];
    const auto [code, sentence] = failure([&] { parse_config(text, "f"); });
    good += code == ExitCode::success ? 1 : 0;
    ASSERT_TRUE(code == ExitCode::success || code == ExitCode::bad_input);
  }
  EXPECT_GT(good, 0);
}

TEST(Stages, NamesResolve) {
  EXPECT_EQ(resolve_stage("quantize"), "quantize");
  for (const std::string& name : stage_names()) EXPECT_EQ(resolve_stage(name), name);
  const auto [code, sentence] = failure([] { resolve_stage("sow"); });
  EXPECT_EQ(code, ExitCode::usage);
  EXPECT_THAT(sentence, HasSubstr("read, field"));
}

}  // namespace
}  // namespace hexfield
