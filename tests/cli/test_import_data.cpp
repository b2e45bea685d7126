// SPDX-License-Identifier: LGPL-3.0-or-later
// Public meshes: every sample becomes a certified environment, or is refused with one line.
#include <nlohmann/json.hpp>

#include <algorithm>

#include "cli/program.h"

namespace cellwalk::test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> samples(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(fs::path(CELLWALK_TEST_DATA) / folder))
    names.push_back(folder + "/" + entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

class Sample : public Program, public testing::WithParamInterface<std::string> {
 protected:
  std::string mesh() const { return (fs::path(CELLWALK_TEST_DATA) / GetParam()).string(); }

  Outcome import() const { return run({"import", mesh(), "-o", "env.ovm", "--json", "report.json"}); }

  /// check agrees with what import said.
  void expect_certified() const {
    succeed({"check", "env.ovm", "--json", "check.json"});
    expect_same_certificate(path("report.json"), path("check.json"));
    EXPECT_GT(nlohmann::json::parse(text("report.json")).at("certificate").at("free_volume"), 0);
  }

  void expect_refusal(const Outcome& outcome) const {
    EXPECT_TRUE(outcome.exit_code == 3 || outcome.exit_code == 4) << outcome.exit_code << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("cellwalk: " + mesh() + ":")) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(files(), std::vector<std::string>{});
  }
};

using GoodSample = Sample;
using BadSample = Sample;

TEST_P(GoodSample, BecomesACertifiedEnvironment) {
  const Outcome outcome = import();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_certified();
}

TEST_P(BadSample, IsMendedOpenlyOrRefusedWithAReason) {
  const Outcome outcome = import();
  if (outcome.exit_code == 0)
    expect_certified();
  else
    expect_refusal(outcome);
}

INSTANTIATE_TEST_SUITE_P(Tet, GoodSample, testing::ValuesIn(samples("tet")), test_name);
INSTANTIATE_TEST_SUITE_P(Surface, GoodSample, testing::ValuesIn(samples("surface")), test_name);
INSTANTIATE_TEST_SUITE_P(HexPoly, GoodSample, testing::ValuesIn(samples("hex_poly")), test_name);
INSTANTIATE_TEST_SUITE_P(Bad, BadSample, testing::ValuesIn(samples("bad")), test_name);

}  // namespace
}  // namespace cellwalk::test
