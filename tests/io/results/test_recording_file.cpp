// SPDX-License-Identifier: LGPL-3.0-or-later
// Motion files, decoded here by what docs/formats.md says: nothing of the writer is used.
#include <cellwalk/internal/io/gzip.h>
#include <cellwalk/internal/io/recording_file.h>

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <random>

#include "io/io_fixture.h"

namespace cellwalk::io {
namespace {

/// A body of three vertices and a particle in a box of 2 x 1 x 4. Its walls have three points.
Recording_scene sample_scene(bool walls_move = false, bool walls_change = false) {
  Recording_scene scene;
  scene.changing_walls = walls_change ? 1 : 0;
  scene.walls_move = walls_move;
  scene.time_step = 0.5;
  scene.steps = 7;
  scene.every = 2;
  scene.cells = 1000000;
  scene.particles = 1;
  scene.bodies = {{false, 2, 1, 0}, {true, 1, 0, 0}};
  scene.upper = {2, 1, 4};
  scene.points = {{0, 0, 0}, {2, 0, 0}, {0, 1, 4}};
  scene.walls = {{0, 1, 2}, {2, 1}};
  scene.edges = {{0, 1}};
  return scene;
}

struct Record {
  std::vector<Point<3>> positions;
  std::vector<std::uint32_t> cells;
  std::vector<Decision> decisions;
  std::vector<std::uint8_t> is_there{};
};

constexpr std::size_t moving = 4, wall_points = 3;

std::vector<Record> sample_records(bool walls_move = false, bool walls_change = false) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<Record> records(5);  // at steps 0, 2, 4, 6, 7
  for (Record& record : records) {
    for (std::size_t i = 0; i < moving; ++i) {
      record.positions.push_back({2 * share(random), share(random), 4 * share(random)});
      record.cells.push_back(static_cast<std::uint32_t>(random() % 1000000));
    }
    for (std::size_t i = 0; walls_move && i < wall_points; ++i)
      record.positions.push_back({2 * share(random), share(random), 4 * share(random)});
    for (int i = 0; i < 2; ++i) record.decisions.push_back(static_cast<Decision>(random() % 8));
    if (walls_change) record.is_there.push_back(random() % 2);
  }
  records[1].positions[0] = {2, 1, 4};
  records[2].positions[0] = {0, 0, 0};  // the largest differences
  return records;
}

void write_sample(const std::filesystem::path& path, bool walls_move = false, bool walls_change = false) {
  Recording_writer writer(path, sample_scene(walls_move, walls_change));
  for (const Record& r : sample_records(walls_move, walls_change))
    writer.add({r.positions, r.cells, r.decisions, r.is_there});
  writer.commit();
}

std::string unzipped(const std::filesystem::path& path) {
  gzFile in = gzopen(path.c_str(), "rb");
  std::string bytes(100000, '\0');
  bytes.resize(static_cast<std::size_t>(gzread(in, bytes.data(), static_cast<unsigned>(bytes.size()))));
  gzclose(in);
  return bytes;
}

template <class T>
T value_at(const std::string& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

int unfolded(std::uint32_t value) {
  return value % 2 == 0 ? static_cast<int>(value / 2) : -static_cast<int>(value / 2) - 1;
}

void expect_every_record(bool walls_move, bool walls_change = false) {
  const Folder folder;
  const std::size_t placed = moving + (walls_move ? wall_points : 0), values = 3 * placed;
  write_sample(folder / "m.gz", walls_move, walls_change);
  const std::string bytes = unzipped(folder / "m.gz");
  ASSERT_TRUE(bytes.starts_with("CWMOTN01"));
  std::size_t at = 12 + value_at<std::uint32_t>(bytes, 8);
  EXPECT_EQ(at % 8, 0u);
  EXPECT_EQ(value_at<double>(bytes, at + 24), 2);
  at += 3 * 24 + 4 * (2 + 5) + 4 * 2;  // points; sizes and corners of walls; one edge
  const auto records = sample_records(walls_move, walls_change);
  const double size[] = {2, 1, 4};
  std::vector<int> last(values), before(values);
  std::vector<std::uint32_t> last_cells(4);
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes.at(i)); };
  for (std::size_t r = 0; r < records.size(); ++r) {
    for (std::size_t i = 0; i < values; ++i) {
      const int expected = r > 1 ? 2 * last[i] - before[i] : last[i];
      const int value = (expected + unfolded(byte(at + i) | byte(at + values + i) << 8)) & 0xffff;
      before[i] = std::exchange(last[i], value);
      EXPECT_LE(std::abs(value * size[i / placed] / 65535 - records[r].positions[i % placed][i / placed]),
                0.50001 * size[i / placed] / 65535);
    }
    at += 2 * values;
    for (std::size_t i = 0; i < 4; ++i) {
      std::uint32_t change = 0;
      for (std::size_t k = 0; k < 4; ++k) change |= std::uint32_t{byte(at + 4 * k + i)} << 8 * k;
      last_cells[i] += static_cast<std::uint32_t>(unfolded(change));
      EXPECT_EQ(last_cells[i], records[r].cells[i]);
    }
    at += 16;
    for (std::size_t b = 0; b < 2; ++b)
      EXPECT_EQ(byte(at++), static_cast<unsigned char>(records[r].decisions[b]));
    for (const std::uint8_t is_there : records[r].is_there) EXPECT_EQ(byte(at++), is_there);
  }
  EXPECT_EQ(at, bytes.size());
}

TEST(RecordingFile, HoldsEveryRecordToTheRoundingOfItsBox) { expect_every_record(false); }
TEST(RecordingFile, HoldsWallsThatMoveAsWell) { expect_every_record(true); }
TEST(RecordingFile, HoldsWallsThatComeAndGoAsWell) {
  expect_every_record(false, true);
  const Folder folder;
  write_sample(folder / "m.gz", true, true);
  EXPECT_EQ(read_recording(folder / "m.gz").scene.changing_walls, 1u);
}

TEST(RecordingFile, ReadsWhatItWrote) {
  const Folder folder;
  write_sample(folder / "m.gz");
  const Recording file = read_recording(folder / "m.gz");
  const Recording_scene expected = sample_scene();
  EXPECT_EQ(file.packed, content_of(folder / "m.gz"));
  EXPECT_EQ(file.scene.frame_count(), 5u);
  EXPECT_EQ(file.scene.moving_count(), 4u);
  EXPECT_EQ(file.scene.points, expected.points);
  EXPECT_EQ(file.scene.walls, expected.walls);
  EXPECT_EQ(file.scene.edges, expected.edges);
  EXPECT_EQ(file.scene.bodies.size(), 2u);
  EXPECT_TRUE(file.scene.bodies[1].is_catheter);
  EXPECT_EQ(file.scene.upper, expected.upper);
}

TEST(RecordingFile, TheSameMotionGivesTheSameBytes) {
  const Folder folder;
  write_sample(folder / "a.gz");
  write_sample(folder / "b.gz");
  EXPECT_EQ(content_of(folder / "a.gz"), content_of(folder / "b.gz"));
}

TEST(RecordingFile, RefusesWhatIsDamaged) {
  const Folder folder;
  write_sample(folder / "m.gz");
  const std::string packed = content_of(folder / "m.gz"), bytes = unzipped(folder / "m.gz");
  const auto refused = [&](const std::string& content) {
    return refusal([&] { read_recording(folder.write("bad.gz", content)); });
  };
  const auto expect = [](const std::string& message, const char* text) {
    EXPECT_NE(message.find(text), std::string::npos) << message;
  };
  expect(refusal([&] { read_recording(folder / "none.gz"); }), "cannot be opened");
  expect(refused("0,0,0"), "not compressed with gzip");
  expect(refused(packed.substr(0, packed.size() - 9)), "damaged or cut short");
  std::string flipped = packed;
  flipped[flipped.size() / 2] ^= 1;
  refused(flipped);
  expect(refused(gzip("ECCDTRC1" + bytes.substr(8))), "does not begin with CWMOTN01");
  expect(refused(gzip(bytes.substr(0, 10))), "cut short");
  expect(refused(gzip(bytes.substr(0, 40))), "its head is cut short");
  expect(refused(gzip(bytes.substr(0, bytes.size() - 1))), "bytes, and");
  expect(refused(gzip(bytes + "x")), "bytes, and");
  const std::size_t head = 12, points = head + value_at<std::uint32_t>(bytes, 8), corners = points + 72 + 8;
  expect(refused(gzip(std::string(bytes).replace(head, 1, "["))), "its head cannot be read");
  expect(refused(gzip(with(bytes, "\"cells\":1000000", "\"cells\":1e00300"))), "its head cannot be read");
  expect(refused(gzip(std::string(bytes).replace(corners, 1, "\x09"))), "names point 9 of 3");
  expect(refused(gzip(std::string(bytes).replace(points + 72, 1, "\x09"))), "more corners than there are");
  const std::size_t every = bytes.find("\"every\":2");
  expect(refused(gzip(std::string(bytes).replace(every, 9, "\"every\":3"))), "do not fit");
  EXPECT_EQ(refused_truncations(
                bytes, [&](const std::string& part) { read_recording(folder.write("cut.gz", gzip(part))); }),
            20);
}

TEST(RecordingFile, AnnouncedRecordsMustCome) {
  const Folder folder;
  const auto records = sample_records();
  const auto add = [&](std::size_t count) {
    Recording_writer writer(folder / "m.gz", sample_scene());
    for (std::size_t i = 0; i < count; ++i)
      writer.add({records[i].positions, records[i].cells, records[i].decisions});
    writer.commit();
  };
  refusal([&] { add(4); }, Error_code::usage);
  Recording_writer writer(folder / "m.gz", sample_scene());
  refusal([&] { writer.add({{}, {}, {}}); }, Error_code::usage);
  EXPECT_FALSE(std::filesystem::exists(folder / "m.gz"));
}

TEST(Gzip, PiecesAndBase64AreWhatOthersRead) {
  const Folder folder;
  std::string all;
  Gzip_file file(folder / "a.gz");
  for (int i = 0; i < 5000; ++i) {
    const std::string piece = std::to_string(i * i) + ",";
    file.write(piece);
    all += piece;
  }
  file.commit();
  EXPECT_EQ(unzipped(folder / "a.gz"), all);
  EXPECT_EQ(unzipped(folder.write("b.gz", gzip(all))), all);
  EXPECT_EQ(unzipped(folder.write("c.gz", gzip(""))), "");
  const auto base64 = [](const std::string& text) {
    std::string out;
    append_base64(out, {reinterpret_cast<const unsigned char*>(text.data()), text.size()});
    return out;
  };
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

}  // namespace
}  // namespace cellwalk::io
