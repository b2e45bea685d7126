// SPDX-License-Identifier: LGPL-3.0-or-later
// The keywords of a legacy file read as VTK reads them, with the sizes of their lists tested.
#include "vtk_lists.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "io/files/text.h"

namespace cellwalk::io {
namespace {

constexpr std::size_t longest_word = 255, longest_line = 255;  // characters that VTK takes at once

/// A part of the text, read as VTK does: by a stream in the locale "C".
class Vtk_stream {
 public:
  explicit Vtk_stream(std::string_view rest) : rest_(rest) {}

  std::string_view word() {
    skip_white_space();
    return take(std::min(rest_.substr(0, longest_word).find_first_of(blanks_and_ends), longest_word));
  }

  /// It may have either sign, and ends where its digits do. None where the stream fails.
  template <class Integer>
  std::optional<Integer> integer() {
    skip_white_space();
    const bool is_negative = rest_.starts_with('-'), has_sign = is_negative || rest_.starts_with('+');
    const std::size_t begin = has_sign ? 1 : 0;
    const std::string_view digits = rest_.substr(begin, rest_.find_first_not_of("0123456789", begin) - begin);
    if (digits.empty()) return {};
    rest_.remove_prefix(begin + digits.size());
    constexpr Integer least = std::numeric_limits<Integer>::min(), most = std::numeric_limits<Integer>::max();
    Integer value = 0;  // negative, since that reaches further
    for (const char c : digits) {
      const auto digit = static_cast<Integer>(c - '0');
      if (value < (least + digit) / 10) return {};
      value = static_cast<Integer>(10 * value - digit);
    }
    if (is_negative) return value;
    if (value < -most) return {};
    return static_cast<Integer>(-value);
  }

  /// Goes to the next line; false if VTK does not find its end.
  bool next_line() {
    const std::size_t end = rest_.substr(0, longest_line + 1).find('\n');
    if (end == std::string_view::npos) return false;
    take(end + 1);
    return true;
  }

  /// Its bytes, the highest first.
  template <class Integer>
  std::optional<Integer> binary() {
    if (rest_.size() < sizeof(Integer)) return {};
    std::uint64_t value = 0;
    for (const char c : take(sizeof(Integer))) value = value << 8 | static_cast<unsigned char>(c);
    return static_cast<Integer>(value);
  }

 private:
  void skip_white_space() { take(rest_.find_first_not_of(blanks_and_ends)); }

  std::string_view take(std::size_t count) {
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(taken.size());
    return taken;
  }

  std::string_view rest_;
};

/// Numbers of a cell as the faces of a polyhedron: how many, and of each how many corners, and these.
class Face_stream {
 public:
  void add(std::int64_t number) {
    if (is_empty_)
      faces_left_ = number;
    else if (corners_left_ > 0)
      --corners_left_;
    else {
      --faces_left_;
      corners_left_ = number;
    }
    is_empty_ = false;
    is_sound_ &= faces_left_ >= 0 && corners_left_ >= 0;
  }
  /// True if all that is announced is there, and nothing else.
  bool is_whole() const { return !is_empty_ && is_sound_ && faces_left_ == 0 && corners_left_ == 0; }

 private:
  bool is_empty_ = true, is_sound_ = true;
  std::int64_t faces_left_ = 0, corners_left_ = 0;
};

enum class Content { values, types, cells };  ///< of a list: one number for each, or corners of cells

struct Keyword {
  std::string_view word;
  Content content;
};

constexpr std::array<Keyword, 9> keywords{{{"points", Content::values},
                                           {"point_data", Content::values},
                                           {"cell_data", Content::values},
                                           {"cell_types", Content::types},
                                           {"cells", Content::cells},
                                           {"polygons", Content::cells},
                                           {"lines", Content::cells},
                                           {"vertices", Content::cells},
                                           {"triangle_strips", Content::cells}}};

/// The part of a file of which VTK makes lists, after its title.
class Legacy_lists {
 public:
  explicit Legacy_lists(std::string_view bytes) : bytes_(bytes), steps_left_(bytes.size()) {
    const std::string first_line(bytes.substr(0, std::min(bytes.find('\n'), longest_line)));
    int major = 0, minor = 0;
    constexpr std::size_t version = 22;  // characters before it
    if (first_line.size() > version &&
        std::sscanf(first_line.c_str() + version, "%d.%d", &major, &minor) == 2)
      have_offsets_ = major >= 5;
    begin_ = std::min(bytes.find('\n'), bytes.size() - 1) + 1;
    begin_ = std::min(bytes.find('\n', begin_), bytes.size() - 1) + 1;
    is_binary_ = same_word(Vtk_stream(bytes.substr(begin_)).word().substr(0, 6), "BINARY");
  }

  /// The places of the keywords with which VTK would go wrong.
  std::vector<std::size_t> broken() {
    constexpr std::string_view first_letters = "pclvtPCLVT";
    for (std::size_t at = begin_; (at = bytes_.find_first_of(first_letters, at)) != std::string_view::npos;
         ++at)
      for (const Keyword& keyword : keywords)
        if (same_word(bytes_.substr(at, keyword.word.size()), keyword.word)) examine(at, keyword);
    for (const Types& types : types_) {
      if (types.count < most_cells_)
        refuse(types.at, "the numbers of cells and of cell types differ: the file is broken");
      else if (std::ranges::any_of(types.polyhedra, [&](std::size_t cell) {
                 return cell < may_be_polyhedra_.size() && !may_be_polyhedra_[cell];
               }))
        refuse(types.at, "the faces of a polyhedron are not as many as announced: the file is broken");
    }
    return std::move(broken_);
  }

  const std::string& problem() const { return problem_; }

 private:
  struct Types {
    std::size_t at;
    std::int64_t count;
    std::vector<std::size_t> polyhedra;  ///< the numbers of these cells
  };

  void refuse(std::size_t at, const std::string& problem) {
    if (broken_.empty()) problem_ = problem;
    broken_.push_back(at);
  }

  /// As text, a value needs a digit and a blank.
  bool is_too_large(std::int64_t count) const { return std::cmp_greater(count, bytes_.size() / 2); }

  void examine(std::size_t at, const Keyword& keyword) {
    Vtk_stream in(bytes_.substr(at));
    in.word();
    const auto count = in.integer<std::int64_t>();
    const auto numbers = keyword.content == Content::cells ? in.integer<std::int64_t>() : 0;
    if (!count || !numbers) return;  // VTK reports it
    for (const std::int64_t announced : {*count, *numbers}) {
      if (announced < 0)
        return refuse(at, fmt::format("announces {} {}: it is broken", announced, keyword.word));
      if (is_too_large(announced))
        return refuse(
            at, fmt::format("announces {} {}, more than its {} bytes can hold: it is cut short or broken",
                            announced, keyword.word, bytes_.size()));
    }
    if (keyword.content == Content::types) examine_types(at, *count, in);
    if (keyword.content != Content::cells) return;
    std::int64_t cells = *count;
    if (have_offsets_) {
      cells = std::max<std::int64_t>(*count - 1, 0);
      if (!same_word(in.word(), "OFFSETS"))
        cells = 0;
      else if (!take_with_offsets(cells, *numbers, in))
        return refuse(at, "its offsets leave the connectivity: the file is broken");
    } else if (!take(cells, *numbers, in)) {
      return refuse(
          at, fmt::format("its {} {} do not take the {} numbers that are announced for them: it is broken",
                          *count, keyword.word, *numbers));
    }
    if (keyword.word == "cells") most_cells_ = std::max(most_cells_, cells);
  }

  template <class Integer>
  std::optional<std::int64_t> number(Vtk_stream& in) const {
    const std::optional<Integer> number = is_binary_ ? in.binary<Integer>() : in.integer<Integer>();
    return number ? std::optional<std::int64_t>(*number) : std::nullopt;
  }

  /// False if no step is left: one list is no longer than the file, only lists within others use them up.
  bool step() { return steps_left_ != 0 && steps_left_-- != 0; }

  void examine_types(std::size_t at, std::int64_t count, Vtk_stream in) {
    constexpr std::int64_t polyhedron = 42;
    Types& types = types_.emplace_back(Types{at, count, {}});
    if (is_binary_ && !in.next_line()) return;
    for (std::int64_t i = 0; i < count; ++i) {
      const auto type = number<std::int32_t>(in);
      if (!type) return;  // VTK reports it
      if (!step()) return refuse(at, "a list within others: the file is broken");
      if (*type == polyhedron) types.polyhedra.push_back(static_cast<std::size_t>(i));
    }
  }

  void note(std::int64_t cell, const Face_stream& faces) {
    const auto i = static_cast<std::size_t>(cell);
    if (i == may_be_polyhedra_.size())
      may_be_polyhedra_.push_back(faces.is_whole());
    else
      may_be_polyhedra_[i] = may_be_polyhedra_[i] && faces.is_whole();
  }

  /// True if cells, each a number of corners and these, take the numbers that are announced for all, or VTK
  /// finds before that they end. Otherwise it writes beyond its memory.
  bool take(std::int64_t& cells, std::int64_t numbers, Vtk_stream in) {
    if (is_binary_ && !in.next_line()) return false;
    std::int64_t taken = 0;
    for (std::int64_t i = 0; i < cells; ++i) {
      if (taken == numbers || !step()) return false;
      const auto corners = number<std::int32_t>(in);
      if (!corners) return ends(cells);
      if (*corners < 0 || *corners >= numbers - taken) return false;
      taken += 1 + *corners;
      Face_stream faces;
      for (std::int64_t k = 0; k < *corners; ++k) {
        const auto corner = number<std::int32_t>(in);
        if (!corner) return ends(cells);
        faces.add(*corner);
      }
      note(i, faces);
    }
    return taken == numbers;
  }

  /// The numbers of a list after its keyword, OFFSETS or CONNECTIVITY. None if VTK refuses them.
  std::optional<std::vector<std::int64_t>> array(std::int64_t count, Vtk_stream& in) {
    const bool is_long = lower(in.word()) == "vtktypeint64";  // all others have 32 bits, or are refused
    if (is_binary_ && !in.next_line()) return {};
    std::vector<std::int64_t> numbers;
    for (std::int64_t i = 0; i < count; ++i) {
      const auto next = is_long ? number<std::int64_t>(in) : number<std::int32_t>(in);
      if (!next || !step()) return {};
      numbers.push_back(*next);
    }
    return numbers;
  }

  /// The same for cells whose corners are in one array, and where they begin in another.
  bool take_with_offsets(std::int64_t& cells, std::int64_t numbers, Vtk_stream in) {
    const std::string type = lower(Vtk_stream(in).word());
    if (type != "vtktypeint64" && type != "vtktypeint32") return false;
    const auto offsets = array(cells + 1, in);
    if (!offsets || !same_word(in.word(), "CONNECTIVITY")) return steps_left_ != 0 && ends(cells);
    const std::string other = lower(Vtk_stream(in).word());
    if (other != "vtktypeint64" && other != "vtktypeint32") return false;
    const auto corners = array(numbers, in);
    if (!corners) return steps_left_ != 0 && ends(cells);
    if (offsets->front() < 0 || offsets->back() > numbers || !std::ranges::is_sorted(*offsets)) return false;
    for (std::int64_t i = 0; i < cells; ++i) {
      Face_stream faces;
      const auto begin = static_cast<std::size_t>(i);
      for (std::int64_t k = (*offsets)[begin]; k < (*offsets)[begin + 1]; ++k)
        faces.add((*corners)[static_cast<std::size_t>(k)]);
      note(i, faces);
    }
    return true;
  }

  /// VTK refuses the list, so that no cells are made of it.
  static bool ends(std::int64_t& cells) {
    cells = 0;
    return true;
  }

  std::string_view bytes_;
  std::size_t begin_, steps_left_;
  bool have_offsets_ = false, is_binary_ = false;
  std::int64_t most_cells_ = 0;
  std::vector<Types> types_;
  std::vector<bool> may_be_polyhedra_;  ///< for each number of a cell: in all lists
  std::vector<std::size_t> broken_;
  std::string problem_;
};

}  // namespace

std::optional<std::string> hide_broken_lists(std::string& bytes) {
  if (bytes.empty()) return {};
  Legacy_lists lists(bytes);
  const std::vector<std::size_t> broken = lists.broken();
  if (broken.empty()) return {};
  for (const std::size_t at : broken) bytes[at] = '_';
  return lists.problem();
}

}  // namespace cellwalk::io
