// SPDX-License-Identifier: LGPL-3.0-or-later
// The rows of each rank, answered and then gathered, and the requested picture and repro file.
#include "table.h"

#include <cellwalk/internal/io/query_file.h>
#include <cellwalk/internal/io/vtu.h>
#include <cellwalk/internal/kernel/byte_archive.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "answers.h"
#include "cli/common/counts_json.h"
#include "cli/common/environment_file.h"
#include "cli/common/printable.h"
#include "picture.h"
#include "pieces.h"
#include "walk_repro.h"

namespace cellwalk::cli {
namespace {

template <class T>
std::string to_message(const T& value) {
  detail::Byte_writer out;
  out(value);
  return out.message();
}

template <class T>
T from_message(std::string_view message) {
  return detail::Byte_reader(message).next<T>();
}

/// The answers of a rank to its rows.
struct Answered {
  std::array<std::uint64_t, std::size(motion_status_names)> tally{};
  Edge_counts counts;
  std::size_t line = 0;  ///< of the first invalid row; 0: none
  std::string error;     ///< of that row

  /// Adds answers to the next rows.
  template <class Answers, class Rows>
  void add(const Answers& answers, const Rows& rows) {
    for (const auto& a : answers) ++tally[static_cast<std::size_t>(a.status)];
    if (line != 0) return;
    const auto invalid =
        std::find_if(rows.begin(), rows.end(), [](const auto& row) { return !row.error.empty(); });
    if (invalid == rows.end()) return;
    line = invalid->line;
    error = invalid->error;
  }

  /// Adds those of the rank that is next.
  void add(const Answered& next) {
    for (std::size_t s = 0; s < tally.size(); ++s) tally[s] += next.tally[s];
    counts += next.counts;
    if (line == 0) line = next.line, error = next.error;
  }

  /// See byte_archive.h.
  template <class Archive>
  void archive(Archive& a) {
    a(tally, counts, line, error);
  }
};

/// Completes all files and prints the number of answers of each status.
void report(const Query_options& options, Query_files& files, const Answered& answered, bool has_radii) {
  nlohmann::ordered_json by_status = nlohmann::ordered_json::object();
  std::string line;
  std::uint64_t motions = 0;
  for (std::size_t s = 0; s < answered.tally.size(); ++s) {
    if (Motion_status{static_cast<std::uint8_t>(s)} == Motion_status::close && !has_radii) continue;
    motions += answered.tally[s];
    by_status[motion_status_names[s]] = answered.tally[s];
    if (answered.tally[s] != 0)
      line += fmt::format("{} {} {}", line.empty() ? ":" : ",", answered.tally[s], motion_status_names[s]);
  }
  nlohmann::ordered_json counts;
  if (options.mode == Query_mode::sweep) {
    counts = cli::to_json(answered.counts);
    counts["walk"] = cli::to_json(answered.counts.walk);
  } else {
    counts = cli::to_json(answered.counts.walk);
  }
  write_json(files.json, {{"motions", motions}, {"status", by_status}, {"counts", counts}});
  files.all.commit(fmt::format("{}: {} motions{}\n", options.output, motions, line));
  if (answered.line != 0)
    fmt::print(stderr, "cellwalk: {}:{}: {}; rows marked invalid: {}\n", printable(options.queries),
               answered.line, printable(answered.error),
               answered.tally[static_cast<std::size_t>(Motion_status::invalid)]);
}

/// The number of the first row of this rank in the whole table.
std::size_t first_row(Ranks& ranks, std::size_t rows) {
  std::vector<std::size_t> firsts;
  std::size_t sum = 0;
  const auto add = [&](std::size_t of_rank) {
    firsts.push_back(sum);
    sum += of_rank;
  };
  ranks.gather(to_message(rows),
               [&](const std::string& of_rank) { add(from_message<std::size_t>(of_rank)); });
  const std::string shared = ranks.broadcast(to_message(firsts));
  return from_message<std::vector<std::size_t>>(shared)[ranks.rank()];
}

/// The row of which a repro file or a picture is requested, on the first rank; none if none is.
/// \throw Error(usage) if there is no such valid row, before anything is answered
template <int D, std::size_t N>
std::optional<Query_row<D, N>> wanted_row(const Query_options& options, Ranks& ranks, std::size_t first,
                                          const std::vector<Query_row<D, N>>& rows) {
  if (!options.row) return std::nullopt;
  using Motion = std::pair<std::array<Point<D>, N>, double>;  // and its radius
  std::optional<Motion> found;
  if (*options.row >= first && *options.row - first < rows.size()) {
    const Query_row<D, N>& row = rows[*options.row - first];
    if (row.error.empty()) found = {row.points, row.radius};
  }
  ranks.gather(to_message(found), [&](const std::string& of_rank) {
    if (!found) found = from_message<std::optional<Motion>>(of_rank);
  });
  if (!ranks.is_first()) return std::nullopt;
  if (!found)
    throw Error(Error_code::usage, fmt::format("--row {}: there is no such valid row", *options.row));
  return Query_row<D, N>{found->first, found->second, 1, 0, {}};
}

/// Draws the requested row.
template <int D, std::size_t N>
void draw_row(const Query_options& options, Query_files& files, const Snapshot<D>& snapshot,
              const Locator<D>& locator, const Query_row<D, N>& motion, const Answer<D>& answer) {
  if (files.picture == nullptr) return;
  const Pictured_motion<D> shown(motion, answer);
  if constexpr (D == 3)
    write_picture(*files.picture, snapshot, *options.row, shown, answer);
  else if (motion.radius == 0)
    write_picture(*files.picture, snapshot, locator, *options.row, motion.points, answer);
  else
    write_thick_picture(*files.picture, snapshot, locator, *options.row, shown, answer);
}

/// Writes the repro file of the requested row.
template <int D>
void record_row(const Query_options& options, Query_files& files, const Environment<D>& environment,
                const Query_row<D, 2>& motion, const Answer<D>& answer) {
  if (files.record == nullptr) return;
  const char* status = motion_status_names[static_cast<std::size_t>(answer.status)];
  write_repro_of(*files.record, environment, motion, options.method,
                 fmt::format("row {} of a query: {}", *options.row, status));
}

/// Options that are of motions without a radius.
/// \throw Error(usage) for one of them
void refuse_with_radii(const Query_options& options) {
  const auto refuse = [](const char* option, const char* advice) {
    throw Error(Error_code::usage, fmt::format("{} is of motions without a radius: {}", option, advice));
  };
  if (options.sweep.touch == Touch::stop) refuse("--touch stop", "with one, no wall is touched");
  if (options.method.kernel != Kernel_choice::exact) refuse("--kernel", "distances are exact only");
  if (options.contact) refuse("--contact", "leave it out, the exact time is found");
  if (!options.trace.empty()) refuse("--trace", "a radius crosses no cells");
  if (!options.tally.empty()) refuse("--tally", "a radius crosses no cells");
}

/// The traces that are requested of the rows of this rank, and those of all on the first.
/// \param files on the first rank
template <int D>
class Traced {
 public:
  Traced(const Query_options& options, Query_files* files, Ranks& ranks, const Environment<D>& environment,
         const Locator<D>& locator, const std::vector<Query_row<D, 2>>& rows)
      : options_(options), files_(files), ranks_(ranks), environment_(environment) {
    if (options.trace.empty() && options.tally.empty()) return;
    std::optional<double> largest;
    if (!options.tally.empty())
      largest = naming(options.queries,
                       [&] { return largest_value(environment.snapshot(), largest_weight(rows)); });
    if (!options.trace.empty()) {
      if (files)
        table_.emplace(*files->trace, std::vector<std::string>{"row", "cell", "length"});
      else
        table_.emplace(text_, 3);
    }
    pieces_.emplace(environment.snapshot(), locator, table_ ? &*table_ : nullptr, largest);
  }

  void add(std::size_t first, std::span<const Query_row<D, 2>> rows, const std::vector<Answer<D>>& answers) {
    if (pieces_) pieces_->add(first, rows, answers);
  }

  void gather() {
    if (table_)
      ranks_.gather(std::move(text_), [&](const std::string& of_rank) { files_->trace->write(of_rank); });
    if (options_.tally.empty()) return;
    Tally& tally = pieces_->tally();
    ranks_.gather(files_ ? std::string() : to_message(tally.words()), [&](const std::string& of_rank) {
      if (!of_rank.empty()) tally.add_words(from_message<std::vector<std::uint64_t>>(of_rank));
    });
    if (!files_) return;
    io::Vtu_grid grid = io::vtu_of_cells(environment_.soup());
    std::vector<double> lengths(grid.cell_count());
    for (std::size_t cell = 0; cell < lengths.size(); ++cell) lengths[cell] = tally[cell];
    grid.cell_data.push_back({"track_length", 1, std::move(lengths)});
    files_->tally->write(io::vtu_text(grid));
  }

 private:
  double largest_weight(const std::vector<Query_row<D, 2>>& rows) {
    double largest = 0;
    for (const Query_row<D, 2>& row : rows)
      if (row.error.empty()) largest = std::max(largest, std::abs(row.weight));
    ranks_.gather(to_message(largest), [&](const std::string& of_rank) {
      largest = std::max(largest, from_message<double>(of_rank));
    });
    return from_message<double>(ranks_.broadcast(to_message(largest)));
  }

  const Query_options& options_;
  Query_files* const files_;
  Ranks& ranks_;
  const Environment<D>& environment_;
  std::string text_;  // of a later rank
  std::optional<io::Csv_writer> table_;
  std::optional<Piece_tables<D>> pieces_;
};

/// Of sweeps, nothing is traced.
template <int D>
struct Not_traced {
  template <class... Arguments>
  explicit Not_traced(const Arguments&...) {}
  template <class... Arguments>
  void add(const Arguments&...) {}
  void gather() {}
};

/// Sets the weights of rows from the column `weight`, if there is one. A row without a number there is
/// invalid.
template <int D>
void set_weights(const io::Csv_table& table, std::vector<Query_row<D, 2>>& rows) {
  const auto column = table.find_column("weight");
  for (std::size_t r = 0; column && r < rows.size(); ++r) {
    if (!rows[r].error.empty()) continue;
    const io::Parsed_number number = table.number(r, *column);
    rows[r].weight = number.value;
    rows[r].error = number.reason;
  }
}

/// Answers the rows of this rank by answer(row, counts), and hands the answers to the first, which writes
/// those of all.
/// \param files on the first rank
/// \param has_radii some row of the whole table has a radius
template <int D, std::size_t N, class Answer_row>
void answer_rows_of_rank(const Query_options& options, Query_files* files, Ranks& ranks,
                         const Environment<D>& environment, const std::vector<Query_row<D, N>>& rows,
                         bool has_radii, const char* label, const Answer_row& answer,
                         const Locator<D>& locator) {
  const Snapshot<D>& snapshot = environment.snapshot();
  const std::size_t first = first_row(ranks, rows.size());
  const auto wanted = wanted_row(options, ranks, first, rows);
  const std::vector<std::string> columns = answer_columns(N == 3, has_radii);
  std::string text;                  // of a later rank
  constexpr std::size_t about = 96;  // bytes of a row
  if (files == nullptr) text.reserve(about * rows.size());
  io::Csv_writer table =
      files != nullptr ? io::Csv_writer(*files->answers, columns) : io::Csv_writer(text, columns.size());
  std::conditional_t<N == 2, Traced<D>, Not_traced<D>> traced(options, files, ranks, environment, locator,
                                                              rows);
  Answered answered;
  answer_rows(rows, label, answered.counts, answer,
              [&](std::size_t begin, const std::vector<Answer<D>>& answers) {
                const std::span<const Query_row<D, N>> of_batch(rows.data() + begin, answers.size());
                answered.add(answers, of_batch);
                write_answers(table, first + begin, snapshot, of_batch, answers, has_radii);
                traced.add(first + begin, of_batch, answers);
              });
  if (files == nullptr) {
    ranks.gather(to_message(answered));
    ranks.gather(std::move(text));
    traced.gather();
    return;
  }
  if (wanted) {
    Edge_counts not_counted;
    const Answer<D> once_more = answer(*wanted, not_counted);
    if constexpr (N == 2) record_row(options, *files, environment, *wanted, once_more);
    draw_row(options, *files, snapshot, locator, *wanted, once_more);
  }
  ranks.gather({}, [&](const std::string& of_rank) {
    if (of_rank.empty()) return;  // that of the first itself
    answered.add(from_message<Answered>(of_rank));
  });
  ranks.gather({}, [&](const std::string& of_rank) { files->answers->write(of_rank); });
  traced.gather();
  report(options, *files, answered, has_radii);
}

}  // namespace

template <int D>
void answer_table(const Query_options& options, Query_files* files, Ranks& ranks,
                  const Environment<D>& environment) {
  const Snapshot<D>& snapshot = environment.snapshot();
  const io::Csv_table table = io::Csv_table::read(options.queries, {ranks.rank(), ranks.size()});
  const bool has_radii = options.radius != 0 || table.find_column("radius");
  if (has_radii) refuse_with_radii(options);
  if (options.mode == Query_mode::move) {
    auto moves = io::query_rows<D, 2>(table, {"a", "b"}, options.radius);
    if (!options.tally.empty()) set_weights(table, moves);
    const Locator<D> locator(snapshot);
    answer_rows_of_rank(
        options, files, ranks, environment, moves, has_radii, "walking",
        [&](const Query_row<D, 2>& row, Edge_counts& local) {
          const auto& [from, to] = row.points;
          return row.radius == 0
                     ? answer_move(snapshot, locator, from, to, options.sweep.touch, options.method, local)
                     : answer_move(snapshot, locator, from, to, options.sweep.touch, local, row.radius);
        },
        locator);
  } else {
    const auto sweeps = io::query_rows<D, 3>(table, {"p", "t", "q"}, options.radius);
    const Locator<D> locator(snapshot);
    answer_rows_of_rank(
        options, files, ranks, environment, sweeps, has_radii, "sweeping",
        [&](const Query_row<D, 3>& row, Edge_counts& local) {
          const auto& [p, target, q] = row.points;
          return answer_sweep(snapshot, locator, Edge_motion<D>{p, target, q, row.radius}, options.sweep,
                              local);
        },
        locator);
  }
}

template void answer_table(const Query_options&, Query_files*, Ranks&, const Environment<2>&);
template void answer_table(const Query_options&, Query_files*, Ranks&, const Environment<3>&);

}  // namespace cellwalk::cli
