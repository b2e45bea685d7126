// SPDX-License-Identifier: LGPL-3.0-or-later
#include "edge/ccd_queries.h"

#include <cellwalk/internal/io/numbers.h>

#include <zlib.h>

#include <memory>
#include <sstream>
#include <stdexcept>

namespace cellwalk::test {
namespace {

std::string inflate_file(const std::string& file) {
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> in(gzopen(file.c_str(), "rb"), gzclose);
  if (!in) throw std::runtime_error(file + ": cannot be opened");
  std::string text;
  std::array<char, 1 << 16> buffer;
  for (;;) {
    const int count = gzread(in.get(), buffer.data(), buffer.size());
    if (count < 0) throw std::runtime_error(file + ": the gzip stream is damaged");
    if (count == 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

std::vector<std::string> split_fields(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

Ccd_row parse_row(const std::vector<std::string>& fields, std::size_t labels, std::size_t points) {
  if (fields.size() != 2 + labels + 3 * points) throw std::runtime_error("another number of fields");
  Ccd_row row{fields[0] + ":" + fields[1], {}, std::vector<Point<3>>(points)};
  for (std::size_t i = 0; i < labels; ++i) {
    const std::string& label = fields[2 + i];
    if (label != "0" && label != "1") throw std::runtime_error("a label that is not 0 or 1");
    row.labels.push_back(label == "1");
  }
  for (std::size_t i = 0; i < 3 * points; ++i) {
    const io::Parsed_number number = io::parse_number(fields[2 + labels + i]);
    if (!number) throw std::runtime_error(number.reason);
    row.points[i / 3][i % 3] = number.value;
  }
  return row;
}

}  // namespace

std::vector<Ccd_row> read_ccd_rows(const std::string& file, std::size_t labels, std::size_t points) {
  std::vector<Ccd_row> rows;
  std::istringstream in(inflate_file(file));
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.starts_with('#')) continue;
    try {
      rows.push_back(parse_row(split_fields(line), labels, points));
    } catch (const std::exception& e) {
      throw std::runtime_error(file + ":" + std::to_string(number) + ": " + e.what());
    }
  }
  return rows;
}

}  // namespace cellwalk::test
