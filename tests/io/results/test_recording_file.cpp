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
  scene.walls_change = walls_change;
  scene.walls_move = walls_move;
  scene.time_step = 0.5;
  scene.steps = 7;
  scene.every = 2;
  scene.cells = 1000000;
  scene.particles = 1;
  scene.bodies = {{false, 2, 1, 0, 0.1}, {true, 1, 0, 0}};
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
  Walls_change change{};
};

constexpr std::size_t moving = 4, wall_points = 3, change_at = 3;
const std::vector<Point<3>> new_points{{1, 0.5, 4}, {0.5, 1, 1}};

std::vector<Record> sample_records(bool walls_move = false, bool walls_change = false) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<Record> records(5);  // at steps 0, 2, 4, 6, 7
  for (Record& record : records) {
    for (std::size_t i = 0; i < moving; ++i) {
      record.positions.push_back({2 * share(random), share(random), 4 * share(random)});
      record.cells.push_back(static_cast<std::uint32_t>(random() % 1000000));
    }
    const std::size_t r = static_cast<std::size_t>(&record - records.data());
    const std::size_t points = wall_points + (walls_change && r >= change_at ? new_points.size() : 0);
    for (std::size_t i = 0; walls_move && i < points; ++i)
      record.positions.push_back({2 * share(random), share(random), 4 * share(random)});
    for (int i = 0; i < 2; ++i) record.decisions.push_back(static_cast<Decision>(random() % 8));
  }
  if (walls_change) {
    records[change_at].change.points = new_points;
    records[change_at].change.walls = {{1}, {{0, 3, 4, 2}, {4, 1}}};
    records[change_at].change.lines = {{}, {{0, 4}}};
    records[4].change.walls = {{1, 2}, {}};
    if (walls_move) records[change_at].positions.back() = new_points.back();
  }
  records[1].positions[0] = {2, 1, 4};
  records[2].positions[0] = {0, 0, 0};  // the largest differences
  return records;
}

void write_sample(const std::filesystem::path& path, bool walls_move = false, bool walls_change = false) {
  Recording_writer writer(path, sample_scene(walls_move, walls_change));
  for (const Record& r : sample_records(walls_move, walls_change))
    writer.add({r.positions, r.cells, r.decisions, walls_change ? &r.change : nullptr});
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
  std::size_t placed = moving + (walls_move ? wall_points : 0);
  write_sample(folder / "m.gz", walls_move, walls_change);
  const std::string bytes = unzipped(folder / "m.gz");
  ASSERT_TRUE(bytes.starts_with("CWMOTN01"));
  std::size_t at = 12 + value_at<std::uint32_t>(bytes, 8);
  EXPECT_EQ(at % 8, 0u);
  EXPECT_EQ(value_at<double>(bytes, at + 24), 2);
  at += 3 * 24 + 4 * (2 + 5) + 4 * 2;  // points; sizes and corners of walls; one edge
  const auto records = sample_records(walls_move, walls_change);
  const double size[] = {2, 1, 4};
  std::vector<std::vector<int>> last(3, std::vector<int>(placed)), before = last;  // of each axis
  std::vector<std::uint32_t> last_cells(4);
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes.at(i)); };
  const auto numbers = [&](std::size_t count) {
    std::vector<std::uint32_t> read;
    for (std::size_t i = 0; i < count; ++i, at += 4) read.push_back(value_at<std::uint32_t>(bytes, at));
    return read;
  };
  for (std::size_t r = 0; r < records.size(); ++r) {
    const Walls_change& change = records[r].change;
    if (walls_change) {
      ASSERT_EQ(numbers(1)[0], change.points.size());
      for (const Point<3>& x : change.points)
        for (std::size_t axis = 0; axis < 3; ++axis, at += 8) EXPECT_EQ(value_at<double>(bytes, at), x[axis]);
      for (const Loops_change* loops : {&change.walls, &change.floor, &change.lines}) {
        const auto counts = numbers(3);
        EXPECT_EQ(numbers(counts[0]), loops->toggled);
        std::vector<std::vector<std::uint32_t>> added;
        for (const std::uint32_t corners : numbers(counts[1])) added.emplace_back(corners);
        for (auto& loop : added) loop = numbers(loop.size());
        EXPECT_EQ(added, loops->added);
      }
    }
    for (std::size_t axis = 0; walls_move && axis < 3; ++axis)
      for (const Point<3>& x : change.points)
        for (auto* places : {&last, &before})
          (*places)[axis].push_back(static_cast<int>(std::lround(x[axis] / size[axis] * 65535)));
    placed = last[0].size();
    for (std::size_t axis = 0, k = at; axis < 3; ++axis)
      for (std::size_t i = 0; i < placed; ++i, ++k) {
        int& was = last[axis][i];
        const int expected = r > 1 ? 2 * was - before[axis][i] : was;
        const int value = (expected + unfolded(byte(k) | byte(k + 3 * placed) << 8)) & 0xffff;
        before[axis][i] = std::exchange(was, value);
        EXPECT_LE(std::abs(value * size[axis] / 65535 - records[r].positions[i][axis]),
                  0.50001 * size[axis] / 65535);
      }
    // A point that appears where it then is takes no more than zeros.
    if (walls_move && !change.points.empty()) {
      EXPECT_EQ(byte(at + 3 * placed - 1), 0);
    }
    at += 6 * placed;
    for (std::size_t i = 0; i < 4; ++i) {
      std::uint32_t folded = 0;
      for (std::size_t k = 0; k < 4; ++k) folded |= std::uint32_t{byte(at + 4 * k + i)} << 8 * k;
      last_cells[i] += static_cast<std::uint32_t>(unfolded(folded));
      EXPECT_EQ(last_cells[i], records[r].cells[i]);
    }
    at += 16;
    for (std::size_t b = 0; b < 2; ++b)
      EXPECT_EQ(byte(at++), static_cast<unsigned char>(records[r].decisions[b]));
  }
  EXPECT_EQ(at, bytes.size());
}

TEST(RecordingFile, HoldsEveryRecordToTheRoundingOfItsBox) { expect_every_record(false); }
TEST(RecordingFile, HoldsWallsThatMoveAsWell) { expect_every_record(true); }
TEST(RecordingFile, HoldsWallsThatComeAndGoAsWell) {
  for (const bool walls_move : {false, true}) {
    expect_every_record(walls_move, true);
    const Folder folder;
    write_sample(folder / "m.gz", walls_move, true);
    EXPECT_TRUE(read_recording(folder / "m.gz").scene.walls_change);
  }
}

TEST(RecordingFile, RefusesWallsThatComeAndGoWithoutSense) {
  const Folder folder;
  write_sample(folder / "m.gz", false, true);
  const std::string bytes = unzipped(folder / "m.gz");
  const auto expect = [&](const std::string& content, const char* text) {
    const std::string message = refusal([&] { read_recording(folder.write("bad.gz", gzip(content))); });
    EXPECT_NE(message.find(text), std::string::npos) << message;
  };
  const std::size_t head = 12 + value_at<std::uint32_t>(bytes, 8), frames = head + 72 + 28 + 8,
                    frame = 40 + 6 * moving + 4 * moving + 2, change = frames + change_at * frame,
                    loops = change + 4 + 48 + 12;
  ASSERT_EQ(value_at<std::uint32_t>(bytes, change), 2u);
  ASSERT_EQ(value_at<std::uint32_t>(bytes, loops), 1u);
  const auto with_byte = [&](std::size_t at, char value) {
    return std::string(bytes).replace(at, 1, 1, value);
  };
  expect(with_byte(loops, 2), "it names loop 2 of 2");
  expect(with_byte(loops + 4, 5), "there are not as many corners as loops have");
  expect(with_byte(loops + 12, 5), "it names point 5 of 5");
  expect(with_byte(change + 3, 1), "a frame is cut short");
  expect(bytes.substr(0, frames - 1), "bytes, and");
  expect(bytes.substr(0, bytes.size() - 1), "a frame is cut short");
  expect(bytes + "x", "after its last frame there are 1 bytes");
  // A loop that a later frame names must have come before.
  const std::size_t last = bytes.size() - frame - 8;
  ASSERT_EQ(value_at<std::uint32_t>(bytes, last + 16 + 4), 2u);
  expect(with_byte(last + 16 + 4, 4), "it names loop 4 of 4");
  EXPECT_EQ(refused_truncations(
                bytes, [&](const std::string& part) { read_recording(folder.write("cut.gz", gzip(part))); }),
            20);
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
  EXPECT_EQ(file.scene.bodies[0].radius, 0.1);
  EXPECT_EQ(file.scene.bodies[1].radius, 0);
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
  const Record& first = records[0];
  refusal(
      [&] {
        writer.add({first.positions, first.cells, first.decisions, &first.change});
      },
      Error_code::usage);
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
