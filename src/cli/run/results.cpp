// SPDX-License-Identifier: LGPL-3.0-or-later
// The report, the recording and the contacts of a run, each checked as it is read.
#include "results.h"

#include <cellwalk/internal/io/csv.h>
#include <cellwalk/internal/io/json_file.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <vector>

#include "cli/common/contact_kind_names.h"

namespace cellwalk::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

[[noreturn]] void refuse(const fs::path& path, const std::string& what) {
  throw Error(Error_code::input, path.string() + ": " + what);
}

ordered_json read_report(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(in), {});
  try {
    ordered_json report = io::parse_ordered_json(path.string(), text);
    for (const char* key : {"dimension", "steps", "environment", "contacts", "manifest"}) report.at(key);
    for (const char* key : {"cells", "walls"}) report.at("environment").at(key).get<std::uint64_t>();
    for (const char* kind : contact_kind_names) report.at("contacts").at(kind).get<std::uint64_t>();
    return report;
  } catch (const nlohmann::json::exception&) {
    refuse(path, "is damaged: it is not the report of a run; run the scene again");
  }
}

template <class T>
void append(std::string& bytes, const std::vector<T>& values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

/// The table's rows; every row is needed, so one that cannot be read is an error here.
class Contact_table {
 public:
  Contact_table(const fs::path& path, std::uint32_t steps, bool in_space)
      : table_(io::Csv_table::read(path)), steps_(steps), in_space_(in_space) {}

  std::size_t size() const { return table_.row_count(); }

  std::string packed() const {
    std::vector<std::uint32_t> step;
    std::vector<float> point, normal;
    std::vector<std::uint8_t> kind;
    for (std::size_t row = 0; row < size(); ++row) {
      const double number = value(row, step_column_);
      if (!(number >= (step.empty() ? 1 : step.back()) && number <= steps_))
        refuse_row(row, "its step is not one of the run, in order");
      step.push_back(static_cast<std::uint32_t>(number));
      kind.push_back(kind_of(row));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const bool is_there = axis < 2 || in_space_;
        point.push_back(is_there ? static_cast<float>(value(row, point_columns_[axis])) : 0);
        normal.push_back(is_there ? static_cast<float>(value(row, normal_columns_[axis])) : 0);
      }
    }
    std::string bytes;
    append(bytes, std::vector{static_cast<std::uint32_t>(size())});
    append(bytes, step);
    append(bytes, point);
    append(bytes, normal);
    append(bytes, kind);
    return bytes;
  }

 private:
  using Columns = std::array<std::size_t, 3>;

  [[noreturn]] void refuse_row(std::size_t row, const std::string& what) const {
    refuse(fmt::format("{}:{}", table_.name(), table_.line(row)), what + "; run the scene again");
  }

  double value(std::size_t row, std::size_t column) const {
    const io::Parsed_number number = table_.number(row, column);
    if (!number) refuse_row(row, number.reason);
    return number.value;
  }

  std::uint8_t kind_of(std::size_t row) const {
    const auto word = table_.field(row, kind_column_);
    const auto found =
        std::find(std::begin(contact_kind_names), std::end(contact_kind_names), word.value_or(""));
    if (found == std::end(contact_kind_names)) refuse_row(row, "its kind is none");
    return static_cast<std::uint8_t>(found - std::begin(contact_kind_names));
  }

  Columns columns(const char* x, const char* y, const char* z) const {
    return {table_.column(x), table_.column(y), table_.column(z)};
  }

  io::Csv_table table_;
  std::uint32_t steps_;
  bool in_space_;
  std::size_t step_column_ = table_.column("step"), kind_column_ = table_.column("kind");
  Columns point_columns_ = columns("x", "y", "z"), normal_columns_ = columns("nx", "ny", "nz");
};

}  // namespace

Run_results read_run(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    refuse(folder, "is no folder: name the one that cellwalk run wrote");
  if (!fs::is_regular_file(folder / "run.json", ignored))
    refuse(folder, "holds no run.json, so it is no run: name a folder that cellwalk run wrote");
  Run_results results;
  results.report = read_report(folder / "run.json");
  const fs::path motion = folder / "motion.gz";
  if (!fs::exists(motion, ignored))
    refuse(motion, "is missing: run the scene again, with output.motion_every left out or more than 0");
  results.motion = io::read_recording(motion);
  const Recording_scene& scene = results.motion.scene;
  if (results.report["steps"] != scene.steps || results.report["dimension"] != scene.dimension)
    refuse(motion, "belongs to another run than run.json beside it; run the scene again");
  const Contact_table contacts(folder / "contacts.csv", scene.steps, scene.dimension == 3);
  results.contact_count = contacts.size();
  results.contacts = contacts.packed();
  return results;
}

}  // namespace cellwalk::cli
