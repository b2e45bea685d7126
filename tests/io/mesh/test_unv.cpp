// SPDX-License-Identifier: LGPL-3.0-or-later
// Datasets of .unv in any number and order mean the same as one of each.
#include <cellwalk/io/mesh_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "io/io_fixture.h"

namespace cellwalk::io {
namespace {

std::string dataset_of(int number, const std::vector<std::string>& records) {
  std::string text = "    -1\n  " + std::to_string(number) + "\n";
  for (const std::string& record : records) text += record;
  return text + "    -1\n";
}

struct Unv_records {
  std::vector<std::string> nodes, elements, groups;

  std::string in_one_of_each() const {
    return dataset_of(2411, nodes) + dataset_of(2412, elements) + dataset_of(2467, groups);
  }
};

/// Tetrahedra over a grid of points, masses on some, and groups of them; numbers have gaps.
Unv_records random_unv(std::mt19937& random) {
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const int n = 2 + below(4), gap = 1 + below(3);
  Unv_records result;
  const auto number = [gap](int node) { return std::to_string(7 + gap * node); };
  for (int i = 0; i <= n; ++i)
    for (int k = 0; k < 3; ++k)
      result.nodes.push_back(number(3 * i + k) + " 1 1 11\n " + std::to_string(i) + " " +
                             std::to_string(k == 1) + " " + std::to_string(k == 2) + "\n");
  std::vector<std::string> entities;
  for (int i = 0; i < n; ++i) {
    const std::string element = std::to_string(100 + 2 * i);
    result.elements.push_back(element + " 111 1 1 7 4\n" + number(3 * i) + " " + number(3 * i + 1) + " " +
                              number(3 * i + 2) + " " + number(3 * i + 3) + "\n");
    if (below(2) == 0)
      result.elements.push_back(std::to_string(101 + 2 * i) + " 161 1 1 7 1\n" + number(3 * i) + "\n");
    result.groups.push_back(std::to_string(i + 1) + " 0 0 0 0 0 0 1\nof " + element + "\n 8 " + element +
                            " 0 0\n");
  }
  return result;
}

/// The records dealt to datasets, in a random order of records and datasets.
std::string dealt(const Unv_records& records, std::mt19937& random) {
  std::vector<std::string> datasets{dataset_of(164, {"1 metres 2\n-1 5 6\n1.0 1.0 1.0\n"})};
  for (const auto& [number, all] :
       {std::pair{2411, records.nodes}, std::pair{2412, records.elements}, std::pair{2467, records.groups}}) {
    std::vector<std::string> shuffled = all;
    std::shuffle(shuffled.begin(), shuffled.end(), random);
    while (!shuffled.empty()) {
      const std::size_t size = 1 + random() % shuffled.size();
      datasets.push_back(
          dataset_of(number, {shuffled.end() - static_cast<std::ptrdiff_t>(size), shuffled.end()}));
      shuffled.resize(shuffled.size() - size);
    }
  }
  std::shuffle(datasets.begin(), datasets.end(), random);
  std::string text;
  for (const std::string& dataset : datasets) text += dataset;
  return text;
}

TEST(Unv, DatasetsMayBeSplitAndInAnyOrder) {
  std::mt19937 random(5);
  int nodes_last = 0;
  for (int i = 0; i < 150; ++i) {
    const Unv_records records = random_unv(random);
    const Mesh_file whole = read_mesh("t.unv", records.in_one_of_each());
    const std::string text = dealt(records, random);
    SCOPED_TRACE(text);
    nodes_last += text.rfind("  2411\n") > text.rfind("  2412\n");
    const Mesh_file file = read_mesh("t.unv", text);
    const auto &soup = std::get<Cell_soup<3>>(file.mesh), &expected = std::get<Cell_soup<3>>(whole.mesh);
    EXPECT_EQ(soup.points, expected.points);
    EXPECT_EQ(soup.vertices, expected.vertices);
    EXPECT_EQ(file.groups, whole.groups);
    EXPECT_EQ(file.report.notes, whole.report.notes);
    EXPECT_EQ(file.groups.size(), records.groups.size());
  }
  EXPECT_GT(nodes_last, 30);
  EXPECT_LT(nodes_last, 120);
}

TEST(Unv, NumbersOfNodesThatNoMeshHasAreRefused) {
  Unv_records records;
  records.nodes = {"0 1 1 11\n0 0 0\n"};
  for (const std::string number : {"2147483648", "9223372036854775807", "99999999999999999999", "-7"}) {
    records.nodes.resize(1);
    records.nodes.push_back(number + " 1 1 11\n0 0 1\n");
    const std::string why = refusal([&] { read_mesh("t.unv", records.in_one_of_each()); });
    EXPECT_NE(why.find("is no number of a node"), std::string::npos) << why;
  }
}

// Many small datasets once took time in proportion to their number squared: minutes for these.
TEST(Unv, ManyDatasetsTakeNoLongerThanOne) {
  constexpr int many = 30'000;
  std::string text;
  Unv_records records;
  const auto number = [](int i) { return std::to_string(i + 1); };
  for (int i = 0; i < many; ++i) {
    text += dataset_of(2411, {number(many - 1 - i) + " 1 1 11\n" + number(i) + " 0 0\n"});
    text += dataset_of(2412, {number(i) + " 161 1 1 7 1\n" + number(i) + "\n"});
    text += dataset_of(2467, {number(i) + " 0 0 0 0 0 0 1\nall\n 8 " + number(i) + " 0 0\n"});
  }
  text += dataset_of(2411, {"50001 1 1 11\n0 1 0\n", "50002 1 1 11\n0 0 1\n"});
  text += dataset_of(2412, {"50000 111 1 1 7 4\n1 2 50001 50002\n"});
  EXPECT_EQ(read_mesh("t.unv", text).report.cells, 1u);
}

}  // namespace
}  // namespace cellwalk::io
