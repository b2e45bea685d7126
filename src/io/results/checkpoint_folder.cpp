// SPDX-License-Identifier: LGPL-3.0-or-later
// The head of a checkpoint, its checksum, and the choice of the newest sound one.
#include <cellwalk/internal/io/checkpoint_folder.h>
#include <cellwalk/internal/io/durable.h>
#include <cellwalk/internal/kernel/byte_archive.h>
#include <cellwalk/internal/kernel/checksum.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <system_error>

#include "io/files/text.h"

namespace cellwalk::io {
namespace {

namespace fs = std::filesystem;

constexpr std::array<char, 8> magic{'C', 'W', 'C', 'H', 'E', 'C', 'K', '\n'};
/// To be raised whenever the state of a run gets other parts, or these another meaning.
constexpr std::uint32_t version = 4;
constexpr std::uint32_t byte_order = 0x01020304;
constexpr std::string_view prefix = "step-", suffix = ".checkpoint";
constexpr std::size_t most_kept = 2;

/// The defect of a checkpoint that was not written as a whole, or was changed.
struct Damage {
  std::string what;
};

/// The head of a file; the program and the state follow.
struct Sealed {
  std::array<char, 8> magic = io::magic;
  std::uint32_t version = io::version, byte_order = io::byte_order;
  std::uint64_t step = 0, bytes = 0, checksum = 0;  ///< of the head that has the content's checksum here

  template <class Archive>
  void archive(Archive& a) {
    a(magic, version, byte_order, step, bytes, checksum);
  }
};
constexpr std::size_t head_size = 40;

std::vector<std::byte> head_bytes(const Sealed& head) {
  cellwalk::detail::Byte_writer out;
  out(head);
  return out.take();
}

std::uint64_t checksum_of(Sealed head, std::span<const std::byte> content) {
  head.checksum = cellwalk::detail::checksum(content);
  return cellwalk::detail::checksum(head_bytes(head));
}

Checkpoint unsealed(const fs::path& file, const std::string& program) {
  const std::string text = load_packed(file);
  const std::span<const std::byte> bytes = std::as_bytes(std::span(text));
  if (bytes.size() < head_size) throw Damage{"it is cut short"};
  cellwalk::detail::Byte_reader in(bytes.first(head_size));
  const auto head = in.next<Sealed>();
  if (head.magic != magic || head.byte_order != byte_order)
    throw Damage{"it is no checkpoint of this machine"};
  const auto content = bytes.subspan(head_size);
  if (head.bytes != content.size()) throw Damage{"it is cut short"};
  if (head.checksum != checksum_of(head, content)) throw Damage{"its checksum differs"};
  if (head.version != version)
    throw Error(
        Error_code::input,
        fmt::format("{}: was written in version {} of the format, and this program reads version {}: go "
                    "on with the program that began the run",
                    file.string(), head.version, version));
  cellwalk::detail::Byte_reader body(content);
  if (const auto writer = body.next<std::string>(); writer != program)
    throw Error(Error_code::input,
                fmt::format("{}: was written by {}, and this is {}: go on with the program that "
                            "began the run",
                            file.string(), shown(writer), program));
  const auto state = body.take_rest();
  return {head.step, {state.begin(), state.end()}, file, {}};
}

}  // namespace

fs::path Checkpoint_folder::file_of(std::uint64_t step) const {
  return folder_ / fmt::format("{}{:010}{}", prefix, step, suffix);
}

/// Descending.
std::vector<std::uint64_t> Checkpoint_folder::steps() const {
  std::vector<std::uint64_t> result;
  std::error_code failure;
  for (fs::directory_iterator entry(folder_, failure); !failure && entry != fs::directory_iterator();
       entry.increment(failure)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(prefix) || !name.ends_with(suffix) || !entry->is_regular_file(failure)) continue;
    const char* const begin = name.data() + prefix.size();
    const char* const end = name.data() + name.size() - suffix.size();
    std::uint64_t step = 0;
    const auto [last, wrong] = std::from_chars(begin, end, step);
    if (wrong == std::errc{} && last == end) result.push_back(step);
  }
  std::sort(result.rbegin(), result.rend());
  return result;
}

void Checkpoint_folder::keep(std::uint64_t step, std::span<const std::byte> state) {
  cellwalk::detail::Byte_writer body;
  body(program_);
  std::vector<std::byte> content = body.take();
  content.insert(content.end(), state.begin(), state.end());
  Sealed head;
  head.step = step;
  head.bytes = content.size();
  head.checksum = checksum_of(head, content);
  const std::vector<std::byte> begin = head_bytes(head);
  const std::array<std::span<const std::byte>, 2> pieces{begin, content};
  write_durably(file_of(step), pieces);
  std::size_t kept = 0;
  std::error_code ignored;
  for (const std::uint64_t other : steps())  // those after it are damaged, and were passed over
    if (other > step || ++kept > most_kept) fs::remove(file_of(other), ignored);
}

Checkpoint Checkpoint_folder::newest() const {
  std::vector<std::string> passed_over;
  for (const std::uint64_t step : steps()) {
    const fs::path file = file_of(step);
    try {
      Checkpoint found = unsealed(file, program_);
      found.passed_over = std::move(passed_over);
      return found;
    } catch (const Damage& damage) {
      passed_over.push_back(fmt::format("{}: {}", file.string(), damage.what));
    }
  }
  if (!passed_over.empty())
    throw Error(Error_code::input,
                passed_over.front() + ", and there is no other checkpoint: begin the run again");
  throw Error(Error_code::input, folder_.string() + ": holds no checkpoint: begin the run again");
}

}  // namespace cellwalk::io
