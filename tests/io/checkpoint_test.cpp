#include "hexfield/io/checkpoint.hpp"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <csignal>
#include <random>

#include "hexfield/base/error.hpp"
#include "hexfield/io/checkpoint_values.hpp"
#include "hexfield/io/whole_file.hpp"
#include "support/meshes.hpp"
#include "support/scratch.hpp"

namespace hexfield {
namespace {

using testing::bytes_of;
using ::testing::HasSubstr;
using testing::ScratchDirectory;
using testing::write_bytes;

/// The sentence with which `work` refuses bad input; empty when it does not.
template <class Work>
std::string refusal(Work work) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    return error.sentence();
  }
  return "";
}

TetInput box_with_features() {
  TetInput input;
  input.mesh = testing::kuhn_box(2, 1, 1);
  input.features.points[VertexId(0)] = 7;
  input.features.edges[edge_key(VertexId(1), VertexId(0))] = 8;
  input.features.faces[face_key(VertexId(1), VertexId(0), VertexId(4))] = 9;
  input.features.tet_colours.assign(input.mesh.num_tets(), 3);
  input.features.names[{2, 9}] = "a name \\ with\nodd bytes";
  return input;
}

void expect_equal(const TetMesh& a, const TetMesh& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.tets, b.tets);
  EXPECT_EQ(a.opposite, b.opposite);
  EXPECT_EQ(a.vertex_tet, b.vertex_tet);
}

void expect_equal(const Features& a, const Features& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.edges, b.edges);
  EXPECT_EQ(a.faces, b.faces);
  EXPECT_EQ(a.tet_colours, b.tet_colours);
  EXPECT_EQ(a.names, b.names);
}

FieldResult some_field() {
  const TetInput input = box_with_features();
  FieldResult result{input.mesh, input.features, {}, {}};
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (std::size_t t = 0; t < input.mesh.num_tets(); ++t) {
    result.field.frames.push_back(
        Quaternion(normal(random), normal(random), normal(random), normal(random)).normalized());
    result.field.matchings.push_back({0, 23, static_cast<octahedral::Rotation>(t % 24), 5});
  }
  result.codes[edge_key(VertexId(0), VertexId(1))] = -1;
  result.codes[edge_key(VertexId(2), VertexId(1))] = compound_code;
  return result;
}

TEST(Checkpoint, GivesBackEveryValueBitForBit) {
  const ScratchDirectory scratch;
  const TetInput input = box_with_features();
  const FieldResult field = some_field();
  SeamlessResult seamless;
  seamless.map.uvw.assign(input.mesh.num_tets(),
                          {Vec3(0.1, 1e-300, -0.0), Vec3(1, 2, 3), Vec3(4, 5, 6), Vec3(7, 8, 9)});
  seamless.map.rotations.assign(input.mesh.num_tets(), {0, 1, 2, 23});
  seamless.report.inverted = {TetId(3)};
  seamless.report.wrong_edges = {edge_key(VertexId(5), VertexId(2))};
  seamless.report.max_residual = 0.125;
  seamless.newton_steps = 17;
  IgmResult igm{seamless.map, seamless.report, true, "because", {Vec3(1, 2, 3)}, 4, 5};
  HexMesh hexes;
  for (int i = 0; i < 8; ++i) hexes.points.emplace_back(i, i % 2, 0.3 * i);
  hexes.hexes = {{0, 1, 2, 3, 4, 5, 6, 7}};
  hexes.feature_points = {{1, 5}};
  hexes.feature_lines = {{{0, 1}, 6}};
  hexes.feature_quads = {{{0, 1, 2, 3}, 7}};

  Checkpoint written(scratch / "run.h5", "hash of the input");
  written.save({"read", "b0", "{}"}, pack(input));
  written.save({"field", "b1", R"({"seconds":1})"}, pack(field));
  written.save({"seamless", "b2", "{}"}, pack(seamless));
  written.save({"igm", "b3", "{}"}, pack(igm));
  written.save({"extract", "b4", "{}"}, pack(hexes));

  const Checkpoint read = Checkpoint::open(scratch / "run.h5");
  EXPECT_EQ(read.input_hash(), "hash of the input");
  ASSERT_EQ(read.stages().size(), 5u);
  EXPECT_EQ(read.stages()[1].report, R"({"seconds":1})");
  const TetInput input_back = unpack_tet_input(read.load("read"));
  expect_equal(input_back.mesh, input.mesh);
  expect_equal(input_back.features, input.features);
  const FieldResult field_back = unpack_field(read.load("field"));
  expect_equal(field_back.mesh, field.mesh);
  EXPECT_EQ(field_back.codes, field.codes);
  EXPECT_EQ(field_back.field.matchings, field.field.matchings);
  for (std::size_t t = 0; t < field.field.frames.size(); ++t) {
    EXPECT_EQ(field_back.field.frames[t].coeffs(), field.field.frames[t].coeffs());
  }
  const SeamlessResult seamless_back = unpack_seamless(read.load("seamless"), input.mesh.num_tets());
  EXPECT_EQ(seamless_back.map.uvw, seamless.map.uvw);
  EXPECT_TRUE(std::signbit(seamless_back.map.uvw[0][0][2]));
  EXPECT_EQ(seamless_back.map.rotations, seamless.map.rotations);
  EXPECT_EQ(seamless_back.report.inverted, seamless.report.inverted);
  EXPECT_EQ(seamless_back.report.wrong_edges, seamless.report.wrong_edges);
  EXPECT_EQ(seamless_back.newton_steps, 17);
  const IgmResult igm_back = unpack_igm(read.load("igm"), input.mesh.num_tets());
  EXPECT_EQ(igm_back.reason, "because");
  EXPECT_TRUE(igm_back.quantization_valid);
  const HexMesh hexes_back = unpack_hex_mesh(read.load("extract"));
  EXPECT_EQ(hexes_back.points, hexes.points);
  EXPECT_EQ(hexes_back.hexes, hexes.hexes);
  EXPECT_EQ(hexes_back.feature_quads[0].colour, 7);
  EXPECT_THROW(unpack_seamless(read.load("seamless"), 5), Error);
  EXPECT_THROW(unpack_field(read.load("read")), Error);
}

TEST(Checkpoint, ForgetsWhatFollowsARecomputedStage) {
  const ScratchDirectory scratch;
  NamedArrays values;
  values.own("x", std::vector<double>{1, 2, 3}, 1);
  Checkpoint first(scratch / "run.h5", "h");
  for (const char* stage : {"read", "field", "seamless"}) first.save({stage, stage, "{}"}, values);
  Checkpoint second = Checkpoint::open(scratch / "run.h5");
  second.save({"field", "new", "{}"}, values);
  const Checkpoint third = Checkpoint::open(scratch / "run.h5");
  ASSERT_EQ(third.stages().size(), 2u);
  EXPECT_EQ(third.find("field")->basis, "new");
  EXPECT_EQ(third.find("seamless"), nullptr);
  EXPECT_THAT(refusal([&] { third.load("seamless"); }), HasSubstr("no finished stage 'seamless'"));
}

TEST(Checkpoint, RefusesTornFilesOfAnyLength) {
  const ScratchDirectory scratch;
  Checkpoint written(scratch / "run.h5", "h");
  written.save({"read", "b", "{}"}, pack(box_with_features()));
  const std::string whole = bytes_of(scratch / "run.h5");
  ASSERT_LT(whole.size(), 50000u);
  for (std::size_t length = 0; length < whole.size(); length += 499) {
    write_bytes(scratch / "torn.h5", whole.substr(0, length));
    const std::string sentence = refusal([&] { Checkpoint::open(scratch / "torn.h5"); });
    EXPECT_THAT(sentence, HasSubstr("torn.h5")) << length;
  }
  for (std::size_t place = 0; place < whole.size(); place += 211) {
    std::string damaged = whole;
    damaged[place] = static_cast<char>(damaged[place] ^ 0x40);
    write_bytes(scratch / "damaged.h5", damaged);
    // The padding of the user block after its text carries nothing.
    const bool padding = place < 512 && whole[place] == '\0';
    EXPECT_EQ(refusal([&] { Checkpoint::open(scratch / "damaged.h5"); }).empty(), padding) << place;
  }
}

TEST(Checkpoint, AFullDiskIsASentenceAndLeavesTheOldFile) {
  const ScratchDirectory scratch;
  Checkpoint written(scratch / "run.h5", "h");
  written.save({"read", "b", "{}"}, pack(box_with_features()));
  const std::string whole = bytes_of(scratch / "run.h5");
  // Writing beyond a limit on the size of files fails as on a full disk.
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  for (rlim_t bytes : {rlim_t{100}, rlim_t{3000}, rlim_t{9000}}) {
    const rlimit small{bytes, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    NamedArrays values;
    values.own("x", std::vector<double>(20000, 1.5), 1);
    const std::string sentence = refusal([&] { written.save({"field", "b", "{}"}, values); });
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_THAT(sentence, HasSubstr("run.h5")) << bytes;
    EXPECT_EQ(bytes_of(scratch / "run.h5"), whole) << bytes;
  }
  std::signal(SIGXFSZ, old_handler);
  written.save({"field", "b", "{}"}, pack(box_with_features()));
  EXPECT_EQ(Checkpoint::open(scratch / "run.h5").stages().size(), 2u);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(scratch.path()), {}), 1);
}

TEST(Checkpoint, RefusesForeignAndNewerFiles) {
  const ScratchDirectory scratch;
  EXPECT_THAT(refusal([&] { Checkpoint::open(scratch / "none.h5"); }), HasSubstr("No such file"));
  EXPECT_THAT(refusal([&] { Checkpoint::open(scratch.path()); }), HasSubstr("directory"));
  write_bytes(scratch / "foreign.h5", "\x89HDF\r\n\x1a\n" + std::string(600, 'x'));
  EXPECT_THAT(refusal([&] { Checkpoint::open(scratch / "foreign.h5"); }), HasSubstr("not written by hexfield"));
  Checkpoint written(scratch / "run.h5", "h");
  written.save({"read", "b", "{}"}, pack(box_with_features()));
  std::string newer = bytes_of(scratch / "run.h5");
  newer.replace(newer.find("schema 1"), 8, "schema 9");
  write_bytes(scratch / "newer.h5", newer);
  EXPECT_THAT(refusal([&] { Checkpoint::open(scratch / "newer.h5"); }), HasSubstr("newer hexfield"));
}

TEST(IterateRing, KeepsTheNewestWholeIterate) {
  const ScratchDirectory scratch;
  IterateRing ring(scratch.path(), "frames/x", "basis");
  EXPECT_FALSE(ring.newest().has_value());
  ring.save({1, 2});
  ring.save({3, 4});
  EXPECT_EQ(IterateRing(scratch.path(), "frames/x", "basis").newest(), (std::vector<double>{3, 4}));
  EXPECT_FALSE(IterateRing(scratch.path(), "frames/x", "other basis").newest().has_value());
  IterateRing resumed(scratch.path(), "frames/x", "basis");
  resumed.save({5, 6});
  EXPECT_EQ(IterateRing(scratch.path(), "frames/x", "basis").newest(), (std::vector<double>{5, 6}));
  // The third save went into the slot of the first; a torn newest leaves the second.
  const auto torn = scratch / "iterate-frames_x.0.h5";
  write_bytes(torn, bytes_of(torn).substr(0, 700));
  EXPECT_EQ(IterateRing(scratch.path(), "frames/x", "basis").newest(), (std::vector<double>{3, 4}));
  IterateRing::remove_all(scratch.path());
  EXPECT_TRUE(std::filesystem::is_empty(scratch.path()));
}

TEST(WholeFile, OldContentStaysWhenWritingFails) {
  const ScratchDirectory scratch;
  write_bytes(scratch / "a.txt", "old");
  EXPECT_THROW(write_whole_file(scratch / "a.txt",
                                [](const auto& path) {
                                  write_bytes(path, "half");
                                  throw Error(ExitCode::bad_input, "the disk is full");
                                }),
               Error);
  EXPECT_EQ(bytes_of(scratch / "a.txt"), "old");
  write_whole_file(scratch / "a.txt", [](const auto& path) { write_bytes(path, "new"); });
  EXPECT_EQ(bytes_of(scratch / "a.txt"), "new");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(scratch.path()), {}), 1);
  EXPECT_THAT(refusal([&] { make_output_directory(scratch / "a.txt"); }), HasSubstr("is a file"));
}

}  // namespace
}  // namespace hexfield
