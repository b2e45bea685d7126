// SPDX-License-Identifier: LGPL-3.0-or-later
// Imports of scenes: options by name, and environments that are kept as long as nothing differs.
#include <cellwalk/environment/compiled.h>
#include <cellwalk/internal/loading/import_call.h>

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "io/mesh/foam_mesh.h"

namespace cellwalk {
namespace {

namespace fs = std::filesystem;

class ImportCalls : public testing::Test {
 protected:
  ImportCalls() : folder_(fs::temp_directory_path() / ("cellwalk_imports_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    write("mesh.off", two_triangles);
    call_.file = folder_ / "mesh.off";
    call_.cache = folder_ / "cache";
  }
  ~ImportCalls() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }

  std::size_t kept() const {
    return fs::exists(call_.cache)
               ? static_cast<std::size_t>(std::distance(fs::directory_iterator(call_.cache), {}))
               : 0;
  }
  /// Imports the mesh, and says how.
  std::string said(const Build_options& options = {}) const {
    const Kept_import got = import_or_reopen(call_, options);
    const auto& environment = of_dimension<2>(got.loaded.environment);
    EXPECT_EQ(environment.is_frozen(), !options.keep_map);
    EXPECT_EQ(got.loaded.built.certificate.cells, environment.snapshot().cell_count());
    return got.lines.front();
  }
  std::string refused() const {
    try {
      import_or_reopen(call_, {});
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Error_code::input);
      return error.what();
    }
    ADD_FAILURE() << "nothing was refused";
    return {};
  }

  static constexpr const char* two_triangles = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
  fs::path folder_;
  Import_call call_;
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(ImportCalls, AreMadeOnceForTheSameContent) {
  EXPECT_TRUE(contains(said(), "kept for the next run"));
  EXPECT_EQ(kept(), 1u);
  EXPECT_TRUE(contains(said(), "from the cache"));
  EXPECT_TRUE(contains(said({.keep_map = false}), "from the cache"));
  // The same bytes, written later and under another name.
  fs::rename(call_.file, folder_ / "other.off");
  call_.file = folder_ / "other.off";
  EXPECT_TRUE(contains(said(), "from the cache"));
  EXPECT_EQ(kept(), 1u);
}

TEST_F(ImportCalls, AreMadeAgainForOtherContentOrOptions) {
  said();
  write("mesh.off", std::string(two_triangles) + "# the same mesh, other bytes\n");
  EXPECT_TRUE(contains(said(), "kept for the next run"));
  call_.options["duplicates"] = std::string("keep");
  EXPECT_TRUE(contains(said(), "kept for the next run"));
  EXPECT_TRUE(contains(said({.simplicial = true}), "kept for the next run"));
  EXPECT_EQ(kept(), 4u);
  write("mesh.off", two_triangles);
  call_.options.clear();
  EXPECT_TRUE(contains(said(), "from the cache")) << "as at first";
}

TEST_F(ImportCalls, AreMadeAgainForOtherContentBesideTheFile) {
  test::Foam_mesh mesh = test::foam_block(2);
  write("case.foam", "");
  std::size_t count = 0;
  for (const char* name : {"polyMesh", "polyMesh/points", "case.foam"}) {
    SCOPED_TRACE(name);
    call_.file = folder_ / name;
    for (const char* patch : {"inlet", "mouth"}) {
      mesh.patches[0].name = patch;
      test::write_foam(folder_ / "polyMesh", test::Foam_writer().files(mesh));
      EXPECT_TRUE(contains(import_or_reopen(call_, {}).lines.front(), "kept for the next run"));
      EXPECT_EQ(kept(), ++count);
      EXPECT_TRUE(contains(import_or_reopen(call_, {}).lines.front(), "from the cache"));
    }
  }
}

TEST_F(ImportCalls, ReplaceWhatIsDamaged) {
  said();
  const fs::path file = fs::directory_iterator(call_.cache)->path();
  std::string bytes(fs::file_size(file), '\0');
  std::ifstream(file, std::ios::binary).read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes[bytes.size() / 2] ^= 1;
  std::ofstream(file, std::ios::binary) << bytes;
  const Kept_import again = import_or_reopen(call_, {});
  ASSERT_GE(again.lines.size(), 3u);
  EXPECT_TRUE(contains(again.lines[0], "kept for the next run"));
  EXPECT_TRUE(contains(again.lines[1], "the cache was damaged: "));
  EXPECT_TRUE(contains(again.lines[2], "read: "));
  EXPECT_TRUE(contains(said(), "from the cache"));
  EXPECT_EQ(kept(), 1u);
}

TEST_F(ImportCalls, DoWithoutACache) {
  write("cache", "a file where the folder should be");
  for (int i = 0; i < 2; ++i) EXPECT_TRUE(contains(said(), "and not kept for the next run: ")) << said();
  EXPECT_TRUE(fs::is_regular_file(call_.cache));
}

TEST_F(ImportCalls, GiveTheSameEnvironmentFromTheCache) {
  const auto bytes_of = [](const Kept_import& got) {
    return compile_to_bytes<2>(of_dimension<2>(got.loaded.environment), got.loaded.built.certificate, {});
  };
  const auto first = bytes_of(import_or_reopen(call_, {}));
  EXPECT_EQ(bytes_of(import_or_reopen(call_, {})), first);
  fs::remove_all(call_.cache);
  write("cache", "");
  EXPECT_EQ(bytes_of(import_or_reopen(call_, {})), first);
}

TEST_F(ImportCalls, KeepNothingThatIsRefused) {
  write("mesh.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n");
  EXPECT_THROW(import_or_reopen(call_, {}), Error);
  call_.file = folder_ / "none.off";
  EXPECT_TRUE(contains(refused(), "none.off"));
  EXPECT_EQ(kept(), 0u);
}

TEST_F(ImportCalls, TakeEveryOption) {
  call_.obstacles = {"b.off"};
  call_.options = {{"mesher", std::string("mesh3")},
                   {"quality", 0.0},
                   {"cell_size", 2.0},
                   {"distance", 3.0},
                   {"tissue", 4.0},
                   {"split", false},
                   {"keep_obstacles", true},
                   {"time_limit", 5.0},
                   {"simplicial", true},
                   {"duplicates", std::string("merge")}};
  const Import_options options = import_options(call_);
  EXPECT_EQ(options.obstacles, call_.obstacles);
  EXPECT_EQ(options.mesher.mesher, Mesher::mesh3);
  EXPECT_EQ(options.mesher.quality, 0.0);
  EXPECT_EQ(options.mesher.cell_size, 2);
  EXPECT_EQ(options.mesher.distance, 3);
  EXPECT_EQ(options.tissue, 4);
  EXPECT_FALSE(options.build.split);
  EXPECT_TRUE(options.mesher.keep_obstacles);
  EXPECT_EQ(options.mesher.time_limit, 5);
  EXPECT_TRUE(options.build.simplicial);
  EXPECT_EQ(options.build.duplicates, Duplicate_vertices::merge);
  for (const auto& [name, value] : call_.options) {
    Import_call wrong = call_;
    wrong.options[name] = std::vector<double>{1, 2};
    EXPECT_THROW(import_options(wrong), Error) << name;
  }
}

TEST_F(ImportCalls, RefuseOptionsThatAreNone) {
  call_.options = {{"qualty", 2.0}};
  EXPECT_EQ(refused(),
            "qualty: unknown key; known here: cell_size, conform, distance, duplicates, import, inside, "
            "keep_obstacles, max_move, mesher, obstacle, quality, seam, sheets, simplicial, split, strict, "
            "time_limit, tissue, weld");
  call_.options = {{"quality", -1.0}};
  EXPECT_EQ(refused(), "quality: expected a number of at least 0");
  call_.options = {{"mesher", std::string("gmsh")}};
  EXPECT_EQ(refused(), "mesher: expected \"tetgen\" or \"mesh3\"");
}

}  // namespace
}  // namespace cellwalk
