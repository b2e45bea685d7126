// SPDX-License-Identifier: LGPL-3.0-or-later
// Tables of comma-separated values: columns by name, rows with their line. Read here, since a malformed field
// must invalidate its row only, with a reason, and numbers may be fractions or hexadecimal.
#ifndef CELLWALK_INTERNAL_IO_CSV_H
#define CELLWALK_INTERNAL_IO_CSV_H

#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/internal/io/numbers.h>

#include <concepts>
#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cellwalk::io {

/// Which rows of a table: of `count` parts, about equal in bytes and in the order of rows, that with a number
/// below it.
struct Table_part {
  std::size_t number = 0, count = 1;
};

/// A table in memory. The first line that is neither blank nor a comment (#) is the header. Fields may be
/// quoted (""). A row of the wrong length does not invalidate the table; only its own numbers are invalid.
class Csv_table {
 public:
  /// \throw Error(input) with file and line: no header, a column named twice or not at all, a quote left open
  static Csv_table read(const std::filesystem::path& path, const Table_part& part = {});
  static Csv_table parse(const std::string& name, std::string text, const Table_part& part = {});

  std::size_t row_count() const { return lines_.size(); }
  const std::vector<std::string>& columns() const { return columns_; }

  std::optional<std::size_t> find_column(std::string_view name) const;
  /// \throw Error(input) naming the existing columns
  std::size_t column(std::string_view name) const;

  /// The line of a row in the file, from 1.
  std::size_t line(std::size_t row) const { return lines_[row]; }
  /// A field; none if the row is too short.
  std::optional<std::string_view> field(std::size_t row, std::size_t column) const;
  /// A field as a finite number, or the reason why it is none, with the column.
  Parsed_number number(std::size_t row, std::size_t column) const;
  /// The reason why a whole row is invalid (a wrong number of fields); none if it is valid.
  std::optional<std::string> row_problem(std::size_t row) const;

  const std::string& name() const { return name_; }

 private:
  struct Source;  ///< the text that fields are part of

  static Csv_table parse(const std::string& name, std::shared_ptr<Source> source, std::string_view text,
                         const Table_part& part);

  std::string name_;
  std::shared_ptr<Source> source_;
  std::vector<std::string> columns_;
  std::vector<std::string_view> fields_;     ///< of all rows
  std::vector<std::size_t> field_begin_{0};  ///< fields of row r: [field_begin_[r], field_begin_[r+1])
  std::vector<std::size_t> lines_;
};

/// Writes a table, which appears complete on commit() or not at all.
class Csv_writer {
 public:
  /// \throw Error(other) if the file cannot be written
  Csv_writer(std::filesystem::path path, const std::vector<std::string>& columns);
  /// \param is_continued the file has the header already
  Csv_writer(std::unique_ptr<Byte_sink> file, const std::vector<std::string>& columns, bool is_continued);
  /// Writes into a file that the caller commits, and that outlives the writer.
  Csv_writer(Atomic_file& file, const std::vector<std::string>& columns);
  /// Appends rows to a text that outlives the writer, without a header.
  Csv_writer(std::string& text, std::size_t column_count);

  /// Writes one row, with a value for each column: texts (quoted where needed), integers, and doubles in the
  /// shortest form that reads back the same; a double that is not finite is empty.
  /// \throw Error(usage) for a wrong number of values
  template <class... Values>
  void row(const Values&... values) {
    begin_row(sizeof...(values));
    (add(values), ...);
    end_row();
  }

  /// Completes a file of the writer's own.
  /// \throw Error(other) if it cannot be written
  void commit();

 private:
  void header(const std::vector<std::string>& columns);
  void begin_row(std::size_t count);
  void end_row();
  void add(double value);
  void add(std::string_view text);
  void add(const char* text) { add(std::string_view(text)); }
  void add(const std::string& text) { add(std::string_view(text)); }
  template <std::integral Integer>
  void add(Integer value) {
    add_bare(std::to_string(value));
  }
  void add_bare(std::string_view text);

  std::unique_ptr<Byte_sink> own_;
  Byte_sink* file_ = nullptr;
  std::string* text_ = nullptr;  ///< instead of a file
  std::size_t column_count_;
  std::string row_;
  bool first_ = true;
};

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_CSV_H
