// SPDX-License-Identifier: LGPL-3.0-or-later
// Lines split into fields with their quotes, parts of a table for ranks, and the writer of rows.
#include <cellwalk/internal/io/csv.h>
#include <cellwalk/internal/io/mapped_file.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <unordered_set>
#include <utility>

#include "text.h"

namespace cellwalk::io {
namespace {

std::string_view trimmed(std::string_view s) {
  const std::size_t first = s.find_first_not_of(" \t"), last = s.find_last_not_of(" \t");
  return first == std::string_view::npos ? std::string_view{} : s.substr(first, last - first + 1);
}

/// The fields of a line; "" within quotes stands for one quote.
/// \param unquoted keeps those fields that are not as they stand in the line
template <class Add>
void split(const Line_reader& in, std::deque<std::string>& unquoted, Add add) {
  std::string_view rest = in.rest();
  for (bool more = true; more;) {
    const std::size_t first = rest.find_first_not_of(" \t");
    if (first == std::string_view::npos || rest[first] != '"') {
      const std::size_t end = std::min(rest.find(','), rest.size());
      add(trimmed(rest.substr(0, end)));
      more = end < rest.size();
      rest.remove_prefix(more ? end + 1 : end);
      continue;
    }
    std::size_t i = first + 1;
    std::size_t quotes = 0;
    for (; i < rest.size(); ++i) {
      if (rest[i] != '"') continue;
      if (!rest.substr(i + 1).starts_with('"')) break;
      ++quotes;
      ++i;
    }
    if (i >= rest.size()) in.fail("a quote is left open");
    const std::string_view field = rest.substr(first + 1, i - first - 1);
    if (quotes == 0) {
      add(field);
    } else {
      std::string& kept = unquoted.emplace_back();
      for (std::size_t k = 0; k < field.size(); ++k) {
        kept.push_back(field[k]);
        if (field[k] == '"') ++k;
      }
      add(std::string_view(kept));
    }
    rest.remove_prefix(i + 1);
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
    more = rest.starts_with(',');
    if (!more && !rest.empty()) in.fail("text follows a quoted field, where a comma should be");
    if (more) rest.remove_prefix(1);
  }
}

/// Where the bytes of a part begin, of a table whose rows begin at `first`: after the end of a line.
std::size_t begin_of_part(std::string_view text, std::size_t first, std::size_t number, std::size_t count) {
  if (number == count) return text.size();
  const std::size_t about = first + (text.size() - first) / count * number;
  if (about <= first) return first;
  const std::size_t end = text.find('\n', about - 1);
  return end == std::string_view::npos ? text.size() : end + 1;
}

}  // namespace

struct Csv_table::Source {
  std::string text;
  Mapped_file file;                  ///< where the text is one that is mapped
  std::deque<std::string> unquoted;  ///< fields that are not as they stand in the text
};

Csv_table Csv_table::parse(const std::string& name, std::string text, const Table_part& part) {
  const auto source = std::make_shared<Source>();
  source->text = std::move(text);
  return parse(name, source, source->text, part);
}

Csv_table Csv_table::parse(const std::string& name, std::shared_ptr<Source> source, std::string_view text,
                           const Table_part& part) {
  Csv_table table;
  table.name_ = name;
  table.source_ = std::move(source);
  Line_reader in(name, text, std::nullopt);
  const auto next = [&] {
    while (in.next_line()) {
      if (!in.rest().starts_with('#')) return true;
    }
    return false;
  };
  if (!next()) io::fail(name, "holds no header: the names of the columns are to stand in its first line");
  split(in, table.source_->unquoted, [&](std::string_view field) { table.columns_.emplace_back(field); });
  std::unordered_set<std::string_view> names;
  for (const std::string& column : table.columns_) {
    // Tables of pandas and R have the numbers of their rows first, without a name.
    if (column.empty() && &column == &table.columns_.front() && table.columns_.size() > 1) continue;
    if (column.empty()) in.fail("a column without a name");
    if (!names.insert(column).second) in.fail(fmt::format("two columns are named '{}'", shown(column)));
  }
  if (part.count > 1) {
    const std::size_t first = text.size() - in.remaining().size();
    in.narrow(begin_of_part(text, first, part.number, part.count),
              begin_of_part(text, first, part.number + 1, part.count));
  }
  while (next()) {
    split(in, table.source_->unquoted, [&](std::string_view field) { table.fields_.push_back(field); });
    table.field_begin_.push_back(table.fields_.size());
    table.lines_.push_back(in.line());
  }
  return table;
}

Csv_table Csv_table::read(const std::filesystem::path& path, const Table_part& part) {
  if (part.count == 1) return parse(path.string(), load(path));
  // Of a part, the other pages of the file are not copied.
  const auto source = std::make_shared<Source>();
  source->file = map_file(path);
  const std::string_view bytes(reinterpret_cast<const char*>(source->file.bytes.data()),
                               source->file.bytes.size());
  return is_gzip(bytes) ? parse(path.string(), unpack(path.string(), std::string(bytes)), part)
                        : parse(path.string(), source, bytes, part);
}

std::optional<std::size_t> Csv_table::find_column(std::string_view name) const {
  const auto found = std::find(columns_.begin(), columns_.end(), name);
  if (found == columns_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns_.begin());
}

std::size_t Csv_table::column(std::string_view name) const {
  if (const auto found = find_column(name)) return *found;
  constexpr std::size_t most = 20;  // names shown in one line
  const std::size_t named = std::min(most, columns_.size());
  std::string names;
  for (std::size_t c = 0; c < named; ++c)
    if (!columns_[c].empty()) names.append(names.empty() ? "" : ",").append(shown(columns_[c]));
  if (named < columns_.size()) names += fmt::format(" and {} more", columns_.size() - named);
  io::fail(name_, fmt::format("has no column '{}': its header names {}", name, names));
}

std::optional<std::string_view> Csv_table::field(std::size_t row, std::size_t column) const {
  const std::size_t i = field_begin_[row] + column;
  if (i >= field_begin_[row + 1]) return std::nullopt;
  return fields_[i];
}

Parsed_number Csv_table::number(std::size_t row, std::size_t column) const {
  const auto text = field(row, column);
  Parsed_number number = text ? parse_number(*text) : Parsed_number{0, "the row ends before it"};
  if (!number) number.reason = fmt::format("{}: {}", shown(columns_[column]), number.reason);
  return number;
}

std::optional<std::string> Csv_table::row_problem(std::size_t row) const {
  const std::size_t count = field_begin_[row + 1] - field_begin_[row];
  if (count == columns_.size()) return std::nullopt;
  return fmt::format("{} fields, where the header has {}", count, columns_.size());
}

Csv_writer::Csv_writer(std::filesystem::path path, const std::vector<std::string>& columns)
    : Csv_writer(std::make_unique<Atomic_file>(std::move(path)), columns, false) {}

Csv_writer::Csv_writer(std::unique_ptr<Byte_sink> file, const std::vector<std::string>& columns,
                       bool is_continued)
    : own_(std::move(file)), file_(own_.get()), column_count_(columns.size()) {
  if (!is_continued) header(columns);
}

Csv_writer::Csv_writer(Atomic_file& file, const std::vector<std::string>& columns)
    : file_(&file), column_count_(columns.size()) {
  header(columns);
}

Csv_writer::Csv_writer(std::string& text, std::size_t column_count)
    : text_(&text), column_count_(column_count) {}

void Csv_writer::header(const std::vector<std::string>& columns) {
  begin_row(columns.size());
  for (const std::string& column : columns) add(column);
  end_row();
}

void Csv_writer::begin_row(std::size_t count) {
  if (count != column_count_)
    throw Error(Error_code::usage, fmt::format("a row of {} values for {} columns", count, column_count_));
  row_.clear();
  first_ = true;
}

void Csv_writer::end_row() {
  row_.push_back('\n');
  if (text_ != nullptr)
    text_->append(row_);
  else
    file_->write(row_);
}

void Csv_writer::add_bare(std::string_view text) {
  if (!first_) row_.push_back(',');
  first_ = false;
  row_.append(text);
}

void Csv_writer::add(double value) { add_bare(std::isfinite(value) ? shortest(value) : std::string()); }

void Csv_writer::add(std::string_view text) {
  if (text.find_first_of(",\"\n\r#") == std::string_view::npos && text == trimmed(text))
    return add_bare(text);
  std::string quoted = "\"";
  for (char c : text) {
    if (c == '"') quoted.push_back('"');
    quoted.push_back(c == '\n' || c == '\r' ? ' ' : c);
  }
  add_bare(quoted + "\"");
}

void Csv_writer::commit() {
  if (own_) own_->commit();
}

}  // namespace cellwalk::io
